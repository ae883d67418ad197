//! Options of jobs that may be done in parts, and the two ways to carry a job out.

use std::ffi::OsString;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use clap::Args;
use liouville::part::Part;

use super::CommandOutput;
use crate::parts::{Form, Identity, Job, check, save};

/// Part of a job.
#[derive(Clone, Debug, Default, Args)]
pub struct Share {
    /// Compute part I of N alone, and write it to the folder --out as a file that `liouville merge`
    /// reads. An existing part is kept
    #[arg(long, value_name = "I/N", requires = "out")]
    pub part: Option<Part>,
    /// Compute the part even if it exists
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

    /// Remedy where the job was stopped: what was reached is kept in parts alone.
    pub fn remedy(&self) -> String {
        match self.part {
            None => {
                "allow more, or compute it in parts, which are kept: --part 1/100 --out parts/ \
                     up to --part 100/100, then `liouville merge parts`"
                    .to_string()
            }
            Some(part) => {
                format!("allow more, or compute more parts than {}: each takes less", part.count())
            }
        }
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
    let form = job.form();
    let name = identity.file_name(part, form.ending());
    if !force {
        match known(&folder.join(&name), &identity, part, &form)? {
            Known::Missing => {}
            Known::Whole => {
                return Ok(CommandOutput { text: format!("{name}: there\n"), code: 0 });
            }
            Known::Other(reason) => {
                anstream::eprintln!("warning: {name} is computed again: {reason}");
            }
        }
    }
    let file = job.file(part, threads)?;
    save(folder, &file).map_err(wrong)?;
    let (range, units) = (part.range(identity.units), identity.units);
    let count = range.end - range.start;
    Ok(CommandOutput { text: format!("{name}: {count} of {units} units\n"), code: 0 })
}

/// Contents of a file under the name of a part.
enum Known {
    /// Nothing.
    Missing,
    /// The part.
    Whole,
    /// Something else, for this reason.
    Other(String),
}

/// Looks whether a part is there.
fn known(path: &Path, identity: &Identity, part: Part, form: &Form) -> Result<Known, String> {
    match fs::read_to_string(path) {
        Ok(text) => {
            let own = check(&text, identity, part, form);
            Ok(own.map_or_else(Known::Other, |()| Known::Whole))
        }
        Err(error) => match error.kind() {
            ErrorKind::NotFound => Ok(Known::Missing),
            ErrorKind::InvalidData => Ok(Known::Other("it is not a text file".to_string())),
            _ => {
                let shown = path.display();
                Err(format!("error: cannot read {shown}: {error}\nhelp: remove it"))
            }
        },
    }
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
