//! From triangles as stored to a [`HalfEdgeMesh`]: welded, with half-edges, unique edges and their traits.

use npr_core::edge_flags::EdgeFlags;
use std::collections::HashSet;
use std::ops::AddAssign;
use std::sync::atomic::{AtomicU32, Ordering};

use crate::half_edge::{HalfEdgeMesh, Surface};
use glam::DVec3;
use npr_core::geometry::NONE;
use rayon::prelude::*;

use crate::crease::{SideNormals, cos_between};
use crate::half_edge_groups::Sides;
use crate::weld::{Weld, weld};
use crate::{degenerate_faces, wedges};

/// A mesh as stored, in the place where it is drawn.
#[derive(Debug, Clone, Copy, Default)]
pub struct PlacedMesh<'a> {
    /// Positions before posing, in the unit of the file. Welding looks at these, so that limbs which touch
    /// in one pose do not grow together.
    pub rest: &'a [[f32; 3]],
    /// The same vertices posed, in the world. The first vertex of a welded group stands for all.
    pub world: &'a [[f32; 3]],
    /// The file's normals at the same vertices, zero where it has none; empty where it has none at all. They say where
    /// faces run on smoothly ([`HalfEdgeMesh::normals_cos`]).
    pub normals: &'a [[f32; 3]],
    /// Three vertices per face, counter-clockwise seen from outside before placing.
    pub triangles: &'a [[u32; 3]],
    /// Index into [`HalfEdgeMesh::surfaces`] for every triangle.
    pub surfaces: &'a [u32],
    /// Ends of edges that the user wants drawn, as stored vertices.
    pub marks: &'a [[u32; 2]],
    /// Lines that are geometry themselves: the two stored vertices of every segment.
    pub polylines: &'a [[u32; 2]],
    /// Index into [`HalfEdgeMesh::surfaces`] for every segment.
    pub polyline_surfaces: &'a [u32],
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
    pub boundary_count: usize,
    /// Edges where three or more faces meet.
    pub non_manifold_count: usize,
    /// Edges whose two faces run the same way.
    pub flipped_count: usize,
    /// Edges that the user marked.
    pub marked_count: usize,
    /// Segments of lines that are geometry themselves.
    pub polyline_count: usize,
    /// Such segments removed because their ends weld, an earlier one has the same ends, or an end or surface does not
    /// exist or is not finite.
    pub lost_polyline_count: usize,
    /// Faces without area that are left, because they hold the surface together.
    pub degenerate_face_count: usize,
    /// Those of them that found no face to take an orientation from.
    pub lost_degenerate_face_count: usize,
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
    pub fn of(shape: &HalfEdgeMesh) -> Self {
        let traits = shape.edge_traits.par_iter();
        let with = |flag| traits.clone().filter(|t| t.contains(flag)).count();
        Self {
            vertex_count: shape.positions.len(),
            face_count: shape.faces.len(),
            edge_count: shape.edge_count(),
            boundary_count: with(EdgeFlags::BOUNDARY),
            non_manifold_count: with(EdgeFlags::NON_MANIFOLD),
            flipped_count: with(EdgeFlags::FLIPPED),
            marked_count: with(EdgeFlags::MARKED),
            polyline_count: shape.polylines.len(),
            degenerate_face_count: shape.degenerate_faces.len(),
            lost_degenerate_face_count: shape
                .degenerate_faces
                .iter()
                .filter(|s| s[1] == NONE)
                .count(),
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
        self.boundary_count += other.boundary_count;
        self.non_manifold_count += other.non_manifold_count;
        self.flipped_count += other.flipped_count;
        self.marked_count += other.marked_count;
        self.polyline_count += other.polyline_count;
        self.lost_polyline_count += other.lost_polyline_count;
        self.degenerate_face_count += other.degenerate_face_count;
        self.lost_degenerate_face_count += other.lost_degenerate_face_count;
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
pub fn add_mesh(shape: &mut HalfEdgeMesh, mesh: &PlacedMesh, weld_tolerance: f32) -> Preparation {
    add_posable_mesh(shape, mesh, weld_tolerance).0
}

/// As [`add_mesh`], together with what [`set_pose`] needs of the mesh: 4 bytes a vertex and 12 a face.
///
/// # Panics
///
/// As [`add_mesh`].
pub fn add_posable_mesh(
    shape: &mut HalfEdgeMesh,
    mesh: &PlacedMesh,
    weld_tolerance: f32,
) -> (Preparation, PosableMesh) {
    let vertex_count = mesh.rest.len().min(mesh.world.len());
    let weld = weld(&mesh.rest[..vertex_count], weld_tolerance);
    let (mut part, mut stored, mut removed) = weld_faces(mesh, &weld, &shape.surfaces);
    removed.double_count = connect(&mut part, &mut stored);
    mark_material_borders(&mut part, &shape.surfaces);
    measure_folds(&mut part);
    measure_normals(&mut part, &stored, mesh.normals);
    removed.lost_mark_count = mark(&mut part, mesh.marks, &weld);
    removed.lost_polyline_count = add_polylines(&mut part, mesh, &weld, shape.surfaces.len());

    let mut preparation = Preparation::of(&part);
    preparation += removed;
    let posable = PosableMesh {
        first_vertex: shape.positions.len(),
        first_face: shape.faces.len(),
        stands_for: weld.first,
        stored,
    };
    append(shape, part);
    (preparation, posable)
}

/// Where a mesh lies in a shape, and which stored vertices its vertices and corners were.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PosableMesh {
    first_vertex: usize,
    first_face: usize,
    /// The stored vertex of every welded vertex, whose place it has.
    stands_for: Vec<u32>,
    /// The stored vertices of every face.
    stored: Vec<[u32; 3]>,
}

impl PosableMesh {
    /// The vertices of the shape that the mesh has, each with the stored vertex of the mesh whose place it has.
    pub fn vertices(&self) -> impl Iterator<Item = (usize, u32)> + '_ {
        (self.first_vertex..).zip(self.stands_for.iter().copied())
    }
}

/// A mesh in another pose: where its stored vertices stand in the world, and the file's normals at them, empty where it
/// has none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeshPose {
    /// Positions in the world.
    pub world: Vec<[f32; 3]>,
    /// The file's normals.
    pub normals: Vec<[f32; 3]>,
}

/// Moves the meshes of a shape into another pose: vertices, and what hangs on where they stand: folds, faces without
/// area, and which faces are twins where more than two meet.
///
/// Vertices, faces and edges keep their numbers: the shape is that of [`add_mesh`] for this pose, bit for bit, where
/// rest positions are the same and all positions finite. O(faces), parallel; nothing is sorted or welded.
///
/// # Panics
///
/// When there are not as many poses as meshes, or one has fewer vertices than its mesh.
pub fn set_pose(shape: &mut HalfEdgeMesh, meshes: &[PosableMesh], poses: &[MeshPose]) {
    // Move the vertices.
    assert_eq!(meshes.len(), poses.len(), "a pose for each mesh");
    for (mesh, pose) in meshes.iter().zip(poses) {
        let vertices = &mut shape.positions[mesh.first_vertex..];
        for (position, stored) in vertices.iter_mut().zip(&mesh.stands_for) {
            let moved = pose.world[*stored as usize];
            *position = if is_finite(&moved) { moved } else { [0.0; 3] };
        }
    }

    // Pair the half-edges of wedges anew.
    for edge in 0..shape.edge_count() as u32 {
        if shape.edge_traits[edge as usize].contains(EdgeFlags::NON_MANIFOLD) {
            for side in shape.sides(edge).to_vec() {
                shape.twins[side as usize] = NONE;
            }
            for [a, b] in wedges::pair(shape, edge) {
                (shape.twins[a as usize], shape.twins[b as usize]) = (b, a);
            }
        }
    }

    // Measure the folds.
    measure_folds(shape);
    if !shape.normals_cos.is_empty() {
        let mut stored = vec![[NONE; 3]; shape.faces.len()];
        let mut normals: Vec<[f32; 3]> = Vec::new();
        for (mesh, pose) in meshes.iter().zip(poses) {
            let first = normals.len() as u32;
            let of_mesh = &mut stored[mesh.first_face..][..mesh.stored.len()];
            for (corners, stored) in of_mesh.iter_mut().zip(&mesh.stored) {
                *corners = stored.map(|vertex| vertex + first);
            }
            let count = normals.len() + pose.world.len();
            normals.extend(&pose.normals);
            normals.resize(count, [0.0; 3]);
        }
        measure_normals(shape, &stored, &normals);
    }
}

/// What becomes of a stored face.
#[derive(Clone, Copy)]
enum Fate {
    Kept {
        corners: [u32; 3],
        stored: [u32; 3],
        surface: u32,
    },
    Collapsed,
    Unsound,
}

/// Decides about stored faces.
struct Welding<'a> {
    mesh: &'a PlacedMesh<'a>,
    weld: &'a Weld,
    surface_count: usize,
    /// Spares looking at every position of every face.
    all_finite: bool,
}

impl Welding<'_> {
    fn fate(&self, face: usize) -> Fate {
        // Drop faces with corners or surfaces that are not there.
        let [a, b, c] = self.mesh.triangles[face];
        let surface = self.mesh.surfaces.get(face).copied().unwrap_or(NONE);
        if surface as usize >= self.surface_count || ![a, b, c].into_iter().all(|v| self.sound(v)) {
            return Fate::Unsound;
        }

        // Turn the faces of a mirrored mesh back.
        let corners = if self.mesh.mirrored {
            [a, c, b]
        } else {
            [a, b, c]
        };

        // Drop faces that welding folds to a line.
        let [a, b, c] = self.weld.corners(corners);
        if a == b || b == c || c == a {
            return Fate::Collapsed;
        }
        Fate::Kept {
            corners: [a, b, c],
            stored: corners,
            surface,
        }
    }

    /// Whether a vertex exists and has finite positions.
    fn sound(&self, vertex: u32) -> bool {
        is_sound(self.mesh, self.weld, vertex, self.all_finite)
    }
}

/// Whether a vertex exists and has finite positions; `all_finite` where all have.
fn is_sound(mesh: &PlacedMesh<'_>, weld: &Weld, vertex: u32, all_finite: bool) -> bool {
    let Some(&welded) = weld.of_vertex.get(vertex as usize) else {
        return false;
    };
    let first = weld.first[welded as usize] as usize;
    all_finite || is_finite(&mesh.rest[vertex as usize]) && is_finite(&mesh.world[first])
}

fn is_finite(position: &[f32; 3]) -> bool {
    position.iter().all(|v| v.is_finite())
}

/// Positions, faces and surfaces of the welded mesh, the stored corners of its faces, and how many fell out.
fn weld_faces(
    mesh: &PlacedMesh,
    weld: &Weld,
    surfaces: &[Surface],
) -> (HalfEdgeMesh, Vec<[u32; 3]>, Preparation) {
    // Decide for every face whether it stays.
    let welding = Welding {
        mesh,
        weld,
        surface_count: surfaces.len(),
        all_finite: mesh.rest.par_iter().chain(mesh.world).all(is_finite),
    };
    let faces = 0..mesh.triangles.len();
    let fates: Vec<Fate> = faces
        .into_par_iter()
        .map(|face| welding.fate(face))
        .collect();

    // Take over the positions of welded vertices.
    let position = |&vertex: &u32| Some(mesh.world[vertex as usize]).filter(is_finite);
    let mut part = HalfEdgeMesh {
        positions: weld
            .first
            .par_iter()
            .map(|v| position(v).unwrap_or_default())
            .collect(),
        faces: Vec::with_capacity(fates.len()),
        face_surfaces: Vec::with_capacity(fates.len()),
        ..HalfEdgeMesh::default()
    };

    // Keep the faces that stay, and count the others.
    let mut removed = Preparation::default();
    let mut stored_corners = Vec::with_capacity(part.faces.capacity());
    for fate in fates {
        match fate {
            Fate::Kept {
                corners,
                stored,
                surface,
            } => {
                stored_corners.push(stored);
                part.faces.push(corners);
                part.face_surfaces.push(surface);
            }
            Fate::Collapsed => removed.collapsed_count += 1,
            Fate::Unsound => removed.unsound_count += 1,
        }
    }
    (part, stored_corners, removed)
}

/// Finds edges and twins, after removing faces stored twice, also from their stored corners; gives the number of those.
fn connect(part: &mut HalfEdgeMesh, stored: &mut Vec<[u32; 3]>) -> usize {
    list_edges(part);
    let doubles = doubles(part);
    if !doubles.is_empty() {
        let is_double = |face: u32| doubles.binary_search(&face).is_ok();
        let kept: Vec<usize> = (0..part.faces.len())
            .filter(|&f| !is_double(f as u32))
            .collect();
        part.faces = kept.iter().map(|&face| part.faces[face]).collect();
        *stored = kept.iter().map(|&face| stored[face]).collect();
        part.face_surfaces = kept.iter().map(|&face| part.face_surfaces[face]).collect();
        list_edges(part);
    }
    pair_half_edges(part);
    doubles.len()
}

fn list_edges(part: &mut HalfEdgeMesh) {
    let sides = Sides::of_faces(&part.faces, part.positions.len());
    part.edge_traits = sides.traits;
    part.edge_starts = sides.starts;
    part.edge_sides = sides.half_edges;
    part.edge_ends = sides.ends;
}

/// Faces with the corners of an earlier one, ascending: they share an edge and the corner opposite it.
fn doubles(part: &HalfEdgeMesh) -> Vec<u32> {
    let mut doubles: Vec<u32> = (0..part.edge_count() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .flat_map_iter(|edge| doubles_beside(part, part.sides(edge)))
        .collect();
    doubles.par_sort_unstable();
    doubles.dedup();
    doubles
}

fn doubles_beside(part: &HalfEdgeMesh, sides: &[u32]) -> Vec<u32> {
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
///
/// Threads write where half-edges point to; every entry has one writer, so order does not matter.
fn pair_half_edges(part: &mut HalfEdgeMesh) {
    // Prepare lists that threads can fill.
    let unset = || -> Vec<AtomicU32> {
        let count = part.edge_sides.len();
        (0..count).map(|_| AtomicU32::new(NONE)).collect()
    };
    let (twins, edge_of) = (unset(), unset());
    let set = |list: &[AtomicU32], at: u32, value: u32| {
        list[at as usize].store(value, Ordering::Relaxed);
    };
    let pair = |[a, b]: [u32; 2]| {
        set(&twins, a, b);
        set(&twins, b, a);
    };

    // Pair the two sides of a plain edge; where faces crowd, pair as wedges do.
    let visit = |edge: u32| {
        let sides = part.sides(edge);
        sides.iter().for_each(|&side| set(&edge_of, side, edge));
        match *sides {
            [a, b] if !part.edge_traits[edge as usize].contains(EdgeFlags::FLIPPED) => pair([a, b]),
            [_] | [_, _] => {}
            _ => wedges::pair(part, edge).into_iter().for_each(pair),
        }
    };

    // Visit all edges.
    (0..part.edge_count() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .for_each(visit);
    let numbers = |list: Vec<AtomicU32>| list.into_iter().map(AtomicU32::into_inner).collect();
    (part.twins, part.edge_of) = (numbers(twins), numbers(edge_of));
}

/// Finds changes of material.
fn mark_material_borders(part: &mut HalfEdgeMesh, surfaces: &[Surface]) {
    let traits = (0..part.edge_count() as u32).into_par_iter().map(|edge| {
        let sides = part.sides(edge);
        let material = EdgeFlags::MATERIAL.when(differ_in_material(part, sides, surfaces));
        part.edge_traits[edge as usize] | material
    });
    part.edge_traits = traits.collect();
}

/// Finds degenerate faces and angles.
fn measure_folds(part: &mut HalfEdgeMesh) {
    let mut normals = degenerate_faces::normals(part);
    part.degenerate_faces = degenerate_faces::find(part, &normals);
    for &[degenerate_face, stand_in] in part.degenerate_faces.iter().filter(|s| s[1] != NONE) {
        normals[degenerate_face as usize] = normals[stand_in as usize];
    }
    let measured = (0..part.edge_count() as u32).into_par_iter().map(|edge| {
        let traits = part.edge_traits[edge as usize];
        dihedral_cos(&normals, part.sides(edge), traits)
    });
    part.dihedral_cos = measured.collect();
}

/// Finds the angles between the file's normals, where it has any.
fn measure_normals(part: &mut HalfEdgeMesh, stored: &[[u32; 3]], normals: &[[f32; 3]]) {
    if normals.is_empty() {
        return;
    }

    // Look up the normals of a half-edge, from the lower end to the higher.
    let normal = |corner: usize| {
        let vertex = stored.as_flattened()[corner];
        normals.get(vertex as usize).copied().unwrap_or_default()
    };
    let beside = |side: u32| -> SideNormals {
        let [tail, head] =
            [side, HalfEdgeMesh::following(side)].map(|corner| normal(corner as usize));
        if part.runs_up(side) {
            [tail, head]
        } else {
            [head, tail]
        }
    };

    // Compare both faces' normals in the middle of every edge.
    let cos = |edge: u32| {
        let faces = part.dihedral_cos[edge as usize];
        let [a, b] = *part.sides(edge) else {
            return faces;
        };
        let is_flipped = part.edge_traits[edge as usize].contains(EdgeFlags::FLIPPED);
        cos_between([beside(a), beside(b)], is_flipped).unwrap_or(faces)
    };
    part.normals_cos = (0..part.edge_count() as u32)
        .into_par_iter()
        .with_min_len(4096)
        .map(cos)
        .collect();
}

fn differ_in_material(part: &HalfEdgeMesh, sides: &[u32], surfaces: &[Surface]) -> bool {
    let surface = |side: u32| part.face_surfaces[side as usize / 3];
    let first = surface(sides[0]);
    let differs = |&side: &u32| {
        let other = surface(side);
        other != first && surfaces[other as usize].material != surfaces[first as usize].material
    };
    sides[1..].iter().any(differs)
}

/// Between the normals of two faces, as if they were wound alike; 1 where one has no orientation.
fn dihedral_cos(normals: &[DVec3], sides: &[u32], traits: EdgeFlags) -> f32 {
    let [a, b] = *sides else {
        return 1.0;
    };
    let [a, b] = [a, b].map(|side| normals[side as usize / 3]);
    if a == DVec3::ZERO || b == DVec3::ZERO {
        return 1.0;
    }
    let cos = a.dot(b).clamp(-1.0, 1.0) as f32;
    if traits.contains(EdgeFlags::FLIPPED) {
        -cos
    } else {
        cos
    }
}

/// Sets [`EdgeFlags::MARKED`]; gives the number of marks that lie on no edge.
fn mark(part: &mut HalfEdgeMesh, marks: &[[u32; 2]], weld: &Weld) -> usize {
    let mut lost = 0;
    for &[a, b] in marks {
        let ends = [a, b].map(|v| weld.of_vertex.get(v as usize));
        match ends {
            [Some(&a), Some(&b)] => match find_edge(part, [a.min(b), a.max(b)]) {
                Some(edge) => part.edge_traits[edge] |= EdgeFlags::MARKED,
                None => lost += 1,
            },
            _ => lost += 1,
        }
    }
    lost
}

/// Takes over the polylines of a mesh, each pair of vertices once; gives the number of those that are left out.
fn add_polylines(
    part: &mut HalfEdgeMesh,
    mesh: &PlacedMesh<'_>,
    weld: &Weld,
    surface_count: usize,
) -> usize {
    let mut known = HashSet::with_capacity(mesh.polylines.len());
    for (index, ends) in mesh.polylines.iter().enumerate() {
        // Leave out lines that hang on nothing.
        let surface = mesh.polyline_surfaces.get(index).copied().unwrap_or(NONE);
        let exists = ends.iter().all(|end| is_sound(mesh, weld, *end, false));
        if !exists || surface as usize >= surface_count {
            continue;
        }

        // Keep each pair of vertices once.
        let [a, b] = ends.map(|end| weld.of_vertex[end as usize]);
        if a != b && known.insert([a.min(b), a.max(b)]) {
            part.polylines.push([a, b]);
            part.polyline_surfaces.push(surface);
        }
    }
    mesh.polylines.len() - part.polylines.len()
}

/// The edge between two vertices, by bisection.
fn find_edge(part: &HalfEdgeMesh, ends: [u32; 2]) -> Option<usize> {
    let (mut from, mut to) = (0, part.edge_count());
    while from < to {
        let middle = from + (to - from) / 2;
        let here = part.ends(middle as u32);
        if here == ends {
            return Some(middle);
        }
        if here < ends {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    None
}

/// Moves a part behind what the shape holds.
fn append(shape: &mut HalfEdgeMesh, part: HalfEdgeMesh) {
    let surfaces = std::mem::take(&mut shape.surfaces);
    if shape.positions.is_empty() && shape.faces.is_empty() {
        *shape = part;
    } else {
        extend(shape, part);
    }
    shape.surfaces = surfaces;
}

/// Appends angles of normals; where one of both has none, those of its faces stand for them.
fn extend_normals_cos(shape: &mut HalfEdgeMesh, part: &HalfEdgeMesh) {
    if shape.normals_cos.is_empty() && part.normals_cos.is_empty() {
        return;
    }
    if shape.normals_cos.is_empty() {
        shape.normals_cos.clone_from(&shape.dihedral_cos);
    }
    let added = if part.normals_cos.is_empty() {
        &part.dihedral_cos
    } else {
        &part.normals_cos
    };
    shape.normals_cos.extend(added);
}

fn extend(shape: &mut HalfEdgeMesh, part: HalfEdgeMesh) {
    let total = 3 * (shape.faces.len() + part.faces.len());
    assert!(
        total < NONE as usize,
        "a shape has fewer than 2^32 half-edges"
    );

    // Number the part's vertices, faces and edges behind those of the shape.
    extend_normals_cos(shape, &part);
    let vertex = shape.positions.len() as u32;
    let face = shape.faces.len() as u32;
    let (half_edge, edge) = (3 * face, shape.edge_count() as u32);
    let moved = |number: u32, by: u32| if number == NONE { NONE } else { number + by };

    // Append all lists with their numbers moved.
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
    shape
        .edge_ends
        .extend(part.edge_ends.iter().map(|ends| ends.map(|v| v + vertex)));
    shape.dihedral_cos.extend(part.dihedral_cos);
    shape.edge_traits.extend(part.edge_traits);
    let degenerate_faces = part
        .degenerate_faces
        .iter()
        .map(|&[s, stand_in]| [s + face, moved(stand_in, face)]);
    shape.degenerate_faces.extend(degenerate_faces);

    // Append lines without faces.
    let polylines = part.polylines.iter().map(|ends| ends.map(|v| v + vertex));
    shape.polylines.extend(polylines);
    shape.polyline_surfaces.extend(part.polyline_surfaces);
}
