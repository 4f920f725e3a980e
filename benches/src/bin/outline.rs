//! Measures how well outlines mind the background and prints the tables kept in `benches/results/outline_color.md`;
//! with `contrast`, `orbits` or `objects` only that part; with `--sheets DIR` writes contact sheets instead.
//!
//! Run by `cargo xtask measure outline-colour`. A measuring program, not a test: it fails only where loading or
//! drawing fails.

use std::error::Error;
use std::path::Path;

use glam::Vec3;
use npr_benches::ledger::{Ledger, precise};
use npr_benches::orbit::turned;
use npr_benches::outline_color::frames::{FRAMES, METHODS, Method, Show, subject};
use npr_benches::outline_color::judge::{CONTRAST, FLIP, Verdict, flips};
use npr_benches::outline_color::scenery::Scenery;
use npr_benches::sheet::Sheet;
use npr_benches::solid::{row_as_one, row_of_balls};
use npr_benches::subject::Subject;
use npr_benches::table::Table;
use npr_benches::timing::Times;
use npr_benches::{device, machine};
use npr_core::camera::{Camera, Projection};
use npr_gpu::engine::Engine;
use npr_gpu::processor::Processor;
use npr_stylesheet::Style;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Pixels of a frame that is judged.
const SIZE: [u32; 2] = [720, 720];

/// Pixels of a picture on a sheet.
const SHEET_SIZE: [u32; 2] = [640, 640];

/// Pixels of the frames that are timed.
const FULL_HD: [u32; 2] = [1920, 1080];

/// Frames of an orbit, and degrees between them.
const STEPS: u32 = 24;
const STEP_DEG: f32 = 0.5;

/// What the camera goes round.
const ORBITS: [(&str, Scenery); 3] = [
    ("godette_vrm1.vrm", Scenery::TwoColors),
    ("godette_vrm1.vrm", Scenery::Photograph),
    ("flight_helmet.glb", Scenery::Textured),
];

/// Triangles of an object, and runs behind a time, of the published measurement and ours.
const TRIANGLES: usize = 302;
const RUNS: usize = 31;

fn main() -> Outcome<()> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words.as_slice() {
        [] => {
            println!("# Outlines that mind the background\n");
            println!("- machine: {}; no graphics device", machine::description());
            println!("- code: {}\n", machine::code());
            contrast()?;
            orbits()?;
            objects()
        }
        ["contrast"] => contrast(),
        ["orbits"] => orbits(),
        ["objects"] => objects(),
        ["--sheets", folder] => sheets(Path::new(folder)),
        _ => Err("arguments are none, contrast, orbits, objects, or --sheets DIR".into()),
    }
}

/// How well outlines read, and how near they stay to the rim.
fn contrast() -> Outcome<()> {
    println!("## Twelve frames\n");
    println!(
        "Preset toon; black lines, but ours, which starts from the rim's colour as it is, {} x {} pixels. Below: \
         share of the outline whose line differs by less than {CONTRAST} in OKLab's lightness from what lies behind. \
         Distance: mean distance in OKLab between line and rim. How places are judged stands in the \
         [README](../README.md).\n",
        SIZE[0], SIZE[1]
    );
    let names = METHODS.iter();
    let head = names.flat_map(|m| [format!("{}, below", m.name), "distance".to_owned()]);
    let mut table = Table::new(["frame".to_owned()].into_iter().chain(head));
    let mut sums = [Verdict::default(); METHODS.len()];

    // Judge every method on every frame.
    for (name, scenery) in FRAMES {
        let Some((model, camera)) = subject(name)? else {
            continue;
        };
        let mut cells = Vec::new();
        for (method, sum) in METHODS.iter().zip(&mut sums) {
            let mut show = Show::new(&Processor, &model, scenery, method, SIZE)?;
            let verdict = Verdict::of(&show.places(&camera)?);
            *sum = sum.and(verdict);
            cells.extend(cells_of(&verdict));
        }
        eprintln!("{name}, {}: {}", scenery.name(), cells.join(" "));
        table.add(format!("{name}, {}", scenery.name()), cells);
    }

    // Sum up, and hold ours against what is wanted.
    table.add("all", sums.iter().flat_map(cells_of));
    println!("{table}");
    let [_, red, _, ours] = sums;
    println!(
        "Ours: {:.2} % below (wanted under 2), distance {:.3} of red's (wanted under a third).\n",
        100.0 * ours.share_below(),
        ours.mean_distance() / red.mean_distance()
    );
    Ok(())
}

fn cells_of(verdict: &Verdict) -> [String; 2] {
    [
        format!("{:.2} %", 100.0 * verdict.share_below()),
        format!("{:.3}", verdict.mean_distance()),
    ]
}

/// How often colours flip while the camera goes round.
fn orbits() -> Outcome<()> {
    println!("## Colours that flip\n");
    println!(
        "{STEPS} steps of {STEP_DEG} degrees. A place of the outline flips where the outline goes on within 4 pixels \
         along the same rim and before the same background, but nowhere there within {FLIP} of its colour in OKLab. \
         Given is the share of places a degree; wanted is under 0.5 %. In brackets the share below {CONTRAST} of \
         lightness, as above, over all frames.\n"
    );
    let head = ["orbit"].into_iter().chain(METHODS.iter().map(|m| m.name));
    let mut table = Table::new(head);
    for (name, scenery) in ORBITS {
        let cells = METHODS.iter().map(|method| orbit(name, scenery, method));
        let cells = cells.collect::<Outcome<Vec<String>>>()?;
        eprintln!("{name}, {}: {}", scenery.name(), cells.join(" "));
        table.add(format!("{name}, {}", scenery.name()), cells);
    }
    println!("{table}");
    Ok(())
}

fn orbit(name: &str, scenery: Scenery, method: &Method) -> Outcome<String> {
    let Some((model, camera)) = subject(name)? else {
        return Ok("-".to_owned());
    };
    let mut show = Show::new(&Processor, &model, scenery, method, SIZE)?;
    let middle = Vec3::from(camera.target);
    let mut before = show.places(&camera)?;

    // Go round the character, and compare every frame with the one before.
    let (mut sum, mut verdict) = ([0, 0], Verdict::default());
    for step in 1..=STEPS {
        let camera = turned(camera, middle, step as f32 * STEP_DEG);
        let after = show.places(&camera)?;
        let found = flips(&before, &after, SIZE);
        sum = [sum[0] + found[0], sum[1] + found[1]];
        verdict = verdict.and(Verdict::of(&after));
        before = after;
    }
    let share = sum[0] as f64 / sum[1].max(1) as f64;
    Ok(format!(
        "{:.3} % ({:.1} %)",
        100.0 * share / f64::from(STEP_DEG),
        100.0 * verdict.share_below()
    ))
}

/// What ten objects cost beside one, on the processor and on graphics hardware.
fn objects() -> Outcome<()> {
    println!("## Ten objects beside one\n");
    println!(
        "Balls of {TRIANGLES} triangles, each a character of its own, that cover as much of 1920 x 1080 pixels \
         together as one does; published were 86.9 and 81.3 frames a second [Tsuji 2014, table 3.2]. Medians of \
         {RUNS} frames in ms and, in brackets, the least; wanted is under 10 % more. Ten have 3.16 times the outline \
         of one, so the same ten stand beside them as a single object: the rest is what objects cost by themselves. \
         Load average {}.\n",
        machine::load()
    );
    objects_on(&Processor)?;
    if let Some(device) = device::open_hardware() {
        objects_on(&*device)?;
    }
    Ok(())
}

fn objects_on(engine: &dyn Engine) -> Outcome<()> {
    println!("On {}:\n", engine.describe());
    let camera = Camera {
        eye: [0.0, 0.0, 10.0],
        target: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        projection: Projection::Parallel { height: 4.4 },
    };

    // Make one ball, ten characters, and the same ten as one object.
    let subject = |scene| -> Outcome<Subject> {
        let prepared = npr_render::Subject::new(&scene, &Style::default())?;
        Ok(Subject { prepared, camera })
    };
    let subjects = [
        ("one", subject(row_of_balls(1, TRIANGLES))?),
        ("ten", subject(row_of_balls(10, TRIANGLES))?),
        ("ten as one", subject(row_as_one(10, TRIANGLES))?),
    ];
    let heads = ["", "work, "].map(|measure| {
        ["one", "ten", "more", "ten as one", "ten more than these"]
            .map(|head| format!("{measure}{head}"))
    });
    let head = std::iter::once("method".to_owned()).chain(heads.into_iter().flatten());
    let mut table = Table::new(head);
    for method in &METHODS {
        let mut style = Style::preset("toon")?;
        style.set("line.background.subjects=object")?;
        for setting in method.settings {
            style.set(setting)?;
        }

        // Draw by turns, so that what else the machine does hits all alike.
        let mut renderers = Vec::new();
        for (name, subject) in &subjects {
            renderers.push((*name, subject.warm_renderer(engine, &style, FULL_HD)?));
        }
        let mut ledger = Ledger::default();
        for _ in 0..RUNS {
            for (name, renderer) in &mut renderers {
                ledger.time(name, || renderer.draw(&camera))?;
            }
        }
        let mut times = Vec::new();
        for (name, _) in &subjects {
            times.extend(ledger.of(name));
        }
        let [one, ten, as_one] = times[..] else {
            continue;
        };

        // Say how much more ten cost.
        let cells = |of: fn(&(Times, Times)) -> Times| {
            let [one, ten, as_one] = [&one, &ten, &as_one].map(of);
            let more =
                |b: Times, a: Times| format!("{:+.1} %", 100.0 * (b.median / a.median - 1.0));
            let shown = [precise(one), precise(ten), more(ten, one), precise(as_one)];
            shown.into_iter().chain([more(ten, as_one)])
        };
        table.add(
            method.name,
            cells(|times| times.0).chain(cells(|times| times.1)),
        );
    }
    println!("{table}");
    Ok(())
}

/// Writes a sheet a scenery: a row a character, the methods beside each other.
fn sheets(folder: &Path) -> Outcome<()> {
    std::fs::create_dir_all(folder)?;
    for scenery in Scenery::ALL {
        let shown = FRAMES.iter().filter(|(_, behind)| *behind == scenery);
        let mut sheet = Sheet::new(METHODS.len(), SHEET_SIZE);
        for (name, _) in shown {
            let Some((model, camera)) = subject(name)? else {
                continue;
            };
            for method in &METHODS {
                let mut show = Show::new(&Processor, &model, scenery, method, SHEET_SIZE)?;
                sheet.add(&show.picture(&camera)?);
            }
        }
        let path = folder.join(format!("outline_{}.png", scenery.name().replace(' ', "_")));
        sheet.write(&path)?;
        println!("{}", path.display());
    }
    Ok(())
}
