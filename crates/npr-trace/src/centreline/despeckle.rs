//! Specks taken out of a bitmap before its lines are found.

use crate::{Bitmap, PixelLoop, TurnPolicy, decompose};

/// The bitmap without specks: shapes of up to `turd_size` pixels, what is in them included, turn white, and holes of
/// up to as many ink.
///
/// A pinhole in a line would become a loop of two lines. Ink hangs together by sides and corners, white by sides, as
/// [`thin`](super::thin()) has it. O(pixels / 64 + length of outlines).
pub fn despeckle(bitmap: &Bitmap, turd_size: u64) -> Bitmap {
    let mut clean = bitmap.clone();
    if turd_size == 0 {
        return clean;
    }
    let loops = decompose(bitmap, TurnPolicy::Black, 0);
    let mut specks: Vec<PixelLoop<'_>> = loops.iter().filter(|l| l.area <= turd_size).collect();
    // What lies inside a speck is smaller and goes first.
    specks.sort_by_key(|speck| speck.area);
    for speck in specks {
        paint(&speck, &mut clean);
    }
    clean
}

/// Paints a loop's inside in the colour around it.
fn paint(speck: &PixelLoop<'_>, bitmap: &mut Bitmap) {
    let mut uprights: Vec<[i32; 2]> = speck
        .corners()
        .zip(speck.steps)
        .filter_map(|([x, y], direction)| match direction {
            1 => Some([y - 1, x]),
            3 => Some([y, x]),
            _ => None,
        })
        .collect();
    uprights.sort_unstable();
    for pair in uprights.as_chunks::<2>().0 {
        let [[y, from], [_, to]] = *pair;
        for x in from..to {
            bitmap.set(x as u32, y as u32, !speck.is_ink);
        }
    }
}
