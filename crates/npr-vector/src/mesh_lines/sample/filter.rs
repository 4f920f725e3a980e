//! From shares of samples to runs of lines, all samples at once: the twins of `vector.weigh_samples` and
//! `vector.filter_visibility`.
//!
//! A line that is visible becomes hidden only where the mean share is clearly low, and the reverse, so that noise
//! about one half makes no dashes. What a sample shows is therefore what the last sample before it showed at which
//! this was clear: a sum over clear samples and a list of them tell which that is, however far back.

use super::SpineSample;
use crate::rank::scan::{compact, exclusive_scan};
use rayon::prelude::*;

/// Mean shares at and above which a line is clearly visible, and below which it is clearly hidden.
pub const CLEAR_SHARES: [f32; 2] = [0.6, 0.4];

/// Mean share at and above which a line that starts with it is visible.
pub const EVEN_SHARE: f32 = 0.5;

/// Decides by the mean share of every sample and its neighbours whether it is visible, and whether that is clear.
///
/// Line `k` holds the samples from `line_starts[k]` to `line_starts[k + 1]`; the mean goes over `radius` samples to
/// both sides on the sample's own line. The first sample of a line counts as clear. O(samples · radius), parallel.
///
/// # Panics
///
/// When a sample names a line that does not hold it: [`place_samples`](super::place_samples) makes none of those.
pub fn weigh_samples(
    radius: u32,
    samples: &[SpineSample],
    line_starts: &[u32],
    shares: &[f32],
    verdicts: &mut [u32],
    clear: &mut [u32],
) {
    let outputs = verdicts.par_iter_mut().zip(clear).enumerate();
    outputs
        .with_min_len(1024)
        .for_each(|(element, (verdict, clear))| {
            let element = element as u32;

            // Keep the window within the line.
            let line = samples[element as usize].line as usize;
            let (start, end) = (line_starts[line], line_starts[line + 1]);
            let from = element - radius.min(element - start);
            let to = element + radius.min(end - 1 - element);

            // Let most of the window decide.
            let mut sum = 0.0;
            for near in from..=to {
                sum += shares[near as usize];
            }

            // Note where it is clear, and where each line starts.
            let count = (to - from + 1) as f32;
            let is_clear = sum >= CLEAR_SHARES[0] * count || sum < CLEAR_SHARES[1] * count;
            *verdict = u32::from(sum >= EVEN_SHARE * count);
            *clear = u32::from(is_clear || element == start);
        });
}

/// Whether every sample is visible, 1 or 0: the verdict of the last clear sample up to it.
///
/// `clear_list` holds the clear samples in order, and `slots` the number of them before every sample. O(samples),
/// parallel.
pub fn filter_visibility(
    verdicts: &[u32],
    clear: &[u32],
    slots: &[u32],
    clear_list: &[u32],
    visible: &mut [u32],
) {
    let samples = visible.par_iter_mut().zip(clear.par_iter().zip(slots));
    samples
        .with_min_len(1024)
        .for_each(|(visible, (clear, slot))| {
            let last = clear_list[(slot + clear - 1) as usize];
            *visible = verdicts[last as usize];
        });
}

/// Visibility of samples, 1 or 0 each, by their shares: [`weigh_samples`] and [`filter_visibility`] with the steps
/// between them.
///
/// ```
/// use npr_vector::mesh_lines::sample::{SpineSample, visible_samples};
///
/// let samples = [SpineSample::default(); 5];
/// let seen = visible_samples(0, &samples, &[0, 5], &[1.0, 0.5, 0.0, 0.5, 1.0]);
/// assert_eq!(seen, [1, 1, 0, 0, 1]);
/// ```
pub fn visible_samples(
    radius: u32,
    samples: &[SpineSample],
    line_starts: &[u32],
    shares: &[f32],
) -> Vec<u32> {
    // Weigh each sample with its neighbours.
    let made = || vec![0; samples.len()];
    let (mut verdicts, mut clear, mut clear_list, mut visible) = (made(), made(), made(), made());
    weigh_samples(
        radius,
        samples,
        line_starts,
        shares,
        &mut verdicts,
        &mut clear,
    );

    // Let unclear ones take the verdict of the last clear one.
    let (slots, _) = exclusive_scan(&clear);
    compact(&clear, &slots, &mut clear_list);
    filter_visibility(&verdicts, &clear, &slots, &clear_list, &mut visible);
    visible
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Walks along one line and remembers what it last showed.
    fn walk(shares: &[f32], radius: usize) -> Vec<u32> {
        let mut visible = None;
        let seen = (0..shares.len()).map(|i| {
            let near = &shares[i.saturating_sub(radius)..(i + radius + 1).min(shares.len())];
            let (sum, count) = (near.iter().sum::<f32>(), near.len() as f32);
            let now = match visible {
                None => sum >= 0.5 * count,
                Some(true) => sum >= 0.4 * count,
                Some(false) => sum >= 0.6 * count,
            };
            visible = Some(now);
            u32::from(now)
        });
        seen.collect()
    }

    /// Samples of lines with these numbers of samples, and where lines start.
    fn lines(lengths: &[usize]) -> (Vec<SpineSample>, Vec<u32>) {
        let (mut samples, mut starts) = (Vec::new(), vec![0]);
        for (line, length) in (0..).zip(lengths) {
            let sample = SpineSample {
                line,
                ..SpineSample::default()
            };
            samples.extend(vec![sample; *length]);
            starts.push(samples.len() as u32);
        }
        (samples, starts)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn every_line_is_filtered_as_by_a_walk_along_it(
            lengths in proptest::collection::vec(0usize..200, 0..6), radius in 0u32..6,
            quarters in proptest::collection::vec(0u8..5, 1200), mild: bool,
        ) {
            let (samples, starts) = lines(&lengths);
            // Mild shares lie about one half, where memory decides.
            let share = |q: &u8| f32::from(*q) * if mild { 0.03 } else { 0.25 } + if mild { 0.42 } else { 0.0 };
            let shares: Vec<f32> = quarters.iter().take(samples.len()).map(share).collect();
            let seen = visible_samples(radius, &samples, &starts, &shares);
            let walked: Vec<u32> = starts
                .windows(2)
                .flat_map(|line| walk(&shares[line[0] as usize..line[1] as usize], radius as usize))
                .collect();
            prop_assert_eq!(seen, walked);
        }
    }

    #[test]
    fn any_radius_and_any_share_will_do() {
        let (samples, starts) = lines(&[1, 0, 3]);
        let shares = [f32::NAN, 1.0, f32::INFINITY, 1.0];
        let seen = visible_samples(u32::MAX, &samples, &starts, &shares);
        assert_eq!(seen, [0, 1, 1, 1]);
        assert!(visible_samples(3, &[], &[0], &[]).is_empty());
    }
}
