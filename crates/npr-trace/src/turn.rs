//! Which way a path turns where two pixels of one colour meet at a corner only.

use super::edges::EdgeMap;
use npr_core::math::mix_bits;

/// How paths go on at corners where ink and white both meet at a point [Selinger 2003, 2.1.2].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum TurnPolicy {
    /// Ink hangs together.
    Black,
    /// White hangs together.
    White,
    /// Always to the left, seen along the path with its inside on the left.
    Left,
    /// Always to the right.
    Right,
    /// The colour that is rarer around the corner hangs together: keeps thin lines whole, black or white.
    #[default]
    Minority,
    /// The colour that prevails around the corner hangs together.
    Majority,
    /// By a hash of the place: the same for every run and any number of threads.
    Random,
}

impl TurnPolicy {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Black,
        Self::White,
        Self::Left,
        Self::Right,
        Self::Minority,
        Self::Majority,
        Self::Random,
    ];

    /// The name as users write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Black => "black",
            Self::White => "white",
            Self::Left => "left",
            Self::Right => "right",
            Self::Minority => "minority",
            Self::Majority => "majority",
            Self::Random => "random",
        }
    }

    /// What it means, in a few words for users.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Black => "Ink",
            Self::White => "White",
            Self::Left => "Paths turn left",
            Self::Right => "Paths turn right",
            Self::Minority => "The rarer colour nearby",
            Self::Majority => "The more frequent colour nearby",
            Self::Random => "By chance, the same in every run",
        }
    }

    /// Whether the inside of a path hangs together at an ambiguous corner, so that the path turns right.
    ///
    /// `is_ink` tells whether the inside of the path is ink in the bitmap. `around` gives the pixels around the
    /// corner as they are when the path is traced: with the insides of all paths before it inverted, and so ink
    /// inside.
    ///
    /// Not in the paper, and measured on the program Potrace with random bitmaps: the neighbourhood is the squares of
    /// 4, 6 and 8 pixels around the corner, of which the smallest without a tie decides; where all tie, the inside
    /// counts as rarer.
    #[inline]
    pub(super) fn joins_inside(
        self,
        corner: [u32; 2],
        is_ink: bool,
        around: impl FnOnce() -> u64,
    ) -> bool {
        match self {
            Self::Black => is_ink,
            Self::White => !is_ink,
            Self::Left => false,
            Self::Right => true,
            Self::Minority => !inside_prevails(around()),
            Self::Majority => inside_prevails(around()),
            Self::Random => {
                let joins_ink = mix_bits(corner[0] ^ mix_bits(corner[1])) & 1 == 1;
                joins_ink == is_ink
            }
        }
    }
}

/// Half the pixels of each square around a corner, and which those are: bit `8 row + column` of the 8x8 pixels around.
const SQUARES: [(u32, u64); 3] = [
    (8, 0x0000_3c3c_3c3c_0000),
    (18, 0x007e_7e7e_7e7e_7e00),
    (32, u64::MAX),
];

/// Whether more than half of the smallest square without a tie is 1.
fn inside_prevails(around: u64) -> bool {
    let counts = SQUARES.map(|(half, square)| ((around & square).count_ones(), half));
    let decides = counts.iter().find(|(count, half)| count != half);
    decides.is_some_and(|(count, half)| count > half)
}

/// The 8x8 pixels around a corner, by the edges not yet traced: two pixels differ where an edge between them is left.
///
/// `inside_is_upper_left` tells of the pixel to the upper left of the corner whether it is 1; so is the one to the
/// lower right, and the other two are the opposite.
pub(super) fn pixels_around(map: &EdgeMap, [x, y]: [u32; 2], inside_is_upper_left: bool) -> u64 {
    // One column to the left of the corner, from the row above it up and down.
    let start = u64::from(inside_is_upper_left);
    let mut column = [0; 8];
    column[3] = start;
    for row in (0..3).rev() {
        column[row] = column[row + 1] ^ map.is_level_around(x, y, -1, row as i32 - 3);
    }
    for row in 4..8 {
        column[row] = column[row - 1] ^ map.is_level_around(x, y, -1, row as i32 - 4);
    }
    let mut around = 0;
    for (row, known) in column.into_iter().enumerate() {
        // Bit `i` is the edge between the pixels of columns `i` and `i + 1`.
        let edges = map.upright_around(x, y, row as i32 - 4);
        // Bit `i` becomes the parity of the edges below bit `i`: how column `i` differs from column 0.
        let mut parity = edges << 1;
        parity ^= parity << 1;
        parity ^= parity << 2;
        parity ^= parity << 4;
        let flip = (parity >> 3 ^ known) & 1;
        let pixels = if flip == 1 { !parity } else { parity } & 0xff;
        around |= pixels << (8 * row);
    }
    around
}
