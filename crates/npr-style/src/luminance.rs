//! How bright a colour is.

/// Share of each channel in luminance [ITU-R BT.709].
pub const LUMA: [f32; 3] = [0.2126, 0.7152, 0.0722];
