//! Smoke of the pictures of one film.

use crate::smoke::Smoke;

impl Smoke {
    /// The same smoke as pictures of one film: all in the one space that they move in, with heats from 0 to 1, which
    /// is that of `hottest`.
    pub fn of_film(frames: Vec<Self>, hottest: f32) -> Vec<Self> {
        let all = frames.iter().fold(Self::default(), |all, smoke| {
            all.with(Self::new(smoke.spheres.clone()))
        });
        let space = (!all.spheres.is_empty()).then(|| all.bounds());
        let finish = |smoke: Self| Self {
            space,
            ..smoke.with_hottest(hottest)
        };
        frames.into_iter().map(finish).collect()
    }
}
