//! Writers of the program `liouville`: reports as text, JSON, LaTeX, HTML and pictures.

pub mod report;
