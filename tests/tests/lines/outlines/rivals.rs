//! The methods that the published one was compared with, and their known faults.

use super::fixture::{
    cube_creases, cube_drawing, cube_front_silhouette, cube_other_silhouette, cube_wanted, front,
    with,
};
use npr_mesh::testing::uv_sphere;
use npr_stylesheet::Style;
use npr_tests::{Ink, Object, asset, draw, lines, placed};

fn ball(name: &str, x: f32) -> Object {
    Object::new(name, placed(&uv_sphere(64, 48), [0.4; 3], [x, 0.0, 0.0]))
}

#[test]
fn the_filter_width_depends_on_the_resolution_and_ours_does_not() {
    // Ink per length of line in pixels of a frame of 360 rows: the width as people see it.
    let width = |method: &str, height: u32, settings: &[&str]| {
        let style = with(with(lines(method), &["line.width.base=12"]), settings);
        let ink = Ink::of(&draw(
            &asset("cube_plane.glb"),
            &style,
            [height * 16 / 9, height],
        ));
        ink.count() as f32 / height as f32 / height as f32
    };
    let (small, large) = (width("filter", 360, &[]), width("filter", 1080, &[]));
    assert!(
        small > 2.5 * large,
        "the filter's lines thin out: {small} to {large}"
    );
    let (small, large) = (width("shape", 360, &[]), width("shape", 1080, &[]));
    assert!(
        (small / large - 1.0).abs() < 0.06,
        "ours stay: {small} to {large}"
    );
}

#[test]
fn our_width_does_not_depend_on_the_mask() {
    let area = |method: &str, scale: &str| {
        let style = with(lines(method), &["line.width.base=8px", scale]);
        Ink::of(&cube_drawing(&style).frame).count() as f32
    };
    let fine = area("shape", "detect.scale=1");
    for scale in ["detect.scale=1.5", "detect.scale=3"] {
        let coarse = area("shape", scale);
        assert!(
            (coarse / fine - 1.0).abs() < 0.02,
            "{scale}: {coarse} px of ink, {fine} at full scale"
        );
    }
    assert!(area("filter", "detect.scale=3") > 2.5 * area("filter", "detect.scale=1"));
}

#[test]
fn the_hull_draws_silhouettes_only() {
    let drawing = cube_drawing(&with(lines("hull"), &["line.width.base=6px"]));
    let (ink, view) = (Ink::of(&drawing.frame), &drawing.view);
    let silhouette = cube_front_silhouette(view).and(cube_other_silhouette(view));
    assert!(ink.share_of(&silhouette, 3.0) > 0.99);
    assert!(ink.share_of(&cube_creases(view), 2.0) < 0.1);
}

#[test]
fn the_union_holds_both_rivals() {
    let ink =
        |method: &str| Ink::of(&cube_drawing(&with(lines(method), &["line.width.base=6px"])).frame);
    let (filter, hull, union) = (ink("filter"), ink("hull"), ink("filter+hull"));
    assert_eq!(
        filter.without(&union).count() + hull.without(&union).count(),
        0
    );
    assert_eq!(union.without(&filter).without(&hull).count(), 0);
}

#[test]
fn front_and_back_faces_share_the_silhouette_edges_only() {
    let drawing = cube_drawing(&lines("edges"));
    let (ink, view) = (Ink::of(&drawing.frame), &drawing.view);
    let silhouette = cube_front_silhouette(view).and(cube_other_silhouette(view));
    assert_eq!(ink.share_of(&silhouette, 1.5), 1.0);
    assert!(ink.share_of(&cube_creases(view), 1.5) < 0.1);
    assert!(ink.farthest_from(&cube_wanted(view)) < 2.5);
}

#[test]
fn the_surface_angle_has_a_threshold_for_each_material() {
    let rule = "[[rule]]\nmatch.material = \"Bold\"\nline.angle_threshold_deg = 40.0\n";
    let text = format!(
        "extends = \"toon\"\nline.method = \"angle\"\nline.color = \"#000000\"\nline.angle_threshold_deg = \
         15.0\nshade.mode = \"paper\"\nshade.ramp = [{{ at = 0.0, light = 1.0 }}]\n{rule}"
    );
    let style = Style::from_toml(&text, &|parent| Err(parent.to_owned())).unwrap();
    let ink = Ink::of(&front(&[ball("Fine", -0.5), ball("Bold", 0.5)], &style).frame);
    let bold = ink.centers().filter(|center| center[0] > 100.0).count();
    let fine = ink.count() - bold;
    assert!(
        fine > 50 && bold > 3 * fine,
        "{bold} px on the bold ball, {fine} on the fine one"
    );
}

#[test]
fn the_hull_follows_control_points() {
    let point =
        "line.width.control_points=[{ position = [0.4, 0.0, 0.0], radius = 0.5, factor = 2.0 }]";
    let style = with(
        lines("hull"),
        &[
            "line.width.base=8px",
            "line.width.max=2",
            point,
            "line.width.source=control-points",
        ],
    );
    let ink = Ink::of(&front(&[ball("Ball", 0.0)], &style).frame);
    let run_from = |x: f32| {
        [0.0, 2.0, 4.0].map(|d| ink.run([x + d * (x - 100.0).signum(), 100.5], [1.0, 0.0]))
    };
    let [near, far] = [140.5, 59.5].map(|x| run_from(x).into_iter().fold(0.0, f32::max));
    assert!(
        near > far + 1.5,
        "{near} px near the point, {far} px away from it"
    );
}
