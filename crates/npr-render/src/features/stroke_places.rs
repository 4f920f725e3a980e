//! Which stroke shows at every pixel of a frame, and where on it the pixel lies.

use super::strokes;
use crate::frame_graph::pixel_count;
use crate::layer_pixel::LayerPixel;
use crate::look::StyledModel;
use npr_core::line_kind::Kind;
use npr_core::window::{View, Window};
use npr_drawing::ink::Images;
use npr_vector::brush::Brushes;
use npr_vector::stroke::{Drawing, Stroke, StrokePoint};
use npr_vector::stroke_ink;

/// Pixels beyond the edge of a stroke that it still tints.
const FRINGE_PX: f64 = 1.0;

/// Bytes of a pixel while places are found: its number with its key, its place, and how near that is.
pub(crate) const PIXEL_BYTES: usize =
    2 * size_of::<u32>() + size_of::<StrokePlace>() + size_of::<f64>();

/// What a pixel shows of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StrokePlace {
    /// Its number, counted from 1; 0 where none shows.
    pub number: u32,
    /// View depth of its line there; [`LayerPixel::FAR`] where none shows.
    pub depth: f32,
    /// Pixels along it, and across: -1 at its left edge, 1 at its right.
    pub uv: [f32; 2],
}

/// What the pixels of a frame show of strokes.
#[derive(Debug, Default)]
pub(crate) struct StrokePlaces {
    /// What every pixel shows; empty where there are no strokes.
    pub places: Vec<StrokePlace>,
    /// What each stroke is on the shape, in the order of their numbers.
    pub kinds: Vec<Kind>,
}

/// What every pixel of a frame of `size` shows of strokes.
///
/// Strokes are drawn once more, on the processor, with their numbers in the place of their colours: the same one wins
/// at every pixel, but for rounding on devices. Then each looks for its pixels along itself. O(pixels + ink).
pub(crate) fn stroke_places(
    mut drawings: Vec<Drawing>,
    view: &View,
    (styled, base_px): (&StyledModel, f32),
    size: [u32; 2],
) -> StrokePlaces {
    // Give every stroke its number.
    let strokes = drawings.iter_mut().flat_map(|drawing| &mut drawing.strokes);
    for (number, stroke) in (1u32..).zip(strokes) {
        let [low, middle, high, _] = number.to_le_bytes();
        for point in &mut stroke.points {
            point.color = Some([low, middle, high, 255]);
        }
    }

    // Draw them.
    let window = Window::over(view.frame_px, [0.0; 2], view.frame_px, size);
    let points = strokes::points_of(&drawings, view, (&styled.brushes, base_px));
    let brushes = Brushes {
        all: &styled.brushes.all,
        texels: styled.textures.words(),
    };
    let [mut numbers, mut keys] = [0, 1].map(|_| vec![0; pixel_count(size)]);
    stroke_ink::draw(&window, (&points, brushes), &mut numbers, &mut keys);

    // Look for the place of every pixel on its stroke.
    let place = |number: &u32| StrokePlace {
        number: number & 0x00ff_ffff,
        depth: LayerPixel::FAR,
        uv: [0.0; 2],
    };
    let mut places: Vec<StrokePlace> = numbers.iter().map(place).collect();
    let strokes = drawings.iter().flat_map(|drawing| &drawing.strokes);
    let mut nearest = vec![f64::INFINITY; places.len()];
    for (number, stroke) in (1u32..).zip(strokes) {
        let mut picture = Picture {
            view,
            size,
            places: &mut places,
            nearest: &mut nearest,
        };
        let stamps_px = match styled.brushes.lay_of(stroke, base_px).images {
            Images::Stamps(stamps) => stamps.reach() * widest(stroke),
            Images::Once | Images::ByLength(_) => 0.0,
        };
        picture.find(number, stroke, stamps_px);
    }
    let strokes = drawings.iter().flat_map(|drawing| &drawing.strokes);
    let kinds = strokes.map(|stroke| stroke.kind).collect();
    StrokePlaces { places, kinds }
}

/// The largest width of a stroke, in pixels.
fn widest(stroke: &Stroke) -> f64 {
    let widths = stroke.points.iter().map(|point| point.width);
    widths.fold(0.0, f64::max)
}

/// The pixels whose places are looked for.
struct Picture<'a> {
    view: &'a View,
    size: [u32; 2],
    places: &'a mut [StrokePlace],
    /// Distance of each from the piece that its place is on, in pixels.
    nearest: &'a mut [f64],
}

impl Picture<'_> {
    /// Finds the places of the pixels of one stroke, whose stamps reach so many pixels from it.
    fn find(&mut self, number: u32, stroke: &Stroke, stamps_px: f64) {
        if !stroke.is_visible() {
            return;
        }
        let back = stroke.points.first().filter(|_| stroke.closed);
        let points: Vec<&StrokePoint> = stroke.points.iter().chain(back).collect();
        let mut along = 0.0;
        for pair in points.windows(2) {
            along += self.find_on(number, ([pair[0], pair[1]], along), stamps_px);
        }
    }

    /// Finds those whose nearest piece is this one, `along` pixels from the start of the stroke; gives its length.
    fn find_on(
        &mut self,
        number: u32,
        ([from, to], along): ([&StrokePoint; 2], f64),
        stamps_px: f64,
    ) -> f64 {
        // Bound the piece.
        let way = [0, 1].map(|k| to.position[k] - from.position[k]);
        let length = way[0].hypot(way[1]);
        let reach = (0.5 * from.width.max(to.width)).max(stamps_px) + FRINGE_PX;
        if !(length > 0.0 && length.is_finite() && reach.is_finite()) {
            return 0.0;
        }
        let bound = |k: usize| {
            let [a, b] = [from.position[k], to.position[k]];
            let most = f64::from(self.size[k]);
            let [low, high] = [a.min(b) - reach, a.max(b) + reach].map(|v| v.clamp(0.0, most));
            low as u32..high.ceil() as u32
        };

        // Look at the pixels around.
        for (x, y) in bound(1).flat_map(|y| bound(0).map(move |x| (x, y))) {
            let at = y as usize * self.size[0] as usize + x as usize;
            if self.places[at].number != number {
                continue;
            }
            let middle = [x, y].map(|v| f64::from(v) + 0.5);
            let off = [0, 1].map(|k| middle[k] - from.position[k]);
            let share = ((off[0] * way[0] + off[1] * way[1]) / (length * length)).clamp(0.0, 1.0);
            let beside = [0, 1].map(|k| off[k] - way[k] * share);
            let distance = beside[0].hypot(beside[1]);
            if distance < self.nearest[at] {
                self.nearest[at] = distance;
                let side = way[0] * off[1] - way[1] * off[0];
                let half = 0.5 * (from.width + (to.width - from.width) * share);
                let across = (distance / half).min(1.0).copysign(side);
                self.places[at].uv = [along + length * share, across].map(|v| v as f32);
                self.places[at].depth = self.depth_between([from.depth, to.depth], share);
            }
        }
        length
    }

    /// View depth at a share of the way between two depths, as the picture of a straight line has it.
    fn depth_between(&self, depths: [f64; 2], share: f64) -> f32 {
        let [from, to] = depths.map(|depth| self.view.plane_coordinate(depth as f32));
        let between = from + (to - from) * share as f32;
        self.view.depth_of_coordinate(between)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64, depth: f64) -> StrokePoint {
        StrokePoint {
            position: [x, y],
            depth,
            width: 6.0,
            u: 0.0,
            world: [0.0; 3],
            ..StrokePoint::default()
        }
    }

    /// The places of 20 x 20 pixels on a stroke that goes right and turns down, as a view sees it: number 3, which
    /// shows at all of them but one.
    fn places_on_corner(view: &View) -> Vec<StrokePlace> {
        let corner = [
            point(2.0, 5.0, 1.0),
            point(12.0, 5.0, 2.0),
            point(12.0, 15.0, 4.0),
        ];
        let stroke = Stroke {
            id: 1,
            kind: Kind::Contour,
            occluders: 0,
            surface: 0,
            closed: false,
            part: None,
            points: corner.to_vec(),
        };
        let size = [20, 20];
        let own = StrokePlace {
            number: 3,
            depth: LayerPixel::FAR,
            uv: [0.0; 2],
        };
        let mut places = vec![own; 400];
        places[4 * 20 + 7].number = 2;
        let mut nearest = vec![f64::INFINITY; 400];
        let mut picture = Picture {
            view,
            size,
            places: &mut places,
            nearest: &mut nearest,
        };
        picture.find(3, &stroke, 0.0);
        places
    }

    fn view(perspective: f32) -> View {
        View {
            perspective,
            ..View::default()
        }
    }

    /// `u` is the way along the stroke, `v` negative on its left.
    #[test]
    fn pixels_lie_along_and_across_their_stroke() {
        let places = places_on_corner(&view(1.0));
        let uv = |x: usize, y: usize| places[y * 20 + x].uv;
        // Over the level part is its left, below it its right, half a pixel from the middle.
        assert_eq!(uv(6, 4), [4.5, -0.5 / 3.0]);
        assert_eq!(uv(6, 6), [4.5, 1.5 / 3.0]);
        // Right of the part that goes down is its left.
        assert_eq!(uv(12, 10), [15.5, -0.5 / 3.0]);
        // Pixels of other strokes, and those out of reach, stay as they are.
        assert_eq!((uv(7, 4), uv(1, 18)), ([0.0; 2], [0.0; 2]));
    }
    /// In perspective half way in the picture is less than half way in depth.
    #[test]
    fn pixels_have_the_depth_of_their_stroke() {
        for (perspective, half_way) in [(0.0, [1.5, 3.0]), (1.0, [4.0 / 3.0, 8.0 / 3.0])] {
            let places = places_on_corner(&view(perspective));
            let depth = |x: usize, y: usize| {
                let [left, right] = [x - 1, x].map(|x| places[y * 20 + x].depth);
                0.5 * (left + right)
            };
            // Half way along the level part, over and below it.
            for y in [3, 5, 6] {
                assert!((depth(7, y) - half_way[0]).abs() < 2e-3, "{}", depth(7, y));
            }
            let down = [9, 10].map(|y| places[y * 20 + 12].depth);
            let down = 0.5 * (down[0] + down[1]);
            assert!((down - half_way[1]).abs() < 5e-3, "{down}");
            // Another stroke shows there, and no piece comes near.
            assert_eq!(
                [places[4 * 20 + 7].depth, places[18 * 20 + 1].depth],
                [1e10; 2]
            );
        }
    }
}
