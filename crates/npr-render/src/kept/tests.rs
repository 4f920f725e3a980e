use super::*;
use npr_core::random::hash;
use proptest::prelude::*;

fn input(seed: u32) -> ContentHash {
    let mut hash = input_of("test");
    hash.numbers(&[seed]);
    hash
}

fn files_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries
        .map(|entry| entry.expect("an entry").path())
        .collect()
}

fn below_a_thousand(rows: &[[u32; 2]]) -> bool {
    rows.len() == 50 && rows.as_flattened().iter().all(|v| *v < 1000)
}

fn made(seed: u32) -> Vec<[u32; 2]> {
    (0..50)
        .map(|i| [0, 1].map(|k| hash(seed, k, i) % 1000))
        .collect()
}

#[test]
fn what_was_kept_is_not_made_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::of(Some(folder.path()));
    let rows = cache.rows(|| input(1), below_a_thousand, || made(1));
    assert_eq!(rows, made(1));
    let again = cache.rows(|| input(1), below_a_thousand, || panic!("it is there"));
    assert_eq!(again, rows);
    assert_eq!(
        cache.rows(|| input(2), below_a_thousand, || made(2)),
        made(2)
    );
    assert_eq!(files_in(folder.path()).len(), 2);
}

#[test]
fn without_a_folder_and_with_a_broken_one_all_is_made() {
    for folder in [None, Some(Path::new("/proc")), Some(Path::new("no/where"))] {
        let rows = Cache::of(folder).rows(|| input(1), below_a_thousand, || made(1));
        assert_eq!(rows, made(1));
    }
}

#[test]
fn a_poisoned_file_with_a_sound_digest_is_made_anew() {
    let folder = tempfile::tempdir().expect("a folder");
    let cache = Cache::of(Some(folder.path()));
    cache.rows(|| input(1), below_a_thousand, || made(1));
    let path = files_in(folder.path()).remove(0);
    let key = input(1).finish();
    for poison in [vec![[1000, 0]; 50], vec![[0, 0]; 49], vec![]] {
        write(folder.path(), &path, &encode(&poison, key)).expect("its own file");
        let rows = cache.rows(|| input(1), below_a_thousand, || made(1));
        assert_eq!(rows, made(1));
        assert_eq!(read(&path).expect("a file"), encode(&made(1), key));
    }
    // Rows of another size, and a file of another input under this name.
    let wide: Vec<[u32; 4]> = vec![[0; 4]; 25];
    for bytes in [encode(&wide, key), encode(&made(1), key + 1)] {
        write(folder.path(), &path, &bytes).expect("its own file");
        assert_eq!(
            cache.rows(|| input(1), below_a_thousand, || made(1)),
            made(1)
        );
    }
}

proptest! {
    #[test]
    fn what_goes_in_comes_out(rows in prop::collection::vec(any::<[u32; 3]>(), 0..40), key: u128) {
        prop_assert_eq!(decode(&encode(&rows, key), key), Some(rows));
    }

    #[test]
    fn any_changed_bit_is_noticed(at: prop::sample::Index, bit in 0u32..8) {
        let mut bytes = encode(&made(3), 7);
        let at = at.index(bytes.len());
        bytes[at] ^= 1 << bit;
        prop_assert_eq!(decode::<[u32; 2]>(&bytes, 7), None);
    }

    #[test]
    fn what_is_cut_off_or_longer_is_noticed(length in 0usize..600) {
        let mut bytes = encode(&made(3), 7);
        prop_assume!(length != bytes.len());
        bytes.resize(length, 0);
        prop_assert_eq!(decode::<[u32; 2]>(&bytes, 7), None);
    }

    #[test]
    fn any_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..200), key: u128) {
        prop_assert_eq!(decode::<[u32; 2]>(&bytes, key), None);
    }
}
