//! Tests of the program, one module a subject.

mod absence;
mod bench;
mod certificates;
mod commands;
#[path = "../../../../tests/common/mod.rs"]
mod common;
mod corpus;
mod documents;
mod export;
mod integrable;
mod maps;
mod memory;
mod mistakes;
mod report;
mod restrictions;
#[path = "../common/values.rs"]
mod values;
