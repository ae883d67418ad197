//! Identity of a job: everything that its numbers depend on, with a key made of it.

use liouville::part::Part;
use liouville_report::evidence::shell_quoted;
use serde::{Deserialize, Serialize};

use crate::report::{VERSION, sha256};

/// Number of hexadecimal digits of a key.
const DIGITS: usize = 16;

/// Job with everything that its numbers depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct Identity {
    /// Name of the job, such as `chart`.
    pub job: &'static str,
    /// Number of units.
    pub units: u64,
    /// Seed of all random draws.
    pub seed: u64,
    /// Request, without the case and the seed.
    pub request: String,
    /// Arguments of the command, without those that differ from part to part.
    pub arguments: Vec<String>,
    /// Name of the case, for messages.
    pub name: String,
    /// Values of `--set`, sorted.
    pub settings: Vec<String>,
    /// Text of the case.
    pub case: String,
}

/// First lines of a part's file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// Program with its version.
    pub program: String,
    /// Name of the job.
    pub job: String,
    /// Key of the job.
    pub key: String,
    /// Number of the part, from 1.
    pub part: u64,
    /// Number of parts.
    pub of: u64,
    /// Number of units of the job.
    pub units: u64,
    /// Seed of all random draws.
    pub seed: u64,
    /// Request, without the case and the seed.
    pub request: String,
    /// Arguments of the command.
    pub arguments: Vec<String>,
    /// Name of the case.
    pub name: String,
    /// Values of `--set`.
    pub settings: Vec<String>,
    /// Text of the case.
    pub case: String,
    /// SHA-256 of the header and of all lines.
    pub digest: String,
}

/// Program with its version.
pub(super) fn program() -> String {
    format!("liouville {VERSION}")
}

impl Identity {
    /// Key: the first digits of a digest over version, job, case, settings, request and seed.
    pub fn key(&self) -> String {
        let (seed, units) = (self.seed.to_string(), self.units.to_string());
        let first = [&program(), self.job, &self.case, &self.request, &seed, &units];
        let settings = self.settings.iter().map(String::as_str);
        let parts: Vec<&str> = first.into_iter().chain(settings).collect();
        // lengths in front, so that no two lists of texts look the same
        let whole: String = parts.iter().map(|part| format!("{} {part}\n", part.len())).collect();
        sha256(&whole).chars().take(DIGITS).collect()
    }

    /// Name of a part's file.
    pub fn file_name(&self, part: Part, ending: &str) -> String {
        let (index, count) = (part.index(), part.count());
        format!("{}-{}-{index:04}-of-{count:04}.{ending}", self.job, self.key())
    }

    /// Header of a part, without its digest.
    pub(super) fn header(&self, part: Part) -> Header {
        Header {
            program: program(),
            job: self.job.to_string(),
            key: self.key(),
            part: part.index(),
            of: part.count(),
            units: self.units,
            seed: self.seed,
            request: self.request.clone(),
            arguments: self.arguments.clone(),
            name: self.name.clone(),
            settings: self.settings.clone(),
            case: self.case.clone(),
            digest: String::new(),
        }
    }
}

/// Options that name a file which the command reads.
const TABLES: [&str; 2] = ["--starts", "--settings"];

impl Header {
    /// Whether this is the header of a part of a job, style aside.
    pub fn is_of(&self, identity: &Identity, part: Part) -> bool {
        let Self { arguments, name, digest, .. } = self.clone();
        Self { arguments, name, digest, ..identity.header(part) } == *self
    }

    /// Files that the command reads: the case, and tables of starts or of bodies.
    pub fn inputs(&self) -> Vec<String> {
        let mut found = vec![self.name.clone()];
        let mut words = self.arguments.iter();
        while let Some(word) = words.next() {
            let (option, value) = match word.split_once('=') {
                Some((option, value)) => (option, Some(value.to_string())),
                None => (word.as_str(), None),
            };
            if TABLES.contains(&option) {
                found.extend(value.or_else(|| words.next().cloned()));
            }
        }
        found
    }

    /// Command that computes a part.
    pub fn command(&self, part: u64, folder: &str) -> String {
        let arguments = self.arguments.iter().map(|argument| shell_quoted(argument));
        let arguments: Vec<String> = arguments.collect();
        let (folder, of) = (shell_quoted(folder), self.of);
        format!("liouville {} --part {part}/{of} --out {folder}", arguments.join(" "))
    }
}
