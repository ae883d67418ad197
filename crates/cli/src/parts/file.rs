//! Files of parts: a header and a line for each unit, written whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use liouville::part::Part;
use serde_json::{Map, Value};

use super::identity::{Header, Identity};
use crate::report::sha256;

/// Beginnings of the two forms of files.
const CSV: &str = "# program: \"liouville ";
const JSON: &str = "{\"header\": ";
/// Lines around the units of a JSON file.
const UNITS: &str = "\"units\": [";
const END: &str = "]}";

/// Form of the files of a job.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// Rows below this line of titles.
    Csv(String),
    /// JSON, one unit a line.
    Json,
}

impl Form {
    /// Ending of the files.
    pub fn ending(&self) -> &'static str {
        match self {
            Self::Csv(_) => "csv",
            Self::Json => "json",
        }
    }
}

/// File of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct PartFile {
    /// Name, without the folder.
    pub name: String,
    /// Contents.
    pub text: String,
}

impl PartFile {
    /// File of a part with these lines.
    pub fn new(
        identity: &Identity,
        part: Part,
        form: &Form,
        lines: &[String],
    ) -> Result<Self, String> {
        let mut header = identity.header(part);
        header.digest = digest(&header, form, lines)?;
        let text = match form {
            Form::Csv(titles) => {
                let mut out = String::new();
                for (key, value) in object(&header)? {
                    out.push_str(&format!("# {key}: {value}\n"));
                }
                out.push_str(titles);
                out.push('\n');
                out.extend(lines.iter().flat_map(|line| [line, "\n"]));
                out
            }
            Form::Json => {
                let header = Value::Object(object(&header)?);
                format!("{JSON}{header},\n{UNITS}\n{}\n{END}\n", lines.join(",\n"))
            }
        };
        Ok(Self { name: identity.file_name(part, form.ending()), text })
    }
}

/// Contents of a file that is whole.
#[derive(Clone, Debug, PartialEq)]
pub struct Contents {
    /// First lines.
    pub header: Header,
    /// Form, with the titles of the file.
    pub form: Form,
    /// Lines of the units.
    pub lines: Vec<String>,
}

impl Contents {
    /// Reads a file, and checks that it is whole.
    pub fn read(text: &str) -> Result<Self, String> {
        let (header, form, lines) = match text.starts_with(JSON) {
            true => from_json(text),
            false => from_csv(text),
        }
        .ok_or("it is cut off")?;
        let header: Header =
            serde_json::from_value(Value::Object(header)).map_err(|error| error.to_string())?;
        let lines: Vec<String> = lines.into_iter().map(str::to_string).collect();
        match digest(&header, &form, &lines)? == header.digest {
            true => Ok(Self { header, form, lines }),
            false => Err("its contents do not fit its digest".to_string()),
        }
    }
}

/// Checks that a text is the whole file of a part of a job; otherwise returns the reason.
pub fn check(text: &str, identity: &Identity, part: Part, form: &Form) -> Result<(), String> {
    let found = Contents::read(text)?;
    match found.header.is_of(identity, part) && found.form == *form {
        true => Ok(()),
        false => Err("it is of another job, or another part".to_string()),
    }
}

/// Header, form and lines of a text.
type Raw<'t> = (Map<String, Value>, Form, Vec<&'t str>);

fn object(header: &Header) -> Result<Map<String, Value>, String> {
    match serde_json::to_value(header) {
        Ok(Value::Object(object)) => Ok(object),
        Ok(_) => Err("error: a header is an object".to_string()),
        Err(error) => Err(format!("error: {error}")),
    }
}

fn from_csv(text: &str) -> Option<Raw<'_>> {
    let mut header = Map::new();
    // the last line ends too
    let mut lines = text.strip_suffix('\n')?.split('\n').peekable();
    while let Some(line) = lines.next_if(|line| line.starts_with("# ")) {
        let (key, value) = line.strip_prefix("# ")?.split_once(": ")?;
        header.insert(key.to_string(), serde_json::from_str(value).ok()?);
    }
    let form = Form::Csv(lines.next()?.to_string());
    Some((header, form, lines.collect()))
}

fn from_json(text: &str) -> Option<Raw<'_>> {
    let mut lines = text.strip_suffix('\n')?.split('\n');
    let header = lines.next()?.strip_prefix(JSON)?.strip_suffix(',')?;
    let header = serde_json::from_str(header).ok()?;
    let is_framed = lines.next() == Some(UNITS) && lines.next_back() == Some(END);
    let lines: Vec<&str> = lines.collect();
    let units = lines.into_iter().map(|line| line.strip_suffix(',').unwrap_or(line));
    is_framed.then(|| (header, Form::Json, units.filter(|line| !line.is_empty()).collect()))
}

/// Digest of a header, but for the digest in it, of the titles, and of all lines.
fn digest(header: &Header, form: &Form, lines: &[String]) -> Result<String, String> {
    let header = Header { digest: String::new(), ..header.clone() };
    let header = Value::Object(object(&header)?).to_string();
    let titles = match form {
        Form::Csv(titles) => titles,
        Form::Json => "",
    };
    Ok(format!("sha256:{}", sha256(&[&header, titles, &lines.join("\n")].join("\n"))))
}

/// Whether a text is that of a part, whole or not.
pub fn is_part(text: &str) -> bool {
    text.starts_with(CSV) || text.starts_with(JSON)
}

/// Writes a file whole or not at all: under another name, then synced, then renamed.
pub fn save(folder: &Path, file: &PartFile) -> io::Result<()> {
    save_by(folder, &file.name, |out| out.write_all(file.text.as_bytes()))
}

fn save_by(
    folder: &Path,
    name: &str,
    fill: impl FnOnce(&mut File) -> io::Result<()>,
) -> io::Result<()> {
    // machines that share a folder may have processes of the same number
    let now = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_nanos());
    let new = folder.join(format!(".{name}.{}-{now}.tmp", std::process::id()));
    let filled = File::create_new(&new).and_then(|mut out| {
        fill(&mut out)?;
        out.sync_all()
    });
    let done = filled.and_then(|()| fs::rename(&new, folder.join(name)));
    match done {
        // the name is kept by the folder; not every system can sync one
        Ok(()) => _ = File::open(folder).and_then(|folder| folder.sync_all()),
        Err(_) => _ = fs::remove_file(&new),
    }
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity() -> Identity {
        Identity {
            job: "chart",
            units: 2,
            seed: 1,
            request: "x from 0 to 1".to_string(),
            arguments: vec!["motion".to_string(), "chart".to_string()],
            name: "a.toml".to_string(),
            settings: Vec::new(),
            case: "title = \"a\"\n# a comment\n".to_string(),
        }
    }

    fn files() -> Vec<PartFile> {
        let lines = ["{\"a\":1}", "{\"a\":[2,3]}"].map(str::to_string);
        let forms = [Form::Csv("a,b".to_string()), Form::Json];
        forms.iter().map(|form| file(form, &lines)).collect()
    }

    fn file(form: &Form, lines: &[String]) -> PartFile {
        PartFile::new(&identity(), Part::WHOLE, form, lines).expect("a file")
    }

    #[test]
    fn files_are_read_as_they_were_written() {
        for file in files() {
            let Contents { header, lines, .. } = Contents::read(&file.text).expect("it is whole");
            assert_eq!((header.case.as_str(), header.part), (identity().case.as_str(), 1));
            assert_eq!(lines, ["{\"a\":1}", "{\"a\":[2,3]}"]);
            assert!(
                is_part(&file.text)
                    && file.name.starts_with(&format!("chart-{}-0001-of-0001.", identity().key()))
            );
        }
        for form in [Form::Csv("a,b".to_string()), Form::Json] {
            let whole = Contents::read(&file(&form, &[]).text).expect("it is whole");
            assert!(whole.lines.is_empty(), "a part may have no units");
            assert_eq!(whole.form, form);
        }
    }

    #[test]
    fn what_is_cut_off_or_changed_is_no_part() {
        for PartFile { text, .. } in files() {
            for end in (0..text.len()).filter(|end| text.is_char_boundary(*end)) {
                assert!(Contents::read(&text[..end]).is_err(), "{}", &text[..end]);
            }
            for (old, new) in [("[2,3]", "[2,4]"), ("from 0", "from 1"), ("a.toml", "b.toml")] {
                assert!(Contents::read(&text.replace(old, new)).is_err(), "{old}");
            }
        }
        let file = file(&Form::Csv("a,b".to_string()), &["1,2".to_string()]);
        assert!(Contents::read(&file.text.replace("a,b", "b,a")).is_err(), "other titles");
    }

    #[test]
    fn headers_belong_to_one_part_of_one_job() {
        let part = |index, count| Part::new(index, count).expect("a part");
        let header = identity().header(part(2, 3));
        assert!(header.is_of(&identity(), part(2, 3)));
        assert!(!header.is_of(&identity(), part(1, 3)), "another part");
        assert!(!header.is_of(&identity(), part(2, 4)), "another number of parts");
        assert!(!header.is_of(&Identity { seed: 2, ..identity() }, part(2, 3)), "another job");
        let arguments = vec!["--dark".to_string()];
        assert!(header.is_of(&Identity { arguments, ..identity() }, part(2, 3)), "style aside");
        let forged = Header { seed: 2, ..header };
        assert!(!forged.is_of(&identity(), part(2, 3)), "a key alone is not enough");
    }

    #[test]
    fn keys_depend_on_all_that_numbers_depend_on() {
        let key = identity().key();
        let change = |change: &dyn Fn(&mut Identity)| {
            let mut other = identity();
            change(&mut other);
            other.key()
        };
        assert_ne!(key, change(&|own| own.seed = 2));
        assert_ne!(key, change(&|own| own.units = 3));
        assert_ne!(key, change(&|own| own.request.push('0')));
        assert_ne!(key, change(&|own| own.case.push('\n')));
        assert_ne!(key, change(&|own| own.settings.push("m=1".to_string())));
        assert_eq!(key, change(&|own| own.arguments.push("--dark".to_string())), "style aside");
        assert_eq!(key.len(), 16);
    }

    #[test]
    fn an_interrupted_write_leaves_no_part() {
        let folder = std::env::temp_dir().join(format!("liouville-parts-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        let full = |out: &mut File| {
            out.write_all(b"half of it")?;
            Err(io::Error::from(io::ErrorKind::StorageFull))
        };
        assert!(save_by(&folder, "part.csv", full).is_err());
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 0, "nothing is left");
        let seen = |out: &mut File| {
            assert!(!folder.join("part.csv").exists(), "it has no name before it is whole");
            out.write_all(b"all of it")
        };
        save_by(&folder, "part.csv", seen).expect("it is written");
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
        fs::remove_dir_all(&folder).expect("a folder");
    }
}
