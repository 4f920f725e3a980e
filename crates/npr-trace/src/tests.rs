mod colors;
mod oracle;

use super::*;
use oracle::{best_polygon, decompose_slowly, holds, is_straight, penalty, stretch};
use proptest::prelude::*;

/// A tracing as the bytes of a file.
fn file_of(tracing: &Tracing, format: TraceFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    write_tracing(tracing, format, &mut bytes).expect("memory");
    bytes
}

/// A bitmap as the bytes of a file.
fn traced(bitmap: &Bitmap, options: &TraceOptions, format: TraceFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    trace_to_file(bitmap, options, format, &mut bytes).expect("memory");
    bytes
}

/// A bitmap from rows of text, `#` for ink.
fn drawn(rows: &[&str]) -> Bitmap {
    let width = rows.first().map_or(0, |row| row.len());
    let mut bitmap = Bitmap::new(width as u32, rows.len() as u32).expect("small");
    for (y, row) in (0..).zip(rows) {
        for (x, mark) in (0..).zip(row.bytes()) {
            bitmap.set(x, y, mark == b'#');
        }
    }
    bitmap
}

/// Any small bitmap: from nearly white to nearly black, single pixels or blocks of them.
fn bitmaps() -> impl Strategy<Value = Bitmap> {
    (1u32..24, 1u32..20, 0u8..=100, 1u32..4, any::<u32>()).prop_map(
        |(width, height, percent, block, seed)| {
            let mut bitmap = Bitmap::new(width, height).expect("small");
            for (x, y) in (0..width * height).map(|i| (i % width, i / width)) {
                let place = (x / block) << 16 | (y / block);
                let number = npr_core::math::mix_bits(place ^ npr_core::math::mix_bits(seed));
                bitmap.set(x, y, number % 100 < u32::from(percent));
            }
            bitmap
        },
    )
}

/// Twice the signed area of a closed curve, by many short chords.
fn doubled_area(segments: &[Segment]) -> f64 {
    let mut area = 0.0;
    let mut at = segments.last().map_or(DVec2::ZERO, Segment::end);
    for segment in segments {
        for place in places(at, segment) {
            area += at.perp_dot(place);
            at = place;
        }
    }
    area
}

fn places(start: DVec2, segment: &Segment) -> Vec<DVec2> {
    match *segment {
        Segment::Corner { corner, end } => vec![corner, end],
        Segment::Arc { from, to, end } => (1..=64)
            .map(|i| {
                let (t, s) = (f64::from(i) / 64.0, 1.0 - f64::from(i) / 64.0);
                start * (s * s * s)
                    + from * (3.0 * s * s * t)
                    + to * (3.0 * s * t * t)
                    + end * (t * t * t)
            })
            .collect(),
    }
}

/// A closed path of four digital lines, 300 steps or so each, every third corner of which may stick out by a step;
/// turned by quarters.
fn slanted(rise: i32, run: i32, jag: u32, turns: usize) -> Vec<u8> {
    let side: Vec<u8> = (1..=300)
        .flat_map(|i| {
            let height = |x: i32| (x * rise).div_euclid(run + rise.abs());
            let (up, sign) = (height(i) - height(i - 1), rise.signum());
            let climb = (0..up.abs()).map(move |_| if sign > 0 { 1u8 } else { 3 });
            let out = if jag > 0 && (i as u32).is_multiple_of(jag + 2) {
                [1u8, 0, 3].to_vec()
            } else {
                vec![0]
            };
            climb.chain(out)
        })
        .collect();
    (0..4u8)
        .flat_map(|quarter| {
            side.iter()
                .map(move |step| (step + quarter + turns as u8) & 3)
        })
        .collect()
}

#[test]
fn long_stretches_take_no_more_than_short_ones() {
    // The outline of a chequer whose white hangs together runs to and fro along the border, as straight as can be.
    let looks = |side: u32| {
        let crenels = |quarter: u8| {
            (0..side).flat_map(move |_| [0, 3, 0, 1].map(|step: u8| (step + quarter) & 3))
        };
        let steps: Vec<u8> = (0..4).flat_map(|quarter| crenels(4 - quarter)).collect();
        straight::measure(&steps, u32::MAX, &mut Vec::new()) as f64 / steps.len() as f64
    };
    let (short, long) = (looks(500), looks(8000));
    assert!(long < 2.0 * short, "{short} {long} looks a step");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn loops_are_those_of_the_paper(bitmap in bitmaps(), policy in 0usize..7, turd_size in 0u64..5) {
        let policy = TurnPolicy::ALL[policy];
        let slow: Vec<_> = decompose_slowly(&bitmap, policy)
            .into_iter()
            .map(|(is_ink, corners)| {
                let size = [bitmap.width() as i32, bitmap.height() as i32];
                let inside = (0..size[0] * size[1]).filter(|i| holds(&corners, [i % size[0], i / size[0]]));
                (is_ink, inside.count() as u64, corners)
            })
            .filter(|(_, area, _)| *area > turd_size)
            .collect();
        let fast: Vec<_> = decompose(&bitmap, policy, turd_size)
            .iter()
            .map(|l| (l.is_ink, l.area, l.corners().collect::<Vec<_>>()))
            .collect();
        prop_assert_eq!(fast, slow);
    }

    #[test]
    fn parents_are_the_innermost_around(bitmap in bitmaps(), turd_size in 0u64..5) {
        let loops = decompose(&bitmap, TurnPolicy::Minority, turd_size);
        let parents = nest([bitmap.width(), bitmap.height()], loops.iter());
        prop_assert_eq!(parents.len(), loops.len());
        let all: Vec<_> = loops.iter().map(|l| (l.area, l.corners().collect::<Vec<_>>())).collect();
        for (index, inner) in loops.iter().enumerate() {
            // The first pixel of a loop is inside it, and inside what is around it.
            let pixel = inner.start.map(|v| v as i32);
            let around = (0u32..).zip(&all).filter(|(i, (_, corners))| *i != index as u32 && holds(corners, pixel));
            let innermost = around.min_by_key(|(_, (area, _))| *area).map(|(i, _)| i);
            prop_assert_eq!(parents[index], innermost);
        }
    }

    #[test]
    fn straight_is_what_the_paper_defines(bitmap in bitmaps()) {
        for pixels in decompose(&bitmap, TurnPolicy::Minority, 0).iter().take(3) {
            let corners: Vec<_> = pixels.corners().collect();
            for (from, length) in straight_lengths(pixels.steps).into_iter().enumerate().take(60) {
                prop_assert!(is_straight(&stretch(&corners, from, length as usize)));
                prop_assert!(!is_straight(&stretch(&corners, from, length as usize + 1)));
            }
        }
    }

    #[test]
    fn limited_lengths_are_cut_off(bitmap in bitmaps(), limit in 0u32..12) {
        let mut limited = Vec::new();
        for pixels in decompose(&bitmap, TurnPolicy::Minority, 0).iter().take(3) {
            straight::measure(pixels.steps, limit, &mut limited);
            let cut: Vec<_> = straight_lengths(pixels.steps).into_iter().map(|length| length.min(limit)).collect();
            prop_assert_eq!(&limited, &cut);
        }
    }

    #[test]
    fn stretches_followed_by_hulls_are_those_walked(bitmap in bitmaps(), limit in 2u32..200, long_runs in 0usize..8) {
        let mut followed = Vec::new();
        for pixels in decompose(&bitmap, TurnPolicy::Majority, 0).iter().take(5) {
            straight::measure_from(pixels.steps, limit, long_runs, &mut followed);
            let mut walked = Vec::new();
            straight::measure_from(pixels.steps, limit, usize::MAX, &mut walked);
            prop_assert_eq!(&followed, &walked);
        }
    }

    #[test]
    fn long_stretches_are_followed_around_every_corner(
        rise in -40i32..40, run in 1i32..40, jag in 0u32..4, turns in 0usize..4,
    ) {
        let steps = slanted(rise, run, jag, turns);
        let (mut followed, mut walked) = (Vec::new(), Vec::new());
        straight::measure_from(&steps, u32::MAX, 4, &mut followed);
        straight::measure_from(&steps, u32::MAX, usize::MAX, &mut walked);
        prop_assert_eq!(followed, walked);
    }

    #[test]
    fn polygons_are_the_best(bitmap in bitmaps()) {
        for pixels in decompose(&bitmap, TurnPolicy::Black, 0).iter().filter(|l| l.steps.len() < 60).take(3) {
            let corners: Vec<_> = pixels.corners().collect();
            let polygon = optimal_polygon(&pixels);
            let ends = polygon.iter().skip(1).map(|i| *i as usize).chain([corners.len()]);
            let cost: f64 = polygon
                .iter()
                .zip(ends)
                .map(|(from, to)| penalty(&stretch(&corners, *from as usize, to - *from as usize)))
                .sum();
            let (sides, least) = best_polygon(&corners);
            prop_assert_eq!((polygon[0], polygon.len()), (0, sides));
            prop_assert!((cost - least).abs() <= 1e-9 * (1.0 + least), "{cost} {least}");
        }
    }

    #[test]
    fn no_place_nearby_is_nearer_to_both_lines(bitmap in bitmaps()) {
        for pixels in decompose(&bitmap, TurnPolicy::White, 2).iter().take(3) {
            let corners: Vec<_> = pixels.corners().map(|c| DVec2::new(f64::from(c[0]), f64::from(c[1]))).collect();
            let polygon = optimal_polygon(&pixels);
            let adjusted = adjust_corners(&pixels, &polygon);
            prop_assert_eq!(adjusted.len(), polygon.len());
            let line = |k: usize| {
                let from = polygon[k] as usize;
                let to = polygon.get(k + 1).map_or(corners.len(), |to| *to as usize);
                let side: Vec<_> = (from..=to).map(|i| corners[i % corners.len()]).collect();
                let middle = side.iter().sum::<DVec2>() / side.len() as f64;
                // The axis of least spread, by trying many.
                let spread = |n: &DVec2| side.iter().map(|p| n.dot(*p - middle).powi(2)).sum::<f64>();
                let axes = (0..720).map(|i| {
                    let angle = f64::from(i) * std::f64::consts::PI / 720.0;
                    DVec2::new(npr_core::math::cos_f64(angle), npr_core::math::sin_f64(angle))
                });
                let least = axes.clone().min_by(|a, b| spread(a).total_cmp(&spread(b))).expect("some");
                let most = axes.map(|axis| spread(&axis)).fold(0.0, f64::max);
                // Where the corners spread alike to all sides, no line fits better than another.
                (spread(&least) < 0.9 * most).then_some((middle, least))
            };
            for (k, place) in adjusted.iter().enumerate() {
                let lines = [line((k + polygon.len() - 1) % polygon.len()), line(k)];
                let [Some(before), Some(after)] = lines else { continue };
                let lines = [before, after];
                let away = |p: DVec2| lines.iter().map(|(m, n)| n.dot(p - *m).powi(2)).sum::<f64>();
                let corner = corners[polygon[k] as usize];
                prop_assert!((*place - corner).abs().max_element() <= 0.5);
                for i in 0..=10 {
                    for j in 0..=10 {
                        let other = corner + DVec2::new(f64::from(i), f64::from(j)) / 10.0 - 0.5;
                        prop_assert!(away(*place) <= away(other) + 0.02, "{place} {other}");
                    }
                }
            }
        }
    }

    #[test]
    fn joined_curves_are_shorter_lists_of_the_same_area(bitmap in bitmaps(), tolerance in 0.0..1.0f64) {
        for pixels in decompose(&bitmap, TurnPolicy::Minority, 2).iter().take(3) {
            let bends = bends(&adjust_corners(&pixels, &optimal_polygon(&pixels)), 1.0);
            let plain = curve(&bends);
            let joined = join_arcs(&bends, tolerance);
            prop_assert!(joined.len() <= plain.len());
            let area = doubled_area(&plain);
            prop_assert!((doubled_area(&joined) - area).abs() < 0.02 * (1.0 + area.abs()));
            let corners = |s: &[Segment]| s.iter().filter(|s| matches!(s, Segment::Corner { .. })).count();
            prop_assert_eq!(corners(&joined), corners(&plain));
            for segment in &joined {
                prop_assert!(plain.iter().any(|s| s.end().distance(segment.end()) < 1e-9));
            }
        }
    }

    #[test]
    fn curves_stay_near_their_paths(bitmap in bitmaps(), alpha_max in 0.0..1.4f64) {
        let options = TraceOptions { alpha_max, ..TraceOptions::default() };
        for path in trace(&bitmap, &options).paths {
            prop_assert!(!path.segments.is_empty());
            // Ink on the left, with y down: outlines turn one way, holes the other.
            let area = doubled_area(&path.segments) / 2.0;
            let size = if path.is_ink { -area } else { area };
            prop_assert!((size - path.area as f64).abs() <= 2.0 + 0.8 * path.area as f64, "{size} {}", path.area);
            for place in path.segments.iter().map(Segment::end) {
                let [w, h] = [bitmap.width(), bitmap.height()].map(f64::from);
                prop_assert!(place.cmpge(DVec2::splat(-0.5)).all() && place.x <= w + 0.5 && place.y <= h + 0.5);
            }
        }
    }

    #[test]
    fn paths_drawn_early_late_or_by_hand_give_the_same_files(bitmap in bitmaps(), early_steps in 0usize..200) {
        let options = TraceOptions { turd_size: 0, ..TraceOptions::default() };
        let tracing = trace(&bitmap, &options);
        for format in TraceFormat::ALL {
            let outlines = paths::Outlines::of(&bitmap, &options, format, early_steps);
            let mut bytes = Vec::new();
            file::write(&outlines, tracing.size, &options, format, &mut bytes).expect("memory");
            prop_assert!(bytes == file_of(&tracing, format), "{format:?}");
            prop_assert!(bytes == traced(&bitmap, &options, format), "{format:?}");
        }
    }

    #[test]
    fn threads_do_not_matter(bitmap in bitmaps()) {
        let options = TraceOptions::default();
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let one = pool(1).install(|| trace(&bitmap, &options));
        prop_assert_eq!(pool(3).install(|| trace(&bitmap, &options)), one);
        let file = |threads| pool(threads).install(|| traced(&bitmap, &options, TraceFormat::Svg));
        prop_assert_eq!(file(1), file(3));
    }
}

/// As many loops as a bitmap of 120x90 pixels can have.
fn chequer() -> Bitmap {
    let mut bitmap = Bitmap::new(120, 90).expect("small");
    for (x, y) in (0..120 * 90).map(|i| (i % 120, i / 120)) {
        bitmap.set(x, y, (x ^ y) & 1 == 0);
    }
    bitmap
}

#[test]
fn batches_are_numbered_through() {
    let bitmap = chequer();
    let loops = decompose(&bitmap, TurnPolicy::White, 0);
    let mut batches = Batches::default();
    let mut count = 0;
    for batch in Decomposition::new(&bitmap, TurnPolicy::White, 0) {
        batches.push(batch);
        count += 1;
    }
    assert!(count > 3 && batches.iter().eq(loops.iter()));
    assert_eq!(batches.len(), loops.len());
    assert_eq!(batches.step_count(), loops.step_count());
    for number in 0..=loops.len() {
        assert_eq!(batches.get(number), loops.get(number));
    }
}

#[test]
fn only_so_many_paths_are_held_as_text() {
    let bitmap = chequer();
    let options = TraceOptions {
        turd_size: 0,
        turn_policy: TurnPolicy::White,
        ..TraceOptions::default()
    };
    // All are squares of four steps; batches have some thousand.
    for early_steps in [0, 5000, 13_000, usize::MAX] {
        let outlines = paths::Outlines::of(&bitmap, &options, TraceFormat::Svg, early_steps);
        let drawn = (0..5400).filter(|number| paths::Paths::drawn(&outlines, *number).is_some());
        let (steps, all) = (4 * drawn.count(), 4 * 5400);
        assert!(
            steps <= early_steps && steps + 8000 > early_steps.min(all),
            "{steps} of {early_steps}"
        );
        assert_eq!(outlines.step_count(), all);
    }
}

#[test]
fn pages_say_where_everything_is() {
    let bitmap = drawn(&["###.", "#.#.", "####"]);
    let options = TraceOptions {
        turd_size: 0,
        ..TraceOptions::default()
    };
    let page = traced(&bitmap, &options, TraceFormat::Pdf);
    let text = String::from_utf8_lossy(&page).replace('\u{fffd}', "?");
    let after = |mark: &str| text.rsplit_once(mark).expect(mark).1;
    let table: usize = after("startxref\n")
        .lines()
        .next()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(text[table..].starts_with("xref\n0 6\n"));
    for (number, entry) in text[table..].lines().skip(3).take(5).enumerate() {
        let place: usize = entry[..10].parse().expect("a number");
        assert!(
            text[place..].starts_with(&format!("{} 0 obj\n", number + 1)),
            "{entry}"
        );
    }
    let (_, content) = text.split_once("stream\n").expect("content");
    let length: usize = after("5 0 obj\n")
        .lines()
        .next()
        .expect("a number")
        .parse()
        .expect("a number");
    assert!(content[length..].starts_with("\nendstream"));
    assert!(content.contains(" m\n") && content[..length].ends_with("f\n"));
}

/// Whether the middles of pixels are covered by a picture of the file.
fn rendered(svg: &[u8], size: [u32; 2]) -> Vec<bool> {
    let tree = resvg::usvg::Tree::from_data(svg, &resvg::usvg::Options::default()).expect("SVG");
    let mut canvas = tiny_skia::Pixmap::new(size[0], size[1]).expect("a canvas");
    resvg::render(
        &tree,
        tiny_skia::Transform::identity(),
        &mut canvas.as_mut(),
    );
    canvas
        .pixels()
        .iter()
        .map(|pixel| pixel.alpha() > 127)
        .collect()
}

#[test]
fn files_show_what_was_traced() {
    let rows = [
        "################....",
        "##............##....",
        "##.####.......##....",
        "##.#..#.......##....",
        "##.#..#.......##....",
        "##.####.......##....",
        "##............##....",
        "################....",
        "..................##",
        "..................##",
    ];
    let bitmap = drawn(&rows);
    let tracing = trace(
        &bitmap,
        &TraceOptions {
            alpha_max: 0.0,
            ..TraceOptions::default()
        },
    );
    assert_eq!(tracing.paths.len(), 5);
    let svg = file_of(&tracing, TraceFormat::Svg);
    let drawn_again = rendered(&svg, tracing.size);
    let ink = (0..10)
        .flat_map(|y| (0..20).map(move |x| (x, y)))
        .map(|(x, y)| bitmap.is_ink(x, y));
    assert!(drawn_again.into_iter().eq(ink));

    let geo: serde_json::Value =
        serde_json::from_slice(&file_of(&tracing, TraceFormat::GeoJson)).expect("JSON");
    let shapes = geo["features"].as_array().expect("a list");
    let rings = |f: &serde_json::Value| f["geometry"]["coordinates"].as_array().map_or(0, Vec::len);
    assert_eq!(shapes.iter().map(rings).collect::<Vec<_>>(), [2, 2, 1]);
    let ring = shapes[0]["geometry"]["coordinates"][0]
        .as_array()
        .expect("a list");
    assert_eq!(ring.first(), ring.last());

    let json: serde_json::Value =
        serde_json::from_slice(&file_of(&tracing, TraceFormat::Json)).expect("JSON");
    let parents: Vec<_> = json["paths"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|p| p["parent"].as_u64())
        .collect();
    assert_eq!(parents, [None, Some(0), Some(1), Some(2), None]);
    assert!(file_of(&tracing, TraceFormat::Pdf).starts_with(b"%PDF-"));
}

#[test]
fn nothing_gives_nothing() {
    for (width, height) in [(0, 0), (0, 5), (5, 0), (1, 1), (70, 3)] {
        let bitmap = Bitmap::new(width, height).expect("small");
        let tracing = trace(&bitmap, &TraceOptions::default());
        assert!(tracing.paths.is_empty() && tracing.size == [width, height]);
    }
}

#[test]
fn one_pixel_is_a_square_or_a_speck() {
    let bitmap = drawn(&["#"]);
    let options = TraceOptions {
        turd_size: 0,
        ..TraceOptions::default()
    };
    let tracing = trace(&bitmap, &options);
    assert_eq!(
        (tracing.paths.len(), tracing.paths[0].segments.len()),
        (1, 4)
    );
    assert!(trace(&bitmap, &TraceOptions::default()).paths.is_empty());
}

#[test]
fn touching_pixels_are_one_shape_or_two() {
    let bitmap = drawn(&["##..", "##..", "..##", "..##"]);
    for (policy, count) in [(TurnPolicy::Black, 1), (TurnPolicy::White, 2)] {
        assert_eq!(decompose(&bitmap, policy, 0).len(), count, "{policy:?}");
    }
}

#[test]
fn no_tolerance_joins_nothing_and_nonsense_does_not_hang() {
    let bitmap = drawn(&[".###.", "#####", "#####", "#####", ".###."]);
    for tolerance in [
        None,
        Some(0.0),
        Some(f64::NAN),
        Some(f64::INFINITY),
        Some(-1.0),
    ] {
        for alpha_max in [f64::NAN, -1.0, f64::INFINITY] {
            let options = TraceOptions {
                join_tolerance: tolerance,
                alpha_max,
                ..TraceOptions::default()
            };
            let tracing = trace(&bitmap, &options);
            assert_eq!(tracing.paths.len(), 1);
            let finite = |s: &Segment| s.end().is_finite();
            assert!(tracing.paths[0].segments.iter().all(finite));
        }
    }
}
