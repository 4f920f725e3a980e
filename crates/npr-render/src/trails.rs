//! Speed lines behind what really moves, as strokes: the same for frames and for drawings of lines.
//!
//! Lines begin where moving surfaces end in the picture, on the side that they come from, and run along the way of that
//! point of the surface through the moments before. They lie behind all that moves, and behind what stands before them.

use crate::movement::Movement;
use glam::{Mat4, Vec2, Vec3};
use npr_core::camera::Camera;
use npr_core::geometry::Triangle;
use npr_core::random::{hash, unit};
use npr_core::raster::{Fill, Sides, fill_triangles, triangle_of};
use npr_core::surface::weights_at;
use npr_core::window::{View, Window};
use npr_stylesheet::Style;
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
use std::collections::{BTreeMap, BTreeSet};

/// Name of the object whose strokes speed lines are.
const OBJECT: &str = "speed lines";

/// Longer side of the grid on which lines are found: as many in pictures of any size.
const GRID_PX: u32 = 1280;

/// Longest line, as a share of the picture's height.
const LONGEST_SHARE: f32 = 0.8;

/// Longest way between two moments, as a share of the picture's height: what goes farther is a cut.
const LEAP_SHARE: f32 = 0.5;

/// How much nearer to the eye than a line a surface has to be to cover it, as a share of the reversed depth.
const COVER_ROOM: f32 = 0.01;

/// Share of a line's way that may lie on what moves before the line begins.
const LATEST_START: f32 = 0.3;

/// Spacings along the motion within which two lines keep their distance from each other.
const LANE_SPACINGS: f32 = 12.0;

/// Share of the way along which a line swells to its full width.
const SWELL_SHARE: f32 = 0.06;

/// Side of a group of lines that are long or short together, or left out, in cells of a line.
const GROUP_CELLS: f32 = 3.0;

/// Points of the curve between two moments.
const SUBSTEPS: usize = 4;

/// What the first bit of the ids of these strokes is.
const ID_BIT: u64 = 1 << 52;

/// The speed lines of all that moves, as a camera sees them in a picture of `size` pixels at `dpi` pixels per inch.
///
/// Strokes of kind [`Kind::Marked`] on surfaces of an object "speed lines", whose materials have the names of what
/// moves. Nothing comes of a way that cannot be seen. O(vertices x moments + triangles), and a grid of fixed size.
pub(crate) fn find_trails(
    movement: &Movement,
    (camera, style): (&Camera, &Style),
    (size, dpi): ([u32; 2], f32),
) -> Drawing {
    // Find out what leaves trails.
    let mut drawing = Drawing {
        size,
        ..Drawing::default()
    };
    let looks = movement.parts().iter().map(|info| info.look(style).follow);
    let reaches: Vec<f32> = looks.map(|follow| follow * style.motion.shutter).collect();
    let is_moving = movement.is_moving();
    let mut trailing = reaches.iter().zip(&is_moving);
    if !trailing.any(|(reach_s, is_moving)| *is_moving && *reach_s > 0.0) {
        return drawing;
    }

    // Choose where lines begin, and draw them.
    let view = camera.view(size, movement.bounds());
    let finder = Finder {
        seen: Seen::new(movement, style, &view, size),
        movement,
        style,
        height_px: size[1] as f32,
        spacing_px: spacing_px(style, &view, movement, (size, dpi)),
        least_px: style.motion.least.to_px(size[1] as f32, dpi, 0.0),
        scales: movement.scales(),
        reaches,
        is_moving,
    };
    let mut surfaces: BTreeMap<u32, u32> = BTreeMap::new();
    let mut ids = BTreeSet::new();
    for start in finder.starts() {
        let count = surfaces.len() as u32;
        let surface = *surfaces.entry(start.object).or_insert(count);
        for (ordinal, points) in (0..).zip(finder.drawn(&start)) {
            let id = ID_BIT | u64::from(start.key) << 8 | (ordinal & 255);
            if ids.insert(id) {
                drawing.strokes.push(Stroke {
                    id,
                    kind: Kind::Marked,
                    occluders: 0,
                    surface,
                    closed: false,
                    points,
                });
            }
        }
    }

    // Name what they lie on.
    let color = style.motion.color;
    let mut named: Vec<(u32, u32)> = surfaces.into_iter().map(|(o, s)| (s, o)).collect();
    named.sort_unstable();
    let name_of = |object: u32| {
        let info = movement.parts().iter().find(|info| info.object == object);
        info.map_or_else(String::new, |info| info.object_name.clone())
    };
    let object_number = 1 + movement
        .parts()
        .iter()
        .map(|info| info.object)
        .max()
        .unwrap_or(0);
    drawing.surfaces = named
        .into_iter()
        .map(|(_, object)| StrokeSurface {
            object: OBJECT.to_owned(),
            object_number,
            material: name_of(object),
            line_color: [color.r, color.g, color.b, color.a],
            fill_color: [color.r, color.g, color.b, color.a],
        })
        .collect();
    drawing
}

/// Lays the strokes and surfaces of a drawing over another one of the same size.
pub(crate) fn lay_over(drawing: &mut Drawing, mut trails: Drawing) {
    let first = drawing.surfaces.len() as u32;
    trails
        .strokes
        .iter_mut()
        .for_each(|stroke| stroke.surface += first);
    drawing.surfaces.append(&mut trails.surfaces);
    drawing.strokes.append(&mut trails.strokes);
}

/// Distance between lines in pixels.
fn spacing_px(
    style: &Style,
    view: &View,
    movement: &Movement,
    (size, dpi): ([u32; 2], f32),
) -> f32 {
    let world_px = pixels_per_unit(view, movement);
    let spacing = style.motion.spacing.to_px(size[1] as f32, dpi, world_px);
    // Closer ones than cells of the grid would be the same.
    spacing.max(2.0 * size[0].max(size[1]) as f32 / GRID_PX as f32)
}

/// Pixels per unit of the world in the middle of the scene.
fn pixels_per_unit(view: &View, movement: &Movement) -> f32 {
    let (low, high) = movement.bounds();
    let middle = (Vec3::from(low) + Vec3::from(high)) * 0.5;
    let depth = (middle - Vec3::from(view.eye_world)).dot(Vec3::from(view.forward_world));
    let world_px = view.pixels_per_unit(depth.max(view.near));
    if world_px.is_finite() { world_px } else { 1.0 }
}

/// What a grid over the picture shows.
struct Seen {
    clip_from_world: Mat4,
    frame_px: Vec2,
    eye_world: Vec3,
    forward_world: Vec3,
    /// Pixels per unit of the world in the middle of the scene.
    world_px: f32,
    window: Window,
    size: [u32; 2],
    /// Numbers of triangles, and reversed depths; 0 where there is no surface.
    ids: Vec<u32>,
    depths: Vec<f32>,
    clip: Vec<[f32; 4]>,
    ndc_scale: Vec2,
}

impl Seen {
    fn new(movement: &Movement, style: &Style, view: &View, size: [u32; 2]) -> Self {
        // Lay a grid over the picture.
        let longer = size[0].max(size[1]).max(1) as f32;
        let side = |px: u32| ((px as f32 * GRID_PX as f32 / longer).round() as u32).max(1);
        let grid = size.map(side);
        let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, grid);

        // Draw the surfaces on it.
        let clip_from_world = Mat4::from_cols_array_2d(&view.clip_from_world);
        let places = movement.now().iter().map(|place| Vec3::from(*place));
        let clip: Vec<[f32; 4]> = places
            .map(|place| (clip_from_world * place.extend(1.0)).to_array())
            .collect();
        let parts = movement.flat_parts(style);
        let fill = Fill {
            window: &window,
            triangles: movement.triangles(),
            parts: &parts,
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |v| clip[v as usize],
            keep: |_, _, _| true,
        };
        let count = grid[0] as usize * grid[1] as usize;
        let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
        fill_triangles(&fill, &mut ids, &mut depths);
        Self {
            clip_from_world,
            frame_px: Vec2::from(view.frame_px),
            eye_world: Vec3::from(view.eye_world),
            forward_world: Vec3::from(view.forward_world),
            world_px: pixels_per_unit(view, movement),
            window,
            size: grid,
            ids,
            depths: depths.into_iter().map(f32::from_bits).collect(),
            clip,
            ndc_scale: 2.0 / Vec2::from(view.frame_px),
        }
    }

    /// Pixels of the picture to a cell of the grid.
    fn step_px(&self) -> f32 {
        self.frame_px.max_element() / self.size[0].max(self.size[1]) as f32
    }

    /// The cell at a place of the picture; none outside.
    fn cell(&self, place: Vec2) -> Option<usize> {
        let grid = Vec2::from(self.size.map(|side| side as f32));
        let at = (place / self.frame_px * grid).floor();
        let inside = at.cmpge(Vec2::ZERO).all() && at.cmplt(grid).all();
        inside.then(|| at.y as usize * self.size[0] as usize + at.x as usize)
    }

    fn ndc(&self, place: Vec2) -> [f32; 2] {
        let ndc = place * self.ndc_scale - 1.0;
        [ndc.x, -ndc.y]
    }

    /// The triangle that a cell shows; none where there is no surface.
    fn triangle(&self, cell: usize) -> Option<u32> {
        (self.ids[cell] != 0).then(|| triangle_of(self.ids[cell]))
    }

    /// Where a place of the world lies in the picture, and its reversed depth; none behind the eye.
    fn place_px(&self, world: Vec3) -> Option<(Vec2, f32)> {
        let clip = self.clip_from_world * world.extend(1.0);
        let ndc = Vec2::new(clip.x, -clip.y) / clip.w;
        let px = (ndc + 1.0) * 0.5 * self.frame_px;
        let is_before_eye = clip.w > 0.0 && clip.z <= clip.w;
        (is_before_eye && px.is_finite()).then_some((px, clip.z / clip.w))
    }
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
    seen: Seen,
    movement: &'a Movement,
    style: &'a Style,
    height_px: f32,
    spacing_px: f32,
    least_px: f32,
    /// How much longer things are in the world than in the mesh of each part.
    scales: Vec<f32>,
    /// How far back the lines of each part follow, in seconds.
    reaches: Vec<f32>,
    is_moving: Vec<bool>,
}

impl Finder<'_> {
    fn triangle(&self, number: u32) -> Triangle {
        self.movement.triangles()[number as usize]
    }

    /// Whether a cell shows something that moves.
    fn is_mover(&self, cell: usize) -> bool {
        let triangle = self.seen.triangle(cell);
        triangle.is_some_and(|number| self.is_moving[self.triangle(number).part as usize])
    }

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
                if self.is_mover(cell) && beside.any(|other| !self.is_mover(other)) {
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
        let triangle = self.triangle(number);
        let reach_s = self.reaches[triangle.part as usize];
        if reach_s <= 0.0 {
            return None;
        }
        let width = self.seen.size[0];
        let [x, y] = [cell as u32 % width, cell as u32 / width];
        let place = Vec2::from(self.seen.window.frame_at(x, y));
        let clip = triangle.corners.map(|v| self.seen.clip[v as usize]);
        let weights = weights_at(clip, self.seen.ndc(place));
        if !weights.iter().all(|weight| weight.is_finite()) {
            return None;
        }
        let before = self.place_before(number, weights, 0.25 * reach_s)?;
        let now = self.movement.place(0, number, weights);
        let [(is, _), (was, _)] = [self.seen.place_px(now)?, self.seen.place_px(before)?];
        let back = (was - is).try_normalize()?;

        // See whether it left it behind.
        let beside = self.seen.cell(place + back * 1.6 * self.seen.step_px());
        if beside.is_none_or(|cell| self.is_mover(cell)) {
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

    /// Where a point of a surface was some seconds before.
    fn place_before(&self, triangle: u32, weights: [f32; 3], seconds: f32) -> Option<Vec3> {
        let moments = self.movement.seconds();
        let after = moments.iter().position(|moment| *moment >= seconds);
        let after = after.unwrap_or(moments.len() - 1).max(1);
        let [near, far] = [*moments.get(after - 1)?, *moments.get(after)?];
        let share = ((seconds - near) / (far - near)).clamp(0.0, 1.0);
        let [near, far] =
            [after - 1, after].map(|moment| self.movement.place(moment, triangle, weights));
        Some(near.lerp(far, share))
    }

    /// The way of a point of a surface through the moments before, as a smooth curve; it ends where it turns back, at a
    /// cut, behind the eye, and at the longest length.
    fn way(&self, start: &Start) -> Vec<WayPoint> {
        // Gather where it was.
        let until = |seconds: &&f32| **seconds < start.reach_s;
        let moments = self.movement.seconds().iter().take_while(until);
        let seconds = moments.copied().chain([start.reach_s]);
        let mut knots: Vec<(Vec2, f32, Vec3)> = Vec::new();
        for seconds in seconds {
            let world = self.place_before(start.triangle, start.weights, seconds);
            let Some(world) = world.filter(|world| world.is_finite()) else {
                break;
            };
            let Some((place, reversed)) = self.seen.place_px(world) else {
                break;
            };
            if let (Some((first, ..)), Some((last, ..))) = (knots.first(), knots.last()) {
                let is_cut = last.distance(place) > LEAP_SHARE * self.height_px;
                if is_cut || first.distance(place) < first.distance(*last) {
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
        if end - gap < 0.5 * self.least_px || of_group > 1.0 - 0.3 * motion.variation {
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
            if self.is_mover(cell) {
                if is_begun || along_px > gap + LATEST_START * (end - gap) {
                    break;
                }
                begins = along_px + step_px;
                continue;
            }
            if self.seen.depths[cell] > point.reversed * (1.0 + COVER_ROOM) {
                runs.push(std::mem::take(&mut run));
                continue;
            }
            let share = (along_px - begins) / (end - begins).max(1e-6);
            let swell = (0.4 + 0.6 * share / SWELL_SHARE).clamp(0.0, 1.0);
            run.push(StrokePoint {
                position: point.place.to_array().map(f64::from),
                depth: f64::from((point.world - self.seen.eye_world).dot(self.seen.forward_world)),
                width: f64::from(widest * swell * (1.0 - share).max(0.0)),
                u: f64::from(along_px - begins),
                world: point.world.to_array(),
                ..StrokePoint::default()
            });
        }
        runs.push(run);
        runs.retain(|run| run.len() >= 3);
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
