//! Passes over vertices and edges.

use crate::pass::{Agreement, Pass, Work, read, uniform, write};
use npr_core::geometry::{Edge, EdgeRole, Influence, Part, PosedVertex, Triangle, Vertex};
use npr_core::outline::Outline;
use npr_core::window::View;
use npr_mesh::classify::{PosedMesh, classify};
use npr_mesh::hull;
use npr_mesh::pose::{Matrix, Pose, pose};
use npr_mesh::project::project;

/// Every vertex posed, projected and given its line width.
pub const POSE_VERTICES: Pass = Pass {
    name: "mesh.pose_vertices",
    shader: npr_shaders::MESH_POSE_VERTICES,
    slots: &[
        uniform::<View>("view"),
        uniform::<Outline>("outline"),
        read::<Vertex>("vertices"),
        read::<Influence>("influences"),
        read::<Matrix>("palette"),
        read::<Part>("parts"),
        write::<PosedVertex>("posed"),
    ],
    work: Work::PerElement { of: "vertices" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let (view, outline) = (b.one(0), b.one(1));
        let with = Pose {
            view: &view,
            outline: &outline,
            influences: b.read(3),
            palette: b.read(4),
            parts: b.read(5),
        };
        pose(&with, b.read(2), b.write(6));
    },
};

/// Which edges may become lines, and of which kind.
pub const CLASSIFY_EDGES: Pass = Pass {
    name: "mesh.classify_edges",
    shader: npr_shaders::MESH_CLASSIFY_EDGES,
    slots: &[
        uniform::<Outline>("outline"),
        read::<PosedVertex>("posed"),
        read::<Triangle>("triangles"),
        read::<Part>("parts"),
        read::<Edge>("edges"),
        write::<EdgeRole>("roles"),
    ],
    work: Work::PerElement { of: "edges" },
    agreement: Agreement::Exact,
    twin: |b| {
        let outline = b.one(0);
        let mesh = PosedMesh {
            posed: b.read(1),
            triangles: b.read(2),
            parts: b.read(3),
        };
        classify(&outline, &mesh, b.read(4), b.write(5));
    },
};

/// Vertices pushed outwards by the line width.
pub const EXTRUDE_HULL: Pass = Pass {
    name: "mesh.extrude_hull",
    shader: npr_shaders::MESH_EXTRUDE_HULL,
    slots: &[
        uniform::<View>("view"),
        read::<Vertex>("vertices"),
        read::<Influence>("influences"),
        read::<Matrix>("palette"),
        read::<PosedVertex>("posed"),
        write::<[f32; 4]>("hull"),
    ],
    work: Work::PerElement { of: "vertices" },
    agreement: Agreement::Relative(1e-4),
    twin: |b| {
        let view: View = b.one(0);
        hull::extrude(
            &view,
            b.read(2),
            b.read(3),
            b.read(1),
            b.read(4),
            b.write(5),
        );
    },
};

/// Posed vertices where a light with shadows sees them.
pub const PROJECT_SHADOW: Pass = Pass {
    name: "mesh.project_shadow",
    shader: npr_shaders::MESH_PROJECT_SHADOW,
    slots: &[
        uniform::<Matrix>("light_from_world"),
        read::<PosedVertex>("posed"),
        write::<[f32; 4]>("projected"),
    ],
    work: Work::PerElement { of: "posed" },
    agreement: Agreement::Relative(1e-5),
    twin: |b| project(&b.one(0), b.read(1), b.write(2)),
};
