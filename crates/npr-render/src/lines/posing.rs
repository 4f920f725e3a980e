//! A line model that moves: its vertices in other poses, with everything that hangs on them and nothing else made anew.

use super::model::LineModel;
use super::recent::RecentViews;
use super::smoke;
use crate::error::RenderError;
use crate::file_light;
use crate::kept::Cache;
use crate::placement;
use glam::Vec3;
use npr_mesh::shape::{MeshPose, set_pose};
use npr_scene::{Mesh, Scene};
use std::sync::{Mutex, OnceLock};

impl LineModel {
    /// Keeps what is seen in the last `count` views, which drawings of them in another look then need not find anew.
    pub fn keep_views(&mut self, count: usize) {
        self.recent = RecentViews::of(count);
    }

    /// Moves the model into the pose of a scene: the one that it was made of, with other places of nodes and joints,
    /// and other weights of morphs ([`Scene::set_pose`]).
    ///
    /// Nothing is welded, sorted or paired anew: vertices, faces, edges, surfaces and the ids of strokes stay.
    /// Positions follow, and what hangs on them: folds and with them creases, faces without area, curvature and with
    /// it widths, intersections; they are those of the posed surface, and made when a view first asks for them.
    /// Bounds, lights and cameras follow too. A folder for what is costly is not used any more: a film would fill it.
    ///
    /// Lines are those of a model made of the posed scene, bit for bit, but for this: the radius that lengths are
    /// measured in stays that of the first pose; vertices that morphs bring together stay apart, and those that they
    /// part stay one; a mesh that is turned inside out keeps the winding that it had; points of the centre lines of
    /// cards move with the nearest vertex, which bends a line by less than a card is wide; textures and colours of
    /// vertices stay where they were on the surface. O(vertices + edges), parallel.
    ///
    /// # Errors
    ///
    /// [`RenderError::OtherScene`] for a scene of other meshes; the model then stays as it is.
    pub fn set_pose(&mut self, scene: &Scene) -> Result<(), RenderError> {
        // Place the meshes.
        let poses = poses_of(scene);
        let counts = poses.iter().map(|pose| pose.world.len());
        if !counts.eq(self.posables.vertex_counts.iter().copied()) {
            let sum = |counts: &[usize]| counts.iter().sum();
            let have: Vec<usize> = poses.iter().map(|pose| pose.world.len()).collect();
            return Err(RenderError::OtherMeshes {
                have: sum(&have),
                want: sum(&self.posables.vertex_counts),
            });
        }

        // Keep the radius of the first pose, then move.
        self.first_radius
            .get_or_insert(placement::radius_of(self.bounds));
        self.first_positions
            .get_or_insert_with(|| self.shape.positions.clone());
        set_pose(&mut self.shape, &self.posables.meshes, &poses);
        let used = poses
            .iter()
            .zip(&self.posables.used)
            .flat_map(|(pose, used)| {
                let placed = used.iter().map(|vertex| pose.world[*vertex as usize]);
                placed.collect::<Vec<_>>()
            });
        self.points = used.collect();
        self.move_cards();

        // Settle what depends on all of it.
        let bounds = npr_core::camera::bounds_of(self.points.iter().copied().map(Vec3::from));
        self.lights = file_light::of_scene(scene, bounds);
        self.bounds = smoke::joined(self.smoke.as_ref(), bounds, self.points.is_empty());
        self.cameras = placement::cameras_of(scene);

        // Forget what was made of the pose before.
        self.prepared = Mutex::new(None);
        self.recent = self.recent.emptied();
        self.bends = OnceLock::new();
        self.cache = Cache::of(None);
        Ok(())
    }

    /// A copy of the model, for poses of its own.
    pub(super) fn to_pose(&self) -> Self {
        Self {
            shape: self.shape.clone(),
            parts: self.parts.clone(),
            colors: self.colors.clone(),
            points: self.points.clone(),
            bounds: self.bounds,
            first_radius: self.first_radius,
            first_positions: self.first_positions.clone(),
            posables: self.posables.clone(),
            cameras: self.cameras.clone(),
            lights: self.lights.clone(),
            smoke: self.smoke.clone(),
            notices: self.notices.clone(),
            triangle_count: self.triangle_count,
            memory_limit: self.memory_limit,
            cache: self.cache.clone(),
            prepared: Mutex::new(None),
            recent: self.recent.emptied(),
            bends: OnceLock::new(),
            map: self.map.clone(),
            fill_lights: self.fill_lights.clone(),
            pictures: self.pictures.clone(),
        }
    }

    /// Notes how far the points of cards' lines lie from their vertices.
    pub(super) fn note_card_offsets(&mut self) {
        let shape = &self.shape;
        let points = shape.cards.points().iter().zip(shape.cards.vertices());
        let offsets = points.map(|(point, vertex)| {
            let [from, to] = [point.vertex as usize, vertex].map(|v| shape.positions[v]);
            std::array::from_fn(|axis| to[axis] - from[axis])
        });
        self.posables.card_offsets = offsets.collect();
    }

    /// Moves the points of cards' lines with their vertices.
    fn move_cards(&mut self) {
        let points = self
            .shape
            .cards
            .points()
            .iter()
            .zip(self.shape.cards.vertices());
        let places = points.zip(&self.posables.card_offsets);
        let moved: Vec<(usize, [f32; 3])> = places
            .map(|((point, vertex), offset)| {
                let from = self.shape.positions[point.vertex as usize];
                (
                    vertex,
                    std::array::from_fn(|axis| from[axis] + offset[axis]),
                )
            })
            .collect();
        for (vertex, place) in moved {
            self.shape.positions[vertex] = place;
        }
    }
}

/// Where the vertices of all meshes stand, in the order of their nodes, with the file's normals.
fn poses_of(scene: &Scene) -> Vec<MeshPose> {
    let drawn = scene.nodes.iter().filter_map(|node| {
        let mesh = scene.meshes.get(node.mesh? as usize)?;
        Some((node, mesh))
    });
    drawn
        .map(|(node, mesh)| {
            let parts = mesh.parts.iter();
            MeshPose {
                world: parts
                    .flat_map(|part| scene.positions_world(node, part))
                    .collect(),
                normals: normals_of(mesh),
            }
        })
        .collect()
}

/// The file's normals of a mesh, zero where a part has none; empty where none has any.
fn normals_of(mesh: &Mesh) -> Vec<[f32; 3]> {
    if mesh.parts.iter().all(|part| part.normals.is_none()) {
        return Vec::new();
    }
    let normals = mesh.parts.iter().flat_map(|part| match &part.normals {
        Some(normals) => normals.clone(),
        None => vec![[0.0; 3]; part.positions.len()],
    });
    normals.collect()
}

#[cfg(test)]
mod tests;
