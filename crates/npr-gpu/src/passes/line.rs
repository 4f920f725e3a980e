//! Passes that find lines on images and draw them on shapes.

use crate::pass::{
    Agreement, Features, Format, Pass, Work, append, read, scatter, texture, uniform, update, write,
};
use npr_core::geometry::{Edge, EdgeRole, GPixel, Part, PosedVertex, Stamp, Triangle, Vertex};
use npr_core::line_color::{LineTint, LineTints};
use npr_core::outline::Outline;
use npr_core::window::{View, Window};
use npr_style::compose::Compose;
use npr_style::draw_mask::{MaskInk, draw_mask};
use npr_style::lighting::Lights;
use npr_style::line_color::{Deciding, LineScene, decide, light_widths};
use npr_vector::screen::detect::{Detection, detect};
use npr_vector::screen::gbuffer::{Surfaces, resolve};
use npr_vector::screen::residual::{self, Inking, Search, Stamps};
use npr_vector::screen::ribbon::{self, Drawing};

/// Depth, normal, object and material of the surface at every pixel.
pub const RESOLVE_GBUFFER: Pass = Pass {
    name: "line.resolve_gbuffer",
    shader: npr_shaders::LINE_RESOLVE_GBUFFER,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        texture("ids", Format::U32),
        read::<PosedVertex>("posed"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        write::<GPixel>("gbuffer"),
    ],
    work: Work::PerElement { of: "gbuffer" },
    agreement: Agreement::Relative(1e-3),
    twin: |b| {
        let (view, window) = (b.one(0), b.one(1));
        let on = Surfaces {
            view: &view,
            window: &window,
            posed: b.read(3),
            triangles: b.read(4),
            parts: b.read(5),
        };
        resolve(&on, b.image(2).texels, b.write(6));
    },
};

/// Marks the pixels that differ from a neighbour, and lists those that own a line.
pub const DETECT: Pass = Pass {
    name: "line.detect",
    shader: npr_shaders::LINE_DETECT,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Outline>("outline"),
        read::<Part>("parts"),
        read::<GPixel>("gbuffer"),
        write::<u32>("mask"),
        append("owners"),
    ],
    work: Work::PerElement { of: "mask" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (view, window, outline) = (b.one(0), b.one(1), b.one(2));
        let with = Detection {
            view: &view,
            window: &window,
            outline: &outline,
            parts: b.read(3),
        };
        detect(&with, b.read(4), b.write(5), b.write(6));
    },
};

/// Half widths of lines by the light that falls on vertices.
pub const LIGHT_WIDTHS: Pass = Pass {
    name: "line.light_widths",
    shader: npr_shaders::LINE_LIGHT_WIDTHS,
    slots: &[
        uniform::<Lights>("lights"),
        read::<Part>("parts"),
        read::<Vertex>("vertices"),
        read::<PosedVertex>("posed"),
        write::<PosedVertex>("lit"),
    ],
    work: Work::PerElement { of: "lit" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let scene = LineScene {
            view: &View::default(),
            lights: &b.one(0),
            axes_world: [[0.0; 3]; 3],
            center_world: [0.0; 3],
            texels: &[],
        };
        light_widths(&scene, b.read(1), b.read(2), b.read(3), b.write(4));
    },
};

/// The colour of lines at the pixels of the mask that they run through, or beside.
pub const COLOR_MASK: Pass = Pass {
    name: "line.color_mask",
    shader: npr_shaders::LINE_COLOR_MASK,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Compose>("compose"),
        uniform::<Lights>("lights"),
        texture("ids", Format::U32),
        read::<PosedVertex>("posed"),
        read::<Vertex>("vertices"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
        read::<u32>("mask"),
        write::<LineTint>("tints"),
    ],
    work: Work::PerElement { of: "tints" },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let on = Deciding {
            view: &b.one(0),
            window: &b.one(1),
            compose: &b.one(2),
            lights: &b.one(3),
            ids: b.image(4).texels,
            posed: b.read(5),
            vertices: b.read(6),
            triangles: b.read(7),
            parts: b.read(8),
            texels: b.read(9),
            mask: b.read(10),
        };
        decide(&on, b.write(11));
    },
};

/// Edges as ribbons of varying width, where the mask shows them.
pub const DRAW_RIBBONS: Pass = Pass {
    name: "line.draw_ribbons",
    shader: npr_shaders::LINE_DRAW_RIBBONS,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Window>("mask_window"),
        uniform::<Outline>("outline"),
        read::<PosedVertex>("posed"),
        read::<Part>("parts"),
        read::<Edge>("edges"),
        read::<EdgeRole>("roles"),
        read::<GPixel>("gbuffer"),
        read::<u32>("mask"),
        read::<LineTint>("tints").serving(Features::TINTS),
    ],
    work: Work::Draw {
        of: "edges",
        vertices: 6,
        targets: &[Format::Rgba8, Format::Depth],
        fills: false,
    },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        let (view, window, mask_window, outline) = (b.one(0), b.one(1), b.one(2), b.one(3));
        let with = Drawing {
            view: &view,
            window: &window,
            mask_window: &mask_window,
            outline: &outline,
            posed: b.read(4),
            parts: b.read(5),
            gbuffer: b.read(8),
            mask: b.read(9),
            tints: b.read(10),
        };
        ribbon::draw(
            &with,
            b.read(6),
            b.read(7),
            b.image_mut(11).texels,
            b.image_mut(12).texels,
        );
    },
};

/// Mask pixels that own a line and that no ribbon inked become stamps.
pub const FIND_RESIDUAL: Pass = Pass {
    name: "line.find_residual",
    shader: npr_shaders::LINE_FIND_RESIDUAL,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Window>("mask_window"),
        read::<Part>("parts"),
        read::<GPixel>("gbuffer"),
        read::<u32>("mask"),
        read::<u32>("owners"),
        texture("ribbons", Format::Rgba8),
        update::<Stamp>("stamps"),
        append("found"),
    ],
    work: Work::PerListed { of: "owners" },
    agreement: Agreement::Relative(1e-6),
    twin: |b| {
        let (window, mask_window) = (b.one(0), b.one(1));
        let on = Search {
            window: &window,
            mask_window: &mask_window,
            parts: b.read(2),
            gbuffer: b.read(3),
            mask: b.read(4),
            ribbons: b.image(6).texels,
        };
        residual::find(&on, b.read(5), b.write(7), b.write(8));
    },
};

/// Moves every stamp to the middle of the stamps around it.
pub const SMOOTH_STAMPS: Pass = Pass {
    name: "line.smooth_stamps",
    shader: npr_shaders::LINE_SMOOTH_STAMPS,
    slots: &[
        uniform::<Window>("mask_window"),
        read::<u32>("mask"),
        read::<u32>("found"),
        read::<Stamp>("stamps"),
        update::<Stamp>("smoothed"),
    ],
    work: Work::PerListed { of: "found" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| {
        let mask_window = b.one(0);
        let on = Stamps {
            mask_window: &mask_window,
            mask: b.read(1),
            stamps: b.read(3),
        };
        residual::smooth(&on, b.read(2), b.write(4));
    },
};

/// Pixels of the output claimed for the stamps that cover them most.
pub const CLAIM_PIXELS: Pass = Pass {
    name: "line.claim_pixels",
    shader: npr_shaders::LINE_CLAIM_PIXELS,
    slots: &[
        uniform::<Window>("window"),
        read::<u32>("found"),
        read::<Stamp>("smoothed"),
        scatter::<u32>("claims"),
        append("covered"),
    ],
    work: Work::PerListed { of: "found" },
    agreement: Agreement::Exact,
    twin: |b| residual::claim(&b.one(0), b.read(1), b.read(2), b.write(3), b.write(4)),
};

/// Inks the claimed pixels.
pub const STAMP_RESIDUAL: Pass = Pass {
    name: "line.stamp_residual",
    shader: npr_shaders::LINE_STAMP_RESIDUAL,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Window>("mask_window"),
        read::<Part>("parts"),
        read::<Stamp>("smoothed"),
        read::<LineTint>("tints").serving(Features::TINTS),
        read::<u32>("covered"),
        update::<u32>("stamped"),
    ],
    work: Work::PerListed { of: "covered" },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (window, mask_window) = (b.one(0), b.one(1));
        let with = Inking {
            window: &window,
            mask_window: &mask_window,
            parts: b.read(2),
            smoothed: b.read(3),
            tints: b.read(4),
        };
        residual::stamp(&with, b.read(5), b.write(6));
    },
};

/// The mask itself.
pub const DRAW_MASK: Pass = Pass {
    name: "line.draw_mask",
    shader: npr_shaders::LINE_DRAW_MASK,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Window>("mask_window"),
        uniform::<Compose>("compose"),
        read::<Part>("parts"),
        read::<u32>("mask"),
        read::<LineTint>("tints"),
        write::<u32>("overlay"),
    ],
    work: Work::PerElement { of: "overlay" },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let with = MaskInk {
            window: &b.one(0),
            compose: &b.one(2),
            parts: b.read(3),
            mask: b.read(4),
            tints: LineTints {
                mask_window: &b.one(1),
                tints: b.read(5),
            },
        };
        draw_mask(&with, b.write(6));
    },
};
