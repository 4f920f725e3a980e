//! Thin lines as a network: branches of pixels between ends and junctions.

use super::distance::distance2;
use crate::Bitmap;
use glam::DVec2;
use npr_core::geometry::NONE;
use rayon::prelude::*;

/// A run of pixels without forks.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Branch {
    /// Nodes at its ends; [`NONE`] of a closed branch without any.
    pub ends: [u32; 2],
    /// Its pixels in order, those of the nodes at its ends included; of a closed branch without nodes each one once.
    pub pixels: Vec<u32>,
}

/// How far beyond the ink's half width the pixels of a junction lie from its middle at most: five in a row, as where
/// lines run into a blot, and half a pixel.
const PLACE_PX: f64 = 2.5;

/// A place where branches end or meet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Node {
    /// Its pixels: one, or several that touch; of junctions made one those of each in turn.
    pub pixels: Vec<u32>,
    /// Of junctions made one, and of those whose pixels are a way, where in `pixels` those of each but the first begin.
    pub joints: Vec<usize>,
    /// Branches that end here; a branch that starts and ends here stands twice.
    pub branches: Vec<u32>,
}

/// Thin lines as branches between nodes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Network {
    /// Pixels of the thin lines, rows from the top.
    pub pixels: Vec<[u32; 2]>,
    /// Half the width of the ink around each pixel, in pixels: how far the edge of the ink is.
    pub radii: Vec<f64>,
    /// Whether thinning took no ink from the sides of each pixel: lines of such pixels are their ink, one pixel wide.
    pub bare: Vec<bool>,
    /// Ends and junctions.
    pub nodes: Vec<Node>,
    /// Pixels that touch no other.
    pub dots: Vec<u32>,
    /// What lies between.
    pub branches: Vec<Branch>,
}

/// Numbers of the ink pixels of a bitmap.
struct Numbers<'a> {
    bitmap: &'a Bitmap,
    /// Of every word, how many pixels lie before it.
    before: Vec<u32>,
    stride: usize,
}

impl<'a> Numbers<'a> {
    fn of(bitmap: &'a Bitmap) -> Self {
        let stride = bitmap.width().div_ceil(64) as usize;
        let words = (0..bitmap.height() as usize).flat_map(|y| bitmap.row(y));
        let before = words
            .scan(0, |count, word| {
                *count += word.count_ones();
                Some(*count - word.count_ones())
            })
            .collect();
        Self {
            bitmap,
            before,
            stride,
        }
    }

    /// The number of an ink pixel; none of a white one.
    fn get(&self, x: i64, y: i64) -> Option<u32> {
        if !self.bitmap.is_ink(x, y) {
            return None;
        }
        let (word, bit) = (x as usize / 64, x as usize % 64);
        let low = self.bitmap.row(y as usize)[word] & ((1 << bit) - 1);
        Some(self.before[y as usize * self.stride + word] + low.count_ones())
    }

    fn pixels(&self) -> Vec<[u32; 2]> {
        let mut pixels = Vec::new();
        for y in 0..self.bitmap.height() {
            for (index, word) in (0..).zip(self.bitmap.row(y as usize)) {
                let mut left = *word;
                while left != 0 {
                    pixels.push([index * 64 + left.trailing_zeros(), y]);
                    left &= left - 1;
                }
            }
        }
        pixels
    }

    /// Pixels that one touches: by its sides, and by its corners where no side leads there.
    fn neighbours(&self, [x, y]: [u32; 2]) -> Neighbours {
        let at = |dx: i64, dy: i64| self.get(i64::from(x) + dx, i64::from(y) + dy);
        let sides = [at(1, 0), at(0, -1), at(-1, 0), at(0, 1)];
        let corners = [(1, -1), (-1, -1), (-1, 1), (1, 1)];
        let mut found = Neighbours::default();
        let reached = corners.iter().enumerate().filter_map(|(i, (dx, dy))| {
            let is_beside = sides[i].is_some() || sides[(i + 1) % 4].is_some();
            if is_beside { None } else { at(*dx, *dy) }
        });
        for pixel in sides.into_iter().flatten().chain(reached) {
            found.pixels[found.count] = pixel;
            found.count += 1;
        }
        found
    }
}

/// At most eight pixels.
#[derive(Debug, Clone, Copy, Default)]
struct Neighbours {
    pixels: [u32; 8],
    count: usize,
}

impl Neighbours {
    fn list(&self) -> &[u32] {
        &self.pixels[..self.count]
    }
}

impl Network {
    /// Takes pixels of a junction for junctions made one, where they are no place but a way: in noise whole chains of
    /// pixels have three neighbours and more.
    fn part_long_junctions(&mut self) {
        for node in 0..self.nodes.len() as u32 {
            let spread = self.reach(node) - self.radius(node);
            if spread > self.radius(node) + PLACE_PX {
                let count = self.nodes[node as usize].pixels.len();
                self.nodes[node as usize].joints = (1..count).collect();
            }
        }
    }

    /// The network of thin lines, as [`thin`](super::thin()) leaves them; `ink` is what they were thinned from.
    ///
    /// Pixels with three neighbours or more make a junction, together with those they touch; pixels with one are
    /// ends. Nodes come in the order of their first pixels. O(pixels), radii on all threads.
    pub fn of(thinned: &Bitmap, ink: &Bitmap) -> Self {
        // Number the thin pixels, with their neighbours and the width of ink around.
        let numbers = Numbers::of(thinned);
        let pixels = numbers.pixels();
        let neighbours: Vec<Neighbours> =
            pixels.par_iter().map(|p| numbers.neighbours(*p)).collect();
        let radii = pixels
            .par_iter()
            .map(|[x, y]| (distance2(ink, *x, *y) as f64).sqrt() - 0.5)
            .collect();

        // Note pixels from whose sides thinning took no ink.
        let is_taken = |x: i64, y: i64| ink.is_ink(x, y) && !thinned.is_ink(x, y);
        let bare = pixels
            .par_iter()
            .map(|pixel| {
                let [x, y] = pixel.map(i64::from);
                let beside = [[x + 1, y], [x, y - 1], [x - 1, y], [x, y + 1]];
                !beside.into_iter().any(|[x, y]| is_taken(x, y))
            })
            .collect();

        // Make nodes of ends and forks, and walk the branches between them.
        let (nodes, node_of) = nodes(&neighbours);
        let is_alone = |pixel: &u32| neighbours[*pixel as usize].count == 0;
        let dots = (0..pixels.len() as u32).filter(is_alone).collect();
        let mut network = Self {
            pixels,
            radii,
            bare,
            nodes,
            dots,
            branches: Vec::new(),
        };
        network.part_long_junctions();
        network.walk_branches(&neighbours, &node_of);
        network
    }

    /// The middle of a pixel.
    pub fn place(&self, pixel: u32) -> DVec2 {
        let [x, y] = self.pixels[pixel as usize];
        DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }

    fn walk_branches(&mut self, neighbours: &[Neighbours], node_of: &[u32]) {
        let mut seen = vec![false; neighbours.len()];
        for node in 0..self.nodes.len() as u32 {
            for start in self.nodes[node as usize].pixels.clone() {
                for next in neighbours[start as usize].list() {
                    let other = node_of[*next as usize];
                    // Pixels inside a node are no branch; one between two nodes is found from the first.
                    let is_first = other == NONE && !seen[*next as usize];
                    if is_first || (other != NONE && other > node) {
                        let pixels = walk([start, *next], neighbours, node_of, &mut seen);
                        let last = pixels[pixels.len() - 1];
                        self.add([node, node_of[last as usize]], pixels);
                    }
                }
            }
        }
        for start in 0..neighbours.len() as u32 {
            let is_left = node_of[start as usize] == NONE && !seen[start as usize];
            if is_left && neighbours[start as usize].count == 2 {
                seen[start as usize] = true;
                let next = neighbours[start as usize].pixels[0];
                let pixels = walk([start, next], neighbours, node_of, &mut seen);
                self.add([NONE; 2], pixels);
            }
        }
    }

    fn add(&mut self, ends: [u32; 2], pixels: Vec<u32>) {
        let number = self.branches.len() as u32;
        for node in ends.into_iter().filter(|node| *node != NONE) {
            self.nodes[node as usize].branches.push(number);
        }
        self.branches.push(Branch { ends, pixels });
    }
}

/// All nodes, and the node of every pixel.
fn nodes(neighbours: &[Neighbours]) -> (Vec<Node>, Vec<u32>) {
    let mut node_of = vec![NONE; neighbours.len()];
    let mut nodes: Vec<Node> = Vec::new();
    for seed in 0..neighbours.len() {
        if node_of[seed] != NONE || matches!(neighbours[seed].count, 0 | 2) {
            continue;
        }

        // Begin a node at an end or a fork.
        let number = nodes.len() as u32;
        node_of[seed] = number;
        let mut node = Node {
            pixels: vec![seed as u32],
            joints: Vec::new(),
            branches: Vec::new(),
        };

        // Let it grow over forks side by side.
        let mut at = 0;
        while at < node.pixels.len() {
            let around = &neighbours[node.pixels[at] as usize];
            at += 1;
            if around.count < 3 {
                continue;
            }
            for next in around.list() {
                if neighbours[*next as usize].count > 2 && node_of[*next as usize] == NONE {
                    node_of[*next as usize] = number;
                    node.pixels.push(*next);
                }
            }
        }
        nodes.push(node);
    }
    (nodes, node_of)
}

/// Pixels from the first two on, up to a node or back to the start, which is not repeated.
fn walk(
    [first, second]: [u32; 2],
    neighbours: &[Neighbours],
    node_of: &[u32],
    seen: &mut [bool],
) -> Vec<u32> {
    let mut pixels = vec![first];
    let (mut before, mut here) = (first, second);
    while here != first || node_of[first as usize] != NONE {
        pixels.push(here);
        if node_of[here as usize] != NONE {
            break;
        }
        seen[here as usize] = true;
        let [a, b] = [0, 1].map(|i| neighbours[here as usize].pixels[i]);
        let next = if a == before { b } else { a };
        before = std::mem::replace(&mut here, next);
    }
    pixels
}
