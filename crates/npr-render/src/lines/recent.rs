//! Lines of views that were drawn last, for drawings of the same views in another look.

use npr_vector::mesh_lines::draw::{LineSettings, Prepared, ViewRuns};
use npr_vector::project::Projector;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

/// What the lines of a view hang on.
#[derive(Debug, Clone)]
pub(super) struct ViewKey {
    pub projector: Projector,
    pub settings: LineSettings,
    /// Of which shape in which pose: another one is prepared anew.
    pub prepared: Arc<Prepared>,
}

impl PartialEq for ViewKey {
    fn eq(&self, other: &Self) -> bool {
        self.projector == other.projector
            && self.settings == other.settings
            && Arc::ptr_eq(&self.prepared, &other.prepared)
    }
}

/// The lines of the views that were drawn last; none unless there is room for them.
#[derive(Debug, Default)]
pub(super) struct RecentViews {
    /// How many are kept.
    room: usize,
    views: Mutex<VecDeque<(ViewKey, Arc<ViewRuns>)>>,
}

impl RecentViews {
    /// Room for so many views.
    pub fn of(room: usize) -> Self {
        Self {
            room,
            views: Mutex::default(),
        }
    }

    /// As much room, and no views.
    pub fn emptied(&self) -> Self {
        Self::of(self.room)
    }

    /// The lines of a view: those that were kept, or those that are found now.
    pub fn runs<E>(
        &self,
        key: ViewKey,
        find: impl FnOnce() -> Result<ViewRuns, E>,
    ) -> Result<ViewRuns, E> {
        if self.room == 0 {
            return find();
        }
        let views = || self.views.lock().unwrap_or_else(PoisonError::into_inner);
        let known = {
            let mut views = views();
            let place = views.iter().position(|(other, _)| *other == key);
            place.and_then(|place| views.remove(place))
        };
        let (key, runs) = match known {
            Some(known) => known,
            None => (key, Arc::new(find()?)),
        };
        let mut views = views();
        views.push_back((key, Arc::clone(&runs)));
        while views.len() > self.room {
            views.pop_front();
        }
        drop(views);
        Ok(runs.as_ref().clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::camera::{Camera, Projection};
    use npr_core::crease::{CreaseFrom, Creases};
    use npr_mesh::half_edge::HalfEdgeMesh;
    use npr_vector::mesh_lines::draw::LineSource;

    fn key(prepared: &Arc<Prepared>, eye_z: f32) -> ViewKey {
        let camera = Camera {
            eye: [0.0, 0.0, eye_z],
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection: Projection::Parallel { height: 2.0 },
        };
        let size = [64, 48];
        ViewKey {
            projector: Projector::new(&camera, size, ([-1.0; 3], [1.0; 3])),
            settings: LineSettings {
                size,
                kinds: 0,
                method: LineSource::Edges,
                smooth: true,
                hidden: false,
                split: None,
                memory_limit: u64::MAX,
            },
            prepared: Arc::clone(prepared),
        }
    }

    /// Which views of a list are found, where there is room for so many.
    fn found(room: usize, keys: &[ViewKey]) -> Vec<bool> {
        let recent = RecentViews::of(room);
        let is_found = |key: &ViewKey| {
            let mut is_found = false;
            let find = || {
                is_found = true;
                Ok::<_, ()>(ViewRuns::default())
            };
            recent.runs(key.clone(), find).expect("no fault");
            is_found
        };
        keys.iter().map(is_found).collect()
    }

    #[test]
    fn the_views_that_were_drawn_last_are_not_found_anew() {
        let prepare = || {
            Arc::new(Prepared::new(
                &HalfEdgeMesh::default(),
                Creases::over(1.0, CreaseFrom::Faces),
                false,
            ))
        };
        let (prepared, posed) = (prepare(), prepare());
        let [a, b, c] = [3.0, 4.0, 5.0].map(|eye_z| key(&prepared, eye_z));
        let views = [&a, &b, &a, &c, &a, &b].map(Clone::clone);
        assert_eq!(found(2, &views), [true, true, false, true, false, true]);
        assert_eq!(found(0, &views), [true; 6]);
        let of_pose = key(&posed, 3.0);
        let other = ViewKey {
            settings: LineSettings {
                kinds: 1,
                ..a.settings.clone()
            },
            ..a.clone()
        };
        assert_eq!(
            found(9, &[a.clone(), of_pose, other, a]),
            [true, true, true, false]
        );
    }
}
