//! Normals that tones are cut with.

use crate::kept::input_of;
use crate::model::Model;
use glam::Vec3;
use npr_core::geometry::Vertex;
use npr_mesh::calm::Shaded;
use npr_mesh::curvature::tightest;
use std::sync::{Arc, PoisonError};

/// What has to be added to the normal of every vertex, and made unit length, to average it as far as `share` of the
/// model's radius; kept for the next style with this share, and where there is a folder for it.
///
/// Measured on the meshes as they were prepared, whatever the pose: what moves keeps the same calm.
pub(crate) fn calming(model: &Model, share: f32) -> Arc<Vec<Vec3>> {
    let mut last = model.calmed.lock().unwrap_or_else(PoisonError::into_inner);
    match &*last {
        Some((of, calming)) if *of == share.to_bits() => Arc::clone(calming),
        _ => {
            let found = Arc::new(find_calming(model, share));
            *last = Some((share.to_bits(), Arc::clone(&found)));
            found
        }
    }
}

fn find_calming(model: &Model, share: f32) -> Vec<Vec3> {
    // Gather the meshes, in lengths of the world.
    let vertices = model.unmorphed();
    let object_of = |vertex: &Vertex| {
        let part = model.parts.get(vertex.part as usize);
        part.map_or(0, |part| part.object)
    };
    let positions: Vec<[f32; 3]> = vertices
        .iter()
        .map(|vertex| {
            let scale = model.scale_of(object_of(vertex));
            vertex.position.map(|x| x * scale)
        })
        .collect();
    let normals: Vec<[f32; 3]> = vertices.iter().map(|vertex| vertex.normal).collect();
    let radius = model.radius();
    let bends: Vec<f32> = vertices
        .iter()
        .map(|vertex| tightest(vertex.curvatures) / radius)
        .collect();
    let objects: Vec<u32> = vertices.iter().map(object_of).collect();
    let triangles: Vec<[u32; 3]> = model
        .triangles
        .iter()
        .map(|triangle| triangle.corners)
        .collect();
    let reach = share * radius;

    // Average their normals.
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
    let calm = model
        .cache
        .rows(input, is_sound, || surface.calm_normals(reach));
    let both = calm.iter().zip(&normals);
    both.map(|(calm, normal)| Vec3::from(*calm) - Vec3::from(*normal))
        .collect()
}

/// A normal with what calms it, of unit length.
pub(crate) fn calmed(normal: [f32; 3], calming: Vec3) -> [f32; 3] {
    if calming == Vec3::ZERO {
        return normal;
    }
    let sum = Vec3::from(normal) + calming;
    sum.try_normalize().map_or(normal, |sum| sum.to_array())
}
