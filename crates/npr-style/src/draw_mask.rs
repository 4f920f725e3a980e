//! The mask itself as lines, as image filters draw them: the twin of `line.draw_mask` [Saito & Takahashi 1990].

use npr_core::color::pack_rgba8;
use npr_core::geometry::{NONE, Part};
use npr_core::line_color::{LineTints, kind_of_mask};
use npr_core::outline::{MASK_KINDS, MASK_OWNER};
use npr_core::window::Window;

use crate::compose::Compose;

/// The inputs from which the mask is drawn.
#[derive(Debug, Clone, Copy)]
pub struct MaskInk<'a> {
    /// The pixel grid of the output.
    pub window: &'a Window,
    /// Settings, with the colour of lines for whose part nothing is decided.
    pub compose: &'a Compose,
    /// Parts.
    pub parts: &'a [Part],
    /// The mask.
    pub mask: &'a [u32],
    /// The decided colours of lines, on the mask's grid.
    pub tints: LineTints<'a>,
}

/// Draws the mask: one texel of a single colour for every pixel that is set. Texels are sRGB bytes with straight alpha.
/// O(pixels).
pub fn draw_mask(with: &MaskInk<'_>, overlay: &mut [u32]) {
    let (window, mask_window) = (with.window, with.tints.mask_window);
    let plain = pack_rgba8(with.compose.line_color);
    let width = window.size[0] as usize;
    for (element, texel) in overlay.iter_mut().enumerate() {
        let frame_px = window.frame_at((element % width) as u32, (element / width) as u32);
        let at = mask_window.pixel_at(frame_px);
        let found = with.mask[(at[1] * mask_window.size[0] + at[0]) as usize];
        *texel = if found & MASK_KINDS == 0 {
            0
        } else {
            with.color_at(at, found).unwrap_or(plain)
        };
    }
}

impl MaskInk<'_> {
    /// The colour that its part has for a pixel of the mask; `None` if nothing is decided for that part.
    fn color_at(&self, at: [u32; 2], found: u32) -> Option<u32> {
        if self.tints.is_empty() {
            return None;
        }
        let part = self.owner_at(at);
        let px = self.tints.mask_window.frame_at(at[0], at[1]);
        (part != NONE).then(|| {
            let kind = kind_of_mask(found);
            pack_rgba8(self.tints.color_at(self.parts, part, kind, px))
        })
    }

    /// The part that the line at a mask pixel belongs to: its own, or that of a pixel beside it.
    fn owner_at(&self, at: [u32; 2]) -> u32 {
        let size = self.tints.mask_window.size;
        let part_of = |element: usize| self.tints.tints[element].part;
        let own = (at[1] * size[0] + at[0]) as usize;
        if self.mask[own] & MASK_OWNER != 0 {
            return part_of(own);
        }
        for y in at[1].saturating_sub(1)..=(at[1] + 1).min(size[1] - 1) {
            for x in at[0].saturating_sub(1)..=(at[0] + 1).min(size[0] - 1) {
                let beside = (y * size[0] + x) as usize;
                if self.mask[beside] & MASK_OWNER != 0 && part_of(beside) != NONE {
                    return part_of(beside);
                }
            }
        }
        part_of(own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_core::line_color::LineTint;
    use npr_core::line_kind::{Kind, KindSet};
    use npr_core::outline::Outline;

    /// A mask of two pixels, of which the left owns the line, drawn on its own grid.
    fn drawn(parts: &[Part], tints: &[LineTint]) -> [u32; 2] {
        let window = Window::over([2.0, 1.0], [0.0; 2], [2.0, 1.0], [2, 1]);
        let compose = Compose {
            line_color: [0.0, 0.0, 0.0, 1.0],
            ..Compose::default()
        };
        let mask = [Outline::NORMAL | MASK_OWNER, Outline::NORMAL];
        let with = MaskInk {
            window: &window,
            compose: &compose,
            parts,
            mask: &mask,
            tints: LineTints {
                mask_window: &window,
                tints,
            },
        };
        let mut overlay = [7; 2];
        draw_mask(&with, &mut overlay);
        overlay
    }

    #[test]
    fn lines_have_the_color_of_their_owner_and_kind() {
        let part = |crease: u32| Part {
            line_flags: KindSet::CREASE,
            line_kinds: Kind::COLORED.map(|kind| if kind == Kind::Crease { crease } else { 0 }),
            ..Part::default()
        };
        let parts = [part(0xff00_00ff), part(0xff00_ff00)];
        let tint = |part: u32| LineTint {
            part,
            ..LineTint::NONE
        };
        assert_eq!(drawn(&parts, &[tint(0), tint(1)]), [0xff00_00ff; 2]);
        assert_eq!(drawn(&parts, &[tint(NONE), tint(1)])[0], 0xff00_0000);
        assert_eq!(drawn(&parts, &[]), [0xff00_0000; 2], "nothing is decided");
    }
}
