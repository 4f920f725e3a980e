//! How much ink changes from a frame to the next that should only move with its surface.
//!
//! Every pixel of a frame that shows a known place is carried to the next frame by the surface ([`Step`]), and back.
//! It is *compared* where the next frame shows the same place, and what the ink is *due* to show there is the same:
//! the shade that hatching stands for, or the ink of a plain pen that a brush draws in the place of. So what comes into
//! view, what another light explains, and lines that move are causes, and what is left has none:
//!
//! - ink **differs** where its tone is another by more than [`STEP`] at its own place, or by more than half of it
//! - it is **gone** where besides nothing within [`NEAR_PX`] has half as much ink; **new** is the same backwards
//! - it **slides** as far as squares of ink have to move to match ([`shifts`])
//!
//! Ink that swims against its surface differs; ink that comes or goes at once is new or gone. Tones are read softened
//! by a pixel, so that reading between pixels changes nothing: a sharp edge half a pixel on differs by a quarter of its
//! height from what is read there, softened by a sixteenth.

use glam::DVec3;
use rayon::prelude::*;

use super::step::Step;
use crate::comic::shift::shifts;
use crate::lines::viewpoint::Viewpoint;
use crate::tones::softened;

/// Ink from which a pixel counts as inked, 0..1.
pub const INKED: f32 = 0.5;

/// Differences of tone up to this are none, 0..1, and up to half the tone where that is less: thin ink is faint once it
/// is softened.
pub const STEP: f32 = 0.25;

/// How far from its place ink counts as still there, in pixels.
pub const NEAR_PX: f64 = 1.5;

/// A frame's ink, the places that it lies on, and what it is due to show.
#[derive(Debug, Clone)]
pub struct Inked {
    size: [usize; 2],
    view: Viewpoint,
    ink: Vec<f32>,
    softened: Vec<f32>,
    places: Places,
}

/// Where every pixel lies in the world, and what is due there.
#[derive(Debug, Clone, Default)]
pub struct Places {
    /// Depth of what each pixel shows, in scene units; NaN where that is not known.
    pub depths: Vec<f64>,
    /// Whether ink is judged there; never where the depth is not known.
    pub is_judged: Vec<bool>,
    /// What the ink is due to show, 0..1.
    pub due: Vec<f32>,
    /// Differences of depth, as a share of the depth, up to which two frames show the same place.
    pub same_depth: f64,
    /// Differences of what is due up to which it is the same.
    pub same_due: f32,
}

/// What changes from a frame to the next, or in all pairs of frames of a sequence.
#[derive(Debug, Clone, Default)]
pub struct InkTally {
    /// Pixels of both frames at which ink is judged.
    pub judged: usize,
    /// Those of them that the other frame shows too, where the same is due.
    pub compared: usize,
    /// Those of them that are inked: of frames before, and of frames after.
    pub inked: [usize; 2],
    /// Inked pixels of both whose tone differs.
    pub differing: usize,
    /// Inked pixels of frames before that are gone, and those of frames after that are new.
    pub jumping: [usize; 2],
    /// How far places move in the picture, in pixels, for some of those that are compared.
    pub moves: Vec<f64>,
    /// How far ink slides against its surface, in pixels, by square.
    pub slides: Vec<f64>,
}

/// Every so many pixels the way of a place is kept.
const MOVES_EVERY: usize = 97;

/// What became of the inked pixels of a pair of frames, by their places in the frame after.
#[derive(Debug, Clone, Default)]
pub struct Events {
    /// Where tones differ.
    pub differing: Vec<[f64; 2]>,
    /// Where ink is gone or new.
    pub jumping: Vec<[f64; 2]>,
}

impl Inked {
    /// A frame of `size` pixels that a camera sees: the ink of every pixel, 0..1, row by row.
    pub fn new(size: [u32; 2], view: Viewpoint, ink: Vec<f32>, places: Places) -> Self {
        Self {
            size: size.map(|side| side as usize),
            view,
            softened: softened(size, ink.iter().copied()),
            ink,
            places,
        }
    }

    /// The ink of every pixel, 0..1, row by row.
    pub fn tones(&self) -> &[f32] {
        &self.ink
    }

    /// The camera that sees the frame.
    pub fn view(&self) -> Viewpoint {
        self.view
    }

    /// Where the places of this frame's pixels lie in `other`; none where they are not judged, `other` does not show
    /// them, or something else is due there. Parallel over pixels.
    fn places_in(&self, other: &Self, step: &Step<'_>) -> Vec<Option<[f64; 2]>> {
        let place_in = |pixel: usize| {
            // Carry the pixel.
            if !self.places.is_judged[pixel] {
                return None;
            }
            let here = [pixel % self.size[0], pixel / self.size[0]].map(|side| side as f64 + 0.5);
            let world = self.view.point_at(here, self.places.depths[pixel]);
            let (there, carried): ([f64; 2], DVec3) = step.moved(here, world);

            // Look whether it shows there.
            let around = other.around(there)?;
            let depth = around.mean(&other.places.depths);
            let away = (step.to.depth(carried) - depth).abs();
            let is_same = away <= self.places.same_depth * depth;
            let due = around.mean_tone(&other.places.due);
            let is_due = (due - self.places.due[pixel]).abs() <= self.places.same_due;
            (is_same && is_due).then_some(there)
        };
        (0..self.ink.len()).into_par_iter().map(place_in).collect()
    }

    /// The four pixels around a place; none where one of them lies outside of the picture.
    fn around(&self, [x, y]: [f64; 2]) -> Option<Around> {
        let (x, y) = (x - 0.5, y - 0.5);
        let last = |i: usize| self.size[i] as f64 - 1.0;
        if !(x >= 0.0 && y >= 0.0 && x < last(0) && y < last(1)) {
            return None;
        }
        Some(Around {
            first: y as usize * self.size[0] + x as usize,
            width: self.size[0],
            shares: [x.fract(), y.fract()],
        })
    }

    /// Most ink, softened, of the pixels whose middles lie within [`NEAR_PX`] of a place.
    fn most_near(&self, place: [f64; 2]) -> f32 {
        let range = |i: usize| {
            let low = (place[i] - NEAR_PX - 0.5).ceil().max(0.0) as usize;
            let high = (place[i] + NEAR_PX - 0.5).floor().max(-1.0) + 1.0;
            low..(high as usize).min(self.size[i])
        };
        let pixels = range(1).flat_map(|y| range(0).map(move |x| [x, y]));
        pixels
            .filter(|pixel| {
                let [dx, dy] = [0, 1].map(|i| pixel[i] as f64 + 0.5 - place[i]);
                dx * dx + dy * dy <= NEAR_PX * NEAR_PX
            })
            .map(|[x, y]| self.softened[y * self.size[0] + x])
            .fold(0.0, f32::max)
    }
}

/// Four pixels around a place, and how far it lies to the right and below the first of them.
struct Around {
    first: usize,
    width: usize,
    shares: [f64; 2],
}

impl Around {
    /// A value between the pixels.
    fn mean(&self, values: &[f64]) -> f64 {
        let [s, t] = self.shares;
        let row = |start: usize| values[start] + (values[start + 1] - values[start]) * s;
        let upper = row(self.first);
        upper + (row(self.first + self.width) - upper) * t
    }

    /// A tone between the pixels.
    fn mean_tone(&self, tones: &[f32]) -> f32 {
        let [s, t] = self.shares.map(|share| share as f32);
        let row = |start: usize| tones[start] + (tones[start + 1] - tones[start]) * s;
        let upper = row(self.first);
        upper + (row(self.first + self.width) - upper) * t
    }
}

impl InkTally {
    /// Adds a pair of frames, with the ways there and back; tells where ink changed.
    pub fn add(&mut self, [before, after]: [&Inked; 2], [there, back]: [&Step<'_>; 2]) -> Events {
        // Compare the ink of either frame with that of the other.
        let mut events = Events::default();
        let carried = before.places_in(after, there);
        let carried_back = after.places_in(before, back);
        for (side, frames, places) in [
            (0, [before, after], &carried),
            (1, [after, before], &carried_back),
        ] {
            self.add_side(side, frames, places, &mut events);
        }
        let ways = carried.iter().enumerate().step_by(MOVES_EVERY);
        self.moves.extend(ways.filter_map(|(pixel, place)| {
            let [x, y] = (*place)?;
            let [column, row] = [pixel % before.size[0], pixel / before.size[0]];
            Some((column as f64 + 0.5 - x).hypot(row as f64 + 0.5 - y))
        }));

        // Find how far ink slides.
        let ink_before = |place: &Option<[f64; 2]>| {
            let around = before.around((*place)?)?;
            Some(f64::from(around.mean_tone(&before.ink)))
        };
        let ink: Vec<f64> = after.ink.iter().copied().map(f64::from).collect();
        let carried_ink: Vec<Option<f64>> = carried_back.iter().map(ink_before).collect();
        self.slides.extend(shifts(after.size, &ink, &carried_ink));
        events
    }

    /// Adds what became of the ink of the first of two frames in the second; `side` is 0 where the first is that
    /// before.
    fn add_side(
        &mut self,
        side: usize,
        [from, to]: [&Inked; 2],
        places: &[Option<[f64; 2]>],
        events: &mut Events,
    ) {
        self.judged += from
            .places
            .is_judged
            .iter()
            .filter(|judged| **judged)
            .count();
        for (pixel, place) in places.iter().enumerate() {
            // Count the ink that can be compared.
            let Some(place) = *place else { continue };
            self.compared += 1;
            if from.ink[pixel] < INKED {
                continue;
            }
            self.inked[side] += 1;

            // Look for it there, and around.
            let tone = from.softened[pixel];
            let now = to
                .around(place)
                .map(|around| around.mean_tone(&to.softened));
            if (now.unwrap_or_default() - tone).abs() <= STEP.min(tone / 2.0) {
                continue;
            }
            let in_frame_after = match side {
                0 => place,
                _ => [pixel % from.size[0], pixel / from.size[0]].map(|side| side as f64 + 0.5),
            };
            self.differing += 1;
            events.differing.push(in_frame_after);
            if to.most_near(place) < tone / 2.0 {
                self.jumping[side] += 1;
                events.jumping.push(in_frame_after);
            }
        }
    }

    /// Share of the judged pixels that are compared, 0..1.
    pub fn compared_share(&self) -> f64 {
        share(self.compared, self.judged)
    }

    /// Share of the compared pixels that are inked.
    pub fn inked_share(&self) -> f64 {
        share(self.inked[0] + self.inked[1], self.compared)
    }

    /// Share of the ink whose tone differs.
    pub fn differing_share(&self) -> f64 {
        share(self.differing, self.inked[0] + self.inked[1])
    }

    /// Shares of the ink that is gone, and of that which is new.
    pub fn jumping_shares(&self) -> [f64; 2] {
        [0, 1].map(|side| share(self.jumping[side], self.inked[side]))
    }

    /// Whether nothing changes at all.
    pub fn is_still(&self) -> bool {
        self.differing == 0 && self.slides.iter().all(|slide| *slide == 0.0)
    }
}

fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::testing::{SIZE, sheet_moved};
    use npr_mesh::testing::Random;
    use proptest::prelude::*;

    /// Half the sides of the sheet, in pixels; a pixel is a unit of the world.
    const HALF: [f64; 2] = [200.0, 140.0];

    /// Depth of the sheet.
    const DEPTH: f64 = 100.0;

    /// The sheet, moved to the right: `ink` at places of the sheet, from its middle, in pixels, and what is due there.
    fn sheet(right: f64, ink: impl Fn([f64; 2]) -> f64, due: impl Fn([f64; 2]) -> f32) -> Inked {
        let count = (SIZE[0] * SIZE[1]) as usize;
        let mut places = Places {
            depths: vec![f64::NAN; count],
            is_judged: vec![false; count],
            due: vec![0.0; count],
            same_depth: 0.003,
            same_due: 0.01,
        };
        let mut tones = vec![0.0; count];
        for pixel in 0..count as u32 {
            let x = f64::from(pixel % SIZE[0]) + 0.5 - f64::from(SIZE[0]) / 2.0 - right;
            let y = f64::from(pixel / SIZE[0]) + 0.5 - f64::from(SIZE[1]) / 2.0;
            if x.abs() <= HALF[0] && y.abs() <= HALF[1] {
                let pixel = pixel as usize;
                places.depths[pixel] = DEPTH;
                places.is_judged[pixel] = true;
                places.due[pixel] = due([x, y]);
                tones[pixel] = ink([x, y]) as f32;
            }
        }
        Inked::new(SIZE, sheet_moved(right), tones, places)
    }

    /// The frames of a sheet before and after it moved to the right.
    fn tally_of(frames: [&Inked; 2]) -> (InkTally, Events) {
        let [there, back] = [[0, 1], [1, 0]].map(|[from, to]| Step {
            from: frames[from].view,
            to: frames[to].view,
            skin: None,
        });
        let mut tally = InkTally::default();
        let events = tally.add(frames, [&there, &back]);
        (tally, events)
    }

    fn even([_, _]: [f64; 2]) -> f32 {
        0.5
    }

    /// How much of a pixel upright stripes cover, `width` wide and `period` apart.
    fn stripes(x: f64, period: f64, width: f64) -> f64 {
        let covered = |x: f64| {
            let periods = (x / period).floor();
            periods * width + (x - periods * period).min(width)
        };
        covered(x + 0.5) - covered(x - 0.5)
    }

    /// Squares of ten pixels, twenty apart, but for those of some numbers, counted along rows.
    fn squares([x, y]: [f64; 2], without: &[i64]) -> f64 {
        let [column, row] = [x, y].map(|v| (v / 20.0).floor() as i64);
        let is_inside = [x, y].iter().all(|v| v.rem_euclid(20.0) < 10.0);
        f64::from(u8::from(
            is_inside && !without.contains(&(row * 20 + column)),
        ))
    }

    #[test]
    fn what_goes_is_counted_to_the_pixel() {
        let all = sheet(0.0, |at| squares(at, &[]), even);
        let some = sheet(0.0, |at| squares(at, &[0, 3, 25]), even);
        let (tally, events) = tally_of([&all, &some]);
        // Past the last row and column there is nothing to read between.
        assert_eq!(
            (tally.judged, tally.compared),
            (2 * 400 * 280, 2 * 399 * 279)
        );
        assert_eq!((tally.inked, tally.jumping), ([28_000, 27_700], [300, 0]));
        assert_eq!((tally.differing, events.jumping.len()), (300, 300));
        let (tally, _) = tally_of([&some, &all]);
        assert_eq!(tally.jumping, [0, 300]);
    }

    #[test]
    fn what_stays_changes_nothing_to_the_bit() {
        let mut random = Random::new(5);
        let tones: Vec<f64> = (0..1000).map(|_| f64::from(random.unit())).collect();
        let noise =
            |[x, y]: [f64; 2]| tones[((x * 31.0 + y * 17.0) as i64).rem_euclid(1000) as usize];
        let frame = sheet(3.25, noise, even);
        let (tally, events) = tally_of([&frame, &frame]);
        assert!(tally.is_still() && events.differing.is_empty() && tally.inked[0] > 10_000);
        assert!(!tally.slides.is_empty() && tally.moves.iter().all(|way| *way == 0.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// Strokes and dots down to a pixel, by any part of a pixel.
        #[test]
        fn ink_that_moves_with_its_surface_does_not_change(
            right in -9.0..9.0f64, period in 4.0..12.0f64, share in 0.3..0.7f64, is_dotted: bool,
        ) {
            let right = f64::from(right as f32);
            let width = (share * period - 1.0).max(1.0);
            let ink = |[x, y]: [f64; 2]| {
                stripes(x, period, width) * if is_dotted { stripes(y, period, width) } else { 1.0 }
            };
            let frames = [0.0, right].map(|right| sheet(right, ink, even));
            let (tally, _) = tally_of([&frames[0], &frames[1]]);
            prop_assert!(tally.inked[0] > 500, "{:?}", tally.inked);
            prop_assert_eq!((tally.differing, tally.jumping), (0, [0, 0]));
            prop_assert!(tally.moves.iter().all(|way| (way - right.abs()).abs() < 1e-3));
            prop_assert!(tally.slides.iter().all(|slide| *slide < 0.35), "{:?}", tally.slides);
        }
    }

    #[test]
    fn ink_that_stays_on_the_screen_differs_and_slides() {
        // A shower door: the sheet moves by two pixels behind its strokes.
        let on_screen = |right: f64| sheet(right, move |[x, _]| stripes(x + right, 7.0, 3.0), even);
        let (tally, _) = tally_of([&on_screen(0.0), &on_screen(2.0)]);
        assert!(tally.differing_share() > 0.6, "{}", tally.differing_share());
        let shift = tally.slides.iter().sum::<f64>() / tally.slides.len() as f64;
        assert!((shift - 2.0).abs() < 0.1, "{shift}");
    }

    #[test]
    fn ink_with_a_cause_counts_for_nothing() {
        // Another tone is due on one half, and its ink goes.
        let all = sheet(0.0, |at| squares(at, &[]), even);
        let lit = |[x, _]: [f64; 2]| if x < 0.0 { 0.5 } else { 0.6 };
        let lighter = sheet(
            0.0,
            |at| if at[0] < 0.0 { squares(at, &[]) } else { 0.0 },
            lit,
        );
        let (tally, _) = tally_of([&all, &lighter]);
        assert_eq!((tally.differing, tally.jumping), (0, [0, 0]));
        assert!((tally.compared_share() - 0.5).abs() < 0.01);

        // Something else comes before one half, without ink.
        let mut hidden = sheet(
            0.0,
            |at| if at[0] < 0.0 { squares(at, &[]) } else { 0.0 },
            even,
        );
        for (pixel, depth) in hidden.places.depths.iter_mut().enumerate() {
            *depth = if pixel as u32 % SIZE[0] < SIZE[0] / 2 {
                *depth
            } else {
                DEPTH - 1.0
            };
        }
        let (tally, _) = tally_of([&all, &hidden]);
        assert_eq!((tally.differing, tally.jumping), (0, [0, 0]));
    }

    #[test]
    fn ink_that_moves_by_a_pixel_differs_but_is_not_gone() {
        let line = |at: f64| {
            sheet(
                0.0,
                move |[x, _]| f64::from(u8::from((x - at).abs() < 1.0)),
                even,
            )
        };
        let (tally, _) = tally_of([&line(0.0), &line(1.0)]);
        assert!(tally.differing > 0);
        assert_eq!(tally.jumping, [0, 0]);
        let (tally, _) = tally_of([&line(0.0), &line(4.0)]);
        assert_eq!(tally.jumping, tally.inked);
    }
}
