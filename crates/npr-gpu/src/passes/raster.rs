//! Passes that draw triangle numbers.

use crate::pass::{Agreement, Format, Pass, Work, read, uniform};
use npr_core::cutout::Cutout;
use npr_core::geometry::{Part, PosedVertex, Triangle, Vertex};
use npr_core::raster::{Fill, HULL_BIT, Sides, fill_triangles, triangle_of};
use npr_core::surface::weights_at;
use npr_core::window::{View, Window};

/// Every triangle draws its number and depth.
const NUMBERS: Work = Work::Draw {
    of: "triangles",
    vertices: 3,
    targets: &[Format::U32, Format::Depth],
    fills: false,
};

/// The number of the nearest triangle, plus one, at every pixel.
pub const DRAW_IDS: Pass = Pass {
    name: "raster.draw_ids",
    shader: npr_shaders::RASTER_DRAW_IDS,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        read::<PosedVertex>("posed"),
        read::<Vertex>("vertices"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
    ],
    work: NUMBERS,
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (view, window): (View, Window) = (b.one(0), b.one(1));
        let posed: &[PosedVertex] = b.read(2);
        let cutout = Cutout {
            posed,
            vertices: b.read(3),
            triangles: b.read(4),
            parts: b.read(5),
            texels: b.read(6),
        };
        let fill = Fill {
            window: &window,
            triangles: cutout.triangles,
            parts: cutout.parts,
            sides: Sides::AsParts,
            id_bits: 0,
            clip_of: |v| posed[v as usize].clip,
            keep: |id, x, y| !cutout.is_hole(triangle_of(id), view.ndc_at(window.frame_at(x, y))),
        };
        fill_triangles(&fill, b.image_mut(7).texels, b.image_mut(8).texels);
    },
};

/// The number of the triangle nearest to a light, plus one, at every texel; both sides of everything throw shadows.
pub const DRAW_SHADOW: Pass = Pass {
    name: "raster.draw_shadow",
    shader: npr_shaders::RASTER_DRAW_SHADOW,
    slots: &[
        uniform::<Window>("window"),
        read::<[f32; 4]>("projected"),
        read::<Vertex>("vertices"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
    ],
    work: NUMBERS,
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let window: Window = b.one(0);
        let projected: &[[f32; 4]] = b.read(1);
        let cutout = Cutout {
            posed: &[],
            vertices: b.read(2),
            triangles: b.read(3),
            parts: b.read(4),
            texels: b.read(5),
        };
        let clip_of = |v: u32| projected[v as usize];
        let is_hole = |triangle: u32, ndc| {
            let clip = cutout.triangles[triangle as usize].corners.map(clip_of);
            cutout.is_hole_at(triangle, weights_at(clip, ndc))
        };
        let fill = Fill {
            window: &window,
            triangles: cutout.triangles,
            parts: cutout.parts,
            sides: Sides::Both,
            id_bits: 0,
            clip_of,
            keep: |id, x, y| !is_hole(triangle_of(id), window.ndc_of(x, y)),
        };
        fill_triangles(&fill, b.image_mut(6).texels, b.image_mut(7).texels);
    },
};

/// The backs of the hull, into the same picture as the triangles; cut-out parts have the holes that they have
/// themselves.
pub const DRAW_HULL: Pass = Pass {
    name: "raster.draw_hull",
    shader: npr_shaders::RASTER_DRAW_HULL,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        read::<[f32; 4]>("hull"),
        read::<Vertex>("vertices"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
    ],
    work: NUMBERS,
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (view, window): (View, Window) = (b.one(0), b.one(1));
        let hull: &[[f32; 4]] = b.read(2);
        let cutout = Cutout {
            posed: &[],
            vertices: b.read(3),
            triangles: b.read(4),
            parts: b.read(5),
            texels: b.read(6),
        };
        let is_hole = |triangle: u32, ndc| {
            let corners = cutout.triangles[triangle as usize].corners;
            let clip = corners.map(|v| hull[v as usize]);
            cutout.is_hole_at(triangle, weights_at(clip, ndc))
        };
        let fill = Fill {
            window: &window,
            triangles: cutout.triangles,
            parts: cutout.parts,
            sides: Sides::Backs,
            id_bits: HULL_BIT,
            clip_of: |v| hull[v as usize],
            keep: |id, x, y| !is_hole(triangle_of(id), view.ndc_at(window.frame_at(x, y))),
        };
        fill_triangles(&fill, b.image_mut(7).texels, b.image_mut(8).texels);
    },
};

/// The number of the nearest triangle of a beam, plus one, at every pixel.
pub const DRAW_BEAMS: Pass = Pass {
    name: "raster.draw_beams",
    shader: npr_shaders::RASTER_DRAW_BEAMS,
    slots: &[
        uniform::<Window>("window"),
        read::<PosedVertex>("posed"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
    ],
    work: NUMBERS,
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let window: Window = b.one(0);
        let posed: &[PosedVertex] = b.read(1);
        let fill = Fill {
            window: &window,
            triangles: b.read(2),
            parts: b.read(3),
            sides: Sides::Beams,
            id_bits: 0,
            clip_of: |v| posed[v as usize].clip,
            keep: |_, _, _| true,
        };
        fill_triangles(&fill, b.image_mut(4).texels, b.image_mut(5).texels);
    },
};
