//! Prepared shapes as bytes, so that a second start need not prepare them again.
//!
//! [`encode`] and [`decode`] turn a shape into bytes and back; whoever calls them reads and writes the file.
//! [`shape_key`] names the input: a cache that was made from anything else is refused.
//!
//! All numbers are little-endian. A header of 72 bytes:
//!
//! | bytes | content |
//! |---|---|
//! | 8 | `NPRSHAPE` |
//! | 4 | [`VERSION`] |
//! | 4 | number of surfaces |
//! | 16 | key of the input |
//! | 4 each | number of vertices, faces, edges, slivers, wires, and 0 |
//! | 8 | bytes of the surfaces |
//! | 8 | checksum of everything else |
//!
//! Then the lists of [`Shape`] in the order of its fields, without `edge_of`, which follows from the sides;
//! then, for each surface, its numbers, and its names with their lengths before them.

use npr_core::geometry::NONE;
use npr_core::shape::{BrokenShape, Shape, Surface};

use crate::content_hash::ContentHash;
use crate::shape::PlacedMesh;

/// Counts up with every change of the layout or of what a prepared shape holds.
pub const VERSION: u32 = 2;

const MAGIC: [u8; 8] = *b"NPRSHAPE";
const HEADER: usize = 72;
const CHECKSUM: std::ops::Range<usize> = 64..72;

/// Why a cache cannot be used. None of these is worth a message to the user: prepare the mesh again.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CacheError {
    /// The bytes are something else.
    #[error("this is no cached shape")]
    NotAShape,
    /// Another version of the program wrote it.
    #[error("the cached shape has version {found}, not {VERSION}")]
    OtherVersion {
        /// The version as read.
        found: u32,
    },
    /// It was made from another input, or with another tolerance.
    #[error("the cached shape belongs to another mesh")]
    OtherInput,
    /// It was cut off, or something was added.
    #[error("the cached shape has {found} bytes, but announces {expected}")]
    OtherLength {
        /// How many bytes there are.
        found: usize,
        /// How many the header asks for; the greatest number if it cannot be had at all.
        expected: u64,
    },
    /// Bytes have changed.
    #[error("the cached shape is damaged")]
    Damaged,
    /// A name is no text, or the surfaces do not fill their space.
    #[error("surface {surface} of the cached shape is damaged")]
    BadSurface {
        /// Which surface, counted from 0.
        surface: u32,
    },
    /// The lists contradict each other.
    #[error(transparent)]
    Broken(#[from] BrokenShape),
}

/// Names everything that a shape is made from: the same input has the same key on every machine.
///
/// Two inputs that differ have the same key with probability 2^-128, unless they are made to; it is no
/// cryptographic hash. About 1 ns per vertex and per corner.
pub fn shape_key(surfaces: &[Surface], meshes: &[PlacedMesh<'_>], weld_tolerance: f32) -> u128 {
    let mut hash = ContentHash::new();
    hash.numbers(&[VERSION, weld_tolerance.to_bits(), count(meshes.len())]);
    let mut bytes = Vec::new();
    surfaces
        .iter()
        .for_each(|surface| write_surface(&mut bytes, surface));
    hash.bytes(&bytes);
    for mesh in meshes {
        hash.positions(mesh.rest);
        hash.positions(mesh.world);
        hash.numbers(mesh.triangles.as_flattened());
        hash.numbers(mesh.surfaces);
        hash.numbers(mesh.marks.as_flattened());
        hash.numbers(mesh.wires.as_flattened());
        hash.numbers(mesh.wire_surfaces);
        hash.numbers(&[u32::from(mesh.mirrored)]);
    }
    hash.finish()
}

/// A shape as bytes, under the key of its input.
///
/// About 64 bytes per face of a closed mesh.
///
/// # Panics
///
/// If a list or a name has 2^32 elements or more.
pub fn encode(shape: &Shape, key: u128) -> Vec<u8> {
    let mut surfaces = Vec::new();
    shape
        .surfaces
        .iter()
        .for_each(|surface| write_surface(&mut surfaces, surface));
    let counts = Counts {
        surfaces: count(shape.surfaces.len()),
        vertices: count(shape.positions.len()),
        faces: count(shape.faces.len()),
        edges: count(shape.edge_count()),
        slivers: count(shape.slivers.len()),
        wires: count(shape.wires.len()),
        surface_bytes: surfaces.len() as u64,
    };
    let mut bytes = Vec::with_capacity(counts.file_size().unwrap_or(0) as usize);
    counts.write(&mut bytes, key);
    let mut put = |numbers: &mut dyn Iterator<Item = u32>| {
        numbers.for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
    };
    put(&mut shape.positions.as_flattened().iter().map(|v| v.to_bits()));
    put(&mut shape.faces.as_flattened().iter().copied());
    put(&mut shape.face_surfaces.iter().copied());
    put(&mut shape.twins.iter().copied());
    // A shape that was never filled has no starts at all.
    put(&mut shape
        .edge_starts
        .iter()
        .copied()
        .chain([0])
        .take(shape.edge_count() + 1));
    put(&mut shape.edge_sides.iter().copied());
    put(&mut shape.dihedral_cos.iter().map(|v| v.to_bits()));
    put(&mut shape.edge_traits.iter().copied());
    put(&mut shape.slivers.as_flattened().iter().copied());
    put(&mut shape.wires.as_flattened().iter().copied());
    put(&mut shape.wire_surfaces.iter().copied());
    bytes.extend_from_slice(&surfaces);
    let sum = checksum(&bytes);
    bytes[CHECKSUM].copy_from_slice(&sum.to_le_bytes());
    bytes
}

/// The shape that was encoded under `key`.
///
/// Nothing in the bytes is trusted: lengths are compared before anything is allocated, then the checksum,
/// then every promise of [`Shape`], so that a shape made to deceive is no worse than a strange mesh.
///
/// # Errors
///
/// [`CacheError`] on any difference from what [`encode`] writes.
pub fn decode(bytes: &[u8], key: u128) -> Result<Shape, CacheError> {
    let counts = Counts::read(bytes, key)?;
    let mut rest = Reader(bytes.get(HEADER..).unwrap_or_default());
    let [vertices, faces, edges, slivers, wires] = counts.of_lists().map(|n| n as usize);
    let mut shape = Shape {
        positions: rest
            .rows(vertices)?
            .into_iter()
            .map(|p| p.map(f32::from_bits))
            .collect(),
        faces: rest.rows(faces)?,
        face_surfaces: rest.numbers(faces)?,
        twins: rest.numbers(3 * faces)?,
        edge_of: Vec::new(),
        edge_starts: rest.numbers(edges + 1)?,
        edge_sides: rest.numbers(3 * faces)?,
        dihedral_cos: rest
            .numbers(edges)?
            .into_iter()
            .map(f32::from_bits)
            .collect(),
        edge_traits: rest.numbers(edges)?,
        slivers: rest.rows(slivers)?,
        wires: rest.rows(wires)?,
        wire_surfaces: rest.numbers(wires)?,
        surfaces: Vec::new(),
    };
    shape.edge_of = edge_of(&shape).ok_or(CacheError::Damaged)?;
    for surface in 0..counts.surfaces {
        let read = read_surface(&mut rest).ok_or(CacheError::BadSurface { surface })?;
        shape.surfaces.push(read);
    }
    if !rest.0.is_empty() {
        return Err(CacheError::BadSurface {
            surface: counts.surfaces,
        });
    }
    shape.check()?;
    Ok(shape)
}

/// The edge of every half-edge, if the sides name existing ones.
fn edge_of(shape: &Shape) -> Option<Vec<u32>> {
    let mut edge_of = vec![NONE; shape.edge_sides.len()];
    for (edge, bounds) in shape.edge_starts.windows(2).enumerate() {
        for &side in shape
            .edge_sides
            .get(bounds[0] as usize..bounds[1] as usize)?
        {
            *edge_of.get_mut(side as usize)? = edge as u32;
        }
    }
    Some(edge_of)
}

/// How much of everything a file holds.
#[derive(Debug, Clone, Copy)]
struct Counts {
    surfaces: u32,
    vertices: u32,
    faces: u32,
    edges: u32,
    slivers: u32,
    wires: u32,
    surface_bytes: u64,
}

impl Counts {
    /// Of vertices, faces, edges, slivers and wires.
    fn of_lists(&self) -> [u32; 5] {
        [
            self.vertices,
            self.faces,
            self.edges,
            self.slivers,
            self.wires,
        ]
    }

    fn file_size(&self) -> Option<u64> {
        let [vertices, faces, edges, slivers, wires] = self.of_lists().map(u64::from);
        // Corners, surface, twins and sides of a face; start, angle and traits of an edge; ends and surface of a wire.
        let numbers = 3 * vertices + 10 * faces + 3 * edges + 1 + 2 * slivers + 3 * wires;
        (HEADER as u64 + 4 * numbers).checked_add(self.surface_bytes)
    }

    /// Appends a header whose checksum is still 0.
    fn write(&self, bytes: &mut Vec<u8>, key: u128) {
        bytes.extend_from_slice(&MAGIC);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&self.surfaces.to_le_bytes());
        bytes.extend_from_slice(&key.to_le_bytes());
        for number in self.of_lists().into_iter().chain([0]) {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        bytes.extend_from_slice(&self.surface_bytes.to_le_bytes());
        bytes.extend_from_slice(&[0; 8]);
    }

    /// Reads a header that fits the key and the bytes after it.
    fn read(bytes: &[u8], key: u128) -> Result<Self, CacheError> {
        let mut header = Reader(bytes);
        let start = header.bytes().filter(|found| *found == MAGIC);
        start.ok_or(CacheError::NotAShape)?;
        let cut = CacheError::OtherLength {
            found: bytes.len(),
            expected: HEADER as u64,
        };
        let mut number = || header.bytes().map(u32::from_le_bytes).ok_or(cut.clone());
        let (version, surfaces) = (number()?, number()?);
        if version != VERSION {
            return Err(CacheError::OtherVersion { found: version });
        }
        let found_key = header.bytes().map(u128::from_le_bytes).ok_or(cut.clone())?;
        if found_key != key {
            return Err(CacheError::OtherInput);
        }
        let mut number = || header.bytes().map(u32::from_le_bytes).ok_or(cut.clone());
        let (vertices, faces, edges, slivers) = (number()?, number()?, number()?, number()?);
        let (wires, _) = (number()?, number()?);
        let mut long = || header.bytes().map(u64::from_le_bytes).ok_or(cut.clone());
        let (surface_bytes, sum) = (long()?, long()?);
        let counts = Self {
            surfaces,
            vertices,
            faces,
            edges,
            slivers,
            wires,
            surface_bytes,
        };
        let expected = counts.file_size().unwrap_or(u64::MAX);
        if bytes.len() as u64 != expected {
            return Err(CacheError::OtherLength {
                found: bytes.len(),
                expected,
            });
        }
        if checksum(bytes) != sum {
            return Err(CacheError::Damaged);
        }
        Ok(counts)
    }
}

fn count(length: usize) -> u32 {
    u32::try_from(length).expect("lists of a shape have 32-bit numbers")
}

/// What is left to read.
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, length: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(taken)
    }

    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.take(N)?.try_into().ok()
    }

    fn number(&mut self) -> Option<u32> {
        self.bytes().map(u32::from_le_bytes)
    }

    fn numbers(&mut self, count: usize) -> Result<Vec<u32>, CacheError> {
        Ok(self.rows::<1>(count)?.into_flattened())
    }

    fn rows<const N: usize>(&mut self, count: usize) -> Result<Vec<[u32; N]>, CacheError> {
        let bytes = self.take(4 * N * count).ok_or(CacheError::Damaged)?;
        let (numbers, _) = bytes.as_chunks::<4>();
        let (rows, _) = numbers.as_chunks::<N>();
        Ok(rows.iter().map(|row| row.map(u32::from_le_bytes)).collect())
    }

    fn text(&mut self) -> Option<String> {
        let length = self.number()? as usize;
        String::from_utf8(self.take(length)?.to_vec()).ok()
    }
}

fn write_surface(bytes: &mut Vec<u8>, surface: &Surface) {
    bytes.extend_from_slice(&surface.object.to_le_bytes());
    bytes.extend_from_slice(&surface.material.to_le_bytes());
    for channel in surface.base_color {
        bytes.extend_from_slice(&channel.to_bits().to_le_bytes());
    }
    bytes.push(u8::from(surface.double_sided));
    for name in [&surface.object_name, &surface.material_name] {
        bytes.extend_from_slice(&count(name.len()).to_le_bytes());
        bytes.extend_from_slice(name.as_bytes());
    }
}

fn read_surface(rest: &mut Reader) -> Option<Surface> {
    let (object, material) = (rest.number()?, rest.number()?);
    let channels = [
        rest.number()?,
        rest.number()?,
        rest.number()?,
        rest.number()?,
    ];
    let double_sided = match rest.bytes()? {
        [0] => false,
        [1] => true,
        _ => return None,
    };
    Some(Surface {
        object,
        material,
        base_color: channels.map(f32::from_bits),
        double_sided,
        object_name: rest.text()?,
        material_name: rest.text()?,
    })
}

/// Of all bytes but the checksum's own. A single changed byte always changes it.
fn checksum(bytes: &[u8]) -> u64 {
    let mut hash = ContentHash::new();
    hash.bytes(&bytes[..CHECKSUM.start]);
    hash.bytes(&bytes[CHECKSUM.end..]);
    hash.finish() as u64
}

#[cfg(test)]
mod tests;
