//! From triangles as stored to a [`Shape`]: welded, with half-edges, unique edges and their traits.

use std::ops::AddAssign;

use glam::DVec3;
use npr_core::geometry::NONE;
use npr_core::shape::{Shape, Surface};
use rayon::prelude::*;

use crate::sides::Sides;
use crate::weld::{Weld, weld};
use crate::{sectors, slivers};

/// A mesh as stored, in the place where it is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub struct PlacedMesh<'a> {
    /// Positions before posing, in the unit of the file. Welding looks at these, so that limbs which touch
    /// in one pose do not grow together.
    pub rest: &'a [[f32; 3]],
    /// The same vertices posed, in the world. The first vertex of a welded group stands for all.
    pub world: &'a [[f32; 3]],
    /// Three vertices per face, counter-clockwise seen from outside before placing.
    pub triangles: &'a [[u32; 3]],
    /// Index into [`Shape::surfaces`] for every triangle.
    pub surfaces: &'a [u32],
    /// Ends of edges that the user wants drawn, as stored vertices.
    pub marks: &'a [[u32; 2]],
    /// Placing turned the mesh inside out; two corners of every face are swapped to undo that.
    pub mirrored: bool,
}

/// What became of a mesh, for reports.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Preparation {
    /// Welded vertices.
    pub vertex_count: usize,
    /// Faces that are left.
    pub face_count: usize,
    /// Unique edges.
    pub edge_count: usize,
    /// Edges with a single face.
    pub border_count: usize,
    /// Edges where three or more faces meet.
    pub non_manifold_count: usize,
    /// Edges whose two faces run the same way.
    pub flipped_count: usize,
    /// Edges that the user marked.
    pub marked_count: usize,
    /// Faces without area that are left, because they hold the surface together.
    pub sliver_count: usize,
    /// Those of them that found no face to take an orientation from.
    pub lost_sliver_count: usize,
    /// Faces removed because two of their corners weld.
    pub collapsed_count: usize,
    /// Faces removed because an earlier one has the same corners.
    pub double_count: usize,
    /// Faces removed because a corner or surface does not exist, or a position is not finite.
    pub unsound_count: usize,
    /// Marks that lie on no edge.
    pub lost_mark_count: usize,
}

impl Preparation {
    /// Counts what a shape holds; it does not remember what was removed.
    pub fn of(shape: &Shape) -> Self {
        let with = |bit: u32| {
            shape
                .edge_traits
                .par_iter()
                .filter(|&t| t & bit != 0)
                .count()
        };
        Self {
            vertex_count: shape.positions.len(),
            face_count: shape.faces.len(),
            edge_count: shape.edge_count(),
            border_count: with(Shape::BORDER),
            non_manifold_count: with(Shape::NON_MANIFOLD),
            flipped_count: with(Shape::FLIPPED),
            marked_count: with(Shape::MARKED),
            sliver_count: shape.slivers.len(),
            lost_sliver_count: shape.slivers.iter().filter(|s| s[1] == NONE).count(),
            ..Self::default()
        }
    }

    /// Faces that were stored but are not in the shape.
    pub fn removed_count(&self) -> usize {
        self.collapsed_count + self.double_count + self.unsound_count
    }
}

impl AddAssign for Preparation {
    fn add_assign(&mut self, other: Self) {
        self.vertex_count += other.vertex_count;
        self.face_count += other.face_count;
        self.edge_count += other.edge_count;
        self.border_count += other.border_count;
        self.non_manifold_count += other.non_manifold_count;
        self.flipped_count += other.flipped_count;
        self.marked_count += other.marked_count;
        self.sliver_count += other.sliver_count;
        self.lost_sliver_count += other.lost_sliver_count;
        self.collapsed_count += other.collapsed_count;
        self.double_count += other.double_count;
        self.unsound_count += other.unsound_count;
        self.lost_mark_count += other.lost_mark_count;
    }
}

/// Adds a mesh to a shape that already holds its [`Surface`]s, and perhaps other meshes.
///
/// Vertices weld within the mesh, not with those of other meshes; `weld_tolerance` is that of
/// [`weld()`]. The new edges ascend by their lower, then their higher vertex. Half-edges of one edge are
/// listed with those first that run up. Where three or more faces meet, faces that bound one wedge of
/// solid matter become twins, as far as they are wound oppositely.
///
/// Any input is taken: faces that name missing vertices or surfaces, or positions that are not finite, are
/// removed and counted; vertices without a finite position move to the origin, unused.
///
/// Angles and areas are those of the posed positions, in `f64`. Sorting, O(n log n), about 100 bytes of
/// scratch per face; the same bits for any number of threads.
///
/// # Panics
///
/// If the mesh has 2^31 half-edges or more, or the shape would have 2^32.
pub fn add_mesh(shape: &mut Shape, mesh: &PlacedMesh, weld_tolerance: f32) -> Preparation {
    let vertex_count = mesh.rest.len().min(mesh.world.len());
    let weld = weld(&mesh.rest[..vertex_count], weld_tolerance);
    let (mut part, mut removed) = weld_faces(mesh, &weld, &shape.surfaces);
    removed.double_count = connect(&mut part);
    measure(&mut part, &shape.surfaces);
    removed.lost_mark_count = mark(&mut part, mesh.marks, &weld);

    let mut preparation = Preparation::of(&part);
    preparation += removed;
    append(shape, part);
    preparation
}

/// What becomes of a stored face.
#[derive(Clone, Copy)]
enum Fate {
    Kept([u32; 3]),
    Collapsed,
    Unsound,
}

/// Positions, faces and surfaces of the welded mesh, and how many faces fell out.
fn weld_faces(mesh: &PlacedMesh, weld: &Weld, surfaces: &[Surface]) -> (Shape, Preparation) {
    let finite = |p: &[f32; 3]| p.iter().all(|v| v.is_finite());
    let all_finite = mesh.rest.par_iter().chain(mesh.world).all(finite);
    let sound = |vertex: u32| {
        let Some(&welded) = weld.of_vertex.get(vertex as usize) else {
            return false;
        };
        let first = weld.first[welded as usize] as usize;
        all_finite || finite(&mesh.rest[vertex as usize]) && finite(&mesh.world[first])
    };
    let fate = |face: usize| {
        let surface = mesh.surfaces.get(face);
        let [a, b, c] = mesh.triangles[face];
        if surface.is_none_or(|&s| s as usize >= surfaces.len())
            || ![a, b, c].into_iter().all(sound)
        {
            return Fate::Unsound;
        }
        let [a, b, c] = weld.corners(if mesh.mirrored { [a, c, b] } else { [a, b, c] });
        if a == b || b == c || c == a {
            Fate::Collapsed
        } else {
            Fate::Kept([a, b, c])
        }
    };
    let fates: Vec<Fate> = (0..mesh.triangles.len())
        .into_par_iter()
        .map(fate)
        .collect();

    let place = |&vertex: &u32| Some(mesh.world[vertex as usize]).filter(finite);
    let mut part = Shape {
        positions: weld
            .first
            .iter()
            .map(|v| place(v).unwrap_or_default())
            .collect(),
        faces: Vec::with_capacity(fates.len()),
        face_surfaces: Vec::with_capacity(fates.len()),
        ..Shape::default()
    };
    let mut removed = Preparation::default();
    for (fate, &surface) in fates
        .iter()
        .zip(mesh.surfaces.iter().chain(std::iter::repeat(&NONE)))
    {
        match fate {
            Fate::Kept(corners) => {
                part.faces.push(*corners);
                part.face_surfaces.push(surface);
            }
            Fate::Collapsed => removed.collapsed_count += 1,
            Fate::Unsound => removed.unsound_count += 1,
        }
    }
    (part, removed)
}

/// Finds edges and twins, after removing faces stored twice; gives the number of those.
fn connect(part: &mut Shape) -> usize {
    list_edges(part);
    let doubles = doubles(part);
    if !doubles.is_empty() {
        let is_double = |face: u32| doubles.binary_search(&face).is_ok();
        let kept: Vec<usize> = (0..part.faces.len())
            .filter(|&f| !is_double(f as u32))
            .collect();
        part.faces = kept.iter().map(|&face| part.faces[face]).collect();
        part.face_surfaces = kept.iter().map(|&face| part.face_surfaces[face]).collect();
        list_edges(part);
    }
    pair_half_edges(part);
    doubles.len()
}

fn list_edges(part: &mut Shape) {
    let sides = Sides::of_faces(&part.faces, part.positions.len());
    part.edge_traits = vec![0; sides.starts.len() - 1];
    part.edge_starts = sides.starts;
    part.edge_sides = sides.half_edges;
}

/// Faces with the corners of an earlier one, ascending: they share an edge and the corner opposite it.
fn doubles(part: &Shape) -> Vec<u32> {
    let mut doubles: Vec<u32> = (0..part.edge_count() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .flat_map_iter(|edge| doubles_beside(part, part.sides(edge)))
        .collect();
    doubles.par_sort_unstable();
    doubles.dedup();
    doubles
}

fn doubles_beside(part: &Shape, sides: &[u32]) -> Vec<u32> {
    if let [a, b] = *sides
        && part.opposite(a) != part.opposite(b)
    {
        return Vec::new();
    }
    let mut seen: Vec<[u32; 2]> = sides.iter().map(|&s| [part.opposite(s), s / 3]).collect();
    seen.sort_unstable();
    let same_corners = |pair: &&[[u32; 2]]| pair[0][0] == pair[1][0];
    seen.windows(2)
        .filter(same_corners)
        .map(|pair| pair[1][1])
        .collect()
}

/// Fills `twins` and `edge_of`.
fn pair_half_edges(part: &mut Shape) {
    let mut twins = vec![NONE; part.edge_sides.len()];
    let mut edge_of = vec![NONE; part.edge_sides.len()];
    let mut pair = |[a, b]: [u32; 2]| {
        twins[a as usize] = b;
        twins[b as usize] = a;
    };
    for edge in 0..part.edge_count() as u32 {
        let sides = part.sides(edge);
        sides.iter().for_each(|&side| edge_of[side as usize] = edge);
        match *sides {
            [a, b] if part.runs_up(a) != part.runs_up(b) => pair([a, b]),
            [_] | [_, _] => {}
            _ => sectors::pair(part, edge).into_iter().for_each(&mut pair),
        }
    }
    (part.twins, part.edge_of) = (twins, edge_of);
}

/// Finds slivers, angles and traits.
fn measure(part: &mut Shape, surfaces: &[Surface]) {
    let mut normals = slivers::normals(part);
    part.slivers = slivers::find(part, &normals);
    for &[sliver, stand_in] in part.slivers.iter().filter(|s| s[1] != NONE) {
        normals[sliver as usize] = normals[stand_in as usize];
    }
    let measured = (0..part.edge_count() as u32).into_par_iter().map(|edge| {
        let sides = part.sides(edge);
        let traits = traits(part, sides, surfaces);
        (traits, dihedral_cos(&normals, sides, traits))
    });
    (part.edge_traits, part.dihedral_cos) = measured.unzip();
}

fn traits(part: &Shape, sides: &[u32], surfaces: &[Surface]) -> u32 {
    let meeting = match *sides {
        [_] => Shape::BORDER,
        [a, b] if part.runs_up(a) == part.runs_up(b) => Shape::FLIPPED,
        [_, _] => 0,
        _ => Shape::NON_MANIFOLD,
    };
    let material = |side: u32| {
        let surface = part.face_surfaces[side as usize / 3];
        surfaces[surface as usize].material
    };
    let same = sides
        .iter()
        .all(|&side| material(side) == material(sides[0]));
    meeting | if same { 0 } else { Shape::MATERIAL }
}

/// Between the normals of two faces, as if they were wound alike; 1 where one has no orientation.
fn dihedral_cos(normals: &[DVec3], sides: &[u32], traits: u32) -> f32 {
    let [a, b] = *sides else {
        return 1.0;
    };
    let [a, b] = [a, b].map(|side| normals[side as usize / 3]);
    if a == DVec3::ZERO || b == DVec3::ZERO {
        return 1.0;
    }
    let cos = a.dot(b).clamp(-1.0, 1.0) as f32;
    if traits & Shape::FLIPPED != 0 {
        -cos
    } else {
        cos
    }
}

/// Sets [`Shape::MARKED`]; gives the number of marks that lie on no edge.
fn mark(part: &mut Shape, marks: &[[u32; 2]], weld: &Weld) -> usize {
    let mut lost = 0;
    for &[a, b] in marks {
        let ends = [a, b].map(|v| weld.of_vertex.get(v as usize));
        match ends {
            [Some(&a), Some(&b)] => match find_edge(part, [a.min(b), a.max(b)]) {
                Some(edge) => part.edge_traits[edge] |= Shape::MARKED,
                None => lost += 1,
            },
            _ => lost += 1,
        }
    }
    lost
}

/// The edge between two vertices, by bisection.
fn find_edge(part: &Shape, ends: [u32; 2]) -> Option<usize> {
    let (mut from, mut to) = (0, part.edge_count());
    while from < to {
        let middle = from + (to - from) / 2;
        match part.ends(middle as u32).cmp(&ends) {
            std::cmp::Ordering::Less => from = middle + 1,
            std::cmp::Ordering::Greater => to = middle,
            std::cmp::Ordering::Equal => return Some(middle),
        }
    }
    None
}

/// Moves a part behind what the shape holds.
fn append(shape: &mut Shape, part: Shape) {
    let surfaces = std::mem::take(&mut shape.surfaces);
    if shape.positions.is_empty() && shape.faces.is_empty() {
        *shape = part;
    } else {
        extend(shape, part);
    }
    shape.surfaces = surfaces;
}

fn extend(shape: &mut Shape, part: Shape) {
    let total = 3 * (shape.faces.len() + part.faces.len());
    assert!(
        total < NONE as usize,
        "a shape has fewer than 2^32 half-edges"
    );
    let vertex = shape.positions.len() as u32;
    let face = shape.faces.len() as u32;
    let (half_edge, edge) = (3 * face, shape.edge_count() as u32);
    let moved = |number: u32, by: u32| if number == NONE { NONE } else { number + by };

    shape.positions.extend(part.positions);
    shape
        .faces
        .extend(part.faces.iter().map(|f| f.map(|v| v + vertex)));
    shape.face_surfaces.extend(part.face_surfaces);
    shape
        .twins
        .extend(part.twins.iter().map(|&h| moved(h, half_edge)));
    shape.edge_of.extend(part.edge_of.iter().map(|&e| e + edge));
    shape.edge_starts.pop();
    shape
        .edge_starts
        .extend(part.edge_starts.iter().map(|&s| s + half_edge));
    shape
        .edge_sides
        .extend(part.edge_sides.iter().map(|&h| h + half_edge));
    shape.dihedral_cos.extend(part.dihedral_cos);
    shape.edge_traits.extend(part.edge_traits);
    let slivers = part
        .slivers
        .iter()
        .map(|&[s, stand_in]| [s + face, moved(stand_in, face)]);
    shape.slivers.extend(slivers);
}
