//! What the commands about motions share: the case, the section, threads, pictures, complaints.

use std::path::{Path, PathBuf};

use clap::Args;
use liouville::case::{Angle, Case};
use liouville::flow::FlowError;
use liouville::number::rational::Rational;
use liouville::report::picture::Paper;

use super::eval::open;
use super::files::plain;

/// Whose motion, and how it is told.
#[derive(Debug, Args)]
pub struct Subject {
    /// A case file
    pub case: PathBuf,
    /// Give a parameter a value: --set m=5/4 --set 'I=[2,2,3]'; others are drawn
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub settings: Vec<String>,
    /// Seed of what is drawn
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

impl Subject {
    pub fn open(&self) -> Result<Case, String> {
        let case = open(&self.case, &self.settings)?;
        match case.model.system.is_map() {
            true => Err(self.told(&FlowError::Discrete)),
            false => Ok(case),
        }
    }

    /// A problem of a motion, with the file it belongs to.
    pub fn told(&self, error: &FlowError) -> String {
        plain(&self.case, &error.to_string(), error.help()).rendered
    }
}

/// Which section: the case's [section], unless something else is said.
#[derive(Debug, Args)]
pub struct Plane {
    /// The energy; by default that of the case's [section]
    #[arg(long)]
    pub energy: Option<Rational>,
    /// The angle of the section: 0, pi/2, pi, 3pi/2, or radians; by default that of the case
    #[arg(long)]
    pub g0: Option<Angle>,
}

impl Plane {
    /// The angle and the energy.
    pub fn of(&self, case: &Case) -> Result<(Angle, Rational), String> {
        let plan = case.section.as_ref();
        let missing = |what: &str, key: &str| {
            format!(
                "error: the case has no [section], so that its {what} is not known\n\
                 help: give --{key}, or add a [section] to the case: docs/writing-a-case.md"
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

/// How many threads.
#[derive(Clone, Copy, Debug, Args)]
pub struct Threads {
    /// How many threads to use; all cores by default. Results do not depend on it
    #[arg(long)]
    pub threads: Option<usize>,
}

impl Threads {
    pub fn count(self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        self.threads.unwrap_or_else(cores)
    }
}

/// A point of a section as it is typed.
pub fn parse_start(text: &str) -> Result<[f64; 2], String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|x| x.trim().parse().ok()).collect();
    let pair = numbers.and_then(|numbers| <[f64; 2]>::try_from(numbers).ok());
    pair.ok_or("write l and L/G with a comma between, such as 1.2,-0.04".to_string())
}

/// A number as it is typed, which may be a multiple of π: `3/2`, `2pi`, `π/2`.
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

/// Where a picture goes, and how it looks.
#[derive(Debug, Args)]
pub struct Ink {
    /// Draw to this file, .svg or .png
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// The width of the picture in pixels
    #[arg(long, default_value_t = 900, value_parser = clap::value_parser!(u32).range(120..=8000))]
    pub width: u32,
    /// Draw a PNG on dark paper; an SVG is light or dark as its reader's setting is
    #[arg(long)]
    dark: bool,
}

impl Ink {
    /// The file, and what its ending asks for; known before anything long is computed.
    pub fn out(&self) -> Result<Option<(&Path, Drawing)>, String> {
        self.out.as_deref().map(|path| Ok((path, drawing(path)?))).transpose()
    }

    pub fn paper(&self) -> Paper {
        if self.dark { Paper::Dark } else { Paper::Light }
    }
}

/// How a picture is written: the ending of its file says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    Svg,
    Png,
}

fn drawing(path: &Path) -> Result<Drawing, String> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("svg") => Ok(Drawing::Svg),
        Some("png") => Ok(Drawing::Png),
        _ => Err(format!(
            "error: {} is neither .svg nor .png\nhelp: the ending says how to draw",
            path.display()
        )),
    }
}
