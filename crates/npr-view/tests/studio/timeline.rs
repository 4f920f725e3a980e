//! Time in the window: what plays, which moment is drawn, and what is said of it.

use super::*;
use npr_view::{Cast, Clip, FilmForm, LookAt, Pose};

/// What of a scene can move: two clips.
fn cast() -> Cast {
    let clip = |name: &str, seconds| Clip {
        name: name.to_owned(),
        seconds,
    };
    Cast {
        clips: vec![clip("Walk", 2.0), clip("Wave", 0.5)],
        ..Cast::default()
    }
}

/// A studio whose scene has a cast, once it is shown in full, and its host.
pub fn stage(size: [f32; 2], pose: Pose, cast: Cast) -> (Harness<'static, Studio>, Easel) {
    let easel = Easel::default();
    easel.0.borrow_mut().news = vec![opened("a.glb", cast)];
    let sheet = Sheet::new("toon", Stated::preset("toon").unwrap(), &[]).unwrap();
    let studio = Studio::new(sheet, None, Box::new(easel.clone())).posed(pose);
    let mut harness = Harness::builder()
        .with_size(vec2(size[0], size[1]))
        .with_max_steps(64)
        .build_ui_state(|ui, studio: &mut Studio| studio.show(ui), studio);
    harness.run_steps(6);
    (harness, easel)
}

pub fn opened(name: &str, cast: Cast) -> News {
    News::Scene(name.to_owned(), Box::new(cast))
}

pub fn last(easel: &Easel) -> Order {
    easel.0.borrow().orders.last().unwrap().clone()
}

#[test]
fn a_clip_plays_by_the_clock_in_drafts_and_stands_in_full() {
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), cast());
    assert_eq!(last(&easel).pose, Pose::default());
    harness.key_press(Key::Space);
    harness.run_steps(1);
    assert!(harness.state().plays());

    // A frame of the window takes a quarter of a second: of six frames of the clip five are left out.
    easel.0.borrow_mut().orders.clear();
    harness.run_steps(10);
    let orders = easel.0.borrow().orders.clone();
    let times: Vec<f32> = orders
        .iter()
        .filter_map(|order| order.pose.time_s)
        .collect();
    assert!(times.len() >= 8, "{times:?}");
    let steps: Vec<f32> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let is_right = |step: &f32| (step - 0.25).abs() < 1e-4 || (step + 1.75).abs() < 1e-4;
    assert!(steps.iter().all(is_right), "{times:?}");
    assert!(steps.iter().any(|step| *step < 0.0), "{times:?}");
    assert!(orders.iter().all(|order| order.is_draft));
    let is_played = |order: &Order| order.pose.clip.as_deref() == Some("Walk");
    assert!(orders.iter().all(is_played));
    assert!(orders.iter().all(|order| order.viewpoint == Some(FRONT)));

    // It stands still in full, at the time of a frame.
    harness.key_press(Key::Space);
    harness.run_steps(6);
    assert!(!harness.state().plays());
    let still = last(&easel);
    let shown = harness.state().picture().unwrap().order.clone();
    assert!(!still.is_draft && shown == still, "{still:?}");
    let time_s = still.pose.time_s.unwrap();
    assert_eq!((time_s * 24.0).round() / 24.0, time_s);
    let said = easel.command(&still);
    assert!(
        said.ends_with(&format!("--clip=Walk --time={time_s}")),
        "{said}"
    );
}

#[test]
fn what_does_not_loop_ends_and_begins_again_when_it_is_played() {
    let pose = Pose {
        clip: Some("1".to_owned()),
        time_s: Some(0.25),
        ..Pose::default()
    };
    let (mut harness, easel) = stage([1000.0, 700.0], pose, cast());
    assert_eq!(harness.state().order().pose.clip.as_deref(), Some("Wave"));
    harness.get_by_label("Loop").click();
    harness.run_steps(2);
    harness.get_by_label("Play").click();
    harness.run_steps(8);
    assert!(!harness.state().plays());
    let end = last(&easel);
    assert_eq!((end.pose.time_s, end.is_draft), (Some(11.0 / 24.0), false));
    easel.0.borrow_mut().orders.clear();
    harness.key_press(Key::Space);
    harness.run_steps(1);
    assert_eq!(easel.0.borrow().orders[0].pose.time_s, Some(0.0));
}

#[test]
fn arrows_step_a_frame_and_the_slider_scrubs() {
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), cast());
    let time = |harness: &Harness<'static, Studio>| harness.state().order().pose.time_s;
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    assert_eq!(time(&harness), Some(1.0 / 24.0));
    for _ in 0..2 {
        harness.key_press(Key::ArrowLeft);
        harness.run_steps(2);
    }
    assert_eq!(time(&harness), Some(47.0 / 24.0));

    // Scrub to the middle.
    let slider = harness.get_by_label("Frame").rect();
    harness.drag_at(slider.center());
    harness.run_steps(2);
    harness.drop_at(slider.center());
    harness.run_steps(6);
    assert_eq!(time(&harness), Some(1.0));
    assert!(!last(&easel).is_draft);
    let shown = harness.query_by_label("frame 24 of 48");
    assert!(shown.is_some());

    // Choose the other clip, which begins at its start, and rest again.
    for (name, clip, time_s) in [
        ("Wave   0.50 s", Some("Wave"), Some(0.0)),
        ("at rest", None, None),
    ] {
        harness.get_by_label("Clip").click();
        harness.run_steps(3);
        harness.get_by_label(name).click();
        harness.run_steps(6);
        let pose = last(&easel).pose;
        assert_eq!((pose.clip.as_deref(), pose.time_s), (clip, time_s));
    }
}

#[test]
fn without_anything_that_moves_there_is_no_bar() {
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), Cast::default());
    assert!(harness.query_by_label("Play").is_none());
    let drawn = easel.0.borrow().orders.len();
    harness.key_press(Key::Space);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(4);
    assert!(!harness.state().plays());
    assert_eq!(easel.0.borrow().orders.len(), drawn);
}

#[test]
fn pictures_on_surfaces_play_without_a_clip() {
    let flowing = Cast {
        flows: true,
        ..Cast::default()
    };
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), flowing);
    assert!(harness.query_by_label("Clip").is_none());
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(4);
    let pose = last(&easel).pose;
    assert_eq!((pose.clip, pose.time_s), (None, Some(119.0 / 24.0)));
}

#[test]
fn a_motion_plays_its_first_clip_and_another_scene_rests() {
    // The scene plays its second clip before, and the motion has one of that name too.
    let second = cast().clips.last().map(|clip| clip.name.clone());
    let playing = Pose {
        clip: second.clone(),
        ..Pose::default()
    };
    let (mut harness, easel) = stage([1000.0, 700.0], playing, cast());
    assert_eq!(last(&easel).pose.clip, second);
    assert_ne!(second.as_deref(), Some("Walk"));
    let motion = Cast {
        motion: Some("wave.vrma".to_owned()),
        ..cast()
    };
    easel.0.borrow_mut().news = vec![opened("a.glb", motion)];
    harness.run_steps(4);
    let said = easel.command(&last(&easel));
    assert!(
        said.ends_with("--motion=wave.vrma --clip=Walk --time=0"),
        "{said}"
    );
    easel.0.borrow_mut().news = vec![opened("b.glb", cast())];
    harness.run_steps(4);
    assert_eq!(last(&easel).pose, Pose::default());
}

#[test]
fn at_first_a_pose_is_drawn_once() {
    let pose = Pose {
        clip: Some("0".to_owned()),
        motion: Some("wave.vrma".to_owned()),
        ..Pose::default()
    };
    let motion = Cast {
        motion: Some("wave.vrma".to_owned()),
        ..cast()
    };
    let (harness, easel) = stage([1000.0, 700.0], pose, motion);
    assert_eq!(harness.state().order().pose.clip.as_deref(), Some("Walk"));
    let (_, resting) = stage([1000.0, 700.0], Pose::default(), cast());
    let count = |easel: &Easel| easel.0.borrow().orders.len();
    assert_eq!(count(&easel), count(&resting));
}

#[test]
fn a_small_window_has_a_small_bar() {
    for width in [40.0, 200.0, 400.0, 900.0] {
        let (harness, _) = stage([width, 300.0], Pose::default(), cast());
        assert_eq!(harness.query_by_label("Clip").is_some(), width > 800.0);
        assert!(harness.query_by_label("Play").is_some());
    }
}

#[test]
fn expressions_and_looks_are_said_and_undone() {
    let figure = Cast {
        expressions: vec!["happy".to_owned(), "Big grin".to_owned()],
        can_look: true,
        ..Cast::default()
    };
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), figure);
    harness.state_mut().search("expression");
    harness.run_steps(12);

    // Drag a slider: that is one step.
    let slider = harness.get_by_label("expression Big grin").rect();
    let start = egui::pos2(slider.left() + 4.0, slider.center().y);
    harness.drag_at(start);
    harness.run_steps(2);
    for step in 1..5 {
        harness.hover_at(start + vec2(10.0 * step as f32, 0.0));
        harness.run_steps(1);
    }
    harness.drop_at(start + vec2(40.0, 0.0));
    harness.run_steps(8);
    let grin = last(&easel).pose.face.share("Big grin").unwrap();
    assert!((0.2..0.8).contains(&grin), "{grin} {slider:?}");
    assert!(!last(&easel).is_draft);

    // Look at the camera.
    harness.get_by_label("Eyes look").click();
    harness.run_steps(3);
    harness.get_by_label("at the camera").click();
    harness.run_steps(6);
    assert_eq!(last(&easel).pose.face.look_at, Some(LookAt::Camera));
    let said = easel.command(&last(&easel));
    let expected = format!("--expression=Big grin={grin} --look-at=camera");
    assert!(said.ends_with(&expected), "{said}");

    // Take both back, one after the other, and forth.
    let faces = [(Some(grin), None), (None, None)];
    for (grin, look_at) in faces {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(4);
        let face = last(&easel).pose.face;
        assert_eq!((face.share("Big grin"), face.look_at), (grin, look_at));
    }
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    harness.run_steps(4);
    assert_eq!(last(&easel).pose.face.share("Big grin"), Some(grin));
    harness.get_by_label("reset expression Big grin").click();
    harness.run_steps(4);
    assert_eq!(last(&easel).pose.face.share("Big grin"), None);

    // Another scene has another figure.
    easel.0.borrow_mut().news = vec![opened("b.vrm", Cast::default())];
    harness.run_steps(3);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(last(&easel).pose, Pose::default());
}

#[test]
fn films_are_taken_of_what_plays_and_of_a_turn() {
    let (mut harness, easel) = stage([1000.0, 700.0], Pose::default(), cast());
    harness.key_press(Key::ArrowRight);
    harness.run_steps(4);
    harness.get_by_label("Film").click();
    harness.run_steps(3);
    harness.key_press(Key::Space);
    harness.run_steps(1);
    assert!(harness.state().plays());
    harness.get_by_label("GIF").click();
    harness.run_steps(3);
    assert!(
        !harness.state().plays(),
        "a film takes the machine for itself"
    );
    let (film, order) = easel.0.borrow().films[0].clone();
    assert_eq!(
        (film.form, film.plays, film.turns),
        (FilmForm::Gif, true, false)
    );
    assert_eq!(
        (order.pose.clip.as_deref(), order.pose.time_s),
        (Some("Walk"), None)
    );
    assert_eq!(order.viewpoint, Some(FRONT));

    // It tells how far it is, and can be ended.
    easel.0.borrow_mut().news = vec![News::Film(Some([3, 48]))];
    harness.run_steps(2);
    let told = harness.query_by_label("frame 3 of 48 of the film is drawn");
    assert!(told.is_some());
    harness.get_by_label("Cancel").click();
    harness.run_steps(2);
    assert_eq!(easel.0.borrow().cancelled, 1);
    easel.0.borrow_mut().news = vec![News::Film(None)];
    harness.run_steps(2);
    assert!(harness.query_by_label("Cancel").is_none());

    // A turn around the moment that is shown.
    harness.get_by_label("To the start").click();
    harness.run_steps(2);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    harness.get_by_label("Film").click();
    harness.run_steps(3);
    harness.get_by_label("what plays").click();
    harness.run_steps(2);
    assert_eq!(harness.state().film(FilmForm::Apng), None);
    harness.get_by_label("the camera turns once").click();
    harness.run_steps(2);
    harness.get_by_label("PNG frames").click();
    harness.run_steps(3);
    let (film, order) = easel.0.borrow().films[1].clone();
    assert_eq!(
        (film.form, film.plays, film.turns),
        (FilmForm::Frames, false, true)
    );
    assert_eq!(order.pose.time_s, Some(1.0 / 24.0));
    assert_eq!(film.options(), ["--fps=24", "--turntable"]);
}
