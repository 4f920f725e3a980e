//! Strokes of brushes in files, held against what frames ink of them.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use npr_core::window::Window;
use npr_drawing::artwork::{
    ArtworkOptions, Paint, Paths, STAMPS_LIMIT, StrokeBrushes, arrange, stamp_count,
};
use npr_drawing::drawing::rasterise;
use npr_drawing::ink::{BrushLay, Images, ink_points};
use npr_drawing::pdf::write_pdf;
use npr_drawing::stamps::Stamps;
use npr_drawing::svg::write_svg;
use npr_vector::brush::{Brush, Brushes};
use npr_vector::stroke::{Drawing, Kind, Stroke, StrokePoint, StrokeSurface};
use npr_vector::stroke_ink::draw;
use proptest::prelude::*;
use resvg::{tiny_skia, usvg};

const SIZE: [u32; 2] = [320, 240];

/// Texels along and across the image of the brush.
const TEXELS: [u32; 2] = [64, 16];

/// An image with gaps in its ink, softer towards its sides, and all its levels.
fn words() -> Vec<u32> {
    let mut size = TEXELS;
    let mut level: Vec<[f32; 2]> = (0..size[0] * size[1])
        .map(|i| {
            let (x, y) = (i % size[0], i / size[0]);
            let beside = (y as f32 + 0.5) / 8.0 - 1.0;
            let nap = (x * 37 + y * 101) % 64;
            [nap as f32 / 63.0, 1.0 - 0.8 * beside * beside]
        })
        .collect();
    let mut words = Vec::new();
    loop {
        words.extend(level.iter().map(|texel| {
            let [nap, ink] = texel.map(|v| (v * 255.0 + 0.5) as u32);
            nap | ink << 8
        }));
        if size[1] == 1 {
            return words;
        }
        let next = [size[0] / 2, size[1] / 2];
        level = (0..next[0] * next[1])
            .map(|i| {
                let (x, y) = (2 * (i % next[0]), 2 * (i / next[0]));
                let at = |dx: u32, dy: u32| level[((y + dy) * size[0] + x + dx) as usize];
                let four = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
                [0, 1].map(|i| four.iter().map(|texel| texel[i]).sum::<f32>() / 4.0)
            })
            .collect();
        size = next;
    }
}

fn brushes(images: Images, grain: f32) -> StrokeBrushes {
    let brush = Brush {
        start: 0,
        texels_along: TEXELS[0],
        texels_across: TEXELS[1],
        levels: 5,
        dry: 0.5,
        grain,
        soft: 0.2,
        spots_per_px: 0.4,
    };
    StrokeBrushes {
        all: vec![Brush::default(), brush],
        texels: words(),
        lays: vec![BrushLay { brush: 1, images }],
    }
}

const DENSE: Stamps = Stamps {
    spacing_px: 3.0,
    size: 1.0,
    length: 1.0,
    jitter: 0.2,
    angle: 0.0,
    turn: std::f64::consts::PI,
    rakes: true,
    scatter: 0.0,
    part: (None, 0.25),
    is_round: true,
};

/// A wave that thins out, a zigzag and a ring, none near another.
fn drawing() -> Drawing {
    let angle = |turn: f64| (turn * std::f64::consts::TAU) as f32;
    let sin = |turn: f64| f64::from(npr_core::math::sin(angle(turn)));
    let cos = |turn: f64| f64::from(npr_core::math::cos(angle(turn)));
    let wave = (0..=100).map(|i| {
        let t = f64::from(i) / 100.0;
        (
            [20.0 + 280.0 * t, 40.0 + 14.0 * sin(1.5 * t)],
            12.0 - 9.0 * t,
        )
    });
    let zigzag = [
        [20.0, 110.0],
        [70.0, 90.0],
        [110.0, 130.0],
        [150.0, 84.0],
        [165.0, 150.0],
    ];
    let zigzag = zigzag.into_iter().map(|at| (at, 8.0));
    let ring = (0..80).map(|i| {
        let t = f64::from(i) / 80.0;
        ([240.0 + 45.0 * cos(t), 160.0 + 45.0 * sin(t)], 10.0)
    });
    let stroke = |id: u64, closed: bool, places: Vec<([f64; 2], f64)>| {
        let (mut u, mut last) = (0.0, None);
        let points = places.into_iter().map(|(position, width)| {
            let [x, y] = last.replace(position).unwrap_or(position);
            u += f64::hypot(position[0] - x, position[1] - y);
            StrokePoint {
                position,
                width,
                u,
                depth: 3.0,
                ..StrokePoint::default()
            }
        });
        Stroke {
            id,
            kind: Kind::Contour,
            occluders: 0,
            surface: 0,
            closed,
            part: None,
            points: points.collect(),
        }
    };
    let black = StrokeSurface {
        line_color: [0, 0, 0, 255],
        ..StrokeSurface::default()
    };
    Drawing {
        size: SIZE,
        surfaces: vec![black],
        strokes: vec![
            stroke(11, false, wave.collect()),
            stroke(12, false, zigzag.collect()),
            stroke(13, true, ring.collect()),
        ],
        ..Drawing::default()
    }
}

fn options(brushes: &StrokeBrushes) -> ArtworkOptions {
    ArtworkOptions {
        paths: Paths::Stamps,
        brushes: brushes.clone(),
        ..ArtworkOptions::default()
    }
}

/// Share of ink at every pixel of a frame.
fn of_frame(drawing: &Drawing, brushes: &StrokeBrushes) -> Vec<f64> {
    let lay_of = |_: &Stroke| brushes.lays[0];
    let points = ink_points(drawing, &|_| 0.5, &lay_of);
    let side = SIZE.map(|side| side as f32);
    let window = Window::over(side, [0.0; 2], side, SIZE);
    let count = (SIZE[0] * SIZE[1]) as usize;
    let (mut layer, mut keys) = (vec![0; count], vec![0; count]);
    let laid = Brushes {
        all: &brushes.all,
        texels: &brushes.texels,
    };
    draw(&window, (&points, laid), &mut layer, &mut keys);
    let alpha = layer.iter().map(|texel| f64::from(texel >> 24) / 255.0);
    alpha.collect()
}

/// The same of the SVG file, as resvg draws it.
fn of_file(drawing: &Drawing, options: &ArtworkOptions) -> Vec<f64> {
    let svg = String::from_utf8(write_svg(drawing, options)).unwrap();
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).unwrap();
    let mut pixels = tiny_skia::Pixmap::new(SIZE[0], SIZE[1]).unwrap();
    resvg::render(
        &tree,
        tiny_skia::Transform::identity(),
        &mut pixels.as_mut(),
    );
    let alpha = pixels.pixels().iter().map(|p| f64::from(p.alpha()) / 255.0);
    alpha.collect()
}

/// How often as much ink there is as in a frame, and how far its places differ: both pictures blurred over squares of
/// 16 pixels.
fn compared(file: &[f64], frame: &[f64]) -> (f64, f64) {
    let width = SIZE[0] as usize;
    let squares = |ink: &[f64]| {
        let mut sums = vec![0.0; (SIZE[0] / 16 * SIZE[1] / 16) as usize];
        for (slot, ink) in ink.iter().enumerate() {
            sums[slot / width / 16 * (width / 16) + slot % width / 16] += ink;
        }
        sums
    };
    let (a, b) = (squares(file), squares(frame));
    let total: f64 = b.iter().sum();
    let off: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum();
    (a.iter().sum::<f64>() / total, off / total)
}

fn lays() -> Vec<(&'static str, Images)> {
    let with = |change: fn(&mut Stamps)| {
        let mut stamps = DENSE;
        change(&mut stamps);
        Images::Stamps(stamps)
    };
    vec![
        ("dense", with(|_| {})),
        ("beads", with(|s| s.spacing_px = 16.0)),
        (
            "held",
            with(|s| (s.rakes, s.turn, s.is_round) = (false, 0.0, false)),
        ),
        ("scattered", with(|s| (s.scatter, s.size) = (0.6, 0.5))),
        ("ribbon", Images::ByLength(40.0)),
        ("once", Images::Once),
    ]
}

/// Chance decides where gaps lie, so single pixels differ; ink as a whole, and about every place, does not. Of stamps
/// that overlap the grain of the paper is its mean, and strokes bend, which a straight row does not know.
#[test]
fn files_have_the_ink_of_frames() {
    let drawing = drawing();
    for grain in [0.0, 0.6] {
        for (name, images) in lays() {
            let brushes = brushes(images, grain);
            let frame = of_frame(&drawing, &brushes);
            let file = of_file(&drawing, &options(&brushes));
            let (ink, off) = compared(&file, &frame);
            assert!(
                (ink - 1.0).abs() < 0.03,
                "{name} {grain}: {ink} times the ink"
            );
            assert!(off < 0.06, "{name} {grain}: {off} lies elsewhere");
        }
    }
}

/// The pixels of our own drawing are those of the SVG file, and the PDF file has the same stamps.
#[test]
fn all_formats_hold_the_same_stamps() {
    let drawing = drawing();
    for (name, images) in lays() {
        let brushes = brushes(images, 0.3);
        let options = options(&brushes);
        let file: f64 = of_file(&drawing, &options).iter().sum();
        let rgba = rasterise(&drawing, &options);
        let own: f64 = rgba
            .chunks(4)
            .map(|pixel| f64::from(pixel[3]) / 255.0)
            .sum();
        assert!((own / file - 1.0).abs() < 0.01, "{name}: {own} {file}");

        let artwork = arrange(&drawing, &options);
        let marks = artwork.layers.iter().flat_map(|layer| &layer.groups);
        let marks: Vec<_> = marks.flat_map(|group| &group.marks).collect();
        assert!(marks.len() > 20 && artwork.images.len() > 2, "{name}");
        let pdf = write_pdf(&drawing, &options);
        let pdf = String::from_utf8_lossy(&pdf);
        assert_eq!(pdf.matches(" Do\n").count(), marks.len(), "{name}");
        assert_eq!(
            pdf.matches("/SMask ").count(),
            artwork.images.len(),
            "{name}"
        );
    }
}

/// Every image stands once and is used; the stamps of a stroke stand in a group with its id.
#[test]
fn svg_files_hold_every_image_once() {
    let drawing = drawing();
    for (name, images) in lays() {
        let svg = write_svg(&drawing, &options(&brushes(images, 0.3)));
        let svg = String::from_utf8(svg).unwrap();
        let count = svg.matches("<image ").count();
        assert!((2..=384).contains(&count), "{name}: {count} images");
        for number in 0..count {
            let used = format!("\"#stamp-{number}\"");
            assert!(svg.contains(&used), "{name}: image {number} is not used");
        }
        assert!(!svg.contains(&format!("\"#stamp-{count}\"")));
        for id in [11, 12, 13] {
            assert_eq!(
                svg.matches(&format!("<g data-id=\"{id}\">")).count(),
                1,
                "{name}"
            );
        }
        assert_eq!(
            svg,
            String::from_utf8(write_svg(&drawing, &options(&brushes(images, 0.3)))).unwrap()
        );
    }
}

/// What no brush draws stays what it is: a stroke of a pen, and a hidden one.
#[test]
fn pens_and_hidden_lines_stay_outlines() {
    let drawing = drawing();
    let pen = ArtworkOptions {
        paths: Paths::Stamps,
        ..ArtworkOptions::default()
    };
    let outline = write_svg(&drawing, &ArtworkOptions::default());
    assert_eq!(write_svg(&drawing, &pen), outline);

    let mut mixed = drawing;
    mixed.strokes[1].surface = 1;
    mixed.surfaces.push(StrokeSurface::default());
    let artwork = arrange(&mixed, &options(&brushes(Images::ByLength(40.0), 0.0)));
    let marks = artwork.layers.iter().flat_map(|layer| &layer.groups);
    for mark in marks.flat_map(|group| &group.marks) {
        let is_stamp = matches!(mark.paint, Paint::Image(_));
        assert_eq!(is_stamp, mark.stroke != Some(12));
    }
}

/// A million stamps are counted, and none is made.
#[test]
fn too_many_stamps_are_counted_and_not_made() {
    let mut drawing = drawing();
    let ring = drawing.strokes[2].clone();
    let crowded = Stamps {
        spacing_px: 0.3,
        ..DENSE
    };
    let crowded = brushes(Images::Stamps(crowded), 0.0);
    drawing.strokes = vec![ring; 1100];
    assert!(stamp_count(&drawing, &crowded) > STAMPS_LIMIT);
    let artwork = arrange(&drawing, &options(&crowded));
    assert!(artwork.images.is_empty());
    drawing.strokes.truncate(20);
    assert!(stamp_count(&drawing, &crowded) < 30_000);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The count is never less than what is made, and whatever numbers hold, files are finite and can be read.
    #[test]
    fn counts_bound_what_is_made(
        places in prop::collection::vec([-500f64..900.0, -500f64..900.0, 0f64..60.0], 0..7),
        choice in 0usize..6, closed: bool, u: f64,
    ) {
        let points = places.iter().map(|[x, y, width]| StrokePoint {
            position: [*x, *y],
            width: *width,
            u,
            ..StrokePoint::default()
        });
        let mut drawing = drawing();
        drawing.strokes.truncate(1);
        drawing.strokes[0].points = points.collect();
        drawing.strokes[0].closed = closed;
        let brushes = brushes(lays()[choice].1, 0.0);
        let options = options(&brushes);
        let made = write_svg(&drawing, &options);
        let made = String::from_utf8(made).unwrap();
        let stamps = made.matches("<use ").count() as u64;
        prop_assert!(stamps <= stamp_count(&drawing, &brushes));
        prop_assert!(usvg::Tree::from_str(&made, &usvg::Options::default()).is_ok());
    }
}
