//! Threads that commands compute on.

use rayon::{ThreadPool, ThreadPoolBuilder};

/// Stack of each thread; formulas nest, and what follows them does.
const STACK: usize = 16 << 20;

/// Starts a number of threads; 0 stands for all cores.
pub fn pool(threads: usize) -> Result<ThreadPool, String> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build();
    pool.map_err(|error| {
        format!("error: cannot start threads: {error}\nhelp: ask for fewer with --threads")
    })
}
