//! Puts a scene into the pose that the user asked for.

use crate::arguments::{ExpressionShare, LookedAt, PoseArguments};
use crate::fault::{Exit, Fault};
use crate::input::read_file;
use crate::message::{self, quoted};
use crate::source::{Loaded, Source};
use npr_core::camera::Camera;
use npr_render::{Movement, RenderError};
use npr_scene::{
    Bone, Clip, Eyes, Figure, Limits, MotionError, Notice, Pose, Posture, PostureError,
    PostureFault, Property, Scene, Swinging,
};
use npr_stylesheet::Style;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

/// Most names that a message lists.
const LISTED: usize = 5;

/// Longest name that is compared with what was asked for, in bytes.
const COMPARED_MAX: usize = 64;

/// Gives a scene that was loaded what the user brings along: the clips of a motion, and the colours of expressions,
/// which stand still. The files of both, and of the pose, are among its inputs then.
pub fn dress(args: &PoseArguments, loaded: &mut Loaded, limits: &Limits) -> Result<(), Fault> {
    loaded.inputs.extend(args.pose.clone());
    if let Some(path) = &args.motion {
        take_motion(path, loaded, limits)?;
    }
    paint(&args.expressions, &mut loaded.scene)
}

/// Gives a scene as it was loaded the colours of expressions.
pub fn paint(expressions: &[ExpressionShare], scene: &mut Scene) -> Result<(), Fault> {
    let shares = shares_of(expressions, scene)?;
    scene.paint_expressions(&shares);
    Ok(())
}

/// Lets a scene have the clips of a motion instead of its own.
pub fn take_motion(path: &Path, loaded: &mut Loaded, limits: &Limits) -> Result<(), Fault> {
    // Read it, without its pictures.
    let limits = Limits {
        decode_images: false,
        ..*limits
    };
    let motion = Source::of(path).load(&limits, None)?;
    let scene = &mut loaded.scene;
    let played = scene.clips_of(&motion.scene, &limits).map_err(|fault| {
        let exit = match fault {
            MotionError::NoBones => Exit::Usage,
            MotionError::Limit(_) => Exit::Limit,
            _ => Exit::Input,
        };
        Fault::new(exit, fault).while_doing(format_args!("cannot play {}", quoted(path)))
    })?;
    loaded.inputs.extend(motion.inputs);

    // Say what of it is not used.
    let told = motion.scene.notices.into_iter().chain(played.notices);
    scene.notices.extend(told.map(|notice| Notice {
        text: format!("motion {}: {notice}", quoted(path)),
    }));
    let channels = played.clips.iter().flat_map(|clip| &clip.channels);
    let shares = channels.filter(|channel| channel.property == Property::Share);
    let faces = scene.figure.iter().flat_map(|figure| &figure.expressions);
    let faces: Vec<_> = faces.collect();
    let is_painted = |number: u32| {
        let face = faces.get(number as usize);
        face.is_some_and(|face| !face.colors.is_empty() || !face.textures.is_empty())
    };
    if shares.map(|channel| channel.node).any(is_painted) {
        scene.notices.push(Notice {
            text: format!(
                "motion {}: expressions of motions change no colours",
                quoted(path)
            ),
        });
    }
    scene.clips = played.clips;
    Ok(())
}

/// How the user has a scene stand: a clip, bones that are bent besides, and expressions.
#[derive(Debug, Clone, Default)]
pub struct Stance {
    clip: Option<Clip>,
    posture: Option<Posture>,
    /// Shares of expressions, by number.
    shares: BTreeMap<u32, f32>,
    /// What its figure looks at.
    look_at: Option<LookedAt>,
    /// How its springs swing while the clip plays.
    swinging: RefCell<Swinging>,
    /// Most bytes that it may take to know where everything was.
    memory_limit: u64,
    /// What there is to warn of.
    pub warnings: Vec<String>,
}

impl Stance {
    /// The stance that the user asked for, in a clip of the scene or without one.
    pub fn of(
        args: &PoseArguments,
        scene: &Scene,
        clip: Option<&Clip>,
        limits: &Limits,
    ) -> Result<Self, Fault> {
        let mut stance = Self {
            clip: clip.cloned(),
            shares: shares_of(&args.expressions, scene)?,
            memory_limit: limits.memory_bytes,
            ..Self::default()
        };
        if let Some(look_at) = args.look_at {
            let warning = why_not_looking(scene.figure.as_ref());
            let looks = scene.figure.as_ref().is_some_and(Figure::can_look);
            stance.look_at = Some(look_at).filter(|_| looks);
            stance.warnings.extend(warning.map(str::to_owned));
        }
        if let Some(path) = &args.pose {
            let (posture, warnings) = posture_of(path, scene, limits)?;
            stance.posture = Some(posture);
            stance.warnings.extend(warnings);
        }
        if args.turned != Posture::default() {
            let posture = stance.posture.get_or_insert_default();
            posture.turns.extend(&args.turned.turns);
        }
        Ok(stance)
    }

    /// Whether it is the pose at rest.
    fn is_rest(&self) -> bool {
        self.clip.is_none()
            && self.posture.is_none()
            && self.shares.is_empty()
            && self.look_at.is_none()
    }

    /// Whether its figure looks at the camera.
    pub fn follows_camera(&self) -> bool {
        self.look_at == Some(LookedAt::Camera)
    }

    /// Puts the scene into it at a time of the clip, in seconds, seen by a camera, and gives what there is to warn of:
    /// a pose that would carry something out of range is not taken. Without a camera no figure looks at it.
    pub fn stand(&self, scene: &mut Scene, time_s: f32, camera: Option<&Camera>) -> Option<String> {
        let mut pose = self.stiff(scene, time_s);
        if self.clip.is_some() && scene.springs.is_some() {
            let mut swinging = self.swinging.borrow_mut();
            pose.swings = swinging.at(scene, time_s, |time_s| self.stiff(scene, time_s));
        }
        pose.look_at = match self.look_at {
            Some(LookedAt::Place(place)) => Some(place.0),
            Some(LookedAt::Camera) => camera.map(|camera| camera.eye),
            None => None,
        };
        if pose.look_at.is_some() {
            let figure = scene.figure.as_ref();
            let looks = figure.map(Figure::looks).into_iter().flatten().flatten();
            for look in looks {
                pose.shares.remove(&look);
            }
        }
        pose.shares.extend(&self.shares);
        let fault = scene.set_pose(&pose).err()?;
        Some(match &self.clip {
            Some(clip) => {
                let name = message::name(&clip.name);
                format!("clip '{name}' is not played: {fault}")
            }
            None => format!("the scene rests: {fault}"),
        })
    }

    /// How bones stand at a time of the clip, before anything swings or looks.
    fn stiff(&self, scene: &Scene, time_s: f32) -> Pose {
        let clip = self.clip.as_ref();
        let mut pose = clip.map_or_else(Pose::default, |clip| scene.pose_at(clip, time_s));
        if let Some(posture) = &self.posture {
            scene.bend(&mut pose, posture);
        }
        pose
    }

    /// Where everything in a scene was before a time of the clip, in seconds, as far as a style follows motion; none
    /// without a clip. The scene stands as at that time, before and after, seen by the same camera.
    pub fn movement(
        &self,
        scene: &mut Scene,
        (time_s, camera): (f32, Option<&Camera>),
        style: &Style,
    ) -> Result<Option<Arc<Movement>>, RenderError> {
        if self.clip.is_none() {
            return Ok(None);
        }
        Movement::of_style(scene, (style, self.memory_limit), |scene, before_s| {
            self.stand(scene, time_s - before_s, camera);
        })
    }
}

/// A scene that was posed.
#[derive(Debug, Clone, Default)]
pub struct Posed {
    /// Whether the user asked for another pose than the one at rest.
    pub is_posed: bool,
    /// Where everything was before, where a clip plays and the style follows motion.
    pub movement: Option<Arc<Movement>>,
    /// What there is to warn of.
    pub warnings: Vec<String>,
    /// How the user has it stand, and when.
    stance: Stance,
    time_s: f32,
}

impl Posed {
    /// Poses the scene as the user asked for, and says nothing of clips that do not play.
    pub fn of(
        args: &PoseArguments,
        scene: &mut Scene,
        style: &Style,
        limits: &Limits,
    ) -> Result<Self, Fault> {
        let clip = clip_of(args, scene)?;
        let stance = Stance::of(args, scene, clip, limits)?;
        let mut posed = Self {
            is_posed: !stance.is_rest(),
            stance,
            ..Self::default()
        };
        posed.move_to(scene, args.time.unwrap_or(0.0), style)?;
        Ok(posed)
    }

    /// Whether its figure looks at the camera.
    pub fn follows_camera(&self) -> bool {
        self.stance.follows_camera()
    }

    /// Poses the scene for a camera that looks at it, where its figure looks back; gives whether it does.
    pub fn face(
        &mut self,
        scene: &mut Scene,
        camera: &Camera,
        style: &Style,
    ) -> Result<bool, RenderError> {
        if !self.follows_camera() {
            return Ok(false);
        }
        // What there is to warn of was told when it took the pose without a look.
        let _ = self.stance.stand(scene, self.time_s, Some(camera));
        self.movement = self
            .stance
            .movement(scene, (self.time_s, Some(camera)), style)?;
        Ok(true)
    }

    /// Poses the scene as it stands at a time, in seconds, with everything else as it was asked for; no figure looks
    /// at a camera.
    pub fn move_to(
        &mut self,
        scene: &mut Scene,
        time_s: f32,
        style: &Style,
    ) -> Result<(), RenderError> {
        self.time_s = time_s;
        self.warnings.clone_from(&self.stance.warnings);
        self.warnings.extend(self.stance.stand(scene, time_s, None));
        self.movement = self.stance.movement(scene, (time_s, None), style)?;
        Ok(())
    }
}

/// Poses the scene as the user asked for, in a style that may follow motion; `flows` is whether pictures on its
/// surfaces move in time, besides clips.
pub fn pose(
    (args, flows): (&PoseArguments, bool),
    scene: &mut Scene,
    style: &Style,
    limits: &Limits,
) -> Result<Posed, Fault> {
    let mut posed = Posed::of(args, scene, style, limits)?;
    if posed.stance.clip.is_none() {
        let why = why_at_rest(args, scene.clips.len(), posed.is_posed);
        let why = why.filter(|_| !flows || args.time.is_none());
        let place = posed.stance.warnings.len();
        posed.warnings.splice(place..place, why);
    }
    Ok(posed)
}

/// Warns of what needs a figure, for a picture without any scene.
pub fn pose_of_nothing(args: &PoseArguments) -> Result<Vec<String>, Fault> {
    let nothing = Scene::default();
    clip_of(args, &nothing)?;
    shares_of(&args.expressions, &nothing)?;
    let files = [("--motion", &args.motion), ("--pose", &args.pose)];
    let said = files.into_iter().filter(|(_, file)| file.is_some());
    let said = said.map(|(option, _)| option);
    let said = said.chain(args.look_at.map(|_| "--look-at"));
    let ignored = said.map(|option| format!("{option} is ignored: there is no scene"));
    Ok(why_at_rest(args, 0, false)
        .into_iter()
        .chain(ignored)
        .collect())
}

/// The clip that the user asked for; the first one for a time or a motion alone; none where the scene rests.
pub fn clip_of<'a>(args: &PoseArguments, scene: &'a Scene) -> Result<Option<&'a Clip>, Fault> {
    let clips = &scene.clips;
    let Some(asked) = &args.clip else {
        let plays = args.time.is_some() || args.motion.is_some();
        return Ok(clips.first().filter(|_| plays));
    };
    let named = clips.iter().find(|clip| clip.name == *asked);
    let numbered = || clips.get(asked.parse::<usize>().ok()?);
    let found = named.or_else(numbered);
    found.map(Some).ok_or_else(|| {
        let names = clips.iter().map(|clip| clip.name.as_str());
        unknown("clip", asked, names)
    })
}

/// The shares that the user gives expressions of a scene, by number; of two for one the last counts.
fn shares_of(asked: &[ExpressionShare], scene: &Scene) -> Result<BTreeMap<u32, f32>, Fault> {
    let figure = scene.figure.as_ref();
    let share = |ExpressionShare { name, share }: &ExpressionShare| {
        let found = figure.and_then(|figure| figure.expression(name));
        let number = found.ok_or_else(|| {
            let all = figure.iter().flat_map(|figure| &figure.expressions);
            unknown("expression", name, all.map(|face| face.name.as_str()))
        })?;
        Ok((number, *share))
    };
    asked.iter().map(share).collect()
}

/// The posture in a file, and what there is to warn of.
fn posture_of(
    path: &Path,
    scene: &Scene,
    limits: &Limits,
) -> Result<(Posture, Vec<String>), Fault> {
    // Read it.
    if scene.bones().is_empty() {
        let fault = Fault::new(Exit::Usage, MotionError::NoBones);
        return Err(fault.while_doing(format_args!("cannot take the pose {}", quoted(path))));
    }
    let bytes = read_file(path, limits.file_bytes)?;
    let (posture, faults) = Posture::read(&bytes, limits).map_err(|fault| {
        let exit = match fault {
            PostureError::Limit(_) => Exit::Limit,
            _ => Exit::Input,
        };
        Fault::new(exit, fault).while_doing(format_args!("cannot read {}", quoted(path)))
    })?;

    // Say what is wrong with it.
    let told = faults.iter().take(LISTED).map(|fault| {
        let what = match fault {
            PostureFault::UnknownBone(name) => {
                let near = nearest(name, Bone::all().map(Bone::name));
                let near = near.first().copied().unwrap_or_default();
                format!("there is no bone '{}': did you mean '{near}'?", message::name(name))
            }
            PostureFault::BadRotation(bone) => {
                format!("the rotation of '{bone}' is ignored: it is no list of four numbers that turn something")
            }
            PostureFault::BadPosition(bone) => {
                format!("the position of '{bone}' is ignored: it is no list of three numbers")
            }
            PostureFault::MovedBone(bone) => {
                format!("the position of '{bone}' is ignored: the hips alone are moved")
            }
            _ => "something is ignored".to_owned(),
        };
        format!("pose {}: {what}", quoted(path))
    });
    let mut warnings: Vec<String> = told.collect();
    if faults.len() > LISTED {
        let more = faults.len() - LISTED;
        warnings.push(format!("pose {}: {more} more are ignored", quoted(path)));
    }
    Ok((posture, warnings))
}

/// What a user may want to know of a scene with so many clips of which none plays; `is_posed` is whether something
/// else poses it.
fn why_at_rest(args: &PoseArguments, clip_count: usize, is_posed: bool) -> Option<String> {
    match (args.time, clip_count) {
        (Some(_), _) => Some("--time is ignored: the scene has no clips".to_owned()),
        (None, 0) => None,
        (None, _) if is_posed => None,
        (None, 1) => {
            Some("the scene rests: it has a clip, which --clip or --time plays".to_owned())
        }
        (None, count) => Some(format!(
            "the scene rests: it has {count} clips, which --clip and --time play"
        )),
    }
}

/// Why a figure does not look where it is asked to, or not quite.
fn why_not_looking(figure: Option<&Figure>) -> Option<&'static str> {
    let Some(figure) = figure.filter(|figure| figure.can_look()) else {
        return Some("--look-at is ignored: the scene has no figure with eyes that look");
    };
    let by_expressions = figure
        .look_at
        .as_ref()
        .is_some_and(|look| look.eyes == Eyes::Expressions);
    let is_painted = |number: u32| {
        let face = figure.expressions.get(number as usize);
        face.is_some_and(|face| !face.colors.is_empty() || !face.textures.is_empty())
    };
    let mut looks = figure.looks().into_iter().flatten();
    (by_expressions && looks.any(is_painted))
        .then_some("--look-at moves no textures, which the figure looks by")
}

/// Names in the order of how much they are like a name.
fn nearest<'a>(asked: &str, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let slips = |name: &&str| match name.len().max(asked.len()) > COMPARED_MAX {
        true => usize::MAX,
        false => strsim::osa_distance(&asked.to_lowercase(), &name.to_lowercase()),
    };
    let mut nearest: Vec<&str> = names.collect();
    nearest.sort_by_cached_key(slips);
    nearest
}

/// The fault for a name or number that no such thing of the scene has; lists those that are most like it first.
fn unknown<'a>(what: &str, asked: &str, names: impl Iterator<Item = &'a str>) -> Fault {
    let nearest = nearest(asked, names);
    let names = nearest.iter().take(LISTED);
    let listed: Vec<String> = names
        .map(|name| format!("'{}'", message::name(name)))
        .collect();
    let there_are = match nearest.len() {
        0 => "it has none".to_owned(),
        1..=LISTED => format!("it has {}", listed.join(", ")),
        count => format!("it has {count}, such as {}", listed.join(", ")),
    };
    let asked = message::name(asked);
    Fault::new(
        Exit::Usage,
        format!("the scene has no {what} '{asked}'; {there_are}"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(names: &[&str]) -> Scene {
        let clip = |name: &&str| Clip {
            name: (*name).to_owned(),
            ..Clip::default()
        };
        Scene {
            clips: names.iter().map(clip).collect(),
            ..Scene::default()
        }
    }

    fn asked(clip: Option<&str>, time: Option<f32>) -> PoseArguments {
        PoseArguments {
            clip: clip.map(str::to_owned),
            time,
            ..PoseArguments::default()
        }
    }

    #[test]
    fn names_come_before_numbers_and_a_time_alone_means_the_first() {
        let scene = scene(&["1", "Walk"]);
        let found = |clip, time| {
            let found = clip_of(&asked(clip, time), &scene).expect("a clip");
            found.map(|clip| clip.name.clone())
        };
        assert_eq!(found(Some("1"), None).as_deref(), Some("1"));
        assert_eq!(found(Some("0"), None).as_deref(), Some("1"));
        assert_eq!(found(Some("Walk"), Some(2.0)).as_deref(), Some("Walk"));
        assert_eq!(found(None, Some(0.0)).as_deref(), Some("1"));
        assert_eq!(found(None, None), None);
    }

    #[test]
    fn faults_list_the_nearest_first() {
        let said = |names: &[&str], clip| {
            clip_of(&asked(Some(clip), None), &scene(names))
                .expect_err("no such clip")
                .message
        };
        let three = ["Survey", "Walk", "Run"];
        let reported = "the scene has no clip 'wlak'; it has 'Walk', 'Run', 'Survey'";
        assert_eq!(said(&three, "wlak"), reported);
        let reported = "the scene has no clip '3'; it has 'Run', 'Walk', 'Survey'";
        assert_eq!(said(&three, "3"), reported);
        assert_eq!(
            said(&[], "Walk"),
            "the scene has no clip 'Walk'; it has none"
        );
        let many = ["a1", "b2", "c3", "d4", "e5", "f6"];
        let reported = "the scene has no clip 'f'; it has 6, such as 'f6', 'a1', 'b2', 'c3', 'd4'";
        assert_eq!(said(&many, "f"), reported);
        assert!(said(&["x"; 9], &"y".repeat(10_000)).len() < 300);
    }

    #[test]
    fn a_scene_at_rest_is_told_of_once_it_has_clips() {
        let told = |names: &[&str], args: &PoseArguments| {
            let style = Style::default();
            pose((args, false), &mut scene(names), &style, &Limits::default())
                .map(|posed| posed.warnings)
        };
        let rest = PoseArguments::default();
        assert_eq!(told(&[], &rest), Ok(vec![]));
        assert_eq!(told(&["a"], &asked(None, Some(1.0))), Ok(vec![]));
        assert_eq!(told(&["a"], &asked(Some("a"), None)), Ok(vec![]));
        let of =
            |names: &[&str], args: &PoseArguments| told(names, args).expect("a pose").remove(0);
        assert!(of(&["a"], &rest).contains("it has a clip"));
        assert!(of(&["a", "b"], &rest).contains("it has 2 clips"));
        assert!(of(&[], &asked(None, Some(1.0))).starts_with("--time is ignored: "));
    }
}
