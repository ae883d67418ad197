//! Options that change the report of a job and not its numbers: `merge` takes them.

use super::explore::ink::Ink;

const JSON: &[&str] = &["--json"];
const FORMAT: &[&str] = &["--format"];

/// Names of options that change the report of a job and not its numbers.
pub struct Styles {
    /// Those with a value.
    pub valued: &'static [&'static [&'static str]],
    /// Those without.
    pub flags: &'static [&'static [&'static str]],
}

impl Styles {
    /// Options of a job by its name.
    pub fn of(job: &str) -> Self {
        match job {
            "chart" => Self { valued: &[Ink::VALUED, &["--colour"]], flags: &[Ink::FLAGS, JSON] },
            "section" => Self {
                valued: &[Ink::VALUED, &["--colour", "--lines", "--images", "--separatrices"]],
                flags: &[Ink::FLAGS, JSON, &["--shade", "--no-marks"]],
            },
            "check" => Self { valued: &[FORMAT], flags: &[JSON, &["--quiet"]] },
            "report" => Self { valued: &[FORMAT], flags: &[JSON] },
            _ => Self { valued: &[], flags: &[JSON] },
        }
    }

    /// All names.
    pub fn names(&self) -> Vec<&'static str> {
        self.valued.iter().chain(self.flags).flat_map(|names| names.iter().copied()).collect()
    }

    fn has_value(&self, name: &str) -> bool {
        self.valued.iter().any(|names| names.contains(&name))
    }

    /// Checks that words are options of the report, with their values.
    pub fn check(&self, words: &[String]) -> Result<(), String> {
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let name = word.split('=').next().unwrap_or_default();
            if !self.names().contains(&name) {
                return Err(format!(
                    "error: the report has no option {word}\nhelp: after -- write any of {}",
                    self.names().join(", ")
                ));
            }
            if self.has_value(name) && name == word && words.next().is_none() {
                return Err(format!("error: {name} has no value\nhelp: write one after it"));
            }
        }
        Ok(())
    }

    /// Arguments of a job with these options of the report: of two formats the later one counts.
    pub fn applied(&self, arguments: &[String], words: &[String]) -> Vec<String> {
        let is_format = |word: &str| {
            [JSON, FORMAT].concat().contains(&word.split('=').next().unwrap_or_default())
        };
        let has_format = words.iter().any(|word| is_format(word));
        let mut kept = Vec::new();
        let mut old = arguments.iter();
        while let Some(word) = old.next() {
            if !has_format || !is_format(word) {
                kept.push(word.clone());
            } else if FORMAT.contains(&word.as_str()) {
                // its value
                old.next();
            }
        }
        kept.extend(words.iter().cloned());
        kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::commands::Arguments;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_string).collect()
    }

    #[test]
    fn styles_are_options_of_their_commands() {
        for path in
            ["check", "report", "sweep", "motion chart", "motion section", "motion exponents"]
        {
            let mut command = Arguments::described();
            for name in path.split(' ') {
                command = command.find_subcommand(name).expect("a command").clone();
            }
            let styles = Styles::of(path.split(' ').next_back().expect("a name"));
            for name in styles.names() {
                let option = command
                    .get_arguments()
                    .find(|own| own.get_long() == name.strip_prefix("--"))
                    .unwrap_or_else(|| panic!("{path} has no {name}"));
                let takes = option.get_action().takes_values();
                assert_eq!(takes, styles.has_value(name), "{path} {name}");
            }
        }
    }

    #[test]
    fn each_job_has_its_own_styles() {
        let check = |job: &str, text: &str| Styles::of(job).check(&words(text));
        assert!(check("chart", "--colour exponent --width=85 --dark").is_ok());
        assert!(check("section", "--colour one --shade").is_ok());
        assert!(check("check", "--format csv --quiet").is_ok());
        for (job, text) in [
            ("chart", "extra.toml"),
            ("chart", "--dark extra.toml"),
            ("chart", "--time 5"),
            ("chart", "--shade"),
            ("chart", "--colour"),
            ("sweep", "--format csv"),
            ("report", "--quiet"),
            ("exponents", "--dark"),
        ] {
            assert!(check(job, text).is_err(), "{job} {text}");
        }
    }

    #[test]
    fn a_format_takes_the_place_of_another() {
        let applied =
            |old: &str, new: &str| Styles::of("check").applied(&words(old), &words(new)).join(" ");
        let old = "check a.toml --settings b.csv --json";
        assert_eq!(applied(old, "--format csv"), "check a.toml --settings b.csv --format csv");
        assert_eq!(applied("check a.toml --format csv", "--json"), "check a.toml --json");
        assert_eq!(applied(old, "--quiet"), format!("{old} --quiet"), "no other format");
    }
}
