//! Many motions on several threads, several in the lanes of each.
//!
//! A motion that is done gives its lane to the next one in the queue. Lanes are independent, so
//! that results do not depend on the assignment of motions to lanes and threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use liouville::order::StableOrder;

use crate::halt::Halt;

/// Number of motions in the lanes of one thread.
pub const MOTION_LANES: usize = 8;
/// Number of motions below which one at a time is faster.
const FEW: usize = 3;

/// Queue of the motions not yet taken.
pub struct Queue {
    next: AtomicUsize,
    count: usize,
}

impl Queue {
    /// Takes the index of the next motion.
    pub fn take(&self) -> Option<usize> {
        let index = self.next.fetch_add(1, Ordering::Relaxed);
        (index < self.count).then_some(index)
    }
}

/// Number of motions that a thread follows at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lockstep {
    /// One motion.
    One,
    /// `MOTION_LANES` motions.
    Lanes,
}

/// Runs a worker on each thread until the queue is empty. Returns the results in the order of the
/// motions.
pub fn in_batches<R: Send>(
    count: usize,
    threads: usize,
    worker: impl Fn(&Queue, Lockstep) -> Vec<(usize, R)> + Sync,
) -> Vec<R> {
    let lockstep = if count < FEW { Lockstep::One } else { Lockstep::Lanes };
    let width = if lockstep == Lockstep::One { 1 } else { MOTION_LANES };
    let queue = Queue { next: AtomicUsize::new(0), count };
    let most = count.div_ceil(width);
    collected(threads.clamp(1, most.max(1)), &|| worker(&queue, lockstep))
}

/// Runs a job for each index, the next one on the first thread that is free. Returns the results in
/// order.
pub fn each<R: Send>(count: usize, threads: usize, job: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    let queue = Queue { next: AtomicUsize::new(0), count };
    collected(threads.clamp(1, count.max(1)), &|| {
        std::iter::from_fn(|| queue.take()).map(|index| (index, job(index))).collect()
    })
}

/// Runs the work on each thread, and returns all results in the order of their indices. One thread
/// is the calling one: where there are no others, as in a browser, motions are followed all the
/// same.
fn collected<R: Send>(threads: usize, work: &(dyn Fn() -> Vec<(usize, R)> + Sync)) -> Vec<R> {
    let mut done = match threads {
        1 => work(),
        _ => {
            let done = Mutex::new(Vec::new());
            let halt = Halt::current();
            std::thread::scope(|scope| {
                for _ in 0..threads {
                    scope.spawn(|| {
                        let own = halt.clone().over(work);
                        done.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).extend(own);
                    });
                }
            });
            done.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner())
        }
    };
    done.order_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}
