//! Which moments of a volume are drawn.

/// Frames from one picture to the next where nothing is said.
pub const DEFAULT_STEP: f64 = 1.0;

/// Frames per second where none are said.
pub const DEFAULT_FPS: f32 = 24.0;

/// Which moments of a volume are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shots {
    /// First and last frame; a single telling one without.
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
