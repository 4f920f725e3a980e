//! What a picture shows of what moves and what does not, on a grid of fixed size.

use crate::movement::Movement;
use glam::{Mat4, Vec2, Vec3};
use npr_core::geometry::{Part, Triangle};
use npr_core::raster::{Fill, Sides, fill_triangles, triangle_of};
use npr_core::window::{View, Window};
use npr_stylesheet::Style;

/// Longer side of the grid: as many cells in pictures of any size.
const GRID_PX: u32 = 1280;

/// How much nearer to the eye than a line a surface has to be to cover it, as a share of the reversed depth.
const COVER_ROOM: f32 = 0.01;

/// What a grid over the picture shows.
pub(crate) struct Seen<'a> {
    pub view: &'a View,
    clip_from_world: Mat4,
    world_from_clip: Mat4,
    /// Pixels per unit of the world in the middle of the scene.
    pub world_px: f32,
    window: Window,
    /// Cells along both sides.
    pub size: [u32; 2],
    /// Numbers of triangles, and reversed depths; 0 where there is no surface.
    ids: Vec<u32>,
    depths: Vec<f32>,
    /// The triangles and what they are parts of.
    triangles: &'a [Triangle],
    parts: Vec<Part>,
    is_moving: &'a [bool],
    /// The vertices in clip space.
    pub clip: Vec<[f32; 4]>,
}

impl<'a> Seen<'a> {
    /// What a view shows as the scene stands; `is_moving` tells for each part whether its object moves. O(vertices +
    /// triangles).
    pub fn new(
        (movement, is_moving): (&'a Movement, &'a [bool]),
        style: &Style,
        view: &'a View,
        size: [u32; 2],
    ) -> Self {
        // Lay a grid over the picture.
        let longer = size[0].max(size[1]).max(1) as f32;
        let side = |px: u32| ((px as f32 * GRID_PX as f32 / longer).round() as u32).max(1);
        let size = size.map(side);
        let clip_from_world = Mat4::from_cols_array_2d(&view.clip_from_world);
        let mut seen = Self {
            view,
            clip_from_world,
            world_from_clip: clip_from_world.inverse(),
            world_px: pixels_per_unit(view, movement),
            window: Window::over(view.frame_px, [0.0; 2], view.frame_px, size),
            size,
            ids: Vec::new(),
            depths: Vec::new(),
            triangles: movement.triangles(),
            parts: movement.flat_parts(style),
            is_moving,
            clip: Vec::new(),
        };

        // Draw the surfaces on it.
        let (ids, depths, clip) = seen.drawn(seen.triangles, movement.now());
        (seen.ids, seen.depths, seen.clip) = (ids, depths, clip);
        seen
    }

    /// The numbers of the triangles that cells show, their reversed depths, and the vertices in clip space.
    fn drawn(
        &self,
        triangles: &[Triangle],
        places: &[[f32; 3]],
    ) -> (Vec<u32>, Vec<f32>, Vec<[f32; 4]>) {
        let places = places.iter().map(|place| Vec3::from(*place));
        let clip: Vec<[f32; 4]> = places
            .map(|place| (self.clip_from_world * place.extend(1.0)).to_array())
            .collect();
        let fill = Fill {
            window: &self.window,
            triangles,
            parts: &self.parts,
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |v| clip[v as usize],
            keep: |_, _, _| true,
        };
        let count = self.size[0] as usize * self.size[1] as usize;
        let (mut ids, mut depths) = (vec![0; count], vec![0; count]);
        fill_triangles(&fill, &mut ids, &mut depths);
        (ids, depths.into_iter().map(f32::from_bits).collect(), clip)
    }

    /// Reversed depths of what moves, where it stood at other places; 0 where none of it was. O(vertices + triangles).
    pub fn movers_at(&self, places: &[[f32; 3]]) -> Vec<f32> {
        let is_finite = |triangle: &Triangle| {
            let corners = triangle.corners.map(|corner| places[corner as usize]);
            corners.as_flattened().iter().all(|v| v.is_finite())
        };
        let moving = self.triangles.iter().copied();
        let moving = moving.filter(|triangle| self.is_moving[triangle.part as usize]);
        let moving: Vec<Triangle> = moving.filter(is_finite).collect();
        self.drawn(&moving, places).1
    }

    /// Pixels of the picture to a cell of the grid.
    pub fn step_px(&self) -> f32 {
        let longer = self.view.frame_px[0].max(self.view.frame_px[1]);
        longer / self.size[0].max(self.size[1]) as f32
    }

    /// The cell at a place of the picture; none outside.
    pub fn cell(&self, place: Vec2) -> Option<usize> {
        let grid = Vec2::from(self.size.map(|side| side as f32));
        let at = (place / Vec2::from(self.view.frame_px) * grid).floor();
        let inside = at.cmpge(Vec2::ZERO).all() && at.cmplt(grid).all();
        inside.then(|| at.y as usize * self.size[0] as usize + at.x as usize)
    }

    /// The middle of a cell in the picture, in pixels.
    pub fn place_of(&self, cell: usize) -> Vec2 {
        let width = self.size[0];
        Vec2::from(
            self.window
                .frame_at(cell as u32 % width, cell as u32 / width),
        )
    }

    /// The triangle that a cell shows; none where there is no surface.
    pub fn triangle(&self, cell: usize) -> Option<u32> {
        (self.ids[cell] != 0).then(|| triangle_of(self.ids[cell]))
    }

    /// Whether a cell shows something that moves.
    pub fn is_mover(&self, cell: usize) -> bool {
        let part = |number: u32| self.triangles[number as usize].part as usize;
        self.triangle(cell)
            .is_some_and(|number| self.is_moving[part(number)])
    }

    /// Whether a surface lies before a reversed depth in a cell.
    pub fn is_hidden(&self, cell: usize, reversed: f32) -> bool {
        self.depths[cell] > reversed * (1.0 + COVER_ROOM)
    }

    /// Where a place of the world lies in the picture, and its reversed depth; none behind the eye.
    pub fn place_px(&self, world: Vec3) -> Option<(Vec2, f32)> {
        let clip = self.clip_from_world * world.extend(1.0);
        let ndc = Vec2::new(clip.x, -clip.y) / clip.w;
        let px = (ndc + 1.0) * 0.5 * Vec2::from(self.view.frame_px);
        let is_before_eye = clip.w > 0.0 && clip.z <= clip.w;
        (is_before_eye && px.is_finite()).then_some((px, clip.z / clip.w))
    }

    /// The place of the world at one of the picture and a reversed depth.
    pub fn world_at(&self, place: Vec2, reversed: f32) -> Vec3 {
        let [x, y] = self.view.ndc_at(place.to_array());
        let place = Vec3::new(x, y, reversed);
        let world = self.world_from_clip.project_point3(place);
        if world.is_finite() { world } else { Vec3::ZERO }
    }

    /// Distance of a place of the world from the eye along the view axis.
    pub fn depth(&self, world: Vec3) -> f32 {
        (world - Vec3::from(self.view.eye_world)).dot(Vec3::from(self.view.forward_world))
    }
}

/// Pixels per unit of the world in the middle of the scene.
fn pixels_per_unit(view: &View, movement: &Movement) -> f32 {
    let (low, high) = movement.bounds();
    let middle = (Vec3::from(low) + Vec3::from(high)) * 0.5;
    let depth = (middle - Vec3::from(view.eye_world)).dot(Vec3::from(view.forward_world));
    let world_px = view.pixels_per_unit(depth.max(view.near));
    if world_px.is_finite() { world_px } else { 1.0 }
}
