//! What moves: the sequences of views that strokes are measured on.

use glam::Vec3;
use npr_core::camera::{Camera, Projection};
use npr_core::math::{cos, sin};

use crate::orbit::turned;

/// Vertical field of view in degrees, distance of the eye in radii, and its height over the horizon in degrees: those
/// of the figures that are published for other programs.
const FOV_DEG: f32 = 45.0;
const AWAY: f32 = 3.0;
const ABOVE_DEG: f32 = 15.0;

/// How the eye goes round in the first sequence, in degrees a frame.
const TURN_DEG: f32 = 0.5;

/// How much nearer the eye comes in the second, as a share of its distance.
const DOLLY: f32 = 0.01;

/// How far the picture moves in the third, in pixels at its middle.
const PAN_PX: f32 = 0.5;

/// Frames in a second of a clip.
const FRAMES_PER_SECOND: f32 = 24.0;

/// A sequence of frames.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Film {
    /// S1: the eye goes round the model.
    Turn,
    /// S2: the eye comes nearer.
    Dolly,
    /// S3: the camera turns where it stands, so the picture moves by less than a pixel and shows the same.
    Pan,
    /// S4: the figure plays a clip before a camera that stands.
    Clip,
    /// S5: nothing moves.
    Still,
}

impl Film {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Turn, Self::Dolly, Self::Pan, Self::Clip, Self::Still];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Turn => "S1 turn",
            Self::Dolly => "S2 dolly",
            Self::Pan => "S3 pan",
            Self::Clip => "S4 clip",
            Self::Still => "S5 still",
        }
    }

    /// How many frames it has; of clips, of one that takes so many seconds.
    pub fn frame_count(self, clip_s: f32) -> usize {
        match self {
            Self::Turn => 120,
            Self::Dolly | Self::Pan => 40,
            Self::Clip => (clip_s * FRAMES_PER_SECOND).round().max(2.0) as usize,
            Self::Still => 8,
        }
    }

    /// The time of a frame of a clip, in seconds.
    pub fn time_s(frame: usize) -> f32 {
        frame as f32 / FRAMES_PER_SECOND
    }

    /// The camera of a frame, before a model in a sphere about `middle`, in a picture `height_px` high.
    pub fn camera(self, frame: usize, (middle, radius): (Vec3, f32), height_px: u32) -> Camera {
        let first = front(middle, radius);
        let count = frame as f32;
        match self {
            Self::Turn => turned(first, middle, TURN_DEG * count),
            Self::Dolly => {
                let left = (0..frame).fold(1.0, |left, _| left * (1.0 - DOLLY));
                let eye = middle + (Vec3::from(first.eye) - middle) * left;
                Camera {
                    eye: eye.to_array(),
                    ..first
                }
            }
            Self::Pan => {
                // A turn about the upright axis moves the middle by so many pixels a radian.
                let half = FOV_DEG.to_radians() / 2.0;
                let distance_px = height_px as f32 / 2.0 * cos(half) / sin(half);
                let px = distance_px * cos(ABOVE_DEG.to_radians());
                let eye = Vec3::from(first.eye);
                let about_eye = turned(first, eye, (PAN_PX * count / px).to_degrees());
                Camera {
                    eye: first.eye,
                    ..about_eye
                }
            }
            Self::Clip | Self::Still => first,
        }
    }
}

/// The first view of every sequence.
fn front(middle: Vec3, radius: f32) -> Camera {
    let above = ABOVE_DEG.to_radians();
    let eye = middle + Vec3::new(0.0, sin(above), cos(above)) * (AWAY * radius);
    Camera {
        eye: eye.to_array(),
        target: middle.to_array(),
        up: [0.0, 1.0, 0.0],
        projection: Projection::Perspective {
            fov_y: FOV_DEG.to_radians(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::viewpoint::{Viewpoint, wide};

    const SIZE: [u32; 2] = [1920, 1080];

    fn place(film: Film, frame: usize, point: [f32; 3]) -> [f64; 2] {
        let camera = film.camera(frame, (Vec3::new(1.0, 2.0, 3.0), 2.0), SIZE[1]);
        Viewpoint::new(&camera, SIZE).project(wide(point))
    }

    #[test]
    fn a_pan_moves_the_middle_by_half_a_pixel_a_frame() {
        for frame in [1, 10, 39] {
            let [x, y] = place(Film::Pan, frame, [1.0, 2.0, 3.0]);
            assert!(((x - 960.0).abs() - 0.5 * frame as f64).abs() < 0.02, "{x}");
            assert!((y - 540.0).abs() < 0.5, "{y}");
        }
    }

    #[test]
    fn a_dolly_brings_the_eye_nearer_by_a_hundredth() {
        let eye = |frame| Vec3::from(Film::Dolly.camera(frame, (Vec3::ZERO, 1.0), 100).eye);
        assert!((eye(0).length() - 3.0).abs() < 1e-5);
        assert!((eye(1).length() - 2.97).abs() < 1e-5);
        assert!((eye(2) / eye(1) - 0.99).abs().max_element() < 1e-2);
    }

    #[test]
    fn a_turn_leads_round_in_720_frames_and_a_still_nowhere() {
        let at = [1.4, 2.5, 2.0];
        let [first, last] = [0, 720].map(|frame| place(Film::Turn, frame, at));
        assert!(first.iter().zip(last).all(|(a, b)| (a - b).abs() < 0.05));
        assert!((place(Film::Turn, 1, at)[0] - first[0]).abs() > 0.5);
        assert_eq!(place(Film::Still, 7, at), first);
    }
}
