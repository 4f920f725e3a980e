//! The visible strokes of a drawing as points that the pass `stroke.draw_strokes` inks into a frame.

use crate::clip::clip_stroke;
use crate::stamps::Stamps;
use npr_core::random::{hash, unit};
use npr_vector::ink_point::InkPoint;
use npr_vector::stroke::{Drawing, Stroke, StrokePoint};
use rayon::prelude::*;

/// Greatest half width of ink, in pixels: wider lines cover any frame.
const WIDEST: f64 = 1e5;

/// How the image of a brush lies on strokes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrushLay {
    /// The number of the brush; 0 is a pen, without an image.
    pub brush: u32,
    /// How often the image is there.
    pub images: Images,
}

/// How often the image of a brush lies on a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Images {
    /// One over the whole stroke.
    Once,
    /// One behind the other, each so many pixels long.
    ByLength(f64),
    /// As stamps.
    Stamps(Stamps),
}

impl BrushLay {
    /// A pen.
    pub const PEN: Self = Self {
        brush: 0,
        images: Images::Once,
    };
}

/// Where the image of a brush lies on one stroke.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Laid {
    pub flags: u32,
    /// Place in the image where the stroke's own way is 0, and how far it moves per pixel along it.
    pub start: f64,
    pub per_px: f64,
    /// Half width at which the brush is pressed down fully.
    pub full: f64,
    /// Length of a ring, in pixels; 0 of an open stroke.
    around: f64,
}

impl Laid {
    /// The image begins anywhere and on either side, by the id of the stroke's line, so that lines are not alike; on a
    /// ring it closes.
    pub fn new(stroke: &Stroke, lay: BrushLay, full: f64) -> Self {
        let length = stroke.length();
        let line = stroke.line();
        let chance = hash(line as u32, (line >> 32) as u32, 0);
        let (start, per_px) = match lay.images {
            Images::ByLength(image) => {
                let images = length / image.max(LEAST_IMAGE_PX);
                let whole = match stroke.closed {
                    true => images.round().max(1.0),
                    false => images,
                };
                (f64::from(unit(chance)), whole / length)
            }
            Images::Once | Images::Stamps(_) => once_over(stroke, length),
        };
        let per_px = if per_px.is_finite() { per_px } else { 0.0 };
        let is_mirrored = matches!(lay.images, Images::ByLength(_)) && chance & 1 != 0;
        let mirrored = if is_mirrored { InkPoint::MIRRORED } else { 0 };
        Self {
            flags: lay.brush << InkPoint::BRUSH_SHIFT | mirrored,
            start,
            per_px,
            full,
            around: if stroke.closed { length } else { 0.0 },
        }
    }

    /// Place in the image at the first point of the stroke.
    pub fn start_on(&self, stroke: &Stroke) -> f64 {
        let first = stroke.points.first();
        first.map_or(0.0, |first| f64::from(self.u(first, 0.0)))
    }

    /// Place in the image at a point of the stroke, after a number of rounds of a ring.
    fn u(&self, point: &StrokePoint, rounds: f64) -> f32 {
        let u = self.start + (point.u + rounds * self.around) * self.per_px;
        if u.abs() < 1e6 { u as f32 } else { 0.0 }
    }

    /// Share of full pressure where a stroke is so wide: by its root, as a nib spreads.
    fn pressure(&self, half_width: f64) -> f32 {
        (half_width / self.full).clamp(0.0, 1.0).sqrt() as f32
    }

    /// A point of the stroke with its width and pressure, in its own colour or else in `own`; nearness and `u` are 0.
    pub fn inked(&self, point: &StrokePoint, own: [u8; 4]) -> InkPoint {
        let half_width = half_width(point);
        InkPoint {
            px: point.position.map(|at| at as f32),
            half_width: half_width as f32,
            nearness: 0.0,
            color: u32::from_le_bytes(point.color.unwrap_or(own)),
            flags: self.flags,
            u: 0.0,
            pressure: self.pressure(half_width),
        }
    }
}

/// Where one image over the whole line of a stroke of some length begins, and how far it moves per pixel.
fn once_over(stroke: &Stroke, length: f64) -> (f64, f64) {
    let [first, last] = match &stroke.points[..] {
        [first, .., last] => [first.u, last.u],
        _ => [0.0; 2],
    };
    let of_part = stroke.part.map(|part| (part.share_at(0.0), part.length_px));
    let (before, length) = of_part.unwrap_or((0.0, length));
    // A texture that runs against the stroke begins with the end of the image.
    let sign = if last < first { -1.0 } else { 1.0 };
    (sign * before - first / length, 1.0 / length)
}

/// Half the width of a stroke at a point, at most [`WIDEST`].
pub(crate) fn half_width(point: &StrokePoint) -> f64 {
    // No number is no width.
    (0.5 * point.width).clamp(0.0, WIDEST).max(0.0)
}

/// The largest half width of a stroke, in pixels.
pub(crate) fn widest(stroke: &Stroke) -> f64 {
    stroke.points.iter().map(half_width).fold(0.0, f64::max)
}

/// Removes points that lie so near to the one before that a piece between them has no direction; the ends stay.
pub(crate) fn keep_apart(points: &mut Vec<StrokePoint>) {
    let Some(last) = points.last().copied() else {
        return;
    };
    let is_near = |a: &StrokePoint, b: &StrokePoint| {
        (0..2).all(|i| (a.position[i] - b.position[i]).abs() < APART_PX)
    };
    points.dedup_by(|next, kept| is_near(next, kept));
    if let [.., end] = &mut points[..] {
        *end = last;
    }
}

/// Least distance between neighbouring points of a stroke with an image, in pixels.
const APART_PX: f64 = 0.05;

/// Least length of an image, in pixels.
const LEAST_IMAGE_PX: f64 = 1.0;

/// The visible strokes of a drawing, as [`draw`](npr_vector::stroke_ink::draw) takes them, cut to the picture.
///
/// `nearness` of a depth is 1 at the near plane and falls to 0 behind it; `lay_of` says how the image of its brush lies
/// on a stroke. A brush is pressed down fully where its stroke is widest. Strokes are worked on in parallel; the result
/// does not depend on the number of threads. O(points).
pub fn ink_points(
    drawing: &Drawing,
    nearness: &(dyn Fn(f64) -> f32 + Sync),
    lay_of: &(dyn Fn(&Stroke) -> BrushLay + Sync),
) -> Vec<InkPoint> {
    let strokes = drawing.strokes.par_iter().with_min_len(64);
    let of_stroke = |stroke: &Stroke| {
        // Cut it to the picture.
        let widest = widest(stroke);
        let parts = match stroke.is_visible() && widest > 0.0 {
            true => clip_stroke(stroke, drawing.size.map(f64::from), widest + 1.0),
            false => Vec::new(),
        };

        // Lay its brush on it.
        let lay = lay_of(stroke);
        let laid = Laid::new(stroke, lay, widest);
        let (has_image, id) = (lay.brush > 0, stroke.line());
        let stamps = match lay.images {
            Images::Stamps(stamps) if has_image => Some(stamps),
            _ => None,
        };

        // Give every point its width and colour; a closed one comes back to its first. The image of a brush needs to
        // know where a ring comes from and goes on to.
        let surface = drawing.surfaces.get(stroke.surface as usize);
        let own = surface.map_or([0, 0, 0, 255], |surface| surface.line_color);
        parts.into_iter().flat_map(move |(mut points, is_closed)| {
            if has_image {
                keep_apart(&mut points);
            }
            let inked = move |point: &StrokePoint| InkPoint {
                nearness: nearness(point.depth),
                ..laid.inked(point, own)
            };
            if let Some(stamps) = stamps {
                return stamps.along(&points, is_closed, id, &inked);
            }
            let laid_at = |i: usize, rounds: f64, flags: u32| InkPoint {
                flags: laid.flags | flags,
                u: laid.u(&points[i], rounds),
                ..inked(&points[i])
            };
            let (joined, count) = (InkPoint::JOINED, points.len());
            let is_ring = is_closed && has_image && count > 1;
            let mut all = Vec::with_capacity(count + 3);
            all.extend(is_ring.then(|| laid_at(count - 1, -1.0, joined)));
            all.extend((0..count).map(|i| laid_at(i, 0.0, InkPoint::GOES_ON | joined)));
            match (is_closed, all.last_mut()) {
                (false, Some(end)) => end.flags = laid.flags,
                (false, None) => {}
                (true, _) if is_ring => all.extend([laid_at(0, 1.0, joined), laid_at(1, 1.0, 0)]),
                (true, _) => all.push(laid_at(0, 1.0, 0)),
            }
            all
        })
    };
    strokes.flat_map_iter(of_stroke).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use npr_vector::stroke::StrokeSurface;
    use proptest::prelude::*;

    fn drawing(points: &[[f64; 3]], closed: bool) -> Drawing {
        let mut along = 0.0;
        let mut last = None;
        let points = points.iter().map(|[x, y, width]| {
            let [px, py] = last.replace([*x, *y]).unwrap_or([*x, *y]);
            along += f64::hypot(x - px, y - py);
            StrokePoint {
                position: [*x, *y],
                width: *width,
                depth: 2.0,
                u: along,
                ..StrokePoint::default()
            }
        });
        let stroke = Stroke {
            id: 0,
            kind: npr_vector::stroke::Kind::Contour,
            occluders: 0,
            surface: 0,
            closed,
            part: None,
            points: points.collect(),
        };
        Drawing {
            size: [64, 48],
            surfaces: vec![StrokeSurface {
                line_color: [1, 2, 3, 255],
                ..StrokeSurface::default()
            }],
            strokes: vec![stroke],
            ..Drawing::default()
        }
    }

    fn inked_with(drawing: &Drawing, lay: BrushLay) -> Vec<InkPoint> {
        ink_points(drawing, &|depth| 1.0 / depth as f32, &|_| lay)
    }

    fn inked(drawing: &Drawing) -> Vec<InkPoint> {
        inked_with(drawing, BrushLay::PEN)
    }

    #[test]
    fn a_stroke_keeps_its_places_widths_and_colors() {
        let mut open = drawing(&[[1.0, 2.0, 3.0], [9.0, 8.0, 5.0]], false);
        open.strokes[0].points[1].color = Some([9, 8, 7, 6]);
        let ends = [
            InkPoint {
                px: [1.0, 2.0],
                half_width: 1.5,
                nearness: 0.5,
                color: 0xff03_0201,
                flags: InkPoint::GOES_ON | InkPoint::JOINED,
                u: 0.0,
                pressure: (1.5_f32 / 2.5).sqrt(),
            },
            InkPoint {
                px: [9.0, 8.0],
                half_width: 2.5,
                nearness: 0.5,
                color: 0x0607_0809,
                flags: 0,
                u: 1.0,
                pressure: 1.0,
            },
        ];
        assert_eq!(inked(&open), ends);
    }

    #[test]
    fn a_closed_stroke_comes_back() {
        let points = [[1.0, 2.0, 3.0], [9.0, 8.0, 5.0], [4.0, 30.0, 5.0]];
        let inked = inked(&drawing(&points, true));
        assert_eq!(inked.len(), 4);
        assert_eq!((inked[3].px, inked[3].flags), (inked[0].px, 0));
        assert!(inked[..3].iter().all(InkPoint::goes_on));
    }

    /// A line of 30 px with a bend.
    const BENT: [[f64; 3]; 3] = [[10.0, 10.0, 2.0], [30.0, 10.0, 4.0], [30.0, 20.0, 1.0]];

    fn with_brush(length_px: Option<f64>) -> BrushLay {
        BrushLay {
            brush: 3,
            images: length_px.map_or(Images::Once, Images::ByLength),
        }
    }

    #[test]
    fn an_image_lies_once_over_a_stroke_or_by_its_length() {
        let once = inked_with(&drawing(&BENT, false), with_brush(None));
        let places: Vec<f32> = once.iter().map(|point| point.u).collect();
        assert_eq!(places, [0.0, 20.0 / 30.0, 1.0]);
        let by_length = inked_with(&drawing(&BENT, false), with_brush(Some(15.0)));
        let starts = by_length[0].u;
        assert!((0.0..1.0).contains(&starts));
        let steps = by_length.iter().map(|point| point.u - starts);
        assert!(
            steps
                .zip([0.0, 20.0 / 15.0, 2.0])
                .all(|(u, want)| (u - want).abs() < 1e-5)
        );
        for point in once.iter().chain(&by_length) {
            assert_eq!(point.flags >> InkPoint::BRUSH_SHIFT, 3);
        }
    }

    #[test]
    fn pressure_is_full_where_a_stroke_is_widest() {
        let inked = inked_with(&drawing(&BENT, false), with_brush(None));
        let pressures = inked.iter().map(|point| point.pressure);
        assert!(pressures.eq([0.5_f32.sqrt(), 1.0, 0.5]));
    }

    #[test]
    fn strokes_of_other_ids_begin_elsewhere_on_the_image() {
        let mut drawing = drawing(&BENT, false);
        let mut starts: Vec<f32> = (0..20)
            .map(|id| {
                drawing.strokes[0].id = id << 33;
                inked_with(&drawing, with_brush(Some(15.0)))[0].u
            })
            .collect();
        starts.sort_by(f32::total_cmp);
        starts.dedup();
        assert_eq!(starts.len(), 20);
    }

    #[test]
    fn an_image_closes_on_a_ring() {
        let mut ring = drawing(&BENT, true);
        for length_px in [Some(7.0), Some(1e4), None] {
            let inked = inked_with(&ring, with_brush(length_px));
            // The last point, the ring, its first point again, and the second, for what joins them.
            let flags: Vec<u32> = inked.iter().map(|point| point.flags & 3).collect();
            assert_eq!(flags, [2, 3, 3, 3, 2, 0]);
            let places: Vec<[f32; 2]> = inked.iter().map(|point| point.px).collect();
            assert_eq!(
                (places[0], places[4], places[5]),
                (places[3], places[1], places[2])
            );
            let rounds = inked[4].u - inked[1].u;
            assert!(
                rounds >= 0.9 && (rounds - rounds.round()).abs() < 1e-4,
                "{rounds}"
            );
            assert!((inked[3].u - inked[0].u - rounds).abs() < 1e-4);
        }
        // Points without a distance are one.
        ring.strokes[0]
            .points
            .iter_mut()
            .for_each(|point| point.position = [5.0; 2]);
        assert!(
            inked_with(&ring, with_brush(None))
                .iter()
                .all(|point| point.px == [5.0; 2])
        );
    }

    #[test]
    fn what_is_hidden_or_has_no_width_is_left_out() {
        let line = [[1.0, 2.0, 3.0], [9.0, 8.0, 5.0]];
        let mut hidden = drawing(&line, false);
        hidden.strokes[0].occluders = 1;
        assert!(inked(&hidden).is_empty());
        let thin = line.map(|[x, y, _]| [x, y, 0.0]);
        assert!(inked(&drawing(&thin, false)).is_empty());
    }

    proptest! {
        /// Whatever strokes hold, shaders get numbers near the picture.
        #[test]
        fn any_numbers_give_points_near_the_picture(
            points in prop::collection::vec([any::<f64>(), any::<f64>(), any::<f64>()], 0..12), closed: bool,
            length_px in prop::option::of(any::<f64>()),
        ) {
            for point in inked_with(&drawing(&points, closed), with_brush(length_px)) {
                prop_assert!(point.px.iter().all(|at| at.abs() < 2.1e5), "{:?}", point);
                prop_assert!((0.0..=1e5).contains(&point.half_width), "{:?}", point);
                prop_assert!((0.0..=1.0).contains(&point.pressure) && point.u.is_finite(), "{:?}", point);
            }
        }
    }
}
