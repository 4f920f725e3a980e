//! Junctions and ends of drawings beside those of their skeletons.
//!
//! The rule of counting, for both: pixels of a thin line are neighbours by their sides, and by their corners where no
//! side leads there. A pixel with one neighbour is an end. Pixels with three or more make a junction, all that touch
//! one. Specks and pinholes of up to two pixels are taken out first.
//!
//! Which pixels a skeleton keeps is not settled: counted by the same rule, the ends and junctions of the bunny are 75
//! and 63 by Zhang and Suen's thinning (scikit-image), 72 and 58 by Lee's; those of the helicopter are 58 and 162, and
//! 59 and 161.

use super::*;
use std::path::Path;

/// A bitmap of the folder beside the checkout; none, said on standard error, where it is not there.
fn sample(name: &str) -> Option<Bitmap> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/assets/bitmaps");
    let Ok(file) = std::fs::File::open(folder.join(name)) else {
        eprintln!("skipped: there is no shared/assets/bitmaps/{name} beside the checkout");
        return None;
    };
    let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().expect("a picture");
    let mut data = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut data).expect("pixels");
    let samples = info.color_type.samples();
    let first: Vec<u8> = data.chunks(samples).map(|pixel| pixel[0]).collect();
    Some(Bitmap::from_luminance(info.width, info.height, &first, 0.5).expect("a bitmap"))
}

/// The eight pixels around one, in order.
const RING: [(i64, i64); 8] = [
    (1, 0),
    (1, -1),
    (0, -1),
    (-1, -1),
    (-1, 0),
    (-1, 1),
    (0, 1),
    (1, 1),
];

/// A bitmap by plain thinning, layer by layer [Rosenfeld 1975], with pixels looked at one by one.
struct Skeleton {
    ink: Bitmap,
}

impl Skeleton {
    /// Takes away all pixels that are white on a side, one side after the other, but for those that hold ink
    /// together, keep holes closed or are ends.
    fn of(bitmap: &Bitmap) -> Self {
        let mut thin = Self {
            ink: bitmap.clone(),
        };
        let mut is_changed = true;
        while is_changed {
            is_changed = false;
            for side in [2, 6, 4, 0] {
                let (dx, dy) = RING[side];
                let open = pixels(&thin.ink)
                    .filter(|(x, y)| thin.ink.is_ink(*x, *y) && !thin.ink.is_ink(x + dx, y + dy));
                let loose: Vec<_> = open.filter(|pixel| thin.is_loose(*pixel)).collect();
                is_changed |= !loose.is_empty();
                for (x, y) in loose {
                    thin.ink.set(x as u32, y as u32, false);
                }
            }
        }
        thin
    }

    /// Whether a pixel has two neighbours or more, which stay one piece without it.
    fn is_loose(&self, (x, y): (i64, i64)) -> bool {
        let ring = RING.map(|(dx, dy)| self.ink.is_ink(x + dx, y + dy));
        // White by sides: each white side begins a run of white unless the ink goes on around the corner after it.
        let runs = [0, 2, 4, 6]
            .into_iter()
            .filter(|k| !ring[*k] && (ring[k + 1] || ring[(k + 2) % 8]));
        runs.count() == 1 && ring.iter().filter(|ink| **ink).count() >= 2
    }

    fn neighbours(&self, (x, y): (i64, i64)) -> Vec<(i64, i64)> {
        let ink = |dx: i64, dy: i64| self.ink.is_ink(x + dx, y + dy);
        let is_near = |(dx, dy): &(i64, i64)| {
            let is_side = *dx == 0 || *dy == 0;
            ink(*dx, *dy) && (is_side || !ink(*dx, 0) && !ink(0, *dy))
        };
        let near = RING.into_iter().filter(is_near);
        near.map(|(dx, dy)| (x + dx, y + dy)).collect()
    }

    /// Ends and junctions.
    fn counts(&self) -> [usize; 2] {
        let inked = || pixels(&self.ink).filter(|(x, y)| self.ink.is_ink(*x, *y));
        let ends = inked().filter(|pixel| self.neighbours(*pixel).len() == 1);
        let is_fork = |pixel: &(i64, i64)| self.neighbours(*pixel).len() > 2;
        let mut forks: std::collections::BTreeSet<(i64, i64)> = inked().filter(is_fork).collect();
        let mut junctions = 0;
        while let Some(seed) = forks.pop_first() {
            junctions += 1;
            let mut left = vec![seed];
            while let Some(pixel) = left.pop() {
                let near = self.neighbours(pixel).into_iter();
                left.extend(near.filter(|other| forks.remove(other)));
            }
        }
        [ends.count(), junctions]
    }
}

#[test]
fn drawings_have_the_junctions_and_ends_of_their_skeletons() {
    for name in [
        "bunny_contour_1px_1024.png",
        "spiral_1px_1024.png",
        "helicopter_lines_1200x900.png",
    ] {
        let Some(bitmap) = sample(name) else { return };
        let options = CentrelineOptions::default();
        let of_skeleton = Skeleton::of(&despeckle(&bitmap, options.turd_size)).counts();
        let found = centrelines(&bitmap, &options);
        let counts = [found.end_count(), found.junctions.len()];
        eprintln!("{name}: ends and junctions {counts:?}, skeleton {of_skeleton:?}");
        for (count, expected) in counts.into_iter().zip(of_skeleton) {
            assert!(
                20 * count.abs_diff(expected) <= expected,
                "{name}: ends and junctions {counts:?}, of the skeleton {of_skeleton:?}"
            );
        }
    }
}

#[test]
fn a_skeleton_is_counted_as_a_reader_would() {
    // A cross, a fork beside it, and a loop.
    let bitmap = paint(60, 40, |x, y| {
        let cross = y == 10 && (3..20).contains(&x) || x == 10 && (3..20).contains(&y);
        let fork = x == 30 && (3..20).contains(&y) || y == 10 && (30..40).contains(&x);
        let ring = (45..55).contains(&x)
            && (5..15).contains(&y)
            && !((46..54).contains(&x) && (6..14).contains(&y));
        cross || fork || ring
    });
    assert_eq!(Skeleton::of(&bitmap).counts(), [7, 2]);
}
