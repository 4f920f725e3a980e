//! Masks coarser than the drawing.

use super::fixture::{SIZE, cube_drawing, cube_wanted, detecting, with};
use npr_render::Frame;
use npr_stylesheet::width_rule;
use npr_tests::{Ink, asset, draw, lines};

const FRAME: [u32; 2] = [960, 540];

fn teapot(method: &str, scale: f32, settings: &[&str]) -> Frame {
    let style = with(lines(method), &[&format!("detect.scale={scale}")]);
    draw(
        &asset("teapot_box_plane.glb"),
        &with(style, settings),
        FRAME,
    )
}

#[test]
fn lines_lie_in_the_same_places_at_every_scale() {
    for scale in [1.0, 1.5, 3.0, 6.0] {
        let style = detecting("shape", &["detect.depth.on", "detect.normal.on"]);
        let style = with(
            style,
            &["line.width.base=6px", &format!("detect.scale={scale}")],
        );
        let drawing = cube_drawing(&style);
        let (ink, wanted) = (Ink::of(&drawing.frame), cube_wanted(&drawing.view));
        assert!(ink.share_of(&wanted, 2.0) > 0.99, "gaps at scale {scale}");
        let apart = ink.farthest_from(&wanted);
        assert!(
            apart <= 3.0 + 1.0 + scale,
            "{apart} px off at scale {scale}"
        );
    }
}

#[test]
fn masks_of_both_scales_differ_by_a_texel_at_most() {
    // At the default of 40 degrees bends of the teapot lie at the threshold.
    let bends = ["detect.normal.threshold_deg=35"];
    let fine = Ink::of(&teapot("filter", 1.0, &bends));
    for scale in [1.5f32, 2.0, 3.0] {
        let coarse = Ink::of(&teapot("filter", scale, &bends));
        let texel = scale.ceil() as i32;
        let [more, less] = [
            coarse.without(&fine.grown(texel)),
            fine.without(&coarse.grown(texel)),
        ];
        let off = [more.count(), less.count()];
        // Bends show as creases on a coarser mask sooner; apart from those, every pixel has its like.
        assert!(
            off[0] * 50 <= fine.count() && off[1] * 500 <= fine.count(),
            "scale {scale}: {off:?} of {}",
            fine.count()
        );
    }
}

#[test]
fn drawings_stay_about_equal_down_to_a_third() {
    let wide = ["line.width.base=6px"];
    let fine = Ink::of(&teapot("shape", 1.0, &wide));
    for scale in [1.5, 3.0] {
        let coarse = Ink::of(&teapot("shape", scale, &wide));
        let moved = coarse.without(&fine.grown(2)).count() + fine.without(&coarse.grown(2)).count();
        assert!(
            moved * 50 <= fine.count(),
            "scale {scale}: {moved} of {}",
            fine.count()
        );
    }
}

#[test]
fn a_mask_thicker_than_the_line_shows_noise_and_a_warning() {
    // Interior edges show wherever the published lookup lands on a mask line they merely cross.
    let noise = |method: &str, scale: f32| {
        let fine = Ink::of(&teapot(method, 1.0, &[]));
        Ink::of(&teapot(method, scale, &[]))
            .without(&fine.grown(2))
            .count()
    };
    let (kept, broken) = (noise("okuya", 1.5), noise("okuya", 6.0));
    assert!(
        broken > 10 * kept.max(50),
        "{kept} px of noise at 1.5, {broken} at 6"
    );
    assert!(
        noise("shape", 6.0) * 3 < broken,
        "edges chosen by kind stay calm"
    );
    assert!(width_rule(6.0, 3.0).is_some() && width_rule(1.5, 3.0).is_none());
}

#[test]
fn rescaled_thresholds_find_the_same_lines_on_a_coarse_mask() {
    // A slope under the threshold on the fine mask rises over it on a coarse one, unless the threshold grows too.
    let scene = super::fixture::cube_before_plane();
    let ink = |scale: u32, rescale: bool| {
        let style = detecting("filter", &["detect.depth.on"]);
        let settings = [
            "detect.plane_depth=false".to_owned(),
            format!("detect.scale={scale}"),
            format!("detect.rescale_thresholds={rescale}"),
        ];
        let style = with(style, &settings.each_ref().map(String::as_str));
        Ink::of(&npr_tests::draw_from(&scene, &style, &super::fixture::corner_camera(), SIZE).frame)
    };
    // The same lines lie within a texel of each other; all that lies farther off is another line.
    let (fine, same, bare) = (ink(1, true), ink(6, true), ink(6, false));
    let stray = |ink: &Ink| ink.without(&fine.grown(7)).count() as f32 / ink.count() as f32;
    let lost = fine.without(&same.grown(7)).count();
    println!(
        "{} stray of rescaled, {} of bare, {lost} lost",
        stray(&same),
        stray(&bare)
    );
    assert!(
        stray(&same) < 0.01,
        "{} of the rescaled mask are other lines",
        stray(&same)
    );
    assert!(
        stray(&bare) > 0.2,
        "{} of the bare mask are other lines",
        stray(&bare)
    );
    assert!(
        lost * 100 < fine.count(),
        "{lost} px of {} are lost",
        fine.count()
    );
}
