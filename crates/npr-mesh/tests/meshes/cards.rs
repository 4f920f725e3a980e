//! Cards and their centre lines, against strips and tubes bent along lines that are known.

use glam::DVec3;
use npr_core::math::{cos_f64, sin_f64};
use npr_mesh::Mesh;
use npr_mesh::card::{Card, CardPoint, cards, draw_by_centre};
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{Random, cube, shape_of, torus, uv_sphere};
use proptest::prelude::*;

/// A place on a line in space, and the way across it there.
#[derive(Clone, Copy)]
struct Station {
    middle: DVec3,
    along: DVec3,
    across: DVec3,
}

/// A bent and twisted line of length 1 from the origin upwards.
#[derive(Debug, Clone, Copy)]
struct Bend {
    /// How far it turns to either side on its way, in radians.
    turns: [f64; 2],
    /// How far what is across it turns around it.
    twist: f64,
}

impl Bend {
    /// The stations at even shares of the way.
    fn stations(&self, count: usize) -> Vec<Station> {
        const STEPS: usize = 400;
        let direction = |t: f64| {
            let [a, b] = self.turns.map(|turn| turn * t);
            DVec3::new(sin_f64(a), cos_f64(a) * cos_f64(b), cos_f64(a) * sin_f64(b))
        };
        let mut middle = DVec3::ZERO;
        let mut across = DVec3::X
            .cross(direction(0.0))
            .cross(direction(0.0))
            .normalize();
        let mut found = Vec::new();
        for step in 0..=STEPS {
            let t = step as f64 / STEPS as f64;
            let along = direction(t);
            // Carry on without turning about the line, and then turn by the twist.
            across = (across - along * across.dot(along)).normalize();
            let [c, s] = [cos_f64(self.twist * t), sin_f64(self.twist * t)];
            let turned = across * c + along.cross(across) * s;
            if step * (count - 1) >= found.len() * STEPS {
                found.push(Station {
                    middle,
                    along,
                    across: turned,
                });
            }
            middle += direction(t + 0.5 / STEPS as f64) / STEPS as f64;
        }
        found
    }
}

/// A strip or a tube along a bend.
#[derive(Debug, Clone, Copy)]
struct Made {
    bend: Bend,
    rows: usize,
    /// Quads across a strip, or around a tube.
    columns: usize,
    /// Width at the root and at the tip.
    widths: [f64; 2],
    /// How far corners are off, in widths of their place.
    noise: f64,
    seed: u64,
}

fn made() -> impl Strategy<Value = Made> {
    let bend = (prop::array::uniform2(-1.2..1.2), -1.0..1.0)
        .prop_map(|(turns, twist)| Bend { turns, twist });
    (
        bend,
        4usize..24,
        1usize..4,
        0.03..0.12,
        0.0..0.8,
        0.0..0.12,
        any::<u64>(),
    )
        .prop_map(|(bend, rows, columns, width, taper, noise, seed)| Made {
            bend,
            rows,
            columns,
            widths: [width, width * taper],
            noise,
            seed,
        })
}

impl Made {
    fn width(&self, t: f64) -> f64 {
        self.widths[0] + t * (self.widths[1] - self.widths[0])
    }

    fn jitter(&self, random: &mut Random, t: f64) -> DVec3 {
        let mut unit = || f64::from(random.unit()) - 0.5;
        DVec3::new(unit(), unit(), unit()) * self.noise * self.width(t)
    }

    /// An open strip, in random winding and order, with faces without area here and there.
    fn strip(&self) -> Mesh {
        let mut random = Random::new(self.seed);
        let stations = self.bend.stations(self.rows);
        let mut positions = Vec::new();
        for (row, station) in stations.iter().enumerate() {
            let t = row as f64 / (self.rows - 1) as f64;
            for column in 0..=self.columns {
                let side = column as f64 / self.columns as f64 - 0.5;
                let place = station.middle + station.across * (side * self.width(t));
                positions.push((place + self.jitter(&mut random, t)).as_vec3().to_array());
            }
        }
        let corner = |row: usize, column: usize| (row * (self.columns + 1) + column) as u32;
        let mut triangles = Vec::new();
        for row in 1..self.rows {
            for column in 1..=self.columns {
                let [a, b] = [corner(row - 1, column - 1), corner(row - 1, column)];
                let [c, d] = [corner(row, column - 1), corner(row, column)];
                match random.below(2) {
                    0 => triangles.extend([[a, b, c], [c, b, d]]),
                    _ => triangles.extend([[a, b, d], [a, d, c]]),
                }
            }
        }
        self.jumbled(positions, triangles, &mut random)
    }

    /// A tube of three sides more than columns, closed at its root if the seed says so, with one tip.
    fn tube(&self) -> Mesh {
        let mut random = Random::new(self.seed);
        let (sides, rows) = (self.columns + 3, self.rows + 4);
        let stations = self.bend.stations(rows + 1);
        let mut positions = Vec::new();
        for (row, station) in stations[..rows].iter().enumerate() {
            let t = row as f64 / rows as f64;
            for side in 0..sides {
                let angle = std::f64::consts::TAU * side as f64 / sides as f64;
                let up = station.along.cross(station.across);
                let spoke = station.across * cos_f64(angle) + up * sin_f64(angle);
                let place = station.middle + spoke * (0.5 * self.width(t));
                positions.push((place + self.jitter(&mut random, t)).as_vec3().to_array());
            }
        }
        let corner = |row: usize, side: usize| (row * sides + side % sides) as u32;
        let mut triangles = Vec::new();
        for row in 1..rows {
            for side in 0..sides {
                let [a, b] = [corner(row - 1, side), corner(row - 1, side + 1)];
                let [c, d] = [corner(row, side), corner(row, side + 1)];
                triangles.extend([[a, b, c], [c, b, d]]);
            }
        }
        let mut close = |row: usize, place: DVec3| {
            let tip = positions.len() as u32;
            positions.push(place.as_vec3().to_array());
            triangles
                .extend((0..sides).map(|side| [corner(row, side), corner(row, side + 1), tip]));
        };
        close(rows - 1, stations[rows].middle);
        if self.seed.is_multiple_of(2) {
            close(0, stations[0].middle);
        }
        self.jumbled(positions, triangles, &mut random)
    }

    fn jumbled(
        &self,
        mut positions: Vec<[f32; 3]>,
        mut triangles: Vec<[u32; 3]>,
        random: &mut Random,
    ) -> Mesh {
        // A face without area lies along an edge of another, with a corner of its own.
        if random.below(3) == 0 {
            let [a, b, _] = triangles[0];
            let middle =
                (0..3).map(|i| 0.5 * (positions[a as usize][i] + positions[b as usize][i]));
            let middle: Vec<f32> = middle.collect();
            positions.push([middle[0], middle[1], middle[2]]);
            let new = positions.len() as u32 - 1;
            let c = triangles[0][2];
            triangles[0] = [a, new, c];
            triangles.push([new, b, c]);
            triangles.push([a, b, new]);
        }
        for triangle in &mut triangles {
            if random.below(4) == 0 {
                triangle.swap(0, 1);
            }
            triangle.rotate_left(random.below(3));
        }
        random.shuffle(&mut triangles);
        Mesh::new(positions, triangles).expect("sound")
    }

    /// Greatest distance of a found line from the known one and back, in widths at the root, but for what lies within a
    /// width of the ends.
    fn distance(&self, points: &[CardPoint]) -> f64 {
        let known: Vec<DVec3> = self.bend.stations(400).iter().map(|s| s.middle).collect();
        let found: Vec<DVec3> = points.iter().map(|point| point.place).collect();
        let to = |place: DVec3, line: &[DVec3]| {
            let ways = line.windows(2).map(|pair| {
                let step = pair[1] - pair[0];
                let t = ((place - pair[0]).dot(step) / step.length_squared()).clamp(0.0, 1.0);
                place.distance(pair[0] + step * t)
            });
            ways.fold(f64::INFINITY, f64::min)
        };
        let width = self.widths[0];
        let is_inner = |place: &&DVec3| {
            let ends = [known[0], known[known.len() - 1]];
            ends.iter().all(|end| place.distance(*end) > 1.5 * width)
        };
        let there = found.iter().map(|place| to(*place, &known));
        let back = known
            .iter()
            .filter(is_inner)
            .map(|place| to(*place, &found));
        there.chain(back).fold(0.0, f64::max) / width
    }
}

fn found(mesh: &Mesh) -> Vec<Card> {
    cards(&shape_of(mesh), |_| true)
}

proptest! {
    /// The line of a strip lies in its middle, within what noise and corners cost, from the root to the tip.
    #[test]
    fn strips_have_the_line_that_they_were_bent_along(made in made()) {
        let found = found(&made.strip());
        prop_assert_eq!(found.len(), 1);
        let points = &found[0].points;
        // Chords of few rows leave a bent line by a part of its sagitta.
        let chord = 1.0 / (made.rows - 1) as f64;
        let turn = made.bend.turns.iter().map(|turn| turn.abs()).sum::<f64>() * chord;
        let sagitta = chord * turn / 8.0 / made.widths[0];
        let off = made.distance(points);
        prop_assert!(off < 0.15 + made.noise + 2.0 * sagitta, "{off} widths, sagitta {sagitta}");

        // It goes from the wide end to the thin one, and has the widths of the strip.
        if made.widths[1] < 0.8 * made.widths[0] {
            prop_assert!(points[0].place.length() < points[points.len() - 1].place.length());
        }
        let known = made.bend.stations(101);
        for point in points {
            let nearest = (0..=100).min_by(|a: &usize, b: &usize| {
                let off = |i: usize| known[i].middle.distance(point.place);
                off(*a).total_cmp(&off(*b))
            });
            let expected = made.width(nearest.expect("sound") as f64 / 100.0);
            let slack = (0.15 + 1.5 * made.noise) * made.widths[0];
            prop_assert!((point.width - expected).abs() < slack, "{} for {expected}", point.width);
            prop_assert!((point.across.length() - point.width).abs() < 1e-9);
            prop_assert!(point.across.dot(point.along).abs() < 1e-6);
        }
    }

    /// The line of a tube lies in its middle, but for its ends.
    #[test]
    fn tubes_have_the_line_that_they_were_bent_along(made in made()) {
        let made = Made { noise: 0.3 * made.noise, widths: [made.widths[0], 0.0], ..made };
        let found = found(&made.tube());
        prop_assert_eq!(found.len(), 1);
        let off = made.distance(&found[0].points);
        let chord = 1.0 / (made.rows + 4) as f64;
        let turn = made.bend.turns.iter().map(|turn| turn.abs()).sum::<f64>() * chord;
        let sagitta = chord * turn / 8.0 / made.widths[0];
        prop_assert!(off < 0.3 + made.noise + 2.0 * sagitta, "{off} widths");
        let points = &found[0].points;
        prop_assert!(points[0].place.length() < points[points.len() - 1].place.length());
    }

    /// What moves, turns or grows takes its lines along; the order of faces says nothing.
    #[test]
    fn lines_follow_their_strips(made in made(), scale in 0.1_f64..8.0) {
        let mesh = made.strip();
        let moved = |p: &[f32; 3]| -> [f32; 3] {
            let p = DVec3::from(p.map(f64::from));
            (DVec3::new(-p.z, p.y, p.x) * scale + DVec3::new(3.0, 1.0, -2.0)).as_vec3().to_array()
        };
        let positions = mesh.positions().iter().map(moved).collect();
        let mut triangles = mesh.triangles().to_vec();
        triangles.reverse();
        let other = found(&Mesh::new(positions, triangles).expect("sound"));
        let plain = found(&mesh);
        prop_assert_eq!(other.len(), plain.len());
        let length = |card: &Card| {
            let pairs = card.points.windows(2);
            pairs.map(|p| p[0].place.distance(p[1].place)).sum::<f64>()
        };
        let (a, b) = (length(&plain[0]) * scale, length(&other[0]));
        prop_assert!((a - b).abs() < 0.01 * a, "{a} and {b}");
    }
}

/// Flat pieces of squares at these places of a grid.
fn squares(places: &[[u32; 2]]) -> Mesh {
    let corner = |x: u32, y: u32| 100 * y + x;
    let positions = (0..10_000)
        .map(|i| [(i % 100) as f32, (i / 100) as f32, 0.0])
        .collect();
    let triangles = places.iter().flat_map(|[x, y]| {
        let [a, b] = [corner(*x, *y), corner(x + 1, *y)];
        let [c, d] = [corner(*x, y + 1), corner(x + 1, y + 1)];
        [[a, b, d], [a, d, c]]
    });
    Mesh::new(positions, triangles.collect()).expect("sound")
}

fn column(x: u32, from: u32, to: u32) -> Vec<[u32; 2]> {
    (from..to).map(|y| [x, y]).collect()
}

#[test]
fn a_straight_column_is_a_card_of_its_own_length() {
    let found = found(&squares(&column(3, 0, 20)));
    let points = &found[0].points;
    assert_eq!(points[0].place, DVec3::new(3.5, 0.0, 0.0));
    assert_eq!(points[points.len() - 1].place, DVec3::new(3.5, 20.0, 0.0));
    assert!(
        points.iter().all(|point| (point.width - 1.0).abs() < 1e-9),
        "{points:?}"
    );
}

#[test]
fn thick_forked_closed_and_holed_pieces_are_no_cards() {
    let join = |parts: &[Vec<[u32; 2]>]| squares(&parts.concat());
    let row = |y: u32, from: u32, to: u32| (from..to).map(|x| [x, y]).collect::<Vec<_>>();
    let cases = [
        ("a short piece", squares(&column(0, 0, 3))),
        (
            "a thick piece",
            join(&[
                column(0, 0, 12),
                column(1, 0, 12),
                column(2, 0, 12),
                column(3, 0, 12),
            ]),
        ),
        ("a fork", join(&[column(10, 0, 20), row(12, 11, 25)])),
        (
            "a cross",
            join(&[column(10, 0, 21), row(10, 0, 10), row(10, 11, 21)]),
        ),
        (
            "a frame",
            join(&[
                column(0, 0, 20),
                column(19, 0, 20),
                row(0, 1, 19),
                row(19, 1, 19),
            ]),
        ),
        ("a cube", cube()),
        ("a ball", uv_sphere(12, 8)),
        ("a ring", torus(40, 6, 1.0, 0.1)),
    ];
    for (what, mesh) in cases {
        assert_eq!(found(&mesh), [], "{what}");
    }
}

#[test]
fn a_band_that_closes_is_no_card() {
    let ring = |i: u32, z: f32| {
        let angle = 0.1 * std::f32::consts::PI * i as f32;
        [npr_core::math::cos(angle), npr_core::math::sin(angle), z]
    };
    let positions = (0..20).flat_map(|i| [ring(i, 0.0), ring(i, 0.1)]).collect();
    let triangles = (0..20).flat_map(|i| {
        let [a, b, c, d] = [2 * i, 2 * i + 1, (2 * i + 2) % 40, (2 * i + 3) % 40];
        [[a, c, d], [a, d, b]]
    });
    assert_eq!(
        found(&Mesh::new(positions, triangles.collect()).expect("sound")),
        []
    );
}

#[test]
fn pieces_are_told_apart_and_only_what_is_wanted_is_looked_at() {
    // The second touches the first in a corner.
    let mesh = squares(&[column(3, 0, 10), column(4, 10, 20), column(9, 0, 10)].concat());
    let shape = shape_of(&mesh);
    assert_eq!(cards(&shape, |_| true).len(), 3);
    let wanted = cards(&shape, |face| face < 20);
    assert_eq!(wanted.len(), 1);
    assert_eq!(wanted[0].faces, (0..20).collect::<Vec<_>>());
}

#[test]
fn a_shape_takes_its_lines_and_keeps_its_promises() {
    let mesh = squares(
        &[
            column(3, 0, 10),
            [[40, 0], [41, 0], [40, 1], [41, 1]].to_vec(),
        ]
        .concat(),
    );
    let mut shape = shape_of(&mesh);
    let before = shape.clone();
    let found = cards(&shape, |_| true);
    assert_eq!(draw_by_centre(&mut shape, &found), [0]);
    shape.sanity_check();
    assert_eq!(shape.polylines.len(), found[0].points.len() - 1);
    assert_eq!(shape.polyline_surfaces, vec![0; shape.polylines.len()]);
    assert_eq!(shape.cards.faces(0), found[0].faces);
    let lineless: Vec<u32> = (0..shape.faces.len() as u32)
        .filter(|f| shape.is_lineless(*f))
        .collect();
    assert_eq!(lineless, found[0].faces);
    // Nothing else has changed.
    let restored = HalfEdgeMesh {
        positions: before.positions.clone(),
        face_surfaces: before.face_surfaces.clone(),
        surfaces: before.surfaces.clone(),
        polylines: Vec::new(),
        polyline_surfaces: Vec::new(),
        cards: Default::default(),
        ..shape
    };
    assert_eq!(restored, before);
}
