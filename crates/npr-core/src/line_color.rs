//! The colour of a line at a place, put together from what was decided there: the twin of `lib/line_tint`.
//!
//! `npr_style::line_color` decides, once for every pixel of the mask; whoever draws a line looks up what was decided
//! under the line's reference coordinate with [`LineTints::at`] and gets its colour from [`line_color`].

use crate::color::{linear_from_srgb, pack_rgba8, srgb_from_linear, unpack_rgba8};
use crate::geometry::{NONE, Part};
use crate::gpu_layout;
use crate::line_kind::{Kind, KindSet};
use crate::outline::Outline;
use crate::window::Window;
use bytemuck::{Pod, Zeroable};

/// The kind that an edge of several kinds is coloured as: the first; an edge of no kind is coloured as a contour.
#[inline]
pub fn kind_of_edge(kinds: u32) -> Kind {
    Kind::first_of(kinds & KindSet::EDGES).unwrap_or(Kind::Contour)
}

/// The kind that a pixel of the mask is coloured as, by what found it.
#[inline]
pub fn kind_of_mask(found: u32) -> Kind {
    if found & Outline::PIECE != 0 {
        Kind::Intersection
    } else if found & (Outline::DEPTH | Outline::OBJECT_ID) != 0 {
        Kind::Contour
    } else if found & Outline::MATERIAL_ID != 0 {
        Kind::Material
    } else {
        Kind::Crease
    }
}

/// The kind of a line between two pixels of a picture of surfaces, by what found it.
#[inline]
pub fn kind_of_border(found: u32) -> Kind {
    if found & Outline::DEPTH != 0 {
        Kind::Contour
    } else if found & (Outline::OBJECT_ID | Outline::PIECE) != 0 {
        Kind::Intersection
    } else {
        kind_of_mask(found)
    }
}

/// What is decided about lines at a pixel of the mask.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
pub struct LineTint {
    /// The colour that the surface gives its lines, sRGB bytes; alpha is what light leaves of their opacity.
    pub own: u32,
    /// What light, depth and the picture's tint lay over that, sRGB bytes with straight alpha.
    pub tint_layer: u32,
    /// Index of the part it is decided for, or [`NONE`] where nothing is.
    pub part: u32,
}
gpu_layout!(LineTint {
    own,
    tint_layer,
    part
});

impl LineTint {
    /// Nothing is decided.
    pub const NONE: Self = Self {
        own: 0,
        tint_layer: 0,
        part: NONE,
    };
}

/// A [`LineTint`] with values 0..1, sRGB encoded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tint {
    /// The surface's colour for its lines, and what is left of their opacity.
    pub own: [f32; 4],
    /// What lies over it, straight alpha.
    pub tint_layer: [f32; 4],
}

/// What is decided over a mask.
#[derive(Debug, Clone, Copy)]
pub struct LineTints<'a> {
    /// The pixel grid of the mask.
    pub mask_window: &'a Window,
    /// A tint for every pixel of the mask; shorter where no style asks for any.
    pub tints: &'a [LineTint],
}

/// Sums over the pixels around a place.
#[derive(Debug, Clone, Copy, Default)]
struct Sum {
    weight: f32,
    own: [f32; 4],
    tint_layer: [f32; 3],
    tint_layer_weight: f32,
}

impl Sum {
    fn add(&mut self, tint: &LineTint, weight: f32) {
        let own = unpack_rgba8(tint.own);
        self.weight += weight;
        self.own = std::array::from_fn(|i| self.own[i] + own[i] * weight);
        // Most lines have no tint layer.
        if tint.tint_layer >> 24 == 0 {
            return;
        }
        let tint_layer = unpack_rgba8(tint.tint_layer);
        self.tint_layer =
            std::array::from_fn(|i| self.tint_layer[i] + tint_layer[i] * (tint_layer[3] * weight));
        self.tint_layer_weight += tint_layer[3] * weight;
    }

    fn mean(&self) -> Option<Tint> {
        if self.weight <= 0.0 {
            return None;
        }
        let [r, g, b] = self
            .tint_layer
            .map(|sum| sum / self.tint_layer_weight.max(1e-6));
        Some(Tint {
            own: self.own.map(|sum| sum / self.weight),
            tint_layer: [r, g, b, self.tint_layer_weight / self.weight],
        })
    }
}

impl LineTints<'_> {
    /// Whether anything may be decided.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.tints.len() < self.mask_window.size[0] as usize * self.mask_window.size[1] as usize
    }

    /// What is decided for a part at a point of the frame; `None` where nothing is.
    ///
    /// The mean over the 3x3 mask pixels around the point, weighted by a tent that ends 1.5 pixels away, so it changes
    /// smoothly along a line. Pixels of the part count alone, unless there are none. 9 look-ups.
    pub fn at(&self, px: [f32; 2], part: u32) -> Option<Tint> {
        if self.is_empty() {
            return None;
        }
        self.mean_around(px, |of| of == part)
            .or_else(|| self.mean_around(px, |of| of != NONE))
    }

    /// The mean around a point over the pixels of some parts.
    fn mean_around(&self, px: [f32; 2], is_wanted: impl Fn(u32) -> bool) -> Option<Tint> {
        let window = self.mask_window;
        let center = window.pixel_at(px);
        let mut sum = Sum::default();
        for y in center[1].saturating_sub(1)..=(center[1] + 1).min(window.size[1] - 1) {
            for x in center[0].saturating_sub(1)..=(center[0] + 1).min(window.size[0] - 1) {
                let tint = &self.tints[(y * window.size[0] + x) as usize];
                if !is_wanted(tint.part) {
                    continue;
                }
                let middle = window.frame_at(x, y);
                let [dx, dy]: [f32; 2] =
                    std::array::from_fn(|i| ((px[i] - middle[i]) / window.frame_step[i]).abs());
                sum.add(tint, (1.5 - dx).max(0.0) * (1.5 - dy).max(0.0));
            }
        }
        sum.mean()
    }

    /// Colour of a part's lines of a kind at a point of the frame, sRGB with straight alpha.
    #[inline]
    pub fn color_at(&self, parts: &[Part], part: u32, kind: Kind, px: [f32; 2]) -> [f32; 4] {
        let of = &parts[part as usize];
        let placed = of.line_flags & Part::LINE_PLACED != 0;
        let tint = if placed { self.at(px, part) } else { None };
        line_color(of, kind, tint)
    }
}

/// Colour of a part's lines of a kind, sRGB with straight alpha, where `tint` is decided.
///
/// A kind's own colour goes before that of the surface, and this before the part's. Without a tint only the first and
/// the last count. The tint layer is mixed in linear light; where there is none the colour stays as it is, to the bit.
#[inline]
pub fn line_color(part: &Part, kind: Kind, tint: Option<Tint>) -> [f32; 4] {
    let mut color = part.line_color;
    if part.line_flags == 0 {
        return color;
    }
    let has_own = part.line_flags & kind.bit() & Part::LINE_KINDS != 0;
    if has_own {
        color = unpack_rgba8(part.line_kinds[kind as usize]);
    }
    let Some(Tint { own, tint_layer }) = tint else {
        return color;
    };
    if !has_own && part.line_flags & Part::LINE_SOURCES != 0 {
        color = [own[0], own[1], own[2], color[3]];
    }
    let [r, g, b] = layered([color[0], color[1], color[2]], tint_layer);
    [r, g, b, color[3] * own[3]]
}

/// A colour under a tint layer, both sRGB encoded; mixed in linear light.
#[inline]
pub fn layered(color: [f32; 3], tint_layer: [f32; 4]) -> [f32; 3] {
    if tint_layer[3] <= 0.0 {
        return color;
    }
    std::array::from_fn(|i| {
        let (under, over) = (linear_from_srgb(color[i]), linear_from_srgb(tint_layer[i]));
        srgb_from_linear(under + (over - under) * tint_layer[3])
    })
}

impl Tint {
    /// As bytes, for a part.
    pub fn packed(&self, part: u32) -> LineTint {
        LineTint {
            own: pack_rgba8(self.own),
            tint_layer: pack_rgba8(self.tint_layer),
            part,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edge_flags::EdgeFlags;
    use crate::line_kind::COLORED_KINDS;
    use proptest::prelude::*;

    fn window() -> Window {
        Window::over([8.0; 2], [0.0; 2], [8.0; 2], [8, 8])
    }

    fn color() -> impl Strategy<Value = [f32; 4]> {
        prop::array::uniform4(0u8..=255).prop_map(|bytes| bytes.map(|b| f32::from(b) / 255.0))
    }

    fn kind() -> impl Strategy<Value = Kind> {
        prop::sample::select(&Kind::COLORED[..])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn a_part_that_asks_for_nothing_keeps_its_color(own in color(), tint in (color(), color()), kind in kind()) {
            let part = Part { line_color: own, ..Part::default() };
            let tint = Tint { own: tint.0, tint_layer: tint.1 };
            prop_assert_eq!(line_color(&part, kind, Some(tint)), own);
        }

        #[test]
        fn a_clear_tint_layer_changes_no_bit(
            own in color(), kind_color in color(), flags in 0u32..=KindSet::COLORED, kind in kind(),
        ) {
            let part = Part {
                line_color: own,
                line_kinds: [pack_rgba8(kind_color); COLORED_KINDS],
                line_flags: flags | Part::LINE_DEPTH,
                ..Part::default()
            };
            let tint = Tint { own: [0.3, 0.2, 0.1, 1.0], tint_layer: [0.9, 0.9, 0.9, 0.0] };
            let expected = if flags & kind.bit() != 0 { kind_color } else { own };
            prop_assert_eq!(line_color(&part, kind, Some(tint)), expected);
        }

        /// A mixed colour lies between both, channel by channel.
        #[test]
        fn a_tint_layer_never_overshoots(under in color(), tint_layer in color()) {
            let mixed = layered([under[0], under[1], under[2]], tint_layer);
            for i in 0..3 {
                let (low, high) = (under[i].min(tint_layer[i]), under[i].max(tint_layer[i]));
                prop_assert!((low - 1e-4..=high + 1e-4).contains(&mixed[i]));
            }
        }

        /// A step of a hundredth of a pixel along a line moves what is found there by at most a few hundredths.
        #[test]
        fn what_is_found_changes_smoothly(
            values in prop::collection::vec(0u32..=255, 64), x in 0f32..7.9, y in 0f32..8.0,
        ) {
            let tint = |v: &u32| LineTint { own: 0xff00_0000 | v, tint_layer: 0, part: 0 };
            let tints: Vec<LineTint> = values.iter().map(tint).collect();
            let window = window();
            let on = LineTints { mask_window: &window, tints: &tints };
            let at = |x: f32| on.at([x, y], 0).map_or(-1.0, |tint| tint.own[0]);
            prop_assert!((at(x) - at(x + 0.01)).abs() < 0.03);
        }

        #[test]
        fn the_parts_own_pixels_go_before_others(
            owner in prop::collection::vec(0u32..3, 64), x in -2f32..10.0, y in -2f32..10.0,
        ) {
            let tint = |part: &u32| match part {
                2 => LineTint::NONE,
                part => LineTint { own: 0xff00_0000 | (part * 255), tint_layer: 0, part: *part },
            };
            let tints: Vec<LineTint> = owner.iter().map(tint).collect();
            let window = window();
            let on = LineTints { mask_window: &window, tints: &tints };
            let center = window.pixel_at([x, y]);
            let near = |part: u32| (0..64u32).any(|i| {
                let far = |axis: usize, v: u32| {
                    let middle = v as f32 + 0.5;
                    v.abs_diff(center[axis]) > 1 || ([x, y][axis] - middle).abs() >= 1.5
                };
                owner[i as usize] == part && !far(0, i % 8) && !far(1, i / 8)
            });
            match on.at([x, y], 1) {
                None => prop_assert!(!near(0) && !near(1)),
                Some(found) if near(1) => prop_assert_eq!(found.own[0], 1.0),
                Some(found) => prop_assert_eq!(found.own[0], 0.0),
            }
        }
    }

    #[test]
    fn kinds_come_from_edges_and_masks() {
        assert_eq!(
            kind_of_edge(KindSet::CREASE | KindSet::MATERIAL),
            Kind::Crease
        );
        assert_eq!(kind_of_edge(EdgeFlags::FACING.0), Kind::Contour);
        assert_eq!(kind_of_edge(0), Kind::Contour);
        assert_eq!(
            kind_of_mask(Outline::PIECE | Outline::DEPTH),
            Kind::Intersection
        );
        assert_eq!(
            kind_of_mask(Outline::NORMAL | Outline::DEPTH),
            Kind::Contour
        );
        assert_eq!(
            kind_of_mask(Outline::NORMAL | Outline::MATERIAL_ID),
            Kind::Material
        );
        assert_eq!(kind_of_mask(Outline::NORMAL), Kind::Crease);
    }

    #[test]
    fn without_tints_nothing_is_decided() {
        let window = window();
        let on = LineTints {
            mask_window: &window,
            tints: &[],
        };
        assert_eq!(on.at([3.0, 3.0], 0), None);
    }
}
