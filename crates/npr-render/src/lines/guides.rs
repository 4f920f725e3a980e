//! Where the guides of a style lie in a view.

use super::model::LineModel;
use glam::Vec3;
use npr_drawing::guides::Guide;
use npr_stylesheet::Style;
use npr_vector::project::Projector;
use rayon::prelude::*;

impl LineModel {
    /// The guides of a style in a view: each lies on the vertex that was nearest to it in the first pose. Those behind
    /// the eye are left out. O(guides x vertices).
    pub(super) fn guides(&self, style: &Style, projector: &Projector) -> Vec<Guide> {
        let first = self
            .first_positions
            .as_ref()
            .unwrap_or(&self.shape.positions);
        let on_screen = |guide: &[f32; 3]| {
            let guide = Vec3::from(*guide);
            let away = |vertex: &u32| guide.distance_squared(Vec3::from(first[*vertex as usize]));
            let all = (0..first.len() as u32).into_par_iter();
            let nearest = all.min_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)))?;
            let world = self.shape.point(nearest);
            let depth = projector.depth(world);
            let place = projector.project(world);
            (depth > projector.near()).then_some(Guide { place, depth })
        };
        style.line.guides.iter().filter_map(on_screen).collect()
    }
}
