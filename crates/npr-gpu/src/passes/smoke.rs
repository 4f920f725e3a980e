//! Passes that draw spheres as cartoon smoke.

use crate::pass::{Agreement, Format, Pass, Work, layered, read, texture, uniform, write};
use npr_core::smoke::{SmokePixel, Sphere, SphereView, ViewSphere};
use npr_core::window::Window;
use npr_style::lighting::Lights;
use npr_style::smoke::resolve::{Resolving, resolve};
use npr_style::smoke::shade::{Shading, shade_spheres};
use npr_style::smoke::{SmokeLook, blur, draw};

/// Every sphere as a camera or a light sees it.
pub const PROJECT_SPHERES: Pass = Pass {
    name: "smoke.project_spheres",
    shader: npr_shaders::SMOKE_PROJECT_SPHERES,
    slots: &[
        uniform::<SphereView>("lens"),
        read::<Sphere>("spheres"),
        write::<ViewSphere>("balls"),
    ],
    work: Work::PerElement { of: "spheres" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| draw::project_spheres(&b.one(0), b.read(1), b.write(2)),
};

/// The number of the nearest sphere, plus one, at every pixel.
pub const DRAW_SPHERES: Pass = Pass {
    name: "raster.draw_spheres",
    shader: npr_shaders::RASTER_DRAW_SPHERES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<SphereView>("lens"),
        read::<ViewSphere>("balls"),
    ],
    work: Work::Draw {
        of: "balls",
        vertices: 6,
        targets: &[Format::U32, Format::Depth],
        fills: true,
    },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (window, lens): (Window, SphereView) = (b.one(0), b.one(1));
        let (ids, depths) = (b.image_mut(3).texels, b.image_mut(4).texels);
        draw::draw_spheres(&lens, &window, b.read(2), ids, depths);
    },
};

/// Light, depth and layer of every pixel.
pub const SHADE_SPHERES: Pass = Pass {
    name: "smoke.shade_spheres",
    shader: npr_shaders::SMOKE_SHADE_SPHERES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<SphereView>("lens"),
        uniform::<SmokeLook>("look"),
        uniform::<Lights>("lights"),
        texture("smoke_ids", Format::U32),
        read::<Sphere>("spheres"),
        read::<ViewSphere>("balls"),
        write::<SmokePixel>("pixels"),
        layered("smoke_lights", Format::U32),
        layered("surface_depths", Format::Depth),
    ],
    work: Work::PerElement { of: "pixels" },
    agreement: Agreement::NearlyAll {
        share: 0.001,
        bound: 1e-3,
    },
    twin: |b| {
        let (window, lens, look, lights) = (b.one(0), b.one(1), b.one(2), b.one(3));
        let with = Shading {
            lens: &lens,
            window: &window,
            look: &look,
            lights: &lights,
            ids: b.image(4).texels,
            shadows: b.layers(8),
            surfaces: b.layers(9),
            spheres: b.read(5),
            balls: b.read(6),
        };
        shade_spheres(&with, b.write(7));
    },
};

/// Tones added up in the cells of every layer.
pub const GATHER_TONES: Pass = Pass {
    name: "smoke.gather_tones",
    shader: npr_shaders::SMOKE_GATHER_TONES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<SmokeLook>("look"),
        read::<SmokePixel>("pixels"),
        write::<[f32; 2]>("gathered"),
    ],
    work: Work::PerElement { of: "gathered" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| {
        let (window, look): (Window, SmokeLook) = (b.one(0), b.one(1));
        blur::gather_tones(window.size, &look, b.read(2), b.write(3));
    },
};

/// The Gaussian along rows of cells.
pub const BLUR_ROWS: Pass = Pass {
    name: "smoke.blur_rows",
    shader: npr_shaders::SMOKE_BLUR_ROWS,
    slots: &[
        uniform::<SmokeLook>("look"),
        read::<[f32; 2]>("gathered"),
        write::<[f32; 2]>("blurred"),
    ],
    work: Work::PerElement { of: "blurred" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| blur::blur_rows(&b.one(0), b.read(1), b.write(2)),
};

/// The Gaussian along columns of cells.
pub const BLUR_COLUMNS: Pass = Pass {
    name: "smoke.blur_columns",
    shader: npr_shaders::SMOKE_BLUR_COLUMNS,
    slots: &[
        uniform::<SmokeLook>("look"),
        read::<[f32; 2]>("blurred"),
        write::<[f32; 2]>("cells"),
    ],
    work: Work::PerElement { of: "cells" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| blur::blur_columns(&b.one(0), b.read(1), b.write(2)),
};

/// The smoothed tone of every pixel.
pub const SMOOTH_TONES: Pass = Pass {
    name: "smoke.smooth_tones",
    shader: npr_shaders::SMOKE_SMOOTH_TONES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<SmokeLook>("look"),
        read::<SmokePixel>("pixels"),
        read::<[f32; 2]>("cells"),
        write::<f32>("tones"),
    ],
    work: Work::PerElement { of: "tones" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (window, look): (Window, SmokeLook) = (b.one(0), b.one(1));
        blur::smooth_tones(window.size, &look, b.read(2), b.read(3), b.write(4));
    },
};

/// Tones and outlines of every pixel.
pub const RESOLVE_PICTURE: Pass = Pass {
    name: "smoke.resolve_picture",
    shader: npr_shaders::SMOKE_RESOLVE_PICTURE,
    slots: &[
        uniform::<Window>("window"),
        uniform::<SphereView>("lens"),
        uniform::<SmokeLook>("look"),
        texture("smoke_ids", Format::U32),
        read::<ViewSphere>("balls"),
        read::<SmokePixel>("pixels"),
        read::<f32>("tones"),
    ],
    work: Work::Draw {
        of: "look",
        vertices: 3,
        targets: &[Format::Rgba8, Format::U32],
        fills: true,
    },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        let (window, lens, look) = (b.one(0), b.one(1), b.one(2));
        let with = Resolving {
            lens: &lens,
            window: &window,
            look: &look,
            ids: b.image(3).texels,
            balls: b.read(4),
            pixels: b.read(5),
            tones: b.read(6),
        };
        let (colors, depths) = (b.image_mut(7).texels, b.image_mut(8).texels);
        resolve(&with, colors, depths);
    },
};
