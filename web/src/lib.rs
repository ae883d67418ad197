//! The verifier for a browser: one call takes a request and returns an answer, both JSON in UTF-8,
//! through the memory of the module.
//!
//! ```text
//! input(length) ─▶ place for the request
//! call()        ─▶ length of the answer
//! output()      ─▶ place of the answer
//! ```
//!
//! If the program fails, the call traps, and the output is the message. The module then has to be
//! made anew.

mod answer;
mod doors;
mod page;
mod request;
