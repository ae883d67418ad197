//! Command lines for the program `liouville`, drawn from the options that its help lists.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::Outcome;
use crate::mutation::Random;

/// Time that a command line may take; each that can is told to stop after a second.
const PATIENCE: Duration = Duration::from_secs(20);

/// Commands, with the words before their options.
const COMMANDS: [&str; 27] = [
    "check",
    "eval",
    "search",
    "report",
    "site",
    "sweep",
    "motion orbit",
    "motion section",
    "motion exponents",
    "motion chart",
    "motion periodic",
    "motion continue",
    "motion diagram",
    "motion rotation",
    "motion basins",
    "measure bench",
    "measure stress",
    "measure growth",
    "merge",
    "verify",
    "table",
    "new",
    "export",
    "names",
    "explain",
    "cases list",
    "cases show",
];

/// Values of options, right and wrong.
const VALUES: [&str; 48] = [
    "0",
    "1",
    "2",
    "-1",
    "3",
    "7",
    "100",
    "0.5",
    "-0.0",
    "1e-3",
    "1e400",
    "nan",
    "inf",
    "1/0",
    "18446744073709551616",
    "",
    " ",
    "x",
    "x=1",
    "x = 0",
    "x=",
    "=1",
    "m=5/4",
    "I=[2,2,3]",
    "I=[2,2",
    "h=0",
    "x=1 y=1/2 z=0",
    "1,1/2,0",
    "0,0",
    "pi/2",
    "up",
    "both",
    "json",
    "csv",
    "text",
    "1/2",
    "3/2",
    "0/0",
    "out.csv",
    "out.svg",
    "out.npy",
    "out.xyz",
    ".",
    "none.toml",
    "x 0..1 5",
    "a=0..1",
    "L=0",
    "é\u{202e}",
];

/// Cases of the catalogue, and paths that are none.
const CASES: [&str; 14] = [
    "classical/flows/lorenz",
    "classical/planar/henon-heiles",
    "classical/maps/lyness",
    "classical/pendula/pendulum",
    "figures/fig-8",
    "figures/fig-A2",
    "figures/fig-6",
    "classical/absence/lorenz",
    "classical/lattices/toda-open-3",
    "classical/kepler/plane",
    "classical/nonholonomic/veselova",
    "nowhere.toml",
    ".",
    "-",
];

/// Command lines, and the program that they are for.
pub struct Lines {
    program: PathBuf,
    folder: PathBuf,
    options: Vec<(&'static str, Vec<Flag>)>,
}

impl Lines {
    /// Reads the options of all commands from the help of the program beside this one.
    pub fn of_program(found: &Path) -> io::Result<Self> {
        let program = std::env::current_exe()?.with_file_name("liouville");
        let folder = found.join("run");
        fs::create_dir_all(&folder)?;
        let mut options = Vec::new();
        for command in COMMANDS {
            let help = Command::new(&program).args(command.split(' ')).arg("--help").output()?;
            let text = String::from_utf8_lossy(&help.stdout).into_owned();
            options.push((command, flags(&text)));
        }
        Ok(Self { program, folder, options })
    }

    /// One command line, without the program.
    pub fn input(&self, random: &mut Random) -> Vec<String> {
        let Some((command, options)) = random.of(&self.options) else { return Vec::new() };
        let mut line: Vec<String> = command.split(' ').map(String::from).collect();
        for _ in 0..random.below(3) {
            line.extend(random.of(&CASES).map(ToString::to_string));
        }
        for _ in 0..random.below(4) {
            let Some(option) = random.of(options) else { break };
            line.push(option.name.clone());
            match random.below(4) {
                0 => line.extend(random.of(&VALUES).map(ToString::to_string)),
                _ => line.extend(random.of(option.values).map(ToString::to_string)),
            }
        }
        if random.below(8) == 0 {
            let at = random.below(line.len() + 1);
            line.insert(at, random.of(&VALUES).copied().unwrap_or_default().to_string());
        }
        if options.iter().any(|option| option.name == "--within")
            && !line.contains(&"--within".into())
        {
            line.extend(["--within".to_string(), "1".to_string()]);
        }
        line
    }

    /// Runs the program: it has to end in time, with one of its exit codes, and with a message
    /// wherever it refuses something. Returns what it printed too.
    pub fn run(&self, line: &[String]) -> io::Result<(Outcome, String)> {
        let printed = self.folder.join("../printed.txt");
        let file = File::create(&printed)?;
        let mut program = Command::new(&self.program)
            .args(line)
            .current_dir(&self.folder)
            .stdin(Stdio::null())
            .stdout(file.try_clone()?)
            .stderr(file)
            .spawn()?;
        let begun = Instant::now();
        let status = loop {
            match program.try_wait()? {
                Some(status) => break Some(status),
                None if begun.elapsed() > PATIENCE => {
                    program.kill()?;
                    program.wait()?;
                    break None;
                }
                None => sleep(Duration::from_millis(2)),
            }
        };
        let bytes = fs::read(printed)?;
        let message = String::from_utf8_lossy(&bytes).into_owned();
        let panicked = message.contains("panicked") || message.contains("internal error");
        let outcome = match status.and_then(|status| status.code()) {
            Some(0 | 1 | 3) if !panicked => Outcome::Valid,
            Some(2) if !panicked && message.contains("error: ") => Outcome::Refused,
            _ => Outcome::Failed,
        };
        Ok((outcome, format!("{status:?}\n{message}")))
    }

    /// Removes what the commands have written.
    pub fn tidy(&self) -> io::Result<()> {
        fs::remove_dir_all(&self.folder)?;
        fs::create_dir_all(&self.folder)
    }
}

/// A long option and values that fit it: none for one without a value.
struct Flag {
    name: String,
    values: &'static [&'static str],
}

/// The long options in a help text, but those that wait for something to happen.
fn flags(help: &str) -> Vec<Flag> {
    let is_name = |c: char| c.is_ascii_lowercase() || c == '-';
    let mut flags = Vec::new();
    for line in help.lines().filter(|line| line.trim_start().starts_with('-')) {
        let Some((_, rest)) = line.split_once("--") else { continue };
        let (name, rest) = rest.split_at(rest.find(|c| !is_name(c)).unwrap_or(rest.len()));
        if !name.is_empty() && !["watch", "help"].contains(&name) {
            let placeholder = rest.split(['<', '>']).nth(1);
            flags.push(Flag { name: format!("--{name}"), values: fitting(placeholder) });
        }
    }
    flags
}

/// Values for what the help calls by a placeholder.
fn fitting(placeholder: Option<&str>) -> &'static [&'static str] {
    match placeholder {
        None => &[],
        Some("SECONDS") => &["0", "0.1", "1"],
        Some("FORMAT" | "TO") => &["json", "text", "csv", "python", "latex", "c"],
        Some("NAME=VALUE") => &["x=1", "m=5/4", "I=[2,2,3]", "a=0"],
        Some(word) if word.starts_with("FILE") || word == "DIR" => &["out.csv", "out.json", "."],
        Some("START") => &["x=1 y=1/2 z=0", "1,1/2,0", "1,1/2,0,0"],
        Some("EQUATION") => &["x = 0", "z = 27", "x = y"],
        Some(word) if word.contains('=') || word.contains(',') => {
            &["a=0..1:5", "1,1/2,2", "x 0..1"]
        }
        Some(_) => &["0", "1", "2", "3", "10", "0.5", "pi/2", "x", "up", "x = 0", "1/2"],
    }
}
