//! The destinations of pictures: one file, or a file for every frame.

use crate::fault::{Exit, Fault};
use crate::output::Output;
use npr_smoke::film::Numbered;
use std::path::{Path, PathBuf};

/// The destination of the pictures of a run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Target {
    /// One file, or standard output.
    One(Output),
    /// One file for each picture, by its number.
    Many {
        /// The names of the files.
        names: Numbered,
        /// Number of the first picture.
        first: u32,
        /// Number of the last one.
        last: u32,
    },
}

impl Target {
    /// The destination that `path` names; a `#` in it stands for the number of a picture.
    ///
    /// Fails before any work is done where nothing can be written there.
    pub fn of(path: &Path) -> Result<Self, Fault> {
        let Some(names) = Numbered::of(path) else {
            return Output::of(path).map(Self::One);
        };
        // Check the folder.
        Output::of(&names.path(0))?;
        Ok(Self::Many {
            names,
            first: 0,
            last: 0,
        })
    }

    /// The destination of the pictures with the numbers `first` to `last`. Refuses to write several pictures into one
    /// file.
    pub fn over(self, first: u32, last: u32) -> Result<Self, Fault> {
        self.check_count((last - first) as usize + 1)?;
        Ok(match self {
            Self::One(output) => Self::One(output),
            Self::Many { names, .. } => Self::Many { names, first, last },
        })
    }

    /// The destination of the picture with a number.
    pub fn output(&self, number: u32) -> Result<Output, Fault> {
        match self {
            Self::One(output) => Ok(output.clone()),
            Self::Many { names, .. } => Output::of(&names.path(number)),
        }
    }

    /// Whether there is a file for the picture with a number. Files appear when they are whole.
    pub fn is_there(&self, number: u32) -> bool {
        match self {
            Self::One(_) => false,
            Self::Many { names, .. } => names.path(number).is_file(),
        }
    }

    /// Refuses to write several pictures into one file.
    pub fn check_count(&self, count: usize) -> Result<(), Fault> {
        match self {
            Self::One(_) if count > 1 => {
                let message = format!(
                    "{count} frames do not fit into one file: name them, such as -o film_####.png"
                );
                Err(Fault::new(Exit::Usage, message))
            }
            _ => Ok(()),
        }
    }

    /// Refuses to write over a file that the pictures are made from, and over what is no file.
    pub fn refuse_any_of(&self, inputs: &[PathBuf]) -> Result<(), Fault> {
        match self {
            Self::One(output) => output.refuse_any_of(inputs),
            Self::Many { first, last, .. } => {
                let mut numbers = *first..=*last;
                numbers.try_for_each(|number| self.output(number)?.refuse_any_of(inputs))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_pictures_need_numbers() {
        let one = Target::One(Output::Standard);
        assert!(one.check_count(1).is_ok());
        let fault = one.check_count(96).expect_err("96 pictures");
        assert_eq!(fault.exit, Exit::Usage);
        assert!(fault.message.contains("####"), "{}", fault.message);
    }

    #[test]
    fn no_picture_of_a_range_lies_on_an_input() {
        let folder = tempfile::tempdir().expect("a folder");
        let input = folder.path().join("f_07.png");
        std::fs::File::create_new(&input).expect("made");
        let over = |first, last| {
            let target = Target::of(&folder.path().join("f_##.png"))?.over(first, last)?;
            target.refuse_any_of(std::slice::from_ref(&input))
        };
        assert_eq!(over(8, 20), Ok(()));
        assert_eq!(over(0, 7).map_err(|fault| fault.exit), Err(Exit::Usage));
    }
}
