//! Lines of pictures whose shape is known.

use super::*;
use crate::mesh_lines::draw::{LineSettings, LineSource, StrokeLook};
use crate::mesh_lines::run::Run;
use crate::mesh_lines::zero_set::CornerNormals;
use crate::project::Projector;
use crate::stroke::{Kind, Stroke};
use npr_core::camera::{Camera, Projection};
use npr_core::geometry::NONE;
use npr_core::line_kind::KindSet;
use npr_core::window::View;
use npr_mesh::half_edge::HalfEdgeMesh;
use npr_mesh::testing::{cube, plane, random_soup, shape_of, uv_sphere};
use proptest::prelude::*;

const BOUNDS: ([f32; 3], [f32; 3]) = ([-2.0; 3], [2.0; 3]);

/// The creases of 40 degrees and more.
const CREASE_COS: f32 = 0.766;

struct Subject {
    shape: HalfEdgeMesh,
    normals: CornerNormals,
    view: View,
    projector: Projector,
    kinds: u32,
}

impl Subject {
    fn new(shape: HalfEdgeMesh, eye: [f32; 3], projection: Projection, size: [u32; 2]) -> Self {
        let camera = Camera {
            eye,
            target: [0.0; 3],
            up: [0.0, 1.0, 0.0],
            projection,
        };
        Self {
            normals: CornerNormals::new(&shape, CREASE_COS),
            shape,
            view: camera.view(size, BOUNDS),
            projector: Projector::new(&camera, size, BOUNDS),
            kinds: KindSet::BITS,
        }
    }

    fn scene(&self) -> ImageScene<'_> {
        ImageScene {
            shape: &self.shape,
            normals: &self.normals,
            view: &self.view,
            is_drawn: &[],
            kinds: self.kinds,
            creases: CREASE_COS.into(),
            depth_threshold: 0.01,
        }
    }

    fn strokes_of(&self, runs: Vec<Run>, size: [u32; 2]) -> Vec<Stroke> {
        let look = StrokeLook {
            width_at: &|_| 2.0,
            paint_at: None,
            is_lit: false,
            follows_bends: false,
        };
        let settings = LineSettings {
            size,
            kinds: self.kinds,
            method: LineSource::Edges,
            smooth: true,
            hidden: false,
            split: None,
            memory_limit: u64::MAX,
        };
        strokes_from(runs, (&self.shape, self.projector.lens()), &settings, &look)
    }

    /// The strokes of ink.
    fn inked(&self, ink: &LineInk, picture: &SurfacePicture) -> Vec<Stroke> {
        let runs = ink.runs((&self.scene(), &self.projector, picture));
        self.strokes_of(runs.expect("a small picture"), picture.size)
    }

    /// The runs of the borders of a picture.
    fn runs(&self, picture: &SurfacePicture) -> Vec<Run> {
        let borders = picture.borders(&self.scene(), None);
        borders.runs((&self.scene(), &self.projector, picture))
    }

    fn strokes(&self) -> Vec<Stroke> {
        let picture = SurfacePicture::new(&self.scene());
        self.strokes_of(self.runs(&picture), picture.size)
    }
}

fn length_of(strokes: &[Stroke], kind: Kind) -> f64 {
    let of_kind = strokes.iter().filter(|stroke| stroke.kind == kind);
    of_kind.map(Stroke::length).sum()
}

#[test]
fn the_outline_of_a_ball_is_one_closed_stroke_on_its_edge() {
    let ball = shape_of(&uv_sphere(96, 48));
    let view = Projection::Parallel { height: 3.0 };
    let subject = Subject::new(ball, [0.0, 0.0, 6.0], view, [400, 300]);
    let of_world = |[x, y, _]: [f64; 3]| 100.0 * glam::DVec2::new(x, -y);
    let middle = glam::DVec2::new(200.0, 150.0);

    // What is found lies where the picture shows it.
    let picture = SurfacePicture::new(&subject.scene());
    for point in subject.runs(&picture).iter().flat_map(|run| &run.points) {
        let off = glam::DVec2::from(point.place) - middle - of_world(point.world.to_array());
        assert!(off.length() < 0.01, "{point:?}");
    }

    let found = subject.strokes();
    assert_eq!(found.len(), 1);
    assert!(found[0].closed && found[0].kind == Kind::Contour);
    for point in &found[0].points {
        let place = glam::DVec2::from(point.position) - middle;
        assert!((place.length() - 100.0).abs() < 0.8, "{point:?}");
        // Smoothing moves places, not what they were found on: by less than the stairs of pixels.
        let off = place - of_world(point.world.map(f64::from));
        assert!(off.length() < 0.5, "{point:?}");
        assert!((point.depth - 6.0).abs() < 0.5, "{point:?}");
    }
    let around = 100.0 * std::f64::consts::TAU;
    assert!((found[0].length() / around - 1.0).abs() < 0.02);
}

#[test]
fn a_cube_shows_each_of_its_nine_edges_once() {
    let eye = [3.0, 4.0, 5.0];
    let view = Projection::Perspective { fov_y: 0.8 };
    let cube = Subject::new(shape_of(&cube()), eye, view, [400, 300]);
    let found = cube.strokes();
    // Edges of which a face is turned to the eye; of the outline, one.
    let [mut outline, mut inner] = [0.0; 2];
    for edge in 0..cube.shape.edge_count() as u32 {
        let ends = cube.shape.ends(edge).map(|v| cube.shape.point(v));
        let faces: Vec<bool> = cube
            .shape
            .sides(edge)
            .iter()
            .map(|side| {
                let [a, b, c] = cube.shape.faces[*side as usize / 3].map(|v| cube.shape.point(v));
                (b - a)
                    .cross(c - a)
                    .dot(glam::DVec3::new(3.0, 4.0, 5.0) - a)
                    > 0.0
            })
            .collect();
        let length = {
            let [[ax, ay], [bx, by]] = ends.map(|end| cube.projector.project(end));
            ((bx - ax).powi(2) + (by - ay).powi(2)).sqrt()
        };
        match (&faces[..], cube.shape.dihedral_cos[edge as usize] < 0.5) {
            ([true, true], true) => inner += length,
            ([true, false] | [false, true], _) => outline += length,
            _ => {}
        }
    }
    let drawn = [Kind::Contour, Kind::Crease].map(|kind| length_of(&found, kind));
    for (drawn, expected) in drawn.into_iter().zip([outline, inner]) {
        assert!(
            (drawn / expected - 1.0).abs() < 0.04,
            "{drawn} of {expected} px"
        );
    }
    let ids: std::collections::BTreeSet<u64> = found.iter().map(|stroke| stroke.id).collect();
    assert_eq!(ids.len(), found.len());
}

#[test]
fn only_the_kinds_asked_for_are_found() {
    let view = Projection::Perspective { fov_y: 0.8 };
    let mut cube = Subject::new(shape_of(&cube()), [3.0, 4.0, 5.0], view, [200, 150]);
    cube.kinds = KindSet::CREASE;
    let found = cube.strokes();
    assert!(!found.is_empty() && found.iter().all(|stroke| stroke.kind == Kind::Crease));
    cube.kinds = KindSet::MATERIAL;
    assert_eq!(cube.strokes(), []);
}

/// One face of the cube turns away steeply, so that its creases are found by its edges.
#[test]
fn nothing_is_found_behind_smoke() {
    let view = Projection::Perspective { fov_y: 0.8 };
    let cube = Subject::new(shape_of(&cube()), [1.2, 4.0, 5.0], view, [400, 300]);
    let picture = SurfacePicture::new(&cube.scene());
    let count = |occluder_depths: Option<&[f32]>| {
        let ink = picture.borders(&cube.scene(), occluder_depths).ink();
        let places = (0..300).flat_map(|y| (0..400).map(move |x| (x, y)));
        places.filter(|(x, y)| ink.is_ink(*x, *y)).count()
    };
    let near = vec![f32::MAX; picture.depths.len()];
    assert_eq!(count(Some(&near)), 0);
    assert!(count(None) > 500);
    assert_eq!(count(Some(&picture.depths)), count(None));
}

/// A wall that fills the picture, with a dark line 3 pixels wide across it and a dark square.
#[test]
fn painted_lines_are_strokes_and_dark_surfaces_are_not() {
    let view = Projection::Parallel { height: 1.0 };
    let wall = Subject::new(shape_of(&plane(4, 4)), [0.0, 0.0, 5.0], view, [120, 80]);
    let picture = SurfacePicture::new(&wall.scene());
    let seen = picture.faces.iter().filter(|face| **face != NONE).count();
    assert!(seen > 1000, "{seen} pixels of the wall");
    let [width, height] = picture.size;
    let is_dark = |x: u32, y: u32| {
        let line = (30..33).contains(&y) && x > 2;
        line || (70..90).contains(&x) && (50..70).contains(&y)
    };
    let lightness: Vec<f32> = (0..width * height)
        .map(|i| {
            if is_dark(i % width, i / width) {
                0.2
            } else {
                0.9
            }
        })
        .collect();
    let none = LineInk::new(picture.size);
    let ink = painted(&picture, &lightness, &none, &PaintedRule::default());
    let found = wall.inked(&ink, &picture);
    let on_wall = |x: u32| picture.faces[(31 * width + x) as usize] != NONE;
    let expected = (3..width).filter(|x| on_wall(*x)).count() as f64;
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].kind, Kind::Marked);
    assert!(
        (found[0].length() - expected).abs() < 4.0,
        "{} of {expected} px",
        found[0].length()
    );
    for point in &found[0].points {
        assert!((point.position[1] - 31.5).abs() < 0.3, "{point:?}");
        assert!(
            (point.depth - 5.0).abs() < 1e-3 && point.width == 2.0,
            "{point:?}"
        );
    }
    // A gentler contrast is no line.
    let faint: Vec<f32> = lightness
        .iter()
        .map(|light| 0.9 + 0.2 * (light - 0.9))
        .collect();
    let ink = painted(&picture, &faint, &none, &PaintedRule::default());
    assert_eq!(wall.inked(&ink, &picture), []);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The closing is that of every square, looked at pixel by pixel.
    #[test]
    fn what_is_painted_is_dark_in_a_square_that_has_light_all_around(seed: u32, reach in 1u32..5) {
        let view = Projection::Parallel { height: 1.0 };
        let wall = Subject::new(shape_of(&plane(1, 1)), [0.0, 0.0, 5.0], view, [24, 20]);
        let picture = SurfacePicture::new(&wall.scene());
        let light = |i: u32| (npr_core::math::mix_bits(seed ^ npr_core::math::mix_bits(i)) % 16) as f32 / 15.0;
        let lightness: Vec<f32> = (0..480).map(light).collect();
        let rule = PaintedRule { reach_px: reach, contrast: 0.3, ..PaintedRule::default() };
        let ink = painted(&picture, &lightness, &LineInk::new(picture.size), &rule);
        let reach = i64::from(reach);
        let square = |x: i64, y: i64| {
            let own = picture.objects[(y * 24 + x) as usize];
            let around = (-reach..=reach).flat_map(move |dy| (-reach..=reach).map(move |dx| (x + dx, y + dy)));
            let inside = around.filter(|(x, y)| (0..24).contains(x) && (0..20).contains(y));
            inside.filter(|(x, y)| picture.objects[(y * 24 + x) as usize] == own).collect::<Vec<_>>()
        };
        let at = |(x, y): &(i64, i64)| lightness[(y * 24 + x) as usize];
        let greatest = |p: &(i64, i64)| square(p.0, p.1).iter().map(at).fold(0.0, f32::max);
        for (x, y) in (0..480).map(|i| (i % 24, i / 24)) {
            let closed = square(x, y).iter().map(greatest).fold(1.0, f32::min);
            let is_line = closed - at(&(x, y)) >= 0.3 && picture.faces[(y * 24 + x) as usize] != NONE;
            prop_assert_eq!(ink.is_ink(x as u32, y as u32), is_line, "{} {}", x, y);
        }
    }

    /// Light lines are the dark ones of the negative, and lines on their ground those where the mean of a plain walk
    /// lies beyond half way.
    #[test]
    fn light_lines_are_those_of_the_negative(seed: u32, bare in 0u32..4) {
        let view = Projection::Parallel { height: 1.0 };
        let wall = Subject::new(shape_of(&plane(1, 1)), [0.0, 0.0, 5.0], view, [24, 20]);
        let picture = SurfacePicture::new(&wall.scene());
        // Sixteenths, so that the negative is exact; some pixels have no paint.
        let light = |i: u32| {
            let bits = npr_core::math::mix_bits(seed ^ npr_core::math::mix_bits(i));
            if bits >> 8 & 15 < bare { f32::NAN } else { (bits % 17) as f32 / 16.0 }
        };
        let lightness: Vec<f32> = (0..480).map(light).collect();
        let negative: Vec<f32> = lightness.iter().map(|light| 1.0 - light).collect();
        let ink_of = |lightness: &[f32], tone, on_ground| {
            let rule = PaintedRule { reach_px: 1, contrast: 0.3, tone, on_ground };
            painted(&picture, lightness, &LineInk::new(picture.size), &rule)
        };
        for on_ground in [false, true] {
            let light = ink_of(&lightness, PaintedTone::Light, on_ground);
            let dark = ink_of(&negative, PaintedTone::Dark, on_ground);
            prop_assert!(light.is_light && !dark.is_light);
            prop_assert_eq!(light.owners, dark.owners);
        }
        let all = ink_of(&lightness, PaintedTone::Dark, false);
        let grounded = ink_of(&lightness, PaintedTone::Dark, true);
        let around = |x: i64, y: i64, reach: i64| {
            let square = (-reach..=reach).flat_map(move |dy| (-reach..=reach).map(move |dx| (x + dx, y + dy)));
            let inside = square.filter(|(x, y)| (0..24).contains(x) && (0..20).contains(y));
            let own = picture.objects[(y * 24 + x) as usize];
            let values = inside.map(|(x, y)| (y * 24 + x) as usize);
            let values = values.filter(|at| picture.objects[*at] == own && !lightness[*at].is_nan());
            values.collect::<Vec<usize>>()
        };
        for (x, y) in (0..480).map(|i| (i % 24, i / 24)) {
            let at = |pixels: Vec<usize>| pixels.into_iter().map(|at| f64::from(lightness[at])).collect::<Vec<f64>>();
            let greatest = |pixel: usize| {
                let (x, y) = ((pixel % 24) as i64, (pixel / 24) as i64);
                at(around(x, y, 1)).into_iter().fold(0.0, f64::max)
            };
            let closed = around(x, y, 1).into_iter().map(greatest).fold(1.0, f64::min);
            let ground = at(around(x, y, i64::from(GROUND)));
            let mean = ground.iter().sum::<f64>() / ground.len() as f64;
            let half_way = (f64::from(lightness[(y * 24 + x) as usize]) + closed) / 2.0;
            let (x, y) = (x as u32, y as u32);
            prop_assert!(!lightness[(y * 24 + x) as usize].is_nan() || !all.is_ink(x, y));
            if (mean - half_way).abs() > 1e-5 {
                prop_assert_eq!(grounded.is_ink(x, y), all.is_ink(x, y) && mean > half_way);
            }
        }
    }

    #[test]
    fn any_soup_gives_sound_strokes(faces in 0usize..60, seed: u64, x in -4.0..4.0f32) {
        let view = Projection::Perspective { fov_y: 0.8 };
        let soup = Subject::new(shape_of(&random_soup(faces, seed)), [x, 1.0, 5.0], view, [90, 60]);
        for stroke in soup.strokes() {
            prop_assert!(stroke.points.len() >= 2 && stroke.is_visible());
            for point in &stroke.points {
                let [x, y] = point.position;
                prop_assert!((-3.0..93.0).contains(&x) && (-3.0..63.0).contains(&y));
                prop_assert!(point.depth.is_finite() && point.width > 0.0);
            }
        }
    }
}
