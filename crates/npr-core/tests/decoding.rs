//! The guard around decoders catches what panics inside, and keeps quiet about nothing else.

use npr_core::decoding::{DecoderPanic, guard};
use std::panic;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Barrier};
use std::thread;

/// Panics that reached the hook of the process.
static TOLD: AtomicUsize = AtomicUsize::new(0);

fn reported() -> usize {
    TOLD.load(Ordering::SeqCst)
}

/// What a guard makes of a panic.
fn caught(decode: impl FnOnce()) -> bool {
    guard(decode) == Err(DecoderPanic)
}

/// One test alone: the hook belongs to the whole process.
#[test]
fn only_panics_inside_a_guard_are_silent() {
    panic::set_hook(Box::new(|_| {
        TOLD.fetch_add(1, Ordering::SeqCst);
    }));

    // Catch without a word, also behind an inner guard that has caught one already.
    assert!(caught(|| panic!("broken")));
    assert_eq!(guard(|| 7), Ok(7));
    assert!(caught(|| {
        assert!(caught(|| panic!("inner")));
        panic!("outer, still inside of its guard")
    }));
    assert_eq!(reported(), 0);

    // Tell of a panic outside, afterwards as before.
    assert!(panic::catch_unwind(|| panic!("a bug")).is_err());
    assert_eq!(reported(), 1);

    // Tell of one in a thread outside while another thread stands inside, and not of the one inside.
    let both = Arc::new(Barrier::new(2));
    let inside = {
        let both = Arc::clone(&both);
        thread::spawn(move || {
            caught(|| {
                both.wait();
                both.wait();
                panic!("inside")
            })
        })
    };
    both.wait();
    assert!(thread::spawn(|| panic!("outside")).join().is_err());
    both.wait();
    assert!(inside.join().expect("the guard caught it"));
    assert_eq!(reported(), 2);
}
