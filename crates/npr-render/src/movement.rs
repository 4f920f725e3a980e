//! Where the surfaces of a scene were before: what trails of motion follow.

use crate::cutoffs::Cutoffs;
use crate::error::RenderError;
use crate::part_info::PartInfo;
use crate::placement::{self, Bounds};
use glam::Vec3;
use npr_core::budget::Budget;
use npr_core::camera::bounds_of;
use npr_core::geometry::{Part, Triangle};
use npr_scene::Scene;
use npr_stylesheet::Style;
use std::collections::BTreeSet;
use std::sync::Arc;

/// Least way of anything that moves, as a share of the scene's radius: what lies below is rounding.
const STILL_SHARE: f32 = 2e-4;

/// The surfaces of a scene as it stands, and where the same vertices were at moments before.
///
/// It depends on these poses alone, never on a picture that was drawn before. Vertices stand where
/// [`Scene::positions_world`] has them, so skins, morphs and nodes all move them. Motion of the camera is none of
/// theirs. 12 bytes for each vertex and moment.
#[derive(Debug, Clone)]
pub struct Movement {
    /// Seconds before the picture of every moment, in rising order; the first is 0.
    seconds: Vec<f32>,
    /// World positions of all vertices at every moment.
    places: Vec<Vec<[f32; 3]>>,
    /// Positions in the mesh, which stay with the surface.
    anchors: Vec<[f32; 3]>,
    triangles: Vec<Triangle>,
    parts: Vec<PartInfo>,
}

impl Movement {
    /// The surfaces of a scene as it is posed, without moments before. O(vertices + triangles).
    pub fn new(scene: &Scene) -> Self {
        let mut movement = Self {
            seconds: vec![0.0],
            places: vec![positions_of(scene)],
            anchors: Vec::new(),
            triangles: Vec::new(),
            parts: Vec::new(),
        };
        let cutoffs = Cutoffs::of(scene);
        for (object, node) in (0..).zip(&scene.nodes) {
            let mesh = node.mesh.and_then(|mesh| scene.meshes.get(mesh as usize));
            let mirrored = placement::determinant_of(&placement::matrices_of(scene, node)[0]) < 0.0;
            for part in mesh.iter().flat_map(|mesh| &mesh.parts) {
                let info = PartInfo {
                    ids: part.ids.clone(),
                    ..PartInfo::new(scene, object, &node.name, part.material, &cutoffs)
                };
                let (first, number) = (movement.anchors.len() as u32, movement.parts.len() as u32);
                let corners_of = |[a, b, c]: [u32; 3]| match mirrored {
                    true => [a, c, b],
                    false => [a, b, c],
                };
                let drawn = part.triangles.iter().filter(|_| !info.is_invisible());
                movement.triangles.extend(drawn.map(|corners| Triangle {
                    corners: corners_of(*corners).map(|corner| corner + first),
                    part: number,
                }));
                movement.anchors.extend(&part.positions);
                movement.parts.push(info);
            }
        }
        movement
    }

    /// Adds where everything was `seconds` before: the same scene in another pose. Moments come in rising order; one
    /// that does not is left out. O(vertices).
    ///
    /// # Errors
    ///
    /// [`RenderError::OtherMeshes`] for a scene with another number of vertices.
    pub fn add(&mut self, before: &Scene, seconds: f32) -> Result<(), RenderError> {
        let places = positions_of(before);
        let want = self.anchors.len();
        if places.len() != want {
            let have = places.len();
            return Err(RenderError::OtherMeshes { have, want });
        }
        if self.seconds.last().is_some_and(|last| seconds > *last) {
            self.seconds.push(seconds);
            self.places.push(places);
        }
        Ok(())
    }

    /// The movement that a style needs, of a scene that `stand` poses: called with seconds before the picture, at first
    /// and at last with 0, so that the scene is left as it stands in the picture. `None` where nothing of the style
    /// follows motion; the scene is not posed then.
    ///
    /// # Errors
    ///
    /// [`RenderError::Memory`] where all places take more than `memory_limit` bytes; the scene is not posed then. Those
    /// of [`Movement::add`].
    pub fn of_style(
        scene: &mut Scene,
        (style, memory_limit): (&Style, u64),
        mut stand: impl FnMut(&mut Scene, f32),
    ) -> Result<Option<Arc<Self>>, RenderError> {
        let moments = style.moments_s();
        if moments.is_empty() {
            return Ok(None);
        }
        let meshes = scene
            .nodes
            .iter()
            .filter_map(|node| scene.meshes.get(node.mesh? as usize));
        let parts = meshes.flat_map(|mesh| &mesh.parts);
        let vertices: usize = parts.map(|part| part.positions.len()).sum();
        // Where they are now, where they lie in their meshes, and where they were.
        let bytes = (moments.len() + 2) * size_of::<[f32; 3]>();
        Budget::new(memory_limit).take("the motion of a scene", vertices, bytes)?;

        stand(scene, 0.0);
        let mut movement = Self::new(scene);
        for seconds in moments {
            stand(scene, seconds);
            movement.add(scene, seconds)?;
        }
        stand(scene, 0.0);
        Ok(Some(Arc::new(movement)))
    }

    /// World positions of all vertices as they stand in the picture.
    pub(crate) fn now(&self) -> &[[f32; 3]] {
        &self.places[0]
    }

    pub(crate) fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    pub(crate) fn parts(&self) -> &[PartInfo] {
        &self.parts
    }

    /// The box around the scene as it stands.
    pub(crate) fn bounds(&self) -> Bounds {
        bounds_of(self.now().iter().copied().map(Vec3::from))
    }

    /// What rasterisers need of the parts: which sides are seen. Cut-out parts are whole here.
    pub(crate) fn flat_parts(&self, style: &Style) -> Vec<Part> {
        let flag = |bit: u32, is_set: bool| if is_set { bit } else { 0 };
        let part = |info: &PartInfo| Part {
            flags: flag(Part::DOUBLE_SIDED, info.double_sided)
                | flag(Part::BEAM, info.is_beam(style)),
            ..Part::default()
        };
        self.parts.iter().map(part).collect()
    }

    /// The two moments around a time before the picture, and the share of the second; the last one beyond it.
    fn moments_around(&self, seconds: f32) -> ([usize; 2], f32) {
        let after = self.seconds.iter().position(|moment| *moment >= seconds);
        let after = after.unwrap_or(self.seconds.len() - 1);
        let before = after.saturating_sub(1);
        let [near, far] = [before, after].map(|moment| self.seconds[moment]);
        let share = (seconds - near) / (far - near).max(f32::MIN_POSITIVE);
        ([before, after], share.clamp(0.0, 1.0))
    }

    /// Where a point of a triangle was some seconds before the picture, by the shares of its corners: on the straight
    /// line between the moments around that.
    pub(crate) fn place_before(&self, triangle: u32, weights: [f32; 3], seconds: f32) -> Vec3 {
        let (moments, share) = self.moments_around(seconds);
        let corners = self.triangles[triangle as usize].corners;
        let [near, far] = moments.map(|moment| weighted(&self.places[moment], corners, weights));
        near.lerp(far, share)
    }

    /// Where all vertices were some seconds before the picture, likewise.
    pub(crate) fn places_before(&self, seconds: f32) -> Vec<[f32; 3]> {
        let ([near, far], share) = self.moments_around(seconds);
        let places = self.places[near].iter().zip(&self.places[far]);
        let between = places.map(|(a, b)| Vec3::from(*a).lerp(Vec3::from(*b), share));
        between.map(|place| place.to_array()).collect()
    }

    /// Where a point of a triangle lies in its mesh.
    pub(crate) fn anchor(&self, triangle: u32, weights: [f32; 3]) -> Vec3 {
        let corners = self.triangles[triangle as usize].corners;
        weighted(&self.anchors, corners, weights)
    }

    /// Whether anything of each part's object moves. O(vertices x moments).
    pub(crate) fn is_moving(&self) -> Vec<bool> {
        let least = STILL_SHARE * placement::radius_of(self.bounds());
        let far = |v: u32| {
            let now = Vec3::from(self.now()[v as usize]);
            let mut before = self.places[1..].iter();
            before.any(|places| now.distance(Vec3::from(places[v as usize])) > least)
        };
        let mut moving = BTreeSet::new();
        for triangle in &self.triangles {
            let object = self.parts[triangle.part as usize].object;
            if !moving.contains(&object) && triangle.corners.into_iter().any(far) {
                moving.insert(object);
            }
        }
        let objects = self.parts.iter().map(|info| moving.contains(&info.object));
        objects.collect()
    }

    /// How much longer things of each part are in the world than in its mesh, roughly. O(vertices).
    pub(crate) fn scales(&self) -> Vec<f32> {
        let mut boxes = vec![[(Vec3::MAX, Vec3::MIN); 2]; self.parts.len()];
        for triangle in &self.triangles {
            for v in triangle.corners.map(|v| v as usize) {
                let places = [self.anchors[v], self.now()[v]].map(Vec3::from);
                for ((low, high), place) in boxes[triangle.part as usize].iter_mut().zip(places) {
                    (*low, *high) = (low.min(place), high.max(place));
                }
            }
        }
        let scale = |[mesh, world]: [(Vec3, Vec3); 2]| {
            let [mesh, world] = [mesh, world].map(|(low, high)| (high - low).length());
            let scale = world / mesh;
            if scale.is_finite() && scale > 0.0 {
                scale
            } else {
                1.0
            }
        };
        boxes.into_iter().map(scale).collect()
    }
}

fn weighted(places: &[[f32; 3]], corners: [u32; 3], weights: [f32; 3]) -> Vec3 {
    let sum = corners.into_iter().zip(weights);
    sum.fold(Vec3::ZERO, |sum, (corner, weight)| {
        sum + Vec3::from(places[corner as usize]) * weight
    })
}

/// World positions of all vertices of all nodes, in their order.
fn positions_of(scene: &Scene) -> Vec<[f32; 3]> {
    let drawn = scene.nodes.iter().filter_map(|node| {
        let mesh = scene.meshes.get(node.mesh? as usize)?;
        Some((node, mesh))
    });
    drawn
        .flat_map(|(node, mesh)| mesh.parts.iter().map(move |part| (node, part)))
        .flat_map(|(node, part)| scene.positions_world(node, part))
        .collect()
}
