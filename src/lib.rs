//! liouville
pub mod case;
pub mod claim;
pub mod formula;
pub mod graph;
pub mod mechanics;
pub mod number;
pub mod report;
pub mod scalar;
pub mod verdict;
