//! The arguments of `npr view`.

use super::{CacheArguments, DrawingArguments};
use clap::{ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, parser::ValueSource};
use std::path::PathBuf;

/// What the user said to `npr view`.
#[derive(Debug, Clone, Args)]
pub struct ViewArguments {
    /// Scene: .glb, .gltf, .vrm, .obj, .stl or .ply; or a volume of smoke: .vdb or .npy.
    pub scene: PathBuf,
    /// The drawing.
    #[command(flatten)]
    pub drawing: DrawingArguments,
    /// What is kept.
    #[command(flatten)]
    pub cache: CacheArguments,
}

/// Arguments together with the options that the user wrote, so that they can be said again.
#[derive(Debug, Clone)]
pub struct Said<T> {
    /// The arguments.
    pub args: T,
    /// Every option that was written, by its name in clap, with its words on a command line.
    pub options: Vec<(String, Vec<String>)>,
}

impl<T: Args> FromArgMatches for Said<T> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        Ok(Self {
            args: T::from_arg_matches(matches)?,
            options: options_said::<T>(matches),
        })
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.args.update_from_arg_matches(matches)?;
        self.options = options_said::<T>(matches);
        Ok(())
    }
}

impl<T: Args> Args for Said<T> {
    fn augment_args(command: Command) -> Command {
        T::augment_args(command)
    }

    fn augment_args_for_update(command: Command) -> Command {
        T::augment_args_for_update(command)
    }
}

/// The options of `T` that a command line states.
fn options_said<T: Args>(matches: &ArgMatches) -> Vec<(String, Vec<String>)> {
    let command = T::augment_args(Command::new("said"));
    let mut said = Vec::new();
    for option in command.get_arguments() {
        let id = option.get_id().as_str();
        let Some(long) = option.get_long() else {
            continue;
        };
        if matches.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let mut words = Vec::new();
        if matches!(option.get_action(), ArgAction::SetTrue) {
            words.push(format!("--{long}"));
        } else {
            let delimiter = option.get_value_delimiter().unwrap_or(' ').to_string();
            for values in matches.get_raw_occurrences(id).into_iter().flatten() {
                let values: Vec<_> = values.map(|value| value.to_string_lossy()).collect();
                words.push(format!("--{long}={}", values.join(&delimiter)));
            }
        }
        said.push((id.to_owned(), words));
    }
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_said_again_as_they_were_written() {
        let line =
            "npr a.glb --clip Walk --time 0.5 --set a=1 --set b=2 --ortho --quiet --eye -1,2,3";
        let command = Said::<ViewArguments>::augment_args(Command::new("npr"));
        let matches = command.get_matches_from(line.split(' '));
        let said = Said::<ViewArguments>::from_arg_matches(&matches).expect("arguments");
        let words: Vec<String> = said
            .options
            .iter()
            .flat_map(|(_, words)| words.clone())
            .collect();
        let expected = [
            "--eye=-1,2,3",
            "--ortho",
            "--clip=Walk",
            "--time=0.5",
            "--set=a=1",
            "--set=b=2",
            "--quiet",
        ];
        assert_eq!(words, expected);
    }
}
