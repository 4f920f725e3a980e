//! What lets controls be used without eyes or a mouse: their names, and keys that change them.

use egui::{EventFilter, Key, Response};

/// Gives a control the name that programs which read screens know it by.
pub(crate) fn name_it(response: &Response, name: &str) {
    response
        .ctx
        .accesskit_node_builder(response.id, |node| node.set_label(name));
}

/// How often the arrow keys were pressed to the right, and up, while a control has the keys; it keeps them.
pub(crate) fn arrows(response: &Response) -> [i32; 2] {
    if !response.has_focus() {
        return [0; 2];
    }
    let filter = EventFilter {
        horizontal_arrows: true,
        vertical_arrows: true,
        ..EventFilter::default()
    };
    let ctx = &response.ctx;
    ctx.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
    ctx.input(|input| {
        let presses = |key| input.num_presses(key) as i32;
        [
            presses(Key::ArrowRight) - presses(Key::ArrowLeft),
            presses(Key::ArrowUp) - presses(Key::ArrowDown),
        ]
    })
}

/// The entry of a list of `count` that arrow keys lead to from one of them; up leads to the first. `None` where they
/// lead nowhere.
pub(crate) fn stepped(response: &Response, now: usize, count: usize) -> Option<usize> {
    let [right, up] = arrows(response);
    let there = (now as i64 + i64::from(right - up)).clamp(0, count.max(1) as i64 - 1) as usize;
    (there != now && count > 0).then_some(there)
}
