//! Speed lines behind what really moves.
//!
//! Lines begin where moving surfaces end in the picture, on the side that they come from, and run along the way of that
//! point of the surface through the moments before. They lie behind all that moves, and behind what stands before them.

use super::seen::Seen;
use super::sort::MotionStrokes;
use crate::movement::Movement;
use glam::{Vec2, Vec3};
use npr_core::random::{hash, unit};
use npr_core::surface::weights_at;
use npr_stylesheet::Style;
use npr_vector::stroke::{StrokePoint, length_of};
use std::collections::{BTreeMap, BTreeSet};

/// Name of the object whose strokes speed lines are.
const OBJECT: &str = "speed lines";

/// Longest line, as a share of the picture's height.
const LONGEST_SHARE: f32 = 0.8;

/// Longest way between two moments, as a share of the picture's height: what goes farther is a cut.
const LEAP_SHARE: f32 = 0.5;

/// Share of a line's way that may lie on what moves before the line begins.
const LATEST_START: f32 = 0.3;

/// Shortest line, as a share of the least way that is followed.
const SHORTEST_SHARE: f32 = 0.7;

/// Spacings along the motion within which two lines keep their distance from each other.
const LANE_SPACINGS: f32 = 12.0;

/// Share of the way along which a line swells to its full width.
const SWELL_SHARE: f32 = 0.06;

/// Side of a group of lines that are long or short together, or left out, in cells of a line.
const GROUP_CELLS: f32 = 3.0;

/// Places that the curve of a way goes through besides its beginning.
const KNOTS: usize = 8;

/// Points of the curve between two of them.
const SUBSTEPS: usize = 4;

/// The speed lines in a picture of `size` pixels, one sort for each object that has any, in their order. Nothing comes
/// of a way that cannot be seen.
pub(super) fn find(
    seen: &Seen<'_>,
    movement: &Movement,
    style: &Style,
    (size, dpi): ([u32; 2], f32),
) -> Vec<MotionStrokes> {
    // Find out what leaves trails.
    let looks = movement.parts().iter().map(|info| info.look(style).follow);
    let height_px = size[1] as f32;
    let spacing_px = style.motion.spacing.to_px(height_px, dpi, seen.world_px);
    let finder = Finder {
        seen,
        movement,
        style,
        height_px,
        // Closer ones than two cells of the grid would be the same.
        spacing_px: spacing_px.max(2.0 * seen.step_px()),
        least_px: style.motion.least.to_px(height_px, dpi, seen.world_px),
        scales: movement.scales(),
        reaches: looks.map(|follow| follow * style.motion.shutter).collect(),
    };
    if finder.reaches.iter().all(|reach_s| *reach_s <= 0.0) {
        return Vec::new();
    }

    // Choose where lines begin, and draw them.
    let mut sorts: BTreeMap<u32, MotionStrokes> = BTreeMap::new();
    for start in finder.starts() {
        let runs = finder.drawn(&start);
        if runs.is_empty() {
            continue;
        }
        let sort = sorts.entry(start.object).or_insert_with(|| {
            let parts = movement.parts().iter();
            let mut names = parts.filter(|info| info.object == start.object);
            let name = names.next().map(|info| info.object_name.clone());
            MotionStrokes {
                names: [OBJECT.to_owned(), name.unwrap_or_default()],
                strokes: Vec::new(),
            }
        });
        let ordinals = (0..256).zip(runs);
        let numbered = ordinals.map(|(ordinal, run)| (u64::from(start.key) << 8 | ordinal, run));
        sort.strokes.extend(numbered);
    }
    sorts.into_values().collect()
}

/// Where a line begins.
#[derive(Debug, Clone, Copy)]
struct Start {
    triangle: u32,
    weights: [f32; 3],
    object: u32,
    /// How far back it follows, in seconds.
    reach_s: f32,
    /// What stays with the place on the surface, and looks random.
    key: u32,
    /// The same of the places around it.
    group: u32,
    place: Vec2,
    /// Unit vector to where it came from.
    back: Vec2,
}

/// A point on the way of a point of a surface.
#[derive(Debug, Clone, Copy)]
struct WayPoint {
    place: Vec2,
    reversed: f32,
    world: Vec3,
    /// Way from the surface, in pixels.
    along_px: f32,
}

struct Finder<'a> {
    seen: &'a Seen<'a>,
    movement: &'a Movement,
    style: &'a Style,
    height_px: f32,
    spacing_px: f32,
    least_px: f32,
    /// How much longer things are in the world than in the mesh of each part.
    scales: Vec<f32>,
    /// How far back the lines of each part follow, in seconds.
    reaches: Vec<f32>,
}

impl Finder<'_> {
    /// Where lines begin: apart from each other across the motion.
    fn starts(&self) -> Vec<Start> {
        // Take those first that are first by chance: the same from picture to picture while they can be seen.
        let mut all = self.trailing_edge();
        all.sort_by_key(|(start, cell)| (start.key, *cell));

        // Leave room between them, more or less.
        let mut taken: BTreeMap<[i32; 2], Vec<Start>> = BTreeMap::new();
        let lane_px = LANE_SPACINGS * self.spacing_px;
        let mut chosen = Vec::new();
        let mut keys = BTreeSet::new();
        for (start, _) in all {
            let room = self.spacing_px * (0.6 + 0.9 * unit(hash(start.key, 1, 0)));
            let [x, y] = (start.place / lane_px).floor().to_array().map(|v| v as i32);
            let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| [x + dx, y + dy]));
            let near = around.filter_map(|cell| taken.get(&cell)).flatten();
            let is_close = |other: &Start| {
                let apart = start.place - other.place;
                apart.perp_dot(other.back).abs() < room && apart.length() < lane_px
            };
            let mut near = near;
            if !near.any(is_close) && keys.insert(start.key) {
                taken.entry([x, y]).or_default().push(start);
                chosen.push(start);
            }
        }
        chosen
    }

    /// All cells of the grid where something that moves ends on the side that it comes from.
    fn trailing_edge(&self) -> Vec<(Start, usize)> {
        let [width, height] = self.seen.size.map(|side| side as usize);
        let mut found = Vec::new();
        for y in 0..height {
            for x in 0..width {
                let cell = y * width + x;
                let mut beside = [
                    (x > 0).then(|| cell - 1),
                    (x + 1 < width).then(|| cell + 1),
                    (y > 0).then(|| cell - width),
                    (y + 1 < height).then(|| cell + width),
                ]
                .into_iter()
                .flatten();
                if self.seen.is_mover(cell) && beside.any(|other| !self.seen.is_mover(other)) {
                    found.extend(self.start_at(cell).map(|start| (start, cell)));
                }
            }
        }
        found
    }

    /// The start of a line in a cell, where what it shows moves and came from outside of all that moves.
    fn start_at(&self, cell: usize) -> Option<Start> {
        // Find the point of the surface, and where it was.
        let number = self.seen.triangle(cell)?;
        let triangle = self.movement.triangles()[number as usize];
        let reach_s = self.reaches[triangle.part as usize];
        if reach_s <= 0.0 {
            return None;
        }
        let place = self.seen.place_of(cell);
        let clip = triangle.corners.map(|v| self.seen.clip[v as usize]);
        let weights = weights_at(clip, self.seen.view.ndc_at(place.to_array()));
        if !weights.iter().all(|weight| weight.is_finite()) {
            return None;
        }
        let before = self.movement.place_before(number, weights, 0.25 * reach_s);
        let now = self.movement.place_before(number, weights, 0.0);
        let [(is, _), (was, _)] = [self.seen.place_px(now)?, self.seen.place_px(before)?];
        let back = (was - is).try_normalize()?;

        // See whether it left it behind.
        let beside = self.seen.cell(place + back * 1.6 * self.seen.step_px());
        if beside.is_none_or(|cell| self.seen.is_mover(cell)) {
            return None;
        }

        // Number the place on the surface in cells of about a spacing.
        let part = triangle.part as usize;
        let cell_world = self.spacing_px / self.seen.world_px / self.scales[part];
        let anchor = self.movement.anchor(number, weights) / power_of_two_below(cell_world);
        let object = self.movement.parts()[part].object;
        let key_of = |place: Vec3| {
            let [i, j, k] = place.floor().to_array().map(|v| v as i32 as u32);
            hash(hash(self.style.motion.seed, i, j), k, object)
        };
        Some(Start {
            triangle: number,
            weights,
            object,
            reach_s,
            key: key_of(anchor),
            group: key_of(anchor / GROUP_CELLS),
            place,
            back,
        })
    }

    /// The way of a point of a surface through the moments before, as a smooth curve; it ends where it turns back, at a
    /// cut, behind the eye, and at the longest length.
    fn way(&self, start: &Start) -> Vec<WayPoint> {
        // Gather where it was.
        let seconds = (0..=KNOTS).map(|i| start.reach_s * i as f32 / KNOTS as f32);
        let mut knots: Vec<(Vec2, f32, Vec3)> = Vec::new();
        for seconds in seconds {
            let world = self
                .movement
                .place_before(start.triangle, start.weights, seconds);
            let Some((place, reversed)) = self.seen.place_px(world) else {
                break;
            };
            if let Some((last, ..)) = knots.last() {
                let leg = place - *last;
                let is_cut = leg.length() > LEAP_SHARE * self.height_px;
                if is_cut || leg.dot(start.back) < 0.0 {
                    break;
                }
            }
            knots.push((place, reversed, world));
        }

        // Lay a smooth curve through the places.
        let mut way: Vec<WayPoint> = Vec::new();
        let at = |i: isize| knots[i.clamp(0, knots.len() as isize - 1) as usize];
        for i in 0..knots.len().saturating_sub(1) as isize {
            let [a, b, c, d] = [i - 1, i, i + 1, i + 2].map(at);
            for step in 0..SUBSTEPS {
                let t = step as f32 / SUBSTEPS as f32;
                add_way_point(&mut way, (curve([a.0, b.0, c.0, d.0], t), b, c), t);
            }
        }
        if let Some(last) = knots.last().filter(|_| knots.len() > 1) {
            add_way_point(&mut way, (last.0, *last, *last), 0.0);
        }
        let longest = LONGEST_SHARE * self.height_px;
        way.retain(|point| point.along_px <= longest);
        way
    }

    /// The runs of a line that are seen; none where what moves covers its beginning, or it is too short.
    fn drawn(&self, start: &Start) -> Vec<Vec<StrokePoint>> {
        // Choose its ends by chance.
        let way = self.way(start);
        let whole_px = way.last().map_or(0.0, |point| point.along_px);
        let chance = |i: u32| unit(hash(start.key, 2, i));
        if whole_px < self.least_px.max(4.0 * self.seen.step_px()) {
            return Vec::new();
        }
        let motion = &self.style.motion;
        let gap = 0.5 * self.spacing_px + 0.25 * whole_px * chance(0) * chance(0);
        let of_group = unit(hash(start.group, 3, 0));
        let torn = motion.variation * (0.6 * chance(1) + 0.4 * of_group);
        let end = whole_px * (1.0 - torn);
        let shortest_px = SHORTEST_SHARE * self.least_px;
        if end - gap < shortest_px || of_group > 1.0 - 0.3 * motion.variation {
            return Vec::new();
        }
        let widest = motion.weight * self.spacing_px * (0.3 + 0.7 * chance(2) * chance(2));

        // Walk along it, and keep what is seen.
        let step_px = 3.0 * self.seen.step_px();
        let steps = ((end - gap) / step_px).ceil().max(2.0) as usize;
        let mut runs: Vec<Vec<StrokePoint>> = Vec::new();
        let mut run: Vec<StrokePoint> = Vec::new();
        let mut begins = gap;
        for i in 0..=steps {
            let along_px = gap + (end - gap) * i as f32 / steps as f32;
            let point = way_at(&way, along_px);
            let Some(cell) = self.seen.cell(point.place) else {
                break;
            };
            let is_begun = !(runs.is_empty() && run.is_empty());
            if self.seen.is_mover(cell) {
                if is_begun || along_px > gap + LATEST_START * (end - gap) {
                    break;
                }
                begins = along_px + step_px;
                continue;
            }
            if self.seen.is_hidden(cell, point.reversed) {
                runs.push(std::mem::take(&mut run));
                continue;
            }
            let share = (along_px - begins) / (end - begins).max(1e-6);
            let swell = (0.4 + 0.6 * share / SWELL_SHARE).clamp(0.0, 1.0);
            run.push(StrokePoint {
                position: point.place.to_array().map(f64::from),
                depth: f64::from(self.seen.depth(point.world)),
                width: f64::from(widest * swell * (1.0 - share).max(0.0)),
                u: f64::from(along_px - begins),
                world: point.world.to_array(),
                ..StrokePoint::default()
            });
        }
        runs.push(run);
        runs.retain(|run| run.len() >= 3);

        // Leave out what is too short where what moves covers the rest.
        let seen_px: f64 = runs.iter().map(|run| length_of(run, false)).sum();
        if seen_px < f64::from(shortest_px) {
            runs.clear();
        }
        runs
    }
}

/// Adds a point between two places of a way, each with its reversed depth and place in the world.
fn add_way_point(
    way: &mut Vec<WayPoint>,
    (place, from, to): (Vec2, (Vec2, f32, Vec3), (Vec2, f32, Vec3)),
    share: f32,
) {
    let before = way.last();
    let along_px = before.map_or(0.0, |last| last.along_px + last.place.distance(place));
    way.push(WayPoint {
        place,
        reversed: from.1 + (to.1 - from.1) * share,
        world: from.2.lerp(to.2, share),
        along_px,
    });
}

/// A point between the middle two of four places, on the curve of Catmull and Rom through them.
fn curve([a, b, c, d]: [Vec2; 4], t: f32) -> Vec2 {
    let (t2, t3) = (t * t, t * t * t);
    0.5 * (2.0 * b
        + (c - a) * t
        + (2.0 * a - 5.0 * b + 4.0 * c - d) * t2
        + (3.0 * b - a - 3.0 * c + d) * t3)
}

/// The point of a way that lies so many pixels along it.
fn way_at(way: &[WayPoint], along_px: f32) -> WayPoint {
    let after = way.partition_point(|point| point.along_px < along_px);
    let after = after.clamp(1, way.len() - 1);
    let [a, b] = [way[after - 1], way[after]];
    let share = ((along_px - a.along_px) / (b.along_px - a.along_px).max(1e-6)).clamp(0.0, 1.0);
    WayPoint {
        place: a.place.lerp(b.place, share),
        reversed: a.reversed + (b.reversed - a.reversed) * share,
        world: a.world.lerp(b.world, share),
        along_px,
    }
}

/// The greatest power of two that is no more than a positive number.
fn power_of_two_below(length: f32) -> f32 {
    f32::from_bits(length.abs().max(f32::MIN_POSITIVE).to_bits() & 0x7f80_0000)
}
