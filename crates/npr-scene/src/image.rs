//! Images: decoded pixels.

/// A decoded image.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Name as in the file, or the file's own name; empty where it has neither.
    pub name: String,
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// sRGB-encoded red, green, blue and straight alpha of each pixel, rows from the top.
    pub rgba: Vec<u8>,
}
