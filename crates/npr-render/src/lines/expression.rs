//! How the strokes of a drawing are drawn: where they end, how they thin out, how a hand sways, how they are dashed.

use super::film::DrawnBefore;
use super::model::check_count;
use super::options::LineOptions;
use super::why::{Watch, WidthStep};
use crate::error::RenderError;
use crate::manners::{StrokeManner, StrokeManners};
use npr_drawing::dash::{Dash, cut_to_dashes, points_of_dashes};
use npr_drawing::guides::{Guide, cut_at_guides};
use npr_drawing::hand::{Hand, draw_by_hand, points_by_hand};
use npr_drawing::lengths::cut_long_strokes;
use npr_drawing::overshoot::{Overshoot, move_ends};
use npr_drawing::pressure::{Curve, Pressure, press_strokes};
use npr_drawing::room::leave_room;
use npr_drawing::stubs::remove_stubs;
use npr_drawing::taper::{Taper, taper_strokes};
use npr_stylesheet::{Length, Style, TaperEnds, WidthStop};
use npr_vector::mesh_lines::run::SPECK_PX;
use npr_vector::sampled::PartWidth;
use npr_vector::stroke::{Kind, Stroke};

/// How far from a guide a line may pass that it lifts the pen of, as a share of the picture's height.
const GUIDE_REACH: f64 = 0.03;

/// Samples on either side that decide with one whether it is seen.
const SAMPLE_RADIUS: u32 = 1;

/// A curve through the stops of a style.
pub(super) fn curve_of(stops: &[WidthStop]) -> Curve {
    let stops = stops
        .iter()
        .map(|stop| [stop.at, stop.factor].map(f64::from));
    Curve::new(&stops.collect::<Vec<_>>())
}

/// What resolves lengths of strokes to pixels.
struct Pixels<'a> {
    style: &'a Style,
    /// The height of the picture, pixels per inch, and about how many pixels a unit covers.
    px: [f32; 3],
}

impl Pixels<'_> {
    fn of(&self, length: Length) -> f64 {
        let [height, dpi, world] = self.px;
        f64::from(length.to_px(height, dpi, world))
    }

    /// Pixels of a length that a pen draws, at the scale of strokes.
    fn drawn(&self, length: Length) -> f64 {
        self.of(self.style.line.scaled(length))
    }

    /// How strokes thin out in a manner.
    fn taper(&self, taper: &npr_stylesheet::Taper) -> Taper {
        Taper {
            lengths_px: [taper.start, taper.end].map(|length| self.drawn(length)),
            short_px: self.drawn(self.style.line.width.short),
            share: f64::from(taper.share),
            tip: f64::from(taper.tip),
            at_all_ends: taper.ends == TaperEnds::All,
        }
    }

    /// A manner, with the pressure over depth that all share.
    fn manner(&self, manner: &StrokeManner, depth: &Pressure) -> Manner {
        let hand = &manner.hand;
        Manner {
            overshoot: Overshoot {
                beyond_px: self.drawn(hand.overshoot),
                short_px: self.drawn(hand.undershoot),
            },
            pressure: Pressure {
                along: curve_of(&manner.pressure),
                ..depth.clone()
            },
            taper: self.taper(&manner.taper),
            hand: Hand {
                wobble_px: self.drawn(hand.wobble),
                wave_px: self.drawn(hand.wave),
                copies: hand.copies,
                spread_px: self.drawn(hand.spread),
                by_texture: false,
            },
            dash: Dash {
                pattern_px: manner
                    .dash
                    .pattern
                    .iter()
                    .map(|length| self.drawn(*length))
                    .collect(),
                fit: manner.dash.fit,
                by_texture: false,
            },
        }
    }
}

/// How the strokes of a part are drawn, in pixels.
#[derive(Clone)]
struct Manner {
    overshoot: Overshoot,
    pressure: Pressure,
    taper: Taper,
    hand: Hand,
    dash: Dash,
}

/// What a style makes of strokes in a picture.
pub(crate) struct Expression {
    /// Lengths under which creases, and other lines, that end in the open are left out, in pixels.
    least_px: [f64; 2],
    /// Length of the longest stroke, in pixels; 0 for any.
    longest_px: f64,
    /// Where pens are lifted, and how far from there a line may pass, in pixels.
    guides: (Vec<Guide>, f64),
    /// Share of the way to a line beside it that ink may take; 0 for all.
    room: f64,
    /// How the strokes of parts are drawn, by the numbers of [`StrokeManners`].
    manners: Vec<Manner>,
}

impl Expression {
    /// That of a style in a view with its own pressure over depth, with lengths of a picture of `[height, dpi, world]`:
    /// its height, pixels per inch, and about how many pixels a unit covers. Lines that are not smoothed are all drawn,
    /// however short.
    pub fn new(
        (style, options): (&Style, &LineOptions),
        manners: &StrokeManners,
        px: [f32; 3],
        depth: &Pressure,
    ) -> Self {
        let pixels = Pixels { style, px };
        let manners = manners.all.iter();
        Self {
            least_px: match options.smooth {
                true => {
                    let least = pixels.of(style.line.least);
                    [pixels.of(style.line.crease_least).max(least), least]
                }
                false => [0.0; 2],
            },
            longest_px: pixels.drawn(style.line.longest),
            guides: (Vec::new(), GUIDE_REACH * f64::from(px[0])),
            room: f64::from(style.line.width.room),
            manners: manners.map(|manner| pixels.manner(manner, depth)).collect(),
        }
    }

    /// The same with pens lifted at some places.
    pub fn guided(mut self, guides: Vec<Guide>) -> Self {
        self.guides.0 = guides;
        self
    }

    /// The same for a film whose strokes hold: dashes and sways lie by the texture, which holds.
    pub fn held(mut self) -> Self {
        for manner in &mut self.manners {
            manner.dash.by_texture = true;
            manner.hand.by_texture = true;
        }
        self
    }

    /// What of it does not depend on what is seen of strokes: their length, width over depth, and the hand.
    pub fn before_sight(self) -> Self {
        let open = |manner: Manner| Manner {
            taper: Taper {
                lengths_px: [0.0; 2],
                short_px: 0.0,
                ..manner.taper
            },
            overshoot: Overshoot {
                beyond_px: 0.0,
                short_px: 0.0,
            },
            pressure: Pressure {
                along: Curve::default(),
                ..manner.pressure
            },
            hand: manner.hand,
            dash: Dash {
                pattern_px: Vec::new(),
                ..manner.dash
            },
        };
        Self {
            // Whether an end is in the open hangs on what is seen of the lines around it.
            least_px: [0.0; 2],
            longest_px: self.longest_px,
            guides: self.guides,
            room: 0.0,
            manners: self.manners.into_iter().map(open).collect(),
        }
    }

    /// The rest of it: how wide the parts of lines are that are seen, found on samples; for every manner. Lengths are
    /// those of a picture of `[height, dpi, world]` as in [`Expression::new`], enlarged.
    pub fn part_widths(
        style: &Style,
        manners: &StrokeManners,
        (px, enlarged): ([f32; 3], f32),
    ) -> Vec<PartWidth> {
        let pixels = Pixels { style, px };
        let width = |manner: &StrokeManner| {
            let taper = pixels.taper(&manner.taper);
            let pressure = curve_of(&manner.pressure);
            let along = |stop: usize| pressure.at(stop as f64 / 31.0) as f32;
            PartWidth {
                along: std::array::from_fn(|i| std::array::from_fn(|j| along(4 * i + j))),
                taper_px: taper.lengths_px.map(|px| px as f32 * enlarged),
                taper_share: taper.share as f32,
                tip: taper.tip as f32,
                short_px: taper.short_px as f32 * enlarged,
                speck_px: SPECK_PX as f32 * enlarged,
                at_all_ends: u32::from(taper.at_all_ends),
                radius: SAMPLE_RADIUS,
            }
        };
        manners.all.iter().map(width).collect()
    }

    /// Draws the visible strokes so for which `manner_of` gives the number of a manner, in a picture of `size` pixels.
    /// After a frame `before` what was drawn there is a stub when it is shorter. `watch` sees them after every step
    /// that changes widths.
    ///
    /// Stubs and specks go before ends move, as what is short is about lines and not about pens. Tapers follow the
    /// ends; copies have the tapers of their line; and each copy is dashed for itself.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] before memory is taken for more points than a drawing may have.
    pub(super) fn draw(
        &self,
        strokes: &mut Vec<Stroke>,
        size: [u32; 2],
        manner_of: impl Fn(&Stroke) -> Option<u32> + Sync,
        (before, watch): (Option<&mut DrawnBefore>, Watch<'_>),
    ) -> Result<(), RenderError> {
        // Leave out stubs, and cut what is too long.
        let of = |stroke: &Stroke| manner_of(stroke).and_then(|i| self.manners.get(i as usize));
        let is_drawn = |stroke: &Stroke| of(stroke).is_some();
        let [of_creases, of_others] = self.least_px;
        let least_px = |stroke: &Stroke| match stroke.kind {
            // What is drawn as a line in the file, and a blade of grass, is meant, however short.
            Kind::Marked => 0.0,
            _ if !is_drawn(stroke) => 0.0,
            Kind::Crease => of_creases,
            _ => of_others,
        };
        match before {
            Some(before) => before.remove_stubs(strokes, size, least_px),
            None => remove_stubs(strokes, size, least_px),
        }
        cut_long_strokes(strokes, self.longest_px, is_drawn);
        let (guides, reach_px) = &self.guides;
        let lifted = cut_at_guides(strokes, guides, *reach_px, is_drawn);
        let is_lifted = |stroke: &Stroke| lifted.get(&stroke.id).copied().unwrap_or_default();

        // Move the ends, and thin them.
        let moves_ends = self
            .manners
            .iter()
            .any(|manner| !manner.overshoot.is_none());
        let mut tapers: Vec<Taper> = self.manners.iter().map(|manner| manner.taper).collect();
        if moves_ends {
            let mut specks = tapers.clone();
            specks
                .iter_mut()
                .for_each(|taper| taper.lengths_px = [0.0; 2]);
            let specks = |stroke: &Stroke| specks.get(manner_of(stroke)? as usize);
            taper_strokes(strokes, size, specks, is_lifted);
            tapers.iter_mut().for_each(|taper| taper.short_px = 0.0);
            move_ends(strokes, size, |stroke| Some(&of(stroke)?.overshoot));
        }
        press_strokes(strokes, |stroke| Some(&of(stroke)?.pressure));
        watch(WidthStep::Pressure, strokes);
        leave_room(strokes, self.room, is_drawn);
        watch(WidthStep::Room, strokes);
        let tapers = |stroke: &Stroke| tapers.get(manner_of(stroke)? as usize);
        taper_strokes(strokes, size, tapers, is_lifted);
        watch(WidthStep::Taper, strokes);

        // Let them sway, and cut them.
        let hand_of = |stroke: &Stroke| Some(&of(stroke)?.hand);
        check_count(points_by_hand(strokes, hand_of))?;
        draw_by_hand(strokes, hand_of);
        let dash_of = |stroke: &Stroke| Some(&of(stroke)?.dash);
        check_count(points_of_dashes(strokes, dash_of))?;
        cut_to_dashes(strokes, dash_of);
        Ok(())
    }
}
