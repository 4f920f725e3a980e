//! `--timings`.

use crate::workplace::Workplace;

#[test]
fn times_go_to_standard_error_as_a_table_or_as_json() {
    let place = Workplace::with_scene();
    let table = place.render("scene.obj", &["--timings"]);
    assert_eq!(table.code, Some(0));
    for word in [
        "processor",
        "load",
        "prepare",
        "draw",
        "shade.compose_frame",
        "encode",
    ] {
        assert!(table.stderr.contains(word), "{}", table.stderr);
    }

    let json = place.render("scene.obj", &["--timings", "json"]);
    let times: serde_json::Value = serde_json::from_str(&json.stderr).expect("JSON");
    let passes = times["passes"].as_array().expect("a list");
    assert!(
        passes
            .iter()
            .any(|pass| pass["name"] == "raster.draw_ids" && pass["ms"].as_f64() >= Some(0.0))
    );
    assert!(json.stdout.is_empty() && table.stdout.is_empty());
}
