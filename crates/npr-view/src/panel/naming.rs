//! Names of controls for programs that read screens, and of keys for people.

use egui::Response;

/// Gives a control the name that programs which read screens know it by.
pub(crate) fn name_it(response: &Response, name: &str) {
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_label(name));
}
