//! The frames of a film, and how its camera moves: decided by the number of a frame alone, so that a film may be drawn
//! in parts, in any order and on several machines.

use crate::arguments::{FilmArguments, Frames};
use crate::fault::{Exit, Fault};
use crate::reel::check_frames;
use std::f64::consts::TAU;

/// Seconds of a turntable whose length nobody says.
const TURN_SECONDS: f64 = 5.0;

/// What the frames of a film show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmPlan {
    /// The frames that are drawn.
    pub frames: Frames,
    /// How the camera turns, if it does.
    pub turn: Option<Turn>,
}

/// How the camera turns about the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turn {
    /// Once in so many frames.
    Once(u32),
    /// By so many degrees a frame.
    ByDegrees(f64),
}

impl FilmPlan {
    /// The film that the arguments ask for; `clip_s` is how long what plays is, in seconds, none where nothing
    /// plays.
    pub fn new(args: &FilmArguments, clip_s: Option<f32>) -> Result<Self, Fault> {
        // Refuse a film in which nothing moves.
        if !args.turntable && args.orbit.is_none() && clip_s.is_none() {
            let message = "nothing moves: no clip plays; say --turntable or --orbit DEG, \
                           or draw a still with npr render";
            return Err(Fault::new(Exit::Usage, message));
        }

        // Count its frames.
        let turn_s = args.turntable.then_some(TURN_SECONDS);
        let whole_s = clip_s.map(f64::from).or(turn_s);
        let count = |seconds: f64| (seconds * f64::from(args.fps)).round().max(1.0) as u32;
        let length = args.length.or(whole_s.map(count));
        let whole = length.map(|length| Frames {
            first: 0,
            last: length - 1,
        });
        let frames = args.frames.or(whole).ok_or_else(|| {
            let message = "--orbit goes on for ever: say with --frames A..B or --length N how long";
            Fault::new(Exit::Usage, message)
        })?;
        check_frames(frames)?;
        let turn = match args.orbit {
            Some(degrees) => Some(Turn::ByDegrees(degrees)),
            None => args.turntable.then(|| {
                let drawn = || frames.last - frames.first + 1;
                Turn::Once(args.length.unwrap_or_else(drawn))
            }),
        };
        Ok(Self { frames, turn })
    }

    /// The angle, in radians, that the camera has turned by in a frame.
    pub fn angle(&self, frame: u32) -> f32 {
        let turns = match self.turn {
            None => 0.0,
            Some(Turn::Once(length)) => f64::from(frame % length) / f64::from(length),
            Some(Turn::ByDegrees(degrees)) => (f64::from(frame) * degrees / 360.0).rem_euclid(1.0),
        };
        (turns * TAU) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arguments::Switch;

    fn args() -> FilmArguments {
        FilmArguments {
            frames: None,
            length: None,
            fps: 24.0,
            turntable: true,
            orbit: None,
            hold: Switch::On,
            resume: false,
        }
    }

    fn angles(args: &FilmArguments) -> Vec<f32> {
        let plan = FilmPlan::new(args, None).expect("a film");
        let Frames { first, last } = plan.frames;
        (first..=last).map(|frame| plan.angle(frame)).collect()
    }

    #[test]
    fn a_turntable_turns_once_and_its_end_runs_on_into_its_start() {
        let whole = angles(&args());
        assert_eq!(whole.len(), 120);
        let step = std::f32::consts::TAU / 120.0;
        assert!(
            whole
                .windows(2)
                .all(|pair| (pair[1] - pair[0] - step).abs() < 1e-5)
        );
        let plan = FilmPlan::new(&args(), None).expect("a film");
        assert_eq!((plan.angle(0), plan.angle(120)), (0.0, 0.0));
    }

    #[test]
    fn parts_of_a_film_of_known_length_are_the_whole() {
        let whole = angles(&FilmArguments {
            length: Some(9),
            ..args()
        });
        let part = |first, last| {
            angles(&FilmArguments {
                length: Some(9),
                frames: Some(Frames { first, last }),
                ..args()
            })
        };
        assert_eq!([part(0, 3), part(4, 8)].concat(), whole);
    }

    #[test]
    fn an_orbit_turns_by_its_angle_and_needs_a_length() {
        let orbit = |frames, degrees| FilmArguments {
            turntable: false,
            orbit: Some(degrees),
            frames,
            ..args()
        };
        let frames = Some(Frames { first: 0, last: 4 });
        let degrees: Vec<f32> = angles(&orbit(frames, 90.0))
            .iter()
            .map(|a| a.to_degrees())
            .collect();
        assert_eq!(degrees, [0.0, 90.0, 180.0, 270.0, 0.0]);
        assert_eq!(angles(&orbit(frames, -90.0))[1].to_degrees(), 270.0);
        let fault = FilmPlan::new(&orbit(None, 1.0), None).expect_err("no length");
        assert!(fault.message.contains("--length"));
    }

    #[test]
    fn what_does_not_move_and_what_never_ends_is_refused() {
        let still = FilmArguments {
            turntable: false,
            ..args()
        };
        let fault = FilmPlan::new(&still, None).expect_err("a still");
        assert!(fault.message.starts_with("nothing moves"));
        let frames = Some(Frames {
            first: 0,
            last: u32::MAX,
        });
        let endless = FilmArguments { frames, ..args() };
        assert_eq!(
            FilmPlan::new(&endless, None).map_err(|fault| fault.exit),
            Err(Exit::Limit)
        );
    }

    #[test]
    fn a_clip_plays_once_and_a_turntable_turns_once_in_it() {
        let film = |turntable, length| FilmArguments {
            turntable,
            length,
            ..args()
        };
        let plan = |args| FilmPlan::new(&args, Some(1.01)).expect("a film");
        let still = plan(film(false, None));
        assert_eq!((still.frames.first, still.frames.last), (0, 23));
        assert_eq!(still.angle(7), 0.0);
        let turned = plan(film(true, None));
        assert_eq!(
            (turned.frames.last, turned.turn),
            (23, Some(Turn::Once(24)))
        );
        assert_eq!(plan(film(false, Some(48))).frames.last, 47);
    }
}
