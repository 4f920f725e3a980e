//! Heights of drawings made of strokes.
//!
//! Strokes lie on *tracks*, lines along v from end to end of the tile, and *gaps* part them there. Tracks come in
//! octaves: each adds a new one in the middle of every two, then shakes them all. The gaps of a track come in an order
//! of which any first few are spread evenly. So coarser drawings take the first tracks and the first gaps.

use super::drawing::{Drawing, Hand, STEPS};
use super::noise::{bit_reversed, closed_noise, scaled_noise};
use npr_core::math;
use npr_core::random::{hash, signed, unit};

/// Range of the tracks' names: a name is a place among so many, so names do not depend on the level.
const TRACK_IDS: u32 = 1 << 16;

/// How far strokes broaden into a wide gap beside them: 0 not at all, 1 until the tone is even.
const EVENNESS: f32 = 0.8;

/// Height of the middle of a gap: about the ink share at which strokes of a track join into one line.
const GAP_HEIGHT: f32 = 0.6;

/// Longest tips as a part of their stroke: at its head, where the pen sets down, and at its tail, where it leaves.
const HEAD: f32 = 0.15;
const TAIL: f32 = 0.4;

/// Length of a blunt tip in spacings.
const BLUNT_TIP: f32 = 0.7;

/// Difference of heights from which on the white between two strokes is round: within a tenth of a spacing of its
/// crest. More would close what lies between strokes that are near each other.
const CREST: f32 = 0.375;

/// Half the width in spacings of the round bottom of a stroke.
const BOTTOM: f32 = 0.075;

/// Noise streams, one for each thing that varies.
const SHAKE: u32 = 0x1000;
const PRESSURE: u32 = 0x2000;
const WEIGHT: u32 = 0x3000;
const GAP: u32 = 0x4000;

/// A track at the row of texels that crosses it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Track {
    /// Name; a half turn of the tile maps the track to the one named `TRACK_IDS - id`.
    id: u32,
    /// Whether this drawing holds it.
    drawn: bool,
    /// Place across the strokes, in tiles.
    u: f32,
}

/// The strokes of one drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strokes {
    /// The drawing that the strokes belong to.
    pub drawing: Drawing,
    /// The hand that draws them.
    pub hand: Hand,
    /// Seed that picks one of many alike.
    pub seed: u32,
}

impl Strokes {
    /// Fills the row of heights at `v`: for each texel, how much ink it takes until it is black.
    ///
    /// O(texels + tracks * (octaves + gaps)).
    pub fn fill_row(&self, v: f32, heights: &mut [f32]) {
        let mut tracks = self.tracks_at(v);
        tracks.retain(|track| track.drawn);
        heights.fill(f32::INFINITY);
        for (i, track) in tracks.iter().enumerate() {
            let before = tracks[(i + tracks.len() - 1) % tracks.len()].u;
            let after = tracks[(i + 1) % tracks.len()].u;
            let gaps = [track.u - before, after - track.u].map(|gap| gap - gap.floor());
            self.ink_track(*track, gaps, v, heights);
        }
    }

    /// Lowers the heights around a track to the ink that it takes until they are black.
    ///
    /// One unit of height is half a spacing at even pressure. `gaps` lie between the track and its
    /// neighbours, in tiles.
    fn ink_track(&self, track: Track, gaps: [f32; 2], v: f32, heights: &mut [f32]) {
        let side = self.drawing.side as f32;
        let spacing = side / self.drawing.side_spacings();
        let pressure = self.pressure(track.id, v);
        let lifted = self.lifted(track.id, v);
        let slopes = gaps.map(|gap| {
            let relative = (gap * side / spacing).clamp(0.25, 4.0);
            2.0 / (spacing * pressure * math::powf(relative, EVENNESS))
        });
        let centre = track.u * side - 0.5;
        let reach = (1.5 * spacing).ceil().min(side * 0.5) as i32;
        let middle = centre.floor() as i32;
        for x in middle - reach..=middle + reach + 1 {
            let dx = x as f32 - centre;
            let height = lifted + blunt(dx, BOTTOM * spacing) * slopes[usize::from(dx > 0.0)];
            let texel = &mut heights[x.rem_euclid(self.drawing.side as i32) as usize];
            *texel = lower_of(*texel, height);
        }
    }

    /// Every track of the level at `v`, ordered across the tile.
    fn tracks_at(&self, v: f32) -> Vec<Track> {
        let mut tracks = vec![Track {
            id: 0,
            drawn: true,
            u: 0.0,
        }];
        let mut count = 1;
        while count < self.drawing.tracks() {
            self.shake(&mut tracks, v, 1.0);
            count *= 2;
            let finest = count == self.drawing.tracks();
            tracks = self.halve_gaps(&tracks, if finest { self.drawing.step } else { 0 });
        }
        self.shake(&mut tracks, v, 1.0 - self.drawing.octave());
        tracks
    }

    /// Shifts tracks by a wave of this octave, at most 0.3 of a spacing and with a slope below 0.1.
    fn shake(&self, tracks: &mut [Track], v: f32, fade: f32) {
        let count = tracks.len() as u32;
        let cells = (count / 6).max(2);
        let most = (0.3 / count as f32).min(0.05 / cells as f32);
        for track in tracks {
            let wave = |id: u32, v: f32| closed_noise(self.seed, hash(SHAKE, count, id), cells, v);
            track.u += fade * self.hand.wobble * most * turned_odd(track.id, v, wave);
        }
    }

    /// Lays a track in the middle of every two, a little to the side; `step` decides which are drawn.
    fn halve_gaps(&self, tracks: &[Track], step: u32) -> Vec<Track> {
        let count = 2 * tracks.len() as u32;
        let most = 0.02 + 0.08 * self.hand.wobble;
        let mut finer = Vec::with_capacity(count as usize);
        for (i, track) in tracks.iter().enumerate() {
            let next_u = tracks.get(i + 1).map_or(tracks[0].u + 1.0, |next| next.u);
            let id = track.id + TRACK_IDS / count;
            let aside = turned_odd(id, 0.0, |id, _| signed(hash(self.seed, SHAKE, id)));
            finer.push(*track);
            finer.push(Track {
                id,
                drawn: is_drawn(i as u32, tracks.len() as u32, step),
                u: (track.u + next_u) * 0.5 + most * aside / count as f32,
            });
        }
        finer
    }

    /// Width of a stroke against the mean, 0.3..2: its own weight, and the pressure of the hand along it.
    fn pressure(&self, id: u32, v: f32) -> f32 {
        let bends = 3.0 * self.drawing.side_spacings() / self.hand.length;
        let weight = |id: u32, _: f32| signed(hash(self.seed, WEIGHT, id));
        let along = |id: u32, v: f32| scaled_noise(self.seed, hash(PRESSURE, 0, id), bends, v);
        let varied = 0.3 * turned_even(id, v, weight) + 0.6 * turned_even(id, v, along);
        (1.0 + self.hand.variation * varied).clamp(0.3, 2.0)
    }

    /// Height of a track's centre line: [`GAP_HEIGHT`] in the middle of a gap, 0 where the pen is down.
    fn lifted(&self, id: u32, v: f32) -> f32 {
        let spacings = self.drawing.side_spacings();
        turned_even(id, v, |id, v| {
            let count = spacings / self.hand.length + unit(hash(self.seed, GAP, id));
            let first = unit(hash(self.seed, GAP + 1, id));
            let past = |k: u32| {
                let room = 1.0 / (k + 1).next_power_of_two() as f32;
                let aside = 0.3 * room * signed(hash(self.seed, GAP + 2 + id, k));
                let tiles = v - (first + bit_reversed(k) + aside);
                (tiles - (tiles + 0.5).floor()) * spacings
            };
            let gaps = (0..count as u32).map(|k| self.tip(past(k)));
            gaps.fold(0.0, f32::max)
        })
    }

    /// Height of the centre line `past` spacings behind the middle of a gap: in the head of a stroke if positive, in
    /// the tail of one if negative. Tails are drawn out further than heads.
    fn tip(&self, past: f32) -> f32 {
        let part = if past > 0.0 { HEAD } else { TAIL };
        let drawn_out = (part * self.hand.length).max(BLUNT_TIP);
        let reach = math::mix(BLUNT_TIP, drawn_out, self.hand.taper);
        let rest = (1.0 - past.abs() / reach).max(0.0);
        GAP_HEIGHT * rest * rest
    }
}

/// Distance in texels from a centre line, with a round bottom.
///
/// With a sharp one, minima would lie between texels here and there, and hairlines would turn into beads.
fn blunt(dx: f32, bottom: f32) -> f32 {
    (dx * dx + bottom * bottom).sqrt()
}

/// The lower of two heights, with a round crest for the same reason: the last white between strokes is a hairline, too.
fn lower_of(a: f32, b: f32) -> f32 {
    let near = (1.0 - (a - b).abs() / CREST).max(0.0);
    a.min(b) - 0.25 * CREST * near * near
}

/// Whether track `i` of the `count` newest is among those that stay until `step`.
///
/// Steps by the golden ratio spread them evenly; a track and its half turn stay or go together.
fn is_drawn(i: u32, count: u32, step: u32) -> bool {
    let pair = i.min(count - 1 - i);
    let turn = (pair as f32 + 0.5) * 0.618_034;
    let staying = 2.0 * math::powf(0.5, step as f32 / STEPS as f32) - 1.0;
    turn - turn.floor() < staying || step == 0
}

/// The value of `f(id, v)`, made so that a half turn of the tile flips its sign.
fn turned_odd(id: u32, v: f32, f: impl Fn(u32, f32) -> f32) -> f32 {
    let twin = (TRACK_IDS - id) % TRACK_IDS;
    match id.cmp(&twin) {
        std::cmp::Ordering::Less => f(id, v),
        std::cmp::Ordering::Greater => -f(twin, -v),
        std::cmp::Ordering::Equal => (f(id, v) - f(id, -v)) * 0.5,
    }
}

/// The value of `f(id, v)`, made so that a half turn of the tile keeps it.
fn turned_even(id: u32, v: f32, f: impl Fn(u32, f32) -> f32) -> f32 {
    let twin = (TRACK_IDS - id) % TRACK_IDS;
    match id.cmp(&twin) {
        std::cmp::Ordering::Less => f(id, v),
        std::cmp::Ordering::Greater => f(twin, -v),
        std::cmp::Ordering::Equal => f(id, v).max(f(id, -v)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hatch::Hatch;
    use proptest::prelude::*;

    fn drawn(side: u32, step: u32, seed: u32, v: f32) -> Vec<Track> {
        let strokes = Strokes {
            drawing: Drawing { side, step },
            hand: Hand::of(&Hatch::default()),
            seed,
        };
        let mut tracks = strokes.tracks_at(v);
        tracks.retain(|track| track.drawn);
        tracks
    }

    #[test]
    fn strokes_thin_out_by_the_cube_root_of_two() {
        let counts: Vec<usize> = (0..=STEPS)
            .map(|step| drawn(512, step, 0, 0.0).len())
            .collect();
        assert_eq!([counts[0], counts[3]], [64, 32]);
        assert!(
            counts[1].abs_diff(51) <= 2 && counts[2].abs_diff(40) <= 2,
            "{counts:?}"
        );
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn coarser_drawings_keep_strokes_in_their_place(
            level in 1u32..6, step in 0..STEPS, seed: u32, v in 0.0f32..1.0,
        ) {
            let side = 16 << level;
            let fine = drawn(side, step, seed, v);
            let spacings = Drawing { side, step }.side_spacings();
            for track in drawn(side, step + 1, seed, v) {
                let before = fine.iter().find(|finer| finer.id == track.id);
                let drift = before.map(|finer| (finer.u - track.u).abs() * spacings);
                prop_assert!(drift.is_some_and(|drift| drift < 0.1), "{drift:?}");
            }
            let last = drawn(side, STEPS, seed, v);
            prop_assert_eq!(last, drawn(side / 2, 0, seed, v));
        }

        #[test]
        fn tracks_never_cross(level in 0u32..6, step in 0..=STEPS, seed: u32, v in 0.0f32..1.0) {
            let tracks = drawn(16 << level, step, seed, v);
            prop_assert!(tracks.windows(2).all(|pair| pair[0].u < pair[1].u));
        }

        /// Between texels both the bottom of a stroke and the crest of white beside it come out as on them: sharp ones
        /// would rise and fall by an eighth of the way between them, and hairlines would be beads.
        #[test]
        fn hairlines_stay_even_between_texels(off in 0.0f32..1.0, spacing in 8.0f32..16.0) {
            let height = |x: f32, centre: f32| blunt(x - centre, BOTTOM * spacing) * 2.0 / spacing;
            let between = |x: f32| lower_of(height(x, off), height(x, off + spacing));
            let texels: Vec<f32> = (-9..28).map(|x| between(x as f32)).collect();
            let at = |x: f32| {
                let i = (x.floor() + 9.0) as usize;
                math::mix(texels[i], texels[i + 1], x - x.floor())
            };
            let (bottom, crest) = (off, off + 0.5 * spacing);
            prop_assert!((at(bottom) - between(bottom)).abs() < 0.05, "bottom {} is {}", between(bottom), at(bottom));
            prop_assert!((at(crest) - between(crest)).abs() < 0.05, "crest {} is {}", between(crest), at(crest));
            prop_assert!(between(crest) - between(bottom) > 0.5);
        }
    }
}
