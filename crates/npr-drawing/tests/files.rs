//! Drawings written to files: what other programs make of them.

use npr_drawing::artwork::{ArtworkOptions, Hidden, Page, Paths};
use npr_drawing::drawing::rasterise;
use npr_drawing::json::{read_json, write_json};
use npr_drawing::pdf::write_pdf;
use npr_drawing::svg::write_svg;
use npr_vector::stroke::{Drawing, Kind, Region, Stroke, StrokePoint, StrokeSurface};
use resvg::{tiny_skia, usvg};

const WHITE: Option<[u8; 4]> = Some([255; 4]);

fn point([x, y]: [f64; 2], width: f64) -> StrokePoint {
    StrokePoint {
        position: [x, y],
        depth: 3.0,
        width,
        u: 0.0,
        world: [x as f32, y as f32, 0.0],
        ..StrokePoint::default()
    }
}

fn stroke(id: u64, kind: Kind, surface: u32, closed: bool, points: Vec<StrokePoint>) -> Stroke {
    Stroke {
        id,
        kind,
        occluders: 0,
        surface,
        closed,
        part: None,
        points,
    }
}

fn surface(object: &str, number: u32, line: [u8; 4], fill: [u8; 4]) -> StrokeSurface {
    StrokeSurface {
        object: object.into(),
        object_number: number,
        material: "m".into(),
        line_color: line,
        fill_color: fill,
    }
}

/// A point on a circle, `turn` times round it.
fn on_circle(center: [f64; 2], radius: f64, turn: f64) -> [f64; 2] {
    let angle = (turn * std::f64::consts::TAU) as f32;
    let (sin, cos) = (npr_core::math::sin(angle), npr_core::math::cos(angle));
    [
        center[0] + radius * f64::from(cos),
        center[1] + radius * f64::from(sin),
    ]
}

/// Lines of every temper: tapers, thick zigzags, tight curls, rings, even and hidden lines, over two fills.
fn sampler() -> Drawing {
    let taper = (0..=120).map(|i| {
        let t = f64::from(i) / 120.0;
        let [_, wave] = on_circle([0.0; 2], 14.0, 1.5 * t);
        point([20.0 + 200.0 * t, 40.0 + wave], 10.0 * t * (1.0 - t) * 4.0)
    });
    let zigzag = [
        [20.0, 100.0],
        [60.0, 70.0],
        [64.0, 110.0],
        [100.0, 72.0],
        [90.0, 112.0],
        [150.0, 80.0],
    ];
    let zigzag = zigzag
        .into_iter()
        .enumerate()
        .map(|(i, p)| point(p, 5.0 + 2.0 * i as f64));
    let curl = (0..90).map(|i| {
        let t = f64::from(i) / 90.0;
        point(
            on_circle([200.0, 100.0], 3.0 + 22.0 * t, 2.5 * t),
            3.0 + 5.0 * t,
        )
    });
    let ring = (0..80).map(|i| {
        let t = f64::from(i) / 80.0;
        let [swell, _] = on_circle([0.0; 2], 2.5, 2.0 * t);
        point(on_circle([60.0, 180.0], 35.0, t), 4.0 + swell)
    });
    let even = (0..60).map(|i| point(on_circle([160.0, 180.0], 30.0, f64::from(i) / 80.0), 3.0));
    let dense_corner = (0..80).map(|i| {
        let t = f64::from(i);
        point(
            if i < 40 {
                [200.0 + t, 150.0]
            } else {
                [240.0, 110.0 + t]
            },
            6.0 + 0.02 * t,
        )
    });
    let back = (0..50).map(|i| point([15.0 + 4.5 * f64::from(i), 215.0], 2.0));
    let mut hidden = stroke(7, Kind::Contour, 0, false, back.collect());
    hidden.occluders = 2;
    let square = |x: f64, y: f64, side: f64| {
        vec![[x, y], [x + side, y], [x + side, y + side], [x, y + side]]
    };
    Drawing {
        size: [256, 232],
        surfaces: vec![
            surface("Body", 0, [20, 20, 30, 255], [250, 220, 170, 255]),
            surface("Glass", 1, [150, 30, 30, 200], [170, 210, 250, 255]),
        ],
        strokes: vec![
            stroke(1, Kind::Contour, 0, false, taper.collect()),
            stroke(2, Kind::Crease, 1, false, zigzag.collect()),
            stroke(3, Kind::Contour, 0, false, curl.collect()),
            stroke(4, Kind::Boundary, 0, true, ring.collect()),
            stroke(5, Kind::Crease, 0, false, even.collect()),
            stroke(6, Kind::Contour, 1, false, dense_corner.collect()),
            hidden,
        ],
        regions: vec![
            Region {
                surface: 0,
                rings: vec![square(10.0, 130.0, 100.0), square(40.0, 160.0, 40.0)],
            },
            Region {
                surface: 1,
                rings: vec![square(110.0, 130.0, 100.0)],
            },
        ],
        ..Drawing::default()
    }
}

fn options(paths: Paths, hidden: Hidden) -> ArtworkOptions {
    ArtworkOptions {
        paths,
        hidden,
        background: WHITE,
        ..ArtworkOptions::default()
    }
}

fn text(drawing: &Drawing, options: &ArtworkOptions) -> String {
    String::from_utf8(write_svg(drawing, options)).expect("UTF-8")
}

/// What resvg draws, as straight RGBA.
fn render(svg: &str) -> (u32, u32, Vec<u8>) {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).expect("an SVG file");
    let size = tree.size().to_int_size();
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height()).expect("pixels");
    resvg::render(
        &tree,
        tiny_skia::Transform::identity(),
        &mut pixels.as_mut(),
    );
    let straight = pixels.pixels().iter().flat_map(|p| {
        let c = p.demultiply();
        [c.red(), c.green(), c.blue(), c.alpha()]
    });
    (size.width(), size.height(), straight.collect())
}

/// Mean difference, and the greatest mean of an 8 by 8 block, out of 255.
fn difference(a: &[u8], b: &[u8], width: usize) -> [f64; 2] {
    assert_eq!(a.len(), b.len());
    let height = a.len() / 4 / width;
    let at = |x: usize, y: usize| -> f64 {
        let i = 4 * (y * width + x);
        (i..i + 4)
            .map(|k| f64::from(a[k].abs_diff(b[k])))
            .sum::<f64>()
            / 4.0
    };
    let mut worst = 0.0_f64;
    let mut sum = 0.0;
    for y in 0..height {
        for x in 0..width {
            sum += at(x, y);
            if x % 8 == 0 && y % 8 == 0 && x + 8 <= width && y + 8 <= height {
                let block: f64 = (0..64).map(|k| at(x + k % 8, y + k / 8)).sum();
                worst = worst.max(block / 64.0);
            }
        }
    }
    [sum / (width * height) as f64, worst]
}

#[test]
fn other_renderers_draw_what_we_draw() {
    let drawing = sampler();
    for paths in [Paths::Outline, Paths::Centreline] {
        for hidden in [Hidden::None, Hidden::Layer, Hidden::Dashed] {
            let options = options(paths, hidden);
            let (width, height, theirs) = render(&text(&drawing, &options));
            assert_eq!([width, height], drawing.size);
            let [mean, worst] = difference(&theirs, &rasterise(&drawing, &options), width as usize);
            assert!(
                mean < 0.2 && worst < 4.0,
                "{paths:?} {hidden:?}: mean {mean}, worst {worst}"
            );
        }
    }
}

#[test]
fn layers_groups_and_ids_are_as_promised() {
    let svg = text(&sampler(), &options(Paths::Outline, Hidden::Layer));
    let document = usvg::roxmltree::Document::parse(&svg).expect("XML");
    let root = document.root_element();
    let layers: Vec<&str> = root
        .children()
        .filter(|n| n.has_tag_name(("http://www.w3.org/2000/svg", "g")))
        .filter_map(|n| n.attribute("id"))
        .collect();
    assert_eq!(
        layers,
        ["fills", "hidden-contour", "contour", "boundary", "crease"]
    );
    let mut ids: Vec<&str> = document
        .descendants()
        .filter_map(|n| n.attribute("id"))
        .collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "ids are unique");
    let strokes: Vec<&str> = document
        .descendants()
        .filter_map(|n| n.attribute("data-id"))
        .collect();
    assert_eq!(strokes, ["7", "1", "3", "6", "4", "2", "5"]);
}

#[test]
fn even_lines_are_strokes_and_others_outlines() {
    let count = |paths, part| {
        text(&sampler(), &options(paths, Hidden::None))
            .matches(part)
            .count()
    };
    assert_eq!(count(Paths::Outline, "stroke-width=\"3\""), 1);
    assert_eq!(count(Paths::Outline, "fill=\"none\""), 1);
    assert_eq!(count(Paths::Centreline, "fill=\"none\""), 6);
}

#[test]
fn same_drawing_same_bytes() {
    let options = options(Paths::Centreline, Hidden::Dashed);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        pool.install(|| {
            let drawing = sampler();
            [
                write_svg(&drawing, &options),
                write_pdf(&drawing, &options),
                write_json(&drawing),
                rasterise(&drawing, &options),
            ]
        })
    };
    let first = run(1);
    assert!(run(2) == first && run(8) == first);
}

#[test]
fn hostile_names_stay_names() {
    let long = "n".repeat(100_000);
    let names = [
        "\"'<>&",
        "]]>",
        "--><script>alert(1)</script>",
        "\u{0}\u{1}\u{1b}[31m\u{7f}",
        "\u{202e}gpj.exe\u{2066}",
        "../../etc/passwd",
        "%n!s",
        "",
        "日本語 🎨",
        "\u{fffe}\u{ffff}\u{10ffff}",
        "a\nb\tc\r",
        &long,
    ];
    let mut drawing = sampler();
    drawing.surfaces = names
        .iter()
        .zip(0..)
        .map(|(name, n)| surface(name, n, [0, 0, 0, 255], [9, 9, 9, 255]))
        .collect();
    let pattern = drawing.strokes[4].clone();
    drawing.strokes = (0..names.len() as u32)
        .map(|surface| Stroke {
            surface,
            ..pattern.clone()
        })
        .collect();
    let svg = text(&drawing, &options(Paths::Outline, Hidden::None));
    let document = usvg::roxmltree::Document::parse(&svg).expect("XML");
    let tags = ["svg", "rect", "g", "path"];
    assert!(
        document
            .descendants()
            .filter(|n| n.is_element())
            .all(|n| tags.contains(&n.tag_name().name()))
    );
    let labels: Vec<&str> = document
        .descendants()
        .filter(|n| {
            n.attribute("id")
                .is_some_and(|id| id.starts_with("crease-"))
        })
        .map(|n| {
            n.attributes()
                .find(|a| a.name() == "label")
                .map_or("", |a| a.value())
        })
        .collect();
    assert_eq!(labels.len(), names.len());
    assert!(labels.contains(&"--><script>alert(1)</script>") && labels.contains(&"日本語 🎨"));
    let mut reader = quick_xml::Reader::from_str(&svg);
    while reader.read_event().expect("well-formed") != quick_xml::events::Event::Eof {}
    let back = read_json(&write_json(&drawing)).expect("JSON");
    assert_eq!(
        back.surfaces
            .iter()
            .map(|s| s.object.as_str())
            .collect::<Vec<_>>(),
        names
    );
    assert!(write_pdf(&drawing, &options(Paths::Outline, Hidden::None)).starts_with(b"%PDF-"));
}

#[test]
fn little_or_nothing_makes_sound_files() {
    let lone = |points: Vec<StrokePoint>| stroke(1, Kind::Contour, 0, false, points);
    let nothing = Drawing {
        size: [40, 30],
        ..Drawing::default()
    };
    let leftovers = Drawing {
        strokes: vec![
            lone(Vec::new()),
            lone(vec![point([5.0, 5.0], 2.0)]),
            lone(vec![point([5.0, 5.0], 2.0); 3]),
        ],
        ..nothing.clone()
    };
    for drawing in [&nothing, &leftovers] {
        for paths in [Paths::Outline, Paths::Centreline] {
            let svg = text(drawing, &options(paths, Hidden::Layer));
            assert!(!svg.contains("<g") && !svg.contains("<path"), "{svg}");
            assert_eq!(
                render(&svg).2,
                rasterise(drawing, &options(paths, Hidden::Layer))
            );
            assert!(!write_pdf(drawing, &options(paths, Hidden::None)).is_empty());
        }
    }
    assert!(rasterise(&Drawing::default(), &ArtworkOptions::default()).is_empty());
    assert!(text(&Drawing::default(), &ArtworkOptions::default()).ends_with("</svg>\n"));
}

/// Every number in the values of `d` and of widths.
fn numbers(svg: &str) -> Vec<f64> {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).expect("an SVG file");
    let bounds = tree.root().abs_stroke_bounding_box();
    [bounds.left(), bounds.top(), bounds.right(), bounds.bottom()]
        .map(f64::from)
        .to_vec()
}

#[test]
fn strokes_far_outside_are_cut() {
    let far = |x: f64| {
        vec![
            point([50.0, 50.0], 4.0),
            point([x, 60.0], 5.0),
            point([60.0, -x], 6.0),
        ]
    };
    let drawing = Drawing {
        size: [100, 100],
        surfaces: vec![surface("a", 0, [0, 0, 0, 255], [1, 2, 3, 255])],
        strokes: [300.0, 1e7, 1e30, f64::INFINITY, f64::NAN]
            .iter()
            .flat_map(|x| [false, true].map(|closed| stroke(1, Kind::Crease, 0, closed, far(*x))))
            .collect(),
        regions: vec![Region {
            surface: 0,
            rings: vec![vec![[-1e9, -1e9], [1e9, -1e9], [50.0, 1e12]]],
        }],
        ..Drawing::default()
    };
    for paths in [Paths::Outline, Paths::Centreline] {
        let svg = text(&drawing, &options(paths, Hidden::None));
        assert!(!svg.contains("NaN") && !svg.contains("inf") && !svg.contains("-0 "));
        assert!(
            numbers(&svg).iter().all(|v| (-8.0..=108.0).contains(v)),
            "{:?}",
            numbers(&svg)
        );
    }
}

#[test]
fn pages_hold_the_picture_in_millimetres() {
    let page = Page::parse("a4");
    for size in [[256, 232], [200, 400]] {
        let drawing = Drawing { size, ..sampler() };
        let options = ArtworkOptions {
            page,
            ..options(Paths::Centreline, Hidden::None)
        };
        let svg = text(&drawing, &options);
        let wide = size[0] > size[1];
        let head = if wide {
            "width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\""
        } else {
            "width=\"210mm\" height=\"297mm\""
        };
        assert!(svg.contains(head), "{}", &svg[..300]);
        let document = usvg::roxmltree::Document::parse(&svg).expect("XML");
        let widths = document
            .descendants()
            .filter_map(|n| n.attribute("stroke-width"));
        assert!(
            widths
                .map(|w| w.parse::<f64>().expect("a number"))
                .all(|w| w > 0.3 && w < 20.0)
        );
        let pdf = String::from_utf8_lossy(&write_pdf(&drawing, &options)).into_owned();
        assert!(
            pdf.contains(if wide { "[0 0 841.8" } else { "[0 0 595.2" }),
            "{}",
            &pdf[..900]
        );
    }
}

#[test]
fn pdf_lists_its_layers() {
    let pdf = write_pdf(&sampler(), &options(Paths::Outline, Hidden::Layer));
    let pdf = String::from_utf8_lossy(&pdf);
    for part in [
        "/OCProperties",
        "(hidden-contour)",
        "(Glass)",
        "/OC /L",
        "startxref",
    ] {
        assert!(pdf.contains(part), "{part}");
    }
    assert!(!pdf.contains("NaN") && !pdf.contains("inf") && !pdf.contains("CreationDate"));
}

/// Writes pictures for looking at into a folder: `NPR_PICTURES=folder cargo test -p npr-vector --test files --
/// --ignored`.
#[test]
#[ignore = "writes files for the eye"]
fn pictures_for_the_eye() {
    let Some(folder) = std::env::var_os("NPR_PICTURES").map(std::path::PathBuf::from) else {
        return;
    };
    let drawing = sampler();
    for (name, paths, hidden) in [
        ("outline", Paths::Outline, Hidden::Dashed),
        ("centreline", Paths::Centreline, Hidden::Layer),
    ] {
        let svg = text(&drawing, &options(paths, hidden));
        let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).expect("an SVG file");
        let scale = 4.0;
        let mut pixels = tiny_skia::Pixmap::new(1024, 928).expect("pixels");
        resvg::render(
            &tree,
            tiny_skia::Transform::from_scale(scale, scale),
            &mut pixels.as_mut(),
        );
        pixels
            .save_png(folder.join(format!("{name}.png")))
            .expect("written");
        let pdf = write_pdf(&drawing, &options(paths, hidden));
        use std::io::Write;
        for (end, bytes) in [("svg", svg.as_bytes()), ("pdf", &pdf)] {
            let mut file = std::fs::OpenOptions::new()
                .write(true)
                .create(true)
                .truncate(true)
                .open(folder.join(format!("{name}.{end}")))
                .expect("opened");
            file.write_all(bytes).expect("written");
        }
    }
}
