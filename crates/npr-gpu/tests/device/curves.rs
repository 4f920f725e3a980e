//! Lists ranked on both engines against a plain walk.

use crate::lists::{Chains, lists};
use crate::shared;
use npr_core::math::mix_bits;
use npr_gpu::curves::ranking::add_ranking;
use npr_gpu::curves::sums::{add_scan, add_sum};
use npr_gpu::curves::work::ListWork;
use npr_gpu::curves::{CurvesError, Scheme, rank_on};
use npr_gpu::engine::Engine;
use npr_gpu::graph::Graph;
use npr_gpu::processor::Processor;
use npr_vector::rank::scan::exclusive_scan;
use npr_vector::rank::{Link, RankError, Ranked, walk};
use proptest::prelude::*;

const SCHEMES: [Scheme; 2] = [Scheme::WYLLIE, Scheme::RULING_SET];

/// The processor, and the device where there is one.
fn engines() -> impl Iterator<Item = &'static dyn Engine> {
    let device = shared::device().map(|device| device as &dyn Engine);
    [Some(&Processor as &dyn Engine), device]
        .into_iter()
        .flatten()
}

/// Ranks on all engines in all ways.
fn check(next: &[u32], keys: &[u32]) {
    for scheme in SCHEMES {
        check_scheme(next, keys, scheme);
    }
}

/// Ranks on all engines.
fn check_scheme(next: &[u32], keys: &[u32], scheme: Scheme) {
    let walked = walk(next, keys).unwrap();
    for engine in engines() {
        let ranked = rank_on(engine, next, keys, scheme).unwrap();
        let (count, on) = (next.len(), engine.describe());
        assert!(ranked == walked, "{scheme:?} of {count} nodes on {on}");
    }
}

/// A loop of all nodes in an order that only the seed knows.
fn one_loop(count: u32, seed: u32) -> Vec<u32> {
    let mut nodes: Vec<u32> = (0..count).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(node ^ mix_bits(!seed)));
    let mut next = vec![0; count as usize];
    for at in 0..count as usize {
        next[nodes[at] as usize] = nodes[(at + 1) % count as usize];
    }
    next
}

#[test]
fn lists_of_every_size_are_ranked() {
    for count in [
        0, 1, 2, 3, 63, 64, 65, 127, 128, 129, 4095, 4096, 4097, 8192, 8193,
    ] {
        for chains in [Chains::Mixed, Chains::Single] {
            let (next, keys) = lists(chains, count, count as u32);
            check(&next, &keys);
        }
    }
}

#[test]
fn random_permutations_are_ranked() {
    for seed in 0..50 {
        let count = 1 + mix_bits(seed + 1) % 3000;
        let mut next: Vec<u32> = (0..count).collect();
        next.sort_unstable_by_key(|node| mix_bits(node ^ mix_bits(!seed)));
        let keys: Vec<u32> = (0..count).map(|node| mix_bits(node) % 16).collect();
        check(&next, &keys);
    }
}

#[test]
fn a_loop_of_a_hundred_thousand_is_ranked() {
    let keys: Vec<u32> = (0..100_000).collect();
    check(&one_loop(100_000, 5), &keys);
    check(&one_loop(100_000, 6), &vec![0; 100_000]);
}

#[test]
fn twenty_runs_give_one_result() {
    let (next, keys) = lists(Chains::Mixed, 20_000, 3);
    let walked = walk(&next, &keys).unwrap();
    for engine in engines() {
        for run in 0..20 {
            for scheme in SCHEMES {
                let ranked = rank_on(engine, &next, &keys, scheme).unwrap();
                assert!(ranked == walked, "run {run} of {scheme:?}");
            }
        }
    }
}

#[test]
fn too_few_rounds_are_reported_alike() {
    let keys = vec![0; 1000];
    let next = one_loop(1000, 2);
    let most = Some(u32::MAX);
    for (scheme, enough) in [
        (Scheme::Wyllie { rounds: Some(9) }, false),
        (Scheme::Wyllie { rounds: Some(10) }, true),
        (Scheme::RulingSet { rounds: Some(3) }, false),
        (Scheme::RulingSet { rounds: Some(7) }, true),
        (Scheme::RulingSet { rounds: most }, true),
        (Scheme::Wyllie { rounds: most }, true),
    ] {
        let found: Vec<Result<Ranked, CurvesError>> = engines()
            .map(|engine| rank_on(engine, &next, &keys, scheme))
            .collect();
        assert!(found.iter().all(|ranked| *ranked == found[0]), "{scheme:?}");
        assert_eq!(found[0].is_ok(), enough, "{scheme:?}");
    }
}

/// Walks to splitters are given up, on every engine after as many steps.
#[test]
fn an_order_made_to_hide_splitters_is_reported_alike() {
    let mut nodes: Vec<u32> = (0..20_000).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(*node));
    let mut next = vec![npr_core::geometry::NONE; nodes.len()];
    for pair in nodes.windows(2) {
        next[pair[1] as usize] = pair[0];
    }
    let keys = vec![0; nodes.len()];
    let found: Vec<_> = engines()
        .map(|engine| rank_on(engine, &next, &keys, Scheme::RULING_SET))
        .collect();
    let is_reported = |ranked: &Result<Ranked, CurvesError>| match ranked {
        Err(CurvesError::Rank(RankError::Unsettled { count, .. })) => *count > 10_000,
        _ => false,
    };
    assert!(
        found.iter().all(is_reported),
        "{:?}",
        found[0].as_ref().err()
    );
    assert!(found.iter().all(|ranked| *ranked == found[0]));
    check_scheme(&next, &keys, Scheme::WYLLIE);
}

#[test]
fn broken_links_never_reach_an_engine() {
    for engine in engines() {
        let found = rank_on(engine, &[1, 7], &[0; 2], Scheme::WYLLIE);
        assert!(matches!(
            found,
            Err(CurvesError::Rank(RankError::MissingNode { node: 1, .. }))
        ));
    }
}

#[test]
fn sums_are_right_around_a_full_row_of_workgroups() {
    let row = 65535 * 64;
    for count in [0, 1, 64, 65, 4096, 4097, row - 1, row, row + 1] {
        let values: Vec<u32> = (0..count).map(mix_bits).collect();
        let (prefixes, sum) = exclusive_scan(&values);
        for engine in engines() {
            let mut graph = Graph::new();
            let bound = graph.buffer::<u32>("values", values.len());
            let scan = add_scan(&mut graph, bound, &ListWork::WHOLE);
            let total = add_sum(&mut graph, bound, &ListWork::WHOLE);
            let mut session = engine.prepare(graph).unwrap();
            session.write(bound, &values).unwrap();
            session.run().unwrap();
            assert_eq!(session.read(scan.total).unwrap(), [sum], "{count} values");
            assert_eq!(session.read(total).unwrap(), [sum], "{count} values");
            assert!(
                session.read(scan.prefixes).unwrap() == prefixes,
                "{count} values"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn passes_rank_like_a_walk(count in 0usize..700, seed in any::<u32>()) {
        let (next, keys) = lists(Chains::Mixed, count, seed);
        let walked = walk(&next, &keys).unwrap();
        for scheme in SCHEMES {
            let ranked = rank_on(&Processor, &next, &keys, scheme).unwrap();
            prop_assert_eq!(&ranked, &walked);
        }
    }
}

#[test]
fn short_lists_take_few_passes() {
    let passes = |count, scheme| {
        let mut graph = Graph::new();
        let links = graph.buffer::<Link>("links", count);
        add_ranking(&mut graph, links, &ListWork::WHOLE, scheme);
        graph.nodes().len()
    };
    assert_eq!(passes(4096, Scheme::RULING_SET), 21);
    assert_eq!(passes(4096, Scheme::WYLLIE), 39);
    assert_eq!(passes(1_000_000, Scheme::RULING_SET), 63);
    assert_eq!(passes(1_000_000, Scheme::WYLLIE), 60);
}
