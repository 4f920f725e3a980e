//! Curves that mind the background: every point of a stroke looks at both of its sides.
//!
//! Frames find the rims of subjects among pixels. A stroke knows where it runs, so its points ask the surface and a
//! picture without lines a little beside them: what is of the line's own subject is its rim, what is not lies behind
//! it.

use crate::features::background_contrast::BackgroundContrast;
use crate::features::line_features::LineFeatures;
use crate::frame::Frame;
use crate::part_info::PartInfo;
use npr_core::color::{largest_difference, linear_from_srgb, srgb_from_linear};
use npr_core::math;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_style::backdrop::{PartSubject, Rule, Rules, UNLIKE_COLORS, adapt};
use npr_stylesheet::Style;
use npr_vector::mesh_lines::bvh::FaceTree;
use npr_vector::project::Projector;
use npr_vector::stroke::{Stroke, StrokePoint};
use rayon::prelude::*;

/// Distances at which a point looks beside itself, in pixels: beyond edges that are blended, and beyond what
/// smoothing moves.
const LOOKS_PX: [f64; 5] = [1.5, 2.5, 3.5, 4.5, 5.5];

/// How many of [`LOOKS_PX`] find where a subject ends; the others only add to means.
const FINDING: usize = 3;

/// How many looks in a row a mean is taken of.
const MEAN_OF: usize = 3;

/// The scene that the colours of strokes follow.
pub(super) struct StrokeContrast<'a> {
    shape: &'a HalfEdgeMesh,
    tree: &'a FaceTree,
    projector: &'a Projector,
    /// The scene without lines, before its background.
    picture: &'a Frame,
    part_subjects: Vec<PartSubject>,
    rules: Rules,
}

/// What a point of a stroke sees, sRGB-encoded.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sides {
    rim: [f32; 3],
    behind: [f32; 3],
    /// How opaque what lies behind is, 0..1: the colour of the line follows it by as much.
    weight: f32,
}

/// What lies at a place of the picture.
#[derive(Debug, Clone, Copy)]
struct Ground {
    /// The number of the subject, 0 for the background.
    subject: u32,
    /// Its colour there, sRGB-encoded, straight alpha.
    color: [f32; 4],
}

impl<'a> StrokeContrast<'a> {
    /// For strokes of parts in a style; none where no part follows a rule.
    pub fn new(
        (shape, tree): (&'a HalfEdgeMesh, &'a FaceTree),
        projector: &'a Projector,
        picture: &'a Frame,
        infos: &[PartInfo],
        style: &Style,
        px: [f32; 3],
    ) -> Option<Self> {
        let backdrop = BackgroundContrast::needs(infos, style, infos.len());
        let rules = backdrop.rules(style, LineFeatures::NONE, 0.0, px, 1);
        let stroke_contrast = Self {
            shape,
            tree,
            projector,
            picture,
            part_subjects: backdrop.part_subjects,
            rules,
        };
        backdrop.is_on.then_some(stroke_contrast)
    }

    /// Gives visible strokes the colours that mind what lies behind them.
    ///
    /// `own_color` is the colour of a surface's lines. Strokes that keep it all along stay without colours of their
    /// own. O(points), each a few sights through the shape; parallel.
    pub fn apply(&self, strokes: &mut [Stroke], own_color: &(dyn Fn(u32) -> [u8; 4] + Sync)) {
        strokes.par_iter_mut().for_each(|stroke| {
            let part_subject = self.part_subjects.get(stroke.surface as usize).copied();
            let rule = part_subject
                .and_then(|part_subject| self.rules.rules.get(part_subject.rule as usize));
            if let (Some(part_subject), Some(rule)) = (part_subject, rule)
                && rule.method != Rule::OFF
                && stroke.is_visible()
            {
                self.mind(stroke, part_subject, rule, own_color(stroke.surface));
            }
        });
    }

    fn mind(&self, stroke: &mut Stroke, part_subject: PartSubject, rule: &Rule, own: [u8; 4]) {
        let count = stroke.points.len();
        let mut seen: Vec<Option<Sides>> = (0..count)
            .map(|index| {
                let point = &stroke.points[index];
                self.sides(tangent(stroke, index), point, (part_subject.subject, rule))
            })
            .collect();
        // The published method judges every place by itself.
        if rule.method != Rule::BY_LIKENESS {
            seen = smoothed(stroke, &seen, f64::from(self.rules.smooth_px));
        }
        let colors: Vec<[u8; 4]> = stroke
            .points
            .iter()
            .zip(&seen)
            .map(|(point, sides)| contrasted(point.color.unwrap_or(own), sides.as_ref(), rule))
            .collect();
        let is_own =
            |(point, color): (&StrokePoint, &[u8; 4])| point.color.unwrap_or(own) == *color;
        if stroke.points.iter().zip(&colors).all(is_own) {
            return;
        }
        for (point, color) in stroke.points.iter_mut().zip(colors) {
            point.color = Some(color);
        }
    }

    /// What a point sees on its two sides; `None` where its subject ends on neither, unless the rule is for lines
    /// within.
    fn sides(
        &self,
        tangent: Option<[f64; 2]>,
        point: &StrokePoint,
        (own, rule): (u32, &Rule),
    ) -> Option<Sides> {
        let [x, y] = tangent?;
        let beside = [[-y, x], [y, -x]].map(|out| self.beside(point.position, out));
        let is_own = |ground: &Ground| ground.subject == own;
        let is_other = |ground: &Ground| ground.subject != own;
        let ends = [0, 1].map(|side| beside[side].first(is_other));
        let rims = [0, 1].map(|side| beside[side].first(is_own));
        // Where both sides leave the subject, its rim is where it is found sooner.
        let outer = match ends {
            [None, None] if rule.within == 0 => return None,
            [None, None] => return within(&beside, own),
            [Some(_), None] => 0,
            [None, Some(_)] => 1,
            [Some(_), Some(_)] => {
                let [here, there] = rims.map(|rim| rim.unwrap_or(usize::MAX));
                usize::from(here < there)
            }
        };
        let behind = beside[outer].mean(ends[outer]?, is_other)?;
        let rim = beside[1 - outer].mean(rims[1 - outer]?, is_own)?;
        Some(Sides {
            rim: [rim[0], rim[1], rim[2]],
            behind: [behind[0], behind[1], behind[2]],
            weight: behind[3],
        })
    }

    /// What lies on one side of a place, along a unit vector away from it.
    fn beside(&self, at: [f64; 2], out: [f64; 2]) -> Beside {
        Beside(LOOKS_PX.map(|distance| self.ground_at([0, 1].map(|i| at[i] + out[i] * distance))))
    }

    /// What lies at a place; nothing outside of the picture.
    fn ground_at(&self, place: [f64; 2]) -> Option<Ground> {
        let [width, height] = self.picture.size;
        let [x, y] = place.map(f64::floor);
        if !(x >= 0.0 && y >= 0.0 && x < f64::from(width) && y < f64::from(height)) {
            return None;
        }
        let texel = 4 * (y as usize * width as usize + x as usize);
        let bytes = self.picture.rgba.get(texel..texel + 4)?;
        let face = self.tree.face_at(self.shape, self.projector, place);
        let surface = face.map(|(face, _)| self.shape.face_surfaces[face as usize]);
        let part_subject = surface.and_then(|surface| self.part_subjects.get(surface as usize));
        Some(Ground {
            subject: part_subject.map_or(0, |part_subject| part_subject.subject),
            color: std::array::from_fn(|i| f32::from(bytes[i]) / 255.0),
        })
    }
}

/// What a line within its subject sees: the mean of both sides.
fn within(beside: &[Beside; 2], own: u32) -> Option<Sides> {
    let [a, b] = [0, 1].map(|side| beside[side].mean(0, |ground| ground.subject == own));
    let (a, b) = (a?, b?);
    let ground = std::array::from_fn(|i| 0.5 * (a[i] + b[i]));
    Some(Sides {
        rim: ground,
        behind: ground,
        weight: 1.0,
    })
}

/// What lies on one side of a point, at each distance of [`LOOKS_PX`].
struct Beside([Option<Ground>; LOOKS_PX.len()]);

impl Beside {
    /// The first look whose ground `is_it` accepts.
    fn first(&self, is_it: impl Fn(&Ground) -> bool) -> Option<usize> {
        let mut looks = self.0.iter().take(FINDING);
        looks.position(|ground| ground.as_ref().is_some_and(&is_it))
    }

    /// The mean colour of accepted grounds among [`MEAN_OF`] looks from one on; its alpha is their mean alpha.
    fn mean(&self, from: usize, is_it: impl Fn(&Ground) -> bool) -> Option<[f32; 4]> {
        let looks = self.0.iter().skip(from).take(MEAN_OF).flatten();
        let (mut sum, mut count) = ([0.0; 4], 0.0);
        for ground in looks.filter(|ground| is_it(ground)) {
            let [r, g, b, a] = ground.color;
            sum = [sum[0] + r * a, sum[1] + g * a, sum[2] + b * a, sum[3] + a];
            count += 1.0;
        }
        let [r, g, b, a] = sum;
        (a > 0.0).then(|| [r / a, g / a, b / a, a / count])
    }
}

/// Unit vector along a stroke at a point; none where it stands still.
fn tangent(stroke: &Stroke, index: usize) -> Option<[f64; 2]> {
    let count = stroke.points.len();
    let [before, after] = if stroke.closed {
        [(index + count - 1) % count, (index + 1) % count]
    } else {
        [index.saturating_sub(1), (index + 1).min(count - 1)]
    };
    let [from, to] = [before, after].map(|i| stroke.points[i].position);
    let along = [0, 1].map(|i| to[i] - from[i]);
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    (length > 0.0).then(|| along.map(|v| v / length))
}

/// What points see, blended along the stroke by a Gaussian that ends at `reach_px`; points that see nothing lower the
/// weight.
///
/// As in frames: what is unlike is not blended, for the mean of a dark and a light wall is a wall that is not there
/// [Tomasi and Manduchi 1998]. O(points * points within reach).
fn smoothed(stroke: &Stroke, seen: &[Option<Sides>], reach_px: f64) -> Vec<Option<Sides>> {
    if reach_px <= 0.0 {
        return seen.to_vec();
    }
    let steps = steps(stroke);
    let count = seen.len();

    // Blend what a point sees with what others within reach see, by distance.
    let blended = |index: usize| {
        let mut blend = Blend::around(nearest(seen, &steps, index, reach_px)?);
        blend.add(seen[index], 1.0);
        for forward in [true, false] {
            for (other, gone) in
                walk(&steps, index, forward).take_while(|(_, gone)| *gone <= reach_px)
            {
                let share = gone / reach_px;
                blend.add(seen[other], math::exp((-2.0 * share * share) as f32));
            }
        }
        blend.mean()
    };
    (0..count).map(blended).collect()
}

/// What a point sees itself, or else the nearest that sees anything.
fn nearest(seen: &[Option<Sides>], steps: &[f64], index: usize, reach_px: f64) -> Option<Sides> {
    let found = [true, false].map(|forward| {
        walk(steps, index, forward)
            .take_while(|(_, gone)| *gone <= reach_px)
            .find(|(other, _)| seen[*other].is_some())
    });
    let beside = found
        .into_iter()
        .flatten()
        .min_by(|a, b| a.1.total_cmp(&b.1));
    seen[index].or_else(|| seen[beside?.0])
}

/// Length of the piece after every point of a stroke, in pixels; infinite where it ends.
fn steps(stroke: &Stroke) -> Vec<f64> {
    let count = stroke.points.len();
    let step = |index: usize| {
        if !stroke.closed && index + 1 == count {
            return f64::INFINITY;
        }
        let [from, to] = [index, (index + 1) % count].map(|i| stroke.points[i].position);
        ((to[0] - from[0]).powi(2) + (to[1] - from[1]).powi(2)).sqrt()
    };
    (0..count).map(step).collect()
}

/// The points after or before one with their distances along the stroke; on a closed one, as far as half around.
fn walk(steps: &[f64], index: usize, forward: bool) -> impl Iterator<Item = (usize, f64)> {
    let count = steps.len();
    let way = if forward { 1 } else { count - 1 };
    let mut gone = 0.0;
    // Every point once, even around a small ring.
    let most = if forward { count / 2 } else { (count - 1) / 2 };
    let is_open = steps[count - 1] == f64::INFINITY;
    let places = (1..=if is_open { count } else { most })
        .map(move |i| (index + way * (i - 1), index + way * i));
    places.map(move |(from, to)| {
        let (from, to) = (from % count, to % count);
        gone += steps[if forward { from } else { to }];
        (to, gone)
    })
}

/// A mean of what points see, weighted by how much it is like what one of them sees.
struct Blend {
    like: Sides,
    rim: [f32; 3],
    behind: [f32; 3],
    counted: f32,
    total: f32,
}

impl Blend {
    fn around(like: Sides) -> Self {
        Self {
            like,
            rim: [0.0; 3],
            behind: [0.0; 3],
            counted: 0.0,
            total: 0.0,
        }
    }

    /// Adds what a point sees, weighted by `near`; a point that sees nothing only lowers the weight of the mean.
    fn add(&mut self, seen: Option<Sides>, near: f32) {
        let Some(sides) = seen else {
            self.total += near;
            return;
        };
        let near = near * likeness(&self.like, &sides);
        let weight = near * sides.weight;
        for i in 0..3 {
            self.rim[i] += sides.rim[i] * weight;
            self.behind[i] += sides.behind[i] * weight;
        }
        self.counted += weight;
        self.total += near;
    }

    fn mean(&self) -> Option<Sides> {
        (self.counted > 0.0).then(|| Sides {
            rim: self.rim.map(|channel| channel / self.counted),
            behind: self.behind.map(|channel| channel / self.counted),
            weight: self.counted / self.total,
        })
    }
}

/// 1 for the same colours on both sides, down to 0 where any channel differs by [`UNLIKE_COLORS`]. Frames ask the
/// side behind alone, since stretches of outline settle the other.
fn likeness(a: &Sides, b: &Sides) -> f32 {
    let most = largest_difference(a.rim, b.rim).max(largest_difference(a.behind, b.behind));
    let left = (1.0 - most / UNLIKE_COLORS).max(0.0);
    left * left
}

/// The colour of a line, sRGB bytes and alpha, by a rule and what it sees: the one place where strokes follow a rule.
fn contrasted(own: [u8; 4], sides: Option<&Sides>, rule: &Rule) -> [u8; 4] {
    let Some(sides) = sides else {
        return own;
    };
    let line = [own[0], own[1], own[2]].map(|byte| f32::from(byte) / 255.0);
    let adapted = adapt(line, sides.rim, sides.behind, rule);
    // Straight in light, as frames blend it.
    let mixed = |i: usize| {
        let [from, to] = [line[i], adapted[i]].map(linear_from_srgb);
        srgb_from_linear(from + (to - from) * sides.weight)
    };
    let [r, g, b] = [0, 1, 2].map(|i| (mixed(i).clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
    [r, g, b, own[3]]
}
