//! Why ends are lost and textures pop.
//!
//! A stroke comes of a raw line: a run of one kind on one surface, cut where something hides it. Raw lines are joined,
//! smoothed and left out where they double others or are shreds; what ends in the open and is short is a stub and left
//! out last. A frame is drawn with and without each ([`Stages`]), and what differs from a frame to the next is looked
//! up there.

use std::collections::BTreeMap;

use npr_vector::mesh_lines::{DEPTH_SHARE, FACING_PX, STRAIGHT_COS, TOUCHING_PX};

pub use super::cause::{Absence, Joint, Loss, Pop, Rule};
use super::count::add;
pub use super::count::{Count, Counts};
use super::near::distance;
use super::tally::{JUMP_PX, MATCH_PX, Match, Pair, dot, voted_slides};
use super::traced::{Line, Sample, Traced};

/// Distance from a place up to which a raw end belongs to it, in pixels: raw lines are not smoothed yet.
const AT_END_PX: f64 = 4.5;

/// Frames within which a joint that changes back flickers.
pub const BACK_FRAMES: usize = 10;

/// How far off a joint may be after those frames, in pixels: strokes overlap and wander there.
const BACK_PX: f64 = 12.0;

/// A frame as it is drawn, and on the way there.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    /// Lines before anything is joined, smoothed or left out.
    pub raw: Traced,
    /// What is drawn, and stubs.
    pub with_stubs: Traced,
    /// What is drawn.
    pub drawn: Traced,
}

/// The causes of a sequence.
#[derive(Debug, Clone, Default)]
pub struct Causes {
    /// Pairs of frames looked at.
    pub pairs: usize,
    /// Matches whose texture pops.
    pub pops: Counts<Pop>,
    /// Matches whose texture would pop although strokes took over their textures as a whole.
    pub voted_pops: Counts<Pop>,
    /// Ends that are lost.
    pub losses: Counts<Loss>,
    /// Carried samples that are gone.
    pub gone: Counts<Absence>,
    /// Matches that pop where ends that meet in both frames are joined in one, and those of them at joints that changed
    /// the other way within [`BACK_FRAMES`] before.
    pub flips: [usize; 2],
    /// Such joints of the last frames, where they are now.
    recent: Vec<Flip>,
}

/// A joint that changed.
#[derive(Debug, Clone, Copy)]
struct Flip {
    /// Number of the pair of frames.
    pair: usize,
    /// Where it is in the later frame of the last pair.
    place: [f64; 2],
    /// Whether its ends were joined then.
    joins: bool,
}

/// Two frames, and whether a sample's point is seen in each.
pub struct Frames<'a> {
    /// The frame before and the one after.
    pub stages: [&'a Stages; 2],
    /// Whether the point of a sample that was carried to the later frame is seen there.
    pub is_seen: &'a dyn Fn(&Sample) -> bool,
    /// Whether the point of a sample of the later frame was seen in the one before.
    pub was_seen: &'a dyn Fn(&Sample) -> bool,
    /// The frame before, carried.
    pub pair: &'a Pair,
}

impl Causes {
    /// Looks for the causes of what changes between two frames.
    pub fn add(&mut self, frames: &Frames<'_>) {
        let number = self.pairs;
        self.pairs += 1;
        self.follow(frames, number);
        self.add_pops(frames, number);
        frames.voted_pops(number, &mut self.voted_pops);
        frames.losses(number, &mut self.losses);
        for sample in &frames.pair.gone {
            let sample = &frames.pair.carried[*sample].sample;
            let cause = frames.absence(sample);
            add(&mut self.gone, cause, 1, (number, sample.place));
        }
    }

    /// Carries the joints of the last frames to the later one of this pair, and forgets old ones.
    fn follow(&mut self, frames: &Frames<'_>, number: usize) {
        self.recent.retain(|flip| flip.pair + BACK_FRAMES >= number);
        for flip in &mut self.recent {
            let moved = frames.moved_from(flip.place);
            flip.place = [0, 1].map(|i| flip.place[i] + moved[i]);
        }
    }

    /// Counts the pops of every pair of strokes that are one.
    fn add_pops(&mut self, frames: &Frames<'_>, number: usize) {
        let mut found = Vec::new();
        for (strokes, group) in frames.popping() {
            let Popped { pop, place, joins } = frames.pop(strokes, &group);
            add(&mut self.pops, pop, group.len(), (number, place));
            if matches!(pop, Pop::Rule(_)) {
                let is_back =
                    |flip: &Flip| flip.joins != joins && distance(flip.place, place) <= BACK_PX;
                self.flips[0] += group.len();
                if self.recent.iter().any(is_back) {
                    self.flips[1] += group.len();
                }
                found.push(Flip {
                    pair: number,
                    place,
                    joins,
                });
            }
        }
        self.recent.extend(found);
    }
}

/// Why the samples of two strokes pop.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Popped {
    pop: Pop,
    /// Where, in the later frame.
    place: [f64; 2],
    /// Whether the later stroke has more before the start of the earlier one.
    joins: bool,
}

impl Frames<'_> {
    /// The matches whose textures pop, by the strokes that they lie on.
    fn popping(&self) -> BTreeMap<[usize; 2], Vec<&Match>> {
        let [before, after] = self.stages;
        let mut groups: BTreeMap<[usize; 2], Vec<&Match>> = BTreeMap::new();
        let popping = self
            .pair
            .matches
            .iter()
            .filter(|found| found.slide > JUMP_PX);
        for found in popping {
            let strokes = [
                before.drawn.samples[found.before].stroke,
                after.drawn.samples[found.after].stroke,
            ];
            groups.entry(strokes).or_default().push(found);
        }
        groups
    }

    /// Counts what would pop although strokes took over their textures as a whole: the lesser parts of strokes that
    /// were several.
    fn voted_pops(&self, number: usize, counts: &mut Counts<Pop>) {
        // Gather the strokes of the frame before that went into each stroke, and how much of each pops.
        let [before, after] = self.stages.map(|stages| &stages.drawn);
        let slides = voted_slides(before, after, &self.pair.matches);
        let mut sources: BTreeMap<usize, BTreeMap<usize, [usize; 2]>> = BTreeMap::new();
        for (found, slide) in self.pair.matches.iter().zip(slides) {
            let stroke = after.samples[found.after].stroke;
            let source = before.samples[found.before].stroke;
            let parts = sources.entry(stroke).or_default();
            parts.entry(source).or_default()[usize::from(slide > JUMP_PX)] += 1;
        }

        // Compare each part with the one whose texture goes on.
        for (stroke, parts) in sources {
            let Some((main, _)) = parts.iter().max_by_key(|(_, [held, _])| *held) else {
                continue;
            };
            for (source, [_, popped]) in parts.iter().filter(|(_, [_, popped])| *popped > 0) {
                let line = &after.strokes[stroke];
                let was = &before.strokes[*source];
                let (start, end) = nearest_tips(before, *source, *main);
                let place = self.carried_place(&start);
                let pop = match () {
                    () if (was.kind, was.surface) != (line.kind, line.surface) => Pop::OtherLine,
                    () if source == main => Pop::Stretched,
                    () => self.joined(self.joint(place), &start, &end),
                };
                add(counts, pop, *popped, (number, place));
            }
        }
    }

    /// Where a sample of the frame before is carried to, by the nearest carried one.
    fn carried_place(&self, sample: &Sample) -> [f64; 2] {
        let [from, to] = self.stages[0].drawn.strokes[sample.stroke].samples;
        let number = (from + sample.station as usize).min(to - 1);
        self.pair.carried[number].sample.place
    }

    /// Why the samples of two strokes that are one pop.
    fn pop(&self, [a, b]: [usize; 2], group: &[&Match]) -> Popped {
        let plain = |pop, place| Popped {
            pop,
            place,
            joins: false,
        };

        // Compare what the strokes are.
        let [before, after] = self.stages.map(|stages| &stages.drawn);
        let [was, is] = [&before.strokes[a], &after.strokes[b]];
        let [from, to] = [was, is].map(|line| line.samples[0]);
        let start = after.samples[to].place;
        if (was.kind, was.surface) != (is.kind, is.surface) {
            let middle = after.samples[group[group.len() / 2].after].place;
            return plain(Pop::OtherLine, middle);
        }
        let is_turned = group.iter().map(|found| self.turn(found)).sum::<f64>() < 0.0;
        if is_turned && was.closed == is.closed {
            return plain(Pop::Reversed, start);
        }
        if was.closed && is.closed {
            return plain(Pop::Head, start);
        }
        let first = self.pair.carried[from].sample.place;
        if was.closed != is.closed {
            // The place of the open one's ends is where the ring is parted.
            let place = if is.closed { first } else { start };
            return plain(Pop::Ring(self.joint(place)), place);
        }

        // Find each start on the other stroke.
        let on_later = nearest_of(after.samples[to..is.samples[1]].iter(), first);
        let earlier = &self.pair.carried[from..was.samples[1]];
        let earlier = earlier.iter().map(|carried| &carried.sample);
        let on_earlier = nearest_of(earlier, start);
        match (on_later, on_earlier) {
            (Some(station), _) if station > JUMP_PX => Popped {
                joins: true,
                ..plain(self.grown(a, is, station, first), first)
            },
            (_, Some(station)) if station > JUMP_PX => plain(self.shrunk(b, was, station), start),
            (Some(_), _) | (_, Some(_)) => plain(Pop::Stretched, start),
            (None, None) => plain(Pop::Elsewhere, start),
        }
    }

    /// Cosine between the directions of a match.
    fn turn(&self, found: &Match) -> f64 {
        let [before, after] = self.stages.map(|stages| &stages.drawn);
        let (was, is) = (&before.samples[found.before], &after.samples[found.after]);
        dot(was.along, is.along)
    }

    /// Why the later stroke `is` begins before the start of stroke `a`, which lies at `station` on it.
    fn grown(&self, a: usize, is: &Line, station: f64, start: [f64; 2]) -> Pop {
        let [before, after] = self.stages;
        let front = &after.drawn.samples[is.samples[0]..][..station as usize];
        let stroke_at = |sample: &Sample| {
            let fits = |number: usize| self.pair.carried[number].sample.stroke != a;
            let found = self.pair.near.nearest(sample.place, MATCH_PX, fits)?;
            Some(self.pair.carried[found.0].sample.stroke)
        };
        if let Some(other) = most_of(front.iter().map(stroke_at)) {
            let own = tip(&before.drawn, a, true);
            let end = nearest_tip(&before.drawn, other, own.place);
            return self.joined(self.joint(start), &own, &end);
        }

        // What was not there before is looked up where it would have been: as far off as the frame moved here.
        let moved = self.moved_near(start);
        let back = |sample: &Sample| [0, 1].map(|i| sample.place[i] - moved[i]);
        let is_in = |traced: &Traced| {
            is_most(front.iter(), |sample| {
                traced.near.is_near(back(sample), MATCH_PX)
            })
        };
        Pop::Start(match () {
            () if is_in(&before.with_stubs) => Absence::Stub,
            () if is_in(&before.raw) => Absence::Suppressed,
            () if is_most(front.iter(), self.was_seen) => Absence::NoLine,
            () => Absence::Hidden,
        })
    }

    /// Why stroke `was` begins before the start of the later stroke `b`, which lies at `station` on it.
    fn shrunk(&self, b: usize, was: &Line, station: f64) -> Pop {
        let after = self.stages[1];
        let front = &self.pair.carried[was.samples[0]..][..station as usize];
        let front = || front.iter().map(|carried| &carried.sample);
        let stroke_at = |sample: &Sample| {
            let fits = |number: usize| after.drawn.samples[number].stroke != b;
            let found = after.drawn.near.nearest(sample.place, MATCH_PX, fits)?;
            Some(after.drawn.samples[found.0].stroke)
        };
        if let Some(other) = most_of(front().map(stroke_at)) {
            let own = tip(&after.drawn, b, true);
            let end = nearest_tip(&after.drawn, other, own.place);
            return self.joined(self.joint(own.place), &own, &end);
        }
        Pop::Start(self.most_absent(front()))
    }

    /// A pop where two strokes are one in one of both frames, by their ends in the frame that parts them.
    fn joined(&self, joint: Joint, own: &Sample, other: &Sample) -> Pop {
        match joint {
            Joint::Rule => Pop::Rule(rule(own, other)),
            _ => Pop::Joint(joint),
        }
    }

    /// Counts the lost ends.
    fn losses(&self, number: usize, counts: &mut Counts<Loss>) {
        let [before, after] = self.stages;
        for (end, place) in &self.pair.ends {
            let is_near = |other: &super::traced::End| distance(other.place, *place) <= JUMP_PX;
            if after.drawn.ends.iter().any(is_near) {
                continue;
            }
            let cause = match after.drawn.near.is_near(*place, MATCH_PX) {
                true => Loss::Joint(self.joint(*place)),
                false => {
                    // Look at the last pixels of the stroke.
                    let end = before.drawn.ends[*end];
                    let [from, to] = before.drawn.strokes[end.stroke].samples;
                    let (from, to) = match end.is_start {
                        true => (from, to.min(from + JUMP_PX as usize)),
                        false => (from.max(to.saturating_sub(JUMP_PX as usize)), to),
                    };
                    let samples = self.pair.carried[from..to].iter();
                    Loss::Absence(self.most_absent(samples.map(|carried| &carried.sample)))
                }
            };
            add(counts, cause, 1, (number, *place));
        }
    }

    /// Why most of some carried samples are not drawn.
    fn most_absent<'b>(&self, samples: impl Iterator<Item = &'b Sample>) -> Absence {
        let mut counts: BTreeMap<Absence, usize> = BTreeMap::new();
        for sample in samples {
            if !self.stages[1].drawn.near.is_near(sample.place, MATCH_PX) {
                *counts.entry(self.absence(sample)).or_default() += 1;
            }
        }
        let most = counts.into_iter().max_by_key(|(_, count)| *count);
        most.map_or(Absence::Suppressed, |(cause, _)| cause)
    }

    /// Why a carried sample is not drawn.
    fn absence(&self, sample: &Sample) -> Absence {
        let after = self.stages[1];
        if after.with_stubs.near.is_near(sample.place, MATCH_PX) {
            return Absence::Stub;
        }
        if after.raw.near.is_near(sample.place, MATCH_PX) {
            return Absence::Suppressed;
        }
        match (self.is_seen)(sample) {
            true => Absence::NoLine,
            false => Absence::Hidden,
        }
    }

    /// What parts strokes at a place of the later frame, in one of both frames.
    fn joint(&self, place: [f64; 2]) -> Joint {
        let moved = self.moved_near(place);
        let [before, after] = self.stages;
        let was = [0, 1].map(|i| place[i] - moved[i]);
        let [ends_before, ends_after] =
            [(before, was), (after, place)].map(|(stages, place)| raw_ends(&stages.raw, place));
        match [ends_before.is_empty(), ends_after.is_empty()] {
            [false, false] => Joint::Rule,
            [true, true] => Joint::Cut,
            [true, false] => parted_by(&ends_after),
            [false, true] => parted_by(&ends_before),
        }
    }

    /// How far the picture moves from a place of the frame before.
    fn moved_from(&self, place: [f64; 2]) -> [f64; 2] {
        self.moved_by(|here, _| distance(here, place))
    }

    /// How far the picture moved to a place of the later frame.
    fn moved_near(&self, place: [f64; 2]) -> [f64; 2] {
        self.moved_by(|_, there| distance(there, place))
    }

    /// How far the sample moves that is nearest by `away` of its places before and after.
    fn moved_by(&self, away: impl Fn([f64; 2], [f64; 2]) -> f64) -> [f64; 2] {
        let before = self.stages[0].drawn.samples.iter();
        let carried = self.pair.carried.iter();
        let places = before
            .zip(carried)
            .map(|(here, there)| (here.place, there.sample.place));
        let nearest = places.min_by(|a, b| away(a.0, a.1).total_cmp(&away(b.0, b.1)));
        nearest.map_or([0.0; 2], |(here, there)| [0, 1].map(|i| there[i] - here[i]))
    }
}

/// Why two ends are not joined; both look out of their strokes.
fn rule(own: &Sample, other: &Sample) -> Rule {
    let depth = own.depth.min(other.depth);
    let gap = distance(own.place, other.place);
    let across = [0, 1].map(|i| other.place[i] - own.place[i]);
    let ahead = [dot(across, own.along), -dot(across, other.along)];
    let aims = ahead.iter().all(|ahead| *ahead >= STRAIGHT_COS * gap);
    match () {
        () if gap > 2.0 * FACING_PX => Rule::Partner,
        () if (own.depth - other.depth).abs() > DEPTH_SHARE * depth => Rule::Depth,
        () if gap > FACING_PX => Rule::Apart,
        () if -dot(own.along, other.along) < STRAIGHT_COS => Rule::Turn,
        () if gap > TOUCHING_PX && !aims => Rule::Turn,
        () => Rule::Other,
    }
}

/// The end of a stroke that is nearer to a place.
fn nearest_tip(traced: &Traced, stroke: usize, place: [f64; 2]) -> Sample {
    let [start, end] = [true, false].map(|is_start| tip(traced, stroke, is_start));
    match distance(start.place, place) <= distance(end.place, place) {
        true => start,
        false => end,
    }
}

/// The ends of two strokes that are nearest to each other.
fn nearest_tips(traced: &Traced, a: usize, b: usize) -> (Sample, Sample) {
    let pairs = [true, false].map(|is_start| {
        let end = tip(traced, a, is_start);
        (end, nearest_tip(traced, b, end.place))
    });
    let away = |(a, b): &(Sample, Sample)| distance(a.place, b.place);
    match away(&pairs[0]) <= away(&pairs[1]) {
        true => pairs[0],
        false => pairs[1],
    }
}

/// An end of a stroke, with the direction out of it, taken over the last pixels.
fn tip(traced: &Traced, stroke: usize, is_start: bool) -> Sample {
    let [from, to] = traced.strokes[stroke].samples;
    let inward = (to - from - 1).min(JUMP_PX as usize);
    let (end, inner) = match is_start {
        true => (from, from + inward),
        false => (to - 1, to - 1 - inward),
    };
    let [end, inner] = [end, inner].map(|number| traced.samples[number]);
    let length = distance(end.place, inner.place);
    let along = match length > 0.0 {
        true => [0, 1].map(|i| (end.place[i] - inner.place[i]) / length),
        false => end.along,
    };
    Sample { along, ..end }
}

/// What more than half of some choices are, where they are one at all.
fn most_of(choices: impl Iterator<Item = Option<usize>>) -> Option<usize> {
    let (mut all, mut counts) = (0, BTreeMap::<usize, usize>::new());
    for choice in choices {
        all += 1;
        if let Some(choice) = choice {
            *counts.entry(choice).or_default() += 1;
        }
    }
    let chosen: usize = counts.values().sum();
    let (most, _) = counts.into_iter().max_by_key(|(_, count)| *count)?;
    (2 * chosen > all).then_some(most)
}

/// The raw lines that end at a place.
fn raw_ends(raw: &Traced, place: [f64; 2]) -> Vec<Line> {
    let near = raw
        .ends
        .iter()
        .filter(|end| distance(end.place, place) <= AT_END_PX);
    near.map(|end| raw.strokes[end.stroke]).collect()
}

/// What parts the lines that end at one place.
fn parted_by(ends: &[Line]) -> Joint {
    let of = |line: &Line| (line.kind, line.surface);
    let is_other = |line: &Line| of(line) != of(&ends[0]);
    match ends.iter().any(is_other) {
        true => Joint::Kind,
        false => Joint::Gap,
    }
}

/// Whether more than half of some samples are so.
fn is_most<'a>(samples: impl Iterator<Item = &'a Sample>, is_so: impl Fn(&Sample) -> bool) -> bool {
    let (mut all, mut so) = (0, 0);
    for sample in samples {
        all += 1;
        so += usize::from(is_so(sample));
    }
    2 * so > all
}

/// The station of the sample that is nearest to a place, where one lies within reach.
fn nearest_of<'a>(samples: impl Iterator<Item = &'a Sample>, place: [f64; 2]) -> Option<f64> {
    let away = samples.map(|sample| (distance(sample.place, place), sample.station));
    let (away, station) = away.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (away <= AT_END_PX).then_some(station)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::step::Step;
    use crate::motion::testing::{line, ring, ring_from, sheet_moved, traced};
    use npr_vector::stroke::{Kind, Stroke};

    /// Strokes that nothing is left out of.
    fn plain(strokes: &[Stroke]) -> Stages {
        staged(strokes, strokes)
    }

    fn staged(drawn: &[Stroke], raw: &[Stroke]) -> Stages {
        Stages {
            raw: traced(raw),
            with_stubs: traced(drawn),
            drawn: traced(drawn),
        }
    }

    fn causes_of(before: &Stages, after: &Stages, is_seen: bool) -> Causes {
        let mut causes = Causes::default();
        add_pair(&mut causes, before, after, is_seen);
        causes
    }

    fn add_pair(causes: &mut Causes, before: &Stages, after: &Stages, is_seen: bool) {
        let step = Step {
            from: sheet_moved(0.0),
            to: sheet_moved(0.0),
            skin: None,
        };
        causes.add(&Frames {
            stages: [before, after],
            is_seen: &|_| is_seen,
            was_seen: &|_| is_seen,
            pair: &Pair::new(&before.drawn, &after.drawn, &step),
        });
    }

    fn pops_of(before: &Stages, after: &Stages) -> Vec<Pop> {
        causes_of(before, after, true).pops.into_keys().collect()
    }

    #[test]
    fn each_pop_has_its_cause() {
        // A line in one piece, and in two.
        let whole = line([100.0, 90.0], [300.0, 90.0]);
        let halves = [
            line([100.0, 90.0], [200.0, 90.0]),
            line([200.0, 90.0], [300.0, 90.0]),
        ];
        let mut other_kind = halves.clone();
        other_kind[0].kind = Kind::Crease;
        let (one, two) = (plain(std::slice::from_ref(&whole)), plain(&halves));
        let joined = staged(std::slice::from_ref(&whole), &halves);
        let mut before_another = halves.clone();
        let points = before_another[0].points.iter_mut();
        points.for_each(|point| point.depth *= 1.1);
        let deeper = plain(&before_another);
        let cases = [
            (&one, &two, Pop::Joint(Joint::Gap)),
            (&two, &one, Pop::Joint(Joint::Gap)),
            (&joined, &two, Pop::Rule(Rule::Other)),
            (&two, &joined, Pop::Rule(Rule::Other)),
            (&joined, &deeper, Pop::Rule(Rule::Depth)),
            (
                &one,
                &staged(&halves, std::slice::from_ref(&whole)),
                Pop::Joint(Joint::Cut),
            ),
            (&one, &staged(&halves, &other_kind), Pop::Joint(Joint::Kind)),
            // A line that loses its front.
            (&one, &plain(&halves[1..]), Pop::Start(Absence::NoLine)),
            (
                &one,
                &staged(&halves[1..], &halves),
                Pop::Start(Absence::Suppressed),
            ),
            (&plain(&halves[1..]), &one, Pop::Start(Absence::NoLine)),
            (
                &staged(&halves[1..], &halves),
                &one,
                Pop::Start(Absence::Suppressed),
            ),
            // A line that is another one, or runs the other way.
            (
                &plain(&halves[..1]),
                &plain(&[turned(&halves[0])]),
                Pop::Reversed,
            ),
            (
                &plain(&[lengthened(&other_kind[0])]),
                &plain(&halves[..1]),
                Pop::OtherLine,
            ),
            (
                &plain(&halves[..1]),
                &plain(&[lengthened(&halves[0])]),
                Pop::Stretched,
            ),
            // Rings.
            (
                &plain(&[ring([300.0, 200.0], 80.0)]),
                &plain(&[ring_from([300.0, 200.0], 80.0, 30)]),
                Pop::Head,
            ),
        ];
        for (number, (before, after, pop)) in cases.into_iter().enumerate() {
            assert_eq!(pops_of(before, after), [pop], "case {number}");
        }
    }

    fn turned(stroke: &Stroke) -> Stroke {
        let [from, to] = [&stroke.points[1], &stroke.points[0]].map(|point| point.position);
        line(from, to)
    }

    /// The same stroke with a texture that starts later.
    fn lengthened(stroke: &Stroke) -> Stroke {
        let mut stroke = stroke.clone();
        stroke.points.iter_mut().for_each(|point| point.u += 20.0);
        stroke
    }

    #[test]
    fn joints_that_change_back_are_told() {
        let whole = line([100.0, 90.0], [300.0, 90.0]);
        let parts = [
            line([100.0, 90.0], [160.0, 90.0]),
            line([160.0, 90.0], [300.0, 90.0]),
        ];
        let two = plain(&parts);
        let joined = staged(std::slice::from_ref(&whole), &parts);
        let flips = |frames: &[&Stages]| {
            let mut causes = Causes::default();
            for pair in frames.windows(2) {
                add_pair(&mut causes, pair[0], pair[1], true);
            }
            causes.flips
        };
        assert_eq!(flips(&[&two, &joined]), [140, 0]);
        assert_eq!(flips(&[&two, &joined, &joined, &two]), [280, 140]);
        let long = [vec![&two], vec![&joined; BACK_FRAMES + 2], vec![&two]].concat();
        assert_eq!(flips(&long), [280, 0], "long ago");
    }

    #[test]
    fn only_what_is_joined_pops_after_a_vote() {
        let whole = line([100.0, 90.0], [300.0, 90.0]);
        let parts = [
            line([100.0, 90.0], [160.0, 90.0]),
            line([160.0, 90.0], [300.0, 90.0]),
        ];
        let (one, two) = (plain(std::slice::from_ref(&whole)), plain(&parts));
        let joined = staged(std::slice::from_ref(&whole), &parts);
        let voted = |before: &Stages, after: &Stages| {
            let causes = causes_of(before, after, true).voted_pops.into_iter();
            let counts = causes.map(|(pop, count)| (pop, count.count));
            counts.collect::<Vec<_>>()
        };
        assert_eq!(voted(&two, &one), [(Pop::Joint(Joint::Gap), 60)]);
        assert_eq!(voted(&two, &joined), [(Pop::Rule(Rule::Other), 60)]);
        assert_eq!(voted(&one, &two), []);
    }

    #[test]
    fn each_lost_end_has_its_cause() {
        let lines = [
            line([100.0, 90.0], [200.0, 90.0]),
            line([100.0, 190.0], [200.0, 190.0]),
        ];
        let without = plain(&lines[..1]);
        let losses = |after: &Stages, is_seen: bool| -> Vec<(Loss, usize)> {
            let causes = causes_of(&plain(&lines), after, is_seen);
            let losses = causes.losses.into_iter();
            losses.map(|(loss, count)| (loss, count.count)).collect()
        };
        let absent = |absence| vec![(Loss::Absence(absence), 2)];
        assert_eq!(losses(&without, true), absent(Absence::NoLine));
        assert_eq!(losses(&without, false), absent(Absence::Hidden));
        assert_eq!(
            losses(&staged(&lines[..1], &lines), true),
            absent(Absence::Suppressed)
        );
        let stubs = Stages {
            with_stubs: traced(&lines),
            ..plain(&lines[..1])
        };
        assert_eq!(losses(&stubs, true), absent(Absence::Stub));

        // Both ends of the second line become places on its way.
        let longer = [lines[0].clone(), line([50.0, 190.0], [250.0, 190.0])];
        let goes_on = vec![(Loss::Joint(Joint::Gap), 2)];
        assert_eq!(losses(&plain(&longer), true), goes_on);
    }
}
