//! Memory that pieces of work share which are under way at the same time.

use std::sync::{Condvar, Mutex, PoisonError};

/// A limit on the memory of pieces of work.
///
/// A piece that needs more than is left waits for others; one that is alone is always let in, so that the
/// limit is that of one piece, if this is larger. Pieces must not wait for each other in other ways.
pub struct Room {
    most: u64,
    taken: Mutex<u64>,
    freed: Condvar,
}

impl Room {
    /// Makes room for so many bytes.
    pub fn new(most: u64) -> Self {
        Self { most, taken: Mutex::new(0), freed: Condvar::new() }
    }

    /// Runs a piece of work that needs so many bytes, when there is room.
    pub fn run<T>(&self, bytes: u64, work: impl FnOnce() -> T) -> T {
        let _share = self.enter(bytes);
        work()
    }

    fn enter(&self, bytes: u64) -> Share<'_> {
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        while *taken > 0 && taken.saturating_add(bytes) > self.most {
            taken = self.freed.wait(taken).unwrap_or_else(PoisonError::into_inner);
        }
        *taken += bytes;
        Share { room: self, bytes }
    }
}

/// The memory of a piece of work, which is given back when it ends.
struct Share<'r> {
    room: &'r Room,
    bytes: u64,
}

impl Drop for Share<'_> {
    fn drop(&mut self) {
        *self.room.taken.lock().unwrap_or_else(PoisonError::into_inner) -= self.bytes;
        self.room.freed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::thread::{scope, yield_now};

    use super::*;

    /// Most bytes that pieces had at the same time.
    fn most_at_a_time(limit: u64, pieces: &[u64]) -> u64 {
        let (room, now, most) = (Room::new(limit), AtomicU64::new(0), AtomicU64::new(0));
        let piece = |bytes: u64| {
            room.run(bytes, || {
                let sum = bytes + now.fetch_add(bytes, Ordering::SeqCst);
                most.fetch_max(sum, Ordering::SeqCst);
                (0..50).for_each(|_| yield_now());
                now.fetch_sub(bytes, Ordering::SeqCst);
            });
        };
        scope(|threads| {
            for bytes in pieces {
                threads.spawn(|| piece(*bytes));
            }
        });
        assert_eq!(now.into_inner(), 0, "all are done");
        most.into_inner()
    }

    #[test]
    fn pieces_wait_for_memory() {
        let pieces: Vec<u64> = (0..40).map(|k| 1 + k % 7).collect();
        assert!(most_at_a_time(10, &pieces) <= 10);
        assert_eq!(most_at_a_time(10, &[30, 20, 30]), 30, "larger ones run alone");
        assert_eq!(most_at_a_time(0, &[1, 1, 1, 1]), 1, "one after another");
    }
}
