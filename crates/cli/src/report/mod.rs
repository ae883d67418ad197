//! Reports of the program: verdicts as a table, as the papers' tables, pictures, code in other
//! languages. What needs no terminal is in `liouville-report`.

pub mod basins;
pub mod bench;
pub mod bifurcations;
pub mod bodies;
pub mod branch;
pub mod certificate;
mod certificate_part;
pub mod chart;
pub mod cycle;
pub mod data;
pub mod diagram;
pub mod exponents;
pub mod export;
pub mod facts;
pub mod growth;
mod hexadecimal;
mod horseshoe_certificate;
pub mod iterates;
pub mod map_points;
pub mod motion_certificate;
pub mod orbit;
pub mod point;
pub mod rotation;
pub mod section;
pub mod stress;
pub mod surface;
pub mod survey;
pub mod sweep;
pub mod table;
pub mod terminal;
mod unique_keys;

pub use liouville_report::{
    CaseDigest, FileFailure, FileOutcome, Heading, RunReport, Summary, VERSION, VerdictTable,
    counted, diagnostic, json, names, records, search, sha256,
};
use liouville_report::{evidence, typeset};
