//! An OpenVDB file and its grids.

use crate::chunk::Compression;
use crate::cursor::Cursor;
use crate::fault::Fault;
use crate::grid::{Grid, Tree};
use crate::info::{GridInfo, Values};
use crate::limits::{Budget, Limits};
use crate::metadata::Metadata;
use crate::packed::{Codec, MASKS_VERSION};
use crate::transform::Transform;
use crate::tree;
use crate::voxel::{ValueType, Voxel};

/// What every file begins with.
const MAGIC: &[u8; 8] = b" BDV\0\0\0\0";

/// Characters of the number that every file has of its own.
const UUID_CHARS: usize = 36;

/// Bytes of the smallest entry of a grid: three lengths and three offsets.
const LEAST_ENTRY_BYTES: usize = 36;

/// Between a grid's name and the number that tells it from others of its name.
const NUMBER_SEPARATOR: char = '\x1e';

/// An OpenVDB file whose list of grids was read, but none of the grids.
#[derive(Debug, Clone)]
pub struct File<'a> {
    version: u32,
    metadata: Metadata,
    infos: Vec<GridInfo>,
    /// One for each of `infos`.
    bodies: Vec<Body<'a>>,
    limits: Limits,
}

/// Where the tree of a grid is, and how it is stored.
#[derive(Debug, Clone)]
struct Body<'a> {
    /// The name with its number.
    unique_name: String,
    /// The unique name of the grid whose tree this one shares.
    parent: Option<String>,
    compression: Compression,
    tree: Cursor<'a>,
}

/// Reads the list of grids of an OpenVDB file.
///
/// O(grids) where the file tells where grids end, as files on disk do; of a stream all trees are read once to find
/// out. Takes memory in proportion to the metadata, about ten times its bytes.
///
/// # Errors
///
/// A [`Fault`] unless the file is an OpenVDB file of version 220 to 224 with a sound list of grids. Grids of types
/// that are not read are no fault here, except in a stream, where nothing tells where they end.
pub fn read<'a>(bytes: &'a [u8], limits: &Limits) -> Result<File<'a>, Fault> {
    let mut cursor = Cursor::new(bytes);
    let header = Header::read(&mut cursor)?;
    let metadata = Metadata::read(&mut cursor)?;
    let count = cursor.count(LEAST_ENTRY_BYTES, "the list of grids")?;
    let mut file = File {
        version: header.version,
        metadata,
        infos: Vec::new(),
        bodies: Vec::new(),
        limits: *limits,
    };
    for _ in 0..count {
        file.read_entry(&header, &mut cursor)?;
    }
    Ok(file)
}

/// What stands before everything else.
struct Header {
    version: u32,
    /// Whether entries tell where their grids end.
    has_offsets: bool,
    /// How all grids are stored, in files that do not say it for each.
    compression: Option<Compression>,
}

impl Header {
    fn read(cursor: &mut Cursor) -> Result<Self, Fault> {
        const WHAT: &str = "the file's header";
        let magic = cursor.array(WHAT).map_err(|_| Fault::NotVdb)?;
        if magic != *MAGIC {
            return Err(Fault::NotVdb);
        }
        let version = cursor.u32(WHAT)?;
        if !(220..=224).contains(&version) {
            return Err(Fault::Version { version });
        }
        // The version of the library that wrote it tells nothing.
        cursor.take(8, WHAT)?;
        let has_offsets = cursor.flag(WHAT)?;
        let compression = match version < MASKS_VERSION {
            true => Some(Compression::of_whole_file(cursor.flag(WHAT)?)),
            false => None,
        };
        cursor.take(UUID_CHARS, WHAT)?;
        Ok(Self {
            version,
            has_offsets,
            compression,
        })
    }
}

impl<'a> File<'a> {
    /// Version of the file format, 220 to 224.
    pub fn version(&self) -> u32 {
        self.version
    }

    /// What the file says of itself.
    pub fn metadata(&self) -> &Metadata {
        &self.metadata
    }

    /// All grids in the order of the file.
    pub fn grids(&self) -> &[GridInfo] {
        &self.infos
    }

    /// Reads the first grid of this name, which holds numbers.
    ///
    /// # Errors
    ///
    /// A [`Fault`] where there is no such grid, it holds vectors or what is not read, it is broken, or it exceeds the
    /// limits.
    pub fn scalar(&self, name: &str) -> Result<Grid<f32>, Fault> {
        self.scalar_at(self.find(name)?)
    }

    /// Reads the first grid of this name, which holds vectors.
    ///
    /// # Errors
    ///
    /// As for [`File::scalar`].
    pub fn vector(&self, name: &str) -> Result<Grid<[f32; 3]>, Fault> {
        self.vector_at(self.find(name)?)
    }

    /// Reads the grid at this place in [`File::grids`], which holds numbers.
    ///
    /// # Errors
    ///
    /// As for [`File::scalar`].
    pub fn scalar_at(&self, place: usize) -> Result<Grid<f32>, Fault> {
        self.grid_at(place)
    }

    /// Reads the grid at this place in [`File::grids`], which holds vectors.
    ///
    /// # Errors
    ///
    /// As for [`File::scalar`].
    pub fn vector_at(&self, place: usize) -> Result<Grid<[f32; 3]>, Fault> {
        self.grid_at(place)
    }

    fn find(&self, name: &str) -> Result<usize, Fault> {
        let place = self.infos.iter().position(|info| info.name == name);
        place.ok_or_else(|| self.no_grid(name))
    }

    fn no_grid(&self, name: &str) -> Fault {
        Fault::NoGrid {
            name: name.to_owned(),
            names: self.infos.iter().map(|info| info.name.clone()).collect(),
        }
    }

    fn grid_at<V: Voxel>(&self, place: usize) -> Result<Grid<V>, Fault> {
        // Find a grid that holds what is asked for, in a transform that is read.
        let info = self.infos.get(place);
        let info = info.ok_or_else(|| self.no_grid(&place.to_string()))?;
        let kind = known_kind(info)?;
        if kind.is_vector() != (V::COUNT == 3) {
            return Err(Fault::Kind {
                grid: info.name.clone(),
                holds: kind,
                vectors_wanted: V::COUNT == 3,
            });
        }
        let transform = linear_transform(info)?;

        // Unpack its tree.
        let (body, is_half) = self.body(place, kind)?;
        let mut budget = Budget::new(&self.limits);
        let mut cursor = body.tree;
        let codec = Codec {
            version: self.version,
            compression: body.compression,
            kind,
            is_half,
        };
        let tree = tree::read(&mut cursor, &codec, &mut budget)?;

        // Refuse bytes that nothing accounts for.
        if cursor.left() > 0 {
            return Err(Fault::Broken {
                what: "a grid",
                at: cursor.at(),
                fault: "bytes are left over behind its values",
            });
        }
        Ok(Grid {
            info: info.clone(),
            transform,
            tree,
            budget,
        })
    }

    /// Where the tree of the grid at `place` is, its own or the one it shares, and whether it is stored as half floats.
    fn body(&self, place: usize, kind: ValueType) -> Result<(&Body<'a>, bool), Fault> {
        let pairs = || self.bodies.iter().zip(&self.infos);
        let (body, info) = pairs().nth(place).ok_or_else(|| self.no_grid(""))?;
        let Some(parent) = &body.parent else {
            return Ok((body, info.is_half));
        };
        let shared = pairs().find(|(body, info)| {
            body.unique_name == *parent
                && body.parent.is_none()
                && info.values == Values::Known(kind)
        });
        let (body, info) = shared.ok_or_else(|| Fault::Instance {
            grid: info.name.clone(),
            parent: parent.clone(),
        })?;
        Ok((body, info.is_half))
    }

    /// Reads what the file says of the next grid, and moves on behind it.
    fn read_entry(&mut self, header: &Header, cursor: &mut Cursor<'a>) -> Result<(), Fault> {
        const WHAT: &str = "an entry in the list of grids";
        let unique_name = cursor.text(WHAT)?;
        let type_name = cursor.text(WHAT)?;
        let parent = Some(cursor.text(WHAT)?).filter(|parent| !parent.is_empty());
        let offset = |offset: i64| usize::try_from(offset).unwrap_or(usize::MAX);
        let (start, shape_end, end) = (
            offset(cursor.i64(WHAT)?),
            offset(cursor.i64(WHAT)?),
            offset(cursor.i64(WHAT)?),
        );
        let mut part = *cursor;
        if header.has_offsets {
            part = cursor.part(start, end, "a grid")?;
            // Grids that share a tree have no values, and state no place where they begin.
            if parent.is_none() {
                part.part(shape_end, end, "a grid's values")?;
            }
            cursor.take(end.saturating_sub(cursor.at()), "a grid")?;
        }
        let name = unique_name
            .split(NUMBER_SEPARATOR)
            .next()
            .unwrap_or_default();
        let (info, compression) = read_info(name.to_owned(), &type_name, header, &mut part)?;
        let mut body = Body {
            unique_name,
            parent,
            compression,
            tree: part,
        };
        if !header.has_offsets {
            body.tree = self.streamed(&info, &body)?;
            cursor.take(body.tree.end().saturating_sub(cursor.at()), "a grid")?;
        }
        self.infos.push(info);
        self.bodies.push(body);
        Ok(())
    }

    /// Finds the end of a tree that only reading it can tell.
    fn streamed(&self, info: &GridInfo, body: &Body<'a>) -> Result<Cursor<'a>, Fault> {
        let start = body.tree;
        linear_transform(info)?;
        let codec = Codec {
            version: self.version,
            compression: body.compression,
            kind: known_kind(info)?,
            is_half: info.is_half,
        };
        let mut cursor = start;
        let mut budget = Budget::new(&self.limits);
        match (&body.parent, codec.kind.is_vector()) {
            (Some(_), _) => {}
            (None, true) => drop::<Tree<[f32; 3]>>(tree::read(&mut cursor, &codec, &mut budget)?),
            (None, false) => drop::<Tree<f32>>(tree::read(&mut cursor, &codec, &mut budget)?),
        }
        start.part(start.at(), cursor.at(), "a grid")
    }
}

/// Reads what stands before a grid's tree.
fn read_info(
    name: String,
    type_name: &str,
    header: &Header,
    cursor: &mut Cursor,
) -> Result<(GridInfo, Compression), Fault> {
    // Learn how its values are compressed: old files say so once for all grids.
    let at = cursor.at();
    let compression = match header.compression {
        Some(compression) => compression,
        None => {
            let flags = cursor.u32("a grid")?;
            Compression::of_flags(flags).ok_or(Fault::Broken {
                what: "a grid",
                at,
                fault: "it is compressed in an unknown way",
            })?
        }
    };

    // Read what is known of it, and where it lies.
    let metadata = Metadata::read(cursor)?;
    let transform = Transform::read(cursor)?;
    Ok((
        GridInfo::new(name, type_name, transform, metadata),
        compression,
    ))
}

fn known_kind(info: &GridInfo) -> Result<ValueType, Fault> {
    match &info.values {
        Values::Known(kind) => Ok(*kind),
        Values::Other(type_name) => Err(Fault::GridType {
            grid: info.name.clone(),
            type_name: type_name.clone(),
        }),
    }
}

fn linear_transform(info: &GridInfo) -> Result<Transform, Fault> {
    info.transform.clone().map_err(|map| Fault::Map {
        grid: info.name.clone(),
        map,
    })
}
