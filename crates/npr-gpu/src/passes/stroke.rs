//! Passes that draw strokes.

use crate::pass::{Agreement, Format, Pass, Work, read, uniform};
use npr_core::window::Window;
use npr_vector::stroke_ink::{InkPoint, draw};

/// Strokes as discs swept from each of their points to the next.
pub const DRAW_STROKES: Pass = Pass {
    name: "stroke.draw_strokes",
    shader: npr_shaders::STROKE_DRAW_STROKES,
    slots: &[uniform::<Window>("window"), read::<InkPoint>("points")],
    work: Work::Draw {
        of: "points",
        vertices: 6,
        targets: &[Format::Rgba8, Format::Depth],
        fills: false,
    },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        draw(
            &b.one(0),
            b.read(1),
            b.image_mut(2).texels,
            b.image_mut(3).texels,
        )
    },
};
