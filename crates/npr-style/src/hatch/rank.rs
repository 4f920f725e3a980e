//! From heights to ranks, so that a threshold inks the area that it names.

/// Steps that heights are sorted into: so many that each byte of rank is reached.
const BINS: usize = 1 << 14;

/// Replaces every height by the share of heights below it, 0..1; equal heights share the middle of theirs.
///
/// Heights that are not finite count as the highest. O(n + bins); heights closer than a 16384th of
/// their range may share a rank.
pub fn rank(heights: &mut [f32]) {
    let finite = heights.iter().copied().filter(|h| h.is_finite());
    let (low, high) = finite.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    // Halves keep the range of extreme heights finite.
    let scale = (BINS - 1) as f32 / (high * 0.5 - low * 0.5).max(f32::MIN_POSITIVE);
    let bin = |height: f32| {
        let place = (height * 0.5 - low * 0.5) * scale;
        if height.is_finite() {
            (place as usize).min(BINS - 1)
        } else {
            BINS - 1
        }
    };
    let mut counts = vec![0u32; BINS];
    for &height in heights.iter() {
        counts[bin(height)] += 1;
    }
    let ranks = middles(&counts, heights.len());
    for height in heights.iter_mut() {
        *height = ranks[bin(*height)];
    }
}

/// The middle of every bin's stretch of the sorted list, as a share of the list.
fn middles(counts: &[u32], total: usize) -> Vec<f32> {
    let mut below = 0u64;
    counts
        .iter()
        .map(|&count| {
            let middle = below as f64 + f64::from(count) * 0.5;
            below += u64::from(count);
            (middle / total.max(1) as f64) as f32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Counts, for every height, those below and half of those equal.
    fn oracle(heights: &[i16]) -> Vec<f32> {
        let share = |h: &i16| {
            let below = heights.iter().filter(|other| *other < h).count() as f32;
            let equal = heights.iter().filter(|other| *other == h).count() as f32;
            (below + equal * 0.5) / heights.len() as f32
        };
        heights.iter().map(share).collect()
    }

    #[test]
    fn odd_heights_do_no_harm() {
        rank(&mut []);
        let mut one = [7.0];
        rank(&mut one);
        assert_eq!(one, [0.5]);
        let mut odd = [f32::NAN, f32::MIN, f32::MAX, f32::INFINITY, 0.0];
        rank(&mut odd);
        assert!(odd.iter().all(|r| (0.0..=1.0).contains(r)), "{odd:?}");
        assert!(odd[1] < odd[4] && odd[4] < odd[0]);
        let mut none = [f32::NAN; 3];
        rank(&mut none);
        assert!(none.iter().all(|r| (0.0..=1.0).contains(r)), "{none:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn ranks_count_what_lies_below(heights in proptest::collection::vec(0i16..4000, 1..60)) {
            let mut ranked: Vec<f32> = heights.iter().map(|&h| f32::from(h)).collect();
            rank(&mut ranked);
            for (got, want) in ranked.iter().zip(oracle(&heights)) {
                prop_assert!((got - want).abs() < 1e-5, "{got} is not {want}");
            }
        }
    }
}
