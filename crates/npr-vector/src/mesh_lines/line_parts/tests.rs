use super::*;
use crate::mesh_lines::run::Beyond;
use crate::mesh_lines::run::testing::run_along;
use npr_mesh::testing::Random;
use proptest::prelude::*;

/// The row from one x to another, which goes on from its ends behind what has these numbers and lengths.
fn row(id: u64, [from, to]: [f64; 2], beyond: [Option<(u64, f64)>; 2]) -> Run {
    let middle = 0.5 * (from + to);
    let behind = |(number, length_px)| Beyond { number, length_px };
    Run {
        beyond: beyond.map(|end| end.map(behind)),
        ..run_along(id, &[[from, 0.0], [middle, 0.0], [to, 0.0]])
    }
}

fn told(mut runs: Vec<Run>) -> Vec<Run> {
    tell_parts(&mut runs);
    runs
}

proptest! {
    #[test]
    fn parts_of_a_row_lie_where_they_are_on_it(
        lengths in prop::collection::vec([4.0..80.0_f64, 1.0..60.0], 2..9),
        seed: u64,
    ) {
        // Cut a row into seen and hidden pieces; let some run the other way, and mix them up.
        let mut random = Random::new(seed);
        let mut x = 10.0;
        let mut runs = Vec::new();
        for (number, [seen, hidden]) in (0..).zip(&lengths) {
            let before = (number > 0).then(|| (number, lengths[number as usize - 1][1]));
            let after = (number as usize + 1 < lengths.len()).then_some((number + 1, *hidden));
            let mut run = row(random.bits() >> 8, [x, x + seen], [before, after]);
            if random.below(2) == 0 {
                run.reverse();
            }
            runs.push(run);
            x += seen + hidden;
        }
        let whole = x - lengths[lengths.len() - 1][1] - 10.0;
        random.shuffle(&mut runs);

        // The row runs as the run with the least id did, and all lie on it by their places.
        let leader = runs.iter().min_by_key(|run| run.id).expect("a run").clone();
        let is_right = leader.points[0].place[0] < leader.points[2].place[0];
        for run in told(runs) {
            let part = run.part.expect("a part");
            prop_assert_eq!(part.line, leader.id);
            prop_assert!((part.length_px - whole).abs() < 1e-9);
            for (point, px) in [0, 2].into_iter().zip(part.ends_px) {
                let x = run.points[point].place[0] - 10.0;
                let expected = if is_right { x } else { whole - x };
                prop_assert!((px - expected).abs() < 1e-9, "{} but {}", px, expected);
            }
        }
    }
}

#[test]
fn ways_without_another_end_are_none() {
    let way = Some((1, 20.0));
    let rows = [
        row(1, [0.0, 40.0], [None, way]),
        row(2, [60.0, 90.0], [None, Some((2, 5.0))]),
    ];
    assert_eq!(told(rows.to_vec()), rows);

    // A line whose two ends are those of one way stays whole.
    let alone = [row(1, [0.0, 40.0], [way; 2])];
    assert_eq!(told(alone.to_vec()), alone);
}

#[test]
fn a_ring_begins_behind_its_longest_way() {
    let way = |number, length_px| Some(Beyond { number, length_px });
    let side = |id: u64, places: [[f64; 2]; 2], beyond: [Option<Beyond>; 2]| Run {
        beyond,
        ..run_along(id, &places)
    };
    let [short, long, longest] = [way(1, 12.0), way(2, 15.0), way(3, 50.0)];
    let sides = vec![
        side(5, [[0.0, 0.0], [40.0, 0.0]], [longest, short]),
        side(6, [[30.0, 40.0], [0.0, 40.0]], [long, longest]),
        side(4, [[40.0, 10.0], [40.0, 40.0]], [short, long]),
    ];
    let parts: Vec<LinePart> = told(sides).iter().filter_map(|run| run.part).collect();
    let ends = [[0.0, 40.0], [97.0, 127.0], [52.0, 82.0]];
    assert_eq!(parts.len(), 3);
    for (part, ends_px) in parts.iter().zip(ends) {
        assert_eq!(
            (part.line, part.ends_px, part.length_px),
            (4, ends_px, 127.0)
        );
    }
}

#[test]
fn where_ends_were_cut_the_way_is_longer() {
    let rows = vec![
        row(1, [0.0, 40.0], [None, Some((1, 4.0))]),
        row(2, [50.0, 70.0], [Some((1, 4.0)), None]),
    ];
    let parts: Vec<[f64; 2]> = told(rows)
        .iter()
        .filter_map(|run| Some(run.part?.ends_px))
        .collect();
    assert_eq!(parts, [[0.0, 40.0], [50.0, 70.0]]);
}
