//! Backgrounds that characters are drawn on, painted here so that everybody has the same.

use npr_core::color::srgb_from_linear;
use npr_render::Picture;

/// What lies behind a character.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenery {
    /// One colour, nearly black: a room at night.
    Dark,
    /// One colour, nearly white: snow.
    Light,
    /// Dark on the left, light on the right.
    TwoColors,
    /// A wall of bricks of many tones.
    Textured,
    /// An evening as a lens sees it: sky, hills, blurred lights, grain.
    Photograph,
}

impl Scenery {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Dark,
        Self::Light,
        Self::TwoColors,
        Self::Textured,
        Self::Photograph,
    ];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
            Self::TwoColors => "two colours",
            Self::Textured => "bricks",
            Self::Photograph => "evening",
        }
    }

    /// Its picture, `size` pixels. O(pixels).
    pub fn picture(self, size: [u32; 2]) -> Picture {
        let mut rgba = Vec::with_capacity(size[0] as usize * size[1] as usize * 4);
        for y in 0..size[1] {
            for x in 0..size[0] {
                let [u, v] = [x, y].map(|at| (at as f32 + 0.5) / size[1] as f32);
                let light = self.light_at(u, v, size[0] as f32 / size[1] as f32);
                let grain = match self {
                    Self::Photograph => 0.03 * (hash(x, y) - 0.5),
                    _ => 0.0,
                };
                rgba.extend(
                    light.map(|v| {
                        ((srgb_from_linear(v) + grain).clamp(0.0, 1.0) * 255.0 + 0.5) as u8
                    }),
                );
                rgba.push(255);
            }
        }
        Picture { size, rgba }
    }

    /// Linear light at a place, in heights of the picture from its top left corner; the picture is `wide` heights wide.
    fn light_at(self, u: f32, v: f32, wide: f32) -> [f32; 3] {
        match self {
            Self::Dark => [0.008, 0.009, 0.014],
            Self::Light => [0.85, 0.87, 0.9],
            Self::TwoColors if u < 0.5 * wide => [0.012, 0.016, 0.05],
            Self::TwoColors => [0.75, 0.6, 0.4],
            Self::Textured => bricks(u, v),
            Self::Photograph => evening(u, v),
        }
    }
}

/// A wall: 12 rows of bricks a height, each of its own tone, mortar between them.
fn bricks(u: f32, v: f32) -> [f32; 3] {
    let row = (v * 12.0).floor();
    let along = u * 5.0
        + if (row as u32).is_multiple_of(2) {
            0.0
        } else {
            0.5
        };
    let [inner_u, inner_v] = [along.fract(), (v * 12.0).fract()];
    if inner_u < 0.05 || inner_v < 0.12 {
        return [0.3, 0.28, 0.25];
    }
    let tone = 0.15 + 0.85 * hash(along as u32, row as u32 + 77);
    let rough = 0.8 + 0.4 * soft(u * 90.0, v * 90.0);
    [0.28, 0.07, 0.04].map(|share| share * tone * rough)
}

/// An evening: a warm horizon under a dark sky, two rows of hills, lamps out of focus.
fn evening(u: f32, v: f32) -> [f32; 3] {
    // Paint the sky.
    let up = (1.0 - v / 0.62).clamp(0.0, 1.0);
    let (low, high) = ([0.8, 0.36, 0.16], [0.03, 0.06, 0.16]);
    let mut light: [f32; 3] = std::array::from_fn(|i| low[i] + (high[i] - low[i]) * up.sqrt());

    // Put two rows of hills before it.
    let hills = [
        (0.5, 3.0, [0.09, 0.07, 0.09]),
        (0.62, 5.0, [0.02, 0.025, 0.02]),
    ];
    for (top, steps, color) in hills {
        let edge = top + 0.16 * (soft(u * steps, top * 40.0) - 0.5);
        let within = ((v - edge) * 40.0).clamp(0.0, 1.0);
        light = std::array::from_fn(|i| light[i] + (color[i] - light[i]) * within);
    }

    // Light lamps out of focus.
    for lamp in 0..14 {
        let [x, y] = [hash(lamp, 1) * 1.8, 0.55 + 0.4 * hash(lamp, 2)];
        let radius = 0.02 + 0.03 * hash(lamp, 3);
        let away = ((u - x) * (u - x) + (v - y) * (v - y)).sqrt();
        let share = 0.6 * ((radius - away) * 120.0).clamp(0.0, 1.0);
        let color = [0.9, 0.4 + 0.4 * hash(lamp, 4), 0.15];
        light = std::array::from_fn(|i| light[i] + (color[i] - light[i]) * share);
    }
    light
}

/// Smooth noise 0..1: a random number at every whole place, blended between.
fn soft(x: f32, y: f32) -> f32 {
    let blend = |t: f32| t * t * (3.0 - 2.0 * t);
    let [i, j] = [x.floor(), y.floor()];
    let [s, t] = [blend(x - i), blend(y - j)];
    let at = |dx: u32, dy: u32| hash(i as u32 + dx, j as u32 + dy);
    let [top, bottom] = [0, 1].map(|dy| at(0, dy) + (at(1, dy) - at(0, dy)) * s);
    top + (bottom - top) * t
}

/// A number 0..1 that two whole numbers decide.
fn hash(x: u32, y: u32) -> f32 {
    let mut bits = x.wrapping_mul(0x9e37_79b9) ^ y.wrapping_mul(0x85eb_ca6b).rotate_left(13);
    bits = (bits ^ bits >> 15).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ bits >> 12).wrapping_mul(0x297a_2d39);
    (bits ^ bits >> 15) as f32 / u32::MAX as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scenery_fills_its_picture_and_is_the_same_again() {
        for scenery in Scenery::ALL {
            let picture = scenery.picture([48, 32]);
            assert_eq!(picture.rgba.len(), 48 * 32 * 4);
            assert_eq!(picture, scenery.picture([48, 32]));
        }
    }

    #[test]
    fn two_colors_meet_in_the_middle() {
        let picture = Scenery::TwoColors.picture([10, 2]);
        let red: Vec<u8> = picture.rgba.chunks_exact(4).map(|p| p[0]).collect();
        assert!(red[4] < 40 && red[5] > 200, "{red:?}");
    }
}
