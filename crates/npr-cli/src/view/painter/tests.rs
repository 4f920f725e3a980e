//! Which renderer draws an order.

use super::*;
use crate::arguments::{Arguments, Command};
use clap::Parser;
use std::sync::mpsc::channel;

/// A painter of a scene that nobody hears.
fn painter_of(scene: &Path) -> Painter {
    let words = ["npr", "view", "--backend", "cpu"].map(Into::into);
    let words = words.into_iter().chain([scene.to_owned().into_os_string()]);
    let parsed = Arguments::try_parse_from(words).expect("a right line");
    let Command::View(said) = parsed.command else {
        panic!("another command");
    };
    let ((_, asks), (news, _)) = (channel(), channel());
    let taken = (PathBuf::from("."), Ends::default());
    Painter::new(said.0.args, asks, news, Box::new(|| {}), taken)
}

/// A draft in a style, from where the scene is framed.
fn draft(style: &str) -> Order {
    Order {
        change: 1,
        style: style.to_owned(),
        overrides: Vec::new(),
        viewpoint: None,
        pose: npr_view::Pose::default(),
        layer: None,
        swatch: None,
        size: [40, 30],
        is_draft: true,
    }
}

#[test]
fn a_draft_of_a_layer_is_drawn_by_the_method_of_the_style() {
    let painter = painter_of(Path::new("a.obj"));
    painter.strokes_s.set(1.0);
    let picture = draft("ink");
    let layer = Order {
        layer: Some("kind".to_owned()),
        ..picture.clone()
    };
    assert!(painter.is_rough(&picture) && !painter.is_rough(&layer));
}

#[test]
fn a_style_is_read_once_for_a_draft() {
    // Lay a painter before a triangle, with a style in a file.
    let folder = tempfile::tempdir().expect("a folder");
    let [scene, file] = ["a.obj", "my.toml"].map(|name| folder.path().join(name));
    let write = |path: &Path, text: &str| {
        let output = Output::of(path).expect("a place");
        output.write(text.as_bytes()).expect("room");
    };
    write(&scene, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write(&file, "extends = \"ink\"\n");
    let painter = painter_of(&scene);
    let order = draft(&file.to_string_lossy());
    let args = order_arguments(&painter.args, &scene, &order);
    let job = painter.job(&args).expect("a style");
    let limits = painter.args.drawing.limits.limits();
    let loaded = Source::of(&scene).load(&limits, None).expect("a scene");
    let (_, prepared) = painter.prepared(&job, &loaded).expect("a model");

    // The renderer has the style that was read to see whether the scene serves it, and the next reads it anew.
    assert!(painter.serves((&job.look.style, &prepared), &scene, &order));
    std::fs::remove_file(&file).expect("it is there");
    let made = || {
        let scene = (&Processor as &dyn Engine, &prepared);
        let asked = (&args, painter.asked(&order));
        let made = painter.renderer(scene, asked, &mut VecDeque::new());
        made.map(|kept| kept.style).map_err(|fault| fault.message)
    };
    assert_eq!(made(), Ok(job.look.style.clone()));
    assert!(made().is_err_and(|text| text.contains("my.toml")));
}
