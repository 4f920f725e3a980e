//! Links borders to lines, which continue through the places where lines meet.

#[cfg(test)]
mod tests;

use super::border::{Border, Borders};
use glam::DVec2;
use npr_core::geometry::NONE;
use npr_trace::centreline::line_of;

/// Number of borders under which a part of a line takes the label of its neighbours: pixels at corners show either
/// side.
pub(super) const LEAST_PART: usize = 6;

/// Number of borders that tell where a line leads from a junction.
const ARM_BORDERS: usize = 10;

/// Cosine of the largest turn of a line where three or more of its kind meet, or where it is too short to tell its
/// kind: 46 degrees.
const STRAIGHT: f64 = 0.697;

/// The label of a line: the bit of its kind, and the surface that it lies on.
pub(super) type Label = [u32; 2];

/// A sequence of borders that are one line.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Chain {
    /// Indices of borders.
    pub borders: Vec<u32>,
    pub label: Label,
    /// Corners of pixels at which it starts and ends; of a closed one the same.
    pub ends: [u32; 2],
    /// Whether the last border runs on to the first.
    pub closed: bool,
    /// Whether nothing else meets its start and its end.
    pub free: [bool; 2],
}

/// The part of a line between two junctions, ends, or changes of label.
struct Part {
    chain: Chain,
    /// Whether it is too short between junctions to tell its label.
    is_vague: bool,
    /// The arms that continue its start and its end.
    partners: [u32; 2],
}

/// Links all borders; each is part of one chain. `surface_of` gives the surface of a pixel.
///
/// Where lines meet, an outline continues around the same pixels: of a surface that covers others, both arms belong to
/// the outline in front. Other arms of one label continue each other where they turn little. O(borders log borders).
pub(super) fn chains(borders: &Borders, surface_of: impl Fn(u32) -> u32) -> Vec<Chain> {
    let grid = Grid { borders };
    let labels: Vec<Label> = borders
        .all
        .iter()
        .map(|border| [border.kind, surface_of(border.owner)])
        .collect();
    let stretches = grid.stretches();
    let mut parts: Vec<Part> = stretches
        .into_iter()
        .flat_map(|stretch| grid.parts(stretch, &labels))
        .collect();
    grid.pair(&mut parts);
    joined(parts)
}

/// The corners of pixels, with borders between them.
struct Grid<'a> {
    borders: &'a Borders,
}

impl Grid<'_> {
    /// The corners at both ends of a border.
    fn ends(&self, border: u32) -> [u32; 2] {
        let width = self.borders.size[0];
        let side = self.borders.all[border as usize].side;
        let pixel = side / 2;
        let first = pixel / width * (width + 1) + pixel % width;
        [first, first + if side & 1 == 0 { width + 1 } else { 1 }]
    }

    /// The borders at a corner: above, below, left, right.
    fn around(&self, corner: u32) -> impl Iterator<Item = u32> {
        let [width, height] = self.borders.size;
        let [x, y] = [corner % (width + 1), corner / (width + 1)];
        let side = |x: Option<u32>, y: Option<u32>, of: u32| {
            let [x, y] = [x.filter(|x| *x < width)?, y.filter(|y| *y < height)?];
            Some(2 * (y * width + x) + of)
        };
        let sides = [
            side(Some(x), y.checked_sub(1), 0),
            side(Some(x), Some(y), 0),
            side(x.checked_sub(1), Some(y), 1),
            side(Some(x), Some(y), 1),
        ];
        let there = sides.into_iter().flatten();
        there.filter_map(|side| self.borders.at(side).map(|index| index as u32))
    }

    /// All borders in stretches between junctions and ends, which are corners where other than two borders meet;
    /// stretches without such corners are closed.
    fn stretches(&self) -> Vec<Chain> {
        let count = self.borders.all.len() as u32;
        let mut taken = vec![false; count as usize];
        let mut stretches = Vec::new();
        for border in 0..count {
            for corner in self.ends(border) {
                if !taken[border as usize] && self.around(corner).count() != 2 {
                    stretches.push(self.walk(corner, border, &mut taken));
                }
            }
        }
        for border in 0..count {
            if !taken[border as usize] {
                stretches.push(self.walk(self.ends(border)[0], border, &mut taken));
            }
        }
        stretches
    }

    /// Follows borders from a corner up to a junction or end, or back to the start.
    fn walk(&self, start: u32, first: u32, taken: &mut [bool]) -> Chain {
        let mut stretch = Chain::default();
        let (mut corner, mut border) = (start, first);

        // Go from border to border until corners where not exactly two meet.
        let closed = loop {
            taken[border as usize] = true;
            stretch.borders.push(border);
            let [a, b] = self.ends(border);
            corner = if a == corner { b } else { a };
            let around: Vec<u32> = self.around(corner).collect();
            let next = around.iter().find(|next| !taken[**next as usize]);
            match next {
                Some(next) if around.len() == 2 => border = *next,
                _ => break around.len() == 2 && corner == start,
            }
        };

        // Note which ends end in nothing.
        stretch.ends = [start, corner];
        stretch.closed = closed;
        stretch.free = stretch
            .ends
            .map(|end| !closed && self.around(end).count() == 1);
        stretch
    }

    /// Cuts a stretch where its label changes.
    fn parts(&self, mut stretch: Chain, labels: &[Label]) -> Vec<Part> {
        let label = |border: &u32| labels[*border as usize];
        let mut cuts = cuts(&stretch.borders.iter().map(label).collect::<Vec<_>>());
        if stretch.closed && cuts.len() > 1 {
            // Around the seam a part goes on.
            let seam = cuts[0].1;
            stretch.borders.rotate_left(seam);
            cuts = self::cuts(&stretch.borders.iter().map(label).collect::<Vec<_>>());
            stretch.closed = false;
            let corner = self.shared(
                stretch.borders[0],
                stretch.borders[stretch.borders.len() - 1],
            );
            stretch.ends = [corner; 2];
        }
        let is_junction = |corner: u32| self.around(corner).count() > 2;
        let is_vague =
            stretch.borders.len() < LEAST_PART && stretch.ends.iter().all(|end| is_junction(*end));
        let last = cuts.len() - 1;
        let parts = cuts.iter().enumerate().map(|(number, (from, to, label))| {
            let borders = stretch.borders[*from..*to].to_vec();
            let cut = |at: usize| self.shared(stretch.borders[at - 1], stretch.borders[at]);
            let chain = Chain {
                label: *label,
                ends: [
                    if number == 0 {
                        stretch.ends[0]
                    } else {
                        cut(*from)
                    },
                    if number == last {
                        stretch.ends[1]
                    } else {
                        cut(*to)
                    },
                ],
                closed: stretch.closed,
                free: [
                    number == 0 && stretch.free[0],
                    number == last && stretch.free[1],
                ],
                borders,
            };
            Part {
                chain,
                is_vague,
                partners: [NONE; 2],
            }
        });
        parts.collect()
    }

    /// The corner that two borders share.
    fn shared(&self, a: u32, b: u32) -> u32 {
        let there = self.ends(b);
        let ends = self.ends(a);
        if there.contains(&ends[0]) {
            ends[0]
        } else {
            ends[1]
        }
    }

    /// Finds the parts that continue each other where they meet.
    fn pair(&self, parts: &mut [Part]) {
        let mut arms: Vec<(u32, u32)> = Vec::new();
        for (number, part) in (0..).zip(&*parts) {
            for end in 0..2 {
                let corner = part.chain.ends[end as usize];
                if !part.chain.closed && self.around(corner).count() > 2 {
                    arms.push((corner, 2 * number + end));
                }
            }
        }
        arms.sort_unstable();
        let mut pairs: Vec<Pair> = arms
            .chunk_by(|a, b| a.0 == b.0)
            .flat_map(|group| self.pairs_at(parts, group))
            .collect();
        let key = |pair: &Pair| (pair.rank, pair.arms);
        pairs.sort_by(|a, b| {
            let by_turn = a.cosine.total_cmp(&b.cosine);
            a.rank.cmp(&b.rank).then(by_turn).then(key(a).cmp(&key(b)))
        });
        for pair in pairs {
            let [a, b] = pair.arms.map(|arm| [arm as usize / 2, arm as usize % 2]);
            let [one, other] = [&parts[a[0]], &parts[b[0]]];
            let are_free = one.partners[a[1]] == NONE && other.partners[b[1]] == NONE;
            let are_one = one.chain.label == other.chain.label || one.is_vague || other.is_vague;
            if !are_free || !are_one {
                continue;
            }
            // What may be anything is now what it runs on to.
            let surer = if one.is_vague { other } else { one };
            let (label, is_vague) = (surer.chain.label, surer.is_vague);
            for ([part, end], partner) in [(a, pair.arms[1]), (b, pair.arms[0])] {
                parts[part].partners[end] = partner;
                parts[part].chain.label = label;
                parts[part].is_vague = is_vague;
            }
        }
    }

    /// The arms of a junction, by corner and number, that may be one line.
    fn pairs_at(&self, parts: &[Part], group: &[(u32, u32)]) -> Vec<Pair> {
        let arms: Vec<Arm> = group
            .iter()
            .map(|(corner, arm)| self.arm(parts, *corner, *arm))
            .collect();
        let mut pairs = Vec::new();
        for (i, a) in arms.iter().enumerate() {
            for b in &arms[i + 1..] {
                pairs.extend(rank([a, b], &arms).map(|rank| Pair {
                    rank,
                    cosine: a.direction.dot(b.direction),
                    arms: [a.number, b.number],
                }));
            }
        }
        pairs
    }

    /// The arm of a part at a junction.
    fn arm(&self, parts: &[Part], corner: u32, number: u32) -> Arm {
        let part = &parts[number as usize / 2];
        let borders = &part.chain.borders;
        let count = borders.len();

        // Take the borders next to the corner.
        let first: Vec<&Border> = (0..count.min(ARM_BORDERS))
            .map(|k| if number & 1 == 0 { k } else { count - 1 - k })
            .map(|k| &self.borders.all[borders[k] as usize])
            .collect();
        let size = self.borders.size;

        // Tell the direction in which they leave it.
        let places: Vec<DVec2> = first
            .iter()
            .map(|border| middle_of(size, border.side))
            .collect();
        Arm {
            number,
            label: part.chain.label,
            is_vague: part.is_vague,
            region: self.region(corner, first[0].owner),
            direction: line_of(&places, place_of(size, corner))[1],
        }
    }

    /// The first pixel around a corner that no border separates from `pixel`, or `pixel` itself.
    fn region(&self, corner: u32, pixel: u32) -> u32 {
        let [width, _] = self.borders.size;
        let below_right = corner / (width + 1) * width + corner % (width + 1);
        // Each side as its own pixel, and the one before it.
        let sides = [
            (below_right.wrapping_sub(width), 0, 1),
            (below_right, 0, 1),
            (below_right.wrapping_sub(1), 1, width),
            (below_right, 1, width),
        ];
        let open = sides.into_iter().find(|(own, of, step)| {
            let is_beside = pixel == *own || pixel == own.wrapping_sub(*step);
            is_beside && self.borders.at(own.wrapping_mul(2) + of).is_none()
        });
        open.map_or(pixel, |(own, _, step)| own.wrapping_sub(step))
    }
}

/// The end of a part at a junction.
struct Arm {
    number: u32,
    label: Label,
    is_vague: bool,
    /// The region whose outline it is: the first pixel at the junction that belongs together with the owner.
    region: u32,
    /// Unit direction away from the junction.
    direction: DVec2,
}

/// Two arms that may be one line.
struct Pair {
    /// How sure it is; the least comes first.
    rank: u32,
    /// Cosine of the angle between them: -1 where one continues the other straight.
    cosine: f64,
    arms: [u32; 2],
}

/// How surely two arms of a junction are one line, the least first: the only two around one region, then two that go
/// straight on, and then vague ones, since what is sure helps to decide those. `None` if they are not one line.
fn rank([a, b]: [&Arm; 2], all: &[Arm]) -> Option<u32> {
    let may_be_one = |a: &Arm, b: &Arm| a.label == b.label || a.is_vague || b.is_vague;
    let may_go_around = |other: &Arm| other.region == a.region && may_be_one(a, other);
    let is_outline = may_go_around(b) && all.iter().filter(|arm| may_go_around(arm)).count() == 2;
    let is_straight = a.direction.dot(b.direction) < -STRAIGHT;
    let is_one = may_be_one(a, b) && (is_outline || is_straight);
    is_one.then(|| match u32::from(a.is_vague) + u32::from(b.is_vague) {
        0 => u32::from(!is_outline),
        vague => 1 + vague,
    })
}

/// Stretches of equal labels, as first, end and label; short ones join the stretch before them, or else the one after.
pub(super) fn cuts(labels: &[Label]) -> Vec<(usize, usize, Label)> {
    let mut parts: Vec<(usize, usize, Label)> = Vec::new();
    for stretch in labels.chunk_by(|a, b| a == b) {
        let own = stretch[0];
        let from = parts.last().map_or(0, |part| part.1);
        let to = from + stretch.len();
        match parts.last_mut() {
            Some((first, last, label)) if *last - *first < LEAST_PART => {
                (*last, *label) = (to, own);
            }
            Some((_, last, label)) if stretch.len() < LEAST_PART || *label == own => {
                *last = to;
            }
            _ => parts.push((from, to, own)),
        }
    }
    parts
}

/// Joins all parts with those that continue them.
fn joined(parts: Vec<Part>) -> Vec<Chain> {
    let mut taken = vec![false; parts.len()];
    let mut chains = Vec::new();
    // Open chains begin at an arm without a partner; what is left then goes around.
    for is_open in [true, false] {
        for arm in 0..2 * parts.len() as u32 {
            let part = &parts[arm as usize / 2];
            let is_start = !is_open || part.partners[arm as usize % 2] == NONE;
            if is_start && !taken[arm as usize / 2] {
                chains.push(follow(&parts, arm, &mut taken));
            }
        }
    }
    chains
}

/// The chain from an arm on.
fn follow(parts: &[Part], start: u32, taken: &mut [bool]) -> Chain {
    // Begin at the end of a part that has no partner, or anywhere on a ring.
    let first = &parts[start as usize / 2].chain;
    let end = start as usize % 2;
    let mut chain = Chain {
        ends: [first.ends[end]; 2],
        free: [first.free[end], false],
        closed: first.closed,
        ..Chain::default()
    };
    let mut lengths: Vec<(Label, usize)> = Vec::new();
    let mut arm = start;
    loop {
        // Append the borders of this part, in the direction of travel.
        let part = &parts[arm as usize / 2];
        let [here, there] = [arm as usize % 2, 1 - arm as usize % 2];
        taken[arm as usize / 2] = true;
        let borders = part.chain.borders.iter().copied();
        if here == 0 {
            chain.borders.extend(borders);
        } else {
            chain.borders.extend(borders.rev());
        }

        // Count borders by label; those of vague parts have no say.
        let weight = if part.is_vague {
            0
        } else {
            part.chain.borders.len()
        };
        match lengths
            .iter_mut()
            .find(|(label, _)| *label == part.chain.label)
        {
            Some((_, length)) => *length += weight,
            None => lengths.push((part.chain.label, weight)),
        }

        // Go on with the partner at the far end.
        chain.ends[1] = part.chain.ends[there];
        chain.free[1] = part.chain.free[there];
        arm = part.partners[there];
        if arm == start {
            chain.closed = true;
        }
        if arm == NONE || arm == start {
            break;
        }
    }

    // Name the whole after the label of most of its length.
    let longest = lengths.iter().rev().max_by_key(|(_, length)| *length);
    chain.label = longest.map_or(first.label, |(label, _)| *label);
    chain
}

/// Where a corner of pixels lies.
pub(super) fn place_of(size: [u32; 2], corner: u32) -> DVec2 {
    DVec2::new(
        f64::from(corner % (size[0] + 1)),
        f64::from(corner / (size[0] + 1)),
    )
}

/// The middle of a side.
pub(super) fn middle_of(size: [u32; 2], side: u32) -> DVec2 {
    let pixel = side / 2;
    let [x, y] = [pixel % size[0], pixel / size[0]].map(f64::from);
    if side & 1 == 0 {
        DVec2::new(x, y + 0.5)
    } else {
        DVec2::new(x + 0.5, y)
    }
}
