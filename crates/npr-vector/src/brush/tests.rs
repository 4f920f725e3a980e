use super::*;
use crate::stroke_ink::draw;
use npr_core::color::unpack_rgba8;
use npr_core::window::Window;
use proptest::prelude::*;

const SIDE: u32 = 64;

/// An image of `along` x `across` texels with its levels, by a function of the place.
fn image(size: [u32; 2], texel: impl Fn(f32, f32) -> [f32; 2]) -> (Brush, Vec<u32>) {
    let levels = size[0].min(size[1]).ilog2() + 1;
    let mut words = Vec::new();
    for level in 0..levels {
        let [along, across] = size.map(|side| side >> level);
        for i in 0..along * across {
            let u = ((i % along) as f32 + 0.5) / along as f32;
            let v = ((i / along) as f32 + 0.5) / across as f32;
            let [nap, ink] = texel(u, v).map(|share| (share * 255.0 + 0.5) as u32);
            words.push(nap | ink << 8);
        }
    }
    let brush = Brush {
        start: 0,
        texels_along: size[0],
        texels_across: size[1],
        levels,
        dry: 0.0,
        grain: 0.0,
        soft: 0.1,
        spots_per_px: 0.5,
    };
    (brush, words)
}

/// Alpha of every pixel of a picture of strokes.
fn drawn(points: &[InkPoint], (brush, texels): &(Brush, Vec<u32>)) -> Vec<f32> {
    let side = SIDE as f32;
    let window = Window::over([side; 2], [0.0; 2], [side; 2], [SIDE; 2]);
    let [mut layer, mut keys] = [0, 1].map(|_| vec![0; (SIDE * SIDE) as usize]);
    let brushes = Brushes {
        all: &[Brush::default(), *brush],
        texels,
    };
    draw(&window, (points, brushes), &mut layer, &mut keys);
    layer
        .into_iter()
        .map(|texel| unpack_rgba8(texel)[3])
        .collect()
}

/// A stroke of the brush through places, whose image is `image_px` long.
fn stroke(places: &[[f32; 2]], half_width: f32, image_px: f32) -> Vec<InkPoint> {
    let mut u = 0.0;
    let mut points: Vec<InkPoint> = Vec::new();
    for px in places {
        if let Some(last) = points.last() {
            let [x, y] = [px[0] - last.px[0], px[1] - last.px[1]];
            u += (x * x + y * y).sqrt() / image_px;
        }
        points.push(InkPoint {
            px: *px,
            half_width,
            nearness: 0.5,
            color: 0xff00_0000,
            flags: 1 << InkPoint::BRUSH_SHIFT | InkPoint::GOES_ON | InkPoint::JOINED,
            u,
            pressure: 1.0,
        });
    }
    if let Some(last) = points.last_mut() {
        last.flags = 1 << InkPoint::BRUSH_SHIFT;
    }
    points
}

fn at(picture: &[f32], x: u32, y: u32) -> f32 {
    picture[(y * SIDE + x) as usize]
}

#[test]
fn the_image_lies_along_the_stroke_and_across_it() {
    // Ink in the first half of each image, on its left side alone.
    let half = image([64, 16], |u, v| [1.0, f32::from(u < 0.5 && v < 0.5)]);
    let picture = drawn(&stroke(&[[8.0, 32.0], [56.0, 32.0]], 8.0, 16.0), &half);
    // From the left end to the right, the stroke's left side is above, where y is less.
    for (x, y, ink) in [
        (12, 28, 1.0),
        (12, 36, 0.0),
        (20, 28, 0.0),
        (28, 28, 1.0),
        (36, 28, 0.0),
    ] {
        assert_eq!(at(&picture, x, y), ink, "{x} {y}");
    }

    // Turned over, it lies on the other side.
    let mut points = stroke(&[[8.0, 32.0], [56.0, 32.0]], 8.0, 16.0);
    points
        .iter_mut()
        .for_each(|point| point.flags |= InkPoint::MIRRORED);
    let picture = drawn(&points, &half);
    assert_eq!([at(&picture, 12, 28), at(&picture, 12, 36)], [0.0, 1.0]);
}

#[test]
fn high_places_of_the_nap_touch_first() {
    // The nap rises along the image.
    let (brush, texels) = image([64, 16], |u, _| [u, 1.0]);
    let dry = Brush {
        dry: 1.0,
        soft: 0.02,
        ..brush
    };
    for (pressure, share) in [(1.0, 1.0), (0.5, 0.5), (0.25, 0.25)] {
        let mut points = stroke(&[[0.0, 32.0], [64.0, 32.0]], 8.0, 64.0);
        points
            .iter_mut()
            .for_each(|point| point.pressure = pressure);
        let picture = drawn(&points, &(dry, texels.clone()));
        let inked = (0..SIDE).filter(|x| at(&picture, *x, 32) > 0.5).count() as f32 / SIDE as f32;
        assert!((inked - share).abs() < 0.04, "{pressure}: {inked}");
        assert_eq!(at(&picture, 62, 32), 1.0, "the highest place touches");
    }
}

#[test]
fn the_paper_shows_through_and_lies_still() {
    let (brush, texels) = image([64, 16], |_, _| [1.0, 1.0]);
    let rough = (
        Brush {
            grain: 1.0,
            soft: 0.05,
            ..brush
        },
        texels,
    );
    let with = |y: f32| {
        let mut points = stroke(&[[4.0, y], [60.0, y]], 9.0, 30.0);
        points.iter_mut().for_each(|point| point.pressure = 0.5);
        drawn(&points, &rough)
    };
    let (here, there) = (with(30.0), with(33.0));
    let inside: Vec<usize> = (0..(SIDE * SIDE) as usize)
        .filter(|slot| {
            (26..37).contains(&(*slot / SIDE as usize))
                && (6..58).contains(&(*slot % SIDE as usize))
        })
        .collect();
    assert!(
        inside.iter().all(|slot| here[*slot] == there[*slot]),
        "the grain is the paper's"
    );
    let inked =
        inside.iter().filter(|slot| here[**slot] > 0.5).count() as f32 / inside.len() as f32;
    assert!((0.3..0.7).contains(&inked), "{inked}");
}

#[test]
fn a_free_end_is_round_however_the_image_ends() {
    // Ink that fades towards both edges leaves no spike beyond the end.
    let soft = image([16, 16], |_, v| {
        [1.0, (1.0 - (2.0 * v - 1.0).abs()).max(0.0)]
    });
    let picture = drawn(&stroke(&[[20.0, 32.0], [40.0, 32.0]], 10.0, 20.0), &soft);
    for (beyond, beside) in [(40.0 + 4.0, 0.0), (40.0 + 8.0, 0.0), (42.0, 5.0)] {
        let (x, y) = (beyond as u32, (32.0 + beside) as u32);
        let [dx, dy] = [x as f32 + 0.5 - 40.0, y as f32 + 0.5 - 32.0];
        let most = 1.0 - (dx * dx + dy * dy).sqrt() / 10.0;
        assert!(
            at(&picture, x, y) <= most.max(0.0) + 0.02,
            "{x} {y}: {}",
            at(&picture, x, y)
        );
    }
}

#[test]
fn a_stamp_shows_its_image_once_and_ends_at_its_sides() {
    // Ink in the corner of the image where it begins, on its left.
    let corner = image([16, 16], |u, v| [1.0, f32::from(u < 0.5 && v < 0.5)]);
    let mut points = stroke(&[[20.0, 32.0], [40.0, 32.0]], 10.0, 20.0);
    points
        .iter_mut()
        .for_each(|point| point.flags &= !InkPoint::JOINED);
    let stamp = |bits: u32| {
        let with_bits = points.iter().map(|point| InkPoint {
            flags: point.flags | InkPoint::STAMP | bits,
            ..*point
        });
        with_bits.collect::<Vec<_>>()
    };
    let picture = drawn(&stamp(0), &corner);
    let inked = [(22, 24), (28, 30)].map(|(x, y)| at(&picture, x, y));
    let bare = [(34, 24), (22, 36), (18, 32), (43, 30)].map(|(x, y)| at(&picture, x, y));
    assert_eq!(
        (inked, bare),
        ([1.0; 2], [0.0; 4]),
        "nothing goes on beyond its ends"
    );

    // Round ones fall off towards their corners.
    let even = image([16, 16], |_, _| [1.0, 1.0]);
    let [square, round] = [0, InkPoint::ROUND].map(|bits| drawn(&stamp(bits), &even));
    assert_eq!([at(&square, 21, 23), at(&round, 21, 23)], [1.0, 0.0]);
    assert_eq!([at(&square, 30, 32), at(&round, 30, 32)], [1.0; 2]);

    // All around they are as the image is across.
    let soft = image([16, 16], |_, v| {
        [1.0, (1.0 - (2.0 * v - 1.0).abs()).max(0.0)]
    });
    let picture = drawn(&stamp(InkPoint::ROUND), &soft);
    let [along, beside] = [at(&picture, 35, 32), at(&picture, 30, 37)];
    assert!(
        (0.35..0.55).contains(&along) && (along - beside).abs() < 0.02,
        "{along} {beside}"
    );
}

fn place() -> impl Strategy<Value = [f32; 2]> {
    prop::array::uniform2(12f32..52.0)
}

proptest! {
    /// A brush that touches everywhere draws what a pen draws, whatever the bends: no pixel is left to nobody.
    #[test]
    fn a_full_brush_is_a_pen(places in prop::collection::vec(place(), 2..12), half in 0.3f32..9.0) {
        let full = image([32, 16], |_, _| [1.0, 1.0]);
        let with_brush = stroke(&places, half, 40.0);
        let with_pen: Vec<_> = with_brush.iter().map(|point| InkPoint { flags: point.flags & 255, ..*point }).collect();
        let [brushed, inked] = [with_brush, with_pen].map(|points| drawn(&points, &full));
        // Beyond free ends a brush is lifted; everywhere else it is pressed down.
        let ends = [places[0], places[places.len() - 1]];
        for slot in 0..(SIDE * SIDE) as usize {
            let p = [slot as u32 % SIDE, slot as u32 / SIDE].map(|v| v as f32 + 0.5);
            let is_at_end = ends.iter().any(|end| {
                ((p[0] - end[0]).powi(2) + (p[1] - end[1]).powi(2)).sqrt() < half + 1.0
            });
            let off = inked[slot] - brushed[slot];
            // The nearest piece may see a corner of a pixel that another one, at another angle, sees as a side: at the
            // same distance half planes then cover up to 0.043 less.
            let is_alike = (-1.5 / 255.0..0.05).contains(&off);
            prop_assert!(is_alike || is_at_end && off > 0.0, "{:?} {} {}", p, brushed[slot], inked[slot]);
        }
    }

    /// However finely a line is cut, the image lies on it as before.
    #[test]
    fn more_points_on_a_line_change_nothing(
        a in place(), b in place(), mut cuts in prop::collection::vec(0.02f32..0.98, 0..9), half in 0.5f32..8.0,
    ) {
        prop_assume!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() > 10.0);
        cuts.sort_by(f32::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < 1e-2);
        let waves = image([64, 16], |u, v| [((u * 4.0).fract() * 2.0 - 1.0).abs(), 0.5 + 0.5 * v]);
        let dry = (Brush { dry: 1.5, soft: 0.5, ..waves.0 }, waves.1);
        let cut = cuts.iter().map(|t| [0, 1].map(|i| a[i] + (b[i] - a[i]) * t));
        let places: Vec<_> = std::iter::once(a).chain(cut).chain([b]).collect();
        let whole = drawn(&stroke(&[a, b], half, 25.0), &dry);
        let cut = drawn(&stroke(&places, half, 25.0), &dry);
        let differ = whole.iter().zip(&cut).filter(|(a, b)| (*a - *b).abs() > 0.02).count();
        prop_assert!(differ <= 2, "{} pixels", differ);
    }

    /// Any numbers give a share of ink.
    #[test]
    fn any_brush_gives_a_share(dry: f32, grain: f32, soft in 0.02f32..2.0, u: f32, pressure in 0f32..1.0, half: f32) {
        let (brush, texels) = image([8, 8], |u, v| [u, v]);
        let brush = Brush { dry, grain, soft, ..brush };
        let mut points = stroke(&[[10.0, 10.0], [40.0, 30.0]], 3.0, 20.0);
        points[0].half_width = half.abs().min(1e5);
        points[1].u = u.clamp(-1e6, 1e6);
        points[0].pressure = pressure;
        prop_assume!(u.is_finite() && half.is_finite() && dry.is_finite() && grain.is_finite());
        for alpha in drawn(&points, &(brush, texels)) {
            prop_assert!((0.0..=1.0).contains(&alpha));
        }
    }
}
