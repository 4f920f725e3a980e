//! Pictures of the stages of a frame, each shown in its place.

use clap::ValueEnum;
use npr_core::camera::Camera;
use npr_core::color::{SrgbEncoder, premultiplied_light};
use npr_core::math::mix_bits;
use npr_core::outline::Outline;
use npr_drawing::artwork::{ArtworkOptions, Mark, arrange};
use npr_drawing::drawing::paint_over;
use npr_render::{
    Drawing, Frame, Kind, LayerPixel, LineStage, RenderError, Renderer, StagePixel, SurfaceStage,
};
use std::mem::take;

/// A layer that is shown in place of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum DebugLayer {
    /// Print the names of all layers.
    List,
    /// A colour for every triangle.
    Triangle,
    /// Depth: white is near, dark is far, black is nothing.
    Depth,
    /// Normals in the world: red is right, green is up, blue is towards +z, from -1 to 1.
    Normal,
    /// A colour for every object.
    Object,
    /// A colour for every material.
    Material,
    /// Base colours, before light.
    Base,
    /// Light, before ramps: how far along its ramp each place lies.
    Light,
    /// Tones: base colours in the light of the ramps, before ink and highlights.
    Tones,
    /// Ink and hatching alone, on white.
    Ink,
    /// The picture without lines.
    Surfaces,
    /// What found lines on the mask: red depth, green normals, blue objects, olive materials, violet cuts.
    Mask,
    /// Lines as found, hidden ones too: contours white, boundaries orange, creases blue, materials green,
    /// intersections pink, marked ones yellow.
    Found,
    /// The same by what is seen of them: white is, red lies behind one surface, darker red behind several.
    Sight,
    /// Pieces of them that are seen, a colour each.
    Pieces,
    /// Strokes joined of those, a colour each, before the style changes them.
    Joined,
    /// Strokes as drawn, a colour each.
    Stroke,
    /// Kinds of strokes as drawn, in the colours of found.
    Kind,
    /// Places on strokes: red rises along them, anew every 64 pixels, and green from their left edge to their right.
    Uv,
    /// Depth of the strokes, as depth has it.
    LineDepth,
    /// Lines alone, over middle grey.
    Line,
}

/// Grey under lines that are shown alone, as an sRGB byte.
const UNDER_LINES: u8 = 128;

/// Pixels along a stroke over which its red rises.
const UV_PX: f32 = 64.0;

/// Blue of all strokes there, so that none is black.
const UV_BLUE: u8 = 96;

/// Share of white that the farthest surface keeps.
const FARTHEST: f32 = 0.1;

/// Width of lines that are no strokes yet, in pixels.
const FOUND_PX: f64 = 1.5;

/// Share of red that a line keeps for every further surface before it.
const BEHIND: f32 = 0.7;

impl DebugLayer {
    /// The names of all layers, each with what it shows.
    pub fn all() -> impl Iterator<Item = (String, String)> {
        let layers = Self::value_variants()
            .iter()
            .filter(|layer| **layer != Self::List);
        let values = layers.filter_map(Self::to_possible_value);
        values.map(|value| {
            let help = value.get_help().map(ToString::to_string);
            (value.get_name().to_owned(), help.unwrap_or_default())
        })
    }

    /// The same, a line each.
    pub fn list() -> String {
        Self::all()
            .map(|(name, text)| format!("{name:10} {text}\n"))
            .collect()
    }

    /// The layer of a name, if there is one.
    #[cfg(any(feature = "view", test))]
    pub fn named(name: &str) -> Option<Self> {
        let layer = Self::from_str(name, false).ok();
        layer.filter(|layer| *layer != Self::List)
    }

    /// The layer of the frame of `size` pixels that a renderer draws, whose options ask for layers and stages.
    pub fn draw(
        self,
        renderer: &mut Renderer<'_>,
        camera: &Camera,
        size: [u32; 2],
    ) -> Result<Frame, RenderError> {
        let mut frame = match self.lines() {
            Some(stage) => self.frame_of(renderer.lines_at(camera, stage)?, size),
            None => renderer.draw(camera)?,
        };
        self.show_in(&mut frame);
        Ok(frame)
    }

    /// How far the surfaces of its frame are drawn.
    pub fn surfaces(self) -> SurfaceStage {
        match self {
            Self::Base => SurfaceStage::Base,
            Self::Light => SurfaceStage::Light,
            Self::Tones => SurfaceStage::Tones,
            Self::Ink => SurfaceStage::Ink,
            _ => SurfaceStage::Whole,
        }
    }

    /// Whether it shows surfaces of a frame at a stage.
    fn is_of_surfaces(self) -> bool {
        self == Self::Surfaces || self.surfaces() != SurfaceStage::Whole
    }

    /// The stage of lines that it shows in place of a frame.
    fn lines(self) -> Option<LineStage> {
        match self {
            Self::Found | Self::Sight => Some(LineStage::Found),
            Self::Pieces => Some(LineStage::Seen),
            Self::Joined => Some(LineStage::Joined),
            _ => None,
        }
    }

    /// A frame of `size` pixels that shows lines at a stage, thin and over black. O(pixels + ink).
    fn frame_of(self, drawings: Vec<Drawing>, size: [u32; 2]) -> Frame {
        // Give every line its colour.
        let mut frame = Frame {
            size,
            rgba: [0, 0, 0, 255].repeat(size[0] as usize * size[1] as usize),
            ..Frame::default()
        };
        let mut number = 0;
        for mut drawing in drawings {
            for stroke in &mut drawing.strokes {
                number += 1;
                let [r, g, b] = match self {
                    Self::Found => color_of_kind(stroke.kind),
                    Self::Sight => color_of_sight(stroke.occluders),
                    _ => color_of(number),
                };
                for point in &mut stroke.points {
                    (point.width, point.color) = (FOUND_PX, Some([r, g, b, 255]));
                }
            }

            // Draw those that are hidden first.
            let [hidden, seen] = [false, true].map(|is_seen| {
                let strokes = drawing.strokes.iter();
                let mut strokes: Vec<_> = strokes
                    .filter(|stroke| stroke.is_visible() == is_seen)
                    .cloned()
                    .collect();
                strokes.iter_mut().for_each(|stroke| stroke.occluders = 0);
                strokes
            });
            for strokes in [hidden, seen] {
                drawing.strokes = strokes;
                let artwork = arrange(&drawing, &ArtworkOptions::default());
                let groups = artwork.layers.into_iter().flat_map(|layer| layer.groups);
                let marks: Vec<Mark> = groups.flat_map(|group| group.marks).collect();
                paint_over(&marks, &mut frame.rgba, size);
            }
        }
        frame
    }

    /// Puts the layer into the place of a frame's colours, and lets go of its layers; tells where it is empty.
    /// O(pixels).
    fn show_in(self, frame: &mut Frame) {
        if self.lines().is_none() {
            self.color(frame);
        }
        let (pixels, _) = frame.rgba.as_chunks::<4>();
        if pixels.iter().all(|pixel| pixel == &pixels[0]) {
            let name = self.to_possible_value();
            let name = name.map_or_else(String::new, |value| value.get_name().to_owned());
            let notice =
                format!("the layer {name} is of one colour: nothing of it shows in this frame");
            frame.notices.push(notice);
        }
    }

    /// Gives every pixel of a frame the colour of its layer.
    fn color(self, frame: &mut Frame) {
        let layers = take(&mut frame.layers);
        let depth_of: fn(&LayerPixel) -> f32 = match self {
            Self::LineDepth => |pixel| pixel.stroke_depth,
            _ => |pixel| pixel.depth,
        };
        let depths = layers.iter().map(depth_of);
        let seen = depths.filter(|depth| *depth < LayerPixel::FAR);
        let (near, far) = seen.fold((f32::INFINITY, 0.0_f32), |(near, far), depth| {
            (near.min(depth), far.max(depth))
        });
        let [under, ..] = premultiplied_light([UNDER_LINES, 0, 0, 255]);
        let encoder = SrgbEncoder::new();
        let shown = |(pixel, stages): (&LayerPixel, &StagePixel)| -> [u8; 3] {
            match self {
                Self::List
                | Self::Line
                | Self::Found
                | Self::Sight
                | Self::Pieces
                | Self::Joined => {
                    let [r, g, b, alpha] = pixel.line;
                    [r, g, b].map(|light| encoder.byte(light + under * (1.0 - alpha)) as u8)
                }
                Self::Depth | Self::LineDepth if depth_of(pixel) >= LayerPixel::FAR => [0; 3],
                Self::Depth | Self::LineDepth => {
                    let share = (depth_of(pixel) - near) / (far - near).max(f32::MIN_POSITIVE);
                    [byte(1.0 - (1.0 - FARTHEST) * share); 3]
                }
                Self::Normal => pixel.normal.map(|n| byte(0.5 + 0.5 * n)),
                Self::Triangle => color_of(stages.triangle),
                Self::Object => color_of(pixel.object),
                Self::Material => color_of(stages.material),
                Self::Base | Self::Light | Self::Tones | Self::Ink | Self::Surfaces => {
                    let [r, g, b, _] = stages.surface;
                    [r, g, b]
                }
                Self::Mask => color_of_mask(stages.mask),
                Self::Stroke => color_of(pixel.stroke),
                Self::Kind => stages.kind.map_or([0; 3], color_of_kind),
                Self::Uv if pixel.stroke == 0 => [0; 3],
                Self::Uv => {
                    let [u, v] = pixel.uv;
                    [byte((u / UV_PX).fract()), byte(0.5 + 0.5 * v), UV_BLUE]
                }
            }
        };
        let stages = take(&mut frame.stages);
        let colors = layers.iter().zip(&stages).map(shown);
        let alpha_of = |stages: &StagePixel| match self.is_of_surfaces() {
            true => stages.surface[3],
            false => 255,
        };
        let alphas = stages.iter().map(alpha_of);
        let colors = colors.zip(alphas);
        frame.rgba = colors.flat_map(|([r, g, b], a)| [r, g, b, a]).collect();
    }
}

fn byte(share: f32) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// The colour of a kind of line.
fn color_of_kind(kind: Kind) -> [u8; 3] {
    match kind {
        Kind::Contour => [255; 3],
        Kind::Boundary => [255, 160, 0],
        Kind::Crease => [64, 160, 255],
        Kind::Material => [64, 255, 64],
        Kind::Intersection => [255, 96, 192],
        Kind::Marked => [255, 255, 0],
    }
}

/// The colour of a line behind so many surfaces.
fn color_of_sight(occluders: u32) -> [u8; 3] {
    match occluders {
        0 => [255; 3],
        more => [byte(BEHIND.powi((more.min(5) - 1) as i32)), 0, 0],
    }
}

/// The colour of what found a pixel of the mask: the brightest of each channel where several did.
fn color_of_mask(bits: u32) -> [u8; 3] {
    let colors = [
        (Outline::DEPTH, [255, 0, 0]),
        (Outline::NORMAL, [0, 255, 0]),
        (Outline::OBJECT_ID, [0, 0, 255]),
        (Outline::MATERIAL_ID, [128, 128, 0]),
        (Outline::PIECE, [128, 0, 128]),
    ];
    let found = colors.into_iter().filter(|(bit, _)| bits & bit != 0);
    found.fold([0; 3], |sum, (_, color): (u32, [u8; 3])| {
        [0, 1, 2].map(|k| color[k].max(sum[k]))
    })
}

/// A colour that tells a number from others: black for 0, none dark for others.
fn color_of(number: u32) -> [u8; 3] {
    if number == 0 {
        return [0; 3];
    }
    let [r, g, b, _] = mix_bits(number).to_le_bytes();
    [r, g, b].map(|channel| 64 + channel / 4 * 3)
}
