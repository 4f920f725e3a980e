//! Words of a style, set in their fonts and placed in a view.

use crate::error::RenderError;
use crate::frame::Frame;
use glam::{Mat4, Vec3};
use npr_core::window::View;
use npr_drawing::drawing::paint_over;
use npr_drawing::lettering::{Band, Font, Lettered, Setting, Words, set_words};
use npr_stylesheet::{Color, LetteringOutline, Style};
use std::collections::BTreeMap;

/// Words of a style, set in their fonts: ready to be placed in any view.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lettering {
    words: Vec<(npr_stylesheet::Lettering, Words)>,
    notices: Vec<String>,
}

impl Lettering {
    /// Sets the words of a style; `fonts` by the names that the style gives them.
    ///
    /// Words whose font is not among them are left out, and [`Lettering::notices`] tells.
    ///
    /// # Errors
    ///
    /// [`RenderError::Lettering`] for words beyond the limits and for fonts that break off.
    pub fn new(style: &Style, fonts: &BTreeMap<String, Font>) -> Result<Self, RenderError> {
        let mut lettering = Self::default();
        for (index, said) in style.lettering.iter().enumerate() {
            let Some(font) = fonts.get(&said.font) else {
                let notice = format!("lettering.{index} is left out: its font was not given");
                lettering.notices.push(notice);
                continue;
            };
            let words = set_words(font, &said.text, &setting_of(said))
                .map_err(|source| RenderError::Lettering { index, source })?;
            lettering.notices.extend(notice_of(index, &words.missing));
            lettering.words.push((said.clone(), words));
        }
        Ok(lettering)
    }

    /// Whether there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// What is left out, for the user.
    pub fn notices(&self) -> &[String] {
        &self.notices
    }

    /// Whether anything of the scene may hide any of the words.
    pub(crate) fn may_be_hidden(&self) -> bool {
        self.words.iter().any(|(said, _)| said.hidden)
    }

    /// The words in a view, in pixels of its frame, the last on top; those anchored behind the eye are left out.
    pub fn placed(&self, view: &View, dpi: f32) -> Vec<Lettered> {
        self.stood(view, dpi).map(|(words, _)| words).collect()
    }

    /// The same words, each with the reversed depth above which surfaces hide them; `None` where no surface does.
    fn stood<'a>(
        &'a self,
        view: &'a View,
        dpi: f32,
    ) -> impl Iterator<Item = (Lettered, Option<f32>)> + 'a {
        let placed = self.words.iter().filter_map(move |(said, words)| {
            // Find where the words stand, and set them in the sizes that lengths have there.
            let (middle, world_px) = place_of(said, view)?;
            let px = |length: npr_stylesheet::Length| {
                f64::from(length.to_px(view.frame_px[1], dpi, world_px))
            };
            let band = |band: &LetteringOutline| Band {
                color: bytes_of(band.color),
                width_px: px(band.width),
            };
            let bands: Vec<Band> = said.bands().map(band).collect();
            let middle = middle.map(f64::from);
            let lettered = Lettered {
                text: said.text.clone(),
                marks: words.marks(middle, px(said.size), bytes_of(said.color), &bands),
            };

            // Let surfaces before the anchor hide them, where the style says so.
            let depth = said.anchor.filter(|_| said.hidden);
            Some((lettered, depth.map(|anchor| depth_of(anchor, view))))
        });
        placed.filter(|(words, _)| !words.marks.is_empty())
    }

    /// Paints the words over a finished frame; `depths_on` gives the reversed depths of surfaces on a grid over it.
    pub(crate) fn finish(
        &self,
        view: &View,
        dpi: f32,
        frame: &mut Frame,
        depths_on: impl Fn([u32; 2]) -> Vec<f32>,
    ) {
        let mut depths = None;
        for (words, hidden_from) in self.stood(view, dpi) {
            // Paint words that nothing hides as they are.
            let Some(hidden_from) = hidden_from else {
                paint_over(&words.marks, &mut frame.rgba, frame.size);
                continue;
            };

            // Lay the others over pixel by pixel, as far as no surface before them covers it.
            let depths = depths.get_or_insert_with(|| depths_on(frame.size.map(|side| 2 * side)));
            let mut sheet = vec![0; frame.rgba.len()];
            paint_over(&words.marks, &mut sheet, frame.size);
            let pixels = frame.rgba.as_chunks_mut().0.iter_mut();
            for (i, (under, over)) in pixels.zip(sheet.as_chunks().0).enumerate() {
                if over[3] > 0 {
                    lay_over(
                        under,
                        *over,
                        seen_share(depths, i, frame.size[0], hidden_from),
                    );
                }
            }
        }
    }
}

/// How much nearer to the eye than an anchor a surface has to be to hide its words, as a share of the reversed depth:
/// the surface under the anchor does not hide them.
const COVER_ROOM: f32 = 0.01;

/// Reversed depth above which a surface stands before a place.
fn depth_of(place: [f32; 3], view: &View) -> f32 {
    let clip = Mat4::from_cols_array_2d(&view.clip_from_world) * Vec3::from(place).extend(1.0);
    clip.z / clip.w * (1.0 + COVER_ROOM)
}

/// Share of pixel `i` of a picture of `width` pixels that no surface before a depth covers; `depths` are those of two
/// samples a pixel along each axis.
fn seen_share(depths: &[f32], i: usize, width: u32, hidden_from: f32) -> f32 {
    let width = width as usize;
    let (x, y) = (i % width, i / width);
    let samples = [(0, 0), (1, 0), (0, 1), (1, 1)];
    // Where no surface is the depth is 0; anchors beyond the far plane of a parallel view lie deeper.
    let is_seen = |(dx, dy): &(usize, usize)| {
        let depth = depths[(2 * y + dy) * 2 * width + 2 * x + dx];
        depth == 0.0 || depth <= hidden_from
    };
    samples.iter().filter(|sample| is_seen(sample)).count() as f32 / 4.0
}

/// Lays a share of a pixel over another, both sRGB bytes with straight alpha, blended as [`paint_over`] does.
fn lay_over(under: &mut [u8; 4], over: [u8; 4], share: f32) {
    let top = f32::from(over[3]) / 255.0 * share;
    let left = f32::from(under[3]) / 255.0 * (1.0 - top);
    let alpha = top + left;
    if top == 0.0 {
        return;
    }
    for (under, over) in under.iter_mut().zip(over).take(3) {
        let sum = f32::from(over) * top + f32::from(*under) * left;
        *under = (sum / alpha + 0.5) as u8;
    }
    under[3] = (alpha * 255.0 + 0.5) as u8;
}

fn bytes_of(color: Color) -> [u8; 4] {
    [color.r, color.g, color.b, color.a]
}

fn setting_of(said: &npr_stylesheet::Lettering) -> Setting {
    Setting {
        bend: f64::from(said.bend),
        slant: f64::from(said.slant),
        spread: f64::from(said.spread),
        spacing: f64::from(said.spacing),
        line_step: f64::from(said.line_step),
        turn: f64::from(said.rotate_deg).to_radians(),
    }
}

fn notice_of(index: usize, missing: &[char]) -> Option<String> {
    let names: Vec<String> = missing.iter().map(|c| format!("'{c}'")).collect();
    (!names.is_empty()).then(|| {
        format!(
            "lettering.{index}: the font lacks {}, which is left out",
            names.join(", ")
        )
    })
}

/// Where the middle of words lies in the frame, and how many pixels a unit of the scene covers there.
fn place_of(said: &npr_stylesheet::Lettering, view: &View) -> Option<([f32; 2], f32)> {
    let Some(anchor) = said.anchor else {
        let middle = std::array::from_fn(|i| said.at[i] * view.frame_px[i]);
        return Some((middle, 0.0));
    };
    let anchor = Vec3::from(anchor);
    let depth = (anchor - Vec3::from(view.eye_world)).dot(Vec3::from(view.forward_world));
    // A parallel view has no eye that anything could be behind.
    let is_before = depth > 0.0;
    if view.perspective > 0.5 && !is_before {
        return None;
    }
    let clip = Mat4::from_cols_array_2d(&view.clip_from_world) * anchor.extend(1.0);
    let ndc = [clip.x / clip.w, -clip.y / clip.w];
    let middle: [f32; 2] = std::array::from_fn(|i| (ndc[i] + 1.0) * 0.5 * view.frame_px[i]);
    let world_px = view.pixels_per_unit(depth);
    let is_sound = middle.iter().all(|v| v.is_finite()) && world_px.is_finite();
    is_sound.then_some((middle, world_px))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, Renderer, RendererOptions};
    use npr_core::camera::{Camera, Projection};
    use npr_drawing::lettering::testing::block_font;
    use npr_gpu::processor::Processor;
    use npr_stylesheet::{Length, Unit};
    use proptest::prelude::*;

    const BOUNDS: ([f32; 3], [f32; 3]) = ([-1.0; 3], [1.0; 3]);

    fn camera() -> Camera {
        Camera {
            eye: [0.0, 0.0, 5.0],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Perspective { fov_y: 1.0 },
        }
    }

    fn lettering(words: npr_stylesheet::Lettering) -> Lettering {
        let style = Style {
            lettering: vec![words],
            ..Style::default()
        };
        let font = Font::new(block_font()).expect("a sound font");
        Lettering::new(&style, &[("a.ttf".to_owned(), font)].into()).expect("sound words")
    }

    fn anchored(anchor: [f32; 3]) -> npr_stylesheet::Lettering {
        npr_stylesheet::Lettering {
            anchor: Some(anchor),
            ..npr_stylesheet::Lettering::new("HI", "a.ttf")
        }
    }

    #[test]
    fn words_lie_where_the_frame_says() {
        let view = camera().view([200, 100], BOUNDS);
        let said = npr_stylesheet::Lettering {
            at: [0.25, 0.5],
            ..npr_stylesheet::Lettering::new("HI", "a.ttf")
        };
        assert_eq!(place_of(&said, &view), Some(([50.0, 50.0], 0.0)));
        let placed = lettering(said).placed(&view, 96.0);
        assert_eq!(placed[0].text, "HI");
        assert_eq!(placed[0].marks.len(), 2);
    }

    #[test]
    fn words_behind_the_eye_are_left_out() {
        let view = camera().view([200, 100], BOUNDS);
        for z in [5.0, 5.1, 1e9] {
            assert!(
                lettering(anchored([0.0, 0.0, z]))
                    .placed(&view, 96.0)
                    .is_empty(),
                "{z}"
            );
        }
        assert_eq!(
            lettering(anchored([0.0, 0.0, 4.9]))
                .placed(&view, 96.0)
                .len(),
            1
        );
    }

    #[test]
    fn sizes_of_the_world_shrink_with_distance() {
        let world_px = |z: f32| {
            let view = camera().view([200, 100], BOUNDS);
            place_of(&anchored([0.0, 0.0, z]), &view)
                .expect("before the eye")
                .1
        };
        assert!((world_px(0.0) / world_px(-5.0) - 2.0).abs() < 1e-4);
        // A unit at depth 5 of a view 2 tan(0.5) high per depth.
        assert!((world_px(0.0) - 100.0 / (2.0 * 0.546_302_5 * 5.0)).abs() < 1e-3);
        let said = npr_stylesheet::Lettering {
            size: Length {
                value: 1.0,
                unit: Unit::World,
            },
            ..anchored([0.0; 3])
        };
        let view = camera().view([200, 100], BOUNDS);
        assert_eq!(lettering(said).placed(&view, 96.0).len(), 1);
    }

    #[test]
    fn words_lie_over_the_picture_whatever_its_tiles() {
        let style = Style {
            lettering: vec![npr_stylesheet::Lettering {
                at: [0.5, 0.5],
                size: Length {
                    value: 90.0,
                    unit: Unit::Px,
                },
                outline: LetteringOutline {
                    width: Length {
                        value: 10.0,
                        unit: Unit::Px,
                    },
                    ..LetteringOutline::default()
                },
                ..npr_stylesheet::Lettering::new("I", "a.ttf")
            }],
            ..Style::default()
        };
        let model = Model::new(&npr_scene::Scene::default()).expect("an empty scene");
        let fonts =
            BTreeMap::from([("a.ttf".to_owned(), Font::new(block_font()).expect("a font"))]);
        let picture = |tile_pixels| {
            let options = RendererOptions {
                fonts: fonts.clone(),
                tile_pixels,
                ..RendererOptions::new([160, 120])
            };
            let mut renderer =
                Renderer::new(&Processor, &model, &style, &options).expect("a stage");
            renderer.draw(&camera()).expect("a picture")
        };
        let whole = picture(1 << 22);
        assert_eq!(whole.rgba, picture(4096).rgba);
        let pixel = |x: usize, y: usize| &whole.rgba[4 * (y * 160 + x)..][..4];
        let said = &style.lettering[0];
        assert_eq!(pixel(80, 60), bytes_of(said.color));
        // The bar ends 90 / 7 from its middle, the band 10 further out.
        assert_eq!(pixel(97, 60), [0, 0, 0, 255]);
        assert_eq!(pixel(110, 60), [255; 4]);
    }

    #[test]
    fn what_is_left_out_is_told() {
        let style = |font: &str| Style {
            lettering: vec![npr_stylesheet::Lettering::new("xHx", font)],
            ..Style::default()
        };
        let fonts = [("a.ttf".to_owned(), Font::new(block_font()).expect("a font"))].into();
        let reported = |font| {
            Lettering::new(&style(font), &fonts)
                .expect("words")
                .notices()
                .to_vec()
        };
        assert_eq!(
            reported("a.ttf"),
            ["lettering.0: the font lacks 'x', which is left out"]
        );
        assert_eq!(
            reported("b.ttf"),
            ["lettering.0 is left out: its font was not given"]
        );
    }

    /// A board across the view at a depth, right of x.
    fn board(x: f32, z: f32) -> npr_scene::Scene {
        let part = npr_scene::Part {
            positions: vec![[x, -9.0, z], [9.0, -9.0, z], [9.0, 9.0, z], [x, 9.0, z]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..npr_scene::Part::default()
        };
        npr_scene::Scene {
            nodes: vec![npr_scene::Node {
                mesh: Some(0),
                ..npr_scene::Node::default()
            }],
            meshes: vec![npr_scene::Mesh {
                parts: vec![part],
                ..npr_scene::Mesh::default()
            }],
            ..npr_scene::Scene::default()
        }
    }

    /// Pixels of a bar in the middle of the frame, left and right of it, that show the words.
    fn shown(engine: &dyn npr_gpu::engine::Engine, hidden: bool, board_z: f32) -> [usize; 2] {
        let style = Style {
            lettering: vec![npr_stylesheet::Lettering {
                size: Length {
                    value: 60.0,
                    unit: Unit::Px,
                },
                hidden,
                ..anchored([0.0; 3])
            }],
            ..Style::default()
        };
        let model = Model::new(&board(0.0, board_z)).expect("a board");
        let options = RendererOptions {
            fonts: [("a.ttf".to_owned(), Font::new(block_font()).expect("a font"))].into(),
            ..RendererOptions::new([160, 120])
        };
        let mut renderer = Renderer::new(engine, &model, &style, &options).expect("a stage");
        let frame = renderer.draw(&camera()).expect("a picture");
        let yellow = bytes_of(style.lettering[0].color);
        let pixels = frame.rgba.as_chunks::<4>().0.iter().enumerate();
        let words = pixels.filter(|(_, pixel)| **pixel == yellow);
        let right = words.clone().filter(|(i, _)| i % 160 >= 80).count();
        [words.count() - right, right]
    }

    #[test]
    fn what_stands_before_the_anchor_hides_words_that_ask_for_it() {
        let [left, right] = shown(&Processor, false, 1.0);
        assert!(left > 300 && right > 300, "{left} {right}");
        assert_eq!(
            shown(&Processor, true, 1.0),
            [left, 0],
            "a board before half of them"
        );
        assert_eq!(
            shown(&Processor, true, -1.0),
            [left, right],
            "a board behind them"
        );
        assert_eq!(
            shown(&Processor, true, 0.0),
            [left, right],
            "what they are fixed to"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        #[test]
        fn a_layer_that_is_not_seen_changes_nothing_and_a_whole_one_is_painted(
            under in prop::array::uniform4(any::<u8>()), over in prop::array::uniform4(any::<u8>()),
        ) {
            let laid = |over, share| {
                let mut pixel = under;
                lay_over(&mut pixel, over, share);
                pixel
            };
            prop_assert_eq!(laid(over, 0.0), under);
            let opaque = [over[0], over[1], over[2], 255];
            prop_assert_eq!(laid(opaque, 1.0), opaque);
        }

        #[test]
        fn no_place_panics(
            anchor in prop::array::uniform3(prop_oneof![-10_f32..10.0, Just(1e9_f32), Just(-1e9_f32)]),
            eye in prop::array::uniform3(-10_f32..10.0), parallel: bool,
        ) {
            let projection = match parallel {
                true => Projection::Parallel { height: 3.0 },
                false => Projection::Perspective { fov_y: 1.0 },
            };
            let view = Camera { eye, projection, ..camera() }.view([64, 48], BOUNDS);
            for words in lettering(anchored(anchor)).placed(&view, 96.0) {
                let mut rgba = vec![0; 64 * 48 * 4];
                paint_over(&words.marks, &mut rgba, [64, 48]);
            }
        }
    }
}
