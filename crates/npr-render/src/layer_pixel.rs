//! What a pixel of a frame holds beside its colour.

use npr_core::color::premultiplied_light;

/// What a pixel of a frame holds beside its colour, for compositing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerPixel {
    /// The lines alone, linear light premultiplied with alpha: laid over the frame without lines, they give the frame.
    pub line: [f32; 4],
    /// Distance of the surface from the eye along the view axis, in scene units; [`LayerPixel::FAR`] without one.
    pub depth: f32,
    /// Unit normal of the surface in the world, towards the side that is seen; 0 without one.
    pub normal: [f32; 3],
    /// Number of the surface's object, counted from 1, see [`Model::object_names`](crate::Model::object_names); 0
    /// without one.
    pub object: u32,
    /// Number of the stroke that shows, counted from 1 in every frame; 0 where none does.
    pub stroke: u32,
    /// Distance of that stroke's line from the eye along the view axis, in scene units, where the pixel lies nearest to
    /// it; [`LayerPixel::FAR`] where no stroke shows.
    pub stroke_depth: f32,
    /// Where on that stroke: pixels along it from its start, and across, -1 at its left edge and 1 at its right.
    pub uv: [f32; 2],
}

impl LayerPixel {
    /// The depth of a pixel without a surface, or without a stroke.
    pub const FAR: f32 = 1e10;

    /// A pixel without surface and lines.
    pub(crate) const EMPTY: Self = Self {
        line: [0.0; 4],
        depth: Self::FAR,
        normal: [0.0; 3],
        object: 0,
        stroke: 0,
        stroke_depth: Self::FAR,
        uv: [0.0; 2],
    };
}

/// The line that turns the pixel `bare` into `shown`, both sRGB bytes with straight alpha: linear light, premultiplied
/// with alpha.
///
/// Alpha is `coverage`, the share of the pixel that is known to be covered, or more. Frames blend strokes by sRGB
/// values, so the edge of a dark line takes more light away than its coverage says. Alpha grows until the rest can be
/// light, so that laying the line over `bare` in linear light gives the colour of `shown` exactly. Its alpha too, where
/// `bare` is opaque or empty; at edges of surfaces before nothing alpha may come out greater.
pub(crate) fn line_between(shown: [u8; 4], bare: [u8; 4], coverage: f32) -> [f32; 4] {
    let [shown, bare] = [shown, bare].map(premultiplied_light);
    let least = |(shown, bare): (&f32, &f32)| match shown < bare {
        true => 1.0 - shown / bare,
        false if *bare < 1.0 => (shown - bare) / (1.0 - bare),
        false => 0.0,
    };
    let alpha = shown.iter().zip(&bare).map(least).fold(coverage, f32::max);
    let light = |i: usize| (shown[i] - bare[i] * (1.0 - alpha)).max(0.0);
    [light(0), light(1), light(2), alpha]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn over(line: [f32; 4], below: [u8; 4]) -> [f32; 4] {
        let below = premultiplied_light(below);
        std::array::from_fn(|i| line[i] + below[i] * (1.0 - line[3]))
    }

    proptest! {
        /// Whatever a frame shows in the place of an opaque pixel, the line gives it, with colours that can be shown.
        #[test]
        fn a_line_over_the_picture_gives_the_frame(
            shown: [u8; 3], bare: [u8; 3], coverage in 0f32..1.0,
        ) {
            let [shown, bare] = [shown, bare].map(|[r, g, b]| [r, g, b, 255]);
            let line = line_between(shown, bare, coverage);
            prop_assert!((coverage..=1.0).contains(&line[3]), "{:?}", line);
            prop_assert!(line[..3].iter().all(|light| (0.0..=line[3] + 1e-6).contains(light)), "{:?}", line);
            let (got, want) = (over(line, bare), premultiplied_light(shown));
            prop_assert!((0..4).all(|i| (got[i] - want[i]).abs() < 1e-6), "{:?} {:?}", got, want);
        }
    }

    #[test]
    fn lines_keep_their_colour_and_coverage() {
        let (ink, paper, nothing) = ([10, 20, 200, 255], [255; 4], [0; 4]);
        assert_eq!(line_between(ink, paper, 1.0), premultiplied_light(ink));
        assert_eq!(line_between(ink, nothing, 0.0), premultiplied_light(ink));
        assert_eq!(line_between(paper, paper, 0.0), [0.0; 4]);
        // Black over black is a line too.
        assert_eq!(
            line_between([0, 0, 0, 255], [0, 0, 0, 255], 0.5),
            [0.0, 0.0, 0.0, 0.5]
        );
        // A half in sRGB values is a fifth of the light.
        let [.., alpha] = line_between([128, 128, 128, 255], paper, 0.5);
        assert!((alpha - 0.784).abs() < 1e-3, "{alpha}");
    }
}
