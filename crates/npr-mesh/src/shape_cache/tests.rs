//! Caches that are whole, damaged and forged.

use super::*;
use crate::shape::add_mesh;
use crate::testing::{Random, random_soup, random_winding};
use proptest::prelude::*;

const KEY: u128 = 0x0123_4567_89ab_cdef_0011_2233_4455_6677;

/// A shape of two random meshes with borders, slivers, marks and all sorts of names.
fn shape(seed: u64) -> Shape {
    let mut random = Random::new(seed);
    let name = |random: &mut Random| {
        let letters = ['a', 'Ж', '目', '\u{1f600}', '\0', '"'];
        (0..random.below(9))
            .map(|_| letters[random.below(6)])
            .collect()
    };
    let surfaces = (0..2 + random.below(3) as u32).map(|i| Surface {
        object: i / 2,
        material: random.below(3) as u32,
        object_name: name(&mut random),
        material_name: name(&mut random),
        base_color: [0; 4].map(|_| random.unit()),
        double_sided: random.below(2) == 0,
    });
    let mut shape = Shape {
        surfaces: surfaces.collect(),
        ..Shape::default()
    };
    for seed in [seed, !seed] {
        let mesh = random_winding(&random_soup((seed % 40) as usize, seed), seed);
        let surfaces: Vec<u32> = mesh.triangles().iter().map(|t| t[0] % 2).collect();
        let placed = PlacedMesh {
            rest: mesh.positions(),
            world: mesh.positions(),
            triangles: mesh.triangles(),
            surfaces: &surfaces,
            marks: &[[0, 1], [1, 2]],
            wires: &[[0, 2], [3, 1]],
            wire_surfaces: &[0, 1],
            mirrored: seed % 2 == 0,
        };
        add_mesh(&mut shape, &placed, 0.0);
    }
    shape
}

/// Bytes with the checksum that belongs to them, as a forger would leave them.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let sum = checksum(&bytes);
    bytes[CHECKSUM].copy_from_slice(&sum.to_le_bytes());
    bytes
}

#[test]
fn each_difference_has_its_error() {
    let bytes = encode(&shape(1), KEY);
    assert_eq!(decode(&[], KEY), Err(CacheError::NotAShape));
    assert_eq!(decode(&bytes, KEY + 1), Err(CacheError::OtherInput));
    let mut other = bytes.clone();
    other[8] += 1;
    assert_eq!(
        decode(&other, KEY),
        Err(CacheError::OtherVersion { found: VERSION + 1 })
    );
    let longer = [bytes.as_slice(), &[0]].concat();
    assert!(matches!(
        decode(&longer, KEY),
        Err(CacheError::OtherLength { .. })
    ));
    let mut damaged = bytes.clone();
    damaged[HEADER] ^= 1;
    assert_eq!(decode(&damaged, KEY), Err(CacheError::Damaged));
}

#[test]
fn a_header_that_asks_for_everything_allocates_nothing() {
    for at in [12, 32, 36, 40, 44, 48, 56, 60] {
        let mut bytes = encode(&shape(1), KEY);
        bytes[at..at + 4].copy_from_slice(&[0xff; 4]);
        assert!(decode(&sealed(bytes), KEY).is_err());
    }
}

#[test]
fn an_empty_shape_comes_back_empty() {
    let empty = decode(&encode(&Shape::default(), KEY), KEY).unwrap();
    assert_eq!((empty.faces.len(), empty.edge_count()), (0, 0));
}

#[test]
fn every_part_of_the_input_is_in_the_key() {
    let (positions, moved) = ([[0.0f32; 3]; 4], [[1.0f32; 3]; 4]);
    let surfaces = [Surface::default()];
    let renamed = [Surface {
        object_name: "x".into(),
        ..Surface::default()
    }];
    let mesh = PlacedMesh {
        rest: &positions,
        world: &positions,
        triangles: &[[0, 1, 2]],
        surfaces: &[0],
        marks: &[],
        wires: &[],
        wire_surfaces: &[],
        mirrored: false,
    };
    let keys = [
        shape_key(&surfaces, &[mesh], 0.0),
        shape_key(&renamed, &[mesh], 0.0),
        shape_key(&surfaces, &[], 0.0),
        shape_key(&surfaces, &[mesh, mesh], 0.0),
        shape_key(&surfaces, &[mesh], 1e-6),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                rest: &moved,
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                world: &moved,
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                triangles: &[[0, 2, 1]],
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                surfaces: &[1],
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                surfaces: &[0, 0],
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                marks: &[[0, 1]],
                ..mesh
            }],
            0.0,
        ),
        shape_key(
            &surfaces,
            &[PlacedMesh {
                mirrored: true,
                ..mesh
            }],
            0.0,
        ),
    ];
    let different: std::collections::BTreeSet<u128> = keys.into_iter().collect();
    assert_eq!(different.len(), keys.len());
    assert_eq!(keys[0], shape_key(&surfaces, &[mesh], 0.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn what_goes_in_comes_out(seed: u64, key: u128) {
        let shape = shape(seed);
        prop_assert_eq!(decode(&encode(&shape, key), key), Ok(shape));
    }

    #[test]
    fn a_changed_byte_is_noticed(seed: u64, at: prop::sample::Index, flip in 1u8..) {
        let mut bytes = encode(&shape(seed), KEY);
        let at = at.index(bytes.len());
        bytes[at] ^= flip;
        prop_assert!(decode(&bytes, KEY).is_err());
    }

    #[test]
    fn a_cut_is_noticed(seed: u64, at: prop::sample::Index) {
        let bytes = encode(&shape(seed), KEY);
        prop_assert!(decode(&bytes[..at.index(bytes.len())], KEY).is_err());
    }

    #[test]
    fn a_forged_cache_is_refused_or_sound(seed: u64, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4)) {
        let mut bytes = encode(&shape(seed), KEY);
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok(shape) = decode(&sealed(bytes), KEY) {
            shape.sanity_check();
        }
    }

    #[test]
    fn noise_is_refused(noise in prop::collection::vec(any::<u8>(), 0..300)) {
        prop_assert!(decode(&noise, KEY).is_err());
        prop_assert!(decode(&[MAGIC.as_slice(), &VERSION.to_le_bytes(), &noise].concat(), KEY).is_err());
    }
}
