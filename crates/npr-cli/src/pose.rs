//! Puts a scene into the pose that the user asked for.

use crate::arguments::PoseArguments;
use crate::fault::{Exit, Fault};
use crate::message;
use npr_scene::{Clip, Scene};

/// Most clips that a message lists.
const LISTED_CLIPS: usize = 5;

/// Longest name that is compared with what was asked for, in bytes.
const COMPARED_MAX: usize = 64;

/// Poses the scene at the time of the clip that the user asked for, and gives what there is to warn of.
///
/// A pose that would carry something out of range is one: the scene rests then.
pub fn pose(args: &PoseArguments, scene: &mut Scene) -> Result<Vec<String>, Fault> {
    let Some(clip) = clip_of(args, scene)? else {
        return Ok(why_at_rest(args, scene.clips.len()).into_iter().collect());
    };
    let clip = clip.clone();
    Ok(stand(scene, &clip, args.time.unwrap_or(0.0))
        .into_iter()
        .collect())
}

/// Poses the scene at a time of one of its clips, in seconds, and gives what there is to warn of.
pub fn stand(scene: &mut Scene, clip: &Clip, time_s: f32) -> Option<String> {
    let pose = scene.pose_at(clip, time_s);
    let name = message::name(&clip.name);
    let fault = scene.set_pose(&pose).err()?;
    Some(format!("clip '{name}' is not played: {fault}"))
}

/// The clip that the user asked for; the first one for a time alone; none where the scene rests.
pub fn clip_of<'a>(args: &PoseArguments, scene: &'a Scene) -> Result<Option<&'a Clip>, Fault> {
    let clips = &scene.clips;
    let Some(asked) = &args.clip else {
        return Ok(clips.first().filter(|_| args.time.is_some()));
    };
    let named = clips.iter().find(|clip| clip.name == *asked);
    let numbered = || clips.get(asked.parse::<usize>().ok()?);
    let found = named.or_else(numbered);
    found.map(Some).ok_or_else(|| unknown_clip(asked, clips))
}

/// What a user may want to know of a scene with so many clips that rests.
fn why_at_rest(args: &PoseArguments, clip_count: usize) -> Option<String> {
    match (args.time, clip_count) {
        (Some(_), _) => Some("--time is ignored: the scene has no clips".to_owned()),
        (None, 0) => None,
        (None, 1) => {
            Some("the scene rests: it has a clip, which --clip or --time plays".to_owned())
        }
        (None, count) => Some(format!(
            "the scene rests: it has {count} clips, which --clip and --time play"
        )),
    }
}

/// The fault for a name or number that no clip has; lists those that are most like it first.
fn unknown_clip(asked: &str, clips: &[Clip]) -> Fault {
    let slips = |clip: &&Clip| match clip.name.len().max(asked.len()) > COMPARED_MAX {
        true => usize::MAX,
        false => strsim::osa_distance(&asked.to_lowercase(), &clip.name.to_lowercase()),
    };
    let mut nearest: Vec<&Clip> = clips.iter().collect();
    nearest.sort_by_cached_key(slips);
    let names = nearest.iter().take(LISTED_CLIPS);
    let listed: Vec<String> = names
        .map(|clip| format!("'{}'", message::name(&clip.name)))
        .collect();
    let there_are = match clips.len() {
        0 => "it has none".to_owned(),
        1..=LISTED_CLIPS => format!("it has {}", listed.join(", ")),
        count => format!("it has {count}, such as {}", listed.join(", ")),
    };
    let asked = message::name(asked);
    Fault::new(
        Exit::Usage,
        format!("the scene has no clip '{asked}'; {there_are}"),
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
        let told = |names: &[&str], args: &PoseArguments| pose(args, &mut scene(names));
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
