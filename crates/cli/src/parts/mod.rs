//! Jobs in parts: each part of a job's units is a file, and the files of all parts are merged to
//! what the job gives in one run.
//!
//! ```text
//! job ─ Part ─▶ units ─ lines ─▶ file  JOB-KEY-0003-of-0040.csv  ─▶ Set ─▶ units ─▶ report
//! ```

mod file;
mod identity;
mod set;

pub use file::{Contents, Form, PartFile, check, is_part, save};
pub use identity::{Header, Identity};
pub use set::{Set, from_folder};

use liouville::part::Part;

use crate::answer::CommandOutput;

/// Work that can be done in parts.
pub trait Job {
    /// Result of a unit; of several units, where the job combines them.
    type Unit;

    /// Identity of the job, by which parts belong together.
    fn identity(&self) -> Result<Identity, String>;

    /// Form of the files of parts.
    fn form(&self) -> Form;

    /// Computes the units of a part.
    fn compute(&self, part: Part, threads: usize) -> Result<Vec<Self::Unit>, String>;

    /// Line of the unit at a place among all units.
    fn line(&self, place: u64, unit: &Self::Unit) -> Result<String, String>;

    /// Unit of a line.
    fn unit(&self, line: &str) -> Result<Self::Unit, String>;

    /// Reports all units, and writes the file of `--out`.
    fn report(&self, units: Vec<Self::Unit>) -> Result<CommandOutput, String>;

    /// Computes a part as a file.
    fn file(&self, part: Part, threads: usize) -> Result<PartFile, String> {
        let identity = self.identity()?;
        let first = part.range(identity.units).start;
        let units = self.compute(part, threads)?;
        let lines = units.iter().zip(first..).map(|(unit, place)| self.line(place, unit));
        let lines = lines.collect::<Result<Vec<String>, String>>()?;
        PartFile::new(&identity, part, &self.form(), &lines)
    }

    /// Reads the units of all parts.
    fn units(&self, set: &Set) -> Result<Vec<Self::Unit>, String> {
        if set.form != self.form() {
            return Err("error: the parts have other columns than the job\n\
                        help: compute them again with --force"
                .to_string());
        }
        set.lines.iter().map(|line| self.unit(line)).collect()
    }
}

/// Line of a unit as JSON.
pub fn json_line(unit: &impl serde::Serialize) -> Result<String, String> {
    serde_json::to_string(unit).map_err(|error| format!("error: cannot write the part: {error}"))
}

/// Unit of a line of JSON.
pub fn json_unit<U: serde::de::DeserializeOwned>(line: &str) -> Result<U, String> {
    serde_json::from_str(line).map_err(|error| format!("error: a part has a wrong line: {error}"))
}
