//! What one thread finds, handed to others that work on it.

use rayon::Yield;
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long a worker looks out for more before it goes: a thread that sleeps takes part of this to wake up.
const PATIENCE: Duration = Duration::from_millis(1);

/// Pieces of work in the order in which they were put.
#[derive(Debug)]
pub(super) struct WorkQueue<T> {
    waiting: Mutex<VecDeque<T>>,
    is_closed: AtomicBool,
    workers: AtomicUsize,
    most_workers: usize,
}

impl<T> WorkQueue<T> {
    /// An empty one, for at most so many workers at a time.
    pub fn new(most_workers: usize) -> Self {
        Self {
            waiting: Mutex::default(),
            is_closed: AtomicBool::new(false),
            workers: AtomicUsize::new(0),
            most_workers,
        }
    }

    /// Hands a piece over.
    pub fn put(&self, piece: T) {
        let waiting = self.waiting.lock();
        let mut waiting = waiting.unwrap_or_else(PoisonError::into_inner);
        waiting.push_back(piece);
    }

    /// Says that no more comes.
    pub fn close(&self) {
        self.is_closed.store(true, Ordering::Release);
    }

    /// Whether one more worker is wanted, which is counted then.
    pub fn enter(&self) -> bool {
        let more = |workers| (workers < self.most_workers).then_some(workers + 1);
        let entered = self
            .workers
            .fetch_update(Ordering::AcqRel, Ordering::Acquire, more);
        entered.is_ok()
    }

    /// Does all pieces that come, as one of those who entered. Goes where nothing comes for long, although more may.
    pub fn work(&self, each: impl FnMut(T)) {
        self.finish(each);
        self.workers.fetch_sub(1, Ordering::AcqRel);
    }

    /// Does all pieces that are left, and those that come meanwhile.
    pub fn finish(&self, mut each: impl FnMut(T)) {
        while let Some(piece) = self.take() {
            each(piece);
        }
    }

    /// The next piece; none once it is closed, or after a while.
    fn take(&self) -> Option<T> {
        let mut idle_since = None;
        loop {
            // What was put before it was closed is seen after.
            let is_closed = self.is_closed.load(Ordering::Acquire);
            let waiting = self.waiting.lock();
            let piece = waiting.unwrap_or_else(PoisonError::into_inner).pop_front();
            if piece.is_some() || is_closed {
                return piece;
            }
            // Other parallel work must not wait.
            if rayon::yield_now() == Some(Yield::Executed) {
                idle_since = None;
                continue;
            }
            std::thread::yield_now();
            if idle_since.get_or_insert_with(Instant::now).elapsed() > PATIENCE {
                return None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pieces come slower than patience lasts at times, so that workers go and come again.
    #[test]
    fn every_piece_is_done_once_however_slowly_they_come() {
        for most_workers in 0..4 {
            let work_queue = WorkQueue::new(most_workers);
            let done = Mutex::new(Vec::new());
            let each = |piece: u32| done.lock().expect("no panic").push(piece);
            rayon::scope(|scope| {
                for piece in 0..60 {
                    work_queue.put(piece);
                    if work_queue.enter() {
                        scope.spawn(|_| work_queue.work(each));
                    }
                    if piece % 20 == 0 {
                        std::thread::sleep(PATIENCE * 3);
                    }
                }
                assert!(work_queue.workers.load(Ordering::Acquire) <= most_workers);
                work_queue.close();
                work_queue.finish(each);
            });
            assert_eq!(work_queue.workers.load(Ordering::Acquire), 0);
            let mut done = done.into_inner().expect("no panic");
            done.sort_unstable();
            assert_eq!(done, (0..60).collect::<Vec<u32>>());
        }
    }
}
