//! Options shared by the commands about motions: case, section, threads, errors.

use std::io::IsTerminal;
use std::path::PathBuf;

use clap::Args;
use liouville::case::{Angle, Case};
use liouville::mechanics::System;
use liouville::number::pair::Pair;
use liouville::number::rational::Rational;
use liouville_cli::report::data::Data;
use liouville_cli::report::diagnostic;
use liouville_flow::{FlowError, FormulaMistake};

use super::Limits;
use super::colour;
use super::eval::open;
use super::files::plain;
use super::output::Ending;

/// Case whose motion is followed, and format of the output.
#[derive(Clone, Debug, Args)]
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
    /// Angle and energy of the section.
    pub fn of(&self, case: &Case) -> Result<(Angle, Rational), String> {
        let plan = case.section.as_ref();
        let rolls = matches!(case.model.system, System::Rubber(_));
        if plan.is_none() && !rolls {
            let error = FlowError::NoAndoyer;
            return Err(format!("error: {error}\nhelp: {}", error.help()));
        }
        let missing = |what: &str, key: &str| {
            format!(
                "error: the case has no [section], so the {what} is unknown\n\
                 help: give --{key}, or add [section] with g0 and energy to the case"
            )
        };
        let g0 = self.g0.clone().or(plan.map(|plan| plan.g0.clone()));
        let energy = self.energy.clone().or(plan.map(|plan| plan.energy.clone()));
        Ok((
            g0.ok_or_else(|| missing("angle", "g0"))?,
            energy.ok_or_else(|| missing("energy", "energy"))?,
        ))
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

/// Reads a number, which may be a multiple of π: `3/2`, `2pi`, `π/2`.
pub fn number_with_pi(text: &str) -> Option<Rational> {
    let plain: String = text.split_whitespace().collect();
    let plain = plain.replace("pi", "π").replace('*', "");
    let Some((before, behind)) = plain.split_once('π') else { return plain.parse().ok() };
    let factor: Rational = match before {
        "" => Rational::from(1),
        "-" | "−" => Rational::from(-1),
        number => number.parse().ok()?,
    };
    let divisor: Rational = match behind.strip_prefix('/') {
        Some(number) => number.parse().ok()?,
        None if behind.is_empty() => Rational::from(1),
        None => return None,
    };
    let pi = Rational::from_f64(std::f64::consts::PI)?;
    Some(&(&pi * &factor) * &divisor.recip()?)
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
