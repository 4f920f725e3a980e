//! Speed lines behind parts that move, over a finished frame.

use crate::error::RenderError;
use crate::frame::Frame;
use crate::frame_graph::pixel_count;
use crate::look::part;
use crate::model::Model;
use crate::options::RendererOptions;
use crate::part_info::PartInfo;
use crate::surfaces::Surfaces;
use glam::{Mat4, Vec2, Vec3};
use npr_core::budget::Budget;
use npr_core::camera::bounds_of;
use npr_core::color::SrgbEncoder;
use npr_core::geometry::Part;
use npr_core::raster::triangle_of;
use npr_core::texture::{TextureStore, linear_texel};
use npr_core::window::View;
use npr_stylesheet::blend::blend;
use npr_stylesheet::motion::Motion;
use npr_stylesheet::{Color, Style};

/// Longest trail in pixels, more than the diagonal of any frame: longer ones are not drawn, and those that run past the
/// eye are cut.
const LONGEST_PX: f32 = 65_536.0;

/// Bytes per pixel for triangle numbers and depths, movers, and what they left behind.
const BYTES_PER_PIXEL: usize = 44;

/// Shortest trail that is drawn, in pixels.
const SHORTEST_PX: f32 = 1.0;

/// How much nearer to the eye than a trail a surface has to be to cover it, as a share of the reversed depth: the
/// surface that a thing slides along does not cover its trail.
const COVER_ROOM: f32 = 0.01;

/// Narrowest spacing of lines, in pixels: closer ones would show as grey.
const SPACING_PX_MIN: f32 = 1.5;

/// The speed lines of a style.
pub(crate) struct SpeedLines {
    /// The parts as the style draws them, which tells the sides that are seen.
    parts: Vec<Part>,
    /// Which mover each part belongs to.
    mover_of_part: Vec<Option<usize>>,
    motion: Motion,
    movers: Vec<Mover>,
    size: [u32; 2],
    dpi: f32,
}

/// Parts that share a trail.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mover {
    trail: Vec3,
    /// Middle of their box, in the world.
    middle: Vec3,
}

/// A trail on the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sweep {
    /// Unit vector away from the part, in pixels.
    along: Vec2,
    length_px: f32,
    /// Change of reversed depth over a pixel along it.
    deepens: f32,
    /// The place that lines are counted from.
    middle_px: Vec2,
    spacing_px: f32,
}

impl SpeedLines {
    /// The speed lines that a style asks for; none where nothing moves.
    pub fn needs(
        model: &Model,
        style: &Style,
        options: &RendererOptions,
        budget: &mut Budget,
    ) -> Result<Option<Self>, RenderError> {
        let trails = style.trails();
        if trails.is_empty() {
            return Ok(None);
        }

        // Reserve memory for the pictures that trails are found on.
        let pixels = pixel_count(options.size);
        budget.take("speed lines", pixels, BYTES_PER_PIXEL)?;

        // Join the parts of one trail into a mover.
        let trail_of = |info: &PartInfo| {
            let trail = info.look(style).trail;
            trails.iter().position(|other| trail == Some(*other))
        };
        let mover_of_part: Vec<Option<usize>> = model.parts.iter().map(trail_of).collect();
        let movers = (0..).zip(&trails);
        let movers = movers.map(|(index, trail)| Mover::new(model, &mover_of_part, index, *trail));
        Ok(Some(Self {
            movers: movers.collect(),
            parts: model.parts.iter().map(|info| part(info, style)).collect(),
            mover_of_part,
            motion: style.motion.clone(),
            size: options.size,
            dpi: options.dpi,
        }))
    }

    /// Lets the lines go out from where the parts are in another pose. O(triangles x trails).
    pub fn follow(&mut self, model: &Model) {
        for (index, mover) in self.movers.iter_mut().enumerate() {
            *mover = Mover::new(model, &self.mover_of_part, index, mover.trail.to_array());
        }
    }

    /// Draws the speed lines over a frame, behind what stands before their part. O(triangles + pixels * trails).
    pub fn finish(&self, model: &Model, view: &View, frame: &mut Frame) {
        // See which mover every pixel shows, and how deep.
        let Surfaces { ids, depths } = Surfaces::new(model, &self.parts, view, self.size);
        let mover_of = |id: &u32| {
            let triangle = model.triangles.get(triangle_of(*id) as usize)?;
            self.mover_of_part[triangle.part as usize]
        };
        let movers: Vec<Option<usize>> = ids.iter().map(mover_of).collect();

        // Draw the trail of each over what lies behind it.
        let pen = Pen::new(self.motion.color);
        for (index, mover) in self.movers.iter().enumerate() {
            let Some(sweep) = self.sweep_of(mover, view) else {
                continue;
            };
            let behind = behind(&movers, index, frame.size, sweep.along);
            for (i, Behind { distance, edge }) in behind.into_iter().enumerate() {
                // Nothing is drawn over what moves itself.
                let is_free = distance > 0.0 && distance < sweep.length_px && movers[i].is_none();
                let trail = || depths[edge as usize] + sweep.deepens * distance;
                if is_free && depths[i] <= trail() * (1.0 + COVER_ROOM) {
                    let place = glam::vec2(
                        (i as u32 % frame.size[0]) as f32,
                        (i as u32 / frame.size[0]) as f32,
                    );
                    let across = (place - sweep.middle_px).perp_dot(sweep.along) / sweep.spacing_px;
                    let along = distance / sweep.length_px;
                    let share = self.motion.coverage(across, along, sweep.spacing_px);
                    pen.lay_over(&mut frame.rgba[4 * i..4 * i + 4], share);
                }
            }
        }
    }

    /// Where a trail lies in a view; none where all of it is behind the eye or too short to see.
    fn sweep_of(&self, mover: &Mover, view: &View) -> Option<Sweep> {
        let whole = [mover.middle, mover.middle + mover.trail];
        let [from, to] = before_eye(whole, view)?;
        let (start, start_depth) = place_px(from, view)?;
        let (end, end_depth) = place_px(to, view)?;
        let length_px = (end - start).length();
        // What runs past the eye may be of any length on the picture.
        let longest = if [from, to] == whole {
            LONGEST_PX
        } else {
            f32::MAX
        };
        if !(SHORTEST_PX..=longest).contains(&length_px) {
            return None;
        }
        let forward = Vec3::from(view.forward_world);
        let depth = (from - Vec3::from(view.eye_world)).dot(forward);
        let world_px = view.pixels_per_unit(depth);
        let spacing = self.motion.spacing;
        Some(Sweep {
            along: (end - start) / length_px,
            length_px: length_px.min(LONGEST_PX),
            deepens: (end_depth - start_depth) / length_px,
            middle_px: start,
            spacing_px: spacing
                .to_px(self.size[1] as f32, self.dpi, world_px)
                .max(SPACING_PX_MIN),
        })
    }
}

impl Mover {
    fn new(model: &Model, mover_of_part: &[Option<usize>], index: usize, trail: [f32; 3]) -> Self {
        let moves = |part: u32| mover_of_part[part as usize] == Some(index);
        let corners = model
            .triangles
            .iter()
            .filter(|triangle| moves(triangle.part));
        let points = corners.flat_map(|triangle| triangle.corners).map(|v| {
            let v = v as usize;
            model.posed_point(&model.vertices[v], &model.influences[v])
        });
        let (low, high) = bounds_of(points);
        Self {
            trail: Vec3::from(trail),
            middle: (Vec3::from(low) + Vec3::from(high)) * 0.5,
        }
    }
}

/// Least depth of a trail's ends, as a share of the farther end's: a trail that runs past the eye is cut there, far
/// outside any frame unless it runs into the eye itself.
const NEAREST_SHARE: f32 = 1e-3;

/// The ends of the part of a segment that lies before the eye; none where all of it lies behind. In a parallel view
/// nothing lies behind the eye.
fn before_eye(ends: [Vec3; 2], view: &View) -> Option<[Vec3; 2]> {
    if view.perspective < 0.5 {
        return Some(ends);
    }
    let (eye, forward) = (Vec3::from(view.eye_world), Vec3::from(view.forward_world));
    let ahead = ends.map(|end| (end - eye).dot(forward));
    let least = NEAREST_SHARE * ahead[0].max(ahead[1]);
    let cut = |kept: usize, lost: usize| {
        let share = (ahead[kept] - least) / (ahead[kept] - ahead[lost]);
        ends[kept] + (ends[lost] - ends[kept]) * share
    };
    match ahead.map(|ahead| ahead > 0.0 && ahead >= least) {
        [true, true] => Some(ends),
        [true, false] => Some([ends[0], cut(0, 1)]),
        [false, true] => Some([cut(1, 0), ends[1]]),
        [false, false] => None,
    }
}

/// Where a place in the world lies in the frame, in pixels, and its reversed depth; none behind the eye.
fn place_px(place: Vec3, view: &View) -> Option<(Vec2, f32)> {
    let clip = Mat4::from_cols_array_2d(&view.clip_from_world) * place.extend(1.0);
    let ndc = glam::vec2(clip.x, -clip.y) / clip.w;
    let px = (ndc + 1.0) * 0.5 * Vec2::from(view.frame_px);
    (clip.w > 0.0 && px.is_finite()).then_some((px, clip.z / clip.w))
}

/// What a mover left behind at a pixel.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Behind {
    /// How far it lies behind, in pixels; 0 on the mover, and where it never was.
    distance: f32,
    /// The pixel of the mover's trailing edge that went through it.
    edge: u32,
}

/// What the mover `index` left behind at every pixel; `along` is the unit vector along its trail.
///
/// The picture is cut into slanted rows of pixels, each walked once: O(pixels).
fn behind(movers: &[Option<usize>], index: usize, size: [u32; 2], along: Vec2) -> Vec<Behind> {
    let mut found = vec![Behind::default(); movers.len()];
    let [width, height] = size.map(i64::from);
    let steep = along.y.abs() > along.x.abs();
    // Walk along the axis that changes most, in its direction.
    let (major, minor) = if steep {
        (along.y, along.x)
    } else {
        (along.x, along.y)
    };
    let (length, rows) = if steep {
        (height, width)
    } else {
        (width, height)
    };
    let slope = minor / major.abs();
    let step_px = (1.0 + slope * slope).sqrt();
    let shift = |step: i64| (slope * step as f32).round() as i64;
    let most = shift(length - 1);
    for row in -most.max(0)..rows - most.min(0) {
        let mut behind: Option<Behind> = None;
        for step in 0..length {
            let (at, other) = (
                if major < 0.0 { length - 1 - step } else { step },
                row + shift(step),
            );
            if !(0..rows).contains(&other) {
                continue;
            }
            let [x, y] = if steep { [other, at] } else { [at, other] };
            let i = (y * width + x) as usize;
            behind = match (movers[i] == Some(index), behind) {
                (true, _) => Some(Behind {
                    distance: 0.0,
                    edge: i as u32,
                }),
                (false, Some(behind)) => Some(Behind {
                    distance: behind.distance + step_px,
                    ..behind
                }),
                (false, None) => None,
            };
            found[i] = behind.unwrap_or_default();
        }
    }
    found
}

/// Lays a colour over pixels.
struct Pen {
    /// Linear light and alpha.
    color: [f32; 4],
    /// Holds the table of linear light.
    store: TextureStore,
    encoder: SrgbEncoder,
}

impl Pen {
    fn new(color: Color) -> Self {
        Self {
            color: color.linear(),
            store: TextureStore::new(),
            encoder: SrgbEncoder::new(),
        }
    }

    fn lay_over(&self, pixel: &mut [u8], share: f32) {
        let bytes: [u8; 4] = std::array::from_fn(|i| pixel[i]);
        let share = share * self.color[3];
        if share > 0.0 {
            let [r, g, b, a] = linear_texel(self.store.words(), u32::from_le_bytes(bytes));
            let [red, green, blue, _] = self.color;
            let [r, g, b, a] = blend([red, green, blue, 1.0], [r * a, g * a, b * a, a], share);
            let [r, g, b] = [r, g, b].map(|v| self.encoder.byte(v / a.max(1e-6)) as u8);
            pixel.copy_from_slice(&[r, g, b, (a * 255.0 + 0.5) as u8]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn distances_run_from_the_trailing_edge() {
        let mut movers = vec![None; 8 * 3];
        movers[8 + 2] = Some(0);
        movers[8 + 3] = Some(0);
        let distances = |index: usize, along: Vec2| -> Vec<f32> {
            let found = behind(&movers, index, [8, 3], along);
            found.iter().map(|behind| behind.distance).collect()
        };
        let row = |along: Vec2| distances(0, along)[8..16].to_vec();
        assert_eq!(row(Vec2::X), [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(row(-Vec2::X), [2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(distances(1, Vec2::X), [0.0; 24]);
        let column = distances(0, Vec2::Y);
        assert_eq!(
            [column[2], column[10], column[18], column[19]],
            [0.0, 0.0, 1.0, 1.0]
        );
    }

    fn eye_at_origin(perspective: f32) -> View {
        View {
            perspective,
            forward_world: [0.0, 0.0, -1.0],
            ..View::default()
        }
    }

    #[test]
    fn what_runs_past_the_eye_is_cut_before_it() {
        let view = eye_at_origin(1.0);
        let [ahead, behind] = [glam::vec3(1.0, 0.0, -2.5), glam::vec3(3.0, 4.0, 1.5)];
        // The cut lies at a thousandth of 2.5 before the eye: 2.4975 of the 4 units that depth changes along the way.
        let [start, cut] = before_eye([ahead, behind], &view).unwrap();
        assert_eq!(start, ahead);
        let wanted = ahead.lerp(behind, 2.4975 / 4.0);
        assert!(cut.distance(wanted) < 1e-5, "{cut}");
        assert_eq!(before_eye([behind, ahead], &view), Some([cut, ahead]));
        assert_eq!(before_eye([behind; 2], &view), None);
        assert_eq!(before_eye([ahead; 2], &view), Some([ahead; 2]));
        assert_eq!(
            before_eye([behind; 2], &eye_at_origin(0.0)),
            Some([behind; 2]),
            "parallel"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]
        /// What is left lies on the segment, before the eye, and nothing of that is lost.
        #[test]
        fn the_part_before_the_eye_is_all_of_it(
            ends in prop::array::uniform2(prop::array::uniform3(-4f32..4.0)), share in 0f32..1.0,
        ) {
            let (view, ends) = (eye_at_origin(1.0), ends.map(Vec3::from));
            let kept = before_eye(ends, &view);
            let place = ends[0].lerp(ends[1], share);
            let least = NEAREST_SHARE * (-ends[0].z).max(-ends[1].z);
            let is_before = -place.z > least.max(0.0) + 1e-4;
            if let Some(kept) = kept {
                prop_assert!(kept.iter().all(|end| -end.z >= least - 1e-5), "{kept:?}");
                let parts = (place - kept[0]).length() + (kept[1] - place).length();
                let is_inside = parts < (kept[1] - kept[0]).length() + 1e-3;
                prop_assert!(is_inside || !is_before, "{place} is left out of {kept:?}");
            }
            prop_assert!(kept.is_some() || !is_before);
        }

        /// A pixel lies behind a mover where a straight walk back meets it, give or take the pixels beside the walk.
        #[test]
        fn distances_are_those_of_a_walk_back(
            size in prop::array::uniform2(1u32..20), cells in prop::collection::vec(any::<u8>(), 400),
            angle in 0f32..6.3,
        ) {
            let along = glam::vec2(npr_core::math::cos(angle), npr_core::math::sin(angle));
            let count = (size[0] * size[1]) as usize;
            let movers: Vec<Option<usize>> = cells[..count].iter().map(|cell| (cell % 12 == 0).then_some(0)).collect();
            let found = behind(&movers, 0, size, along);
            let is_mover = |x: i64, y: i64| {
                let inside = (0..i64::from(size[0])).contains(&x) && (0..i64::from(size[1])).contains(&y);
                inside && movers[(y * i64::from(size[0]) + x) as usize].is_some()
            };
            for (i, Behind { distance, edge }) in found.iter().enumerate().filter(|(_, behind)| behind.distance > 0.0) {
                prop_assert_eq!(movers[*edge as usize], Some(0));
                let place = glam::vec2((i as u32 % size[0]) as f32, (i as u32 / size[0]) as f32);
                let back = place - along * *distance;
                let [x, y] = [back.x.round() as i64, back.y.round() as i64];
                let near = (-1..=1).any(|u| (-1..=1).any(|v| is_mover(x + u, y + v)));
                prop_assert!(near && movers[i].is_none(), "{i}: {distance}");
            }
        }
    }
}
