//! Passes that give surfaces their tone.

use crate::pass::{
    Agreement, Features, Format, Pass, Work, append, layered, read, texture, uniform, update, write,
};
use npr_core::geometry::{Part, PosedVertex, Triangle, Vertex};
use npr_core::outline::Outline;
use npr_core::window::{View, Window};
use npr_style::backdrop::Rules;
use npr_style::compose::{Compose, Layers, TriangleConstants, compose, fill, know_triangles};
use npr_style::even_tones::{ToneMap, even_tones, find_tones, flag_tones};
use npr_style::lighting::Lights;
use npr_style::picture_depth::{PictureDepths, find_depths};

/// What is the same all over each triangle.
pub const KNOW_TRIANGLES: Pass = Pass {
    name: "shade.know_triangles",
    shader: npr_shaders::SHADE_KNOW_TRIANGLES,
    slots: &[
        uniform::<View>("view"),
        uniform::<Compose>("compose"),
        uniform::<Lights>("lights"),
        read::<PosedVertex>("posed"),
        read::<Vertex>("vertices"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
        write::<TriangleConstants>("known"),
    ],
    work: Work::PerElement { of: "known" },
    agreement: Agreement::NearlyAll {
        share: 0.01,
        bound: 1e-5,
    },
    twin: |b| {
        let (view, compose, lights) = (b.one(0), b.one(1), b.one(2));
        let (window, rules) = (Window::default(), Rules::default());
        let layers = Layers {
            posed: b.read(3),
            vertices: b.read(4),
            triangles: b.read(5),
            parts: b.read(6),
            texels: b.read(7),
            ..Layers::empty(&view, &window, &compose, &lights, &rules)
        };
        know_triangles(&layers, b.write(8));
    },
};

/// The tone of every pixel whose part has hard steps between tones.
pub const FIND_TONES: Pass = Pass {
    name: "shade.find_tones",
    shader: npr_shaders::SHADE_FIND_TONES,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Compose>("compose"),
        uniform::<Lights>("lights"),
        texture("ids", Format::U32),
        read::<PosedVertex>("posed"),
        read::<Vertex>("vertices"),
        read::<TriangleConstants>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
        layered("shadows", Format::U32).serving(Features::SHADOWS),
        layered("smoke_shadows", Format::Depth).serving(Features::SMOKE_SHADOWS),
        write::<u32>("tone_map"),
        read::<Triangle>("surfaces").for_twin(),
    ],
    work: Work::PerElement { of: "tone_map" },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (view, window, settings, lights) = (b.one(0), b.one(1), b.one(2), b.one(3));
        let rules = Rules::default();
        let layers = Layers {
            ids: b.image(4).texels,
            posed: b.read(5),
            vertices: b.read(6),
            known: b.read(7),
            parts: b.read(8),
            texels: b.read(9),
            shadows: b.layers(10),
            smoke_shadows: b.layers(11),
            triangles: b.read(13),
            ..Layers::empty(&view, &window, &settings, &lights, &rules)
        };
        find_tones(&layers, b.write(12));
    },
};

/// The tiles of the picture in which tones may change.
pub const FLAG_TONES: Pass = Pass {
    name: "shade.flag_tones",
    shader: npr_shaders::SHADE_FLAG_TONES,
    slots: &[
        uniform::<Window>("window"),
        read::<Part>("parts"),
        read::<u32>("tone_map"),
    ],
    work: Work::Draw {
        of: "window",
        fills: true,
        vertices: 3,
        targets: &[Format::U32],
    },
    agreement: Agreement::Exact,
    twin: |b| {
        let window: Window = b.one(0);
        let map = ToneMap {
            size: window.size,
            parts: b.read(1),
            words: b.read(2),
        };
        flag_tones(&map, b.image_mut(3).texels);
    },
};

/// The median of the tones of a part round every pixel.
pub const EVEN_TONES: Pass = Pass {
    name: "shade.even_tones",
    shader: npr_shaders::SHADE_EVEN_TONES,
    slots: &[
        uniform::<Window>("window"),
        read::<Part>("parts"),
        read::<u32>("tone_map"),
        texture("tone_flags", Format::U32),
    ],
    work: Work::Draw {
        of: "window",
        fills: true,
        vertices: 3,
        targets: &[Format::U32],
    },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let window: Window = b.one(0);
        let map = ToneMap {
            size: window.size,
            parts: b.read(1),
            words: b.read(2),
        };
        let flags = b.image(3).texels;
        even_tones(&map, flags, b.image_mut(4).texels);
    },
};

/// Pixels of one known colour, and a list of the others.
pub const FILL_FRAME: Pass = Pass {
    name: "shade.fill_frame",
    shader: npr_shaders::SHADE_FILL_FRAME,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Compose>("compose"),
        texture("ids", Format::U32),
        texture("beam_ids", Format::U32).serving(Features::BEAMS),
        texture("ribbons", Format::Rgba8).serving(Features::RIBBONS),
        texture("smoke_depths", Format::U32).serving(Features::SMOKE),
        texture("fronts", Format::Rgba8).serving(Features::BACKDROP),
        read::<TriangleConstants>("known"),
        update::<u32>("frame"),
        append("list"),
        read::<Part>("parts").serving(Features::EVEN_TONES),
        texture("evened", Format::U32).serving(Features::EVEN_TONES),
    ],
    work: Work::PerElement { of: "frame" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (window, settings) = (b.one(0), b.one(1));
        let (view, lights, rules) = (View::default(), Lights::default(), Rules::default());
        let layers = Layers {
            ids: b.image(2).texels,
            beam_ids: b.image(3).texels,
            ribbons: b.image(4).texels,
            smoke_depths: b.image(5).texels,
            fronts: b.image(6).texels,
            known: b.read(7),
            parts: b.read(10),
            evened: b.image(11).texels,
            ..Layers::empty(&view, &window, &settings, &lights, &rules)
        };
        fill(&layers, b.write(8), b.write(9));
    },
};

/// Surfaces shaded by their ramps, ink, smoke and lines over them, background behind, at the
/// listed pixels.
pub const COMPOSE_FRAME: Pass = Pass {
    name: "shade.compose_frame",
    shader: npr_shaders::SHADE_COMPOSE_FRAME,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Compose>("compose"),
        uniform::<Lights>("lights"),
        texture("ids", Format::U32),
        texture("beam_ids", Format::U32).serving(Features::BEAMS),
        texture("ribbons", Format::Rgba8).serving(Features::RIBBONS),
        read::<PosedVertex>("posed"),
        read::<Vertex>("vertices"),
        read::<TriangleConstants>("triangles"),
        read::<Part>("parts"),
        read::<u32>("texels"),
        texture("charts", Format::U32).serving(Features::INK),
        read::<u32>("list"),
        update::<u32>("frame"),
        layered("shadows", Format::U32).serving(Features::SHADOWS),
        texture("smoke_colors", Format::Rgba8).serving(Features::SMOKE),
        texture("smoke_depths", Format::U32).serving(Features::SMOKE),
        layered("smoke_shadows", Format::Depth).serving(Features::SMOKE_SHADOWS),
        uniform::<Rules>("rules").serving(Features::BACKDROP),
        texture("fronts", Format::Rgba8).serving(Features::BACKDROP),
        texture("backs", Format::Rgba8).serving(Features::BACKDROP),
        texture("evened", Format::U32).serving(Features::EVEN_TONES),
        read::<Triangle>("surfaces").for_twin(),
    ],
    work: Work::PerListed { of: "list" },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (view, window, settings, lights) = (b.one(0), b.one(1), b.one(2), b.one(3));
        let rules = b.one(19);
        let layers = Layers {
            view: &view,
            window: &window,
            compose: &settings,
            lights: &lights,
            ids: b.image(4).texels,
            beam_ids: b.image(5).texels,
            ribbons: b.image(6).texels,
            posed: b.read(7),
            vertices: b.read(8),
            triangles: b.read(23),
            known: b.read(9),
            parts: b.read(10),
            texels: b.read(11),
            charts: b.read(12),
            shadows: b.layers(15),
            smoke_colors: b.image(16).texels,
            smoke_depths: b.image(17).texels,
            smoke_shadows: b.layers(18),
            rules: &rules,
            fronts: b.image(20).texels,
            backs: b.image(21).texels,
            evened: b.image(22).texels,
        };
        compose(&layers, b.read(13), b.write(14));
    },
};

/// How deep each pixel of a picture lies.
pub const FIND_DEPTHS: Pass = Pass {
    name: "shade.find_depths",
    shader: npr_shaders::SHADE_FIND_DEPTHS,
    slots: &[
        uniform::<View>("view"),
        uniform::<Window>("window"),
        uniform::<Compose>("compose"),
        uniform::<Outline>("outline"),
        texture("depth", Format::Depth),
        texture("beam_depth", Format::Depth),
        texture("smoke_depths", Format::U32).serving(Features::SMOKE),
        read::<u32>("frame"),
        write::<f32>("picture_depths"),
    ],
    work: Work::PerElement {
        of: "picture_depths",
    },
    agreement: Agreement::Relative(1e-5),
    twin: |b| {
        let outline: Outline = b.one(3);
        let with = PictureDepths {
            view: &b.one(0),
            window: &b.one(1),
            compose: &b.one(2),
            reach_px: outline.reach_px,
            surfaces: b.read(4),
            beams: b.read(5),
            smoke: b.read(6),
            frame: b.read(7),
        };
        find_depths(&with, b.write(8));
    },
};
