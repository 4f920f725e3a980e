//! The one door to decoders that others wrote.
//!
//! Decoders of pictures, fonts, packed bytes and texts come from elsewhere, and some of them panic on broken input.
//! Each call of one stands inside [`guard`], which turns such a panic into an error; `cargo xtask decoders` checks
//! that.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// How many guards this thread stands in.
    static DEPTH: Cell<u32> = const { Cell::new(0) };
}

/// A decoder stopped on its input in a way that it does not expect itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("it is broken in a way that its decoder does not expect")]
pub struct DecoderPanic;

/// What `decode` gives.
///
/// What `decode` changed outside of itself may be half done after a panic: drop it.
///
/// A panic inside writes nothing to standard error. For that the first call puts a hook before that of the process,
/// which passes on every panic outside of guards, also from other threads at the same time. A hook that the program
/// sets later replaces it. A thread that `decode` itself starts is not guarded. O(1) beside `decode`.
///
/// # Errors
///
/// [`DecoderPanic`] where `decode` panics. Nothing is caught where the program is built with `panic = "abort"`.
///
/// ```
/// use npr_core::decoding::{DecoderPanic, guard};
///
/// let palette = [255u8, 0, 0, 9, 9];
/// let color = |start: usize| palette[start..start + 3].to_vec();
/// assert_eq!(guard(|| color(0)), Ok(vec![255, 0, 0]));
/// assert_eq!(guard(|| color(3)), Err(DecoderPanic));
/// ```
pub fn guard<R>(decode: impl FnOnce() -> R) -> Result<R, DecoderPanic> {
    keep_guarded_panics_silent();
    let _inside = Inside::enter();
    panic::catch_unwind(AssertUnwindSafe(decode)).map_err(|_| DecoderPanic)
}

/// Puts a hook before the present one, once in a process.
fn keep_guarded_panics_silent() {
    static INSTALLED: Once = Once::new();
    INSTALLED.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if DEPTH.get() == 0 {
                before(panic);
            }
        }));
    });
}

/// A stay in a guard, however it ends.
struct Inside;

impl Inside {
    fn enter() -> Self {
        DEPTH.set(DEPTH.get() + 1);
        Self
    }
}

impl Drop for Inside {
    fn drop(&mut self) {
        DEPTH.set(DEPTH.get() - 1);
    }
}
