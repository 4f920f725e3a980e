//! The moments of a volume that are drawn.

/// Default number of frames from one picture to the next.
pub const DEFAULT_STEP: f64 = 1.0;

/// Default number of frames per second.
pub const DEFAULT_FPS: f32 = 24.0;

/// The moments of a volume that are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shots {
    /// First and last frame. `None` for all frames of a series, and for one frame of a simulation that shows the smoke
    /// well.
    pub frames: Option<(u32, u32)>,
    /// Frames from one picture to the next.
    pub step: f64,
    /// Frames of the volume per second.
    pub fps: f32,
    /// Cells of the built-in simulation along x, y and z, which is up.
    pub grid: Option<[u32; 3]>,
}

impl Default for Shots {
    fn default() -> Self {
        Self {
            frames: None,
            step: DEFAULT_STEP,
            fps: DEFAULT_FPS,
            grid: None,
        }
    }
}
