//! Smoke: from the simulation, from files and series, alone and in scenes.

use crate::workplace::{Outcome, Workplace};
use npr_vdb::ValueType;
use npr_vdb::testing::{Sample, SampleGrid, npy_file};

/// A small and quick drawing of smoke.
const SMALL: [&str; 6] = ["--size", "48x32", "--backend", "cpu", "--spheres", "30"];

fn smoke(place: &Workplace, arguments: &[&str]) -> Outcome {
    place.npr(&[&["smoke"], arguments, &SMALL[..]].concat())
}

/// A ball of smoke whose middle lies at a height, as a file.
fn ball(height: i32) -> Vec<u8> {
    let mut sample = Sample::ball(4);
    let voxels = std::mem::take(&mut sample.grids[0].voxels);
    let moved = voxels
        .into_iter()
        .map(|([x, y, z], value)| ([x, y + height, z], value));
    sample.grids[0].voxels = moved.collect();
    sample.bytes()
}

/// A grid of voxels with these values in a row.
fn row(name: &str, values: &[f32]) -> SampleGrid {
    let mut grid = SampleGrid::new(name, ValueType::Float);
    let voxels = (0i32..).zip(values);
    let voxels = voxels.map(|(x, value)| ([x, 0, 0], ([*value, 0.0, 0.0], true)));
    grid.voxels = voxels.collect();
    grid
}

/// The pixels of a picture, as its file has them.
fn is_blank(place: &Workplace, name: &str) -> bool {
    let picture = image::load_from_memory(&place.get(name))
        .expect("a picture")
        .into_rgba8();
    let first = picture.get_pixel(0, 0);
    picture.pixels().all(|pixel| pixel == first)
}

#[test]
fn every_built_in_source_gives_a_picture() {
    let place = Workplace::new();
    for source in ["plume", "puff", "explosion", "cloud"] {
        let more = ["--grid", "12x12x16", "--frames", "8"];
        smoke(&place, &[&[source], &more[..]].concat()).assert_silent_success();
        assert!(!is_blank(&place, &format!("{source}.png")), "{source}");
    }
}

/// How many pixels of a picture are not as white as the paper.
fn covered(place: &Workplace, name: &str) -> usize {
    let picture = image::load_from_memory(&place.get(name))
        .expect("a picture")
        .into_rgba8();
    picture.pixels().filter(|pixel| pixel.0 != [255; 4]).count()
}

/// Smoke is born and grows, and covers as much in a frame alone as in that of a film.
#[test]
fn a_film_shows_the_birth_of_smoke_and_a_frame_alone_is_one_of_it() {
    let place = Workplace::new();
    let plume = "smoke plume --grid 15x15x20 --eye 0,0.5,2 --target 0,0.5,0 --size 160x120 --backend cpu --spheres 60";
    for particles in ["cover", "published"] {
        let chosen = format!("{plume} --particles {particles}");
        let draw = |more: &str| {
            let command = format!("{chosen} {more}");
            let words: Vec<&str> = command.split(' ').collect();
            place.npr(&words).assert_silent_success();
        };
        draw("--frames 3..40 -o p_##.png");
        let names: Vec<String> = (3..=40).map(|frame| format!("p_{frame:02}.png")).collect();
        assert!(names.iter().all(|name| place.names().contains(name)));
        let sizes = [3, 12, 24, 40].map(|frame| covered(&place, &format!("p_{frame:02}.png")));
        println!("{particles}: {sizes:?}");
        assert!(
            sizes[0] > 0 && 2 * sizes[3] > 3 * sizes[0],
            "{particles}: {sizes:?}"
        );
        draw("--frames 24 -o again.png");
        assert_eq!(covered(&place, "again.png"), sizes[2], "{particles}");
    }
}

/// Every command that draws volumes draws the published particles where they are asked for, by option or by style,
/// the same for any number of threads; and ours without.
#[test]
fn published_particles_are_drawn_by_every_command() {
    let place = Workplace::with_scene();
    place.put("ball.vdb", &ball(0));
    let commands: [&[&str]; 5] = [
        &["smoke", "plume", "--grid", "12x12x16", "--frames", "12"],
        &["smoke", "ball.vdb"],
        &["render", "ball.vdb"],
        &["render", "scene.obj", "--volume", "ball.vdb@0.3,0,1*0.1"],
        &["lines", "scene.obj", "--volume", "puff"],
    ];
    for command in commands {
        let drawn = |threads: &str, more: &[&str]| {
            let mut command = place.command(&[command, &SMALL[..], &["-o", "-"], more].concat());
            command.env("RAYON_NUM_THREADS", threads);
            let outcome = Outcome::of(command.output().expect("it starts"));
            assert_eq!(
                (outcome.code, outcome.stderr.as_str()),
                (Some(0), ""),
                "{more:?}"
            );
            outcome.stdout
        };
        let published = drawn("1", &["--particles", "published"]);
        assert!(
            published == drawn("3", &["--particles", "published"]),
            "{command:?}: threads"
        );
        assert!(
            published == drawn("2", &["--set", "smoke.particles=published"]),
            "{command:?}: --set"
        );
        assert!(published != drawn("2", &[]), "{command:?}: ours");
        assert!(
            drawn("1", &[]) == drawn("2", &["--particles", "cover"]),
            "{command:?}: cover"
        );
        assert!(
            published != drawn("2", &["--particles", "published", "--seed", "9"]),
            "{command:?}: seeds"
        );
    }
}

#[test]
fn the_number_of_spheres_is_the_users_for_both_kinds() {
    let place = Workplace::new();
    let strokes = |particles: &str, count: &str| {
        let command = [
            "lines",
            "puff",
            "--particles",
            particles,
            "--spheres",
            count,
            "--format",
            "json",
        ];
        let outcome = place.npr(&[&command[..], &["-q", "-o", "-", "--size", "320x240"]].concat());
        outcome.assert_silent_success();
        let drawing: serde_json::Value = serde_json::from_str(outcome.text()).expect("JSON");
        drawing["strokes"].as_array().expect("strokes").len()
    };
    for particles in ["cover", "published"] {
        let (few, many) = (strokes(particles, "8"), strokes(particles, "300"));
        assert!(
            0 < few && 2 * few < many,
            "{particles}: {few} strokes, then {many}"
        );
    }
}

#[test]
fn particles_are_born_where_the_user_says() {
    let place = Workplace::new();
    place.put("ball.vdb", &ball(0));
    let published = [
        "ball.vdb",
        "--particles",
        "published",
        "--eye",
        "0,0,20",
        "--target",
        "0,0,0",
    ];
    let drawn = |more: &[&str]| {
        let outcome = smoke(&place, &[&published[..], &["-o", "out.png"], more].concat());
        outcome.assert_silent_success();
        covered(&place, "out.png")
    };
    let (anywhere, above) = (drawn(&[]), drawn(&["--emitter", "0,3,0*1.5"]));
    assert!(
        0 < above && above < anywhere,
        "{above} of {anywhere} pixels"
    );
    smoke(&place, &[&published[..], &["--emitter", "0,3,0"]].concat())
        .assert_fault(2, "a point and a radius");
    let idle = smoke(&place, &["ball.vdb", "--emitter", "0,3,0*1.5"]);
    assert_eq!(
        idle.stderr,
        "npr: warning: --emitter is ignored: smoke.particles is cover\n"
    );
}

/// Said once, by name, and only where there is smoke.
#[test]
fn keys_that_cannot_act_are_named() {
    let place = Workplace::with_scene();
    place.put("ball.vdb", &ball(0));
    let boards = [
        "--set",
        "smoke.method=billboards",
        "--set",
        "smoke.sigma=3px",
        "--set",
        "smoke.line.width=9",
    ];
    let reported = |command: &[&str]| {
        let outcome = place.npr(&[command, &SMALL[..], &boards, &["-o", "-"]].concat());
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        outcome.stderr
    };
    let wanted = "npr: warning: 'smoke.line.width' is ignored: billboards have the published line\n\
                  npr: warning: 'smoke.sigma' is ignored: \
                  smoke.method is billboards, which have one tone without smoke.heat\n";
    assert_eq!(reported(&["smoke", "ball.vdb"]), wanted);
    assert_eq!(
        reported(&["render", "scene.obj", "--volume", "ball.vdb"]),
        wanted
    );
    assert_eq!(
        reported(&["render", "scene.obj"]),
        "npr: warning: 'smoke.line.width', 'smoke.method' and 'smoke.sigma' are ignored: \
         the scene has no smoke\n\
         npr: warning: --spheres is ignored: the scene has no smoke\n"
    );
}

#[test]
fn half_steps_draw_pictures_between_frames() {
    let place = Workplace::new();
    let plume = ["plume", "--grid", "15x15x20", "--step", "0.5"];
    smoke(
        &place,
        &[&plume[..], &["--frames", "3..5", "-o", "h_#.png"]].concat(),
    )
    .assert_silent_success();
    assert_eq!(
        place.names(),
        ["h_3.png", "h_4.png", "h_5.png", "h_6.png", "h_7.png"]
    );
}

#[test]
fn smoke_is_the_same_for_any_number_of_threads_and_other_for_another_seed() {
    let place = Workplace::new();
    let drawn = |threads: &str, more: &[&str]| {
        let fixed = [
            "smoke",
            "explosion",
            "--grid",
            "16x16x16",
            "--frames",
            "6",
            "-o",
            "-",
        ];
        let mut command = place.command(&[&fixed[..], &SMALL, more].concat());
        command.env("RAYON_NUM_THREADS", threads);
        let outcome = Outcome::of(command.output().expect("it starts"));
        assert_eq!((outcome.code, outcome.stderr.as_str()), (Some(0), ""));
        outcome.stdout
    };
    let one = drawn("1", &[]);
    for threads in ["2", "8"] {
        assert!(one == drawn(threads, &[]), "{threads} threads");
    }
    assert!(one != drawn("2", &["--seed", "7"]));
}

#[test]
fn a_volume_is_drawn_by_any_command_and_from_standard_input() {
    let place = Workplace::new();
    place.put("puff.vdb", &ball(0));
    smoke(&place, &["puff.vdb"]).assert_silent_success();
    let by_smoke = place.get("puff.png");
    assert!(!is_blank(&place, "puff.png"));
    place
        .npr(&[&["render", "puff.vdb"], &SMALL[..]].concat())
        .assert_silent_success();
    assert!(by_smoke == place.get("puff.png"), "render draws it alike");
    for command in ["smoke", "render"] {
        let style = ["--style", "smoke-cel-2", "-o", "-"];
        let fed = place.npr_fed(&[&[command, "-"], &SMALL[..], &style].concat(), &ball(0));
        assert_eq!((fed.code, fed.stderr.as_str()), (Some(0), ""), "{command}");
        assert!(by_smoke == fed.stdout, "{command}");
    }
}

#[test]
fn a_series_is_a_film_and_estimates_its_motion_once() {
    let place = Workplace::new();
    for frame in 1..=3 {
        place.put(&format!("s_{frame:04}.vdb"), &ball(2 * frame));
    }
    let outcome = smoke(&place, &["s_####.vdb", "-o", "out_#.png", "--step", "0.5"]);
    assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
    assert_eq!(
        outcome.stderr.matches("velocities are estimated").count(),
        1,
        "{}",
        outcome.stderr
    );
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    let pictures = [
        "out_1.png",
        "out_2.png",
        "out_3.png",
        "out_4.png",
        "out_5.png",
    ];
    assert_eq!(&place.names()[..5], pictures);
    assert!(pictures.iter().all(|name| !is_blank(&place, name)));
}

#[test]
fn a_missing_frame_is_named() {
    let place = Workplace::new();
    for frame in [1, 3] {
        place.put(&format!("s_{frame}.vdb"), &ball(frame));
    }
    smoke(&place, &["s_#.vdb", "-o", "o_#.png"]).assert_fault(1, "cannot read 's_2.vdb': ");
    smoke(&place, &["s_#.vdb", "-o", "o_#.png", "--frames", "3..4"])
        .assert_fault(1, "cannot read 's_4.vdb': ");
    smoke(&place, &["t_#.vdb", "-o", "o_#.png"]).assert_fault(1, "no file such as 't_1.vdb'");
    assert_eq!(place.names(), ["s_1.vdb", "s_3.vdb"]);
}

#[test]
fn smoke_in_a_scene_lies_where_it_is_put() {
    let place = Workplace::with_scene();
    place.put("puff.vdb", &ball(0));
    let eye = [
        "--eye",
        "0.3,0.3,4",
        "--target",
        "0.3,0.3,0",
        "-o",
        "out.png",
    ];
    let drawn = |volumes: &[&str]| {
        let outcome = place.render("scene.obj", &[&eye[..], volumes].concat());
        outcome.assert_silent_success();
        place.get("out.png")
    };
    let bare = drawn(&[]);
    let before = drawn(&["--volume", "puff.vdb@0.3,0,1*0.1"]);
    let behind = drawn(&["--volume", "puff.vdb@0.3,0,-1*0.1"]);
    assert!(bare != before && bare != behind && before != behind);
    assert!(
        bare == drawn(&["--volume", "puff.vdb@900,0,900*0.1"]),
        "out of sight"
    );
    let both = [
        "--volume",
        "puff.vdb@0.3,0,1*0.1",
        "--volume",
        "puff.vdb@0.3,0,-1*0.1",
    ];
    assert!(before != drawn(&both));
}

#[test]
fn what_is_wrong_with_a_volume_is_told_in_a_line() {
    let place = Workplace::new();
    place.put(
        "two.vdb",
        &Sample::new(vec![row("a", &[1.0]), row("b", &[1.0])]).bytes(),
    );
    place.put("far.vdb", &Sample::new(vec![far(4000)]).bytes());
    place.put("wide.vdb", &Sample::new(vec![far(400)]).bytes());
    place.put("text.vdb", b"no volume at all");
    place.put("cut.vdb", &ball(0)[..200]);
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (4000, 4000, 4000), }";
    place.put("claim.npy", &npy_file(header, &[0; 64]));
    let names = place.names();
    let cases: [(&[&str], i32, &str); 9] = [
        (
            &["two.vdb"],
            3,
            "cannot read 'two.vdb': no grid is called density; name one of 'a', 'b'",
        ),
        (&["two.vdb", "--density", "c"], 2, "there is no grid 'c'"),
        (
            &["two.vdb", "--density", "a", "--velocity", "a,b"],
            2,
            "2 grids",
        ),
        (&["far.vdb"], 5, "4001x4001x4001 voxels exceeds the limit"),
        (
            &["wide.vdb", "--memory-limit", "1M"],
            5,
            "--memory-limit lifts that",
        ),
        (&["text.vdb"], 3, "cannot read 'text.vdb': this is neither"),
        (&["cut.vdb"], 3, "cannot read 'cut.vdb': "),
        (
            &["claim.npy"],
            3,
            "the shape needs 256000000000 bytes, but 64 follow",
        ),
        (&["gone.vdb"], 1, "cannot read 'gone.vdb': "),
    ];
    for (arguments, code, text) in cases {
        smoke(&place, &[arguments, &["-o", "out.png"]].concat()).assert_fault(code, text);
        let volume = [&["render", arguments[0], "-o", "out.png"], &arguments[1..]].concat();
        place
            .npr(&[&volume[..], &SMALL].concat())
            .assert_fault(code, text);
        assert_eq!(place.names(), names, "{arguments:?}");
    }
}

/// Two voxels that lie far apart.
fn far(end: i32) -> SampleGrid {
    let mut grid = row("density", &[1.0]);
    grid.voxels.insert([end; 3], ([1.0, 0.0, 0.0], true));
    grid
}

#[test]
fn smoke_that_is_none_is_an_empty_picture_and_a_word() {
    let place = Workplace::new();
    place.put(
        "thin.vdb",
        &Sample::new(vec![row("density", &[0.01])]).bytes(),
    );
    place.put(
        "nan.vdb",
        &Sample::new(vec![row("density", &[f32::NAN, -2.0, f32::INFINITY])]).bytes(),
    );
    place.put("none.vdb", &Sample::new(vec![row("density", &[])]).bytes());
    let cases = [
        ("thin", "no density is above 0.1: the greatest is 0.01"),
        (
            "nan",
            "3 densities that are negative or no numbers count as 0",
        ),
        ("none", "there is no smoke"),
    ];
    for (name, text) in cases {
        let outcome = smoke(&place, &[&format!("{name}.vdb")]);
        assert_eq!(outcome.code, Some(0), "{}", outcome.stderr);
        assert!(outcome.stderr.contains(text), "{}", outcome.stderr);
        assert!(is_blank(&place, &format!("{name}.png")), "{name}");
    }
    let outcome = smoke(&place, &["thin.vdb", "--threshold", "0.001"]);
    outcome.assert_silent_success();
    assert!(!is_blank(&place, "thin.png"));
}

#[test]
fn what_does_not_fit_together_is_refused_before_any_work() {
    let place = Workplace::with_scene();
    place.assert_refused(&[
        (&["smoke"], "<SOURCE>"),
        (
            &["smoke", "plume", "--frames", "1..9", "-o", "one.png"],
            "9 frames do not fit into one file",
        ),
        (
            &["smoke", "plume", "--frames", "9..1"],
            "must not end before it begins",
        ),
        (&["smoke", "plume", "--grid", "2x9x9"], "--grid: "),
        (&["smoke", "plume", "--fps", "0"], "--fps"),
        (
            &["smoke", "plume", "-o", "out.gif"],
            "pictures are written as .png",
        ),
        (&["smoke", "plume", "--camera", "0"], "no camera '0'"),
        (&["smoke", "plume", "--camera", "-1"], "no camera '-1'"),
        (
            &["render", "scene.obj", "--volume", "a.vdb@1,2"],
            "three numbers",
        ),
        (&["render", "scene.obj", "--volume", "a_##.vdb"], "series"),
    ]);
    place.put("ball.vdb", &ball(0));
    smoke(&place, &["ball.vdb", "--grid", "9x9x9"]).assert_fault(2, "--grid is of the built-in");
    smoke(&place, &["ball.vdb", "--frames", "2"]).assert_fault(2, "is one frame");
    smoke(
        &place,
        &["ball.vdb", "-o", "ball.vdb.png", "--memory-limit", "10K"],
    )
    .assert_fault(5, "--memory-limit");
    place
        .npr(&[
            "render",
            "scene.obj",
            "--volume",
            "ball.vdb",
            "-o",
            "ball.vdb",
        ])
        .assert_fault(2, "");
    assert_eq!(place.names(), ["ball.vdb", "scene.obj"]);
}

#[test]
fn a_grid_too_large_for_the_memory_is_refused() {
    let place = Workplace::new();
    smoke(&place, &["plume", "--grid", "4000x4000x4000"])
        .assert_fault(5, "--memory-limit lifts that");
    smoke(
        &place,
        &["plume", "--frames", "1..4000000000", "-o", "p_#.png"],
    )
    .assert_fault(5, "--memory-limit lifts that");
}

#[test]
fn info_tells_what_is_in_a_volume() {
    let place = Workplace::new();
    let grids = vec![
        row("density", &[0.5, 2.0]),
        row("heat", &[f32::NAN]),
        row("fuel", &[1.0]),
    ];
    place.put("fire.vdb", &Sample::new(grids).bytes());
    let text = place.npr(&["info", "fire.vdb"]);
    for part in [
        "fire.vdb: OpenVDB 224",
        "grid 'density' float, 2x1x1 voxels of 1.0000, 2 active, values 0.5 to 2: density",
        "1 no numbers: temperature",
        "draws smoke from 2x1x1 voxels",
        "note: grid 'fuel' is not drawn",
    ] {
        assert!(
            text.text().contains(part),
            "{part} is not in {}",
            text.text()
        );
    }
    let json = place.npr(&["info", "fire.vdb", "--json"]);
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).expect("JSON");
    assert_eq!(json["grids"][0]["used_as"], "density");
    assert_eq!(json["grids"][2]["used_as"], serde_json::Value::Null);
    let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 2), }";
    place.put("two.npy", &npy_file(header, &[0, 0, 128, 63, 0, 0, 0, 64]));
    let array = place.npr(&["info", "two.npy"]);
    assert!(
        array.text().contains("values 1 to 2: density"),
        "{}",
        array.text()
    );
}

/// The numbers of the paths of each layer of a drawing that hold something.
fn layers(svg: &str) -> Vec<(String, usize)> {
    let layers = svg.split("<g id=\"").skip(1);
    let named = layers.filter_map(|layer| {
        let (name, rest) = layer.split_once('"')?;
        Some((name.to_owned(), rest.matches("<path").count()))
    });
    named.filter(|(_, count)| *count > 0).collect()
}

#[test]
fn smoke_is_drawn_in_curves_and_filled() {
    let place = Workplace::with_scene();
    place.put("ball.vdb", &ball(0));
    let size = [
        "--size",
        "96x64",
        "--backend",
        "cpu",
        "--spheres",
        "20",
        "-q",
    ];
    let draw = |more: &[&str]| {
        let outcome = place.npr(&[&["lines"], more, &size[..], &["-o", "-"]].concat());
        outcome.assert_silent_success();
        outcome.text().to_owned()
    };
    let filled = draw(&["ball.vdb"]);
    let names: Vec<String> = layers(&filled).into_iter().map(|(name, _)| name).collect();
    assert!(names.iter().any(|name| name.contains("fills")), "{names:?}");
    assert!(
        names.iter().any(|name| name.contains("contour")),
        "{names:?}"
    );
    let pen = draw(&["ball.vdb", "--svg", "centreline"]);
    assert!(!pen.contains("fills") && pen.contains("contour"));
    let built_in = draw(&["puff"]);
    assert!(built_in.contains("fills") && built_in.contains("smoke"));
    let among = draw(&["scene.obj", "--volume", "ball.vdb@0.5,0,0.5*0.05"]);
    assert!(!among.contains("fills") && among.contains("smoke"));
}

#[test]
fn curves_of_smoke_are_the_same_for_any_number_of_threads() {
    let place = Workplace::new();
    let draw = |threads: &str| {
        let mut command = place.command(&["lines", "puff", "--spheres", "60", "-q", "-o", "-"]);
        let output = command.env("RAYON_NUM_THREADS", threads).output();
        let outcome = Outcome::of(output.expect("the command runs"));
        outcome.assert_silent_success();
        outcome.text().to_owned()
    };
    assert_eq!(draw("1"), draw("3"));
}
