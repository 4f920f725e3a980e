//! How spheres follow smoke, by the style that it is drawn in.

use npr_smoke::{Birthplace, ParticleSettings, Placement, PuffSettings, TrackSettings};
use npr_stylesheet::{SmokeParticles, SmokePlacement, SmokeStyle};

/// Frames per second that the pace of a style is stated for.
const STYLE_FPS: f32 = 24.0;

/// What spheres follow: a series of volumes, and what is known of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Following {
    /// Frames of the volume from one moment to the next.
    pub step: f32,
    /// Frames of the volume per second.
    pub fps: f32,
    /// Where smoke comes from, for published particles.
    pub birthplace: Birthplace,
    /// Other seeds give other, equally likely spheres.
    pub seed: u32,
}

impl Default for Following {
    /// Every frame of 24 a second, from anywhere.
    fn default() -> Self {
        Self {
            step: 1.0,
            fps: STYLE_FPS,
            birthplace: Birthplace::Anywhere,
            seed: 0,
        }
    }
}

impl Following {
    /// The spheres that a style asks for.
    pub fn settings(&self, style: &SmokeStyle) -> PuffSettings {
        let puffs = &style.puffs;
        let frame_seconds = self.step / self.fps;
        match style.particles {
            SmokeParticles::Cover => PuffSettings::Cover(TrackSettings {
                count: puffs.count,
                threshold: puffs.threshold,
                detail: puffs.detail,
                frame_seconds,
                scale: puffs.scale,
                // The same pace whatever the steps and the frames.
                ease: (puffs.ease * self.step * STYLE_FPS / self.fps).min(1.0),
                placement: match puffs.placement {
                    SmokePlacement::Cover => Placement::Cover,
                    SmokePlacement::Random => Placement::Random,
                },
                seed: self.seed,
            }),
            SmokeParticles::Published => PuffSettings::Published(ParticleSettings {
                count: puffs.count,
                threshold: puffs.threshold,
                frame_seconds,
                still: puffs.still,
                birthplace: self.birthplace,
                seed: self.seed,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The usual style asks for what the crate of smoke calls usual: neither has other numbers.
    #[test]
    fn a_style_without_wishes_follows_as_usual() {
        let usual = Following::default().settings(&SmokeStyle::default());
        assert_eq!(usual, PuffSettings::Cover(TrackSettings::default()));
        let style = SmokeStyle {
            particles: SmokeParticles::Published,
            ..SmokeStyle::default()
        };
        let published = Following::default().settings(&style);
        assert_eq!(
            published,
            PuffSettings::Published(ParticleSettings::default())
        );
    }

    #[test]
    fn spheres_swell_at_one_pace_whatever_the_frames() {
        let ease = |step: f32, fps: f32| {
            let following = Following {
                step,
                fps,
                ..Following::default()
            };
            match following.settings(&SmokeStyle::default()) {
                PuffSettings::Cover(settings) => settings.ease,
                PuffSettings::Published(_) => f32::NAN,
            }
        };
        assert!((ease(0.5, 24.0) - 0.06).abs() < 1e-6);
        assert!((ease(1.0, 12.0) - 0.24).abs() < 1e-6);
        assert_eq!(ease(40.0, 24.0), 1.0);
    }
}
