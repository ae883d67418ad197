//! Complete sets of parts: none missing, none twice, none of another job.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use liouville_catalogue::inside;

use super::file::{Contents, Form, PartFile, is_part};
use super::identity::{Header, program};
use crate::source::is_standard_input;

/// Parts by their numbers, each with the name of its file and its contents.
type Parts<'f> = BTreeMap<u64, (&'f str, Contents)>;
/// Parts by the key of their job and the number of its parts.
type Jobs<'f> = BTreeMap<(String, u64), Parts<'f>>;

/// All lines of a job, in the order of its units.
#[derive(Clone, Debug)]
pub struct Set {
    /// Header of the first part.
    pub header: Header,
    /// Form of the files.
    pub form: Form,
    /// Lines of all parts.
    pub lines: Vec<String>,
}

/// Reads the parts in a folder, by their names and texts. Other files are passed over.
pub fn from_folder(folder: &Path) -> Result<Vec<PartFile>, String> {
    let shown = folder.display();
    let wrong = |error: std::io::Error| {
        let help = "give the folder in which --out of the commands with --part wrote parts";
        format!("error: cannot read {shown}: {error}\nhelp: {help}")
    };
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(wrong)? {
        let path = entry.map_err(wrong)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_data = path.extension().is_some_and(|ending| ending == "csv" || ending == "json");
        if !is_data || name.starts_with('.') {
            continue;
        }
        let bytes = fs::read(&path)
            .map_err(|error| format!("error: cannot read {}: {error}", path.display()))?;
        let text = String::from_utf8_lossy(&bytes).into_owned();
        if is_part(&text) || is_named(&name) {
            found.push(PartFile { name, text });
        }
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    match found.is_empty() {
        true => Err(format!(
            "error: {shown} has no parts\nhelp: run jobs with --part I/N --out {shown}"
        )),
        false => Ok(found),
    }
}

/// Whether a file has the name of a part: `JOB-KEY-0003-of-0040.csv`.
fn is_named(name: &str) -> bool {
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let words: Vec<&str> = stem.rsplit('-').collect();
    let is_number = |word: &str| word.len() >= 4 && word.bytes().all(|c| c.is_ascii_digit());
    matches!(&words[..], [count, "of", index, key, _, ..]
        if is_number(count) && is_number(index) && key.len() == 16)
}

impl Set {
    /// Puts parts together. `folder` is where missing ones belong.
    pub fn new(files: &[PartFile], folder: &str) -> Result<Self, String> {
        let mut jobs: Jobs<'_> = BTreeMap::new();
        for PartFile { name, text } in files {
            let contents = Contents::read(text).map_err(|reason| {
                format!(
                    "error: {name} is damaged: {reason}\n\
                     help: remove it, and compute its part again"
                )
            })?;
            let header = &contents.header;
            if header.program != program() {
                return Err(format!(
                    "error: {name} is of {}, and this is {}\n\
                     help: merge parts with the program that computed them",
                    header.program,
                    program()
                ));
            }
            let own = jobs.entry((header.key.clone(), header.of)).or_default();
            let part = header.part;
            if let Some((other, _)) = own.insert(part, (name, contents)) {
                return Err(format!(
                    "error: part {part} is there twice: {other} and {name}\nhelp: remove one of them"
                ));
            }
        }
        if jobs.len() > 1 {
            return Err(foreign(&jobs));
        }
        let Some((_, parts)) = jobs.into_iter().next() else {
            return Err("error: there are no parts".to_string());
        };
        let Some((first, Contents { header, form, .. })) = parts.values().next().cloned() else {
            return Err("error: there are no parts".to_string());
        };
        if let Some((other, _)) = parts.values().find(|(_, own)| own.form != form) {
            return Err(format!(
                "error: {other} has other columns than {first}\n\
                 help: remove it, and compute its part again"
            ));
        }
        let missing: BTreeSet<u64> =
            (1..=header.of).filter(|part| !parts.contains_key(part)).collect();
        if let Some(first) = missing.first() {
            let (count, of) = (missing.len(), header.of);
            let are = if count == 1 { "is" } else { "are" };
            let others = if count == 1 { "" } else { "\ncompute the other parts in the same way" };
            let away = away(&header.inputs());
            return Err(format!(
                "error: {count} of {of} parts {are} missing: {}\nhelp: {}{others}{away}",
                ranges(&missing),
                header.command(*first, folder)
            ));
        }
        let lines = parts.into_values().flat_map(|(_, own)| own.lines).collect();
        Ok(Self { header, form, lines })
    }
}

/// Remark on the files that a command reads and that are not here, where there are any.
fn away(inputs: &[String]) -> String {
    let is_here = |name: &String| {
        let path = Path::new(name);
        path.exists() || is_standard_input(path) || !inside(path).is_empty()
    };
    let away: Vec<&str> = inputs.iter().filter(|name| !is_here(name)).map(String::as_str).collect();
    let are = match away.len() {
        0 => return String::new(),
        1 => "is",
        _ => "are",
    };
    format!(
        "\n{} {are} not here: run the command where the first parts were computed; for parts of a \
         call in Python repeat the call, with the same `out` and number of parts",
        away.join(" and ")
    )
}

/// Message about parts of several jobs.
fn foreign(jobs: &Jobs<'_>) -> String {
    let mut out = "error: the parts are not of one job".to_string();
    for ((key, of), parts) in jobs {
        let names = parts.values().next().map(|(name, own)| (*name, own.header.job.as_str()));
        let (name, job) = names.unwrap_or_default();
        let count = parts.len();
        out.push_str(&format!("\n  {count} of {of} of {job} {key}, such as {name}"));
    }
    out + "\nhelp: move the parts of each job to a folder of their own"
}

/// Numbers as ranges: `1-3, 7`.
fn ranges(numbers: &BTreeSet<u64>) -> String {
    let mut found: Vec<(u64, u64)> = Vec::new();
    for number in numbers {
        match found.last_mut() {
            Some((_, end)) if *end + 1 == *number => *end = *number,
            _ => found.push((*number, *number)),
        }
    }
    let shown = found.iter().map(|(from, to)| match from == to {
        true => from.to_string(),
        false => format!("{from}-{to}"),
    });
    shown.collect::<Vec<_>>().join(", ")
}
