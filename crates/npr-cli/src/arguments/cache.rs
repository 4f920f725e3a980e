//! The argument for the folder that keeps prepared data between runs.

use crate::fault::{Exit, Fault};
use crate::message::quoted;
use clap::Args;
use std::path::PathBuf;

/// Environment variable that names the cache folder where the option does not.
const VARIABLE: &str = "NPR_CACHE_DIR";

/// Where what is costly to prepare is kept between runs.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct CacheArguments {
    /// Keep what is costly to prepare in this folder between runs, which saves time and changes no drawing; `off`
    /// keeps none [default: the folder that NPR_CACHE_DIR names, else off].
    #[arg(long, value_name = "DIR|off", help_heading = "Work")]
    pub cache: Option<PathBuf>,
}

impl CacheArguments {
    /// The cache folder, which must exist; `None` for no cache.
    pub fn folder(&self) -> Result<Option<PathBuf>, Fault> {
        let of_variable = || std::env::var_os(VARIABLE).map(PathBuf::from);
        let folder = self.cache.clone().or_else(of_variable);
        let Some(folder) =
            folder.filter(|folder| !folder.as_os_str().is_empty() && folder != "off")
        else {
            return Ok(None);
        };
        if folder.is_dir() {
            return Ok(Some(folder));
        }
        let message = format!("cache: there is no folder {}", quoted(&folder));
        Err(Fault::new(Exit::Failed, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> Result<Option<PathBuf>, Fault> {
        let cache = Some(PathBuf::from(name));
        CacheArguments { cache }.folder()
    }

    #[test]
    fn off_and_nothing_mean_no_cache() {
        assert_eq!(folder("off"), Ok(None));
        let fault = folder("no/where").expect_err("missing");
        assert_eq!(fault.exit, Exit::Failed);
    }
}
