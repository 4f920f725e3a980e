//! Passes that find what lies behind outlines.

use crate::pass::{Agreement, Format, Pass, Work, read, texture, uniform, write};
use npr_core::geometry::{Part, Triangle};
use npr_core::window::Window;
use npr_style::backdrop::{
    ContrastBias, PartSubject, Rim, Rules, Scenery, Search, TileRims, blend_biases, bound_tiles,
    draw_rims, find_rims, flag_tiles, gather_tiles, smooth_rims, spread_rims, spread_rows,
    vote_bias,
};

/// Which tiles of the output lie near a border between two subjects; its window is the grid of tiles.
pub const FLAG_TILES: Pass = Pass {
    name: "backdrop.flag_tiles",
    shader: npr_shaders::BACKDROP_FLAG_TILES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Window>("output_window"),
        uniform::<Rules>("rules"),
        texture("ids", Format::U32),
        read::<Triangle>("triangles"),
        read::<PartSubject>("part_subjects"),
    ],
    work: Work::Draw {
        of: "rules",
        fills: false,
        vertices: 3,
        targets: &[Format::Rgba8],
    },
    agreement: Agreement::Exact,
    twin: |b| {
        let (window, rules) = (b.one(1), b.one(2));
        let scenery = Scenery {
            window: &window,
            rules: &rules,
            ids: b.image(3).texels,
            triangles: b.read(4),
            part_subjects: b.read(5),
        };
        flag_tiles(&scenery, b.image_mut(6).texels);
    },
};

/// The colours of both sides of every border between subjects.
pub const FIND_RIMS: Pass = Pass {
    name: "backdrop.find_rims",
    shader: npr_shaders::BACKDROP_FIND_RIMS,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        texture("ids", Format::U32),
        texture("depths", Format::Depth),
        texture("drawn_ids", Format::U32),
        texture("busy", Format::Rgba8),
        texture("ribbons", Format::Rgba8),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<PartSubject>("part_subjects"),
        read::<u32>("bare"),
        read::<u32>("overlay"),
        write::<Rim>("rims"),
    ],
    work: Work::PerElement { of: "rims" },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        let search = Search {
            scenery: Scenery {
                window: &window,
                rules: &rules,
                ids: b.image(2).texels,
                triangles: b.read(7),
                part_subjects: b.read(9),
            },
            depths: b.image(3).texels,
            drawn_ids: b.image(4).texels,
            busy: b.image(5).texels,
            ribbons: b.image(6).texels,
            parts: b.read(8),
            bare: b.read(10),
            overlay: b.read(11),
        };
        find_rims(&search, b.write(12));
    },
};

/// Outlines of one pixel outside of the shape.
pub const DRAW_RIMS: Pass = Pass {
    name: "backdrop.draw_rims",
    shader: npr_shaders::BACKDROP_DRAW_RIMS,
    slots: &[
        read::<Part>("parts"),
        read::<Rim>("rims"),
        write::<u32>("overlay"),
    ],
    work: Work::PerElement { of: "overlay" },
    agreement: Agreement::Exact,
    twin: |b| draw_rims(b.read(0), b.read(1), b.write(2)),
};

/// Rims blended along the outline.
pub const SMOOTH_RIMS: Pass = Pass {
    name: "backdrop.smooth_rims",
    shader: npr_shaders::BACKDROP_SMOOTH_RIMS,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<Rim>("rims"),
        write::<Rim>("smoothed"),
    ],
    work: Work::PerElement { of: "smoothed" },
    agreement: Agreement::Texels(0.002),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        smooth_rims(&window, &rules, b.read(2), b.write(3));
    },
};

/// What the lines of every tile of the output start from, and what lies behind them.
pub const GATHER_TILES: Pass = Pass {
    name: "backdrop.gather_tiles",
    shader: npr_shaders::BACKDROP_GATHER_TILES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<Part>("parts"),
        read::<Rim>("rims"),
        write::<TileRims>("tile_rims"),
    ],
    work: Work::PerElement { of: "tile_rims" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        gather_tiles(&window, &rules, b.read(2), b.read(3), b.write(4));
    },
};

/// The bounds of what lies behind the lines of every tile, and the tile's own vote.
pub const BOUND_TILES: Pass = Pass {
    name: "backdrop.bound_tiles",
    shader: npr_shaders::BACKDROP_BOUND_TILES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<TileRims>("tile_rims"),
        write::<ContrastBias>("bounds"),
    ],
    work: Work::PerElement { of: "bounds" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        bound_tiles(&window, &rules, b.read(2), b.write(3));
    },
};

/// Whether the lines of every tile turn darker or brighter.
pub const VOTE_BIAS: Pass = Pass {
    name: "backdrop.vote_bias",
    shader: npr_shaders::BACKDROP_VOTE_BIAS,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<TileRims>("tile_rims"),
        read::<ContrastBias>("bounds"),
        read::<ContrastBias>("before"),
        write::<ContrastBias>("biases"),
    ],
    work: Work::PerElement { of: "biases" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        let (gathered, bounds, before) = (b.read(2), b.read(3), b.read(4));
        vote_bias(&window, &rules, gathered, bounds, before, b.write(5));
    },
};

/// The biases of tiles, kept for the next frame and blended along the outline for this one.
pub const BLEND_BIASES: Pass = Pass {
    name: "backdrop.blend_biases",
    shader: npr_shaders::BACKDROP_BLEND_BIASES,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<ContrastBias>("biases"),
        write::<ContrastBias>("kept"),
        write::<ContrastBias>("blended"),
    ],
    work: Work::PerElement { of: "blended" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        let biases = b.read(2);
        blend_biases(&window, &rules, biases, b.write(3), b.write(4));
    },
};

/// The nearest rim in every row.
pub const SPREAD_ROWS: Pass = Pass {
    name: "backdrop.spread_rows",
    shader: npr_shaders::BACKDROP_SPREAD_ROWS,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<Rim>("rims"),
        write::<u32>("columns"),
    ],
    work: Work::PerElement { of: "columns" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        spread_rows(&window, &rules, b.read(2), b.write(3));
    },
};

/// The nearest rim of every pixel, as pictures.
pub const SPREAD_RIMS: Pass = Pass {
    name: "backdrop.spread_rims",
    shader: npr_shaders::BACKDROP_SPREAD_RIMS,
    slots: &[
        uniform::<Window>("window"),
        uniform::<Rules>("rules"),
        read::<Rim>("rims"),
        read::<u32>("columns"),
        read::<ContrastBias>("biases"),
    ],
    work: Work::Draw {
        of: "rules",
        fills: false,
        vertices: 3,
        targets: &[Format::Rgba8, Format::Rgba8],
    },
    agreement: Agreement::Texels(0.001),
    twin: |b| {
        let (window, rules) = (b.one(0), b.one(1));
        let (rims, columns, biases) = (b.read(2), b.read(3), b.read(4));
        let (fronts, backs) = (b.image_mut(5).texels, b.image_mut(6).texels);
        spread_rims(&window, &rules, rims, columns, biases, fronts, backs);
    },
};
