//! Charts against what a reader can check by hand: lengths, agreement across edges, symmetries.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use npr_core::geometry::Triangle;
use proptest::prelude::*;

use super::*;
use crate::direction_field::Guide;
use crate::mesh::Mesh;
use crate::testing::{
    Random, cube, cylinder, icosphere, mapped, moebius_strip, random_soup, shuffled_vertices,
    torus, unindexed, with_doubles,
};

fn triangles_of(mesh: &Mesh) -> Vec<Triangle> {
    let triangle = |&corners: &[u32; 3]| Triangle { corners, part: 0 };
    mesh.triangles().iter().map(triangle).collect()
}

fn chart_of(mesh: &Mesh, settings: &ChartSettings) -> StrokeChart {
    let triangles = triangles_of(mesh);
    let surface = ChartInput {
        positions: mesh.positions(),
        triangles: &triangles,
        directions: &[],
    };
    stroke_chart(&surface, settings)
}

fn tiles_of(tile_world: f32) -> ChartSettings {
    ChartSettings {
        tile_world,
        ..ChartSettings::default()
    }
}

fn guided(tile_world: f32, guide: Guide) -> ChartSettings {
    ChartSettings {
        guides: vec![PartGuide { guide, angle: 0.0 }],
        ..tiles_of(tile_world)
    }
}

fn corners_of(mesh: &Mesh, face: usize) -> [Vec3; 3] {
    mesh.triangles()[face].map(|vertex| Vec3::from_array(mesh.positions()[vertex as usize]))
}

/// How `u` and `v` change per unit of length in a triangle.
fn gradients(corners: [Vec3; 3], chart: &[[f32; 2]; 3]) -> [Vec3; 2] {
    let [e, f] = [corners[1] - corners[0], corners[2] - corners[0]];
    let normal = e.cross(f);
    [0, 1].map(|k| {
        let [to_e, to_f] = [chart[1][k] - chart[0][k], chart[2][k] - chart[0][k]];
        (f.cross(normal) * to_e + normal.cross(e) * to_f) / normal.length_squared()
    })
}

/// A flat sheet of uneven triangles over vertices in random order.
fn uneven_sheet(columns: u32, rows: u32, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let mut jitter = || 0.3 * random.unit() - 0.15;
    for row in 0..=rows {
        for column in 0..=columns {
            positions.push([column as f32 + jitter(), row as f32 + jitter(), 0.0]);
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let a = row * (columns + 1) + column;
            let [b, c, d] = [a + 1, a + columns + 2, a + columns + 1];
            if random.below(2) == 0 {
                triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }
    random.shuffle(&mut triangles);
    shuffled_vertices(&Mesh::new(positions, triangles).unwrap(), seed).0
}

/// A ball with dents that has no symmetry.
fn bumpy(level: u32, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut wave = || Vec3::from_array([0; 3].map(|_| 8.0 * random.unit() - 4.0));
    let waves = [wave(), wave(), wave()];
    mapped(&icosphere(level), |p| {
        let height = |wave: &Vec3| npr_core::math::sin(wave.dot(Vec3::from_array(p)) + wave.x);
        let height: f32 = waves.iter().map(height).sum();
        p.map(|v| v * (1.0 + 0.06 * height))
    })
}

/// A tube about z without caps.
fn tube(around: u32, bands: u32, radius: f32) -> Mesh {
    let mesh = cylinder(around, bands);
    let inside = |corners: &&[u32; 3]| {
        let z = corners.map(|vertex| mesh.positions()[vertex as usize][2]);
        !(z[0] == z[1] && z[1] == z[2])
    };
    let triangles = mesh.triangles().iter().filter(inside).copied().collect();
    let positions = mesh.positions().iter();
    let positions = positions.map(|[x, y, z]| [x * radius, y * radius, *z]);
    Mesh::new(positions.collect(), triangles).unwrap()
}

/// A tube with strokes round it or along it.
#[derive(Debug, Clone, Copy)]
struct Tube {
    around: u32,
    bands: u32,
    radius: f32,
    /// Tiles that its ring is long.
    tiles: f32,
    across: bool,
}

impl Tube {
    fn mesh(&self) -> Mesh {
        tube(self.around, self.bands, self.radius)
    }

    fn settings(&self) -> ChartSettings {
        // Of the polygon that the ring is.
        let corner = std::f32::consts::PI / self.around as f32;
        let girth = self.around as f32 * 2.0 * self.radius * npr_core::math::sin(corner);
        let across = self.across;
        guided(girth / self.tiles, Guide::Curvature { across })
    }

    /// Coordinates' change per tile in each triangle: of the coordinate that runs round the tube, and of the other.
    fn spacings(&self, settings: &ChartSettings) -> [Vec<f32>; 2] {
        let mesh = self.mesh();
        let chart = chart_of(&mesh, settings);
        assert_eq!(chart.singular_triangles, 0);
        let [mut round, mut along] = [Vec::new(), Vec::new()];
        for (face, chart) in chart.corners.iter().enumerate() {
            let spacing =
                gradients(corners_of(&mesh, face), chart).map(|g| g.length() * settings.tile_world);
            round.push(spacing[usize::from(self.across)]);
            along.push(spacing[usize::from(!self.across)]);
        }
        [round, along]
    }

    /// What the ring may stretch the coordinate that runs round it, in the mean, so that a whole number of tiles goes
    /// round: the next to its length, and either where that is about halfway between two.
    fn stretches(&self) -> Vec<f32> {
        let whole = [self.tiles.floor(), self.tiles.ceil()].map(|count| count / self.tiles);
        let near = |stretch: &f32| (stretch - 1.0).abs() <= 0.55 / self.tiles;
        whole.into_iter().filter(near).collect()
    }
}

/// Whether a stretch is spread over all triangles: nowhere twice as much as in the mean, and nowhere the other way.
///
/// A few sweeps of averaging leave the rest: of 1500 tubes the most uneven missed the mean by 0.55 of the stretch.
fn spread_evenly(spacings: &[f32], stretch: f32) -> bool {
    let most = (stretch - 1.0).abs() + 0.005;
    spacings
        .iter()
        .all(|spacing| (spacing - stretch).abs() < most)
}

/// The ring asks for 5.5 tiles and gets 5; the more sweeps, the more even.
#[test]
fn sweeps_even_out_what_a_ring_stretches() {
    let tube = Tube {
        around: 44,
        bands: 6,
        radius: 0.670_386_7,
        // Was given as tiles of the circle, not of the polygon.
        tiles: 5.491_018,
        across: false,
    };
    let stretch = 5.0 / tube.tiles;
    let unevenness = |rounds: u32| {
        let settings = ChartSettings {
            rounds,
            ..tube.settings()
        };
        let [round, _] = tube.spacings(&settings);
        assert!(spread_evenly(&round, stretch), "{rounds}: {round:?}");
        let miss = |spacing: &f32| (spacing - stretch).abs();
        round.iter().map(miss).fold(0.0, f32::max)
    };
    let [few, more, many] = [4, 64, 1024].map(unevenness);
    assert!(
        few < 0.035 && more < 0.25 * few && many < 1e-3,
        "{few} {more} {many}"
    );
}

/// Whether two charts of the same corners differ by whole tiles, maybe after a half turn.
fn agree(ours: &[Vec2], theirs: &[Vec2], tolerance: f32) -> bool {
    [1.0, -1.0].iter().any(|&turn| {
        let offset = ours[0] - theirs[0] * turn;
        let whole = (offset - offset.round()).abs().max_element() < tolerance;
        let differs = |(a, b): (&Vec2, &Vec2)| (a - b * turn - offset).abs().max_element();
        whole && ours.iter().zip(theirs).map(differs).all(|d| d < tolerance)
    })
}

/// Pairs of corners `[[face, corner]; 2]` at both ends of every edge that two faces of a manifold share.
fn shared_edges(mesh: &Mesh) -> Vec<[[[usize; 2]; 2]; 2]> {
    let mut sides: BTreeMap<[[u32; 3]; 2], Vec<[[usize; 2]; 2]>> = BTreeMap::new();
    for face in 0..mesh.triangles().len() {
        let corners = corners_of(mesh, face).map(|p| (p + 0.0).to_array().map(f32::to_bits));
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (edge, side) = if corners[i] < corners[j] {
                ([corners[i], corners[j]], [[face, i], [face, j]])
            } else {
                ([corners[j], corners[i]], [[face, j], [face, i]])
            };
            sides.entry(edge).or_default().push(side);
        }
    }
    let pairs = sides.into_values().filter(|sides| sides.len() == 2);
    pairs.map(|sides| [sides[0], sides[1]]).collect()
}

/// Edges whose two faces disagree though they are smooth and neither is singular.
fn torn_edges(mesh: &Mesh, settings: &ChartSettings) -> usize {
    let triangles = triangles_of(mesh);
    let surface = ChartInput {
        positions: mesh.positions(),
        triangles: &triangles,
        directions: &[],
    };
    let (nodes, lifted) = lift_faces(&surface, settings);
    assert_eq!(nodes.faces.len(), triangles.len());
    let normal = |face: usize| {
        let [a, b, c] = corners_of(mesh, face);
        (b - a).cross(c - a).normalize()
    };
    let torn = |[one, other]: &&[[[usize; 2]; 2]; 2]| {
        let [f, g] = [one[0][0], other[0][0]];
        let backwards = (one[0][1] + 1) % 3 == one[1][1];
        let smooth = normal(f).dot(normal(g)) > settings.crease_cos + 1e-4
            && backwards != ((other[0][1] + 1) % 3 == other[1][1]);
        let ends = |side: &[[usize; 2]; 2]| side.map(|[face, i]| lifted[face].corners[i]);
        let singular = lifted[f].singular || lifted[g].singular;
        smooth && !singular && !agree(&ends(one), &ends(other), 2e-3)
    };
    shared_edges(mesh).iter().filter(torn).count()
}

#[test]
fn nothing_has_no_coordinates() {
    let chart = stroke_chart(&ChartInput::default(), &ChartSettings::default());
    assert_eq!(chart, StrokeChart::default());
}

#[test]
fn a_cube_has_straight_even_strokes() {
    let chart = chart_of(&cube(), &tiles_of(0.5));
    assert_eq!(chart.singular_triangles, 0);
    assert!(chart.gradient_error < 1e-4, "{}", chart.gradient_error);
    assert_eq!(torn_edges(&cube(), &tiles_of(0.5)), 0);
    for (face, chart) in chart.corners.iter().enumerate() {
        let [u, v] = gradients(corners_of(&cube(), face), chart);
        assert!((u.length() - 2.0).abs() < 1e-3 && (v.length() - 2.0).abs() < 1e-3);
        assert!(u.abs().max_element() > 1.999, "strokes lie askew: {u}");
    }
}

#[test]
fn a_sphere_turns_at_few_points_and_a_torus_nowhere() {
    for level in [3, 4, 5] {
        let turning = chart_of(&icosphere(level), &tiles_of(0.15)).turning_triangles;
        assert!((4..=12).contains(&turning), "level {level}: {turning}");
    }
    let chart = chart_of(&torus(96, 48, 1.0, 0.4), &tiles_of(0.2));
    assert_eq!(chart.turning_triangles, 0);
    // Rings are longer outside than inside: 4 pi * 0.4 / 0.2 strokes end on the way, on either side.
    assert!(
        chart.singular_triangles <= 60,
        "{}",
        chart.singular_triangles
    );
    assert!(chart.gradient_error < 0.15, "{}", chart.gradient_error);
}

#[test]
fn strokes_wrap_round_a_tube_or_run_along_it() {
    for across in [true, false] {
        let mesh = tube(32, 12, 0.5);
        let chart = chart_of(&mesh, &guided(0.21, Guide::Curvature { across }));
        for (face, chart) in chart.corners.iter().enumerate() {
            let [_, v] = gradients(corners_of(&mesh, face), chart);
            let cos = v.normalize().dot(Vec3::Z).abs();
            assert!(if across { cos < 0.05 } else { cos > 0.95 }, "{cos}");
        }
    }
}

#[test]
fn each_part_follows_its_guide_up_to_its_border() {
    let mesh = uneven_sheet(8, 8, 3);
    let mut triangles = triangles_of(&mesh);
    for (face, triangle) in triangles.iter_mut().enumerate() {
        let middle = corners_of(&mesh, face).iter().sum::<Vec3>() / 3.0;
        triangle.part = u32::from(middle.x > 4.0);
    }
    let part = |guide, angle| PartGuide { guide, angle };
    let settings = ChartSettings {
        guides: vec![
            part(Guide::Along([1.0, 0.0, 7.0]), 0.0),
            part(Guide::Along([1.0, 0.0, 0.0]), 0.4),
        ],
        ..tiles_of(0.7)
    };
    let surface = ChartInput {
        positions: mesh.positions(),
        triangles: &triangles,
        directions: &[],
    };
    let chart = stroke_chart(&surface, &settings);
    assert_eq!(chart.singular_triangles, 0);
    for (face, triangle) in triangles.iter().enumerate() {
        let [_, v] = gradients(corners_of(&mesh, face), &chart.corners[face]);
        let angle = 0.4 * triangle.part as f32;
        let wanted = Vec3::new(npr_core::math::cos(angle), npr_core::math::sin(angle), 0.0);
        assert!((v * 0.7).dot(wanted).abs() > 0.999, "{face}: {v}");
    }
}

/// Both ends of every line on a bent sheet, a direction each.
fn painted_sheet(seed: u64) -> (Mesh, Vec<[f32; 3]>) {
    let mesh = mapped(&uneven_sheet(8, 8, seed), |[x, y, _]| [x, y, 0.02 * x * y]);
    let turn = |p: &[f32; 3]| {
        let angle = 0.15 * p[0];
        [npr_core::math::cos(angle), npr_core::math::sin(angle), 0.0]
    };
    let directions = mesh.positions().iter().map(turn).collect();
    (mesh, directions)
}

fn painted_chart(mesh: &Mesh, directions: &[[f32; 3]]) -> StrokeChart {
    let surface = ChartInput {
        positions: mesh.positions(),
        triangles: &triangles_of(mesh),
        directions,
    };
    stroke_chart(&surface, &guided(0.7, Guide::Painted))
}

#[test]
fn strokes_turn_as_they_are_painted() {
    let (mesh, directions) = painted_sheet(5);
    let chart = painted_chart(&mesh, &directions);
    let mut sum = 0.0;
    for (face, corners) in mesh.triangles().iter().enumerate() {
        let painted = corners.map(|vertex| Vec3::from(directions[vertex as usize]));
        let painted = (painted[0] + painted[1] + painted[2]).normalize();
        let [_, v] = gradients(corners_of(&mesh, face), &chart.corners[face]);
        let cos = v.normalize().dot(painted).abs();
        sum += cos;
        // Gradients have no curl, and what is painted has: a few triangles turn away from it.
        assert!(cos > 0.9, "{face}: {cos}");
    }
    // Ten degrees in the mean.
    assert!(sum / mesh.triangles().len() as f32 > 0.985, "{sum}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// Painting one direction everywhere is to follow that direction, whatever its sign and length at each vertex.
    #[test]
    fn one_painted_direction_is_a_fixed_one(
        seed in 0u64..1000, x in -1f32..1.0, y in -1f32..1.0, lengths in prop::collection::vec(0.1f32..9.0, 81),
        signs: u64,
    ) {
        prop_assume!(x * x + y * y > 0.01);
        let mesh = uneven_sheet(4, 4, seed);
        let sign = |i: usize| if signs >> (i % 64) & 1 == 0 { 1.0 } else { -1.0 };
        let directions: Vec<[f32; 3]> = (0..mesh.positions().len())
            .map(|i| [x, y, 0.5].map(|v| v * lengths[i % lengths.len()] * sign(i)))
            .collect();
        let painted = painted_chart(&mesh, &directions);
        let fixed = chart_of(&mesh, &guided(0.7, Guide::Along([x, y, 0.5])));
        for face in 0..mesh.triangles().len() {
            let corners = corners_of(&mesh, face);
            let [v, w] = [&painted, &fixed].map(|chart| gradients(corners, &chart.corners[face])[1]);
            prop_assert!(v.normalize().dot(w.normalize()).abs() > 0.999, "{v} is not {w}");
        }
    }

    #[test]
    fn any_directions_give_finite_charts(
        values in prop::collection::vec(prop::array::uniform3(prop::num::f32::ANY), 42),
    ) {
        let chart = painted_chart(&icosphere(1), &values);
        prop_assert!(chart.corners.as_flattened().as_flattened().iter().all(|v| v.is_finite()));
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let with_threads = |threads: usize, mesh: &Mesh| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| chart_of(mesh, &tiles_of(0.1)))
    };
    let soup = with_doubles(&random_soup(3_000, 1), 2);
    for mesh in [soup, bumpy(5, 3), unindexed(&torus(90, 60, 1.0, 0.3))] {
        let alone = with_threads(1, &mesh);
        assert!(alone == with_threads(2, &mesh));
        assert!(alone == with_threads(4, &mesh));
    }
}

#[test]
fn a_twisted_band_is_cut_where_its_winding_turns() {
    let mesh = moebius_strip(60);
    assert_eq!(torn_edges(&mesh, &tiles_of(0.2)), 0);
    let chart = chart_of(&mesh, &tiles_of(0.2));
    assert_eq!(chart.turning_triangles, 0);
}

#[test]
fn sizes_that_are_none_give_zeros() {
    for tile_world in [0.0, -1.0, f32::NAN, f32::INFINITY, 1e-44] {
        let chart = chart_of(&cube(), &tiles_of(tile_world));
        assert!(chart.corners.as_flattened().iter().all(|c| *c == [0.0; 2]));
        assert_eq!(chart.corners.len(), 12);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn a_flat_sheet_has_exact_spacing(
        columns in 1u32..9, rows in 1u32..9, seed: u64, tile in 0.05f32..20.0, angle in 0.0f32..6.3,
    ) {
        let mesh = uneven_sheet(columns, rows, seed);
        let (x, y) = (npr_core::math::cos(angle), npr_core::math::sin(angle));
        for guide in [Guide::Along([x, y, 0.0]), Guide::Curvature { across: true }] {
            let chart = chart_of(&mesh, &guided(tile, guide));
            prop_assert_eq!(chart.singular_triangles, 0);
            for (face, chart) in chart.corners.iter().enumerate() {
                let [u, v] = gradients(corners_of(&mesh, face), chart).map(|g| g * tile);
                prop_assert!((u.length() - 1.0).abs() < 1e-3 && (v.length() - 1.0).abs() < 1e-3);
                // Seen from the front, u lies to the right of v.
                prop_assert!((u.cross(v).z - 1.0).abs() < 1e-3);
                let along = (v.dot(Vec3::new(x, y, 0.0)).abs() - 1.0).abs() < 1e-3;
                prop_assert!(along || !matches!(guide, Guide::Along(_)));
            }
        }
    }

    #[test]
    fn strokes_close_round_a_tube_of_any_girth(
        around in 12u32..60, bands in 2u32..8, radius in 0.3f32..3.0, tiles in 5.0f32..40.0, across: bool,
    ) {
        let tube = Tube { around, bands, radius, tiles, across };
        let settings = tube.settings();
        prop_assert_eq!(torn_edges(&tube.mesh(), &settings), 0);
        let [round, along] = tube.spacings(&settings);
        let asked = along.iter().all(|spacing| (spacing - 1.0).abs() < 0.005);
        prop_assert!(asked, "{along:?}");
        let is_even = tube.stretches().into_iter().any(|stretch| spread_evenly(&round, stretch));
        prop_assert!(is_even, "{round:?} is none of {:?}", tube.stretches());
    }

    #[test]
    fn neighbours_agree_on_any_ball(seed: u64, level in 1u32..4, tile in 0.05f32..2.0) {
        let mesh = bumpy(level, seed);
        prop_assert_eq!(torn_edges(&mesh, &tiles_of(tile)), 0);
    }

    #[test]
    fn the_order_of_storage_changes_nothing(seed: u64, tile in 0.1f32..0.6) {
        let mesh = bumpy(2, seed);
        let mut order: Vec<usize> = (0..mesh.triangles().len()).collect();
        Random::new(seed).shuffle(&mut order);
        let shuffled = shuffled_vertices(&mesh, seed).0;
        let triangles = order.iter().map(|&face| shuffled.triangles()[face]).collect();
        let moved = Mesh::new(shuffled.positions().to_vec(), triangles).unwrap();
        let [before, after] = [&mesh, &moved].map(|mesh| chart_of(mesh, &tiles_of(tile)));
        for (&old, new) in order.iter().zip(&after.corners) {
            let [old, new] = [&before.corners[old], new].map(|chart| chart.map(Vec2::from_array));
            prop_assert!(agree(&old, &new, 1e-2), "{old:?} {new:?}");
        }
    }

    #[test]
    fn a_larger_copy_with_larger_tiles_has_the_same_chart(seed: u64, power in -8i32..8) {
        let mesh = bumpy(2, seed);
        let size = 2.0_f32.powi(power);
        let larger = mapped(&mesh, |p| p.map(|v| v * size));
        prop_assert_eq!(chart_of(&mesh, &tiles_of(0.3)), chart_of(&larger, &tiles_of(0.3 * size)));
    }

    #[test]
    fn anything_gives_finite_coordinates(
        seed: u64, faces in 0usize..40, power in -40i32..38, tile_power in -3i32..3, broken in 0usize..4,
    ) {
        let soup = with_doubles(&unindexed(&random_soup(faces, seed)), seed);
        let mut mesh = mapped(&soup, |p| p.map(|v| v * 10.0_f32.powi(power)));
        if broken > 0 && faces > 0 {
            let mut positions = mesh.positions().to_vec();
            let mut random = Random::new(seed);
            for _ in 0..broken {
                let vertex = random.below(positions.len());
                positions[vertex][random.below(3)] =
                    [f32::NAN, f32::INFINITY, f32::MAX, -0.0][random.below(4)];
            }
            mesh = mapped(&mesh, |p| p);
            let triangles = triangles_of(&mesh);
            let surface = ChartInput { positions: &positions, triangles: &triangles, directions: &[] };
            check_finite(&stroke_chart(&surface, &tiles_of(10.0_f32.powi(tile_power))), faces)?;
        }
        check_finite(&chart_of(&mesh, &tiles_of(10.0_f32.powi(power + tile_power))), faces)?;
    }
}

fn check_finite(chart: &StrokeChart, faces: usize) -> Result<(), TestCaseError> {
    prop_assert!(chart.corners.len() >= faces);
    let mut numbers = chart.corners.as_flattened().as_flattened().iter();
    prop_assert!(numbers.all(|v| v.is_finite()));
    prop_assert!(chart.gradient_error.is_finite());
    Ok(())
}
