//! The table of keys that have no effect: which, when and why. Its reasons are printed for users.

mod drawings;
mod entry;
mod lines;
mod smoke;
mod tones;

pub(super) use entry::{Entry, Why};

/// All entries. The first one that covers a key and whose condition holds gives the reason.
pub(super) fn entries() -> impl Iterator<Item = &'static Entry> {
    let tables = [
        drawings::ENTRIES,
        lines::ENTRIES,
        tones::ENTRIES,
        smoke::ENTRIES,
    ];
    tables.into_iter().flatten()
}
