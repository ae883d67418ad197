//! Options shared by the commands about motions: case, section, threads, errors.

use std::io::IsTerminal;
use std::path::PathBuf;

use crate::parts::Identity;
use crate::report::data::DataTable;
use crate::report::diagnostic;
use clap::Args;
use liouville::case::{Angle, Case, Direction};
use liouville::mechanics::components;
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::{Rational, RationalError};
use liouville_flow::{
    ChoiceError, Fixed, FlowError, FormulaMistake, IterateError, SectionChoice, number_with_pi,
};

use super::LimitArgs;
use super::colour;
use super::eval::{Opened, open_text, read_text};
use super::files::plain;
use super::fixing;
use super::output::Ending;
use super::share::Share;

/// Case whose motion is followed, and format of the output.
#[derive(Clone, Debug, Args)]
pub struct MotionArgs {
    /// Case file
    pub case: PathBuf,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Seed of the random draws
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub limits: LimitArgs,
    /// Text of the case, if it is at hand.
    #[arg(skip)]
    pub text: Option<String>,
}

impl MotionArgs {
    pub fn open(&self) -> Result<Case, String> {
        self.opened().map(|opened| opened.case)
    }

    /// Reads the case, and keeps its text.
    pub fn opened(&self) -> Result<Opened, String> {
        match &self.text {
            Some(text) => self.read(text),
            None => self.moving(open_text(&self.case, &self.settings)?),
        }
    }

    /// Reads the case from its text.
    pub fn read(&self, text: &str) -> Result<Opened, String> {
        self.moving(read_text(&self.case, text, &self.settings)?)
    }

    /// Whether the case is a map.
    pub fn reads_map(&self) -> Result<bool, String> {
        let opened = match &self.text {
            Some(text) => read_text(&self.case, text, &self.settings)?,
            None => open_text(&self.case, &self.settings)?,
        };
        Ok(opened.case.model.system.is_map())
    }

    /// Reads a case that may be a map.
    pub fn open_with_maps(&self) -> Result<Case, String> {
        let opened = match &self.text {
            Some(text) => read_text(&self.case, text, &self.settings)?,
            None => open_text(&self.case, &self.settings)?,
        };
        self.keeping(opened).map(|opened| opened.case)
    }

    /// Identity of a job about the case.
    pub fn identity(
        &self,
        job: &'static str,
        text: &str,
        (units, request): (u64, String),
        share: &Share,
    ) -> Identity {
        let mut settings = self.settings.clone();
        settings.sort();
        Identity {
            job,
            units,
            seed: self.seed,
            request,
            arguments: share.arguments.clone(),
            name: self.case.display().to_string(),
            settings,
            case: text.to_string(),
        }
    }

    /// The case, if it has motions, and these stay on its level.
    fn moving(&self, opened: Opened) -> Result<Opened, String> {
        if opened.case.model.system.is_map() {
            return Err(self.told(&FlowError::Discrete));
        }
        self.keeping(opened)
    }

    /// The case, if what moves stays on its level.
    fn keeping(&self, opened: Opened) -> Result<Opened, String> {
        match liouville_flow::check_level(&opened.case, self.seed) {
            Ok(()) => Ok(opened),
            Err(error) => {
                let coloured = colour(std::io::stderr().is_terminal());
                let shown = self.case.display().to_string();
                Err(diagnostic::of_judging(&shown, &opened.text, &error, coloured).rendered)
            }
        }
    }

    /// Line that names the drawn values of free parameters; empty where there are none, and in JSON.
    pub fn drawn_parameters(&self) -> String {
        let Some(case) = (!self.json).then(|| self.open_with_maps().ok()).flatten() else {
            return String::new();
        };
        let Ok(values) = liouville_flow::fixed_parameters(&case, self.seed, 0) else {
            return String::new();
        };
        let mut values = values.iter().map(|value| value.to_f64().0.to_string());
        let named = case.model.free_parameters().map(|parameter| {
            let own: Vec<String> = values.by_ref().take(components(parameter.kind)).collect();
            format!("{} = {}", parameter.name, parameter.kind.as_setting(&own))
        });
        let named: Vec<String> = named.collect();
        match named.is_empty() {
            true => String::new(),
            false => format!("drawn with seed {}: {}\n", self.seed, named.join(", ")),
        }
    }

    /// Message about a failed orbit of a map, with its file.
    pub fn of_iterates(&self, error: &IterateError) -> String {
        match error {
            IterateError::Start(error) => self.told(error),
            other => format!("error: {}: {other}\nhelp: {}", self.case.display(), other.help()),
        }
    }

    /// Message about a failed motion, with its file.
    pub fn told(&self, error: &FlowError) -> String {
        plain(&self.case, &error.to_string(), error.help()).rendered
    }
}

/// Poincaré section: that of the case, unless options override it.
#[derive(Clone, Debug, Args)]
pub struct SectionPlaneArgs {
    /// Energy; by default that of the case's [section]
    #[arg(long, value_parser = parse_number)]
    pub energy: Option<Rational>,
    /// Value of an integral that the case claims and that is proved, or of the energy, for all motions:
    /// --fix J=3.1. The option may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub fix: Vec<String>,
    /// Angle of the section: 0, pi/2, pi, 3pi/2, or radians; by default that of the case
    #[arg(long)]
    pub g0: Option<Angle>,
}

impl SectionPlaneArgs {
    /// Functions whose values all motions share.
    pub fn fixed(&self, case: &Case) -> Result<Vec<Fixed>, String> {
        fixing::fixed(case, self.energy.as_ref(), &self.fix)
    }

    /// Choices of the options, of a section g = g₀.
    pub fn choice(&self) -> Result<SectionChoice, String> {
        match self.fix.is_empty() {
            true => Ok(SectionChoice {
                g0: self.g0.clone(),
                energy: self.energy.clone(),
                ..SectionChoice::default()
            }),
            false => {
                Err("error: --fix: the section g = g₀ of a rolling body has an energy alone\n\
                          help: give --energy, or a surface by --section"
                    .to_string())
            }
        }
    }

    /// Angle and energy of the section.
    pub fn of(&self, case: &Case) -> Result<(Angle, Rational), String> {
        self.choice()?.place(case).map_err(|error| wrong_choice(&error))
    }
}

/// Section of motions: what they cross, what is recorded there, and how many crossings count.
#[derive(Clone, Debug, Args)]
pub struct CrossingArgs {
    #[command(flatten)]
    pub plane: SectionPlaneArgs,
    /// Surface of the section, by formulas of the case: --section 'x = 0'. By default g = g₀ of a
    /// rolling body
    #[arg(long, value_name = "EQUATION", conflicts_with = "g0", allow_hyphen_values = true)]
    pub section: Option<String>,
    /// Values recorded at crossings of --section, by formulas: --axes 'y, z'. By default the first
    /// two components of the state that the surface leaves free
    #[arg(long, value_name = "FORMULAS", requires = "section", allow_hyphen_values = true)]
    pub axes: Option<String>,
    /// Number of crossings of each motion; by default of a section 500 or as the case says, of a
    /// diagram 100, of a rotation number 2000
    #[arg(long, value_parser = parse_positive)]
    pub crossings: Option<usize>,
    /// Number of crossings left out at the beginning of each motion; by default of a section none or
    /// as the case says, of a diagram 300, of a rotation number none
    #[arg(long, value_parser = parse_count)]
    pub skip: Option<usize>,
    /// Crossings that count: up (g or the surface's left side less its right one grows), down, both
    #[arg(long)]
    pub direction: Option<Direction>,
}

/// Message about options that determine no section.
pub fn wrong_choice(error: &ChoiceError) -> String {
    let help = match error {
        ChoiceError::Unknown(what) => {
            let key = if *what == "angle" { "g0" } else { what };
            format!("give --{key}, or add [section] with g0 and energy to the case")
        }
        ChoiceError::NoStart => "give --start l,L/G".to_string(),
        ChoiceError::TwoStarts => {
            "leave one of them out: beside --state an axis is a parameter; an axis of the energy, l or L/G \
             starts on a section, with --start l,L/G for what the axes leave open"
                .to_string()
        }
        ChoiceError::Flow(error) => error.help().to_string(),
    };
    match error {
        ChoiceError::TwoStarts => {
            format!("error: --state says where the motions start, and an axis too\nhelp: {help}")
        }
        _ => format!("error: {error}\nhelp: {help}"),
    }
}

/// Message about a time in which nothing moves.
pub fn check_time(time: f64) -> Result<(), String> {
    match time != 0.0 && time.is_finite() {
        true => Ok(()),
        false => Err("error: --time: write a number that is not 0".to_string()),
    }
}

/// Number of threads.
#[derive(Clone, Copy, Debug, Args)]
pub struct Threads {
    /// Number of threads; all cores by default. Results do not depend on it
    #[arg(long, value_parser = super::super::parse_threads)]
    pub threads: Option<usize>,
}

impl Threads {
    pub fn count(self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.threads.unwrap_or_else(cores)
    }
}

/// Reads a number, or a formula of numbers such as 2*pi.
pub fn parse_number(text: &str) -> Result<Rational, String> {
    number_with_pi(text).ok_or_else(|| {
        let error = text.trim().parse::<Rational>().err();
        let error = error.filter(|error| *error == RationalError::TooLong);
        error.map_or("write a number, such as 12, -0.5, 1e-3, 3/7 or 2*pi".to_string(), |error| {
            error.to_string()
        })
    })
}

/// Reads the same as the nearest f64.
pub fn parse_float(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(number) => Ok(number),
        Err(_) => parse_number(text).map(|number| number.to_f64().0),
    }
}

/// Reads a count of orbits, crossings or images.
pub fn parse_count(text: &str) -> Result<usize, String> {
    const MOST_COUNT: usize = 1_000_000;
    let count = text.parse().ok().filter(|count| *count <= MOST_COUNT);
    count.ok_or(format!("write a whole number up to {MOST_COUNT}"))
}

/// Reads a count that has to be 1 or more.
pub fn parse_positive(text: &str) -> Result<usize, String> {
    match parse_count(text)? {
        0 => Err("nothing would be computed: write 1 or more".to_string()),
        count => Ok(count),
    }
}

/// Reads a point of a section.
pub fn parse_start(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| {
        let exact = || number_with_pi(text).map(|x| x.to_f64().0);
        text.trim().parse().ok().or_else(exact)
    };
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
    pair.ok_or("write l and L/G with a comma between, such as 1.2,-0.04; a whole state is given by --state".to_string())
}

/// Renders data by the ending of their file.
pub fn rendered(data: &DataTable<'_>, ending: Ending) -> Vec<u8> {
    match ending {
        Ending::Npy => data.npy(),
        Ending::Json => data.json().into_bytes(),
        _ => data.csv().into_bytes(),
    }
}

/// A whole number as a cell of data.
pub fn whole(count: usize) -> DoubleDouble {
    DoubleDouble::from_f64(count as f64)
}

/// Message about a formula of an option, with its place.
pub fn wrong_formula(option: &str, text: &str, mistake: &FormulaMistake) -> String {
    let coloured = colour(std::io::stderr().is_terminal());
    let (message, help) = (&mistake.message, mistake.help.as_deref());
    diagnostic::of_option(option, text, mistake.span.clone(), message, help, coloured).rendered
}
