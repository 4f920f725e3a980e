//! Half-edges gathered by the unique edge that they run along.

use npr_core::edge_flags::EdgeFlags;
use rayon::prelude::*;

use crate::buckets::Buckets;

/// Half-edges `3 f + i` of all faces, grouped by edge; edges ascend by lower, then by higher vertex.
///
/// Of one edge come first the half-edges that run up, from the lower vertex to the higher, in ascending order.
pub(crate) struct Sides {
    /// Where the half-edges of each edge start; one more than there are edges.
    pub(crate) starts: Vec<u32>,
    pub(crate) half_edges: Vec<u32>,
    /// The lower and the higher vertex of every edge.
    pub(crate) ends: Vec<[u32; 2]>,
    /// [`EdgeFlags::BOUNDARY`], [`EdgeFlags::NON_MANIFOLD`], [`EdgeFlags::FLIPPED`] or none of them for every
    /// edge.
    pub(crate) traits: Vec<EdgeFlags>,
}

/// Set in a key where the half-edge runs down; limits a mesh to 2^31 half-edges.
const DOWN: u64 = 1 << 31;

impl Sides {
    /// Sorts half-edges by 64-bit keys: by lower vertex in one counting sort, then each short bucket by
    /// higher vertex and direction. O(n log k) with at most `k` edges at one vertex.
    ///
    /// # Panics
    ///
    /// If there are 2^31 half-edges or more.
    pub(crate) fn of_faces(faces: &[[u32; 3]], vertex_count: usize) -> Self {
        let half_edge_count = 3 * faces.len();
        assert!(
            (half_edge_count as u64) < DOWN,
            "a mesh has fewer than 2^31 half-edges"
        );

        // Gather half-edges by their lower vertex.
        let lower: Vec<[u32; 3]> = faces
            .par_iter()
            .map(|&[a, b, c]| [a.min(b), b.min(c), c.min(a)])
            .collect();
        let buckets = Buckets::new(vertex_count, lower.as_flattened(), |h| key(faces, h));

        // Sort every bucket by higher vertex and direction.
        let runs = buckets.gather(|run| {
            let mut sorted = SortedRun::default();
            run.for_each(|start, keys| sorted.add(start, keys, &lower));
            sorted
        });

        // Join the runs in the order of vertices.
        let mut sides = Self {
            starts: Vec::with_capacity(half_edge_count / 2 + 1),
            half_edges: Vec::with_capacity(half_edge_count),
            ends: Vec::with_capacity(half_edge_count / 2),
            traits: Vec::with_capacity(half_edge_count / 2),
        };
        for run in runs {
            sides.starts.extend_from_slice(&run.starts);
            sides.half_edges.extend_from_slice(&run.half_edges);
            sides.ends.extend_from_slice(&run.ends);
            sides.traits.extend_from_slice(&run.traits);
        }
        sides.starts.push(half_edge_count as u32);
        sides
    }
}

/// The higher vertex, the direction and the number of a half-edge.
fn key(faces: &[[u32; 3]], half_edge: u32) -> u64 {
    let [face, i] = [half_edge / 3, half_edge % 3].map(|v| v as usize);
    let [tail, head] = [faces[face][i], faces[face][(i + 1) % 3]];
    let down = if tail > head { DOWN } else { 0 };
    u64::from(tail.max(head)) << 32 | down | u64::from(half_edge)
}

/// The number of the half-edge of a key.
fn half_edge_of(key: u64) -> u32 {
    (key & (DOWN - 1)) as u32
}

/// Edges of consecutive lower vertices.
#[derive(Default)]
struct SortedRun {
    starts: Vec<u32>,
    half_edges: Vec<u32>,
    ends: Vec<[u32; 2]>,
    traits: Vec<EdgeFlags>,
    scratch: Vec<u64>,
}

impl SortedRun {
    /// Appends the edges of one lower vertex, whose half-edges start at `start` among all; `lower` has the lower vertex
    /// of every half-edge, face by face.
    fn add(&mut self, start: usize, keys: &[u64], lower: &[[u32; 3]]) {
        self.scratch.clear();
        self.scratch.extend_from_slice(keys);
        self.scratch.sort_unstable();
        let mut start = start as u32;
        for edge in self.scratch.chunk_by(|a, b| a >> 32 == b >> 32) {
            self.starts.push(start);
            let half_edge = half_edge_of(edge[0]) as usize;
            let low = lower[half_edge / 3][half_edge % 3];
            self.ends.push([low, (edge[0] >> 32) as u32]);
            self.traits.push(meeting(edge));
            self.half_edges
                .extend(edge.iter().map(|key| half_edge_of(*key)));
            start += edge.len() as u32;
        }
    }
}

/// How the faces of an edge meet, told from its keys.
fn meeting(keys: &[u64]) -> EdgeFlags {
    match keys {
        [_] => EdgeFlags::BOUNDARY,
        [a, b] if (a ^ b) & DOWN == 0 => EdgeFlags::FLIPPED,
        [_, _] => EdgeFlags::NONE,
        _ => EdgeFlags::NON_MANIFOLD,
    }
}
