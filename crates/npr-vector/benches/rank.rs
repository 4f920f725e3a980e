//! Ways of ranking lists and of linking the sides of pixels, in nodes and sides per second.
//!
//! Up to a million of each; `NPR_BENCH_MOST=10000000` goes on to ten million, and less is quicker. Each way stands
//! beside a serial walk. `benches/ranking.sh` at the root makes `benches/results/ranking.md` of what this prints.

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use npr_core::math::mix_bits;
use npr_vector::pixel_strokes::ranked_sides;
use npr_vector::pixel_strokes::side::{Ink, PIXELS_A_WORD, Side, link_sides, mark_sides};
use npr_vector::rank::scan::exclusive_scan;
use npr_vector::rank::{self, Link, RankError, Ranked};
use std::time::Duration;

/// Numbers of nodes.
const COUNTS: [usize; 5] = [1_000, 10_000, 100_000, 1_000_000, 10_000_000];

/// The greatest of these unless `NPR_BENCH_MOST` says otherwise.
const MOST: usize = 1_000_000;

type Way = fn(&[u32], &[u32]) -> Result<Ranked, RankError>;

const WAYS: [(&str, Way); 3] = [
    ("serial walk", rank::walk),
    ("wyllie", |next, keys| rank::wyllie(next, keys, None)),
    ("ruling set", |next, keys| {
        rank::ruling_set(next, keys, None)
    }),
];

/// The numbers of nodes that are asked for.
fn counts() -> impl Iterator<Item = usize> {
    let said = std::env::var("NPR_BENCH_MOST").ok();
    let most = said.and_then(|most| most.parse().ok()).unwrap_or(MOST);
    COUNTS.into_iter().filter(move |count| *count <= most)
}

/// Numbers in an order that looks random.
fn shuffled(count: usize) -> Vec<u32> {
    let mut nodes: Vec<u32> = (0..count as u32).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(node ^ 0x9e37_79b9));
    nodes
}

/// Loops of about `length` nodes that are strewn over memory.
fn loops(count: usize, length: usize) -> Vec<u32> {
    let mut next = vec![0; count];
    for chain in shuffled(count).chunks(length) {
        for (at, node) in chain.iter().enumerate() {
            next[*node as usize] = chain[(at + 1) % chain.len()];
        }
    }
    next
}

/// A name and the successors that it stands for.
type Lists = (&'static str, fn(usize) -> Vec<u32>);

/// One loop, many, and those of a random permutation: a few long ones and some short.
const LISTS: [Lists; 3] = [
    ("one loop", |count| loops(count, usize::MAX)),
    ("loops of 200", |count| loops(count, 200)),
    ("random loops", shuffled),
];

fn group<'a>(c: &'a mut Criterion, name: &str) -> BenchmarkGroup<'a, WallTime> {
    let mut group = c.benchmark_group(name);
    group.sample_size(10);
    group.warm_up_time(Duration::from_millis(300));
    group.measurement_time(Duration::from_secs(1));
    group
}

fn rank_lists(c: &mut Criterion) {
    for (name, make) in LISTS {
        let mut group = group(c, &format!("rank {name}"));
        for count in counts() {
            let next = make(count);
            let keys: Vec<u32> = (0..count as u32).collect();
            group.throughput(Throughput::Elements(count as u64));
            for (way, rank) in WAYS {
                group.bench_function(BenchmarkId::new(way, count), |b| {
                    b.iter(|| rank(&next, &keys).expect("lists"));
                });
            }
        }
        group.finish();
    }
}

/// A square picture of ink.
struct Picture {
    side: u32,
    pixels: Vec<u32>,
}

impl Picture {
    /// A picture whose ink `is_ink` names, of the first side with about `side_count` sides, of which there are
    /// `per_pixel` a pixel.
    fn new(side_count: usize, per_pixel: f64, is_ink: fn(u32, u32) -> bool) -> Self {
        let side = (side_count as f64 / per_pixel).sqrt().max(4.0) as u32;
        let place = |pixel: u32| (pixel % side, pixel / side);
        let ink = (0..side * side).map(place).map(|(x, y)| is_ink(x, y));
        Self {
            side,
            pixels: ink.map(u32::from).collect(),
        }
    }

    fn ink(&self) -> Ink<'_> {
        Ink {
            size: [self.side; 2],
            pixels: &self.pixels,
        }
    }
}

/// A name and the picture with about a number of sides that it stands for.
type Pictures = (&'static str, fn(usize) -> Picture);

/// A comb, whose outline is one loop; dots; random ink.
const PICTURES: [Pictures; 3] = [
    ("one loop", |count| {
        Picture::new(count, 1.0, |x, y| y == 0 || x % 2 == 0)
    }),
    ("dots of 8 sides", |count| {
        Picture::new(count, 0.5, |x, y| x % 4 < 2 && y % 4 < 2)
    }),
    ("random ink", |count| {
        Picture::new(count, 1.0, |x, y| {
            mix_bits(x ^ mix_bits(y)).is_multiple_of(2)
        })
    }),
];

/// Links of all sides, all pixels at once.
fn linked(ink: &Ink<'_>) -> Vec<Link> {
    let word_count = ink.pixels.len().div_ceil(PIXELS_A_WORD);
    let (mut masks, mut counts) = (vec![0; word_count], vec![0; word_count]);
    mark_sides(ink.size, &ink.bits(), &mut masks, &mut counts);
    let (starts, total) = exclusive_scan(&counts);
    let mut sides = vec![Side::default(); total as usize];
    let mut links = vec![Link::default(); total as usize];
    let picture = (*ink).into();
    link_sides(&[total], &picture, &masks, &starts, &mut sides, &mut links);
    links
}

/// The loops of a picture side by side, one after the other, as a program without threads follows them: four times
/// pixel plus direction of every side.
fn followed(ink: &Ink<'_>) -> Vec<u32> {
    let mut is_seen = vec![0_u8; ink.pixels.len()];
    let mut sides = Vec::new();
    for pixel in 0..ink.pixels.len() as u32 {
        let mask = ink.sides_of(pixel);
        for direction in (0..4).filter(|direction| mask >> direction & 1 != 0) {
            let mut at = (pixel, direction);
            while is_seen[at.0 as usize] >> at.1 & 1 == 0 {
                is_seen[at.0 as usize] |= 1 << at.1;
                sides.push(4 * at.0 + at.1);
                at = ink.after(at.0, at.1);
            }
        }
    }
    sides
}

fn link_pictures(c: &mut Criterion) {
    for (name, make) in PICTURES {
        let mut group = group(c, &format!("link {name}"));
        for count in counts() {
            let picture = make(count);
            let ink = picture.ink();
            let found = followed(&ink).len();
            assert_eq!(found, linked(&ink).len(), "every side once");
            group.throughput(Throughput::Elements(found as u64));
            group.bench_function(BenchmarkId::new("serial walk", count), |b| {
                b.iter(|| followed(&ink));
            });
            group.bench_function(BenchmarkId::new("links of all sides", count), |b| {
                b.iter(|| linked(&ink));
            });
            group.bench_function(BenchmarkId::new("links and rows", count), |b| {
                b.iter(|| ranked_sides(&ink.into(), &ink.bits(), None).expect("loops"));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, rank_lists, link_pictures);
criterion_main!(benches);
