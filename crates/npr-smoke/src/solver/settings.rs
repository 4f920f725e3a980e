//! What smokes, and how.

use super::Source;
use glam::Vec3;

/// What smokes, and how.
///
/// Lengths are in *box lengths*, the longest side of the grid, so that a finer grid shows the same motion in more
/// detail. Numbers that are not finite fall back on the source's own; all are kept within the ranges stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmokeSettings {
    /// What smokes.
    pub source: Source,
    /// Cells along x, y and z; z is up. [`MIN_SIDE`](super::MIN_SIDE) to [`MAX_SIDE`](crate::MAX_SIDE) each. The
    /// paper's 15 x 15 x 20 by default.
    pub size: [u32; 3],
    /// Seconds per frame, 0.001 to 1.
    pub frame_seconds: f32,
    /// How hot the source is, 0 to 10. 0.3 a cigarette, 1 a chimney, 3 a volcano.
    pub heat: f32,
    /// Upward acceleration of smoke of temperature 1, in box lengths per second squared, 0 to 50.
    pub buoyancy: f32,
    /// Downward acceleration of smoke of density 1, 0 to 50.
    pub weight: f32,
    /// How much vorticity confinement curls the smoke, 0 to 2. 0 calm, 0.3 rolling, 1 wild.
    pub curl: f32,
    /// Share of the density that vanishes per second, 0 to 10.
    pub fading: f32,
    /// Share of the temperature that vanishes per second, 0 to 10.
    pub cooling: f32,
    /// Wind that the air starts with and that goes on outside, in box lengths per second, at most 4.
    pub wind: Vec3,
    /// Other seeds give other smoke of the same kind.
    pub seed: u32,
}

impl SmokeSettings {
    /// Settings under which a source looks like itself.
    pub fn of(source: Source) -> Self {
        // Start from the plume; the others say where they differ.
        let plume = SmokeSettings {
            source,
            size: [15, 15, 20],
            frame_seconds: 1.0 / 24.0,
            heat: 1.0,
            buoyancy: 0.7,
            weight: 0.05,
            curl: 0.25,
            fading: 0.25,
            cooling: 0.5,
            wind: Vec3::ZERO,
            seed: 0,
        };
        match source {
            Source::Plume => plume,
            Source::Puff => SmokeSettings {
                buoyancy: 0.3,
                fading: 0.2,
                ..plume
            },
            Source::Explosion => SmokeSettings {
                size: [24, 24, 24],
                heat: 2.0,
                buoyancy: 0.12,
                cooling: 0.8,
                ..plume
            },
            Source::Cloud => SmokeSettings {
                size: [32, 20, 16],
                heat: 0.3,
                buoyancy: 0.25,
                weight: 0.02,
                curl: 0.2,
                fading: 0.12,
                wind: Vec3::new(0.03, 0.0, 0.0),
                ..plume
            },
        }
    }

    /// The same with every number finite and in its range.
    pub(super) fn sane(self) -> Self {
        // Put the source's own numbers in place of those that are not finite.
        let own = Self::of(self.source);
        let within = |value: f32, own: f32, least: f32, most: f32| {
            if value.is_finite() {
                value.clamp(least, most)
            } else {
                own
            }
        };
        let wind = if self.wind.is_finite() {
            self.wind
        } else {
            own.wind
        };

        // Keep every number in its range.
        Self {
            frame_seconds: within(self.frame_seconds, own.frame_seconds, 1e-3, 1.0),
            heat: within(self.heat, own.heat, 0.0, 10.0),
            buoyancy: within(self.buoyancy, own.buoyancy, 0.0, 50.0),
            weight: within(self.weight, own.weight, 0.0, 50.0),
            curl: within(self.curl, own.curl, 0.0, 2.0),
            fading: within(self.fading, own.fading, 0.0, 10.0),
            cooling: within(self.cooling, own.cooling, 0.0, 10.0),
            wind: wind.clamp(Vec3::splat(-4.0), Vec3::splat(4.0)),
            ..self
        }
    }
}
