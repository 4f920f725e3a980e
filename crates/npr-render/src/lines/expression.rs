//! How the strokes of a drawing are drawn: where they end, how they thin out, how a hand sways, how they are dashed.

use super::model::check_count;
use super::options::LineOptions;
use crate::error::RenderError;
use npr_drawing::dash::{Dash, cut_to_dashes};
use npr_drawing::hand::{Hand, draw_by_hand};
use npr_drawing::overshoot::{Overshoot, move_ends};
use npr_drawing::pressure::{Curve, Pressure, press_strokes};
use npr_drawing::room::leave_room;
use npr_drawing::stubs::remove_stubs;
use npr_drawing::taper::{Taper, taper_strokes};
use npr_stylesheet::{Length, Style, TaperEnds, WidthStop};
use npr_vector::mesh_lines::run::SPECK_PX;
use npr_vector::sampled::PartWidth;
use npr_vector::stroke::{Kind, Stroke};

/// Samples on either side that decide with one whether it is seen.
const SAMPLE_RADIUS: u32 = 1;

/// A curve through the stops of a style.
pub(super) fn curve_of(stops: &[WidthStop]) -> Curve {
    let stops = stops
        .iter()
        .map(|stop| [stop.at, stop.factor].map(f64::from));
    Curve::new(&stops.collect::<Vec<_>>())
}

/// How strokes thin out in a style, with lengths in pixels as `px` resolves them.
fn taper_of(style: &Style, px: &dyn Fn(Length) -> f64) -> Taper {
    let width = &style.line.width;
    Taper {
        lengths_px: [width.taper.start, width.taper.end].map(px),
        short_px: px(width.short),
        share: f64::from(width.taper.share),
        tip: f64::from(width.taper.tip),
        at_all_ends: width.taper.ends == TaperEnds::All,
    }
}

/// What a style makes of strokes in a picture.
pub(crate) struct Expression {
    /// Lengths under which creases, and other lines, that end in the open are left out, in pixels.
    least_px: [f64; 2],
    overshoot: Overshoot,
    pressure: Pressure,
    /// Share of the way to a line beside it that ink may take; 0 for all.
    room: f64,
    taper: Taper,
    hand: Hand,
    dash: Dash,
}

impl Expression {
    /// That of a style in a view with its own pressure, with lengths in pixels as `px` resolves them. Lines that are
    /// not smoothed are all drawn, however short.
    pub fn new(
        (style, options): (&Style, &LineOptions),
        [height, dpi, world]: [f32; 3],
        pressure: Pressure,
    ) -> Self {
        let px = |length: Length| f64::from(length.to_px(height, dpi, world));
        let hand = &style.line.hand;
        Self {
            least_px: match options.smooth {
                true => {
                    let least = px(style.line.least);
                    [px(style.line.crease_least).max(least), least]
                }
                false => [0.0; 2],
            },
            overshoot: Overshoot {
                beyond_px: px(hand.overshoot),
                short_px: px(hand.undershoot),
            },
            pressure,
            room: f64::from(style.line.width.room),
            taper: taper_of(style, &px),
            hand: Hand {
                wobble_px: px(hand.wobble),
                wave_px: px(hand.wave),
                copies: hand.copies,
                spread_px: px(hand.spread),
            },
            dash: Dash {
                pattern_px: style.line.dash.pattern.iter().copied().map(px).collect(),
                fit: style.line.dash.fit,
            },
        }
    }

    /// What of it does not depend on what is seen of strokes: width over depth, and the hand.
    pub fn before_sight(self) -> Self {
        let none = Taper {
            lengths_px: [0.0; 2],
            short_px: 0.0,
            ..self.taper
        };
        Self {
            // Whether an end is in the open hangs on what is seen of the lines around it.
            least_px: [0.0; 2],
            overshoot: Overshoot {
                beyond_px: 0.0,
                short_px: 0.0,
            },
            pressure: Pressure {
                along: Curve::default(),
                ..self.pressure
            },
            room: 0.0,
            taper: none,
            hand: self.hand,
            dash: Dash {
                pattern_px: Vec::new(),
                ..self.dash
            },
        }
    }

    /// The rest of it: how wide the parts of lines are that are seen, found on samples.
    pub fn part_width(style: &Style, px: [f32; 3]) -> PartWidth {
        let [height, dpi, world] = px;
        let taper = taper_of(style, &|length| f64::from(length.to_px(height, dpi, world)));
        let pressure = curve_of(&style.line.width.pressure);
        let along = |stop: usize| pressure.at(stop as f64 / 31.0) as f32;
        PartWidth {
            along: std::array::from_fn(|i| std::array::from_fn(|j| along(4 * i + j))),
            taper_px: taper.lengths_px.map(|px| px as f32),
            taper_share: taper.share as f32,
            tip: taper.tip as f32,
            short_px: taper.short_px as f32,
            speck_px: SPECK_PX as f32,
            at_all_ends: u32::from(taper.at_all_ends),
            radius: SAMPLE_RADIUS,
        }
    }

    /// Draws the visible strokes for which `is_drawn` is true so, in a picture of `size` pixels.
    ///
    /// Stubs and specks go before ends move, as what is short is about lines and not about pens. Tapers follow the
    /// ends; copies have the tapers of their line; and each copy is dashed for itself.
    ///
    /// # Errors
    ///
    /// [`RenderError::TooMany`] before memory is taken for more points than a drawing may have.
    pub fn draw(
        &self,
        strokes: &mut Vec<Stroke>,
        size: [u32; 2],
        is_drawn: impl Fn(&Stroke) -> bool + Sync,
    ) -> Result<(), RenderError> {
        // Leave out stubs.
        let [of_creases, of_others] = self.least_px;
        let least_px = |stroke: &Stroke| match stroke.kind {
            _ if !is_drawn(stroke) => 0.0,
            Kind::Crease => of_creases,
            _ => of_others,
        };
        remove_stubs(strokes, size, least_px);

        // Move the ends, and thin them.
        let mut taper = self.taper;
        if !self.overshoot.is_none() {
            let specks = Taper {
                lengths_px: [0.0; 2],
                ..taper
            };
            taper_strokes(strokes, size, &specks, &is_drawn);
            taper.short_px = 0.0;
            move_ends(strokes, size, &self.overshoot, &is_drawn);
        }
        press_strokes(strokes, &self.pressure, &is_drawn);
        leave_room(strokes, self.room, &is_drawn);
        taper_strokes(strokes, size, &taper, &is_drawn);

        // Let them sway, and cut them.
        check_count(self.hand.points_after(strokes, &is_drawn))?;
        draw_by_hand(strokes, &self.hand, &is_drawn);
        check_count(self.dash.points_after(strokes, &is_drawn))?;
        cut_to_dashes(strokes, &self.dash, &is_drawn);
        Ok(())
    }
}
