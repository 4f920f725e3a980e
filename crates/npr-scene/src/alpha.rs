//! What alpha means.

/// What a material's alpha means.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AlphaMode {
    /// Alpha is ignored.
    Opaque,
    /// Pixels below this alpha are not drawn, the others are opaque.
    Mask(f32),
    /// Alpha is coverage.
    Blend,
}
