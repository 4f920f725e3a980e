//! Angles on the nodes of a graph, smoothed from coarse to fine.
//!
//! Every link of the graph says how the value at its other end looks from here: turned by an angle, and
//! mirrored where the two nodes count in opposite senses. Smooth values are those which agree with what
//! their neighbours say. Rounds of averaging alone would take as many rounds as the graph is wide, so groups of
//! linked nodes are first merged into one node that stands for all, level after level, and the smoothing runs
//! from the coarsest level down [Jakob et al. 2015, 3.4].
//!
//! Differs: the paper places coarse nodes in space and computes their links anew; here a coarse link is the sum
//! of the fine ones it replaces (an aggregation in the sense of algebraic multigrid). Links that contradict each
//! other cancel, so coarse levels do not guess across distances over which the angle is not known.

use rayon::prelude::*;

use super::complex::Complex;
use super::nodes::Nodes;

/// Stands for "no node".
const NONE: u32 = u32::MAX;

/// Nodes smoothed one after another by one thread.
///
/// Within a block fresh values count at once, across blocks those of the round before; the size is fixed, so
/// the number of threads changes nothing.
const BLOCK: usize = 2048;

/// How a value looks from elsewhere: mirrored or not, then turned; the length is a weight.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View<const N: usize> {
    /// Whether the sense of counting is opposite.
    pub(crate) flips: bool,
    pub(crate) turns: [Complex; N],
}

impl<const N: usize> View<N> {
    const SAME: Self = Self {
        flips: false,
        turns: [Complex::ONE; N],
    };

    fn of(&self, value: &[Complex; N]) -> [Complex; N] {
        std::array::from_fn(|k| self.turns[k].times(value[k].conjugate_if(self.flips)))
    }

    /// This view of what `inner` shows.
    fn after(&self, inner: &Self) -> Self {
        Self {
            flips: self.flips != inner.flips,
            turns: self.of(&inner.turns),
        }
    }

    /// The view in the opposite direction; turns back where this one turns.
    fn back(&self) -> Self {
        Self {
            flips: self.flips,
            turns: self.turns.map(|turn| turn.conjugate_if(!self.flips)),
        }
    }

    /// The same view with weight 1.
    fn unit(&self) -> Self {
        Self {
            flips: self.flips,
            turns: self.turns.map(|turn| turn.unit().unwrap_or(Complex::ONE)),
        }
    }

    fn strength(&self) -> f32 {
        self.turns.iter().map(|turn| turn.length()).sum()
    }
}

/// A neighbour and how its value looks from here.
#[derive(Debug, Clone, Copy)]
struct Link<const N: usize> {
    to: u32,
    view: View<N>,
}

/// A graph with `N` angles per node.
#[derive(Debug)]
pub(crate) struct Level<const N: usize> {
    /// Where the links of each node start; one more than there are nodes.
    starts: Vec<u32>,
    /// Both directions of every link, by the node they are seen from.
    links: Vec<Link<N>>,
    /// What each node is drawn to by itself; the length is a weight against those of links.
    pulls: Vec<[Complex; N]>,
    /// How many of the finest nodes each stands for.
    sizes: Vec<u32>,
}

/// For every node, the coarse node that stands for it, and how its value looks from here.
struct Parents<const N: usize> {
    of_node: Vec<Link<N>>,
    count: usize,
}

impl<const N: usize> Level<N> {
    /// The finest level: `view` tells how the value of a node's neighbour looks from the node.
    pub(crate) fn new(
        nodes: &Nodes,
        pulls: Vec<[Complex; N]>,
        view: impl Fn(usize, usize) -> View<N> + Sync,
    ) -> Self {
        let runs = runs(nodes.count(), |node, links: &mut Vec<Link<N>>| {
            links.extend(nodes.neighbours_of(node).iter().map(|&to| Link {
                to,
                view: view(node, to as usize),
            }));
        });
        Self::joined(&runs, pulls, vec![1; nodes.count()])
    }

    /// A level from the links of consecutive nodes, and how many each of them has.
    fn joined(runs: &[Run<N>], pulls: Vec<[Complex; N]>, sizes: Vec<u32>) -> Self {
        let link_count = runs.iter().map(|run| run.links.len()).sum();
        let mut starts = Vec::with_capacity(pulls.len() + 1);
        let mut links = Vec::with_capacity(link_count);
        starts.push(0);
        for run in runs {
            let before = links.len() as u32;
            starts.extend(run.ends.iter().map(|end| before + end));
            links.extend_from_slice(&run.links);
        }
        Self {
            starts,
            links,
            pulls,
            sizes,
        }
    }

    fn count(&self) -> usize {
        self.pulls.len()
    }

    fn links_of(&self, node: usize) -> &[Link<N>] {
        &self.links[self.starts[node] as usize..self.starts[node + 1] as usize]
    }

    /// What a node would be without neighbours.
    fn start_of(&self, node: usize) -> [Complex; N] {
        self.pulls[node].map(|pull| pull.unit().unwrap_or(Complex::ONE))
    }

    /// Values of length 1 that agree with links and pulls, after `rounds` sweeps of every level.
    ///
    /// O(rounds * links). The result does not depend on the number of threads.
    pub(crate) fn solve(self, rounds: u32) -> Vec<[Complex; N]> {
        let mut levels = vec![self];
        let mut families: Vec<Parents<N>> = Vec::new();
        while let Some((parents, coarse)) = levels.last().and_then(Self::coarsen) {
            families.push(parents);
            levels.push(coarse);
        }
        let mut values: Vec<[Complex; N]> = Vec::new();
        while let Some(level) = levels.pop() {
            values = match families.get(levels.len()) {
                Some(parents) => level.inherit(parents, &values),
                None => (0..level.count())
                    .map(|node| level.start_of(node))
                    .collect(),
            };
            level.smooth(&mut values, rounds);
        }
        values
    }

    /// Every node's value from that of its parent.
    fn inherit(&self, parents: &Parents<N>, values: &[[Complex; N]]) -> Vec<[Complex; N]> {
        parents
            .of_node
            .par_iter()
            .with_min_len(BLOCK)
            .enumerate()
            .map(|(node, parent)| match values.get(parent.to as usize) {
                Some(value) => parent.view.of(value),
                None => self.start_of(node),
            })
            .collect()
    }

    /// Replaces values by the mean of what their neighbours and their pull say, node by node.
    fn smooth(&self, values: &mut [[Complex; N]], rounds: u32) {
        let mut old = values.to_vec();
        for _ in 0..rounds {
            old.copy_from_slice(values);
            values
                .par_chunks_mut(BLOCK)
                .enumerate()
                .for_each(|(block, own)| self.sweep(block * BLOCK, own, &old));
        }
    }

    /// One sweep over the nodes from `first` on, whose values are `own`; `old` holds those of all nodes.
    fn sweep(&self, first: usize, own: &mut [[Complex; N]], old: &[[Complex; N]]) {
        for k in 0..own.len() {
            let mut sums = self.pulls[first + k];
            for link in self.links_of(first + k) {
                let to = link.to as usize;
                let value = own.get(to.wrapping_sub(first)).unwrap_or(&old[to]);
                let said = link.view.of(value);
                sums = std::array::from_fn(|n| sums[n].plus(said[n]));
            }
            for (value, sum) in own[k].iter_mut().zip(sums) {
                *value = sum.unit().unwrap_or(*value);
            }
        }
    }

    /// Merges groups of linked nodes; none where nothing is linked.
    fn coarsen(&self) -> Option<(Parents<N>, Self)> {
        let parents = self.group();
        if parents.count == 0 {
            return None;
        }
        let (member_starts, members) = parents.members();
        let members_of = |group: usize| {
            let [from, to] = [0, 1].map(|i| member_starts[group + i] as usize);
            &members[from..to]
        };
        let runs = runs(parents.count, |group, links: &mut Vec<Link<N>>| {
            self.merge_links(group as u32, members_of(group), &parents, links);
        });
        let groups = || (0..parents.count).into_par_iter().with_min_len(BLOCK);
        let pulls = groups().map(|group| self.merged_pull(members_of(group), &parents));
        let size = |group| members_of(group).iter().map(|&m| self.sizes[m as usize]);
        let sizes = groups().map(|group| size(group).sum());
        let coarse = Self::joined(&runs, pulls.collect(), sizes.collect());
        Some((parents, coarse))
    }

    /// Pairs each node with its most strongly linked neighbour that is still alone; whoever finds none joins a
    /// pair. Nodes without links have no parent: there is nothing that a coarser level could tell them.
    fn group(&self) -> Parents<N> {
        let alone = Link {
            to: NONE,
            view: View::SAME,
        };

        // Pair nodes along their strongest links.
        let mut of_node = vec![alone; self.count()];
        let mut count = 0;
        for node in 0..self.count() {
            if of_node[node].to != NONE {
                continue;
            }
            let free = |link: &&Link<N>| of_node[link.to as usize].to == NONE;
            if let Some(mate) = self.best(self.links_of(node).iter().filter(free)) {
                of_node[node].to = count;
                of_node[mate.to as usize] = Link {
                    to: count,
                    view: mate.view.unit().back(),
                };
                count += 1;
            }
        }

        // Let those left alone join the pair of their most strongly linked neighbour.
        for node in 0..self.count() {
            if of_node[node].to == NONE
                && let Some(host) = self.best(self.links_of(node).iter())
            {
                let Link { to, view } = of_node[host.to as usize];
                of_node[node] = Link {
                    to,
                    view: host.view.unit().after(&view),
                };
            }
        }
        Parents {
            of_node,
            count: count as usize,
        }
    }

    /// The strongest link for the size of the node it leads to, the first of equals.
    fn best<'a>(&self, links: impl Iterator<Item = &'a Link<N>>) -> Option<&'a Link<N>> {
        let score = |link: &Link<N>| link.view.strength() / self.sizes[link.to as usize] as f32;
        links
            .map(|link| (score(link), link))
            .fold(None, |best: Option<(f32, &Link<N>)>, one| match best {
                Some(best) if best.0 >= one.0 => Some(best),
                _ => Some(one),
            })
            .map(|(_, link)| link)
    }

    /// Appends the links of a group to others, one to each, as its first member sees them.
    fn merge_links(
        &self,
        group: u32,
        members: &[u32],
        parents: &Parents<N>,
        links: &mut Vec<Link<N>>,
    ) {
        let first = links.len();
        for &member in members {
            let home = parents.of_node[member as usize].view.back();
            for link in self.links_of(member as usize) {
                let other = &parents.of_node[link.to as usize];
                if other.to != group && other.to != NONE {
                    links.push(Link {
                        to: other.to,
                        view: home.after(&link.view.after(&other.view)),
                    });
                }
            }
        }
        // A stable sort: sums keep the order of members.
        links[first..].sort_by_key(|link| link.to);
        let (mut kept, mut from) = (first, first);
        while from < links.len() {
            let same = |link: &&Link<N>| link.to == links[from].to;
            let to = from + links[from..].iter().take_while(same).count();
            if let Some(link) = merged(&links[from..to]) {
                links[kept] = link;
                kept += 1;
            }
            from = to;
        }
        links.truncate(kept);
    }

    fn merged_pull(&self, members: &[u32], parents: &Parents<N>) -> [Complex; N] {
        members
            .iter()
            .fold([Complex::default(); N], |sum, &member| {
                let home = parents.of_node[member as usize].view.back();
                let pull = home.of(&self.pulls[member as usize]);
                std::array::from_fn(|k| sum[k].plus(pull[k]))
            })
    }
}

/// The links of consecutive nodes.
struct Run<const N: usize> {
    links: Vec<Link<N>>,
    /// How many links there are up to and with each node.
    ends: Vec<u32>,
}

/// The links of nodes `0..count`, as `append` lists those of each, in runs of a fixed length.
fn runs<const N: usize>(
    count: usize,
    append: impl Fn(usize, &mut Vec<Link<N>>) + Sync,
) -> Vec<Run<N>> {
    (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(|run| {
            let nodes = run * BLOCK..((run + 1) * BLOCK).min(count);
            let mut run = Run {
                links: Vec::with_capacity(8 * BLOCK),
                ends: Vec::with_capacity(nodes.len()),
            };
            for node in nodes {
                append(node, &mut run.links);
                run.ends.push(run.links.len() as u32);
            }
            run
        })
        .collect()
}

/// The sum of links to one node; of mirrored and plain ones, the kind that says more.
fn merged<const N: usize>(links: &[Link<N>]) -> Option<Link<N>> {
    let sum = |flips: bool| {
        let same = links.iter().filter(|link| link.view.flips == flips);
        let turns = same.fold([Complex::default(); N], |sum, link| {
            std::array::from_fn(|k| sum[k].plus(link.view.turns[k]))
        });
        View { flips, turns }
    };
    let [plain, mirrored] = [sum(false), sum(true)];
    let view = if plain.strength() >= mirrored.strength() {
        plain
    } else {
        mirrored
    };
    (view.strength() > 1e-6).then(|| Link {
        to: links[0].to,
        view,
    })
}

impl<const N: usize> Parents<N> {
    /// The nodes of every group, ascending, and where each group starts among them.
    fn members(&self) -> (Vec<u32>, Vec<u32>) {
        let mut starts = vec![0u32; self.count + 1];
        for parent in &self.of_node {
            if let Some(count) = starts.get_mut(parent.to as usize) {
                *count += 1;
            }
        }
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // Fill every group from its end, last node first, which leaves its start behind.
        let mut members = vec![0; end as usize];
        for (node, parent) in self.of_node.iter().enumerate().rev() {
            if let Some(start) = starts.get_mut(parent.to as usize) {
                *start -= 1;
                members[*start as usize] = node as u32;
            }
        }
        (starts, members)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::Random;
    use proptest::prelude::*;

    /// A connected graph whose links say exactly what `truth` says, plus the links themselves.
    fn consistent(count: usize, seed: u64) -> (Level<2>, Vec<Vec<Link<2>>>) {
        let mut random = Random::new(seed);
        let truth: Vec<([f32; 2], bool)> = (0..count)
            .map(|_| ([random.unit(), random.unit()], random.below(2) == 0))
            .collect();
        let mut links: Vec<Vec<Link<2>>> = vec![Vec::new(); count];
        let mut join = |a: usize, b: usize| {
            for [from, to] in [[a, b], [b, a]] {
                let ([here, there], flips) =
                    ([truth[from].0, truth[to].0], truth[from].1 != truth[to].1);
                let sign = if flips { -1.0 } else { 1.0 };
                let turns = [0, 1].map(|k| Complex::of_turns(here[k] - sign * there[k]));
                links[from].push(Link {
                    to: to as u32,
                    view: View { flips, turns },
                });
            }
        };
        for node in 1..count {
            join(node, random.below(node));
            if node > 3 && random.below(2) == 0 {
                join(node, random.below(node));
            }
        }
        let pulls = vec![[Complex::default(); 2]; count];
        let runs = runs(count, |node, all| all.extend_from_slice(&links[node]));
        (Level::joined(&runs, pulls, vec![1; count]), links)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn links_that_can_all_hold_do(count in 1usize..300, seed: u64, rounds in 0u32..4) {
            let (level, links) = consistent(count, seed);
            let values = level.solve(rounds);
            for (node, links) in links.iter().enumerate() {
                for link in links {
                    let said = link.view.of(&values[link.to as usize]);
                    for k in 0..2 {
                        let [a, b] = [said[k], values[node][k]];
                        prop_assert!((a.re - b.re).abs() < 1e-4 && (a.im - b.im).abs() < 1e-4);
                    }
                }
            }
        }

        #[test]
        fn a_view_and_its_back_cancel(a in 0.0f32..1.0, b in 0.0f32..1.0, flips: bool, x in 0.0f32..1.0) {
            let view = View { flips, turns: [a, b].map(Complex::of_turns) };
            let value = [x, 1.0 - x].map(Complex::of_turns);
            let back = view.back().of(&view.of(&value));
            let same = view.back().after(&view);
            prop_assert!(!same.flips);
            for k in 0..2 {
                prop_assert!((back[k].re - value[k].re).abs() < 1e-5 && (back[k].im - value[k].im).abs() < 1e-5);
                prop_assert!((same.turns[k].re - 1.0).abs() < 1e-5);
            }
        }
    }
}
