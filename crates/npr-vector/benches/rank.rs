//! Ways of ranking lists, in nodes per second.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use npr_core::math::mix_bits;
use npr_vector::rank::{self, RankError, Ranked};
use std::time::Duration;

/// Numbers of nodes.
const COUNTS: [usize; 4] = [1_000, 10_000, 100_000, 1_000_000];

type Way = fn(&[u32], &[u32]) -> Result<Ranked, RankError>;

const WAYS: [(&str, Way); 3] = [
    ("walk", rank::walk),
    ("wyllie", |next, keys| rank::wyllie(next, keys, None)),
    ("ruling set", |next, keys| {
        rank::ruling_set(next, keys, None)
    }),
];

/// Loops of about `length` nodes that are strewn over memory, and their keys.
fn loops(count: usize, length: usize) -> (Vec<u32>, Vec<u32>) {
    let mut nodes: Vec<u32> = (0..count as u32).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(node ^ 0x9e37_79b9));
    let mut next = vec![0; count];
    for chain in nodes.chunks(length) {
        for (at, node) in chain.iter().enumerate() {
            next[*node as usize] = chain[(at + 1) % chain.len()];
        }
    }
    (next, (0..count as u32).collect())
}

fn rank_lists(c: &mut Criterion) {
    for (name, length) in [("one loop", usize::MAX), ("loops of 200", 200)] {
        let mut group = c.benchmark_group(format!("rank {name}"));
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300));
        group.measurement_time(Duration::from_secs(1));
        for count in COUNTS {
            let (next, keys) = loops(count, length);
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

criterion_group!(benches, rank_lists);
criterion_main!(benches);
