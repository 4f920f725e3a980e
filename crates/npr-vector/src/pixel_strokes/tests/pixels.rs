//! Segments, fragments and sides.

use crate::pixel_strokes::edge::DrawnEdge;
use crate::pixel_strokes::fragment::{
    Fragment, draw_nearest, emit_fragments, holder_of, test_fragments,
};
use crate::pixel_strokes::ranked_sides;
use crate::pixel_strokes::segment::{Drawn, PixelView, Segment, project_edges, reciprocal};
use crate::pixel_strokes::side::{
    Ink, InkPicture, PIXELS_A_WORD, Side, key_of, link_sides, mark_sides, morton,
};
use crate::rank::hash_key;
use crate::rank::scan::exclusive_scan;
use npr_core::edge_flags::EdgeFlags;
use npr_core::geometry::NONE;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

fn view(size: [u32; 2], fine: f32) -> PixelView {
    PixelView {
        // A plain perspective: x, y as they are, w the distance along -z, reversed depth 1 / w.
        clip_from_world: [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0],
            [0.0, 0.0, 1.0, 0.0],
        ],
        size,
        fine,
        wanted: 63,
        perspective: 1.0,
        depth_scale: 1.0,
        tolerance: 0.1,
        least_visible: 2,
        ..PixelView::default()
    }
}

fn project(view: &PixelView, a: [f32; 3], b: [f32; 3], reversed: bool) -> Option<Segment> {
    let positions = [a, b].concat();
    let edges = [DrawnEdge {
        tail: 0,
        head: 1,
        face: 0,
        across: NONE,
        ..DrawnEdge::default()
    }];
    let mark = 1 | if reversed { EdgeFlags::REVERSED.0 } else { 0 };
    let drawn = Drawn {
        view,
        extent: &[1],
        list: &[0],
        marks: &[mark],
        edges: &edges,
        positions: &positions,
    };
    let (mut segments, mut counts) = ([Segment::default()], [7]);
    project_edges(&drawn, &mut segments, &mut counts);
    (counts[0] > 0).then_some(segments[0])
}

/// Where a share of an edge falls on the fine grid, in double precision; none where the view does not show it.
fn place(view: &PixelView, a: [f32; 3], b: [f32; 3], share: f64) -> Option<[f64; 2]> {
    let [x, y, z] = [0, 1, 2].map(|i| f64::from(a[i]) * (1.0 - share) + f64::from(b[i]) * share);
    let w = -z;
    let is_shown = w >= 1.0 && x.abs() <= w && y.abs() <= w;
    let [width, height] = view
        .size
        .map(|side| f64::from(side) * f64::from(view.fine) / 2.0);
    is_shown.then(|| [width * (1.0 + x / w), height * (1.0 - y / w)])
}

fn point() -> impl Strategy<Value = [f32; 3]> {
    (-3.0..3.0f32, -3.0..3.0f32, -6.0..0.5f32).prop_map(|(x, y, z)| [x, y, z])
}

/// Distance of a place from a line between two.
fn off([x, y]: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let square = (dx * dx + dy * dy).max(1e-12);
    let share = (((x - from[0]) * dx + (y - from[1]) * dy) / square).clamp(0.0, 1.0);
    let [ex, ey] = [x - from[0] - share * dx, y - from[1] - share * dy];
    (ex * ex + ey * ey).sqrt()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn reciprocals_are_those_of_division(b in prop_oneof![1e-30..1e30f32, -10.0..10.0f32, any::<f32>()]) {
        let found = reciprocal(b);
        let expected = 1.0 / b;
        if (1e-30..1e30).contains(&b.abs()) {
            prop_assert!((found.to_bits() as i64 - expected.to_bits() as i64).abs() <= 1, "{found} {expected}");
            // What a device may be off by changes nothing.
            for nudge in [-3i32, 3] {
                let off = f32::from_bits((1.0 / b.abs()).to_bits().wrapping_add_signed(nudge));
                let mut bits = off.to_bits() - 4;
                for _ in 0..8 {
                    if f32::from_bits(bits + 1) * b.abs() <= 1.0 { bits += 1; }
                }
                prop_assert_eq!(f32::from_bits(bits), found.abs());
            }
        }
    }

    #[test]
    fn what_a_view_shows_of_an_edge_is_its_segment(a in point(), b in point(), reversed: bool) {
        let view = view([40, 30], 2.0);
        let shown: Vec<[f64; 2]> = (0..=400).filter_map(|i| place(&view, a, b, f64::from(i) / 400.0)).collect();
        let Some(segment) = project(&view, a, b, reversed) else {
            prop_assert!(shown.len() <= 1, "{}", shown.len());
            return Ok(());
        };
        let [from, to] = [segment.start, segment.end].map(|end| end.map(f64::from));
        for place in &shown {
            prop_assert!(off(*place, from, to) < 0.01);
        }
        // No more than that: both ends are near what is shown, in the edge's direction.
        if let (Some(first), Some(last)) = (shown.first(), shown.last()) {
            let (first, last) = if reversed { (last, first) } else { (first, last) };
            let reach = |p: [f64; 2], q: &[f64; 2]| ((p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sqrt();
            let step = shown.windows(2).map(|pair| reach(pair[0], &pair[1])).fold(0.0, f64::max) + 0.5;
            prop_assert!(reach(from, first) < 2.0 * step && reach(to, last) < 2.0 * step);
        }
        prop_assert!((0.0..=1.0).contains(&segment.start_z) && (0.0..=1.0).contains(&segment.end_z));
    }

    #[test]
    fn an_edge_cut_at_both_ends_keeps_its_line(slope in -0.5..0.5f32, lift in -0.4..0.4f32) {
        let view = view([100, 100], 2.0);
        let at = |x: f32| [x, lift + slope * x, -2.0];
        let segment = project(&view, at(-9.0), at(9.0), false).expect("it crosses the view");
        for end in [segment.start, segment.end] {
            let x = (end[0] / 100.0 - 1.0) * 2.0;
            let expected = 100.0 * (1.0 - (lift + slope * x) / 2.0);
            prop_assert!((end[1] - expected).abs() < 0.01 || end[1] == 0.0 || end[1] == 200.0, "{end:?} {expected}");
        }
        if (lift.abs() + 2.0 * slope.abs()) < 1.9 {
            prop_assert_eq!([segment.start[0], segment.end[0]], [0.0, 200.0]);
        }
    }

    #[test]
    fn holders_are_those_of_a_walk(counts in prop::collection::vec(0u32..4, 1..40)) {
        let (starts, total) = exclusive_scan(&counts);
        let numbered = (0..).zip(&counts);
        let held: Vec<u32> = numbered.flat_map(|(i, count)| std::iter::repeat_n(i, *count as usize)).collect();
        prop_assert_eq!((0..total).map(|value| holder_of(&starts, value)).collect::<Vec<_>>(), held);
    }

    #[test]
    fn fragments_cover_a_line_without_gaps(
        from in prop::array::uniform2(0.0..80.0f32), to in prop::array::uniform2(0.0..80.0f32),
        z in prop::array::uniform2(0.1..1.0f32), fine in 1u32..4,
    ) {
        let view = view([80, 80], fine as f32);
        let place = |at: [f32; 2]| at.map(|v| v * fine as f32);
        let segment = Segment { start: place(from), end: place(to), start_z: z[0], end_z: z[1], edge: 0, mark: 1 };
        let count = segment.fragment_count();
        let mut fragments = vec![Fragment::default(); count as usize + 2];
        emit_fragments(&view, &[count], &[1], &[0], &[segment], &mut fragments);
        prop_assert!(fragments[count as usize..].iter().all(|f| f.pixel == NONE));
        fragments.truncate(count as usize);
        let pixels: Vec<[i64; 2]> = fragments.iter().map(|f| [f.pixel % 80, f.pixel / 80].map(i64::from)).collect();
        for pair in pixels.windows(2) {
            prop_assert!((0..2).all(|i| (pair[0][i] - pair[1][i]).abs() <= 1), "neighbours {pair:?}");
        }
        let [a, b] = [from, to].map(|end| end.map(f64::from));
        for (pixel, fragment) in pixels.iter().zip(&fragments) {
            let middle = pixel.map(|v| v as f64 + 0.5);
            prop_assert!(off(middle, a, b) < 1.2, "{middle:?}");
            prop_assert!((z[0].min(z[1]) - 1e-6..=z[0].max(z[1]) + 1e-6).contains(&fragment.z));
        }
        // The line's end belongs to the edge that goes on there; all before it has a pixel near. The last fragment
        // lies up to a step and a half before the end along the longer axis, so as far at most along the other, where
        // the middle of a pixel is half a pixel more away.
        let [along, across] = if (a[0] - b[0]).abs() >= (a[1] - b[1]).abs() { [0, 1] } else { [1, 0] };
        for i in 0..=50 {
            let at = [0, 1].map(|k| a[k] + (b[k] - a[k]) * f64::from(i) / 50.0);
            let near = pixels.iter().any(|pixel| {
                let away = |k: usize| (pixel[k] as f64 + 0.5 - at[k]).abs();
                away(along) <= 1.5 + 1e-4 && away(across) <= 2.0 + 1e-4
            });
            prop_assert!(near, "{at:?}");
        }
    }

    #[test]
    fn fragments_show_where_enough_pixels_do(
        surfaces in prop::collection::vec(prop_oneof![Just(0.0f32), 0.05..1.0f32], 30),
        occluder_depths in prop::collection::vec(0.0..1.0f32, 30), is_occluded: bool,
        pixel in 0u32..30, z in 0.05..1.0f32,
        least in 0u32..10,
    ) {
        let view = PixelView { size: [6, 5], least_visible: least, ..view([6, 5], 2.0) };
        let (mut shown, mut ink) = ([7], [0]);
        let occluder_depths = if is_occluded { occluder_depths } else { vec![0.0] };
        let fragments = [Fragment { pixel, z, segment: 0 }];
        test_fragments(&view, [&surfaces, &occluder_depths], &fragments, &mut shown, &mut ink);
        let occluder = |i: usize| if is_occluded { occluder_depths[i] } else { 0.0 };
        let scene: Vec<f32> = (0..30).map(|i| surfaces[i].max(occluder(i))).collect();
        let [x, y] = [pixel % 6, pixel / 6].map(i64::from);
        let mut count = 0;
        for (i, scene) in (0i64..).zip(&scene) {
            let is_near = (i % 6 - x).abs() <= 1 && (i / 6 - y).abs() <= 1;
            let is_free = *scene == 0.0 || f64::from(1.0 / z) <= f64::from(1.0 / scene) + 0.1;
            count += u32::from(is_near && is_free);
        }
        prop_assert_eq!(shown[0], u32::from(count >= least));
        prop_assert_eq!(ink[0], shown[0] << pixel);
    }

    #[test]
    fn the_nearest_fragment_owns_a_pixel(
        fragments in prop::collection::vec((0u32..6, 0u32..4, any::<bool>()), 0..30),
    ) {
        let all: Vec<Fragment> = (0..).zip(&fragments)
            .map(|(segment, (pixel, z, _))| Fragment { pixel: *pixel, z: *z as f32 / 4.0, segment }).collect();
        let shown: Vec<u32> = fragments.iter().map(|f| u32::from(f.2)).collect();
        let (mut owners, mut nearest) = ([0; 6], [0; 6]);
        draw_nearest(&all, &shown, &mut owners, &mut nearest);
        for pixel in 0..6 {
            let there = all.iter().zip(&shown).filter(|(f, shown)| f.pixel == pixel && **shown != 0);
            let best = there.min_by(|a, b| b.0.z.total_cmp(&a.0.z).then(a.0.segment.cmp(&b.0.segment)));
            prop_assert_eq!(owners[pixel as usize], best.map_or(0, |(f, _)| f.segment + 1));
        }
    }

    #[test]
    fn morton_codes_take_bits_in_turns(x in any::<u16>(), y in any::<u16>()) {
        let code = morton([x.into(), y.into()]);
        for bit in 0..16 {
            prop_assert_eq!(code >> (2 * bit) & 1, u32::from(x >> bit & 1));
            prop_assert_eq!(code >> (2 * bit + 1) & 1, u32::from(y >> bit & 1));
        }
    }

    #[test]
    fn sides_follow_the_ink_and_close(
        width in 1u32..9, height in 1u32..9, cells in prop::collection::vec(any::<bool>(), 64),
    ) {
        let pixels: Vec<u32> = cells[..(width * height) as usize].iter().map(|c| u32::from(*c)).collect();
        let ink = Ink { size: [width, height], pixels: &pixels };
        let expected = walked_loops(&ink);
        let (sides, ranked) = ranked_sides(&ink.into(), &ink.bits(), None).expect("loops");
        let by_rounds = ranked_sides(&ink.into(), &ink.bits(), Some(16)).expect("loops");
        prop_assert_eq!(&by_rounds, &(sides.clone(), ranked.clone()));
        let found: BTreeSet<Vec<u32>> = ranked.chains()
            .map(|chain| least_first(chain.iter().map(|side| sides[*side as usize].code).collect())).collect();
        prop_assert_eq!(found, expected);
        for chain in ranked.chains() {
            let code = |side: &u32| {
                let side = sides[*side as usize].code;
                let (pixel, way) = (side / 4, side % 4);
                morton([2 * (pixel % width) + (way >> 1), 2 * (pixel / width) + (way & 1)])
            };
            prop_assert_eq!(chain.iter().map(code).max(), chain.first().map(code));
        }
    }

    #[test]
    fn sides_know_what_shows_at_their_pixels(owners in prop::collection::vec(0u32..5, 35)) {
        let segments: Vec<Segment> = (0..4).map(|i| {
            let at = i as f32;
            Segment { start: [at, 1.0], end: [3.0 * at, -at], edge: i, ..Segment::default() }
        }).collect();
        let nearest: Vec<u32> = (100..135).collect();
        let ink = Ink { size: [5, 7], pixels: &owners };
        let picture = InkPicture { ink, nearest: &nearest, segments: &segments };
        let (sides, _) = ranked_sides(&picture, &ink.bits(), None).expect("loops");
        for side in sides {
            let pixel = side.code / 4;
            let owner = owners[pixel as usize];
            prop_assert_eq!((side.segment + 1, side.nearest), (owner, 100 + pixel));
            let along = (owner - 1) as f32;
            prop_assert_eq!([side.extent.x, side.extent.y], [2.0 * along, -along - 1.0]);
        }
    }

    #[test]
    fn keys_hash_to_what_is_left_of_codes(x in 0u32..0x8000, y in 0u32..0x8000, way in 0u32..4) {
        let code = morton([2 * x + (way >> 1), 2 * y + (way & 1)]);
        prop_assert_eq!(hash_key(key_of([x, y], way)), (!code).max(1));
    }

    #[test]
    fn links_lead_there_and_back(cells in prop::collection::vec(any::<bool>(), 42)) {
        let pixels: Vec<u32> = cells.iter().map(|c| u32::from(*c)).collect();
        let ink = Ink { size: [7, 6], pixels: &pixels };
        let word_count = 42_usize.div_ceil(PIXELS_A_WORD);
        let (mut masks, mut counts) = (vec![0; word_count], vec![0; word_count]);
        mark_sides(ink.size, &ink.bits(), &mut masks, &mut counts);
        let (starts, total) = exclusive_scan(&counts);
        let count = total as usize + 3;
        let (mut sides, mut links) = (vec![Side::default(); count], vec![Default::default(); count]);
        link_sides(&[total], &ink.into(), &masks, &starts, &mut sides, &mut links);
        for (element, link) in (0..).zip(&links) {
            prop_assert_eq!(links[link.next as usize].prev, element);
            prop_assert_eq!(links[link.prev as usize].next, element);
            prop_assert!(element < total || link.next == element);
        }
    }
}

fn least_first(mut ring: Vec<u32>) -> Vec<u32> {
    let least = (0..ring.len()).min_by_key(|i| ring[*i]).unwrap_or(0);
    ring.rotate_left(least);
    ring
}

/// Corner points of a side from its start to its end, clockwise around its pixel.
fn ends(width: u32, side: u32) -> [[i64; 2]; 2] {
    let (x, y) = (i64::from(side / 4 % width), i64::from(side / 4 / width));
    let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
    let way = (side % 4) as usize;
    [corners[way], corners[(way + 1) % 4]]
}

/// All loops by a walk from corner point to corner point: where two sides start, the one that turns left is next.
fn walked_loops(ink: &Ink<'_>) -> BTreeSet<Vec<u32>> {
    let [width, height] = ink.size;
    let is_ink = |x: i64, y: i64| {
        let is_inside = x >= 0 && y >= 0 && x < i64::from(width) && y < i64::from(height);
        is_inside && ink.pixels[(y * i64::from(width) + x) as usize] != 0
    };
    let mut from: BTreeMap<[i64; 2], Vec<u32>> = BTreeMap::new();
    let mut all = BTreeSet::new();
    for pixel in 0..width * height {
        let (x, y) = (i64::from(pixel % width), i64::from(pixel / width));
        let beside = [(x, y - 1), (x + 1, y), (x, y + 1), (x - 1, y)];
        for (way, (bx, by)) in (0..).zip(beside) {
            if is_ink(x, y) && !is_ink(bx, by) {
                let side = 4 * pixel + way;
                all.insert(side);
                from.entry(ends(width, side)[0]).or_default().push(side);
            }
        }
    }
    let after = |side: u32| {
        let candidates = &from[&ends(width, side)[1]];
        let left = candidates.iter().find(|next| *next % 4 == (side + 3) % 4);
        // Of one candidate there is no choice.
        *left
            .filter(|_| candidates.len() > 1)
            .unwrap_or(&candidates[0])
    };
    let mut loops = BTreeSet::new();
    while let Some(first) = all.pop_first() {
        let ring = std::iter::successors(Some(first), |side| {
            Some(after(*side)).filter(|next| *next != first)
        });
        let ring: Vec<u32> = ring.collect();
        all.retain(|side| !ring.contains(side));
        loops.insert(least_first(ring));
    }
    loops
}

#[test]
fn all_patterns_of_four_pixels_link() {
    for pattern in 0..16u32 {
        let mut pixels = vec![0; 16];
        for (bit, pixel) in [5, 6, 9, 10].into_iter().enumerate() {
            pixels[pixel] = pattern >> bit & 1;
        }
        let ink = Ink {
            size: [4, 4],
            pixels: &pixels,
        };
        let (sides, ranked) = ranked_sides(&ink.into(), &ink.bits(), None).expect("loops");
        // Ink joined by a corner is one, so each pattern with ink has one loop.
        assert_eq!(
            ranked.starts.len() - 1,
            usize::from(pattern != 0),
            "{pattern:04b}"
        );
        assert_eq!(
            walked_loops(&ink).iter().map(Vec::len).sum::<usize>(),
            sides.len()
        );
    }
}

#[test]
fn rounds_that_are_too_few_are_told() {
    let pixels = vec![1; 100];
    let ink = Ink {
        size: [100, 1],
        pixels: &pixels,
    };
    assert!(ranked_sides(&ink.into(), &ink.bits(), Some(3)).is_err());
    assert!(ranked_sides(&ink.into(), &ink.bits(), Some(8)).is_ok());
}
