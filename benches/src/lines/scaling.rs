//! How time grows with the number of triangles.

/// The power of `n log n` that times grow with, by least squares over logarithms; `None` of fewer than two sizes.
///
/// Each sample is a number of triangles and a time. 1 means that doubling a large mesh takes a little over twice as
/// long.
pub fn exponent(samples: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<[f64; 2]> = samples
        .iter()
        .map(|(count, time)| [libm::log(count * libm::log2(*count)), libm::log(*time)])
        .collect();
    let count = logs.len() as f64;
    let mean = [0, 1].map(|i| logs.iter().map(|log| log[i]).sum::<f64>() / count);
    let product = |i: usize, j: usize| -> f64 {
        logs.iter()
            .map(|log| (log[i] - mean[i]) * (log[j] - mean[j]))
            .sum()
    };
    let spread = product(0, 0);
    (spread > 0.0).then(|| product(0, 1) / spread)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_power_is_found_again(power in 0.2..3.0f64, factor in 1e-6..1e3f64) {
            let law = |n: f64| (n, factor * libm::pow(n * libm::log2(n), power));
            let samples = [1e4, 3e4, 1e5, 3e5, 1e6].map(law);
            prop_assert!((exponent(&samples).unwrap() - power).abs() < 1e-9);
        }
    }

    #[test]
    fn one_size_settles_nothing() {
        assert_eq!(exponent(&[]), None);
        assert_eq!(exponent(&[(1e4, 2.0), (1e4, 3.0)]), None);
    }
}
