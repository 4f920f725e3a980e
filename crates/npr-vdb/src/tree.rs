//! The tree of a grid: first its shape, then the values of its leaves.
//!
//! Under the root stand nodes of 32 x 32 x 32 places, under those nodes of 16 x 16 x 16, under those leaves of 8 x 8
//! x 8 voxels. A place without a child is a tile: one value for all its voxels [Museth 2013].

use std::ops::Range;

use crate::cursor::Cursor;
use crate::fault::Fault;
use crate::grid::{LEAF_SIDE, LEAF_VOXELS, LeafHead, Tile, Tree};
use crate::limits::Budget;
use crate::mask::Mask;
use crate::packed::{Codec, MASKS_VERSION, Others, Unpacked};
use crate::voxel::{ValueType, Voxel};

/// A kind of node between root and leaves.
#[derive(Debug, Clone, Copy)]
struct Level {
    /// Binary logarithm of the places along a side.
    side_log2: u32,
    /// Voxels along a side of one place.
    place_side: u16,
}

const UPPER: Level = Level {
    side_log2: 5,
    place_side: 128,
};

const LOWER: Level = Level {
    side_log2: 4,
    place_side: LEAF_SIDE,
};

/// Voxels along a side of what stands under the root.
const ROOT_SIDE: u16 = 4096;

/// Bytes of the smallest child of the root: its place and two masks.
const LEAST_CHILD_BYTES: usize = 12 + 2 * 4096;

/// Bytes of a leaf's mask.
const LEAF_MASK_BYTES: usize = LEAF_VOXELS / 8;

/// Reads the tree at `cursor`.
pub(crate) fn read<V: Voxel>(
    cursor: &mut Cursor,
    codec: &Codec,
    budget: &mut Budget,
) -> Result<Tree<V>, Fault> {
    let at = cursor.at();
    // Trees once had several buffers; the format still counts them.
    if cursor.u32("a tree")? != 1 {
        return Err(Fault::Broken {
            what: "a tree",
            at,
            fault: "it has other than one buffer",
        });
    }
    let background = codec.single(cursor)?;
    let mut reader = Reader {
        cursor,
        codec,
        budget,
        background,
        unpacked: Unpacked::default(),
        tiles: Vec::new(),
        leaves: Vec::new(),
    };
    let order = reader.shape()?;
    let values = reader.values(order)?;
    let (mut tiles, mut leaves) = (reader.tiles, reader.leaves);
    tiles.sort_unstable_by_key(|tile| tile.origin);
    leaves.sort_unstable_by_key(|leaf| leaf.origin);
    Ok(Tree {
        background,
        tiles,
        leaves,
        values,
    })
}

struct Reader<'r, 'a, V> {
    cursor: &'r mut Cursor<'a>,
    codec: &'r Codec,
    budget: &'r mut Budget,
    background: V,
    unpacked: Unpacked<V>,
    tiles: Vec<Tile<V>>,
    leaves: Vec<LeafHead>,
}

impl<'a, V: Voxel> Reader<'_, 'a, V> {
    /// Reads all nodes; ranges of leaves in the order in which their values follow.
    fn shape(&mut self) -> Result<Vec<Range<usize>>, Fault> {
        let at = self.cursor.at();
        let broken = |fault| Fault::Broken {
            what: "the root",
            at,
            fault,
        };
        let (tile_count, child_count) = self.root_counts()?;
        self.budget.grow::<[i32; 3]>("the root", tile_count)?;
        let mut origins = Vec::new();
        for _ in 0..tile_count {
            origins.push(self.root_tile()?);
        }
        let mut spans = Vec::new();
        for _ in 0..child_count {
            let origin = self.root_origin()?;
            let first = self.leaves.len();
            self.upper(origin)?;
            origins.push(origin);
            spans.push((origin, first..self.leaves.len()));
        }
        origins.sort_unstable();
        if origins.windows(2).any(|pair| pair.first() == pair.last()) {
            return Err(broken("two of its children lie in one place"));
        }
        // Whatever the order of the shapes is, values follow by place.
        spans.sort_unstable_by_key(|&(origin, _)| origin);
        Ok(spans.into_iter().map(|(_, leaves)| leaves).collect())
    }

    /// How many tiles and children the root has, no more than the file can hold.
    fn root_counts(&mut self) -> Result<(usize, usize), Fault> {
        let at = self.cursor.at();
        let tile_count = self.cursor.u32("the root")? as usize;
        let child_count = self.cursor.u32("the root")? as usize;
        let tile_bytes = self.codec.single_bytes::<V>().saturating_add(13);
        let tiles_bytes = tile_count.saturating_mul(tile_bytes);
        let children_bytes = child_count.saturating_mul(LEAST_CHILD_BYTES);
        if tiles_bytes.saturating_add(children_bytes) > self.cursor.left() {
            return Err(Fault::Broken {
                what: "the root",
                at,
                fault: "it has more children than the file can hold",
            });
        }
        Ok((tile_count, child_count))
    }

    fn root_tile(&mut self) -> Result<[i32; 3], Fault> {
        let tile: Tile<V> = Tile {
            origin: self.root_origin()?,
            value: self.codec.single(self.cursor)?,
            is_active: self.cursor.flag("a tile of the root")?,
            side: ROOT_SIDE,
        };
        if tile.is_active || !tile.value.is_same(&self.background) {
            self.budget.grow::<Tile<V>>("tiles", 1)?;
            self.tiles.push(tile);
        }
        Ok(tile.origin)
    }

    fn root_origin(&mut self) -> Result<[i32; 3], Fault> {
        const WHAT: &str = "a child of the root";
        let at = self.cursor.at();
        let origin = self.cursor.corner(WHAT)?;
        if origin
            .iter()
            .any(|part| part.rem_euclid(ROOT_SIDE.into()) != 0)
        {
            return Err(Fault::Broken {
                what: WHAT,
                at,
                fault: "its corner is no multiple of 4096",
            });
        }
        Ok(origin)
    }

    fn upper(&mut self, origin: [i32; 3]) -> Result<(), Fault> {
        let children = self.node(origin, UPPER)?;
        for place in children.places() {
            self.lower(UPPER.corner(origin, place))?;
        }
        Ok(())
    }

    fn lower(&mut self, origin: [i32; 3]) -> Result<(), Fault> {
        let children = self.node(origin, LOWER)?;
        self.budget
            .grow::<LeafHead>("leaves", children.count_on())?;
        for place in children.places() {
            let active = self.cursor.array::<LEAF_MASK_BYTES>("a leaf")?;
            self.leaves.push(LeafHead {
                origin: LOWER.corner(origin, place),
                first_value: 0,
                active,
            });
        }
        Ok(())
    }

    /// Reads masks and tiles of a node; the places of its children.
    fn node(&mut self, origin: [i32; 3], level: Level) -> Result<Mask<'a>, Fault> {
        const WHAT: &str = "a node's masks";

        // Read which places hold children, and which are active.
        let children = Mask(self.cursor.take(level.mask_bytes(), WHAT)?);
        let active = Mask(self.cursor.take(level.mask_bytes(), WHAT)?);
        let background = self.background;
        let tile = |(place, &value): (usize, &V)| Tile {
            origin: level.corner(origin, place),
            side: level.place_side,
            value,
            is_active: active.is_on(place),
        };

        // Keep tiles that are active, or differ from the background.
        let others = self.node_values(children, active)?;
        let values = &self.unpacked.values;
        match others {
            Others::Active => {
                let places = active.places().filter(|&place| !children.is_on(place));
                let tiles = places.filter_map(|place| Some((place, values.get(place)?)));
                keep(&mut self.tiles, self.budget, tiles.map(tile))
            }
            Others::Anywhere => {
                let tiles = values.iter().enumerate().filter(|&(place, value)| {
                    !children.is_on(place) && (active.is_on(place) || !value.is_same(&background))
                });
                keep(&mut self.tiles, self.budget, tiles.map(tile))
            }
        }?;
        Ok(children)
    }

    /// Unpacks a value for every place of a node.
    fn node_values(&mut self, children: Mask, active: Mask) -> Result<Others, Fault> {
        let Self {
            cursor,
            codec,
            unpacked,
            background,
            ..
        } = self;
        if codec.version >= MASKS_VERSION {
            return codec.node(active, *background, cursor, unpacked);
        }
        // Values of children were not stored at all.
        let count = children.len().saturating_sub(children.count_on());
        codec.all(count, cursor, unpacked)?;
        let Unpacked { stored, values, .. } = unpacked;
        let mut stored = stored.iter().copied();
        values.clear();
        values.extend((0..children.len()).map(|place| {
            let is_tile = !children.is_on(place);
            let stored = is_tile.then(|| stored.next()).flatten();
            stored.unwrap_or(*background)
        }));
        Ok(Others::Anywhere)
    }

    /// Reads the values of all leaves, which lie in `order`.
    fn values(&mut self, order: Vec<Range<usize>>) -> Result<Vec<V>, Fault> {
        let count = self.leaves.len().saturating_mul(LEAF_VOXELS);
        let mut values = self.budget.list("values", count)?;
        for span in order {
            for at in span {
                let Some(leaf) = self.leaves.get_mut(at) else {
                    continue;
                };
                leaf.first_value = values.len();
                let active = leaf.active;
                self.leaf(&active)?;
                values.extend_from_slice(&self.unpacked.values);
            }
        }
        Ok(values)
    }

    /// Unpacks the values of the next leaf.
    fn leaf(&mut self, active: &[u8; LEAF_MASK_BYTES]) -> Result<(), Fault> {
        const WHAT: &str = "a leaf's values";

        // Check the mask against that of the leaf's topology.
        let at = self.cursor.at();
        if self.cursor.array::<LEAF_MASK_BYTES>(WHAT)? != *active {
            return Err(Fault::Broken {
                what: WHAT,
                at,
                fault: "its two masks differ",
            });
        }
        if self.codec.kind == ValueType::Bool {
            return self.bool_leaf();
        }

        // Unpack its values, and skip the buffers that old files add.
        let extra_buffers = match self.codec.version < MASKS_VERSION {
            true => self.extra_buffers()?,
            false => 0,
        };
        let Self {
            cursor,
            codec,
            unpacked,
            background,
            ..
        } = self;
        codec.node(Mask(active), *background, cursor, unpacked)?;
        for _ in 0..extra_buffers {
            codec.all(LEAF_VOXELS, cursor, unpacked)?;
        }
        Ok(())
    }

    /// Skips a leaf's corner, which the tree gives; how many buffers besides the first follow, which nothing uses.
    fn extra_buffers(&mut self) -> Result<u8, Fault> {
        const WHAT: &str = "a leaf's buffers";
        self.cursor.corner(WHAT)?;
        let at = self.cursor.at();
        match self.cursor.byte(WHAT)? {
            count @ 1..=127 => Ok(count.saturating_sub(1)),
            _ => Err(Fault::Broken {
                what: WHAT,
                at,
                fault: "there is not even one",
            }),
        }
    }

    /// Leaves of flags hold a corner and a bit for every voxel, never packed.
    fn bool_leaf(&mut self) -> Result<(), Fault> {
        const WHAT: &str = "a leaf's values";
        self.cursor.corner(WHAT)?;
        let bits = Mask(self.cursor.take(LEAF_MASK_BYTES, WHAT)?);
        let values = (0..LEAF_VOXELS).map(|place| f32::from(u8::from(bits.is_on(place))));
        self.unpacked.values.clear();
        self.unpacked
            .values
            .extend(values.map(|value| V::ZERO.map(|_| value)));
        Ok(())
    }
}

/// Appends `new` tiles, planned first.
fn keep<V>(
    tiles: &mut Vec<Tile<V>>,
    budget: &mut Budget,
    new: impl Iterator<Item = Tile<V>> + Clone,
) -> Result<(), Fault> {
    budget.grow::<Tile<V>>("tiles", new.clone().count())?;
    tiles.extend(new);
    Ok(())
}

impl Level {
    fn mask_bytes(self) -> usize {
        1usize
            .wrapping_shl(self.side_log2.saturating_mul(3))
            .wrapping_shr(3)
    }

    /// The corner of a place of the node at `origin`; x is the slowest of its coordinates.
    fn corner(self, origin: [i32; 3], place: usize) -> [i32; 3] {
        let side = self.side_log2;
        let last = 1usize.wrapping_shl(side).wrapping_sub(1);
        let steps = [
            place.wrapping_shr(side.saturating_mul(2)),
            place.wrapping_shr(side) & last,
            place & last,
        ];
        let mut corner = origin;
        for (part, step) in corner.iter_mut().zip(steps) {
            // Children of the root end on or before the last index there is.
            *part = part.wrapping_add((step as i32).wrapping_mul(self.place_side.into()));
        }
        corner
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_their_node_z_first() {
        assert_eq!(LOWER.corner([128, 0, -128], 0), [128, 0, -128]);
        assert_eq!(LOWER.corner([0; 3], 1), [0, 0, 8]);
        assert_eq!(LOWER.corner([0; 3], 16), [0, 8, 0]);
        assert_eq!(LOWER.corner([0; 3], 256), [8, 0, 0]);
        assert_eq!(UPPER.corner([-4096; 3], 32767), [-128; 3]);
        let last = i32::MAX - 4095;
        assert_eq!(UPPER.corner([last; 3], 32767), [i32::MAX - 127; 3]);
        assert_eq!((UPPER.mask_bytes(), LOWER.mask_bytes()), (4096, 512));
    }
}
