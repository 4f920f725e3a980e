//! Passes that draw strokes.

use crate::pass::{Agreement, Features, Format, Pass, Work, read, texture, uniform, write};
use npr_core::geometry::{PosedVertex, Triangle};
use npr_core::window::{View, Window};
use npr_vector::brush::{Brush, Brushes};
use npr_vector::ink_point::InkPoint;
use npr_vector::sampled::{self, PartWidths, Parts, SampledLine, Scenery, SpineSample};
use npr_vector::stroke_ink::draw;

/// How far in front of each sample of a line lies what hides it, in sizes of a pixel; 0 if nothing.
pub const SEE_SAMPLES: Pass = Pass {
    name: "stroke.see_samples",
    shader: npr_shaders::STROKE_SEE_SAMPLES,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        texture("ids", Format::U32),
        read::<PosedVertex>("posed"),
        read::<Triangle>("triangles"),
        read::<SpineSample>("samples"),
        write::<f32>("gaps"),
    ],
    work: Work::PerElement { of: "samples" },
    // Depths are compared: of a surface just at the tolerance, engines may think differently.
    agreement: Agreement::NearlyAll {
        share: 0.002,
        bound: 0.02,
    },
    twin: |b| {
        let on = Scenery {
            view: &b.one(0),
            window: &b.one(1),
            ids: b.image(2).texels,
            posed: b.read(3),
            triangles: b.read(4),
        };
        sampled::see_samples(&on, b.read(5), b.write(6));
    },
};

/// Whether a line is visible at each sample by most of those around it, and whether that is clear.
pub const WEIGH_SAMPLES: Pass = Pass {
    name: "stroke.weigh_samples",
    shader: npr_shaders::STROKE_WEIGH_SAMPLES,
    slots: &[
        uniform::<PartWidths>("widths"),
        read::<SpineSample>("samples"),
        read::<SampledLine>("lines"),
        read::<f32>("gaps"),
        write::<u32>("verdicts"),
        write::<u32>("clear"),
    ],
    work: Work::PerElement { of: "samples" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (verdicts, clear) = (b.write(4), b.write(5));
        let seen = (b.read(1), b.read(3));
        sampled::weigh_samples(
            &b.one::<PartWidths>(0).all,
            b.read(2),
            seen,
            verdicts,
            clear,
        );
    },
};

/// Whether each sample is visible: lines change only where that is clear.
pub const FILTER_VISIBILITY: Pass = Pass {
    name: "stroke.filter_visibility",
    shader: npr_shaders::STROKE_FILTER_VISIBILITY,
    slots: &[
        read::<u32>("verdicts"),
        read::<u32>("clear"),
        read::<u32>("clear_slots"),
        read::<u32>("clear_list"),
        write::<u32>("visible"),
    ],
    work: Work::PerElement { of: "verdicts" },
    agreement: Agreement::Exact,
    twin: |b| {
        sampled::filter_visibility(b.read(0), b.read(1), b.read(2), b.read(3), b.write(4));
    },
};

/// The first sample of every visible and every hidden part of a line.
pub const PART_SAMPLES: Pass = Pass {
    name: "stroke.part_samples",
    shader: npr_shaders::STROKE_PART_SAMPLES,
    slots: &[
        read::<SpineSample>("samples"),
        read::<u32>("visible"),
        write::<u32>("part_starts"),
    ],
    work: Work::PerElement { of: "samples" },
    agreement: Agreement::Exact,
    twin: |b| sampled::part_samples(b.read(0), b.read(1), b.write(2)),
};

/// Points of ink of the visible parts of lines, one for every two samples.
pub const INK_SAMPLES: Pass = Pass {
    name: "stroke.ink_samples",
    shader: npr_shaders::STROKE_INK_SAMPLES,
    slots: &[
        uniform::<View>("view"),
        uniform::<PartWidths>("widths"),
        read::<SampledLine>("lines"),
        read::<SpineSample>("samples"),
        read::<f32>("gaps"),
        read::<u32>("visible"),
        read::<u32>("part_slots"),
        read::<u32>("part_firsts"),
        write::<InkPoint>("points"),
    ],
    work: Work::PerElement { of: "points" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let parts = Parts {
            visible: b.read(5),
            slots: b.read(6),
            firsts: b.read(7),
        };
        let seen = (b.read(3), b.read(4));
        let widths = &b.one::<PartWidths>(1).all[..];
        sampled::ink_samples((&b.one(0), widths), b.read(2), seen, &parts, b.write(8));
    },
};

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
