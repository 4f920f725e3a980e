//! How the time of a frame grows with triangles and pixels.

use std::fmt;

/// Number of coefficients: constant, triangles, pixels, and their product.
const TERMS: usize = 4;

/// The time of one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Triangles of the model.
    pub triangles: f64,
    /// Pixels of the frame.
    pub pixels: f64,
    /// Milliseconds.
    pub ms: f64,
}

impl Sample {
    /// The terms of the model at this sample, in units that make them alike in size: 10^5 triangles, 10^6 pixels.
    fn terms(&self) -> [f64; TERMS] {
        let (triangles, pixels) = (self.triangles / 1e5, self.pixels / 1e6);
        [1.0, triangles, pixels, triangles * pixels]
    }
}

/// `t = base + triangles + pixels + both`, fitted by least squares.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cost {
    /// Milliseconds of a frame without triangles or pixels.
    pub base_ms: f64,
    /// Milliseconds for 100 000 triangles.
    pub triangles_ms: f64,
    /// Milliseconds for a million pixels.
    pub pixels_ms: f64,
    /// Milliseconds for 100 000 triangles times a million pixels, beyond what each costs alone.
    pub product_ms: f64,
    /// Share of the variance that the fit explains, 0..1.
    pub r_squared: f64,
}

impl Cost {
    /// The least squares fit; `None` where the samples do not settle all four coefficients.
    pub fn fit(samples: &[Sample]) -> Option<Self> {
        Self::fit_terms(samples, TERMS)
    }

    /// The fit without the product: triangles and pixels add up.
    pub fn fit_sum(samples: &[Sample]) -> Option<Self> {
        Self::fit_terms(samples, TERMS - 1)
    }

    /// Fits the first `count` terms; the others are zero.
    fn fit_terms(samples: &[Sample], count: usize) -> Option<Self> {
        // Build the normal equations, the right side as the last column.
        let mut rows = vec![vec![0.0; count + 1]; count];
        for sample in samples {
            let terms = sample.terms();
            for (row, left) in rows.iter_mut().zip(terms) {
                for (cell, right) in row.iter_mut().zip(&terms[..count]) {
                    *cell += left * right;
                }
                row[count] += left * sample.ms;
            }
        }
        let solved = solve(rows)?;
        let term = |i: usize| solved.get(i).copied().unwrap_or(0.0);
        let mut cost = Self {
            base_ms: term(0),
            triangles_ms: term(1),
            pixels_ms: term(2),
            product_ms: term(3),
            r_squared: 0.0,
        };
        cost.r_squared = 1.0 - cost.residual(samples) / variance(samples);
        Some(cost)
    }

    /// Milliseconds that the fit expects.
    pub fn at(&self, triangles: f64, pixels: f64) -> f64 {
        let sample = Sample {
            triangles,
            pixels,
            ms: 0.0,
        };
        let factors = [
            self.base_ms,
            self.triangles_ms,
            self.pixels_ms,
            self.product_ms,
        ];
        factors.iter().zip(sample.terms()).map(|(a, b)| a * b).sum()
    }

    /// Share of the expected time that the product makes up, 0 where costs merely add up.
    pub fn product_share(&self, triangles: f64, pixels: f64) -> f64 {
        let alone = Self {
            product_ms: 0.0,
            ..*self
        };
        1.0 - alone.at(triangles, pixels) / self.at(triangles, pixels)
    }

    /// Sum of squared differences between samples and fit.
    fn residual(&self, samples: &[Sample]) -> f64 {
        let difference = |sample: &Sample| sample.ms - self.at(sample.triangles, sample.pixels);
        samples.iter().map(|s| difference(s) * difference(s)).sum()
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            base_ms,
            triangles_ms,
            pixels_ms,
            product_ms,
            ..
        } = self;
        write!(f, "{base_ms:.2} {triangles_ms:+.2} T {pixels_ms:+.2} P")?;
        if *product_ms == 0.0 {
            return Ok(());
        }
        write!(f, " {product_ms:+.2} T P")
    }
}

/// Sum of squared differences between samples and their mean.
fn variance(samples: &[Sample]) -> f64 {
    let mean = samples.iter().map(|s| s.ms).sum::<f64>() / samples.len() as f64;
    samples.iter().map(|s| (s.ms - mean) * (s.ms - mean)).sum()
}

/// Gauss and Jordan's elimination of `n` equations of `n` unknowns and a right side, with the largest pivot first.
fn solve(mut rows: Vec<Vec<f64>>) -> Option<Vec<f64>> {
    for column in 0..rows.len() {
        // Choose the largest pivot; without one there is no answer.
        let largest = (column..rows.len())
            .max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()))?;
        rows.swap(column, largest);
        let pivot = rows[column].clone();
        if pivot[column].abs() < 1e-9 {
            return None;
        }

        // Take the unknown out of all other equations.
        for (i, row) in rows.iter_mut().enumerate() {
            if i != column {
                let factor = row[column] / pivot[column];
                row.iter_mut()
                    .zip(&pivot)
                    .for_each(|(cell, p)| *cell -= factor * p);
            }
        }
    }
    let last = rows.len();
    Some(
        rows.iter()
            .enumerate()
            .map(|(i, row)| row[last] / row[i])
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Samples on a grid whose times follow `law`.
    fn samples(law: impl Fn(f64, f64) -> f64) -> Vec<Sample> {
        let (counts, sizes) = ([960.0, 9566.0, 66400.0], [2.3e5, 9.2e5, 2.07e6]);
        let pairs = counts
            .iter()
            .flat_map(|t| sizes.iter().map(move |p| (*t, *p)));
        pairs
            .map(|(triangles, pixels)| Sample {
                triangles,
                pixels,
                ms: law(triangles, pixels),
            })
            .collect()
    }

    proptest! {
        #[test]
        fn a_law_of_this_form_is_found_again(
            base in 0f64..10.0, t in 0.1f64..50.0, p in 0.1f64..50.0, both in 0f64..20.0,
        ) {
            let law = |triangles: f64, pixels: f64| {
                base + t * triangles / 1e5 + p * pixels / 1e6 + both * triangles * pixels / 1e11
            };
            let cost = Cost::fit(&samples(law)).expect("the grid settles all terms");
            prop_assert!((cost.triangles_ms - t).abs() < 1e-6 && (cost.product_ms - both).abs() < 1e-6);
            prop_assert!(cost.r_squared > 1.0 - 1e-9);
        }
    }

    #[test]
    fn costs_that_add_up_leave_no_product() {
        let cost = Cost::fit(&samples(|t, p| 2.0 + t / 1e4 + p / 1e5)).expect("a fit");
        assert!(cost.product_share(66400.0, 2.07e6).abs() < 1e-9);
    }

    #[test]
    fn one_size_alone_settles_nothing() {
        let same = [Sample {
            triangles: 1e4,
            pixels: 1e6,
            ms: 5.0,
        }; 9];
        assert_eq!(Cost::fit(&same), None);
    }
}
