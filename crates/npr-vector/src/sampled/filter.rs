//! From verdicts on samples to parts of lines, all samples at once: the twins of `stroke.weigh_samples` and
//! `stroke.filter_visibility`.
//!
//! A line that is visible becomes hidden only where the mean share is clearly low, and the reverse, so that noise
//! about one half makes no dashes. What a sample shows is therefore what the last sample before it showed at which
//! this was clear: a sum over clear samples and a list of them tell which that is, however far back.

use super::{PartWidth, SampledLine, SpineSample};
use crate::rank::scan::{compact, exclusive_scan};
use rayon::prelude::*;

/// Mean shares at and above which a line is clearly visible, and below which it is clearly hidden.
pub const CLEAR_SHARES: [f32; 2] = [0.6, 0.4];

/// Mean share at and above which a line that starts with it is visible.
pub const EVEN_SHARE: f32 = 0.5;

/// Decides by the mean share of every sample and its neighbours whether it is visible, and whether that is clear.
///
/// The mean goes over [`PartWidth::radius`] samples to both sides on the sample's own line. The first sample of a line
/// counts as clear. O(samples · radius), parallel.
///
/// # Panics
///
/// When a sample names a line that does not hold it.
pub fn weigh_samples(
    widths: &[PartWidth],
    lines: &[SampledLine],
    (samples, gaps): (&[SpineSample], &[f32]),
    verdicts: &mut [u32],
    clear: &mut [u32],
) {
    let outputs = verdicts.par_iter_mut().zip(clear).enumerate();
    outputs
        .with_min_len(1024)
        .for_each(|(element, (verdict, clear))| {
            let element = element as u32;

            // Keep the window within the line.
            let line = &lines[samples[element as usize].line as usize];
            let last = line.first + line.count - 1;
            let radius = line.width(widths).radius;
            let from = element - radius.min(element - line.first);
            let to = element + radius.min(last - element);

            // Let most of the window decide.
            let mut sum = 0.0;
            for near in from..=to {
                sum += if gaps[near as usize] > 0.0 { 0.0 } else { 1.0 };
            }

            // Note where it is clear, and where each line starts.
            let count = (to - from + 1) as f32;
            let is_clear = sum >= CLEAR_SHARES[0] * count || sum < CLEAR_SHARES[1] * count;
            *verdict = u32::from(sum >= EVEN_SHARE * count);
            *clear = u32::from(is_clear || element == line.first);
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

/// Visibility of samples, 1 or 0 each, by how far in front lies what hides them: [`weigh_samples`] and
/// [`filter_visibility`] with the steps between them.
///
/// ```
/// use npr_vector::sampled::{PartWidth, SampledLine, SpineSample, visible_samples};
///
/// let line = SampledLine { count: 6, ..SampledLine::default() };
/// let samples = [SpineSample::default(); 6];
/// let seen = visible_samples(&[PartWidth::default()], &[line], &samples, &[0.0, 0.0, 3.5, 2.5, 0.0, 0.0]);
/// assert_eq!(seen, [1, 1, 0, 0, 1, 1]);
/// ```
pub fn visible_samples(
    widths: &[PartWidth],
    lines: &[SampledLine],
    samples: &[SpineSample],
    gaps: &[f32],
) -> Vec<u32> {
    // Weigh each sample with its neighbours.
    let made = || vec![0; samples.len()];
    let (mut verdicts, mut clear, mut clear_list, mut visible) = (made(), made(), made(), made());
    weigh_samples(widths, lines, (samples, gaps), &mut verdicts, &mut clear);

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
    fn walk(gaps: &[f32], radius: usize) -> Vec<u32> {
        let mut visible = None;
        let seen = (0..gaps.len()).map(|i| {
            let near = &gaps[i.saturating_sub(radius)..(i + radius + 1).min(gaps.len())];
            let sum = near.iter().filter(|gap| **gap == 0.0).count() as f32;
            let count = near.len() as f32;
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

    /// Lines with these numbers of samples, and the samples.
    fn lines(lengths: &[usize]) -> (Vec<SampledLine>, Vec<SpineSample>) {
        let (mut lines, mut samples) = (Vec::new(), Vec::new());
        for (line, length) in (0..).zip(lengths) {
            let sample = SpineSample {
                line,
                ..SpineSample::default()
            };
            lines.push(SampledLine {
                first: samples.len() as u32,
                count: *length as u32,
                ..SampledLine::default()
            });
            samples.extend(vec![sample; *length]);
        }
        (lines, samples)
    }

    fn over(radius: u32) -> PartWidth {
        PartWidth {
            radius,
            ..PartWidth::default()
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn every_line_is_filtered_as_by_a_walk_along_it(
            lengths in proptest::collection::vec(0usize..200, 0..6), radius in 0u32..6,
            hidden in proptest::collection::vec(any::<bool>(), 1200),
        ) {
            let (lines, samples) = lines(&lengths);
            let gap = |hidden: &bool| if *hidden { 2.5 } else { 0.0 };
            let gaps: Vec<f32> = hidden.iter().take(samples.len()).map(gap).collect();
            let seen = visible_samples(&[over(radius)], &lines, &samples, &gaps);
            let range = |line: &SampledLine| line.first as usize..(line.first + line.count) as usize;
            let walked = lines.iter().flat_map(|line| walk(&gaps[range(line)], radius as usize));
            let walked: Vec<u32> = walked.collect();
            prop_assert_eq!(seen, walked);
        }
    }

    #[test]
    fn any_radius_and_any_gap_will_do() {
        let (lines, samples) = lines(&[1, 0, 3]);
        let gaps = [f32::INFINITY, 0.0, 3.0, f32::NAN];
        let seen = visible_samples(&[over(u32::MAX)], &lines, &samples, &gaps);
        assert_eq!(seen, [0, 1, 1, 1]);
        assert!(visible_samples(&[over(3)], &[], &[], &[]).is_empty());
    }
}
