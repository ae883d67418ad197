//! The program `liouville` as a library: its command line, and the writers of its reports as text,
//! JSON, LaTeX, HTML and pictures.

mod answer;
mod commands;
pub mod parts;
pub mod report;
pub mod source;

pub use commands::{answers, jobs, run};
