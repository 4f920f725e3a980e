//! Cameras that nodes of the scene carry.
#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

use std::convert::Infallible;
use std::f32::consts::PI;

use ::gltf::json::camera::{Camera as JsonCamera, Orthographic, Perspective};
use ::gltf::json::{Index, Root};

use super::tree::Tree;
use crate::camera::{Camera, Projection};
use crate::loading::Loading;
use crate::pool::Pool;
use crate::scene::Scene;

/// Reads the cameras that kept nodes carry; one that cannot project is left out with a notice.
pub(crate) fn read(root: &Root, tree: &Tree, scene: &mut Scene, loading: &mut Loading) {
    let mut cameras = Pool::default();
    for (_, source, node) in tree.nodes_with_source(root, scene) {
        let Some(index) = source.camera.as_ref().map(Index::value) else {
            continue;
        };
        let Ok(place) = cameras.place(index, || {
            Ok::<_, Infallible>(root.cameras.get(index).and_then(camera))
        });
        node.camera = place;
        if place.is_none() {
            loading.notices.add(format!(
                "camera {index} is missing or has values out of range and is left out"
            ));
        }
    }
    scene.cameras = cameras.items;
}

fn camera(source: &JsonCamera) -> Option<Camera> {
    let projection = projection(source)?;
    Some(Camera {
        name: source.name.clone().unwrap_or_default(),
        projection,
    })
}

fn projection(camera: &JsonCamera) -> Option<Projection> {
    match (&camera.perspective, &camera.orthographic) {
        (Some(perspective), _) => perspective_of(perspective),
        (None, Some(orthographic)) => orthographic_of(orthographic),
        (None, None) => None,
    }
}

fn perspective_of(source: &Perspective) -> Option<Projection> {
    let &Perspective {
        yfov,
        znear,
        zfar,
        aspect_ratio: aspect,
        ..
    } = source;
    let is_sound = yfov > 0.0
        && yfov < PI
        && is_positive(znear)
        && zfar.is_none_or(|zfar| zfar > znear)
        && aspect.is_none_or(is_positive);
    is_sound.then_some(Projection::Perspective {
        yfov,
        znear,
        zfar: zfar.filter(|zfar| zfar.is_finite()),
        aspect,
    })
}

fn orthographic_of(source: &Orthographic) -> Option<Projection> {
    let &Orthographic {
        xmag,
        ymag,
        znear,
        zfar,
        ..
    } = source;
    let (xmag, ymag) = (xmag.abs(), ymag.abs());
    let is_sound =
        is_positive(xmag) && is_positive(ymag) && znear >= 0.0 && zfar > znear && zfar.is_finite();
    is_sound.then_some(Projection::Orthographic {
        xmag,
        ymag,
        znear,
        zfar,
    })
}

fn is_positive(value: f32) -> bool {
    value > 0.0 && value.is_finite()
}
