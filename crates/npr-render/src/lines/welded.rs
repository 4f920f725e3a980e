//! Builds the one welded surface that the lines of a scene are drawn of.

use super::LineModelOptions;
use super::assembly::{Assembly, place_key};
use crate::error::RenderError;
use crate::part_info::PartInfo;
use npr_core::budget::Budget;
use npr_core::edge_flags::EdgeFlags;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::shape::{PosableMesh, Preparation, add_posable_mesh};
use npr_scene::Scene;

/// Bytes of a shape and its hierarchy for every triangle, its three half-edges and its share of the vertices.
const BYTES_PER_TRIANGLE: usize = 284;

/// Bytes of a line segment: with its links in a shape, and with its visible parts in a view.
pub(super) const BYTES_PER_POLYLINE: usize = 320;

/// Bytes of a stored vertex: where it rests, where it stands, its place in the shape, and its number for poses.
const BYTES_PER_VERTEX: usize = 56;

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

/// What a line model keeps of its meshes, so that they can take other poses.
#[derive(Debug, Clone, Default)]
pub(super) struct Posables {
    /// The meshes, in the order of the nodes that they are drawn at.
    pub meshes: Vec<PosableMesh>,
    /// Of every mesh: the stored vertices that triangles and lines use, which views frame.
    pub used: Vec<Vec<u32>>,
    /// Of every mesh: how many vertices are stored.
    pub vertex_counts: Vec<usize>,
    /// Of every point of a card's line: how far it lies from the vertex that it has its colour of.
    pub card_offsets: Vec<[f32; 3]>,
}

/// The welded shape of an assembly, what became of its meshes, and what other poses need of them.
pub(super) struct Built {
    pub shape: HalfEdgeMesh,
    pub preparation: Preparation,
    pub posables: Posables,
}

/// Welds an assembly to a shape.
pub(super) fn build(assembly: &Assembly, options: &LineModelOptions) -> Built {
    let mut shape = HalfEdgeMesh {
        surfaces: assembly.surfaces(),
        ..HalfEdgeMesh::default()
    };
    let mut preparation = Preparation::default();
    let mut posables = Posables::default();
    for mesh in &assembly.meshes {
        let (added, posable) = add_posable_mesh(&mut shape, &mesh.view(), options.weld);
        preparation += added;
        posables.meshes.push(posable);
        posables.used.push(mesh.used());
        posables.vertex_counts.push(mesh.vertex_count());
    }
    Built {
        shape,
        preparation,
        posables,
    }
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

/// Notices of what lines do not show of a scene, or show otherwise.
pub(super) fn notices_of(
    scene: &Scene,
    assembly: &Assembly,
    preparation: &Preparation,
) -> Vec<String> {
    let mut notices: Vec<String> = scene.notices.iter().map(ToString::to_string).collect();
    let cut_out = |info: &PartInfo| info.alpha_cutoff.is_some() && info.base_color[3] >= 1.0;
    if let Some(info) = assembly.parts.iter().find(|info| cut_out(info)) {
        notices.push(format!(
            "material '{}' may be cut out by its texture, but lines follow its triangles",
            info.material_name
        ));
    }
    notices.extend(faults_of(preparation));
    notices
}

/// What an artist may want to mend in the meshes of a scene, in one sentence. What welding does to every mesh is none
/// of it.
fn faults_of(preparation: &Preparation) -> Option<String> {
    let counted = |count: usize, one: &str, more: &str| {
        let what = if count == 1 { one } else { more };
        (count > 0).then(|| format!("{count} {what}"))
    };
    let faults = [
        counted(
            preparation.double_count,
            "face that is stored twice and drawn once",
            "faces that are stored twice and drawn once",
        ),
        counted(
            preparation.flipped_count,
            "edge whose faces are wound against each other, where contours may be wrong",
            "edges whose faces are wound against each other, where contours may be wrong",
        ),
        counted(
            preparation.lost_mark_count,
            "marked line that is no edge of a mesh",
            "marked lines that are no edges of a mesh",
        ),
        counted(
            preparation.lost_polyline_count,
            "line segment that is left out, because it has no length or is stored twice",
            "line segments that are left out, because they have no length or are stored twice",
        ),
    ];
    let faults: Vec<String> = faults.into_iter().flatten().collect();
    (!faults.is_empty()).then(|| format!("the meshes have {}", faults.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_can_be_mended_is_told() {
        let clean = Preparation {
            boundary_count: 4,
            non_manifold_count: 1,
            collapsed_count: 2,
            ..Preparation::default()
        };
        assert_eq!(faults_of(&clean), None);
        let faulty = Preparation {
            double_count: 1,
            lost_mark_count: 2,
            ..clean
        };
        let sentence = "the meshes have 1 face that is stored twice and drawn once; \
                        2 marked lines that are no edges of a mesh";
        assert_eq!(faults_of(&faulty).as_deref(), Some(sentence));
    }
}
