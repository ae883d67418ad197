//! Options of jobs that may be done in parts, and the two ways to carry a job out.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use clap::Args;
use liouville::part::Part;

use super::CommandOutput;
use crate::parts::{Job, PartFile, save};

/// Part of a job.
#[derive(Clone, Debug, Default, Args)]
pub struct Share {
    /// Compute part I of N alone, and write it to the folder --out as a file that `liouville merge`
    /// reads. A part that is there already is kept
    #[arg(long, value_name = "I/N", requires = "out")]
    pub part: Option<Part>,
    /// Compute a part again that is there already
    #[arg(long, requires = "part")]
    pub force: bool,
    /// Arguments of the command, without those that differ from part to part.
    #[arg(skip)]
    pub arguments: Vec<String>,
}

impl Share {
    /// Keeps the arguments of the program after its name.
    pub fn keep(&mut self, arguments: &[OsString]) {
        self.arguments = kept(arguments);
    }
}

/// Options that do not change the numbers, and differ from part to part.
const VALUES: [&str; 5] = ["--part", "--out", "--threads", "--within", "--megabytes"];
const FLAGS: [&str; 1] = ["--force"];

/// Arguments of the program after its name, without those that differ from part to part.
fn kept(arguments: &[OsString]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut all = arguments.iter().map(|argument| argument.to_string_lossy().into_owned());
    while let Some(argument) = all.next() {
        let name = argument.split_once('=').map(|(name, _)| name);
        if VALUES.contains(&argument.as_str()) {
            // its value
            all.next();
        } else if !FLAGS.contains(&argument.as_str())
            && !name.is_some_and(|own| VALUES.contains(&own))
        {
            kept.push(argument);
        }
    }
    kept
}

/// Place of the results, and number of threads.
#[derive(Clone, Copy)]
pub struct Target<'t> {
    pub out: Option<&'t Path>,
    pub threads: usize,
}

/// Carries a job out: as a whole, or one part of it.
pub fn carry_out<J: Job>(
    job: &J,
    share: &Share,
    target: Target<'_>,
) -> Result<CommandOutput, String> {
    match (share.part, target.out) {
        (Some(part), Some(folder)) => write_part(job, part, folder, share.force, target.threads),
        _ => job.report(job.compute(Part::WHOLE, target.threads)?),
    }
}

/// Computes a part and writes its file, unless it is there already and whole.
fn write_part<J: Job>(
    job: &J,
    part: Part,
    folder: &Path,
    force: bool,
    threads: usize,
) -> Result<CommandOutput, String> {
    let identity = job.identity()?;
    let wrong = |error: std::io::Error| {
        let shown = folder.display();
        format!("error: cannot write to {shown}: {error}\nhelp: give --out a folder of your own")
    };
    fs::create_dir_all(folder).map_err(wrong)?;
    let name = identity.file_name(part, job.form().ending());
    let known = fs::read_to_string(folder.join(&name));
    if !force && known.is_ok_and(|text| PartFile::read(&text).is_ok()) {
        return Ok(CommandOutput { text: format!("{name}: there\n"), code: 0 });
    }
    let file = job.file(part, threads)?;
    save(folder, &file).map_err(wrong)?;
    let (range, units) = (part.range(identity.units), identity.units);
    let count = range.end - range.start;
    Ok(CommandOutput { text: format!("{name}: {count} of {units} units\n"), code: 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_of_a_part_are_left_out() {
        let given =
            "motion chart a.toml --part 3/4 --x c1=0..1 --out=parts --force --threads 2 --dark";
        let given: Vec<OsString> = given.split(' ').map(OsString::from).collect();
        assert_eq!(kept(&given).join(" "), "motion chart a.toml --x c1=0..1 --dark");
    }
}
