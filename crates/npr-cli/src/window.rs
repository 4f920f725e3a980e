//! The window of `npr view`.

use crate::arguments::{Said, ViewArguments};
use crate::fault::{Exit, Fault};
use crate::message::quoted;
use crate::view;
use npr_core::decoding::guard;
use std::path::Path;

/// Opens the window, and comes back when the user closes it.
pub fn view(said: &Said<ViewArguments>) -> Result<(), Fault> {
    // Say what is wrong with the command line before there is a window.
    let path = &said.args.scene;
    if path == Path::new("-") {
        let message =
            "npr view reads its scene from a file, which it looks at again when it changes";
        return Err(Fault::new(Exit::Usage, message));
    }
    if let Err(error) = std::fs::metadata(path) {
        return Err(Fault::from(error).while_doing(format_args!("cannot read {}", quoted(path))));
    }
    view::check(&said.args)?;

    // Open the window. A system that lacks something may make its library panic.
    let title = format!("npr {}", path.display());
    let mut fault = None;
    let opened = guard(|| {
        npr_view::window::open(&title, |wake| {
            view::studio(said, wake).map_err(|cause| {
                let text = cause.message.clone();
                fault = Some(cause);
                text
            })
        })
    });
    match (fault, opened) {
        (Some(fault), _) => Err(fault),
        (None, Ok(Ok(()))) => Ok(()),
        (None, Ok(Err(error))) => Err(Fault::new(Exit::Failed, error)),
        (None, Err(_)) => {
            let message = "the window has stopped in a way that its library does not expect";
            Err(Fault::new(Exit::Failed, message))
        }
    }
}
