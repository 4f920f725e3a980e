//! The colour of a line before a background: the twin of `lib/backdrop`.

use super::oklab::{light_of_oklab, oklab_of_light};
use super::published::{self, sane};
use super::rule::Rule;
use crate::luminance::LUMA;
use npr_core::color::{linear_from_srgb, pack_rgba8, srgb_from_linear, unpack_rgba8};
use npr_core::math::{self, mix, smoothstep};
use npr_core::surface::dot;

/// Contrast given up for the sake of a smaller step, and half the band in which a line turns from darker to brighter.
///
/// A line that is lighter than a dark background and darker than a light one must pass through the background's own
/// lightness somewhere between, if it is to change without a jump. Smaller makes that stretch of outline shorter, and
/// the change steeper.
pub(super) const TURN: f32 = 0.006;

/// Greatest difference, in lightness, at which the steps to both candidates still count as about equal.
const EVEN_STEP: f32 = 0.018;

/// Weight of missing contrast in a vote, as a multiple of a step in lightness: that a line reads comes first.
const LACK_WORTH: f32 = 50.0;

/// Vote in favour of the direction that a rule forces; the other candidate is to stay where it reads already.
const FORCED: f32 = 0.05;

/// Share of the target contrast after which a moved line has taken all of its hue from the rim.
const HUE_AT: f32 = 0.5;

/// Rounds of bisection when chroma is fitted into the gamut, and lightness to a luminance.
const FIT_ROUNDS: u32 = 14;

/// How far a channel may lie outside 0..1 and still count as in gamut, as a share of a grey of that lightness.
const GAMUT_ROOM: f32 = 1e-3;

/// Least red while chroma is first fitted into the gamut, as a share of blue.
///
/// At the tip of sRGB's blue the gamut overhangs by 0.16 degrees of hue: on the way from grey to the tip chroma leaves
/// it and comes back. Chroma that is fitted to this border jumps by 15 %. The border where red is 1/66 of blue or more
/// does not overhang.
const BLUE_TIP: f32 = 1.0 / 64.0;

/// Largest factor by which chroma then grows up to the gamut's own border; the tip of blue needs 1.55.
const TIP_REACH: f32 = 1.6;

/// Greatest ratio of luminances, that of white to black [WCAG 2].
const WCAG_LARGEST: f32 = 21.0;

/// The colour of a line where its surface ends before `behind`; all colours are sRGB-encoded, 0..1.
///
/// `rim` is the colour of the surface beside the line. With a rule by contrast, a line that reaches the target stays as
/// it is. Any other moves in lightness until it does, and takes its hue from the rim on the way; chroma gives way where
/// sRGB has no such colour. If neither direction reaches the target, the line goes as far as it can.
///
/// Continuous in all three colours, and steep in two places. A line turns from darker to brighter within a band of
/// 1.2 % of the measure's scale. OKLab is steep beside black: the first of 255 steps of a grey is 6.7 % of lightness.
///
/// Contrast never falls, except before backgrounds at which the line turns from darker to brighter: a band of about 1 %
/// of lightness.
///
/// With a rule by likeness: the published method, see [`published::color`]. Channels outside 0..1 are clamped; NaN
/// counts as 0. About 10 cube roots and 200 products.
pub fn adapt(line: [f32; 3], rim: [f32; 3], behind: [f32; 3], rule: &Rule) -> [f32; 3] {
    let [line, rim, behind] = [line, rim, behind].map(|color| color.map(sane));
    let rule = &rule.sane();
    if rule.method == Rule::BY_LIKENESS {
        return published::color(line, rim, behind, rule);
    }
    let light = |color: [f32; 3]| color.map(linear_from_srgb);
    let before = light(line);
    if rule.method == Rule::OFF {
        return line;
    }
    let ground = Ground::of_light(light(behind), rule);
    let adapted = adapted_light(before, light(rim), &ground, rule);
    match adapted == before {
        true => line,
        false => adapted.map(srgb_from_linear),
    }
}

/// The contrast of one colour before another, both sRGB-encoded, in the measure of the rule's target.
pub fn contrast(line: [f32; 3], behind: [f32; 3], rule: &Rule) -> f32 {
    let light = [line, behind].map(|color| color.map(|channel| linear_from_srgb(sane(channel))));
    if rule.measure == Rule::WCAG {
        let [a, b] = light.map(|light| dot(LUMA, light) + 0.05);
        return a.max(b) / a.min(b);
    }
    let [a, b] = light.map(|light| oklab_of_light(light)[0]);
    (a - b).abs()
}

/// What lies behind a line, as places on the scale of the rule's measure: 0 black, 1 white.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// The darkest ground that the line must read before.
    pub low: f32,
    /// The brightest ground that the line must read before.
    pub high: f32,
    /// Share of the brighter candidate in the result, 0..1; `None` if this ground alone decides.
    pub brighter: Option<f32>,
}

impl Ground {
    /// The ground of a single colour in linear light.
    pub fn of_light(behind: [f32; 3], rule: &Rule) -> Self {
        let place = place_of_light(behind, rule);
        Self {
            low: place,
            high: place,
            brighter: None,
        }
    }

    /// Packs the ground and the number of a rule into a texel.
    pub(super) fn packed(&self, rule: u32) -> u32 {
        let share = self.brighter.unwrap_or(0.5);
        pack_rgba8([self.low, self.high, share, 0.0]) | rule << 24
    }

    /// Unpacks the ground from such a texel.
    pub(super) fn unpacked(texel: u32) -> Self {
        let [low, high, share, _] = unpack_rgba8(texel);
        Self {
            low,
            high,
            brighter: Some(share),
        }
    }
}

/// [`adapt`] by contrast for colours in linear light of 0..1, as passes compute it.
pub fn adapted_light(line: [f32; 3], rim: [f32; 3], ground: &Ground, rule: &Rule) -> [f32; 3] {
    let line = started(|| line, rim, rule);
    let own = oklab_of_light(line);
    let target = target_of(rule);
    let from = place_of(line, own[0], rule);
    let to = moved(from, ground, target, rule.direction);
    let step = (to - from).abs();
    if step == 0.0 {
        return line;
    }
    let edge = match rim == line {
        true => own,
        false => oklab_of_light(rim),
    };
    let share = smoothstep(0.0, target * HUE_AT, step);
    at_place(to, to > from, [own, edge], share, rule)
}

/// The published method for colours in linear light of 0..1, as passes compute it.
pub(super) fn published_light(
    line: [f32; 3],
    rim: [f32; 3],
    behind: [f32; 3],
    rule: &Rule,
) -> [f32; 3] {
    if rule.method == Rule::OFF {
        return line;
    }
    let [line, rim, behind] = [line, rim, behind].map(|light| light.map(srgb_from_linear));
    published::color(line, rim, behind, rule).map(linear_from_srgb)
}

/// The colour that a line starts from: its own, or a share of its rim's.
pub(super) fn started(line: impl FnOnce() -> [f32; 3], rim: [f32; 3], rule: &Rule) -> [f32; 3] {
    if rule.rim_factor > 0.0 {
        return rim.map(|channel| channel * rule.rim_factor);
    }
    line()
}

/// Place of a colour of known lightness on the scale of the rule's measure, 0 black to 1 white.
fn place_of(light: [f32; 3], lightness: f32, rule: &Rule) -> f32 {
    if rule.measure == Rule::WCAG {
        return math::ln(dot(LUMA, light) * 20.0 + 1.0) / math::ln(WCAG_LARGEST);
    }
    lightness
}

/// Place of a colour on that scale, from its linear light alone.
pub(super) fn place_of_light(light: [f32; 3], rule: &Rule) -> f32 {
    place_of(light, oklab_of_light(light)[0], rule)
}

/// The luminance at a place on the scale of WCAG contrast.
fn luminance_at(place: f32) -> f32 {
    (math::exp(place * math::ln(WCAG_LARGEST)) - 1.0) / 20.0
}

/// The rule's target contrast as a distance on the scale of its measure.
fn target_of(rule: &Rule) -> f32 {
    if rule.measure == Rule::WCAG {
        return math::ln(rule.goal.clamp(1.0, WCAG_LARGEST)) / math::ln(WCAG_LARGEST);
    }
    rule.goal.clamp(0.0, 1.0)
}

/// The place to which a line at `line` moves before a ground, both on a scale of 0 to 1.
///
/// There are two candidates, a darker and a brighter one, each no farther from the line than the target needs. If the
/// ground does not say which to take, the one that falls shorter of the target loses; if both fall about equally short,
/// the longer step loses; between, they are blended.
fn moved(line: f32, ground: &Ground, target: f32, direction: u32) -> f32 {
    let both = Candidates::of(line, [ground.low, ground.high], target, direction);
    let share = ground.brighter.unwrap_or_else(|| {
        let turn = TURN.min(0.5 * target);
        let bias = match direction {
            Rule::BRIGHTER => -turn,
            Rule::DARKER => turn,
            _ => turn * (both.longer(line) / EVEN_STEP.min(target).max(1e-6)).clamp(-1.0, 1.0),
        };
        let [lack_darker, lack_brighter] = both.lacks;
        smoothstep(-turn, turn, lack_darker - lack_brighter + bias)
    });
    mix(both.darker, both.brighter, share)
}

/// Preferred direction of a line at `line` before grounds from `grounds[0]` to `grounds[1]`: -1 darker to 1 brighter.
///
/// It is the difference in cost of both candidates: how far the line moves and, with far more weight, how much it falls
/// short of the target.
pub(super) fn preference(line: f32, grounds: [f32; 2], rule: &Rule) -> f32 {
    let both = Candidates::of(line, grounds, target_of(rule), rule.direction);
    let [lack_darker, lack_brighter] = both.lacks;
    let forced = match rule.direction {
        Rule::BRIGHTER => -FORCED,
        Rule::DARKER => FORCED,
        _ => 0.0,
    };
    let cost = both.longer(line) + LACK_WORTH * (lack_darker - lack_brighter) + forced;
    cost.clamp(-1.0, 1.0)
}

/// The two places that a line may move to.
struct Candidates {
    darker: f32,
    brighter: f32,
    /// How much the darker and the brighter candidate fall short of the target.
    lacks: [f32; 2],
}

impl Candidates {
    fn of(line: f32, [low, high]: [f32; 2], target: f32, direction: u32) -> Self {
        let mut darker = line.min(low - target).max(0.0);
        let mut brighter = line.max(high + target).min(1.0);
        // If a direction is forced, the other candidate only keeps to its side of the ground.
        if direction == Rule::BRIGHTER {
            darker = line.min(low);
        }
        if direction == Rule::DARKER {
            brighter = line.max(high);
        }
        let lacks = [
            (target - (low - darker)).max(0.0),
            (target - (brighter - high)).max(0.0),
        ];
        Self {
            darker,
            brighter,
            lacks,
        }
    }

    /// How much longer the step to the darker candidate is than that to the brighter one.
    fn longer(&self, line: f32) -> f32 {
        (line - self.darker) - (self.brighter - line)
    }
}

/// The colour of a given lightness with a chroma between those of line and rim, as far as sRGB has it.
///
/// Continuous. Chroma is first fitted into a gamut without an overhang. From there the colour moves straight in linear
/// light, where sRGB is convex, as far as sRGB reaches. Only beside blue does this turn the hue, by up to 1.2 degrees.
fn at_lightness(lightness: f32, own: [f32; 3], edge: [f32; 3], share: f32) -> [f32; 3] {
    // A shade of the rim's paint: chroma grows and falls with lightness.
    let paler = ((lightness + 0.1) / (edge[0] + 0.1)).clamp(0.5, 2.0);
    let a = mix(own[1], edge[1] * paler, share);
    let b = mix(own[2], edge[2] * paler, share);
    let room = GAMUT_ROOM * lightness * lightness * lightness;
    let at = |scale: f32| light_of_oklab([lightness, a * scale, b * scale]);
    let whole = at(1.0);
    if is_in_gamut(whole, room) {
        return whole.map(|light| light.clamp(0.0, 1.0));
    }
    let (mut fits, mut spills) = (0.0, 1.0);
    for _ in 0..FIT_ROUNDS {
        let middle = 0.5 * (fits + spills);
        let light = at(middle);
        if is_in_gamut(light, room) && light[0] >= BLUE_TIP * light[2] {
            fits = middle;
        } else {
            spills = middle;
        }
    }
    let (inner, outer) = (at(fits), at((fits * TIP_REACH).min(1.0)));
    let share = share_in_gamut(inner, outer, room);
    [0, 1, 2].map(|i| mix(inner[i], outer[i], share).clamp(0.0, 1.0))
}

/// [`at_lightness`] for a place on the scale of the rule's measure: for WCAG, the lightness at which the fitted colour
/// has the luminance of that place.
///
/// The search ends between two colours; the one farther in the line's direction (`brighter` or not) is taken, so that
/// contrast does not fall short.
fn at_place(
    place: f32,
    brighter: bool,
    [own, edge]: [[f32; 3]; 2],
    share: f32,
    rule: &Rule,
) -> [f32; 3] {
    // Take the place as the lightness, on the scale of OKLab.
    if rule.measure != Rule::WCAG {
        return at_lightness(place, own, edge, share);
    }

    // Search for the lightness whose fitted colour has the luminance of the place.
    let luminance = luminance_at(place);
    let (mut low, mut high) = (0.0, 1.0);
    let (mut dark, mut bright) = ([0.0; 3], [1.0; 3]);
    for _ in 0..=FIT_ROUNDS {
        let lightness = 0.5 * (low + high);
        let light = at_lightness(lightness, own, edge, share);
        if dot(LUMA, light) < luminance {
            (low, dark) = (lightness, light);
        } else {
            (high, bright) = (lightness, light);
        }
    }
    if brighter { bright } else { dark }
}

fn is_in_gamut(light: [f32; 3], room: f32) -> bool {
    let inside = |channel: f32| channel >= -room && channel <= 1.0 + room;
    inside(light[0]) && inside(light[1]) && inside(light[2])
}

/// How much of the straight way from a colour in the gamut to another one lies in the gamut.
fn share_in_gamut(from: [f32; 3], to: [f32; 3], room: f32) -> f32 {
    let mut share = 1.0f32;
    for (from, to) in from.into_iter().zip(to) {
        let border = to.max(-room).min(1.0 + room);
        if border != to {
            share = share.min((border - from) / (to - from));
        }
    }
    share.max(0.0)
}

#[cfg(test)]
mod tests;
