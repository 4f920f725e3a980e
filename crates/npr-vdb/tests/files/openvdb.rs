//! Files that OpenVDB wrote: read as they are, and damaged.

mod mutants;
mod written;

/// A file of `tests/data`, unpacked.
fn unpacked(name: &str) -> Vec<u8> {
    let path = format!("{}/tests/data/{name}.vdb.zz", env!("CARGO_MANIFEST_DIR"));
    let packed = std::fs::read(path).expect("a file of this folder");
    miniz_oxide::inflate::decompress_to_vec_zlib(&packed).expect("a zlib stream")
}
