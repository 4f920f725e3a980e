//! Heights of drawings made of strokes.
//!
//! Strokes lie on *tracks*, lines along v from end to end of the tile, and are parted on them by *gaps*. Tracks come in
//! octaves: each lays a new one in the middle of every two, then shakes them all. Gaps of a
//! track come in an order whose every beginning is spread evenly. So coarser drawings take the first
//! of both.

use super::drawing::{Drawing, Hand, STEPS};
use super::noise::{bit_reversed, closed_noise, hash, scaled_noise, signed, unit};
use npr_core::math;

/// Names of tracks: their places among this many, so that the names do not hang on the level.
const TRACK_IDS: u32 = 1 << 16;

/// Noise streams, one for each thing that varies.
const SHAKE: u32 = 0x1000;
const PRESSURE: u32 = 0x2000;
const WEIGHT: u32 = 0x3000;
const GAP: u32 = 0x4000;

/// A track where one row of texels crosses it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Track {
    /// Name; the track that a half turn maps it to has the name `TRACK_IDS - id`.
    id: u32,
    /// Whether this drawing inks it.
    drawn: bool,
    /// Place across strokes, in tiles.
    u: f32,
}

/// Fills a row of `side` heights at `v`: for each texel, how much ink it takes to reach it.
///
/// O(texels + tracks * (octaves + gaps)).
pub fn fill_row(drawing: Drawing, hand: &Hand, seed: u32, v: f32, heights: &mut [f32]) {
    let tracks: Vec<Track> = tracks_at(drawing, hand, seed, v)
        .into_iter()
        .filter(|track| track.drawn)
        .collect();
    heights.fill(f32::INFINITY);
    for (i, track) in tracks.iter().enumerate() {
        let before = tracks[(i + tracks.len() - 1) % tracks.len()].u;
        let after = tracks[(i + 1) % tracks.len()].u;
        let gaps = if tracks.len() == 1 {
            [1.0, 1.0]
        } else {
            [track.u - before, after - track.u].map(|gap| gap - gap.floor())
        };
        ink_track(drawing, hand, seed, v, *track, gaps, heights);
    }
}

/// Lowers the heights around a track to the ink that it takes to reach them.
///
/// One unit of height is half a spacing of even pressure. Beside a wide gap strokes are broader, half
/// of what it takes to keep the tone even.
fn ink_track(
    drawing: Drawing,
    hand: &Hand,
    seed: u32,
    v: f32,
    track: Track,
    gaps: [f32; 2],
    heights: &mut [f32],
) {
    let side = drawing.side as f32;
    let spacing = side / drawing.side_spacings();
    let pressure = pressure(drawing, hand, seed, track.id, v);
    let lifted = lifted(drawing, hand, seed, track.id, v);
    let slopes = gaps.map(|gap| {
        let relative = (gap * side / spacing).clamp(0.25, 4.0);
        2.0 / (spacing * pressure * relative.sqrt())
    });
    let centre = track.u * side - 0.5;
    let reach = (1.5 * spacing).ceil().min(side * 0.5) as i32;
    let middle = centre.floor() as i32;
    for x in middle - reach..=middle + reach + 1 {
        let dx = x as f32 - centre;
        let height = lifted + dx.abs() * slopes[usize::from(dx > 0.0)];
        let texel = &mut heights[x.rem_euclid(drawing.side as i32) as usize];
        *texel = texel.min(height);
    }
}

/// Every track of the level at `v`, ordered across the tile.
fn tracks_at(drawing: Drawing, hand: &Hand, seed: u32, v: f32) -> Vec<Track> {
    let mut tracks = vec![Track {
        id: 0,
        drawn: true,
        u: 0.0,
    }];
    let mut count = 1;
    loop {
        let finest = count == drawing.tracks();
        let fade = if finest { 1.0 - drawing.octave() } else { 1.0 };
        shake(&mut tracks, hand, seed, v, fade);
        if finest {
            return tracks;
        }
        count *= 2;
        let step = if count == drawing.tracks() {
            drawing.step
        } else {
            0
        };
        tracks = halve_gaps(&tracks, hand, seed, step);
    }
}

/// Shifts tracks by a wave of this octave, at most 0.3 of a spacing and with a slope below 0.1.
fn shake(tracks: &mut [Track], hand: &Hand, seed: u32, v: f32, fade: f32) {
    let count = tracks.len() as u32;
    let cells = (count / 6).max(2);
    let most = (0.3 / count as f32).min(0.05 / cells as f32);
    for track in tracks {
        let wave = |id: u32, v: f32| closed_noise(seed, SHAKE + count + (id << 8), cells, v);
        track.u += fade * hand.wobble * most * turned_odd(track.id, v, wave);
    }
}

/// Lays a track in the middle of every two, a little to the side; `step` decides which are drawn.
fn halve_gaps(tracks: &[Track], hand: &Hand, seed: u32, step: u32) -> Vec<Track> {
    let count = 2 * tracks.len() as u32;
    let mut finer = Vec::with_capacity(count as usize);
    for (i, track) in tracks.iter().enumerate() {
        let next_u = tracks.get(i + 1).map_or(tracks[0].u + 1.0, |next| next.u);
        let id = track.id + TRACK_IDS / count;
        let aside = |id: u32, _: f32| signed(hash(seed, SHAKE, id)) * (0.02 + 0.12 * hand.wobble);
        finer.push(*track);
        finer.push(Track {
            id,
            drawn: is_drawn(i as u32, tracks.len() as u32, step),
            u: (track.u + next_u) * 0.5 + turned_odd(id, 0.0, aside) / count as f32,
        });
    }
    finer
}

/// Whether newcomer `i` of `count` is among those that stay until `step`.
///
/// Steps by the golden ratio spread them evenly; a newcomer and its half turn share their fate.
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

/// Width of a stroke against the mean, 0.3..2: its own weight, and how the hand presses along it.
fn pressure(drawing: Drawing, hand: &Hand, seed: u32, id: u32, v: f32) -> f32 {
    let bends = 3.0 * drawing.side_spacings() / hand.length;
    let along = |id: u32, v: f32| scaled_noise(seed, PRESSURE + (id << 16), bends, v);
    let weight = |id: u32, _: f32| signed(hash(seed, WEIGHT, id));
    let varied = 0.4 * turned_even(id, v, weight) + 0.9 * turned_even(id, v, along);
    (1.0 + hand.variation * varied).clamp(0.3, 2.0)
}

/// Height, 0..1, of a track's centre line: 1 in the middle of a gap, 0 where the pen is down.
fn lifted(drawing: Drawing, hand: &Hand, seed: u32, id: u32, v: f32) -> f32 {
    let wanted = drawing.side_spacings() / hand.length;
    turned_even(id, v, |id, v| {
        let count = (wanted + unit(hash(seed, GAP, id))) as u32;
        let gap = |k: u32| {
            let aside = 0.3 * signed(hash(seed, GAP + id, k)) / (k + 1).next_power_of_two() as f32;
            let centre = bit_reversed(k) + unit(hash(seed, GAP + 1, id)) + aside;
            let past = v - centre;
            (past - (past + 0.5).floor()) * drawing.side_spacings()
        };
        (0..count).map(|k| tip(gap(k), hand)).fold(0.0, f32::max)
    })
}

/// Height of a centre line `past` spacings behind the middle of a gap: a stroke's head if positive, its
/// tail if negative. Tails are drawn out further than heads.
fn tip(past: f32, hand: &Hand) -> f32 {
    let tail = math::mix(0.7, 0.5 * hand.length.max(1.4), hand.taper);
    let head = math::mix(0.7, 0.25 * hand.length.max(2.8), hand.taper);
    let reach = if past > 0.0 { head } else { tail };
    let rest = (1.0 - past.abs() / reach).max(0.0);
    rest * rest
}
