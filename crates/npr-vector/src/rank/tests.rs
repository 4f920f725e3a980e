//! All ways of ranking against each other, and against lists that are known because they were made.

use super::scan::{BLOCK, compact, exclusive_scan};
use super::splitter::{WALK_LIMIT, WINDOW, find_splitters};
use super::*;
use crate::mesh_lines::graph::CurveGraph;
use proptest::prelude::*;

/// Lists that were chains before their nodes were numbered at random.
#[derive(Debug, Clone)]
struct Lists {
    next: Vec<u32>,
    keys: Vec<u32>,
    /// Nodes of each chain in order, and whether it is closed.
    chains: Vec<(Vec<u32>, bool)>,
}

/// Links chains of these lengths, whose nodes are taken from `nodes` in order.
fn linked(nodes: &[u32], lengths: &[(usize, bool)], keys: Vec<u32>) -> Lists {
    let mut next = vec![NONE; nodes.len()];
    let (mut from, mut chains) = (0, Vec::new());
    for (length, is_closed) in lengths {
        let chain = nodes[from..from + length].to_vec();
        from += length;
        for pair in chain.windows(2) {
            next[pair[0] as usize] = pair[1];
        }
        if *is_closed {
            next[chain[length - 1] as usize] = chain[0];
        }
        chains.push((chain, *is_closed));
    }
    Lists { next, keys, chains }
}

/// Numbers below `count` in an order that only the seed knows.
fn shuffled(count: usize, seed: u32) -> Vec<u32> {
    let mut nodes: Vec<u32> = (0..count as u32).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(node.wrapping_add(0x9e37_79b9) ^ mix_bits(seed)));
    nodes
}

/// A loop of all nodes in the order given, with equal keys.
fn one_loop(nodes: &[u32]) -> Lists {
    linked(nodes, &[(nodes.len(), true)], vec![7; nodes.len()])
}

fn lists() -> impl Strategy<Value = Lists> {
    let length = prop_oneof![4 => 1usize..12, 2 => 12usize..80, 1 => 80usize..400];
    let chains = prop::collection::vec((length, any::<bool>()), 0..12);
    (chains, any::<u32>(), 0u32..4).prop_flat_map(|(lengths, seed, spread)| {
        let count = lengths.iter().map(|(length, _)| length).sum();
        let key = match spread {
            0 => 0..=0u32,
            1 => 0..=9,
            _ => 0..=u32::MAX,
        };
        let keys = prop::collection::vec(key, count);
        keys.prop_map(move |keys| linked(&shuffled(count, seed), &lengths, keys))
    })
}

/// What ranking must give, from chains that are known.
fn expected(lists: &Lists) -> Ranked {
    let mut chains: Vec<Vec<u32>> = Vec::new();
    for (chain, is_closed) in &lists.chains {
        let precedence = |at: &usize| (hash_key(lists.keys[chain[*at] as usize]), chain[*at]);
        let first = (0..chain.len()).min_by_key(precedence).unwrap();
        let first = if *is_closed { first } else { 0 };
        chains.push([&chain[first..], &chain[..first]].concat());
    }
    chains.sort_unstable_by_key(|chain| chain[0]);
    let count = lists.next.len();
    let mut ranked = Ranked {
        head: vec![0; count],
        rank: vec![0; count],
        length: vec![0; count],
        ..Ranked::default()
    };
    for chain in &chains {
        ranked.starts.push(ranked.order.len() as u32);
        for (rank, node) in (0..).zip(chain) {
            ranked.head[*node as usize] = chain[0];
            ranked.rank[*node as usize] = rank;
            ranked.length[*node as usize] = chain.len() as u32;
            ranked.order.push(*node);
        }
    }
    ranked.starts.push(count as u32);
    ranked
}

/// Ranks in all three ways, which must agree.
fn rank_all(lists: &Lists) -> Ranked {
    let Lists { next, keys, .. } = lists;
    let ranked = walk(next, keys).unwrap();
    ranked.sanity_check(next);
    assert!(
        wyllie(next, keys, None).as_ref() == Ok(&ranked),
        "Wyllie's ranking"
    );
    assert!(
        ruling_set(next, keys, None).as_ref() == Ok(&ranked),
        "ranking by splitters"
    );
    ranked
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn all_ways_give_the_chains_that_were_linked(lists in lists()) {
        prop_assert_eq!(rank_all(&lists), expected(&lists));
    }

    #[test]
    fn any_permutation_is_loops(count in 0usize..600, seed in any::<u32>(), key_seed in any::<u32>()) {
        let keys = (0..count as u32).map(|node| mix_bits(node ^ key_seed)).collect();
        let ranked = rank_all(&Lists { next: shuffled(count, seed), keys, chains: Vec::new() });
        prop_assert_eq!(ranked.order.len(), count);
    }

    #[test]
    fn heads_do_not_depend_on_how_nodes_are_numbered(lists in lists(), seed in any::<u32>()) {
        let numbers = shuffled(lists.next.len(), seed);
        let mut other = lists.clone();
        let distinct: Vec<u32> = (0..lists.next.len() as u32).map(|node| mix_bits(node ^ 5)).collect();
        for node in 0..lists.next.len() {
            let (next, at) = (lists.next[node], numbers[node] as usize);
            other.next[at] = if next == NONE { NONE } else { numbers[next as usize] };
            other.keys[at] = distinct[node];
        }
        let (one, two) = (walk(&lists.next, &distinct).unwrap(), walk(&other.next, &other.keys).unwrap());
        for node in 0..lists.next.len() {
            let at = numbers[node] as usize;
            prop_assert_eq!(numbers[one.head[node] as usize], two.head[at]);
            prop_assert_eq!(one.rank[node], two.rank[at]);
            prop_assert_eq!(one.length[node], two.length[at]);
        }
    }

    #[test]
    fn too_few_rounds_are_reported_and_never_wrong(lists in lists(), rounds in 0u32..10) {
        let Lists { next, keys, .. } = &lists;
        let ranked = walk(next, keys).unwrap();
        for found in [wyllie(next, keys, Some(rounds)), ruling_set(next, keys, Some(rounds))] {
            match found {
                Ok(found) => prop_assert_eq!(&found, &ranked),
                Err(RankError::Unsettled { count, rounds: said }) => prop_assert!(count > 0 && said == rounds),
                Err(other) => prop_assert!(false, "{}", other),
            }
        }
        let longest = ranked.length.iter().max().copied().unwrap_or_default();
        if longest as usize <= 1 << rounds {
            prop_assert_eq!(wyllie(next, keys, Some(rounds)), Ok(ranked));
        } else {
            prop_assert!(wyllie(next, keys, Some(rounds)).is_err());
        }
    }

    #[test]
    fn broken_links_are_refused_by_all(
        next in prop::collection::vec(prop_oneof![9 => 0u32..40, 1 => Just(NONE), 1 => any::<u32>()], 0..40),
    ) {
        let keys = vec![0; next.len()];
        let mut seen = std::collections::BTreeSet::new();
        let is_sound = next.iter().all(|n| *n == NONE || ((*n as usize) < next.len() && seen.insert(*n)));
        let found = walk(&next, &keys);
        prop_assert_eq!(found.is_ok(), is_sound);
        prop_assert_eq!(&wyllie(&next, &keys, None), &found);
        prop_assert_eq!(&ruling_set(&next, &keys, None), &found);
    }

    #[test]
    fn sums_are_those_of_all_before(values in prop::collection::vec(any::<u32>(), 0..9000)) {
        let mut sum = 0u32;
        let before = values.iter().map(|v| {
            let before = sum;
            sum = sum.wrapping_add(*v);
            before
        });
        let wanted: Vec<u32> = before.collect();
        prop_assert_eq!(exclusive_scan(&values), (wanted, sum));
    }

    #[test]
    fn compacting_keeps_what_is_marked_in_order(flags in prop::collection::vec(0u32..2, 0..500)) {
        let (slots, count) = exclusive_scan(&flags);
        let mut list = vec![0; count as usize];
        compact(&flags, &slots, &mut list);
        let wanted: Vec<u32> = (0..flags.len() as u32).filter(|i| flags[*i as usize] != 0).collect();
        prop_assert_eq!(list, wanted);
    }

    #[test]
    fn splitters_are_far_apart_and_everywhere(lists in lists()) {
        let links = link(&lists.next, &lists.keys).unwrap();
        let mut flags = vec![0; links.len()];
        find_splitters(&links, &mut flags);
        for (chain, is_closed) in &lists.chains {
            let count: u32 = chain.iter().map(|node| flags[*node as usize]).sum();
            let most = chain.len() as u32 / (WINDOW + 1);
            if *is_closed {
                prop_assert!((1..=most.max(1)).contains(&count));
            } else {
                prop_assert!(flags[chain[0] as usize] == 1 && count <= most + 2);
            }
        }
    }
}

#[test]
fn nothing_at_all() {
    let ranked = rank_all(&one_loop_of(0));
    assert_eq!(ranked.starts, [0]);
    assert_eq!(ranked.chains().count(), 0);
}

fn one_loop_of(count: usize) -> Lists {
    if count == 0 {
        return linked(&[], &[], Vec::new());
    }
    one_loop(&shuffled(count, 3))
}

#[test]
fn lists_around_powers_of_two() {
    for exponent in 0..12 {
        for count in [(1usize << exponent) - 1, 1 << exponent, (1 << exponent) + 1] {
            if count == 0 {
                continue;
            }
            let nodes = shuffled(count, exponent);
            for is_closed in [false, true] {
                let lists = linked(&nodes, &[(count, is_closed)], vec![0; count]);
                assert_eq!(rank_all(&lists), expected(&lists), "{count} nodes");
            }
        }
    }
}

#[test]
fn a_loop_of_a_million() {
    let lists = one_loop_of(1_000_000);
    assert!(rank_all(&lists) == expected(&lists));
}

#[test]
fn a_hundred_thousand_loops_of_three() {
    let count = 300_000;
    let keys = (0..count as u32).map(mix_bits).collect();
    let lists = linked(&shuffled(count, 1), &vec![(3, true); count / 3], keys);
    assert!(rank_all(&lists) == expected(&lists));
}

#[test]
fn every_node_follows_itself() {
    let next: Vec<u32> = (0..1000).collect();
    let ranked = rank_all(&Lists {
        keys: vec![0; 1000],
        chains: Vec::new(),
        next: next.clone(),
    });
    assert_eq!(ranked.order, next);
    assert!(ranked.length.iter().all(|length| *length == 1));
}

#[test]
fn no_node_follows_another() {
    let lists = linked(&shuffled(1000, 9), &vec![(1, false); 1000], vec![0; 1000]);
    assert_eq!(rank_all(&lists), expected(&lists));
}

#[test]
fn keys_and_numbers_in_order_along_a_loop() {
    let count = 100_000u32;
    let upwards: Vec<u32> = (0..count).collect();
    let downwards: Vec<u32> = (0..count).rev().collect();
    let mut by_hash = upwards.clone();
    by_hash.sort_unstable_by_key(|key| hash_key(*key));
    let all_equal = vec![4; count as usize];
    for nodes in [&upwards, &downwards] {
        for keys in [&upwards, &downwards, &by_hash, &all_equal] {
            let lists = linked(nodes, &[(count as usize, true)], keys.clone());
            assert!(rank_all(&lists) == expected(&lists));
        }
    }
}

#[test]
fn walks_stay_far_below_their_limit() {
    let links = link(&one_loop_of(1_000_000).next, &vec![0; 1_000_000]).unwrap();
    let mut flags = vec![0; links.len()];
    find_splitters(&links, &mut flags);
    let (slots, _) = exclusive_scan(&flags);
    let mut walks = vec![jump::Walk::default(); links.len()];
    splitter::walk_to_splitter(&links, &flags, &slots, &mut walks);
    let longest = walks.iter().map(|walk| walk.steps).max();
    assert!(longest < Some(WALK_LIMIT / 4), "{longest:?}");
}

#[test]
fn an_order_made_to_hide_splitters_is_reported() {
    let mut nodes: Vec<u32> = (0..20_000).collect();
    nodes.sort_unstable_by_key(|node| mix_bits(*node));
    let lists = one_loop(&nodes);
    let found = ruling_set(&lists.next, &lists.keys, None);
    assert!(
        matches!(found, Err(RankError::Unsettled { count, .. }) if count > 0),
        "{found:?}"
    );
    let ranked = wyllie(&lists.next, &lists.keys, None);
    assert!(ranked == Ok(expected(&lists)));
}

#[test]
fn an_open_order_made_to_hide_splitters_is_reported() {
    let mut nodes: Vec<u32> = (0..5_000).collect();
    nodes.sort_unstable_by_key(|node| std::cmp::Reverse(mix_bits(*node)));
    let lists = linked(&nodes, &[(5_000, false)], vec![0; 5_000]);
    let found = ruling_set(&lists.next, &lists.keys, None);
    assert!(matches!(found, Err(RankError::Unsettled { .. })));
}

#[test]
fn every_length_is_added_up_around_blocks() {
    for count in [
        0,
        1,
        2,
        BLOCK - 1,
        BLOCK,
        BLOCK + 1,
        BLOCK * BLOCK,
        BLOCK * BLOCK + 1,
    ] {
        let (prefixes, sum) = exclusive_scan(&vec![1; count]);
        assert_eq!(prefixes, (0..count as u32).collect::<Vec<_>>());
        assert_eq!(sum as usize, count);
    }
}

#[test]
fn rounds_beyond_all_reason_end() {
    let lists = one_loop_of(100);
    for ranked in [
        wyllie(&lists.next, &lists.keys, Some(u32::MAX)),
        ruling_set(&lists.next, &lists.keys, Some(u32::MAX)),
    ] {
        assert_eq!(ranked, Ok(expected(&lists)));
    }
}

#[test]
fn curves_are_ranked_by_their_links() {
    let node = |edge, next, prev| crate::mesh_lines::graph::CurveNode {
        edge,
        next,
        prev,
        ..Default::default()
    };
    // Edge 0 has the least hash, so the loop starts there.
    let graph = CurveGraph {
        nodes: vec![
            node(9, 2, 1),
            node(0, 0, 2),
            node(5, 1, 0),
            node(7, NONE, NONE),
        ],
    };
    graph.sanity_check();
    let ranked = rank_curves(&graph).unwrap();
    assert_eq!(ranked.order, [1, 0, 2, 3]);
    assert_eq!(ranked.starts, [0, 3, 4]);
}

#[test]
fn errors_name_what_is_wrong() {
    let two_into_one = walk(&[2, 2, NONE], &[0; 3]).unwrap_err();
    assert_eq!(
        two_into_one.to_string(),
        "nodes 0 and 1 are both followed by node 2"
    );
    let missing = walk(&[3, NONE], &[0; 2]).unwrap_err();
    assert_eq!(
        missing.to_string(),
        "node 0 is followed by node 3, but there are only 2"
    );
    let keys = walk(&[NONE], &[]).unwrap_err();
    assert_eq!(keys.to_string(), "there are 1 nodes, but 0 keys");
}

#[test]
fn no_two_numbers_mix_to_one() {
    let mut mixed: Vec<u32> = (0..100_000).map(mix_bits).collect();
    mixed.sort_unstable();
    mixed.dedup();
    assert_eq!(mixed.len(), 100_000);
    assert_eq!(mix_bits(0), 0);
    assert_eq!(hash_key(0), 1);
}
