//! Many motions on several threads, several side by side in the lanes of each.
//!
//! A motion that is done gives its lane to the next one that nobody has taken. Lanes do not know of
//! each other, so that results do not depend on how motions meet lanes and threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Motions side by side.
pub const LANES: usize = 8;
/// Fewer motions than that are faster one by one.
const FEW: usize = 4;

/// The motions that nobody has taken yet.
pub struct Queue {
    next: AtomicUsize,
    count: usize,
}

impl Queue {
    /// The index of the next motion.
    pub fn take(&self) -> Option<usize> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.count).then_some(index)
    }
}

/// How the motions of a swarm are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Abreast {
    /// One at a time.
    One,
    /// `LANES` of them.
    Lanes,
}

/// Runs a worker on each thread until the queue is empty; gives the results in the order of the motions.
pub fn swarm<R: Send>(
    count: usize,
    threads: usize,
    worker: impl Fn(&Queue, Abreast) -> Vec<(usize, R)> + Sync,
) -> Vec<R> {
    let abreast = if count < FEW { Abreast::One } else { Abreast::Lanes };
    let width = if abreast == Abreast::One { 1 } else { LANES };
    let queue = Queue { next: AtomicUsize::new(0), count };
    let done = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, count.div_ceil(width).max(1)) {
            scope.spawn(|| {
                let own = worker(&queue, abreast);
                done.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).extend(own);
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}
