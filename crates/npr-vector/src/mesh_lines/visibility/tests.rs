use super::*;
use npr_core::budget::Budget;
use npr_core::camera::{Camera, Projection};
use npr_mesh::testing::{crossing_soup, mapped, shape_of};
use proptest::prelude::*;

const SIZE: [u32; 2] = [400, 300];

fn projector(eye: [f32; 3], is_parallel: bool) -> Projector {
    let projection = match is_parallel {
        true => Projection::Parallel { height: 3.0 },
        false => Projection::Perspective { fov_y: 0.7 },
    };
    let camera = Camera {
        eye,
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection,
    };
    Projector::new(&camera, SIZE, ([-1.0; 3], [1.0; 3]))
}

/// Faces in front of the places around a share of a piece, counted one by one; none where they differ.
fn plainly_in_front(seen: &Seen<'_>, piece: &Piece, share: f64) -> Option<u32> {
    let step = 2.0 * LEAST_CROWDED_PX / piece.length();
    let count = |share: f64| {
        let point = piece.world_at(seen.projector, share.clamp(0.0, 1.0));
        let sight = seen.sight(point, &Circumstances::default());
        seen.tree
            .occluders(seen.shape, &sight, &[], seen.count_limit)
    };
    let [before, here, after] = [share - step, share, share + step].map(count);
    (before == here && here == after).then_some(here)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// What faces hide of a crowded piece is what sights to its places say, counted or not; what is left out has no
    /// span.
    #[test]
    fn crowded_pieces_are_hidden_where_sights_say_so(
        faces in 0_usize..100, seed: u64, height in prop::sample::select(&[1.0_f32, 0.01, 0.0]), is_parallel: bool,
        is_counted: bool, eye in prop::array::uniform3(-1.5_f32..4.0),
        ends in prop::array::uniform2(prop::array::uniform3(-1.0_f64..1.0)),
        left_out in prop::option::of(0.0_f64..0.5),
    ) {
        // Through each other, nearly in one plane, and in one; the eye among them or outside.
        let mesh = mapped(&crossing_soup(faces, seed), |[x, y, z]| [x, y, z * height]);
        let shape = shape_of(&mesh);
        let (tree, projector) = (FaceTree::new(&shape), projector(eye, is_parallel));
        let none = OutlineGrid::new(SIZE, Vec::new(), &mut Budget::new(u64::MAX)).expect("no limit is set");
        let images = FaceImages::default();
        let seen = Seen {
            shape: &shape, tree: &tree, projector: &projector, outlines: &none, images: &images, extra: None,
            size: SIZE,
            count_limit: if is_counted { 255 } else { 1 },
        };
        let piece = Piece::new(&projector, SIZE, DVec3::from(ends[0]), DVec3::from(ends[1]));
        prop_assume!(piece.is_some_and(|piece| piece.length() > 1.0));
        let piece = piece.expect("just looked at");
        let left_out: Vec<[f64; 2]> = left_out.into_iter().map(|from| [from, from + 0.25]).collect();
        let spans = seen.crowded_spans(&piece, &Circumstances::default(), &left_out, &mut Memory::default());
        for share in (0..64).map(|i| (f64::from(i) + 0.5) / 64.0) {
            let span = spans.iter().find(|span| (span.from..span.to).contains(&share));
            let is_left_out = left_out.iter().any(|[from, to]| (*from..*to).contains(&share));
            prop_assert_eq!(span.is_none(), is_left_out);
            if let (Some(span), Some(plain)) = (span, plainly_in_front(&seen, &piece, share)) {
                // All faces together are few enough for a piece so long; shorter ones are only told hidden or not.
                let is_long = piece.length() >= PX_PER_COUNTED * faces as f64;
                let is_told = is_counted && left_out.is_empty() && is_long;
                let found = if is_told { span.occluders } else { span.occluders.min(1) };
                prop_assert_eq!(found, if is_told { plain } else { plain.min(1) }, "at {}", share);
            }
        }
    }
}

/// Ink fills the paper once, and a line over black paper is told so for its black part.
#[test]
fn paper_under_many_lines_is_black() {
    let projector = projector([0.0, 0.0, 4.0], false);
    let line = |y: f64| {
        let [a, b] = [-1.0, 1.0].map(|x| DVec3::new(x, y, 0.0));
        Piece::new(&projector, SIZE, a, b).expect("in the frame")
    };
    let shown = |from, to| Span {
        from,
        to,
        occluders: 0,
    };
    let mut ink = Ink::new(SIZE);
    // A cell of 64 square pixels is black after 192 pixels of line; a line leaves 8 to 12 in it.
    for _ in 0..12 {
        ink.draw(&line(0.0), &[shown(0.0, 0.5)], false);
    }
    assert!(ink.black_parts(&line(0.0)).is_empty());
    let hidden = Span {
        occluders: 1,
        ..shown(0.0, 0.5)
    };
    (0..9).for_each(|_| ink.draw(&line(0.0), &[hidden], false));
    assert!(
        ink.black_parts(&line(0.0)).is_empty(),
        "hidden lines take no ink"
    );
    (0..40).for_each(|_| ink.draw(&line(0.0), &[shown(0.0, 0.5)], false));
    let [[from, to]] = ink.black_parts(&line(0.0))[..] else {
        panic!("one part is black");
    };
    assert!(from < 0.05 && (0.45..0.55).contains(&to), "{from} {to}");
    assert!(ink.black_parts(&line(0.9)).is_empty());
}
