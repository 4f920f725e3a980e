//! Passes that draw lines into a picture pixel by pixel and make strokes of them.
//!
//! [`crate::curves::pixels`] lines them up. Up to the links of sides they are exact; smoothing agrees within rounding,
//! so a side whose direction lies on a threshold may be kept by one engine alone.

use crate::pass::{
    Agreement, Format, Image, Pass, Work, indices, read, scatter, texture, uniform, write,
};
use npr_vector::mesh_lines::contour::steps::Viewer;
use npr_vector::pixel_strokes::edge::{DrawnEdge, Facing, mark_edges};
use npr_vector::pixel_strokes::fragment::{self, Fragment};
use npr_vector::pixel_strokes::looped::{self, Filter, Gathered, Ordered, SpeckRule, Spot};
use npr_vector::pixel_strokes::planar::Planar;
use npr_vector::pixel_strokes::segment::{Drawn, PixelView, Segment, project_edges};
use npr_vector::pixel_strokes::side::{self, Ink, InkPicture, Side};
use npr_vector::pixel_strokes::strip::{self, CullRule, StripSpot};
use npr_vector::pixel_strokes::surface;
use npr_vector::rank::Link;
use npr_vector::rank::place::Standing;

/// Which edges are drawn, as which kind, and in which direction.
pub const MARK_EDGES: Pass = Pass {
    name: "vector.mark_edges",
    shader: npr_shaders::VECTOR_MARK_EDGES,
    slots: &[
        uniform::<Viewer>("viewer"),
        uniform::<PixelView>("view"),
        read::<f32>("positions"),
        read::<u32>("front"),
        read::<DrawnEdge>("edges"),
        write::<u32>("flags"),
        write::<u32>("marks"),
    ],
    work: Work::PerElement { of: "edges" },
    agreement: Agreement::Exact,
    twin: |b| {
        let view: PixelView = b.one(1);
        let on = Facing {
            viewer: &b.one(0),
            wanted: view.wanted,
            is_convex_only: view.is_convex_only != 0,
            positions: b.read(2),
            front: b.read(3),
        };
        let (flags, marks) = (b.write(5), b.write(6));
        mark_edges(&on, b.read(4), flags, marks);
    },
};

/// Edges cut to the view, on the fine grid, with their numbers of fragments.
pub const PROJECT_EDGES: Pass = Pass {
    name: "vector.project_edges",
    shader: npr_shaders::VECTOR_PROJECT_EDGES,
    slots: &[
        uniform::<PixelView>("view"),
        read::<u32>("extent"),
        read::<u32>("list"),
        read::<u32>("marks"),
        read::<DrawnEdge>("edges"),
        read::<f32>("positions"),
        write::<Segment>("segments"),
        write::<u32>("counts"),
    ],
    work: Work::PerElement { of: "segments" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (segments, counts) = (b.write(6), b.write(7));
        let drawn = Drawn {
            view: &b.one(0),
            extent: b.read(1),
            list: b.read(2),
            marks: b.read(3),
            edges: b.read(4),
            positions: b.read(5),
        };
        project_edges(&drawn, segments, counts);
    },
};

/// Depths of the surfaces that hide lines.
pub const DRAW_SURFACES: Pass = Pass {
    name: "vector.draw_surfaces",
    shader: npr_shaders::VECTOR_DRAW_SURFACES,
    slots: &[
        uniform::<PixelView>("view"),
        read::<f32>("positions"),
        indices("corners"),
    ],
    work: Work::Draw {
        of: "corners",
        vertices: 1,
        targets: &[Format::Depth],
        fills: true,
    },
    // Corners lie within 1/256 of a pixel, and a device is free in which: slopes shift depths, and edges shift pixels.
    agreement: Agreement::NearlyAll {
        share: 0.001,
        bound: 1e-4,
    },
    twin: |b| {
        let depths = b.image_mut(3);
        surface::draw_surfaces(&b.one(0), b.read(1), b.read(2), depths.texels);
    },
};

/// The fragments of all segments.
pub const EMIT_FRAGMENTS: Pass = Pass {
    name: "vector.emit_fragments",
    shader: npr_shaders::VECTOR_EMIT_FRAGMENTS,
    slots: &[
        uniform::<PixelView>("view"),
        read::<u32>("extent"),
        read::<u32>("segment_count"),
        read::<u32>("starts"),
        read::<Segment>("segments"),
        write::<Fragment>("fragments"),
    ],
    work: Work::PerElement { of: "fragments" },
    agreement: Agreement::Exact,
    twin: |b| {
        let (segment_count, starts) = (b.read(2), b.read(3));
        let fragments = b.write(5);
        fragment::emit_fragments(
            &b.one(0),
            b.read(1),
            segment_count,
            starts,
            b.read(4),
            fragments,
        );
    },
};

/// Which fragments show, by the depths around them, and which pixels these ink.
pub const TEST_FRAGMENTS: Pass = Pass {
    name: "vector.test_fragments",
    shader: npr_shaders::VECTOR_TEST_FRAGMENTS,
    slots: &[
        uniform::<PixelView>("view"),
        texture("surfaces", Format::Depth),
        texture("occluder_depths", Format::U32),
        read::<Fragment>("fragments"),
        write::<u32>("shown"),
        scatter::<u32>("ink"),
    ],
    work: Work::PerElement { of: "fragments" },
    agreement: Agreement::Exact,
    twin: |b| {
        let scene = [b.read(1), b.read(2)];
        let (shown, ink) = (b.write(4), b.write(5));
        fragment::test_fragments(&b.one(0), scene, b.read(3), shown, ink);
    },
};

/// The nearest fragment of every pixel, and its reversed depth.
pub const DRAW_NEAREST: Pass = Pass {
    name: "vector.draw_nearest",
    shader: npr_shaders::VECTOR_DRAW_NEAREST,
    slots: &[
        uniform::<PixelView>("view"),
        read::<Fragment>("fragments"),
        read::<u32>("shown"),
    ],
    work: Work::Draw {
        of: "fragments",
        fills: false,
        vertices: 3,
        targets: &[Format::U32, Format::Depth],
    },
    agreement: Agreement::Exact,
    twin: |b| {
        let (owners, nearest) = (b.image_mut(3), b.image_mut(4));
        fragment::draw_nearest(b.read(1), b.read(2), owners.texels, nearest.texels);
    },
};

/// The sides of inked pixels, eight pixels a word.
pub const MARK_SIDES: Pass = Pass {
    name: "vector.mark_sides",
    shader: npr_shaders::VECTOR_MARK_SIDES,
    slots: &[
        uniform::<PixelView>("view"),
        read::<u32>("ink"),
        write::<u32>("masks"),
        write::<u32>("counts"),
    ],
    work: Work::PerElement { of: "masks" },
    agreement: Agreement::Exact,
    twin: |b| {
        let view: PixelView = b.one(0);
        side::mark_sides(view.size, b.read(1), b.write(2), b.write(3));
    },
};

/// Sides linked to those before and after them, with what shows at their pixels.
pub const LINK_SIDES: Pass = Pass {
    name: "vector.link_sides",
    shader: npr_shaders::VECTOR_LINK_SIDES,
    slots: &[
        read::<u32>("extent"),
        texture("ink", Format::U32),
        texture("nearest", Format::Depth),
        read::<Segment>("segments"),
        read::<u32>("masks"),
        read::<u32>("starts"),
        write::<Side>("sides"),
        write::<Link>("links"),
    ],
    work: Work::PerElement { of: "sides" },
    agreement: Agreement::Exact,
    twin: |b| {
        let picture = InkPicture {
            ink: ink_of(b.image(1)),
            nearest: b.image(2).texels,
            segments: b.read(3),
        };
        let (sides, links) = (b.write(6), b.write(7));
        side::link_sides(b.read(0), &picture, b.read(4), b.read(5), sides, links);
    },
};

/// Sides in the order of their loops.
pub const GATHER_SIDES: Pass = Pass {
    name: "vector.gather_sides",
    shader: npr_shaders::VECTOR_GATHER_SIDES,
    slots: &[
        uniform::<PixelView>("view"),
        read::<u32>("order"),
        read::<Standing>("standings"),
        read::<Side>("sides"),
        write::<Spot>("spots"),
        write::<Planar>("places"),
        write::<Planar>("directions"),
        write::<u32>("areas"),
    ],
    work: Work::PerElement { of: "order" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| {
        let into = Gathered {
            spots: b.write(4),
            places: b.write(5),
            directions: b.write(6),
            areas: b.write(7),
        };
        let view: PixelView = b.one(0);
        let on = Ordered {
            width: view.size[0],
            order: b.read(1),
            standings: b.read(2),
            sides: b.read(3),
        };
        looped::gather_sides(&on, into);
    },
};

fn ink_of(image: Image<'_>) -> Ink<'_> {
    Ink {
        size: image.size,
        pixels: image.texels,
    }
}

/// Marks of loops that are no specks.
pub const DROP_SPECKS: Pass = Pass {
    name: "vector.drop_specks",
    shader: npr_shaders::VECTOR_DROP_SPECKS,
    slots: &[
        uniform::<SpeckRule>("rule"),
        read::<Spot>("spots"),
        read::<u32>("areas"),
        read::<u32>("sums"),
        write::<u32>("kept"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Exact,
    twin: |b| {
        looped::drop_specks(&b.one(0), b.read(1), b.read(2), b.read(3), b.write(4));
    },
};

/// Means along loops.
pub const SMOOTH_LOOPS: Pass = Pass {
    name: "vector.smooth_loops",
    shader: npr_shaders::VECTOR_SMOOTH_LOOPS,
    slots: &[
        uniform::<Filter>("means"),
        read::<f32>("weights"),
        read::<Spot>("spots"),
        read::<Planar>("vectors_in"),
        write::<Planar>("vectors_out"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        looped::smooth_loops(&b.one(0), b.read(1), b.read(2), b.read(3), b.write(4));
    },
};

/// Unit tangents of loops.
pub const FIT_TANGENTS: Pass = Pass {
    name: "vector.fit_tangents",
    shader: npr_shaders::VECTOR_FIT_TANGENTS,
    slots: &[
        uniform::<Filter>("means"),
        read::<f32>("weights"),
        read::<Spot>("spots"),
        read::<Planar>("places"),
        write::<Planar>("tangents"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Relative(1e-3),
    twin: |b| {
        looped::fit_tangents(&b.one(0), b.read(1), b.read(2), b.read(3), b.write(4));
    },
};

/// Sides whose loop runs in the direction of the contour.
pub const CULL_SIDES: Pass = Pass {
    name: "vector.cull_sides",
    shader: npr_shaders::VECTOR_CULL_SIDES,
    slots: &[
        uniform::<CullRule>("rule"),
        read::<Planar>("tangents"),
        read::<Planar>("directions"),
        read::<u32>("kept_in"),
        write::<u32>("kept_out"),
    ],
    work: Work::PerElement { of: "kept_in" },
    // Of a cosine just at the threshold, engines may think differently.
    agreement: Agreement::NearlyAll {
        share: 0.001,
        bound: 0.0,
    },
    twin: |b| strip::cull_sides(&b.one(0), b.read(1), b.read(2), b.read(3), b.write(4)),
};

/// Sides kept by a vote of those around them.
pub const VOTE_SIDES: Pass = Pass {
    name: "vector.vote_sides",
    shader: npr_shaders::VECTOR_VOTE_SIDES,
    slots: &[
        uniform::<CullRule>("rule"),
        read::<Spot>("spots"),
        read::<u32>("kept_in"),
        write::<u32>("kept_out"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Exact,
    twin: |b| strip::vote_sides(&b.one(0), b.read(1), b.read(2), b.write(3)),
};

/// First sides of strips.
pub const START_STRIPS: Pass = Pass {
    name: "vector.start_strips",
    shader: npr_shaders::VECTOR_START_STRIPS,
    slots: &[
        read::<Spot>("spots"),
        read::<u32>("kept"),
        write::<u32>("flags"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Exact,
    twin: |b| strip::start_strips(b.read(0), b.read(1), b.write(2)),
};

/// Places of sides in their strips.
pub const RANK_STRIPS: Pass = Pass {
    name: "vector.rank_strips",
    shader: npr_shaders::VECTOR_RANK_STRIPS,
    slots: &[
        read::<Spot>("spots"),
        read::<u32>("kept"),
        read::<u32>("flags"),
        read::<u32>("slots"),
        read::<u32>("firsts"),
        write::<StripSpot>("strips"),
    ],
    work: Work::PerElement { of: "spots" },
    agreement: Agreement::Exact,
    twin: |b| {
        let strips = b.write(5);
        strip::rank_strips(
            b.read(0),
            b.read(1),
            b.read(2),
            b.read(3),
            b.read(4),
            strips,
        );
    },
};

/// Lengths of strips, at their first sides.
pub const MEASURE_STRIPS: Pass = Pass {
    name: "vector.measure_strips",
    shader: npr_shaders::VECTOR_MEASURE_STRIPS,
    slots: &[
        read::<Spot>("spots"),
        read::<u32>("kept"),
        read::<StripSpot>("strips"),
        write::<u32>("lengths"),
    ],
    work: Work::PerElement { of: "strips" },
    agreement: Agreement::Exact,
    twin: |b| strip::measure_strips(b.read(0), b.read(1), b.read(2), b.write(3)),
};

/// Sides of strips that are long enough.
pub const DROP_SHORT: Pass = Pass {
    name: "vector.drop_short",
    shader: npr_shaders::VECTOR_DROP_SHORT,
    slots: &[
        uniform::<CullRule>("rule"),
        read::<StripSpot>("strips"),
        read::<u32>("lengths"),
        write::<u32>("kept"),
    ],
    work: Work::PerElement { of: "strips" },
    agreement: Agreement::Exact,
    twin: |b| strip::drop_short(&b.one(0), b.read(1), b.read(2), b.write(3)),
};
