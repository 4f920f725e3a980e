//! Small valid files, for tests, fuzzing and benches.

use std::collections::BTreeMap;

use crate::transform::Transform;
use crate::voxel::ValueType;

/// How the chunks of a file are packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Packing {
    /// Not at all.
    Plain,
    /// By zlib.
    Zip,
    /// By blosc with LZ4 and shuffled bytes. Only from version 222 on.
    Blosc,
}

/// An OpenVDB file to be written.
#[derive(Debug, Clone)]
pub struct Sample {
    /// Version of the format, 220 to 224.
    pub version: u32,
    /// How chunks are packed.
    pub packing: Packing,
    /// Whether inactive values are left out. Only from version 222 on.
    pub leaves_out_inactive: bool,
    /// Whether nothing tells where grids end.
    pub is_stream: bool,
    /// Its grids.
    pub grids: Vec<SampleGrid>,
}

/// A value of up to three components; numbers use the first.
pub type SampleValue = [f32; 3];

/// A grid to be written.
#[derive(Debug, Clone)]
pub struct SampleGrid {
    /// Its name.
    pub name: String,
    /// What it holds. Values must be such as this type can hold.
    pub kind: ValueType,
    /// Whether real numbers are stored as half floats; values must fit them.
    pub is_half: bool,
    /// What is not in `voxels` or `tiles`.
    pub background: SampleValue,
    /// Values and whether they are active. No voxel may lie in a tile, nor in a leaf that does.
    pub voxels: BTreeMap<[i32; 3], (SampleValue, bool)>,
    /// Origin, side (8, 128 or 4096), value, and whether it is active. Origins are multiples of sides.
    pub tiles: Vec<([i32; 3], i32, SampleValue, bool)>,
    /// Where it lies.
    pub transform: Transform,
}

impl SampleGrid {
    /// A grid of nothing but zeros.
    pub fn new(name: &str, kind: ValueType) -> Self {
        Self {
            name: name.to_owned(),
            kind,
            is_half: false,
            background: [0.0; 3],
            voxels: BTreeMap::new(),
            tiles: Vec::new(),
            transform: Transform::IDENTITY,
        }
    }

    /// What a reader should find at `index`, by looking through everything.
    pub fn find(&self, index: [i32; 3]) -> (SampleValue, bool) {
        let holds =
            |origin: [i32; 3], side: i32| (0..3).all(|axis| index[axis] & -side == origin[axis]);
        let tile = self.tiles.iter().find(|tile| holds(tile.0, tile.1));
        let voxel = self.voxels.get(&index).copied();
        voxel
            .or(tile.map(|tile| (tile.2, tile.3)))
            .unwrap_or((self.background, false))
    }
}

impl Sample {
    /// A file of the newest version with these grids.
    pub fn new(grids: Vec<SampleGrid>) -> Self {
        Self {
            version: 224,
            packing: Packing::Blosc,
            leaves_out_inactive: true,
            is_stream: false,
            grids,
        }
    }

    /// A ball of smoke, thicker in the middle, some twenty voxels wide.
    pub fn puff() -> Self {
        Self::ball(10)
    }

    /// A ball of smoke of `radius` voxels, stored as half floats like those of simulations.
    pub fn ball(radius: i32) -> Self {
        let mut grid = SampleGrid::new("density", ValueType::Float);
        grid.is_half = true;
        let across = || -radius..=radius;
        for index in
            across().flat_map(|x| across().flat_map(move |y| across().map(move |z| [x, y, z])))
        {
            let distance_squared: i32 = index.iter().map(|part| part * part).sum();
            let inside = radius * radius - distance_squared;
            if inside > 0 {
                // Sixteenths, so that half floats hold them.
                let sixteenths = inside * 64 / (radius * radius)
                    + (index[0] * 7 + index[1] * 5 + index[2] * 3) % 4;
                grid.voxels
                    .insert(index, ([sixteenths as f32 / 16.0, 0.0, 0.0], true));
            }
        }
        Self::new(vec![grid])
    }

    /// The file's bytes.
    pub fn bytes(&self) -> Vec<u8> {
        let mut file = Vec::new();
        file.extend(b" BDV\0\0\0\0");
        put_u32(&mut file, self.version);
        put_u32(&mut file, 10);
        put_u32(&mut file, 0);
        file.push(u8::from(!self.is_stream));
        if self.version < 222 {
            file.push(u8::from(self.packing == Packing::Zip));
        }
        file.extend(b"00000000-0000-4000-8000-000000000000");
        put_u32(&mut file, 1);
        put_meta(&mut file, "creator", "string", b"npr-vdb");
        put_u32(&mut file, self.grids.len() as u32);
        for grid in &self.grids {
            self.put_grid(&mut file, grid);
        }
        file
    }

    fn put_grid(&self, file: &mut Vec<u8>, grid: &SampleGrid) {
        let suffix = if grid.is_half { "_HalfFloat" } else { "" };
        put_text(file, &grid.name);
        put_text(file, &format!("Tree_{}_5_4_3{suffix}", grid.kind));
        put_text(file, "");
        let offsets = file.len();
        file.extend([0; 24]);
        let start = file.len();
        if self.version >= 222 {
            let masks = if self.leaves_out_inactive { 2 } else { 0 };
            let packing = match self.packing {
                Packing::Plain => 0,
                Packing::Zip => 1,
                Packing::Blosc => 4,
            };
            put_u32(file, masks | packing);
        }
        put_u32(file, 1);
        put_meta(
            file,
            "is_saved_as_half_float",
            "bool",
            &[u8::from(grid.is_half)],
        );
        put_text(file, "AffineMap");
        let [x, y, z, origin] = grid.transform.columns();
        for (axis, last) in [(x, 0.0), (y, 0.0), (z, 0.0), (origin, 1.0)] {
            let row = axis.into_iter().chain([last]);
            file.extend(row.flat_map(f64::to_le_bytes));
        }
        let mut shape_end = 0;
        Writer {
            sample: self,
            grid,
            file,
        }
        .tree(&mut shape_end);
        if !self.is_stream {
            let stated = [start, shape_end, file.len()].map(|offset| (offset as u64).to_le_bytes());
            file[offsets..offsets + 24].copy_from_slice(stated.as_flattened());
        }
    }
}

/// A `.npy` file of version 1 with this header and these elements.
pub fn npy_file(header: &str, elements: &[u8]) -> Vec<u8> {
    let mut file = b"\x93NUMPY\x01\0".to_vec();
    file.extend((header.len() as u16).to_le_bytes());
    file.extend(header.bytes());
    file.extend(elements);
    file
}

fn put_u32(file: &mut Vec<u8>, number: u32) {
    file.extend(number.to_le_bytes());
}

fn put_text(file: &mut Vec<u8>, text: &str) {
    put_u32(file, text.len() as u32);
    file.extend(text.bytes());
}

fn put_meta(file: &mut Vec<u8>, name: &str, type_name: &str, value: &[u8]) {
    put_text(file, name);
    put_text(file, type_name);
    put_u32(file, value.len() as u32);
    file.extend(value);
}

fn put_corner(file: &mut Vec<u8>, corner: [i32; 3]) {
    file.extend(corner.iter().flat_map(|part| part.to_le_bytes()));
}

/// A place of a node.
#[derive(Clone)]
enum Place {
    Child,
    Tile(SampleValue, bool),
}

/// Writes the tree of one grid.
struct Writer<'a> {
    sample: &'a Sample,
    grid: &'a SampleGrid,
    file: &'a mut Vec<u8>,
}

impl Writer<'_> {
    /// Origins, multiples of `side`, of everything smaller than `side` that lies in the cube of `within` at `origin`.
    fn origins(&self, side: i32, origin: [i32; 3], within: i32) -> Vec<[i32; 3]> {
        let tiles = self
            .grid
            .tiles
            .iter()
            .filter(|tile| tile.1 < side)
            .map(|tile| tile.0);
        let corner = |index: [i32; 3], side: i32| index.map(|part| part & -side);
        let all = self.grid.voxels.keys().copied().chain(tiles);
        let mut origins: Vec<_> = all
            .filter(|&index| within == 0 || corner(index, within) == origin)
            .map(|index| corner(index, side))
            .collect();
        origins.sort_unstable();
        origins.dedup();
        origins
    }

    fn tree(&mut self, shape_end: &mut usize) {
        put_u32(self.file, 1);
        self.single(self.grid.background);
        let uppers = self.origins(4096, [0; 3], 0);
        let tiles: Vec<_> = self
            .grid
            .tiles
            .iter()
            .filter(|tile| tile.1 == 4096)
            .collect();
        put_u32(self.file, tiles.len() as u32);
        put_u32(self.file, uppers.len() as u32);
        for &&(origin, _, value, is_active) in &tiles {
            put_corner(self.file, origin);
            self.single(value);
            self.file.push(u8::from(is_active));
        }
        let mut leaves = Vec::new();
        for upper in uppers {
            put_corner(self.file, upper);
            for lower in self.node(upper, 32, 128) {
                for leaf in self.node(lower, 16, 8) {
                    let (_, active) = self.leaf(leaf);
                    self.file.extend(mask(&active));
                    leaves.push(leaf);
                }
            }
        }
        *shape_end = self.file.len();
        for leaf in leaves {
            self.buffer(leaf);
        }
    }

    /// Writes a node; origins of its children in their order.
    fn node(&mut self, origin: [i32; 3], places: i32, side: i32) -> Vec<[i32; 3]> {
        let children = self.origins(side, origin, places * side);
        let place = |index: [i32; 3]| {
            let step = |axis: usize| ((index[axis] - origin[axis]) / side) as usize;
            (step(0) * places as usize + step(1)) * places as usize + step(2)
        };
        let mut all =
            vec![Place::Tile(self.grid.background, false); (places * places * places) as usize];
        for tile in self.grid.tiles.iter().filter(|tile| tile.1 == side) {
            if tile.0.map(|part| part & -(places * side)) == origin {
                all[place(tile.0)] = Place::Tile(tile.2, tile.3);
            }
        }
        children
            .iter()
            .for_each(|&child| all[place(child)] = Place::Child);
        let is_child: Vec<_> = all
            .iter()
            .map(|place| matches!(place, Place::Child))
            .collect();
        let active: Vec<_> = all
            .iter()
            .map(|place| matches!(place, Place::Tile(_, true)))
            .collect();
        self.file.extend(mask(&is_child));
        self.file.extend(mask(&active));
        let tile = |place: &Place| match place {
            Place::Child => None,
            Place::Tile(value, _) => Some(*value),
        };
        if self.sample.version < 222 {
            let values: Vec<_> = all.iter().filter_map(tile).collect();
            self.chunk(&values);
        } else {
            let values: Vec<_> = all
                .iter()
                .map(|place| tile(place).unwrap_or_default())
                .collect();
            let ignored: Vec<_> = is_child;
            self.values(&values, &active, &ignored);
        }
        let mut children = children;
        children.sort_unstable_by_key(|&child| place(child));
        children
    }

    /// Values of a leaf and which of them are active.
    fn leaf(&self, origin: [i32; 3]) -> (Vec<SampleValue>, Vec<bool>) {
        let index = |place: i32| {
            [
                origin[0] + (place >> 6),
                origin[1] + (place >> 3 & 7),
                origin[2] + (place & 7),
            ]
        };
        (0..512).map(|place| self.grid.find(index(place))).unzip()
    }

    fn buffer(&mut self, origin: [i32; 3]) {
        let (values, active) = self.leaf(origin);
        self.file.extend(mask(&active));
        if self.grid.kind == ValueType::Bool {
            put_corner(self.file, origin);
            let on: Vec<_> = values.iter().map(|value| value[0] != 0.0).collect();
            self.file.extend(mask(&on));
        } else if self.sample.version < 222 {
            put_corner(self.file, origin);
            // A second buffer, which nothing uses.
            self.file.push(2);
            self.chunk(&values);
            self.chunk(&vec![[0.0; 3]; 512]);
        } else {
            self.values(&values, &active, &[false; 512]);
        }
    }

    /// Writes the values of a node with as few inactive ones as the format allows; those to be `ignored` may be lost.
    fn values(&mut self, values: &[SampleValue], active: &[bool], ignored: &[bool]) {
        let background = self.grid.background;
        let opposite = match self.grid.kind {
            ValueType::Bool => [1.0 - background[0], 0.0, 0.0],
            _ => background.map(|part| -part),
        };
        let mut inactive: Vec<SampleValue> = Vec::new();
        let count = if self.grid.kind.is_vector() { 3 } else { 1 };
        let same = |one: &SampleValue, other: &SampleValue| {
            one[..count]
                .iter()
                .map(|part| part.to_bits())
                .eq(other[..count].iter().map(|part| part.to_bits()))
        };
        for (place, value) in values.iter().enumerate() {
            let counts = !active[place] && !ignored[place];
            if counts && inactive.len() < 3 && !inactive.iter().any(|known| same(known, value)) {
                inactive.push(*value);
            }
        }
        // Where a mask chooses, a set bit stands for the second of these.
        let is_background = |value: &SampleValue| same(value, &background);
        let (kind, first, second) = match inactive.as_slice() {
            [] => (0, background, background),
            [one] if is_background(one) => (0, *one, *one),
            [one] if same(one, &opposite) => (1, *one, *one),
            [one] => (2, *one, *one),
            [one, other] if is_background(one) && same(other, &opposite) => (3, *other, *one),
            [one, other] if is_background(other) && same(one, &opposite) => (3, *one, *other),
            [one, other] if is_background(one) => (4, *other, *one),
            [one, other] if is_background(other) => (4, *one, *other),
            [one, other] => (5, *one, *other),
            _ => (6, background, background),
        };
        self.file.push(kind);
        if matches!(kind, 2 | 4 | 5) {
            self.single(first);
        }
        if kind == 5 {
            self.single(second);
        }
        if matches!(kind, 3..=5) {
            let bits: Vec<_> = (0..values.len())
                .map(|place| !active[place] && same(&values[place], &second))
                .collect();
            self.file.extend(mask(&bits));
        }
        let leaves_out = self.sample.leaves_out_inactive && kind != 6;
        let stored = values
            .iter()
            .zip(active)
            .filter(|(_, active)| !leaves_out || **active);
        let stored: Vec<_> = stored.map(|(value, _)| *value).collect();
        self.chunk(&stored);
    }

    fn single(&mut self, value: SampleValue) {
        let bytes = self.encoded(&[value], false);
        self.file.extend(bytes);
    }

    fn chunk(&mut self, values: &[SampleValue]) {
        let is_real = !matches!(
            self.grid.kind,
            ValueType::Bool | ValueType::Int32 | ValueType::Int64 | ValueType::Vec3i
        );
        let is_half = self.grid.is_half && is_real;
        if is_half && values.is_empty() {
            return;
        }
        let bytes = self.encoded(values, is_half);
        let packed = match self.sample.packing {
            Packing::Plain => return self.file.extend(bytes),
            Packing::Zip => miniz_oxide::deflate::compress_to_vec_zlib(&bytes, 6),
            Packing::Blosc => blosc(&bytes, if is_half { 2 } else { 4 }),
        };
        if packed.len() < bytes.len() {
            self.file.extend((packed.len() as i64).to_le_bytes());
            self.file.extend(packed);
        } else {
            self.file.extend((-(bytes.len() as i64)).to_le_bytes());
            self.file.extend(bytes);
        }
    }

    fn encoded(&self, values: &[SampleValue], is_half: bool) -> Vec<u8> {
        let count = if self.grid.kind.is_vector() { 3 } else { 1 };
        let numbers = values.iter().flat_map(|value| &value[..count]);
        numbers
            .flat_map(|&number| self.encoded_number(number, is_half))
            .collect()
    }

    fn encoded_number(&self, number: f32, is_half: bool) -> Vec<u8> {
        match self.grid.kind {
            ValueType::Bool => vec![u8::from(number != 0.0)],
            ValueType::Int32 | ValueType::Vec3i => (number as i32).to_le_bytes().to_vec(),
            ValueType::Int64 => (number as i64).to_le_bytes().to_vec(),
            _ if is_half => half(number).to_le_bytes().to_vec(),
            ValueType::Float | ValueType::Vec3s => number.to_le_bytes().to_vec(),
            ValueType::Double | ValueType::Vec3d => f64::from(number).to_le_bytes().to_vec(),
        }
    }
}

/// The half float of a number that one holds exactly, in its normal range.
fn half(number: f32) -> u16 {
    let bits = number.to_bits();
    let sign = (bits >> 16 & 0x8000) as u16;
    let exponent = (bits >> 23 & 0xff) as i32 - 112;
    match exponent {
        -112 => sign,
        143 => sign | 0x7c00 | u16::from(number.is_nan()),
        1..31 => sign | (exponent as u16) << 10 | (bits >> 13 & 0x3ff) as u16,
        _ => unreachable!("{number} is no normal half float"),
    }
}

fn mask(bits: &[bool]) -> Vec<u8> {
    let byte = |bits: &[bool]| (0..8).fold(0, |byte, bit| byte | u8::from(bits[bit]) << bit);
    bits.chunks(8).map(byte).collect()
}

/// A container of one block, its bytes shuffled, not split.
fn blosc(bytes: &[u8], element_bytes: usize) -> Vec<u8> {
    let count = bytes.len() / element_bytes;
    let place = |at: usize| (at % count) * element_bytes + at / count;
    let shuffled: Vec<_> = (0..count * element_bytes)
        .map(|at| bytes[place(at)])
        .collect();
    let stream = lz4_flex::block::compress(&shuffled);
    let mut packed = vec![2, 1, 0x31, element_bytes as u8];
    put_u32(&mut packed, bytes.len() as u32);
    put_u32(&mut packed, bytes.len() as u32);
    put_u32(&mut packed, stream.len() as u32 + 24);
    put_u32(&mut packed, 20);
    put_u32(&mut packed, stream.len() as u32);
    packed.extend(stream);
    packed
}
