//! The source of a scene: standard input or a file.

use crate::ending::has_ending;
use crate::fault::Fault;
use crate::input::{read_file, read_standard};
use crate::message::quoted;
use crate::output::folder_of;
use crate::volume::VolumeSource;
use npr_scene::{
    FolderResources, Format, Limits, MemoryResources, ResourceError, Resources, Scene, load_bytes,
};
use npr_smoke::file::is_volume;
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// The source of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// Standard input.
    Standard,
    /// A file.
    File(PathBuf),
}

/// A scene with the files that it was made from.
#[derive(Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// Its format, by name or else by content.
    pub format: Option<Format>,
    /// The volume, where the source is one; the scene is empty then.
    pub volume: Option<VolumeSource>,
    /// The scene's own file and all files that it refers to.
    pub inputs: Vec<PathBuf>,
}

impl Source {
    /// The source that `path` names, `-` for standard input.
    pub fn of(path: &Path) -> Self {
        if path.as_os_str() == "-" {
            Self::Standard
        } else {
            Self::File(path.to_owned())
        }
    }

    /// Loads the scene. Files that it refers to must lie below its own folder, or below `external`.
    pub fn load(&self, limits: &Limits, external: Option<&Path>) -> Result<Loaded, Fault> {
        match self {
            Self::Standard => load_standard(limits, external),
            Self::File(path) => load_file(path, limits, external),
        }
    }
}

fn load_standard(limits: &Limits, external: Option<&Path>) -> Result<Loaded, Fault> {
    let bytes = read_standard(limits.file_bytes)?;
    if is_volume(&bytes) {
        return Ok(Loaded::of_volume("standard input".to_owned(), bytes));
    }
    let resources: Box<dyn Resources> = match external {
        Some(folder) => Box::new(FolderResources::new(folder, None)?),
        None => Box::new(MemoryResources::default()),
    };
    let scene = load_bytes("standard input", &bytes, None, resources.as_ref(), limits)
        .map_err(|error| Fault::from(error).while_doing("cannot read standard input"))?;
    Ok(Loaded {
        scene,
        format: Format::of_content(&bytes),
        volume: None,
        inputs: Vec::new(),
    })
}

fn load_file(path: &Path, limits: &Limits, external: Option<&Path>) -> Result<Loaded, Fault> {
    // Give the bytes of a volume as they are, with an empty scene.
    let bytes = read_file(path, limits.file_bytes)?;
    if has_volume_name(path) || is_volume(&bytes) {
        return Ok(Loaded {
            inputs: vec![path.to_owned()],
            ..Loaded::of_volume(quoted(path), bytes)
        });
    }

    // Load the scene, noting every file that it refers to.
    let resources = Recorder::new(folder_of(path), external)?;
    let format = Format::of_path(path).or_else(|| Format::of_content(&bytes));
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let scene = load_bytes(&name, &bytes, format, &resources, limits).map_err(|error| {
        Fault::from(error).while_doing(format_args!("cannot read {}", quoted(path)))
    })?;
    let mut inputs = resources.asked.into_inner();
    inputs.push(path.to_owned());
    Ok(Loaded {
        scene,
        format,
        volume: None,
        inputs,
    })
}

/// Whether the extension of a path is that of a volume file.
pub fn has_volume_name(path: &Path) -> bool {
    has_ending(path, "vdb") || has_ending(path, "npy")
}

impl Loaded {
    /// A source of smoke with an empty scene.
    pub fn of_smoke(source: VolumeSource) -> Self {
        Self {
            scene: Scene::default(),
            format: None,
            volume: Some(source),
            inputs: Vec::new(),
        }
    }

    /// The bytes of a volume, called `name` in messages, with an empty scene.
    fn of_volume(name: String, bytes: Vec<u8>) -> Self {
        Self {
            scene: Scene {
                file_bytes: bytes.len() as u64,
                ..Scene::default()
            },
            format: None,
            volume: Some(VolumeSource::Read(name, bytes)),
            inputs: Vec::new(),
        }
    }
}

/// The files of a folder, with a record of those that were asked for.
struct Recorder {
    folder: PathBuf,
    files: FolderResources,
    asked: RefCell<Vec<PathBuf>>,
}

impl Recorder {
    fn new(folder: &Path, external: Option<&Path>) -> Result<Self, ResourceError> {
        let files = FolderResources::new(folder, external)?;
        Ok(Self {
            folder: folder.to_owned(),
            files,
            asked: RefCell::default(),
        })
    }
}

impl Resources for Recorder {
    fn read(&self, name: &str, limit_bytes: u64) -> Result<Vec<u8>, ResourceError> {
        self.asked.borrow_mut().push(self.folder.join(name));
        self.files.read(name, limit_bytes)
    }

    fn mention(&self, name: &str) {
        self.asked.borrow_mut().push(self.folder.join(name));
    }
}
