//! How much hatching and brushes add: sequences of frames, whose ink is compared.

use std::collections::VecDeque;
use std::path::Path;

use glam::Vec3;
use npr_benches::lines::soup::Soup;
use npr_benches::lines::viewpoint::Viewpoint;
use npr_benches::motion::film::Film;
use npr_benches::motion::ink::{Events, InkTally, Inked};
use npr_benches::motion::inked::{InkFilm, Medium};
use npr_benches::motion::skin::Skin;
use npr_benches::motion::step::Step;
use npr_benches::sheet::Sheet;
use npr_render::{Frame, LineModel, LineModelOptions, Model};
use npr_scene::{Clip, LoadOptions, Pose, Scene, load};
use npr_stylesheet::Style;

use crate::Outcome;
use crate::arguments::Arguments;

/// Frame of all sequences.
pub const SIZE: [u32; 2] = [960, 540];

/// The sequences, and how many frames are drawn of each.
pub const FILMS: [(Film, usize); 4] = [
    (Film::Turn, 13),
    (Film::Pan, 5),
    (Film::Clip, 13),
    (Film::Still, 2),
];

/// Frames after which ink is compared once more: what slides slowly differs by little from frame to frame.
pub const LATER: usize = 4;

/// Models of the shared folder, and the clips that they play.
const MODELS: [(&str, Option<&str>); 4] = [
    ("stanford_bunny.glb", None),
    ("nefertiti_70k.glb", None),
    ("godette_vrm1.vrm", None),
    ("fox.glb", Some("Run")),
];

/// A preset with a change, and what of it is measured.
pub struct Look {
    /// Name of the row.
    pub name: &'static str,
    preset: &'static str,
    setting: Option<&'static str>,
    /// What puts ink on the paper.
    pub medium: Medium,
}

impl Look {
    const fn new(name: &'static str, preset: &'static str, medium: Medium) -> Self {
        Self {
            name,
            preset,
            setting: None,
            medium,
        }
    }

    const fn with(self, setting: &'static str) -> Self {
        Self {
            setting: Some(setting),
            ..self
        }
    }

    fn style(&self) -> Outcome<Style> {
        let mut style = Style::preset(self.preset)?;
        if let Some(setting) = self.setting {
            style.set(setting)?;
        }
        Ok(style)
    }
}

/// Takes the grain of the paper from hatching, and from brushes.
const SMOOTH: [&str; 2] = ["ink.hatch.grain=0", "line.brush.grain=0"];

/// Sets strokes as many pixels apart as they are in a frame twice as high.
const WIDE: [&str; 2] = ["ink.hatch.spacing=12", "ink.hatch.spacing=14"];

/// What is measured.
pub const LOOKS: [Look; 17] = {
    use Medium::{Brush, Hatching};
    [
        Look::new("crosshatch", "crosshatch", Hatching),
        Look::new("crosshatch, wide", "crosshatch", Hatching).with(WIDE[0]),
        Look::new("comic-silver", "comic-silver", Hatching),
        Look::new("comic-silver, wide", "comic-silver", Hatching).with(WIDE[1]),
        Look::new("stipple", "stipple", Hatching),
        Look::new("pencil", "pencil", Hatching),
        Look::new("pencil, smooth paper", "pencil", Hatching).with(SMOOTH[0]),
        Look::new("manga", "manga", Hatching),
        Look::new("brush", "brush", Brush),
        Look::new("brush, smooth paper", "brush", Brush).with(SMOOTH[1]),
        Look::new("charcoal", "charcoal", Brush),
        Look::new("charcoal, smooth paper", "charcoal", Brush).with(SMOOTH[1]),
        Look::new("chalkboard", "chalkboard", Brush),
        Look::new("chalkboard, smooth paper", "chalkboard", Brush).with(SMOOTH[1]),
        Look::new("sketch", "sketch", Brush),
        Look::new("sketch, smooth paper", "sketch", Brush).with(SMOOTH[1]),
        Look::new("inked", "inked", Brush),
    ]
};

/// What a sequence of a model in a look came to.
pub struct InkRow {
    /// Name of the model.
    pub model: String,
    /// The look.
    pub look: &'static Look,
    /// The sequence.
    pub film: Film,
    /// The figures of successive frames.
    pub tally: InkTally,
    /// Those of frames [`LATER`] apart.
    pub later: InkTally,
}

/// Draws and measures all that is asked for.
///
/// # Errors
///
/// Whatever loading and drawing say.
pub fn measured(arguments: &Arguments) -> Outcome<Vec<InkRow>> {
    let mut rows = Vec::new();
    for (file, clip) in MODELS {
        let path = arguments.models.join(file);
        if !path.is_file() {
            eprintln!("left out: there is no {}", path.display());
            continue;
        }
        let mut subject: Option<InkSubject> = None;
        for look in &LOOKS {
            for (film, frames) in FILMS {
                let is_asked = arguments.takes(&format!("{file} {}", look.name), film.name());
                if !is_asked || film == Film::Clip && clip.is_none() {
                    continue;
                }
                let subject = match &mut subject {
                    Some(subject) => subject,
                    none => none.insert(InkSubject::new(&path, clip)?),
                };
                eprintln!("{file} {:?} {} {}", look.medium, look.name, film.name());
                let frames = frames.min(arguments.frames_most);
                let pictures = arguments.pictures.as_deref();
                rows.push(subject.measured(look, (film, frames), pictures)?);
            }
        }
    }
    Ok(rows)
}

/// A model ready to be drawn.
struct InkSubject {
    name: String,
    scene: Scene,
    clip: Option<Clip>,
    model: Model,
    lines: LineModel,
    /// Middle and radius of a sphere around the model at rest.
    sphere: (Vec3, f32),
    /// The surface in every frame of the clip that was drawn so far.
    surfaces: Vec<Soup>,
}

impl InkSubject {
    fn new(path: &Path, clip: Option<&str>) -> Outcome<Self> {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let scene = load(path, &LoadOptions::default())?;
        let found = scene.clips.iter().find(|found| Some(&*found.name) == clip);
        let (middle, radius) = Soup::of_scene(&scene).ball();
        Ok(Self {
            name: name.into_owned(),
            clip: found.cloned(),
            model: Model::new(&scene)?,
            lines: LineModel::new(&scene, &LineModelOptions::default())?,
            sphere: (middle.as_vec3(), radius as f32),
            surfaces: Vec::new(),
            scene,
        })
    }

    fn measured(
        &mut self,
        look: &'static Look,
        (film, frame_count): (Film, usize),
        pictures: Option<&Path>,
    ) -> Outcome<InkRow> {
        // Prepare the look, and find the surfaces of all frames.
        let [mut tally, mut later] = [InkTally::default(), InkTally::default()];
        self.scene.set_pose(&Pose::default())?;
        let lines = (&self.model, &self.lines);
        let mut ink = InkFilm::new(lines, &look.style()?, look.medium, SIZE)?;
        let mut drawn: VecDeque<Inked> = VecDeque::new();
        let mut worst: Option<(usize, Sheet)> = None;
        for frame in 0..frame_count {
            // Draw the next frame.
            if let (Film::Clip, Some(clip)) = (film, &self.clip) {
                self.scene
                    .set_pose(&self.scene.pose_at(clip, Film::time_s(frame)))?;
                ink.set_pose(&self.scene)?;
                if frame >= self.surfaces.len() {
                    self.surfaces.push(Soup::of_scene(&self.scene));
                }
            }
            let camera = film.camera(frame, self.sphere, SIZE[1]);
            let next = ink.draw(&camera)?;

            // Compare it with the one before, and with an earlier one.
            if let Some(last) = drawn.back() {
                let events = self.compared(&mut tally, [last, &next], (film, [frame - 1, frame]));
                let count = events.differing.len();
                if pictures.is_some() && worst.as_ref().is_none_or(|(most, _)| count > *most) {
                    worst = Some((count, panels([last, &next], &events)));
                }
            }
            if drawn.len() == LATER {
                let frames = [frame - LATER, frame];
                self.compared(&mut later, [&drawn[0], &next], (film, frames));
                drawn.pop_front();
            }
            drawn.push_back(next);
        }

        // Show the worst pair.
        if let (Some(folder), Some((_, sheet))) = (pictures, worst) {
            let name = format!(
                "{:?} {} {} {}",
                look.medium,
                look.name,
                self.name,
                film.name()
            );
            sheet.write(&folder.join(name.replace([' ', ','], "_") + ".png"))?;
        }
        Ok(InkRow {
            model: self.name.clone(),
            look,
            film,
            tally,
            later,
        })
    }

    /// Adds two frames of some numbers to the figures.
    fn compared(
        &self,
        tally: &mut InkTally,
        frames: [&Inked; 2],
        (film, numbers): (Film, [usize; 2]),
    ) -> Events {
        let skins = (film == Film::Clip).then(|| {
            let [before, after] = numbers.map(|frame| &self.surfaces[frame]);
            [(before, after), (after, before)].map(|(from, to)| {
                Skin::new(
                    from.faces.clone(),
                    [from.positions.clone(), to.positions.clone()],
                )
            })
        });
        let [from, to]: [Viewpoint; 2] = frames.map(Inked::view);
        let skin = |side: usize| skins.as_ref().map(|skins| &skins[side]);
        let there = Step {
            from,
            to,
            skin: skin(0),
        };
        let back = Step {
            from: to,
            to: from,
            skin: skin(1),
        };
        tally.add(frames, [&there, &back])
    }
}

/// Sides of what a picture shows of a frame, in pixels.
const CUT_PX: [usize; 2] = [120, 90];

/// Pixels of a picture for one of the frame.
const ZOOM: usize = 5;

/// The ink of two frames around the place where most of it changes, and once more that of the later one, where what
/// differs is blue and what is gone or new red.
fn panels([last, next]: [&Inked; 2], events: &Events) -> Sheet {
    // Find the part of the frame with most changes.
    let cell = |place: &[f64; 2]| [0, 1].map(|i| place[i] as usize / (CUT_PX[i] / 2));
    let mut counts = std::collections::BTreeMap::<[usize; 2], usize>::new();
    let weighty = events
        .jumping
        .iter()
        .cycle()
        .take(10 * events.jumping.len());
    for place in events.differing.iter().chain(weighty) {
        *counts.entry(cell(place)).or_default() += 1;
    }
    let most = counts.iter().max_by_key(|(_, count)| **count);
    let most = most.map_or([0; 2], |(cell, _)| *cell);
    let corner: [usize; 2] = std::array::from_fn(|i| {
        let middle = most[i] * (CUT_PX[i] / 2) + CUT_PX[i] / 4;
        let start = middle.saturating_sub(CUT_PX[i] / 2);
        start.min(SIZE[i] as usize - CUT_PX[i])
    });

    // Draw it three times.
    let size = CUT_PX.map(|side| side * ZOOM);
    let mut sheet = Sheet::new(3, size.map(|side| side as u32));
    let marks = [
        (&events.differing, [70, 110, 255]),
        (&events.jumping, [255, 0, 0]),
    ];
    for (tones, marks) in [(last, &[][..]), (next, &[]), (next, &marks)] {
        let mut colors: Vec<[u8; 3]> = (tones.tones().iter())
            .map(|ink| [((1.0 - ink) * 255.0) as u8; 3])
            .collect();
        for (places, color) in marks {
            for [x, y] in *places {
                colors[*y as usize * SIZE[0] as usize + *x as usize] = *color;
            }
        }
        let pixel = |i: usize| {
            let [x, y] = [
                i % size[0] / ZOOM + corner[0],
                i / size[0] / ZOOM + corner[1],
            ];
            let [r, g, b] = colors[y * SIZE[0] as usize + x];
            [r, g, b, 255]
        };
        sheet.add(&Frame {
            size: size.map(|side| side as u32),
            rgba: (0..size[0] * size[1]).flat_map(pixel).collect(),
            ..Frame::default()
        });
    }
    sheet
}
