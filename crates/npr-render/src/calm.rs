//! Normals that tones are cut with.

use crate::kept::input_of;
use crate::model::Model;
use npr_mesh::calm::Shaded;

/// The normal of every vertex of a model, averaged as far as `share` of its radius; kept where there is a folder for
/// it. The pose is that of the moment.
pub(crate) fn shading_normals(model: &Model, share: f32) -> Vec<[f32; 3]> {
    let vertices = model.vertices.iter().zip(&model.influences);
    let positions: Vec<[f32; 3]> = vertices
        .map(|(vertex, influence)| model.posed_point(vertex, influence).to_array())
        .collect();
    let normals: Vec<[f32; 3]> = model.vertices.iter().map(|vertex| vertex.normal).collect();
    let radius = model.radius();
    let bends: Vec<f32> = model
        .vertices
        .iter()
        .map(|vertex| {
            vertex
                .curvatures
                .map(f32::abs)
                .into_iter()
                .fold(0.0, f32::max)
                / radius
        })
        .collect();
    let objects: Vec<u32> = model
        .vertices
        .iter()
        .map(|vertex| {
            model
                .parts
                .get(vertex.part as usize)
                .map_or(0, |part| part.object)
        })
        .collect();
    let triangles: Vec<[u32; 3]> = model
        .triangles
        .iter()
        .map(|triangle| triangle.corners)
        .collect();
    let reach = share * radius;
    let input = || {
        let mut hash = input_of("calm normals");
        hash.positions(&positions);
        hash.positions(&normals);
        hash.numbers(&bends.iter().map(|bend| bend.to_bits()).collect::<Vec<_>>());
        hash.numbers(&objects);
        hash.numbers(triangles.as_flattened());
        hash.numbers(&[reach.to_bits()]);
        hash
    };
    let is_sound = |kept: &[[f32; 3]]| {
        kept.len() == normals.len() && kept.iter().flatten().all(|x| x.abs() <= 1.001)
    };
    let surface = Shaded {
        positions: &positions,
        normals: &normals,
        bends: &bends,
        objects: &objects,
        triangles: &triangles,
    };
    model
        .cache
        .rows(input, is_sound, || surface.calm_normals(reach))
}
