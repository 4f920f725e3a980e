//! A sequence, measured.

use std::collections::BTreeMap;
use std::path::Path;

use npr_benches::motion::causes::{Causes, Frames};
use npr_benches::motion::film::Film;
use npr_benches::motion::skin::Skin;
use npr_benches::motion::step::Step;
use npr_benches::motion::tally::{Due, Pair, Tally};
use npr_benches::motion::traced::Sample;
use npr_render::HeldLines;

use crate::Outcome;
use crate::picture::panels;
use crate::subject::{Shot, Subject};

/// What a sequence of a model came to.
pub struct Measured {
    /// Name of the model.
    pub model: String,
    /// The sequence.
    pub film: Film,
    /// Whether strokes hold from frame to frame.
    pub is_held: bool,
    /// The figures.
    pub tally: Tally,
    /// Why.
    pub causes: Causes,
}

impl Measured {
    /// What its row is called.
    pub fn name(&self) -> String {
        match self.is_held {
            true => format!("{}, held", self.model),
            false => self.model.clone(),
        }
    }
}

/// Draws and measures a sequence, whose strokes may hold from frame to frame; pictures of causes go to a folder where
/// there is one.
///
/// # Errors
///
/// Whatever drawing, and writing of pictures, say.
pub fn measured(
    subject: &mut Subject,
    (film, is_held): (Film, bool),
    frame_count: usize,
    pictures: Option<&Path>,
) -> Outcome<Measured> {
    let (mut tally, mut causes) = (Tally::default(), Causes::default());
    let mut shown: BTreeMap<String, String> = BTreeMap::new();
    let mut held = is_held.then(HeldLines::default);
    let mut last = subject.shot((film, 0), None, held.as_mut())?;
    let mut earlier: Option<Pair> = None;
    tally.add_bias(&last.stages.drawn, &last.stages.raw);
    for frame in 1..frame_count {
        // Draw the next frame, and the ways there and back.
        let next = subject.shot((film, frame), Some(&last), held.as_mut())?;
        let skins = (film == Film::Clip).then(|| [(&last, &next), (&next, &last)].map(skin));
        let [skin, skin_back] = match &skins {
            Some([there, back]) => [Some(there), Some(back)],
            None => [None, None],
        };
        let step = Step {
            from: last.view,
            to: next.view,
            skin,
        };
        let back = Step {
            from: next.view,
            to: last.view,
            skin: skin_back,
        };

        // Compare both.
        let pair = Pair::new(&last.stages.drawn, &next.stages.drawn, &step);
        let is_seen = |sample: &Sample| next.sees(sample);
        let was_seen = |sample: &Sample| {
            let world = back.carried(sample.world);
            last.sees(&Sample { world, ..*sample })
        };
        let due = Due {
            raw: &next.stages.raw,
            is_seen: &is_seen,
        };
        tally.add((&last.stages.drawn, &next.stages.drawn), &pair, &due);
        tally.add_raw_ends(&last.stages.raw, &next.stages.raw, &step);
        tally.add_bias(&next.stages.drawn, &next.stages.raw);
        if let Some(earlier) = &earlier {
            tally.add_blinks(earlier, &step, &next.stages.drawn);
        }

        // Look for causes, and draw the largest events so far.
        causes.add(&Frames {
            stages: [&last.stages, &next.stages],
            is_seen: &is_seen,
            was_seen: &was_seen,
            pair: &pair,
        });
        if pictures.is_some() {
            show(&mut shown, &causes, frame, [&last, &next]);
        }
        earlier = Some(pair);
        last = next;
    }
    for (name, svg) in shown {
        let folder = pictures.unwrap_or(Path::new("."));
        let name = format!(
            "{}_{}{}_{name}.svg",
            subject.name,
            if is_held { "held_" } else { "" },
            film.name().replace(' ', "_")
        );
        write_picture(&folder.join(name), &svg)?;
    }
    Ok(Measured {
        model: subject.name.clone(),
        film,
        is_held,
        tally,
        causes,
    })
}

fn skin((from, to): (&Shot, &Shot)) -> Skin {
    Skin::new(from.faces(), [from.points(), to.points()])
}

/// Draws the events of this pair of frames that are the largest of their cause.
fn show(
    shown: &mut BTreeMap<String, String>,
    causes: &Causes,
    frame: usize,
    [last, next]: [&Shot; 2],
) {
    let pops = causes
        .pops
        .iter()
        .map(|(cause, count)| (format!("pop_{cause:?}"), count));
    let losses = causes
        .losses
        .iter()
        .map(|(cause, count)| (format!("loss_{cause:?}"), count));
    for (name, count) in pops.chain(losses) {
        let (_, pair, place) = count.largest;
        if pair + 1 == frame {
            let stages = [
                &last.stages.drawn,
                &next.stages.drawn,
                &last.stages.raw,
                &next.stages.raw,
            ];
            let name = name.replace(['(', ')'], "_");
            shown.insert(name, panels(&stages, place, frame));
        }
    }
}

#[expect(
    clippy::disallowed_methods,
    reason = "pictures to look at may be half written"
)]
fn write_picture(path: &Path, svg: &str) -> Outcome<()> {
    Ok(std::fs::write(path, svg)?)
}
