//! Passes that draw strokes.

use crate::pass::{Agreement, Features, Format, Pass, Work, read, uniform};
use npr_core::window::Window;
use npr_vector::brush::{Brush, Brushes};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke_ink::draw;

/// Strokes as discs swept from each of their points to the next.
pub const DRAW_STROKES: Pass = Pass {
    name: "stroke.draw_strokes",
    shader: npr_shaders::STROKE_DRAW_STROKES,
    slots: &[
        uniform::<Window>("window"),
        read::<InkPoint>("points"),
        read::<Brush>("brushes").serving(Features::BRUSHES),
        read::<u32>("texels").serving(Features::BRUSHES),
    ],
    work: Work::Draw {
        of: "points",
        vertices: 6,
        targets: &[Format::Rgba8, Format::Depth],
        fills: false,
    },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        let brushes = Brushes {
            all: b.read(2),
            texels: b.read(3),
        };
        draw(
            &b.one(0),
            (b.read(1), brushes),
            b.image_mut(4).texels,
            b.image_mut(5).texels,
        );
    },
};
