//! The light of lines before the colours that a frame found on both of their sides: the last step of every line layer.

use super::adapt::{Ground, adapted_light, published_light};
use super::rule::{Rule, Rules};
use npr_core::math::mix_bits;

/// Adapts lines to what lies behind them, pixel by pixel, and keeps recent answers: neighbouring pixels mostly ask for
/// the same.
#[derive(Debug, Clone)]
pub struct ContrastCache {
    answers: [Option<Answer>; ANSWERS],
}

/// How many answers are kept; a power of two.
const ANSWERS: usize = 64;

/// The adapted light of a line for a front texel and a back texel.
#[derive(Debug, Clone, Copy)]
struct Answer {
    line: [f32; 3],
    front: u32,
    back: u32,
    adapted: [f32; 3],
}

impl Default for ContrastCache {
    fn default() -> Self {
        Self {
            answers: [None; ANSWERS],
        }
    }
}

/// Mask of the colour in a texel, without its highest byte.
const COLOR: u32 = 0x00ff_ffff;

impl ContrastCache {
    /// The light of a line at a pixel where [`spread_rims`](super::spread_rims) wrote `front` and `back`.
    ///
    /// `light_of` turns sRGB bytes into linear light and the highest byte into 0..1.
    pub fn light(
        &mut self,
        line: [f32; 3],
        [front, back]: [u32; 2],
        rules: &Rules,
        light_of: impl Fn(u32) -> [f32; 4],
    ) -> [f32; 3] {
        if front >> 24 == 0 {
            return line;
        }
        let [r, g, b, weight] = light_of(front);
        let rule = &rules.rules[(back >> 24) as usize];
        // If a line starts from the rim's colour, its own plays no part.
        let forgets = rule.method == Rule::BY_CONTRAST && rule.rim_factor > 0.0;
        let slot = &mut self.answers[slot_of(front & COLOR, back)];
        let is_known = |answer: &&Answer| {
            (forgets || answer.line == line) && answer.front == front & COLOR && answer.back == back
        };
        let adapted = match slot.as_ref().filter(is_known) {
            Some(answer) => answer.adapted,
            None => {
                let adapted = adapted(line, [r, g, b], back, rule, light_of);
                *slot = Some(Answer {
                    line,
                    front: front & COLOR,
                    back,
                    adapted,
                });
                adapted
            }
        };
        std::array::from_fn(|i| line[i] + (adapted[i] - line[i]) * weight)
    }
}

/// Index of the answer for two texels.
fn slot_of(front: u32, back: u32) -> usize {
    mix_bits(front ^ back.rotate_left(16)) as usize % ANSWERS
}

fn adapted(
    line: [f32; 3],
    rim: [f32; 3],
    back: u32,
    rule: &Rule,
    light_of: impl Fn(u32) -> [f32; 4],
) -> [f32; 3] {
    if rule.method == Rule::BY_CONTRAST {
        return adapted_light(line, rim, &Ground::unpacked(back), rule);
    }
    let [r, g, b, _] = light_of(back);
    published_light(line, rim, [r, g, b], rule)
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::color::{linear_rgba, unpack_rgba8};
    use proptest::prelude::*;

    fn light_of(texel: u32) -> [f32; 4] {
        linear_rgba(unpack_rgba8(texel))
    }

    proptest! {
        /// Pixels that ask the same again and again, or nearly the same, get what each would get alone.
        #[test]
        fn what_was_asked_before_changes_nothing(
            picks in prop::collection::vec((0usize..2, 0usize..4, 0usize..5), 1..40),
        ) {
            let mut rules = Rules::default();
            rules.rules[1] = Rule::CONTRAST;
            rules.rules[3] = Rule { rim_factor: 0.7, ..Rule::CONTRAST };
            rules.rules[2] = Rule {
                thresholds: [1.0, -1.0, -1.0, -1.0],
                method: Rule::BY_LIKENESS,
                intensity: 2.0,
                ..Rule::CONTRAST
            };
            let lines = [[0.0; 3], [0.5, 0.1, 0.1]];
            let fronts = [0xff10_2030, 0x8010_2030, 0xff10_2031, 0];
            let backs = [0x0130_3030, 0x0230_3030, 0x0131_3030, 0x0330_3030, 0];
            let mut contrast_cache = ContrastCache::default();
            for (line, front, back) in picks {
                let texels = [fronts[front], backs[back]];
                let alone = ContrastCache::default().light(lines[line], texels, &rules, light_of);
                prop_assert_eq!(contrast_cache.light(lines[line], texels, &rules, light_of), alone);
            }
        }
    }
}
