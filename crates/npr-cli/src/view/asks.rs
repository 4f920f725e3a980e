//! What a painter is asked for, in the order in which it is done.

use npr_core::interrupt::Interrupt;
use npr_view::{Film, Order, Question, Take};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

/// What a painter is asked for.
#[derive(Debug, Clone, PartialEq)]
pub enum Ask {
    /// Draw a picture, asked for when so many scenes were known to be opened.
    Draw(Order, u64),
    /// Draw a picture beside the present one, which stays as it is; any picture that is asked for later counts instead.
    Aside(Order, u64),
    /// Open a scene, or a motion for the figure of the present one.
    Open(PathBuf),
    /// Tell what is at a place of a picture.
    PointAt(Question),
    /// Write the picture of an order, or its lines, into a file.
    Save(Take, Order),
    /// Draw a film.
    Film(Film, Order),
    /// Nobody asks any more.
    End,
}

/// What a desk raises to end what its painter does.
#[derive(Debug, Clone)]
pub struct Ends {
    /// Ends the film that is drawn.
    pub film: Interrupt,
    /// Ends a full picture, and one beside it; raised after a picture was asked for. Drafts are drawn to their end:
    /// who moves all the time sees them.
    pub picture: Interrupt,
}

impl Default for Ends {
    fn default() -> Self {
        Self {
            film: Interrupt::new(),
            picture: Interrupt::new(),
        }
    }
}

/// What was asked for and is still to be done.
pub struct Asks {
    receiver: Receiver<Ask>,
    ends: Ends,
    queue: RefCell<VecDeque<Ask>>,
}

impl Asks {
    /// Those that a receiver gets, after a first one.
    pub fn after(first: Ask, receiver: Receiver<Ask>, ends: Ends) -> Self {
        Self {
            receiver,
            ends,
            queue: RefCell::new(VecDeque::from([first])),
        }
    }

    /// What ends the work.
    pub fn ends(&self) -> &Ends {
        &self.ends
    }

    /// What is to be done next; none where nothing was asked for in a time. Of pictures that were asked for one after
    /// the other, only the last counts.
    pub fn next(&self, wait: Duration) -> Option<Ask> {
        self.take();
        let mut queue = self.queue.borrow_mut();
        if queue.is_empty() {
            match self.receiver.recv_timeout(wait) {
                Ok(ask) => push(&mut queue, ask),
                Err(RecvTimeoutError::Timeout) => return None,
                Err(RecvTimeoutError::Disconnected) => return Some(Ask::End),
            }
        }
        queue.pop_front()
    }

    /// Whether another picture waits to be drawn, or nobody asks any more.
    pub fn have_picture(&self) -> bool {
        self.take();
        let is_picture = |ask: &Ask| matches!(ask, Ask::Draw(..) | Ask::End);
        self.queue.borrow().iter().any(is_picture)
    }

    /// Takes what was asked for meanwhile. The flag is lowered first, and was raised last: what is not taken here ends
    /// the picture that is drawn next.
    fn take(&self) {
        self.ends.picture.lower();
        let mut queue = self.queue.borrow_mut();
        while let Ok(ask) = self.receiver.try_recv() {
            push(&mut queue, ask);
        }
    }
}

/// Adds what is asked for; a picture takes the place of one that waits at the end, and of one beside it.
fn push(queue: &mut VecDeque<Ask>, ask: Ask) {
    if matches!(ask, Ask::Draw(..) | Ask::Aside(..)) {
        queue.retain(|other| !matches!(other, Ask::Aside(..)));
    }
    if matches!((queue.back(), &ask), (Some(Ask::Draw(..)), Ask::Draw(..))) {
        queue.pop_back();
    }
    queue.push_back(ask);
}
