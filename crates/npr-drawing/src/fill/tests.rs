use super::*;
use npr_mesh::testing::Random;
use proptest::prelude::*;

type Segment = [[f64; 2]; 2];

fn ring(corners: &[[f64; 2]]) -> Vec<Segment> {
    let next = |i: usize| corners[(i + 1) % corners.len()];
    (0..corners.len()).map(|i| [corners[i], next(i)]).collect()
}

fn square(from: f64, to: f64) -> Vec<Segment> {
    ring(&[[from, from], [to, from], [to, to], [from, to]])
}

fn ring_area(ring: &[[f64; 2]]) -> f64 {
    let next = |i: usize| ring[(i + 1) % ring.len()];
    let doubled = (0..ring.len()).map(|i| ring[i][0] * next(i)[1] - ring[i][1] * next(i)[0]);
    doubled.sum::<f64>() / 2.0
}

fn region_area(region: &Region) -> f64 {
    region.rings.iter().map(|ring| ring_area(ring)).sum()
}

/// Every piece of a ring runs along another region's ring, the opposite way, or along nothing; and one outer ring.
fn check(regions: &[Region]) {
    let mut pieces = BTreeMap::new();
    for region in regions {
        for (index, ring) in region.rings.iter().enumerate() {
            assert!(ring.len() >= 3);
            assert_eq!(ring_area(ring) > 0.0, index == 0, "the outer ring first");
            for i in 0..ring.len() {
                let ends = [ring[i], ring[(i + 1) % ring.len()]];
                let key = ends.map(|p| p.map(|v| (v * FINENESS) as i64));
                assert!(pieces.insert(key, region.surface).is_none(), "used once");
            }
        }
    }
    for ([a, b], surface) in &pieces {
        let beyond = pieces.get(&[*b, *a]);
        assert_ne!(beyond, Some(surface), "equal neighbours are one");
    }
}

fn contains(region: &Region, [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for ring in &region.rings {
        for i in 0..ring.len() {
            let ([ax, ay], [bx, by]) = (ring[i], ring[(i + 1) % ring.len()]);
            if (ay > y) != (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay) {
                inside = !inside;
            }
        }
    }
    inside
}

#[test]
fn a_picture_without_lines_is_one_region_or_none() {
    let all = regions([4, 3], &[], &|_| Some(7)).unwrap();
    assert_eq!(all.len(), 1);
    assert_eq!(all[0].surface, 7);
    assert_eq!(
        all[0].rings,
        [[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]]
    );
    assert_eq!(regions([4, 3], &[], &|_| None), Ok(vec![]));
    assert_eq!(regions([0, 3], &[], &|_| Some(1)), Ok(vec![]));
    let side = LONGEST_SIDE + 1;
    assert_eq!(
        regions([side, 3], &[], &|_| None),
        Err(FillError::TooLarge { side })
    );
}

#[test]
fn a_square_is_one_region() {
    let inside = |[x, y]: [f64; 2]| (x > 2.0 && x < 6.0 && y > 2.0 && y < 6.0).then_some(3);
    let found = regions([10, 10], &square(2.0, 6.0), &inside).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(
        found[0].rings,
        [[[2.0, 2.0], [6.0, 2.0], [6.0, 6.0], [2.0, 6.0]]]
    );
}

#[test]
fn nested_squares_have_holes() {
    let lines = [square(1.0, 9.0), square(2.0, 8.0), square(3.0, 7.0)].concat();
    let depth = |[x, y]: [f64; 2]| {
        let from_border = x.min(y).min(10.0 - x).min(10.0 - y);
        Some(from_border.min(3.5) as u32)
    };
    let found = regions([10, 10], &lines, &depth).unwrap();
    check(&found);
    let areas: Vec<f64> = found.iter().map(region_area).collect();
    assert_eq!(areas, [36.0, 28.0, 20.0, 16.0]);
    assert_eq!(
        found.iter().map(|r| r.rings.len()).collect::<Vec<_>>(),
        [2, 2, 2, 1]
    );
}

#[test]
fn crossing_lines_cut_the_picture_into_quarters() {
    let lines = [[[0.0, 0.0], [8.0, 8.0]], [[8.0, 0.0], [0.0, 8.0]]];
    let side = |[x, y]: [f64; 2]| Some(u32::from(x > y) + 2 * u32::from(x + y > 8.0));
    let found = regions([8, 8], &lines, &side).unwrap();
    check(&found);
    assert_eq!(found.len(), 4);
    assert!(
        found
            .iter()
            .all(|r| region_area(r) == 16.0 && r.rings[0].contains(&[4.0, 4.0]))
    );
}

#[test]
fn a_line_that_ends_in_nothing_encloses_nothing() {
    let lines = [[[5.0, 0.0], [5.0, 7.0]]];
    let found = regions([8, 8], &lines, &|_| Some(0)).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].surface, region_area(&found[0])), (0, 64.0));
}

#[test]
fn a_line_inside_one_surface_leaves_no_trace() {
    let lines = [square(2.0, 6.0), vec![[[0.0, 4.0], [8.0, 4.0]]]].concat();
    let found = regions([8, 8], &lines, &|_| Some(1)).unwrap();
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].rings.len(), 1);
}

#[test]
fn areas_that_touch_in_a_point_stay_apart() {
    let lines = [square(1.0, 4.0), square(4.0, 7.0)].concat();
    let inside = |[x, y]: [f64; 2]| {
        let within = |low: f64, high: f64| (low..high).contains(&x) && (low..high).contains(&y);
        (within(1.0, 4.0) || within(4.0, 7.0)).then_some(1)
    };
    let found = regions([8, 8], &lines, &inside).unwrap();
    assert_eq!(
        found.iter().map(region_area).collect::<Vec<_>>(),
        [9.0, 9.0]
    );
}

#[test]
fn lines_outside_and_broken_numbers_are_left_out() {
    let lines = [
        [[-1e9, 4.0], [1e9, 4.0]],
        [[-1e300, 1e300], [1e300, -1e299]],
        [[f64::NAN, 0.0], [1.0, 1.0]],
        [[f64::INFINITY, 0.0], [1.0, 1.0]],
        [[9.0, 9.0], [20.0, 20.0]],
        [[3.0, 3.0], [3.0, 3.0]],
        [[-4.0, 2.0], [2.0, -4.0]],
    ];
    let found = regions([8, 8], &lines, &|[_, y]| Some(u32::from(y > 4.0))).unwrap();
    check(&found);
    assert_eq!(
        found.iter().map(region_area).collect::<Vec<_>>(),
        [32.0, 32.0]
    );
}

/// Surfaces in blocks that have nothing to do with the lines.
fn blocks([x, y]: [f64; 2]) -> Option<u32> {
    Some((x / 7.0) as u32 % 3 + 3 * ((y / 5.0) as u32 % 2))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn regions_tile_the_picture(
        lines in prop::collection::vec(prop::array::uniform2(prop::array::uniform2(-5.0..25.0)), 0..30),
        step in prop::sample::select(vec![0.001, 0.25, 1.0, 4.0]),
        probes in prop::collection::vec(prop::array::uniform2(0.01..19.99), 8),
    ) {
        let on_steps = |v: f64| (v / step).round() * step;
        let lines: Vec<Segment> = lines.iter().map(|s: &Segment| s.map(|p| p.map(on_steps))).collect();
        let found = regions([20, 20], &lines, &blocks).unwrap();
        check(&found);
        let whole: f64 = found.iter().map(region_area).sum();
        prop_assert_eq!(whole, 400.0);
        for probe in probes {
            let odd = probe.map(|v: f64| v + 1e-7);
            prop_assert_eq!(found.iter().filter(|r| contains(r, odd)).count(), 1);
        }
    }

    #[test]
    fn order_and_direction_of_lines_do_not_matter(
        lines in prop::collection::vec(prop::array::uniform2(prop::array::uniform2(0.0..20.0)), 0..12),
        seed: u64,
    ) {
        let mut random = Random::new(seed);
        let mut other = lines.clone();
        random.shuffle(&mut other);
        other.iter_mut().step_by(2).for_each(|s| s.reverse());
        prop_assert_eq!(regions([20, 20], &lines, &blocks), regions([20, 20], &other, &blocks));
    }
}

#[test]
fn thousands_of_lines_are_quick() {
    let mut random = Random::new(3);
    let mut unit = || f64::from(random.unit());
    let lines: Vec<Segment> = (0..10_000)
        .map(|_| {
            let [x, y] = [unit() * 1000.0, unit() * 1000.0];
            [[x, y], [x + 20.0 * unit() - 10.0, y + 20.0 * unit() - 10.0]]
        })
        .collect();
    let start = std::time::Instant::now();
    let found = regions([1000, 1000], &lines, &blocks).unwrap();
    let taken = start.elapsed();
    check(&found);
    assert_eq!(found.iter().map(region_area).sum::<f64>(), 1e6);
    assert!(taken.as_secs() < 30, "{taken:?}");
}

#[test]
fn thousands_of_lines_through_one_place_are_refused_or_filled() {
    let mut random = Random::new(4);
    let mut unit = || f64::from(random.unit());
    let lines: Vec<Segment> = (0..30_000)
        .map(|_| [[unit(), unit()], [unit(), unit()]])
        .collect();
    assert_eq!(
        regions([9, 9], &lines, &|_| None),
        Err(FillError::TooManyCrossings)
    );
}

/// An outline with a gap keeps its colour inside, and lets it out only near the gap.
#[test]
fn a_gap_does_not_paint_an_area_away() {
    let corners = [[20.0, 20.0], [80.0, 20.0], [80.0, 80.0], [20.0, 80.0]];
    let mut lines: Vec<Segment> = ring(&corners);
    // Many pieces, as strokes have, and one of them missing.
    lines.remove(1);
    let right = (0..30).filter(|i| *i != 15).map(|i| {
        let at = |k: i32| [80.0, 20.0 + 2.0 * f64::from(k)];
        [at(i), at(i + 1)]
    });
    lines.extend(right);
    let inside = |[x, y]: [f64; 2]| (20.0..80.0).contains(&x) && (20.0..80.0).contains(&y);
    let surface_at = |place: [f64; 2]| Some(u32::from(inside(place)));
    let found = regions([100, 100], &lines, &surface_at).unwrap();
    check(&found);
    let painted: f64 = found
        .iter()
        .filter(|region| region.surface == 1)
        .map(region_area)
        .sum();
    assert!((painted - 3600.0).abs() < 250.0, "{painted}");
}
