//! Functions that the page calls.
#![allow(unsafe_code, reason = "exported names are unsafe attributes; there is no unsafe block")]

use std::panic;
use std::sync::{Mutex, MutexGuard, Once};

use crate::answer::answered;

/// Request that the page writes.
static INPUT: Mutex<Vec<u8>> = Mutex::new(Vec::new());
/// Answer that the page reads.
static OUTPUT: Mutex<Vec<u8>> = Mutex::new(Vec::new());
/// Setting of the hook that keeps the message of a failure.
static HOOK: Once = Once::new();

fn locked(bytes: &Mutex<Vec<u8>>) -> MutexGuard<'_, Vec<u8>> {
    bytes.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Makes room for a request of this length, and returns its place.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    let mut bytes = locked(&INPUT);
    bytes.clear();
    bytes.resize(length, 0);
    bytes.as_mut_ptr()
}

/// Answers the request, and returns the length of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn call() -> usize {
    HOOK.call_once(|| {
        panic::set_hook(Box::new(|fault| *locked(&OUTPUT) = fault.to_string().into_bytes()));
    });
    let request = std::mem::take(&mut *locked(&INPUT));
    locked(&OUTPUT).clear();
    let answer = answered(&request).into_bytes();
    let length = answer.len();
    *locked(&OUTPUT) = answer;
    length
}

/// Returns the length of the answer, or of the message of a failure.
#[unsafe(no_mangle)]
pub extern "C" fn length() -> usize {
    locked(&OUTPUT).len()
}

/// Returns the place of the answer, or of the message of a failure.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    locked(&OUTPUT).as_ptr()
}
