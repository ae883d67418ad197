//! Options shared by the commands about motions: case, section, threads, pictures, errors.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use crate::report::data::Data;
use crate::report::diagnostic;
use crate::report::picture::{self, Paper, Picture};
use clap::Args;
use liouville::case::{Angle, Case};
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;
use liouville_flow::{ChoiceError, FlowError, FormulaMistake, SectionChoice, number_with_pi};

use super::Limits;
use super::colour;
use super::eval::open;
use super::files::plain;
use super::output::{Ending, Output};

/// Case whose motion is followed, and format of the output.
#[derive(Debug, Args)]
pub struct Subject {
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
    pub limits: Limits,
}

impl Subject {
    pub fn open(&self) -> Result<Case, String> {
        let case = open(&self.case, &self.settings)?;
        match case.model.system.is_map() {
            true => Err(self.told(&FlowError::Discrete)),
            false => Ok(case),
        }
    }

    /// Message about a failed motion, with its file.
    pub fn told(&self, error: &FlowError) -> String {
        plain(&self.case, &error.to_string(), error.help()).rendered
    }
}

/// Poincaré section: that of the case, unless options override it.
#[derive(Debug, Args)]
pub struct Plane {
    /// Energy; by default that of the case's [section]
    #[arg(long)]
    pub energy: Option<Rational>,
    /// Angle of the section: 0, pi/2, pi, 3pi/2, or radians; by default that of the case
    #[arg(long)]
    pub g0: Option<Angle>,
}

impl Plane {
    /// Choices of the options.
    pub fn choice(&self) -> SectionChoice {
        SectionChoice {
            g0: self.g0.clone(),
            energy: self.energy.clone(),
            ..SectionChoice::default()
        }
    }

    /// Angle and energy of the section.
    pub fn of(&self, case: &Case) -> Result<(Angle, Rational), String> {
        self.choice().place(case).map_err(|error| wrong_choice(&error))
    }
}

/// Message about options that determine no section.
pub fn wrong_choice(error: &ChoiceError) -> String {
    let help = match error {
        ChoiceError::Unknown(what) => {
            let key = if *what == "angle" { "g0" } else { what };
            format!("give --{key}, or add [section] with g0 and energy to the case")
        }
        ChoiceError::NoStart => "give --start l,L/G".to_string(),
        ChoiceError::TwoStarts => "leave one of them out".to_string(),
        ChoiceError::Flow(error) => error.help().to_string(),
    };
    match error {
        ChoiceError::TwoStarts => {
            format!("error: --state says where the motions start, and an axis too\nhelp: {help}")
        }
        _ => format!("error: {error}\nhelp: {help}"),
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

/// Reads a count of orbits, crossings or images.
pub fn parse_count(text: &str) -> Result<usize, String> {
    const MOST: usize = 1_000_000;
    let count = text.parse().ok().filter(|count| *count <= MOST);
    count.ok_or(format!("write a whole number up to {MOST}"))
}

/// Reads a point of a section.
pub fn parse_start(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| {
        let exact = || number_with_pi(text).map(|x| x.to_f64().0);
        text.trim().parse().ok().or_else(exact)
    };
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
    pair.ok_or("write l and L/G with a comma between, such as 1.2,-0.04".to_string())
}

/// File and style of a picture.
#[derive(Debug, Args)]
pub struct Ink {
    /// Write to this file: a picture to .svg or .png; of `orbit` and `section` also data to .csv, .npy
    /// or .json
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Width of the picture in pixels
    #[arg(long, default_value_t = 900, value_parser = clap::value_parser!(u32).range(120..=8000))]
    pub width: u32,
    /// Draw a PNG on dark paper; an SVG is light or dark by its reader's setting
    #[arg(long)]
    dark: bool,
}

impl Ink {
    /// Returns the file with its format, so that errors are found before any long computation.
    pub fn output(&self, allowed: &[Ending], inputs: &[&Path]) -> Result<Option<Output>, String> {
        self.out.as_deref().map(|path| Output::new(path, allowed, inputs)).transpose()
    }

    /// Draws a picture of dots and lines.
    pub fn drawn(&self, picture: &Picture, ending: Ending) -> Result<Vec<u8>, String> {
        match ending {
            Ending::Png => {
                picture::png(picture, self.paper()).map_err(|error| format!("error: {error}"))
            }
            _ => Ok(picture::svg(picture).into_bytes()),
        }
    }

    pub fn paper(&self) -> Paper {
        if self.dark { Paper::Dark } else { Paper::Light }
    }
}

/// Renders data by the ending of their file.
pub fn rendered(data: &Data, ending: Ending) -> Vec<u8> {
    match ending {
        Ending::Npy => data.npy(),
        Ending::Json => data.json().into_bytes(),
        _ => data.csv().into_bytes(),
    }
}

/// A whole number as a cell of data.
pub fn whole(count: usize) -> Pair {
    Pair::from_f64(count as f64)
}

/// Message about a formula of an option, with its place.
pub fn wrong_formula(option: &str, text: &str, mistake: &FormulaMistake) -> String {
    let coloured = colour(std::io::stderr().is_terminal());
    let (message, help) = (&mistake.message, mistake.help.as_deref());
    diagnostic::of_option(option, text, mistake.span.clone(), message, help, coloured).rendered
}
