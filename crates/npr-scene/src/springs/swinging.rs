//! How springs stand at any time of a film: by the time alone, whichever times were asked for before.

use super::swing::Swing;
use crate::pose::Pose;
use crate::quaternion::{self, Quaternion};
use crate::scene::Scene;
use std::collections::{BTreeMap, VecDeque};

/// Steps a second.
const RATE: f64 = 60.0;

/// Steps after which springs rest anew, so that no time takes for ever: those of an hour.
const PERIOD: u64 = 216_000;

/// Share of a step below which a time is that of the step.
const NEAR: f64 = 1e-3;

/// Most bytes of turns that are kept of steps before, and fewest steps.
const KEPT: (usize, usize) = (32 << 20, 2);

/// The springs of a scene in a film.
#[derive(Debug, Clone, Default)]
pub struct Swinging {
    /// The springs at the last step that was made.
    swing: Option<Swing>,
    /// Turns of the joints at steps up to that one.
    kept: VecDeque<Vec<Quaternion>>,
    /// The number of that step.
    last: u64,
}

impl Swinging {
    /// How the joints of a scene are turned beside their parents at a time in seconds, by node, where `pose_at` gives
    /// the pose at any time.
    ///
    /// They rest at time 0 and before. From there the pose is taken 60 times a second, and between two such steps
    /// joints stand on the shorter arc between their turns. So the rate of a film changes nothing, and a part of a
    /// film is that of the whole. Every hour they rest anew.
    ///
    /// O(steps since the last time x (nodes + joints)), or since 0 for times longer ago than it keeps: 32 MiB of
    /// turns.
    pub fn at(
        &mut self,
        scene: &Scene,
        time_s: f32,
        mut pose_at: impl FnMut(f32) -> Pose,
    ) -> BTreeMap<u32, [f32; 4]> {
        // Find the step before the time.
        let time = (f64::from(time_s) * RATE).max(0.0);
        let near = time.round();
        let (step, share) = match (time - near).abs() < NEAR {
            true => (near as u64, 0.0),
            false => (time as u64, time.fract()),
        };
        let mut turns = self.at_step(step, scene, &mut pose_at);

        // Go on to the time, unless they rest anew there.
        let next = step + 1;
        if share > 0.0 && next % PERIOD != 0 {
            let later = self.at_step(next, scene, &mut pose_at);
            for (turn, later) in turns.iter_mut().zip(later) {
                *turn = quaternion::on_arc(*turn, later, share as f32);
            }
        }
        let joints = scene.springs.iter().flat_map(|springs| &springs.joints);
        joints.map(|joint| joint.node).zip(turns).collect()
    }

    fn at_step(
        &mut self,
        step: u64,
        scene: &Scene,
        pose_at: &mut impl FnMut(f32) -> Pose,
    ) -> Vec<Quaternion> {
        // Begin anew where the step is not kept, or comes after a rest.
        let start = step - step % PERIOD;
        let first = self
            .last
            .saturating_sub(self.kept.len().saturating_sub(1) as u64);
        let mut time_of = |step: u64| pose_at((step as f64 / RATE) as f32);
        if self.kept.is_empty() || step < first || self.last < start {
            let swing = Swing::new(scene, &time_of(start));
            self.kept = VecDeque::from([swing.turns().to_vec()]);
            (self.swing, self.last) = (Some(swing), start);
        }

        // Step on.
        while let Some(swing) = self.swing.as_mut().filter(|_| self.last < step) {
            self.last += 1;
            swing.step(scene, &time_of(self.last), 1.0 / RATE);
            let bytes = swing.turns().len().max(1) * size_of::<Quaternion>();
            self.kept.push_back(swing.turns().to_vec());
            if self.kept.len() > (KEPT.0 / bytes).max(KEPT.1) {
                self.kept.pop_front();
            }
        }
        let ago = (self.last - step) as usize;
        let place = self.kept.len().checked_sub(1 + ago);
        let turns = place.and_then(|place| self.kept.get(place));
        turns.cloned().unwrap_or_default()
    }
}
