use super::*;
use proptest::prelude::*;

/// No tapers, no specks.
const EVEN: PartWidth = PartWidth {
    along: [[1.0; 4]; 8],
    taper_px: [0.0; 2],
    taper_share: 0.5,
    tip: 0.0,
    short_px: 0.0,
    speck_px: 0.0,
    at_all_ends: 0,
    radius: 0,
};

fn view() -> View {
    View {
        perspective: 1.0,
        near: 0.5,
        ..View::default()
    }
}

/// Lines of a number of pairs of samples each, a pixel apart, line `k` at height `k`.
fn lines(pairs: &[u32]) -> (Vec<SampledLine>, Vec<SpineSample>) {
    let (mut lines, mut samples) = (Vec::new(), Vec::new());
    for (line, pairs) in (0..).zip(pairs) {
        lines.push(SampledLine {
            first: samples.len() as u32,
            count: 2 * pairs,
            step_px: 1.0,
            full_half_width: 2.0,
            bits: SampledLine::START_FREE | SampledLine::END_FREE,
            ..SampledLine::default()
        });
        samples.extend((0..2 * pairs).map(|i| SpineSample {
            px: [i as f32, line as f32],
            line,
            depth: 1.0,
            half_width: 2.0,
            color: 0xff00_0000,
            ..SpineSample::default()
        }));
    }
    (lines, samples)
}

fn inked_with(
    width: &PartWidth,
    lines: &[SampledLine],
    samples: &[SpineSample],
    visible: &[u32],
) -> Vec<InkPoint> {
    inked(
        (&view(), &[*width]),
        lines,
        (samples, &vec![0.0; samples.len()]),
        visible,
    )
}

/// The rows of points that strokes run through.
fn rows(points: &[InkPoint]) -> Vec<Vec<[f32; 2]>> {
    let mut rows: Vec<Vec<[f32; 2]>> = Vec::new();
    let mut goes_on = false;
    for point in points {
        if goes_on {
            rows.last_mut().expect("begun").push(point.px);
        } else if point.goes_on() {
            rows.push(vec![point.px]);
        }
        goes_on = point.goes_on();
    }
    rows
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Every visible part of three samples and more becomes a stroke from its first sample to its last, in steps of at
    /// most three; nothing else is drawn.
    #[test]
    fn strokes_are_the_visible_parts(
        pairs in prop::collection::vec(1u32..12, 1..5), seen in prop::collection::vec(any::<bool>(), 96),
    ) {
        let (lines, samples) = lines(&pairs);
        let visible: Vec<u32> = seen.iter().take(samples.len()).map(|seen| u32::from(*seen)).collect();
        let points = inked_with(&EVEN, &lines, &samples, &visible);
        let found = rows(&points);

        // Walk along every line.
        let mut wanted: Vec<[[f32; 2]; 2]> = Vec::new();
        for line in &lines {
            let range = line.first as usize..(line.first + line.count) as usize;
            let numbered: Vec<usize> = range.collect();
            for part in numbered.chunk_by(|a, b| visible[*a] == visible[*b]) {
                if visible[part[0]] != 0 && part.len() > 2 {
                    wanted.push([samples[part[0]].px, samples[part[part.len() - 1]].px]);
                }
            }
        }
        let long = |row: &&Vec<[f32; 2]>| row[row.len() - 1][0] - row[0][0] >= 2.0;
        let ends: Vec<[[f32; 2]; 2]> = found.iter().filter(long).map(|row| [row[0], row[row.len() - 1]]).collect();
        prop_assert_eq!(ends, wanted);
        for pair in found.iter().flat_map(|row| row.windows(2)) {
            prop_assert!(pair[1][0] - pair[0][0] <= 3.0 && pair[0][1] == pair[1][1]);
        }
    }
}

/// Half widths of the points of one line, `samples` long and seen in a range, with gaps of a size where it is hidden.
fn half_widths(width: &PartWidth, seen: std::ops::Range<usize>, gap: f32, bits: u32) -> Vec<f32> {
    let (mut lines, samples) = lines(&[40]);
    lines[0].bits = bits;
    let visible: Vec<u32> = (0..80).map(|i| u32::from(seen.contains(&i))).collect();
    let gaps: Vec<f32> = visible
        .iter()
        .map(|seen| if *seen == 0 { gap } else { 0.0 })
        .collect();
    let points = inked((&view(), &[*width]), &lines, (&samples, &gaps), &visible);
    points.iter().map(|point| point.half_width).collect()
}

const TAPERED: PartWidth = PartWidth {
    taper_px: [20.0; 2],
    ..EVEN
};

#[test]
fn every_line_takes_its_own_width() {
    let (mut lines, samples) = lines(&[20, 20]);
    lines[1].bits = 1 << SampledLine::WIDTH_SHIFT;
    let half = PartWidth {
        along: [[0.5; 4]; 8],
        ..EVEN
    };
    let gaps = vec![0.0; samples.len()];
    let seen = vec![1; samples.len()];
    let points = inked((&view(), &[EVEN, half]), &lines, (&samples, &gaps), &seen);
    let widths: Vec<f32> = points.iter().map(|point| point.half_width).collect();
    assert_eq!(widths, [[2.0; 20], [1.0; 20]].concat());
}

#[test]
fn free_ends_thin_out_and_others_do_not() {
    const FREE: u32 = SampledLine::START_FREE | SampledLine::END_FREE;
    let all = half_widths(&TAPERED, 0..80, 0.0, FREE);
    assert!(all[0] == 0.0 && all[3] < 1.5 && all[20] == 2.0 && all[39] < 0.3);
    let met = half_widths(&TAPERED, 0..80, 0.0, 0);
    assert_eq!(met, [2.0; 40]);
    let one = half_widths(&TAPERED, 0..80, 0.0, SampledLine::END_FREE);
    assert!(one[0] == 2.0 && one[39] < 0.3);

    // Where a line goes behind something it meets that one's outline; at a cusp it meets nothing.
    let junction = half_widths(&TAPERED, 0..60, 2.0 * JUNCTION, FREE);
    let cusp = half_widths(&TAPERED, 0..60, 0.5 * JUNCTION, FREE);
    assert!(
        junction[29] == 2.0 && cusp[29] < 0.3,
        "{junction:?} {cusp:?}"
    );
    assert_eq!(junction[30..], [0.0; 10]);
    let both = PartWidth {
        at_all_ends: 1,
        ..TAPERED
    };
    assert!(half_widths(&both, 0..60, 2.0 * JUNCTION, 0)[29] < 0.3);
}

#[test]
fn rings_have_no_ends_and_specks_are_gone() {
    let ring = SampledLine::CLOSED;
    assert_eq!(half_widths(&TAPERED, 0..80, 0.0, ring), [2.0; 40]);
    let specks = PartWidth {
        speck_px: 8.0,
        ..EVEN
    };
    assert_eq!(half_widths(&specks, 10..18, 0.0, 0), [0.0; 40]);
    assert!(half_widths(&specks, 10..24, 0.0, 0).contains(&2.0));
    let short = PartWidth {
        short_px: 40.0,
        ..EVEN
    };
    let thin = half_widths(&short, 0..31, 0.0, SampledLine::START_FREE);
    assert_eq!(thin[4], 1.0, "half of 2, at three quarters of the length");
}

#[test]
fn pressure_goes_from_one_end_of_a_part_to_the_other() {
    let rising = std::array::from_fn(|i| std::array::from_fn(|j| (4 * i + j) as f32 / 31.0));
    let pressed = PartWidth {
        along: rising,
        ..EVEN
    };
    let widths = half_widths(&pressed, 20..61, 0.0, 0);
    assert!((widths[20] - 2.0 * 20.0 / 40.0).abs() < 0.01, "{widths:?}");
}

#[test]
fn an_image_lies_by_length_or_once_over_a_part() {
    let (mut lines, samples) = lines(&[20]);
    lines[0].u_start = 0.25;
    lines[0].u_per_px = 0.1;
    lines[0].ink_flags = 3 << InkPoint::BRUSH_SHIFT;
    let visible: Vec<u32> = (0..40).map(|i| u32::from(i >= 10)).collect();
    let points = inked_with(&EVEN, &lines, &samples, &visible);
    assert!(
        (points[8].u - (0.25 + 1.6)).abs() < 1e-5 && points[8].flags >> InkPoint::BRUSH_SHIFT == 3
    );
    lines[0].bits |= SampledLine::ONCE;
    let points = inked_with(&EVEN, &lines, &samples, &visible);
    assert!(points[5].u == 0.0 && (points[19].u - 1.0).abs() < 1e-5);
}

#[test]
fn samples_without_width_draw_nothing() {
    let (lines, mut samples) = lines(&[8]);
    samples
        .iter_mut()
        .for_each(|sample| sample.half_width = 0.0);
    let points = inked_with(&EVEN, &lines, &samples, &[1; 16]);
    assert_eq!(points, [InkPoint::default(); 8]);
    assert!(inked_with(&EVEN, &[], &[], &[]).is_empty());
}
