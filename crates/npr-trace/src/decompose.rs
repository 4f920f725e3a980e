//! Bitmaps to closed paths along pixel edges [Selinger 2003, 2.1].

use super::bitmap::Bitmap;
use super::edges::EdgeMap;
use super::huge_buffer::HugeBuffer;
use super::turn::{TurnPolicy, pixels_around};

/// Steps after which a batch of loops is handed on: the last ones shall end at about the same time on all threads.
const BATCH_STEPS: usize = 1 << 11;

/// Directions of steps: right, up, left, down. Each is a left turn from the one before.
pub const STEPS: [[i32; 2]; 4] = [[1, 0], [0, -1], [-1, 0], [0, 1]];

/// Closed paths along pixel edges, in the order of their first corners.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Loops {
    heads: Vec<LoopHead>,
    /// The steps of all loops, one after the other.
    steps: Vec<u8>,
}

/// What is known of a loop besides its steps: 12 bytes, for there may be millions.
///
/// Sides are up to [`SIDE_LIMIT`](super::SIDE_LIMIT), so places of pixels have 15 bits, and areas and all steps
/// together less than 32.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LoopHead {
    /// The start: 15 bits of x, as many of y, and on top whether its inside is ink.
    place: u32,
    area: u32,
    /// Where its steps end among those of all.
    end: u32,
}

impl LoopHead {
    fn new([x, y]: [u32; 2], is_ink: bool, area: u64, end: usize) -> Self {
        Self {
            place: x | y << 15 | u32::from(is_ink) << 30,
            area: area as u32,
            end: end as u32,
        }
    }

    fn start(self) -> [u32; 2] {
        [self.place & 0x7fff, self.place >> 15 & 0x7fff]
    }

    fn is_ink(self) -> bool {
        self.place >> 30 & 1 == 1
    }
}

/// A closed path along pixel edges, its inside on the left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelLoop<'a> {
    /// The uppermost of its corners, and of those the leftmost. The first step leads down from it.
    pub start: [u32; 2],
    /// Whether its inside is ink: the outline of a shape, not of a hole.
    pub is_ink: bool,
    /// Pixels inside, those of holes and of shapes within them included.
    pub area: u64,
    /// Directions of its steps of one pixel each, as indices into [`STEPS`].
    pub steps: &'a [u8],
}

impl PixelLoop<'_> {
    /// Its corners from the start on, one for every step. Pixels, y down.
    pub fn corners(&self) -> impl Iterator<Item = [i32; 2]> {
        let mut here = self.start.map(|v| v as i32);
        self.steps.iter().map(move |direction| {
            let corner = here;
            let step = STEPS[usize::from(direction & 3)];
            here = [here[0] + step[0], here[1] + step[1]];
            corner
        })
    }
}

impl Loops {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.heads.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.heads.is_empty()
    }

    /// The loop of a number.
    pub fn get(&self, index: usize) -> Option<PixelLoop<'_>> {
        let head = self.heads.get(index)?;
        let before = index.checked_sub(1).and_then(|i| self.heads.get(i));
        let start = before.map_or(0, |head| head.end) as usize;
        Some(PixelLoop {
            start: head.start(),
            is_ink: head.is_ink(),
            area: u64::from(head.area),
            steps: self.steps.get(start..head.end as usize)?,
        })
    }

    /// Steps of all loops.
    pub fn step_count(&self) -> usize {
        self.steps.len()
    }

    /// Gives spare memory back.
    pub(super) fn shrink(&mut self) {
        self.heads.shrink_to_fit();
        self.steps.shrink_to_fit();
    }

    /// Puts the loops of another list behind these.
    fn append(&mut self, other: &Self) {
        let offset = self.steps.len() as u32;
        self.steps.extend_from_slice(&other.steps);
        let moved = |head: &LoopHead| LoopHead {
            end: offset + head.end,
            ..*head
        };
        self.heads.extend(other.heads.iter().map(moved));
    }

    /// All loops in order.
    pub fn iter(&self) -> impl Iterator<Item = PixelLoop<'_>> + Clone {
        (0..self.len()).filter_map(|index| self.get(index))
    }
}

/// The closed paths of a bitmap whose area is more than `turd_size` pixels.
///
/// The method of the paper: the first ink pixel, rows from the top, starts a path around what hangs together with it;
/// the inside is inverted; and so on until all is white. Here no pixel is inverted: edges that a path took are taken
/// away, and of what is left the same paths follow, since a pixel is inverted where an odd number of paths lies
/// around it.
///
/// One thread, O(pixels / 64 + steps): which way a path turns hangs on the paths before it. The curves of
/// finished loops can be worked on meanwhile, see [`Decomposition`].
pub fn decompose(bitmap: &Bitmap, policy: TurnPolicy, turd_size: u64) -> Loops {
    let mut loops = Loops::default();
    for batch in Decomposition::new(bitmap, policy, turd_size) {
        loops.append(&batch);
    }
    loops
}

/// A decomposition under way: an iterator over batches of loops, each of some two thousand steps or one long loop.
#[derive(Debug)]
pub struct Decomposition<'a> {
    bitmap: &'a Bitmap,
    policy: TurnPolicy,
    turd_size: u64,
    map: EdgeMap,
    /// Where to look for the next loop.
    from: [u32; 2],
}

impl<'a> Decomposition<'a> {
    /// Begins to take a bitmap apart.
    pub fn new(bitmap: &'a Bitmap, policy: TurnPolicy, turd_size: u64) -> Self {
        Self {
            bitmap,
            policy,
            turd_size,
            map: EdgeMap::new(bitmap),
            from: [0; 2],
        }
    }

    /// The memory of its edges, which were all taken once there are no more loops: zero.
    pub(super) fn into_words(self) -> HugeBuffer {
        self.map.into_words()
    }

    /// Follows the loop that starts at a corner; its steps are added to `steps`. Gives the area inside.
    fn follow(&self, start: [u32; 2], is_ink: bool, steps: &mut Vec<u8>) -> u64 {
        let [mut x, mut y] = start;
        let mut direction = 3u8;
        let mut area = 0i64;
        loop {
            steps.push(direction);

            // Take a step, and sum up the area under it.
            match direction {
                0 => x += 1,
                1 => {
                    y -= 1;
                    area += i64::from(x);
                }
                2 => x -= 1,
                _ => {
                    y += 1;
                    area -= i64::from(x);
                }
            }

            // Stop where the path closes.
            if [x, y] == start {
                return area.unsigned_abs();
            }
            direction = self.turn([x, y], direction, is_ink);
        }
    }

    /// The direction in which a path leaves a corner that it came to in a direction.
    #[inline]
    fn turn(&self, [x, y]: [u32; 2], direction: u8, is_ink: bool) -> u8 {
        let (left, right) = ((direction + 1) & 3, (direction + 3) & 3);
        if !self.map.leads(x, y, left) {
            return if self.map.leads(x, y, direction) {
                direction
            } else {
                right
            };
        }
        if !self.map.leads(x, y, right) {
            return left;
        }
        // With all four edges there, what lies behind on the left is inside, and so is what lies ahead on the right.
        let upper_left = direction & 1 == 0;
        let around = || pixels_around(&self.map, [x, y], upper_left);
        if self.policy.joins_inside([x, y], is_ink, around) {
            right
        } else {
            left
        }
    }

    /// Takes the edges of a loop away.
    fn take(&mut self, start: [u32; 2], steps: &[u8]) {
        let [mut x, mut y] = start;
        for direction in steps {
            self.map.take(x, y, *direction);
            let step = STEPS[usize::from(direction & 3)];
            x = x.wrapping_add_signed(step[0]);
            y = y.wrapping_add_signed(step[1]);
        }
    }
}

impl Iterator for Decomposition<'_> {
    type Item = Loops;

    /// The next loops that are large enough; none where there are no more.
    fn next(&mut self) -> Option<Loops> {
        let mut batch = Loops {
            heads: Vec::new(),
            steps: Vec::with_capacity(2 * BATCH_STEPS),
        };
        while batch.steps.len() < BATCH_STEPS {
            // Find the next border that no path has gone along.
            let Some(start) = self.map.next_upright(self.from) else {
                break;
            };
            self.from = start;

            // Follow it around, and turn over the pixels inside.
            let is_ink = self.bitmap.is_ink(i64::from(start[0]), i64::from(start[1]));
            let before = batch.steps.len();
            let area = self.follow(start, is_ink, &mut batch.steps);
            self.take(start, batch.steps.get(before..).unwrap_or(&[]));

            // Leave out specks.
            if area <= self.turd_size {
                batch.steps.truncate(before);
                continue;
            }
            let end = batch.steps.len();
            batch.heads.push(LoopHead::new(start, is_ink, area, end));
        }
        (!batch.is_empty()).then_some(batch)
    }
}
