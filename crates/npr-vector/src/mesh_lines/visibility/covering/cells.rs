//! The faces of a view by cells of the picture: a line is hidden by one of the few foremost faces where it runs.

use super::cover::Cover;
use super::sights::Sights;
use crate::mesh_lines::bvh::{Barrier, NEARER};
use crate::mesh_lines::visibility::{MARGIN, Piece};
use crate::project::Projector;
use foldhash::fast::FixedState;
use glam::{DVec2, DVec3};
use npr_core::geometry::NONE;
use npr_mesh::half_edge::HalfEdgeMesh;
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Side of a cell in pixels; it doubles where faces are so large that there would be too many entries.
const CELL_PX: f64 = 16.0;

/// Most entries of faces in cells; if there were more, cells become twice as wide.
const MOST_ENTRIES: usize = 1 << 25;

/// By how much places and orders are widened for rounding: in cells, and as a share of an order.
const ROOM: f64 = 1e-6;

/// Rounding of orders of a face that reaches to the eye, as a share of the greatest.
const ROUNDING: f64 = 1e-12;

/// Where faces are cut off before the eye, as a share of the near plane's distance: nearer ones hide nothing.
const CUT: f64 = 1e-7;

/// Least doubled area of an image whose plane is known, as a share of the square of its length.
const LEAST_SLENDERNESS: f64 = 1e-6;

/// Greatest length of such an image, in cells.
const FARTHEST: f64 = 1e6;

/// Rounding of the order of a plane, as a share of the greatest order of its face.
const PLANE_ROUNDING: f64 = 1e-9;

/// The faces of a view by the cells of the picture that they touch, foremost first.
///
/// Depths are compared by their order ([`order_of`]), which changes linearly over the image of a plane. A face that
/// fills a cell hides whatever lies behind it there; of such faces the wall is the one that ends first. Faces whose
/// planes lie behind the wall are not kept in the cell: about as many remain as meet in its visible part.
#[derive(Debug)]
pub(super) struct FaceCells {
    grid: Grid,
    /// By face.
    bounds: Vec<Bounds>,
    /// By face, where all is seen from one eye; else empty.
    barriers: Vec<Barrier>,
    /// By cell.
    walls: Vec<Wall>,
    /// Where the faces of each cell start in `entries`, and at the end where the last ones end.
    starts: Vec<u32>,
    /// Faces, each with the least order that it has in the cell; ascending in every cell.
    entries: Vec<(f64, u32)>,
}

/// The bounds of a face's image as linear functions over the picture: the value at a place is `v . (x, y, 1)`.
#[derive(Debug, Clone, Copy)]
struct Bounds {
    /// The order of its plane, less rounding.
    plane: DVec3,
    /// The distance from each side of its image, in cells, positive inside.
    sides: [DVec3; 3],
    /// Rounding of the plane's order.
    rounding: f64,
}

impl Bounds {
    /// The bounds of an image of which nothing is known.
    const NONE: Self = Self {
        sides: [DVec3::new(0.0, 0.0, f64::INFINITY); 3],
        plane: DVec3::new(0.0, 0.0, f64::NEG_INFINITY),
        rounding: f64::INFINITY,
    };

    /// The bounds of an image that was not cut off before the eye.
    fn of(image: &Polygon) -> Self {
        // Leave out images so slim or long that rounding decides.
        let &[a, b, c] = image.corners() else {
            return Self::NONE;
        };
        let [along, across] = [b - a, c - a];
        let area = along.truncate().perp_dot(across.truncate());
        let longest = along.length_squared().max(across.length_squared());
        let [low, high] = image.range(2);
        let is_plain = area.abs() > LEAST_SLENDERNESS * longest && longest < FARTHEST * FARTHEST;
        if !(is_plain && a.is_finite() && low.is_finite() && high.is_finite()) {
            return Self::NONE;
        }

        // Measure inwards from every side.
        let side = |from: Corner, to: Corner| {
            let across = (to - from).truncate().perp().normalize_or_zero() * area.signum();
            across.extend(-across.dot(from.truncate()))
        };

        // Tell how the order changes over the picture.
        let slope = DVec2::new(
            along.z * across.y - across.z * along.y,
            across.z * along.x - along.z * across.x,
        ) / area;
        let rounding = PLANE_ROUNDING * low.abs().max(high.abs());
        Self {
            sides: [side(a, b), side(b, c), side(c, a)],
            plane: slope.extend(a.z - slope.dot(a.truncate()) - rounding),
            rounding,
        }
    }

    /// Whether its plane lies nowhere before another's over a cell, or by so little that it hides nothing more.
    fn is_behind(&self, other: &Self, cell: DVec2, projector: &Projector) -> bool {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE];
        corners.iter().all(|corner| {
            let place = (cell + *corner).extend(1.0);
            let order = other.plane.dot(place) + 2.0 * other.rounding;
            self.plane.dot(place) >= order - 0.5 * touching(projector, order)
        })
    }

    /// Whether the face may hide a part of a line between two places; `least` are the orders above which a plane lies
    /// behind the line there.
    fn may_hide(&self, ends: &[DVec3; 2], least: &[f64; 2]) -> bool {
        let is_beside = |side: &DVec3| ends.iter().all(|end| side.dot(*end) < -ROOM);
        let is_behind = (0..2).all(|i| self.plane.dot(ends[i]) > least[i]);
        !is_behind && !self.sides.iter().any(is_beside)
    }
}

/// The face that fills a cell and ends first.
#[derive(Debug, Clone, Copy)]
struct Wall {
    /// The order of its farthest place in the cell.
    end: f64,
    face: u32,
}

impl Wall {
    const NONE: Self = Self {
        end: f64::INFINITY,
        face: NONE,
    };

    /// The wall that ends first; of two that end alike, the one of the lesser face.
    fn nearer(self, other: Self) -> Self {
        let is_other = (other.end, other.face) < (self.end, self.face);
        if is_other { other } else { self }
    }
}

/// Cells over a picture and its margin.
#[derive(Debug, Clone, Copy)]
struct Grid {
    cell_px: f64,
    origin: f64,
    columns: usize,
    rows: usize,
}

impl Grid {
    fn new(size: [u32; 2], cell_px: f64) -> Self {
        let margin = MARGIN * f64::from(size[0].max(size[1]));
        let [columns, rows] =
            size.map(|side| ((f64::from(side) + 2.0 * margin) / cell_px) as usize + 1);
        Self {
            cell_px,
            origin: -margin,
            columns,
            rows,
        }
    }

    /// A place of the picture in units of cells.
    fn place(&self, place: [f64; 2]) -> DVec2 {
        (DVec2::from(place) - self.origin) / self.cell_px
    }

    /// The rows or columns of `count` that a range touches.
    fn touched([low, high]: [f64; 2], count: usize) -> std::ops::Range<usize> {
        let first = (low - ROOM).floor().max(0.0) as usize;
        let end = ((high + ROOM).floor() + 1.0).clamp(0.0, count as f64) as usize;
        first..end.max(first)
    }
}

/// The order of a depth from the eye: greater behind, and linear over the image of a plane.
fn order_of(projector: &Projector, depth: f64) -> f64 {
    if projector.is_perspective() {
        -1.0 / depth
    } else {
        depth
    }
}

/// A corner of a face's image: cells to the right and down, and order.
type Corner = DVec3;

/// A convex piece of a face's image; cutting off a triangle's part before the eye and a cell's four sides adds a corner
/// each.
#[derive(Debug, Clone, Copy)]
struct Polygon {
    corners: [Corner; 8],
    count: usize,
}

impl Polygon {
    const EMPTY: Self = Self {
        corners: [Corner::ZERO; 8],
        count: 0,
    };

    fn push(&mut self, corner: Corner) {
        // Of a convex piece no side is cut twice; one more would come of rounding and lie on another.
        if let Some(place) = self.corners.get_mut(self.count) {
            *place = corner;
            self.count += 1;
        }
    }

    fn corners(&self) -> &[Corner] {
        &self.corners[..self.count]
    }

    fn sides(&self) -> impl Iterator<Item = [Corner; 2]> {
        let corners = self.corners();
        (0..corners.len()).map(move |i| [corners[i], corners[(i + 1) % corners.len()]])
    }

    /// The part where the coordinate of an axis is at least a bound (`sign` 1) or at most (-1).
    fn cut(&self, axis: usize, sign: f64, bound: f64) -> Self {
        let mut cut = Self::EMPTY;
        for [from, to] in self.sides() {
            let [a, b] = [from, to].map(|corner| (corner[axis] - bound) * sign);
            if a >= 0.0 {
                cut.push(from);
            }
            if (a >= 0.0) != (b >= 0.0) {
                cut.push(from.lerp(to, (a / (a - b)).clamp(0.0, 1.0)));
            }
        }
        cut
    }

    /// Least and greatest coordinate of an axis.
    fn range(&self, axis: usize) -> [f64; 2] {
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        self.corners().iter().fold(start, |[low, high], corner| {
            [low.min(corner[axis]), high.max(corner[axis])]
        })
    }

    /// Whether the polygon fills the square cell at a place, and a little more.
    fn fills(&self, cell: DVec2) -> bool {
        let middle = cell + 0.5;
        let mut turns = [false; 2];
        for [from, to] in self.sides() {
            let along = (to - from).truncate();
            let reach = along.perp_dot(middle - from.truncate());
            let least = 0.5 * (along.x.abs() + along.y.abs()) + ROOM * along.length();
            if reach.abs() < least {
                return false;
            }
            turns[usize::from(reach > 0.0)] = true;
        }
        // The middle lies on one side of all.
        turns[0] != turns[1]
    }
}

/// The image of the part of a face that lies before the eye; `None` if all of it lies behind.
fn image_of(
    shape: &HalfEdgeMesh,
    face: u32,
    projector: &Projector,
    grid: &Grid,
) -> Option<Polygon> {
    let corners = shape.faces[face as usize].map(|v| projector.from_eye(shape.point(v)));

    // Leave out what lies before the cut, just before the eye.
    let cut = CUT * projector.near();
    let is_before = |corner: &DVec3| !projector.is_perspective() || corner.z > cut;
    let mut image = Polygon::EMPTY;
    let mut push = |corner: DVec3| {
        let place = grid.place(projector.project_from_eye(corner));
        image.push(place.extend(order_of(projector, corner.z)));
    };

    // Go around the face, with new corners where a side crosses the cut.
    for i in 0..3 {
        let [from, to] = [corners[i], corners[(i + 1) % 3]];
        if is_before(&from) {
            push(from);
        }
        if is_before(&from) != is_before(&to) {
            let crossed = from.lerp(to, (cut - from.z) / (to.z - from.z));
            push(crossed.truncate().extend(cut));
        }
    }
    (image.count > 0).then_some(image)
}

/// The part of a face that lies in a cell.
struct Part<'a> {
    cell: usize,
    /// The cell's upper left corner, in cells.
    corner: DVec2,
    /// The least and greatest order that it has there.
    orders: [f64; 2],
    /// The image of the face, where it is known.
    image: Option<&'a Polygon>,
}

impl Part<'_> {
    /// Whether the face fills the cell.
    fn fills(&self) -> bool {
        self.image.is_some_and(|image| image.fills(self.corner))
    }
}

/// Visits all cells that a face touches.
fn for_parts(
    shape: &HalfEdgeMesh,
    face: u32,
    projector: &Projector,
    grid: &Grid,
    mut visit: impl FnMut(Part<'_>),
) {
    let Some(image) = image_of(shape, face, projector, grid) else {
        return;
    };
    let orders = image.range(2);
    let is_sound = image.corners().iter().all(|corner| corner.is_finite());
    let rounding = ROUNDING * orders[0].abs().max(orders[1].abs());
    let room = |order: f64| ROOM * order.abs().max(least_scale(projector)) + rounding;
    let mut part = |column: usize, row: usize, orders: [f64; 2], image| {
        visit(Part {
            cell: row * grid.columns + column,
            corner: DVec2::new(column as f64, row as f64),
            orders: [orders[0] - room(orders[0]), orders[1] + room(orders[1])],
            image,
        });
    };
    if !is_sound {
        // Where it lies is not known: anywhere, and before all.
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                part(column, row, [f64::MIN, f64::MAX], None);
            }
        }
        return;
    }
    for row in Grid::touched(image.range(1), grid.rows) {
        let [top, bottom] = [row as f64 - ROOM, (row + 1) as f64 + ROOM];
        let mut rest = image.cut(1, 1.0, top).cut(1, -1.0, bottom);
        for column in Grid::touched(rest.range(0), grid.columns) {
            let [left, right] = [column as f64 - ROOM, (column + 1) as f64 + ROOM];
            rest = rest.cut(0, 1.0, left);
            let inside = rest.cut(0, -1.0, right);
            if inside.count > 0 {
                part(column, row, inside.range(2), Some(&image));
            }
        }
    }
}

/// How far before an order a plane may lie without hiding it: less than half of what sights leave out ([`NEARER`]).
fn touching(projector: &Projector, order: f64) -> f64 {
    let way = match projector.is_perspective() {
        true => order.abs(),
        false => (order - projector.near()).max(0.0),
    };
    0.4 * NEARER * way
}

/// The least scale that rounding of orders is relative to: in parallel view orders are depths, which may be 0.
fn least_scale(projector: &Projector) -> f64 {
    if projector.is_perspective() {
        0.0
    } else {
        projector.near().abs() + projector.far().abs()
    }
}

impl FaceCells {
    /// Bytes for each face: usual faces touch few cells, and large ones lie before the wall in few.
    pub(super) const BYTES_PER_FACE: usize =
        size_of::<Bounds>() + size_of::<Barrier>() + 4 * size_of::<(u32, f64, u32)>();

    /// Sorts the faces of a shape into cells. About O(faces + cells they touch before what hides them there).
    ///
    /// A thread takes at least `least` faces at once: with no more faces than that, the calling thread does all.
    pub(super) fn new(
        shape: &HalfEdgeMesh,
        projector: &Projector,
        size: [u32; 2],
        least: usize,
    ) -> Self {
        let mut cell_px = CELL_PX;
        loop {
            let grid = Grid::new(size, cell_px);
            let is_last = grid.columns * grid.rows == 1;
            let most = if is_last { usize::MAX } else { MOST_ENTRIES };
            let sorter = Sorter {
                shape,
                projector,
                grid,
                least,
            };
            if let Some(found) = sorter.cells(most) {
                return found;
            }
            cell_px *= 2.0;
        }
    }

    /// Adds the parts of a piece that faces hide to those known, until all hidden parts are known.
    ///
    /// O(cells that the piece passes + faces before its parts that are not yet known to be hidden).
    pub(super) fn cover(&self, sights: &Sights<'_>, cover: &mut Cover, tried: &mut Tried) {
        let piece = sights.piece;
        tried.clear();
        self.for_cells(piece, |cell, part| {
            if cover.holds(part) {
                return;
            }
            let projector = sights.seen.projector;
            let orders = part.map(|share| piece.image().coordinate_at(projector, share));
            let farthest = orders[0].max(orders[1]);
            let ends = part.map(|share| self.grid.place(piece.place_at(share)).extend(1.0));
            let least = orders.map(|order| order - touching(projector, order));
            let mut try_face = |face: u32, cover: &mut Cover| {
                // A face hides what it hides in all cells at once.
                if self.bounds[face as usize].may_hide(&ends, &least) && tried.insert(face) {
                    cover.add(sights.hidden_behind(face, self.barriers.get(face as usize)));
                }
            };
            if self.walls[cell].face != NONE {
                try_face(self.walls[cell].face, cover);
            }
            let [first, end] = [cell, cell + 1].map(|c| self.starts[c] as usize);
            for (nearest, face) in &self.entries[first..end] {
                if *nearest >= farthest || cover.holds(part) {
                    break;
                }
                try_face(*face, cover);
            }
        });
        cover.join();
    }

    /// Visits the cells that a piece's image passes, in order, with the part in each as shares of the image.
    fn for_cells(&self, piece: &Piece, mut visit: impl FnMut(usize, [f64; 2])) {
        let [a, b] = piece.place.map(|place| self.grid.place(place));
        let along = b - a;
        // The share at which the next side of a cell is reached along each axis.
        let next_side = |axis: usize, at: f64| {
            let side = match along[axis] > 0.0 {
                true => at.floor() + 1.0,
                false => at.ceil() - 1.0,
            };
            (side, (side - a[axis]) / along[axis])
        };
        let start = |axis: usize| match along[axis] == 0.0 {
            true => (0.0, f64::INFINITY),
            false => next_side(axis, a[axis]),
        };
        let mut next = [start(0), start(1)];
        let mut from = 0.0;
        while from < 1.0 {
            let axis = usize::from(next[1].1 < next[0].1);
            let to = next[axis].1.clamp(from, 1.0);
            if from < to {
                let middle = a + along * (0.5 * (from + to));
                let column = (middle.x.max(0.0) as usize).min(self.grid.columns - 1);
                let row = (middle.y.max(0.0) as usize).min(self.grid.rows - 1);
                visit(row * self.grid.columns + column, [from, to]);
            }
            from = to;
            let side = next[axis].0 + along[axis].signum();
            next[axis] = (side, (side - a[axis]) / along[axis]);
        }
    }
}

/// The faces that were tested against a piece.
pub(crate) type Tried = HashSet<u32, FixedState>;

/// The input of sorting faces into cells.
struct Sorter<'a> {
    shape: &'a HalfEdgeMesh,
    projector: &'a Projector,
    grid: Grid,
    /// Fewest faces that a thread takes at once.
    least: usize,
}

impl Sorter<'_> {
    /// The faces sorted into cells; `None` if there are more than `most` entries.
    fn cells(&self, most: usize) -> Option<FaceCells> {
        let faces = (0..self.shape.faces.len() as u32).into_par_iter();
        let bounds = faces.with_min_len(self.least).map(|face| {
            let image = image_of(self.shape, face, self.projector, &self.grid);
            image.map_or(Bounds::NONE, |image| Bounds::of(&image))
        });
        let bounds: Vec<Bounds> = bounds.collect();
        let count = match self.projector.is_perspective() {
            true => bounds.len() as u32,
            false => 0,
        };
        let [x, y, z, _] = self.projector.eye();
        let eye = DVec3::new(x, y, z);
        let faces = (0..count).into_par_iter().with_min_len(self.least);
        let barriers = faces.map(|face| Barrier::of(self.shape, face, eye));
        let barriers: Vec<Barrier> = barriers.collect();
        let walls = self.walls();
        let found = self.entries(&bounds, &walls, most)?;
        let mut starts = vec![0_u32; walls.len() + 1];
        for (cell, ..) in &found {
            starts[*cell as usize + 1] += 1;
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        // By cell, then as they were found.
        let mut next = starts.clone();
        let mut entries = vec![(0.0, NONE); found.len()];
        for (cell, order, face) in found {
            entries[next[cell as usize] as usize] = (order, face);
            next[cell as usize] += 1;
        }
        let mut rest = entries.as_mut_slice();
        let mut of_cells = Vec::with_capacity(walls.len());
        for range in starts.windows(2) {
            let (cell, after) = rest.split_at_mut((range[1] - range[0]) as usize);
            of_cells.push(cell);
            rest = after;
        }
        let cells = of_cells.into_par_iter().with_min_len(self.least);
        cells.for_each(|cell| {
            cell.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        });
        Some(FaceCells {
            grid: self.grid,
            bounds,
            barriers,
            walls,
            starts,
            entries,
        })
    }

    /// The wall of every cell.
    fn walls(&self) -> Vec<Wall> {
        let Self {
            projector, grid, ..
        } = self;
        let none = || vec![Wall::NONE; grid.columns * grid.rows];
        // What lies before this hides nothing, or not all that is behind it.
        let far = projector.far();
        let nearest = match projector.is_perspective() {
            true => order_of(projector, projector.near().max(ROOM * far)),
            false => projector.near() + ROOM * least_scale(projector),
        };
        let count = self.shape.faces.len();
        // Few lists of cells, each as long as the picture is large.
        let share = count / rayon::current_num_threads().max(1) + 1;
        let faces = (0..count as u32).into_par_iter();
        faces
            .with_min_len(self.least.max(share))
            .fold(none, |mut walls, face| {
                for_parts(self.shape, face, projector, grid, |part| {
                    if part.orders[0] > nearest && part.fills() {
                        let end = part.orders[1];
                        walls[part.cell] = walls[part.cell].nearer(Wall { end, face });
                    }
                });
                walls
            })
            .reduce(none, |mut one, other| {
                for (wall, other) in one.iter_mut().zip(other) {
                    *wall = wall.nearer(other);
                }
                one
            })
    }

    /// Entries of cell, least order and face, in no order, without walls and faces behind them; `None` if there are
    /// more than `most`.
    fn entries(
        &self,
        bounds: &[Bounds],
        walls: &[Wall],
        most: usize,
    ) -> Option<Vec<(u32, f64, u32)>> {
        // Keep a face in a cell unless the wall of the cell hides it there.
        let is_kept = |face: u32, part: &Part<'_>| {
            let wall = walls[part.cell];
            let is_behind = || {
                let wall = &bounds[wall.face as usize];
                bounds[face as usize].is_behind(wall, part.corner, self.projector)
            };
            let may_be_before = part.orders[0] <= wall.end && wall.face != face;
            may_be_before && (wall.face == NONE || !is_behind())
        };

        // Gather entries with all threads, and stop where there are too many.
        let count = AtomicUsize::new(0);
        let faces = (0..self.shape.faces.len() as u32).into_par_iter();
        let found: Vec<Vec<(u32, f64, u32)>> = faces
            .with_min_len(self.least)
            .fold(Vec::new, |mut found, face| {
                if count.load(Ordering::Relaxed) <= most {
                    let before = found.len();
                    for_parts(self.shape, face, self.projector, &self.grid, |part| {
                        if is_kept(face, &part) {
                            found.push((part.cell as u32, part.orders[0], face));
                        }
                    });
                    count.fetch_add(found.len() - before, Ordering::Relaxed);
                }
                found
            })
            .collect();
        (count.into_inner() <= most).then(|| found.concat())
    }
}
