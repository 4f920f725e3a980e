//! Arrays in NumPy's `.npy` files, versions 1 to 3 of the format.
//!
//! ```
//! use npr_vdb::{Limits, npy};
//!
//! # let header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 2), }";
//! # let file = npr_vdb::testing::npy_file(header, &[0, 0, 128, 63, 0, 0, 0, 64]);
//! // let file = std::fs::read("density.npy")?;
//! let array = npy::read(&file, &Limits::default())?;
//! assert_eq!(array.size, [1, 1, 2]);
//! assert_eq!(array.values, npy::Values::Scalars(vec![1.0, 2.0]));
//! # Ok::<(), npr_vdb::Fault>(())
//! ```

mod fault;
mod header;

pub use fault::NpyFault;

use crate::fault::Fault;
use crate::half::f32_from_half;
use crate::limits::{Budget, Limits};
use header::{Header, Real};

/// A dense volume.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// How many places it has along each axis; all zero where it has none.
    pub size: [usize; 3],
    /// A value for each place; the last axis runs fastest, in whatever order the file stores them.
    pub values: Values,
}

/// Values of a dense volume.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Numbers.
    Scalars(Vec<f32>),
    /// Vectors, the fourth axis of the file.
    Vectors(Vec<[f32; 3]>),
}

/// Reads a `.npy` file of half, single or double floats, rounded to single precision, in either byte order and either
/// order of axes. NaN and infinities are handed on.
///
/// O(elements).
///
/// # Errors
///
/// [`Fault::Npy`] where the file is no such array, or has a byte too many or too few; [`Fault::Memory`] where it
/// exceeds the limits.
pub fn read(bytes: &[u8], limits: &Limits) -> Result<Array, Fault> {
    // Check the length of the data before memory is taken.
    let (header, data) = Header::read(bytes)?;
    let (size, is_vector) = header.sides()?;
    let components = if is_vector { 3 } else { 1 };
    let count = size.into_iter().try_fold(components, usize::checked_mul);
    let needed = count.and_then(|count| count.checked_mul(header.real.bytes()));
    if needed != Some(data.len()) {
        return Err(NpyFault::Length {
            needed: needed.map_or(u64::MAX, |needed| needed as u64),
            held: data.len() as u64,
        }
        .into());
    }

    // Read the numbers, the last axis fastest.
    let count = count.unwrap_or_default();
    let mut budget = Budget::new(limits);
    let mut numbers = budget.list("an array", count)?;
    header.decode(data, &mut numbers);
    if header.is_fortran {
        numbers = last_axis_fastest(&numbers, size, components, budget.list("an array", count)?);
    }

    // Group them by three where they are vectors.
    if !is_vector {
        return Ok(Array {
            size,
            values: Values::Scalars(numbers),
        });
    }
    let mut vectors =
        budget.list::<[f32; 3]>("an array", count.checked_div(3).unwrap_or_default())?;
    vectors.extend_from_slice(numbers.as_chunks().0);
    Ok(Array {
        size,
        values: Values::Vectors(vectors),
    })
}

/// The same elements with the last axis fastest instead of the first.
fn last_axis_fastest(
    numbers: &[f32],
    size: [usize; 3],
    components: usize,
    mut sorted: Vec<f32>,
) -> Vec<f32> {
    let [x_side, y_side, z_side] = size;
    let plane = x_side.saturating_mul(y_side);
    let volume = plane.saturating_mul(z_side).max(1);
    for first in (0..x_side).flat_map(|x| (x..plane).step_by(x_side)) {
        for place in (first..volume).step_by(plane) {
            let values = numbers.get(place..).unwrap_or_default().iter();
            sorted.extend(values.step_by(volume).take(components));
        }
    }
    sorted
}

impl Real {
    fn bytes(self) -> usize {
        match self {
            Self::Half => 2,
            Self::Single => 4,
            Self::Double => 8,
        }
    }
}

impl Header {
    /// Appends the numbers of `data`, rounded to single precision.
    fn decode(&self, data: &[u8], numbers: &mut Vec<f32>) {
        match self.real {
            Real::Half => self.extend(data, numbers, |b| f32_from_half(u16::from_le_bytes(b))),
            Real::Single => self.extend(data, numbers, f32::from_le_bytes),
            Real::Double => self.extend(data, numbers, |b| f64::from_le_bytes(b) as f32),
        }
    }

    fn extend<const N: usize>(
        &self,
        data: &[u8],
        numbers: &mut Vec<f32>,
        number: impl Fn([u8; N]) -> f32,
    ) {
        let little = |mut bytes: [u8; N]| {
            if self.is_big_endian {
                bytes.reverse();
            }
            bytes
        };
        let elements = data.as_chunks().0.iter();
        numbers.extend(elements.map(|&bytes| number(little(bytes))));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::npy_file;
    use proptest::prelude::*;

    const LIMITS: Limits = Limits {
        memory_bytes: 1 << 20,
    };

    fn fault(file: &[u8]) -> NpyFault {
        match read(file, &LIMITS) {
            Err(Fault::Npy(fault)) => fault,
            other => panic!("{other:?}"),
        }
    }

    fn header(descr: &str, fortran: bool, shape: &str) -> String {
        let fortran = if fortran { "True" } else { "False" };
        format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}")
    }

    #[test]
    fn precision_and_byte_order_are_those_of_the_header() {
        let cases: [(&str, Vec<u8>); 6] = [
            ("<f2", vec![0, 0x3e, 0, 0xc0]),
            (">f2", vec![0x3e, 0, 0xc0, 0]),
            ("<f4", [1.5f32, -2.0].map(f32::to_le_bytes).concat()),
            (">f4", [1.5f32, -2.0].map(f32::to_be_bytes).concat()),
            ("<f8", [1.5f64, -2.0].map(f64::to_le_bytes).concat()),
            (">f8", [1.5f64, -2.0].map(f64::to_be_bytes).concat()),
        ];
        for (descr, data) in cases {
            let array = read(
                &npy_file(&header(descr, false, "(2, 1, 1)"), &data),
                &LIMITS,
            );
            let wanted = Array {
                size: [2, 1, 1],
                values: Values::Scalars(vec![1.5, -2.0]),
            };
            assert_eq!(array, Ok(wanted), "{descr}");
        }
    }

    #[test]
    fn all_versions_of_the_header_are_read() {
        let text = header("<f2", false, "(1, 1, 1)");
        for major in 1..=3u8 {
            let mut file = vec![0x93, b'N', b'U', b'M', b'P', b'Y', major, 0];
            let length = (text.len() as u32).to_le_bytes();
            file.extend(&length[..if major == 1 { 2 } else { 4 }]);
            file.extend(text.bytes());
            file.extend([0, 0x3c]);
            assert!(read(&file, &LIMITS).is_ok(), "{major}");
            file[7] = 1;
            assert_eq!(fault(&file), NpyFault::Version { major, minor: 1 });
        }
    }

    #[test]
    fn what_is_no_volume_is_refused_by_name() {
        let shape = |text: &str| fault(&npy_file(&header("<f4", false, text), &[0; 16]));
        assert_eq!(
            shape("(4,)").to_string(),
            "an array of shape (4) is no volume: three sides are read, or four of which the last is 3"
        );
        assert!(matches!(shape("(1, 1, 2, 2)"), NpyFault::Shape { .. }));
        assert!(matches!(shape("()"), NpyFault::Shape { .. }));
        let descr = fault(&npy_file(&header("<i4", false, "(1, 1, 4)"), &[0; 16]));
        assert_eq!(
            descr.to_string(),
            "the elements have type '<i4', which is not read, only f2, f4 and f8"
        );
        assert_eq!(fault(b"P5 2 2 255"), NpyFault::NotNpy);
        assert_eq!(fault(b""), NpyFault::NotNpy);
    }

    #[test]
    fn a_byte_too_many_or_too_few_is_refused() {
        let text = header("<f4", false, "(1, 2, 2)");
        for held in [0, 15, 17, 32] {
            let held = held as u64;
            assert_eq!(
                fault(&npy_file(&text, &vec![0; held as usize])),
                NpyFault::Length { needed: 16, held }
            );
        }
        let huge = header("<f4", false, "(4294967296, 4294967296, 4294967296)");
        assert!(matches!(
            fault(&npy_file(&huge, &[])),
            NpyFault::Length {
                needed: u64::MAX,
                ..
            }
        ));
    }

    #[test]
    fn an_array_without_places_is_empty() {
        let text = header("<f4", true, "(4294967296, 4294967296, 0)");
        let empty = Array {
            size: [0; 3],
            values: Values::Scalars(Vec::new()),
        };
        assert_eq!(read(&npy_file(&text, &[]), &LIMITS), Ok(empty));
    }

    #[test]
    fn memory_is_planned_before_it_is_taken() {
        let text = header("<f4", false, "(16, 16, 4)");
        let limits = Limits { memory_bytes: 4095 };
        let fault = read(&npy_file(&text, &[0; 4096]), &limits);
        assert!(matches!(
            fault,
            Err(Fault::Memory {
                bytes: 4096,
                limit: 4095,
                ..
            })
        ));
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

        #[test]
        fn either_order_of_axes_gives_the_same_places(
            size in prop::array::uniform3(0usize..6), is_vector: bool, is_fortran: bool,
        ) {
            let components = if is_vector { 3 } else { 1 };
            // Every element says where it lies.
            let value = |x: usize, y: usize, z: usize, c: usize| (x * 1000 + y * 100 + z * 10 + c) as f32;
            let mut wanted = Vec::new();
            let mut stored = Vec::new();
            let [a, b, c] = size;
            for x in 0..a { for y in 0..b { for z in 0..c { for w in 0..components {
                wanted.push(value(x, y, z, w));
            }}}}
            for w in 0..components { for z in 0..c { for y in 0..b { for x in 0..a {
                stored.push(value(x, y, z, w));
            }}}}
            let data = if is_fortran { stored } else { wanted.clone() };
            let data: Vec<u8> = data.iter().flat_map(|number| number.to_le_bytes()).collect();
            let shape = if is_vector { format!("({a}, {b}, {c}, 3)") } else { format!("({a}, {b}, {c})") };
            let array = read(&npy_file(&header("<f4", is_fortran, &shape), &data), &LIMITS).unwrap();
            prop_assert_eq!(array.size, if size.contains(&0) { [0; 3] } else { size });
            let numbers = match array.values {
                Values::Scalars(numbers) => numbers,
                Values::Vectors(vectors) => vectors.concat(),
            };
            prop_assert_eq!(numbers, wanted);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 20_000, ..ProptestConfig::default() })]

        #[test]
        fn damaged_files_never_panic(
            changes in prop::collection::vec((any::<usize>(), any::<u8>()), 1..5),
            cut in prop::option::of(any::<usize>()),
        ) {
            let mut file = npy_file(&header("<f4", true, "(2, 3, 2, 3)"), &[0; 144]);
            for (at, byte) in changes {
                let at = at % file.len();
                file[at] = byte;
            }
            if let Some(cut) = cut {
                file.truncate(cut % file.len());
            }
            if let Ok(array) = read(&file, &LIMITS) {
                let count = match array.values {
                    Values::Scalars(numbers) => numbers.len(),
                    Values::Vectors(vectors) => vectors.len(),
                };
                prop_assert_eq!(count, array.size.iter().product::<usize>());
            }
        }
    }
}
