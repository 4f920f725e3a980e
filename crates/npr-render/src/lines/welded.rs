//! From what a scene has to the one surface that lines are drawn of.

use super::LineModelOptions;
use super::assembly::{Assembly, place_key};
use crate::error::RenderError;
use crate::part_info::PartInfo;
use npr_core::budget::Budget;
use npr_core::edge_flags::EdgeFlags;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_scene::Scene;

/// Bytes of a shape and its hierarchy for every triangle, its three half-edges and its share of the vertices.
const BYTES_PER_TRIANGLE: usize = 260;

/// Bytes of a line segment in a shape, linked, and in a view with what is seen of it.
const BYTES_PER_POLYLINE: usize = 320;

/// Bytes of a stored vertex: where it rests, where it stands, and its place in the shape.
const BYTES_PER_VERTEX: usize = 48;

/// Refuses scenes that memory or the numbers of half-edges have no room for.
pub(super) fn check_budget(
    assembly: &Assembly,
    options: &LineModelOptions,
) -> Result<(), RenderError> {
    let half_edges = 3 * assembly.triangle_count();
    crate::error::check_count("half-edges", half_edges, assembly.polyline_count())?;
    let mut budget = Budget::new(options.memory_limit);
    budget.take("vertices", assembly.vertex_count(), BYTES_PER_VERTEX)?;
    budget.take(
        "triangles with their edges",
        assembly.triangle_count(),
        BYTES_PER_TRIANGLE,
    )?;
    budget.take(
        "line segments",
        assembly.polyline_count(),
        BYTES_PER_POLYLINE,
    )?;
    Ok(())
}

/// The welded shape of an assembly.
pub(super) fn build(assembly: &Assembly, options: &LineModelOptions) -> HalfEdgeMesh {
    let mut shape = HalfEdgeMesh {
        surfaces: assembly.surfaces(),
        ..HalfEdgeMesh::default()
    };
    for mesh in &assembly.meshes {
        npr_mesh::shape::add_mesh(&mut shape, &mesh.view(), options.weld);
    }
    shape
}

/// Marks the edges where a material that asks for lines meets another.
pub(super) fn mark_materials(shape: &mut HalfEdgeMesh, marked: &[bool]) {
    if !marked.contains(&true) {
        return;
    }
    for edge in 0..shape.edge_count() as u32 {
        let asks = |side: &u32| marked[shape.face_surfaces[*side as usize / 3] as usize];
        let meets = shape.edge_traits[edge as usize].contains(EdgeFlags::MATERIAL);
        if meets && shape.sides(edge).iter().any(asks) {
            shape.edge_traits[edge as usize] |= EdgeFlags::MARKED;
        }
    }
}

/// The colour of every vertex of a shape; empty where the scene has no colours.
pub(super) fn colors_of(shape: &HalfEdgeMesh, assembly: &Assembly) -> Vec<u32> {
    let colors = assembly.colors();
    if colors.is_empty() {
        return Vec::new();
    }
    let color_at = |position: &[f32; 3]| {
        let found = colors.binary_search_by_key(&place_key(*position), |(place, _)| *place);
        found.map_or(u32::MAX, |index| colors[index].1)
    };
    shape.positions.iter().map(color_at).collect()
}

/// What of a scene lines do not show, for the user.
pub(super) fn notices_of(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let mut notices: Vec<String> = scene.notices.iter().map(ToString::to_string).collect();
    let cut_out = |info: &PartInfo| info.alpha_cutoff.is_some() && info.base_color[3] >= 1.0;
    if let Some(info) = assembly.parts.iter().find(|info| cut_out(info)) {
        notices.push(format!(
            "material '{}' may be cut out by its texture, but lines follow its triangles",
            info.material_name
        ));
    }
    notices
}
