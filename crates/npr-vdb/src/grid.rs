//! Voxels, most of them not stored.

use crate::bounds::Bounds;
use crate::fault::Fault;
use crate::info::GridInfo;
use crate::limits::Budget;
use crate::transform::Transform;
use crate::voxel::Voxel;

/// Voxels along a side of a leaf.
pub(crate) const LEAF_SIDE: u16 = 8;

/// Voxels of a leaf.
pub(crate) const LEAF_VOXELS: usize = 512;

/// A grid: a value for every index, of which only few are stored.
///
/// Indices are those of the file, negative ones too; voxels that are not stored hold the background.
#[derive(Debug, Clone)]
pub struct Grid<V> {
    pub(crate) info: GridInfo,
    pub(crate) transform: Transform,
    pub(crate) tree: Tree<V>,
    /// What is left for dense copies.
    pub(crate) budget: Budget,
}

/// What is stored of a grid.
#[derive(Debug, Clone)]
pub(crate) struct Tree<V> {
    pub(crate) background: V,
    /// By origin. No two tiles or leaves share a voxel.
    pub(crate) tiles: Vec<Tile<V>>,
    /// By origin.
    pub(crate) leaves: Vec<LeafHead>,
    /// `LEAF_VOXELS` for every leaf.
    pub(crate) values: Vec<V>,
}

/// A leaf without its values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LeafHead {
    pub(crate) origin: [i32; 3],
    /// Where its values begin.
    pub(crate) first_value: usize,
    pub(crate) active: [u8; LEAF_VOXELS / 8],
}

/// A cube of voxels that all hold one value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tile<V> {
    /// Index of its lowest corner.
    pub origin: [i32; 3],
    /// Voxels along a side: 8, 128 or 4096.
    pub side: u16,
    /// What all its voxels hold.
    pub value: V,
    /// Whether they are active. Inactive tiles are listed only where they hold other than the background.
    pub is_active: bool,
}

/// A cube of 8 x 8 x 8 voxels.
#[derive(Debug, Clone, Copy)]
pub struct Leaf<'a, V> {
    /// Index of its lowest corner.
    pub origin: [i32; 3],
    /// Its 512 values; z runs fastest, then y.
    pub values: &'a [V],
    /// A bit for each value, lowest first, that says whether it is active.
    pub active: &'a [u8; LEAF_VOXELS / 8],
}

impl<V: Voxel> Grid<V> {
    /// What the file says of the grid.
    pub fn info(&self) -> &GridInfo {
        &self.info
    }

    /// From indices of voxels to places in the world.
    pub fn index_to_world(&self) -> &Transform {
        &self.transform
    }

    /// The value of every voxel that is not stored.
    pub fn background(&self) -> V {
        self.tree.background
    }

    /// The tiles that are active or hold other than the background, by origin.
    pub fn tiles(&self) -> &[Tile<V>] {
        &self.tree.tiles
    }

    /// The leaves, by origin.
    pub fn leaves(&self) -> impl ExactSizeIterator<Item = Leaf<'_, V>> {
        self.tree.leaves.iter().map(|head| self.tree.leaf(head))
    }

    /// The value at `index`, active or not. O(log n) in tiles and leaves.
    pub fn value(&self, index: [i32; 3]) -> V {
        self.tree.find(index).0
    }

    /// Whether the voxel at `index` is active. O(log n) in tiles and leaves.
    pub fn is_active(&self, index: [i32; 3]) -> bool {
        self.tree.find(index).1
    }

    /// The smallest box that holds all active voxels, those of tiles too; nothing where none is active.
    pub fn active_bounds(&self) -> Option<Bounds> {
        let tiles = self.tiles().iter().filter_map(Tile::active_bounds);
        let leaves = self.tree.leaves.iter().filter_map(LeafHead::active_bounds);
        tiles.chain(leaves).reduce(Bounds::union)
    }

    /// How many voxels are active, those of tiles too.
    pub fn active_voxel_count(&self) -> u64 {
        let tiles = self.tiles().iter().filter(|tile| tile.is_active);
        let tiles = tiles.map(|tile| u64::from(tile.side).pow(3));
        let leaves = self.tree.leaves.iter().map(LeafHead::active_count);
        tiles.chain(leaves).fold(0, u64::saturating_add)
    }

    /// All values of the box of `size` voxels with its lowest corner at `low`, tiles expanded.
    ///
    /// z runs fastest, then y: voxel `low + [x, y, z]` is at `(x * size[1] + y) * size[2] + z`, as in an array
    /// `[x][y][z]`. O(voxels).
    ///
    /// # Errors
    ///
    /// [`Fault::Memory`] where the box does not fit the limits under which the file was read, less what the grid
    /// itself takes.
    pub fn dense(&self, low: [i32; 3], size: [usize; 3]) -> Result<Vec<V>, Fault> {
        let count = size.into_iter().try_fold(1, usize::checked_mul);
        let count = if size.contains(&0) { Some(0) } else { count };
        let mut budget = self.budget;
        let mut voxels = budget.list("a dense grid", count.unwrap_or(usize::MAX))?;
        voxels.resize(count.unwrap_or_default(), self.tree.background);
        for tile in self.tiles() {
            let overlap = Overlap::of(tile.origin, tile.side, low, size);
            overlap.rows(|row, _| voxels[row].fill(tile.value));
        }
        for leaf in self.leaves() {
            let overlap = Overlap::of(leaf.origin, LEAF_SIDE, low, size);
            overlap.rows(|row, stored| voxels[row].copy_from_slice(&leaf.values[stored]));
        }
        Ok(voxels)
    }
}

#[cfg(any(test, feature = "testing"))]
impl<V: Voxel> Grid<V> {
    /// Panics unless tiles and leaves are sorted, lie on multiples of their sides, share no voxel, and have their
    /// values.
    ///
    /// # Panics
    ///
    /// On a bug of the reader.
    pub fn sanity_check(&self) {
        // Check that cubes lie on multiples of their sides and share no voxel.
        let tiles = self.tiles().iter().map(|tile| (tile.origin, tile.side));
        let leaves = self.leaves().map(|leaf| (leaf.origin, LEAF_SIDE));
        let mut cubes: Vec<_> = tiles.chain(leaves).collect();
        cubes.sort_unstable();
        for side in [LEAF_SIDE, 128, 4096] {
            let corner = |origin: [i32; 3]| origin.map(|part| part & -i32::from(side));
            let of_side = cubes.iter().filter(|cube| cube.1 == side);
            assert!(
                of_side.clone().all(|cube| corner(cube.0) == cube.0),
                "a cube lies between places"
            );
            let taken: std::collections::BTreeSet<_> = of_side.clone().map(|cube| cube.0).collect();
            assert_eq!(taken.len(), of_side.count(), "two cubes lie in one place");
            let smaller = cubes.iter().filter(|cube| cube.1 < side);
            assert!(
                smaller
                    .into_iter()
                    .all(|cube| !taken.contains(&corner(cube.0))),
                "a cube lies in another"
            );
        }

        // Check that all are sorted and have their values.
        assert!(self.tiles().is_sorted_by_key(|tile| tile.origin));
        assert!(self.tree.leaves.is_sorted_by_key(|leaf| leaf.origin));
        assert_eq!(self.tree.values.len(), self.tree.leaves.len() * LEAF_VOXELS);
        assert!(self.leaves().all(|leaf| leaf.values.len() == LEAF_VOXELS));
    }
}

impl<V: Voxel> Tree<V> {
    fn leaf<'a>(&'a self, head: &'a LeafHead) -> Leaf<'a, V> {
        Leaf {
            origin: head.origin,
            values: &self.values[head.first_value..][..LEAF_VOXELS],
            active: &head.active,
        }
    }

    /// Value at `index` and whether it is active.
    fn find(&self, index: [i32; 3]) -> (V, bool) {
        // Look for the leaf that the voxel lies in.
        let corner = |side: u16| index.map(|part| part & -i32::from(side));
        let leaf = self
            .leaves
            .binary_search_by_key(&corner(LEAF_SIDE), |leaf| leaf.origin);
        if let Ok(leaf) = leaf {
            let place = index
                .iter()
                .fold(0, |place, part| place << 3 | (part & 7) as usize);
            let head = &self.leaves[leaf];
            let is_active = head.active[place >> 3] >> (place & 7) & 1 == 1;
            return (self.values[head.first_value + place], is_active);
        }

        // Look for a tile around it, the smallest first.
        for side in [LEAF_SIDE, 128, 4096] {
            let tile = self
                .tiles
                .binary_search_by_key(&corner(side), |tile| tile.origin);
            if let Some(tile) = tile.ok().map(|tile| &self.tiles[tile])
                && tile.side >= side
            {
                return (tile.value, tile.is_active);
            }
        }
        (self.background, false)
    }
}

impl<V> Tile<V> {
    fn active_bounds(&self) -> Option<Bounds> {
        let last = i32::from(self.side) - 1;
        self.is_active.then(|| Bounds {
            low: self.origin,
            high: self.origin.map(|part| part + last),
        })
    }
}

impl LeafHead {
    fn active_count(&self) -> u64 {
        self.active
            .iter()
            .map(|byte| u64::from(byte.count_ones()))
            .sum()
    }

    /// A byte of the mask is a row along z, eight bytes a slab of one x.
    fn active_bounds(&self) -> Option<Bounds> {
        let (mut xs, mut ys, mut zs) = (0u8, 0u8, 0u8);
        for (row, &byte) in self
            .active
            .iter()
            .enumerate()
            .filter(|(_, byte)| **byte != 0)
        {
            xs |= 1 << (row >> 3);
            ys |= 1 << (row & 7);
            zs |= byte;
        }
        let bits = [xs, ys, zs];
        let end = |axis: usize, offset: u32| self.origin[axis] + offset as i32;
        (zs != 0).then(|| Bounds {
            low: std::array::from_fn(|axis| end(axis, bits[axis].trailing_zeros())),
            high: std::array::from_fn(|axis| end(axis, 7 - bits[axis].leading_zeros())),
        })
    }
}

/// Where a cube of voxels and a dense box overlap.
struct Overlap {
    /// The first voxel inside the box.
    start: [usize; 3],
    /// The same voxel inside the cube.
    offset: [usize; 3],
    /// Voxels along each side.
    count: [usize; 3],
    /// Size of the box.
    size: [usize; 3],
    /// Side of the cube.
    side: usize,
}

impl Overlap {
    fn of(origin: [i32; 3], side: u16, low: [i32; 3], size: [usize; 3]) -> Self {
        // No index lies further than this from `low`, so cutting longer sides off changes nothing.
        let side_of = |axis: usize| size[axis].min(1 << 33) as i64;
        let begin = |axis: usize| i64::from(origin[axis]) - i64::from(low[axis]);
        let start = |axis: usize| begin(axis).clamp(0, side_of(axis));
        let end = |axis: usize| (begin(axis) + i64::from(side)).clamp(0, side_of(axis));
        Self {
            start: std::array::from_fn(|axis| start(axis) as usize),
            offset: std::array::from_fn(|axis| (start(axis) - begin(axis)).max(0) as usize),
            count: std::array::from_fn(|axis| (end(axis) - start(axis)).max(0) as usize),
            size,
            side: side.into(),
        }
    }

    /// Hands over every row along z: its places in the box and in the cube.
    fn rows(&self, mut visit: impl FnMut(std::ops::Range<usize>, std::ops::Range<usize>)) {
        if self.count.contains(&0) {
            return;
        }
        for x in 0..self.count[0] {
            for y in 0..self.count[1] {
                let row = (self.start[0] + x) * self.size[1] + self.start[1] + y;
                let row = row * self.size[2] + self.start[2];
                let stored = (self.offset[0] + x) * self.side + self.offset[1] + y;
                let stored = stored * self.side + self.offset[2];
                visit(row..row + self.count[2], stored..stored + self.count[2]);
            }
        }
    }
}
