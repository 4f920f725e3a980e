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
pub(crate) struct Link<const N: usize> {
    pub(crate) to: u32,
    pub(crate) view: View<N>,
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
    /// The finest level: `starts` tells where the links of each node start.
    pub(crate) fn new(starts: Vec<u32>, links: Vec<Link<N>>, pulls: Vec<[Complex; N]>) -> Self {
        let sizes = vec![1; pulls.len()];
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
        for r in 0..rounds {
            old.copy_from_slice(values);
            values
                .par_chunks_mut(BLOCK)
                .enumerate()
                .for_each(|(block, own)| self.sweep(block * BLOCK, own, &old, r + 1 == rounds));
        }
    }

    /// One sweep over the nodes from `first` on, whose values are `own`; `old` holds those of all nodes.
    fn sweep(&self, first: usize, own: &mut [[Complex; N]], old: &[[Complex; N]], last: bool) {
        for k in 0..own.len() {
            let mut sums = self.pulls[first + k];
            for link in self.links_of(first + k) {
                let to = link.to as usize;
                let value = own.get(to.wrapping_sub(first)).unwrap_or(&old[to]);
                let said = link.view.of(value);
                sums = std::array::from_fn(|n| sums[n].plus(said[n]));
            }
            let soft = std::env::var("SOFT").is_ok() && !last;
            for (n, (value, sum)) in own[k].iter_mut().zip(sums).enumerate() {
                if soft {
                    let w: f32 = self
                        .links_of(first + k)
                        .iter()
                        .map(|l| l.view.turns[n].length())
                        .sum::<f32>()
                        + self.pulls[first + k][n].length();
                    *value = if w > 0.0 { sum.scaled(1.0 / w) } else { *value };
                } else {
                    *value = sum.unit().unwrap_or(*value);
                }
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
        let groups = || (0..parents.count).into_par_iter();
        let runs: Vec<Vec<Vec<Link<N>>>> = (0..parents.count.div_ceil(BLOCK))
            .into_par_iter()
            .map(|run| {
                (run * BLOCK..((run + 1) * BLOCK).min(parents.count))
                    .map(|group| self.merged_links(group as u32, members_of(group), &parents))
                    .collect()
            })
            .collect();
        let mut starts = vec![0];
        let mut links = Vec::with_capacity(self.links.len() / 2);
        for group in runs.iter().flatten() {
            links.extend_from_slice(group);
            starts.push(links.len() as u32);
        }
        let pulls = groups()
            .map(|group| self.merged_pull(members_of(group), &parents))
            .collect();
        let size = |group| members_of(group).iter().map(|&m| self.sizes[m as usize]);
        let sizes = groups().map(|group| size(group).sum()).collect();
        let coarse = Self {
            starts,
            links,
            pulls,
            sizes,
        };
        Some((parents, coarse))
    }

    /// Pairs each node with its most strongly linked neighbour that is still alone; whoever finds none joins a
    /// pair. Nodes without links have no parent: there is nothing that a coarser level could tell them.
    fn group(&self) -> Parents<N> {
        let alone = Link {
            to: NONE,
            view: View::SAME,
        };
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

    /// The links of a group to others, one to each, as its first member sees them.
    fn merged_links(&self, group: u32, members: &[u32], parents: &Parents<N>) -> Vec<Link<N>> {
        let mut seen: Vec<Link<N>> = Vec::new();
        for &member in members {
            let home = parents.of_node[member as usize].view.back();
            for link in self.links_of(member as usize) {
                let other = &parents.of_node[link.to as usize];
                if other.to != group && other.to != NONE {
                    seen.push(Link {
                        to: other.to,
                        view: home.after(&link.view.after(&other.view)),
                    });
                }
            }
        }
        // A stable sort: sums keep the order of members.
        seen.sort_by_key(|link| link.to);
        seen.chunk_by(|a, b| a.to == b.to)
            .filter_map(merged)
            .collect()
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
