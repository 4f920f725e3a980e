//! `cargo xtask assets`: the project's own sample models, made from formulas.

mod beams;
mod book;
mod cloth;
mod crockery;
mod figures;
mod fruit;
mod glb;
mod pen;
mod prism;
mod scene;
mod shape;
mod sheet;
mod smooth;
mod still_life;
mod teapot;
mod tube;
mod tuft;
mod turned;

use std::path::Path;

use anyhow::{Result, bail};

use crate::file;

/// A file name below `assets/`, and what makes the scene in it.
type Sample = (&'static str, fn() -> scene::Scene);

/// Every sample.
const SCENES: [Sample; 7] = [
    ("cube_plane.glb", figures::cube_plane),
    ("teapot_box_plane.glb", figures::teapot_box_plane),
    ("two_balls.glb", figures::two_balls),
    ("steps.glb", figures::steps),
    ("still_life.glb", still_life::still_life),
    ("beams.glb", beams::beams),
    ("tuft.glb", tuft::tuft),
];

/// Writes every sample into `folder`, each whole or not at all.
pub fn write(folder: &Path) -> Result<()> {
    for (name, scene) in SCENES {
        let bytes = glb::glb(&scene())?;
        file::write_whole(&folder.join(name), &bytes)?;
        eprintln!("{name}: {} kB", bytes.len() / 1000);
    }
    Ok(())
}

/// Fails, naming the file, unless `folder` holds exactly what [`write()`] would put there.
pub fn check(folder: &Path) -> Result<()> {
    for (name, scene) in SCENES {
        let committed = std::fs::read(folder.join(name)).unwrap_or_default();
        if committed != glb::glb(&scene())? {
            bail!("assets/{name} is stale; run `cargo xtask assets`");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn committed_samples_are_what_the_code_makes() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets");
        check(&folder).unwrap();
    }

    #[test]
    fn every_object_but_grass_is_closed_and_has_a_name_of_its_own() {
        for (file, scene) in SCENES {
            let objects = scene().objects;
            let names: std::collections::BTreeSet<_> = objects.iter().map(|o| o.name).collect();
            assert_eq!(names.len(), objects.len(), "{file}");
            for object in &objects {
                let has_border = shape::open_edge_count(&object.shape) > 0;
                assert_eq!(
                    has_border,
                    object.name == tuft::GRASS,
                    "{file}: {}",
                    object.name
                );
            }
        }
    }

    #[test]
    fn samples_stay_small() {
        for (file, scene) in SCENES {
            let limit = if file == "still_life.glb" {
                1_500_000
            } else {
                300_000
            };
            assert!(glb::glb(&scene()).unwrap().len() < limit, "{file}");
        }
    }
}
