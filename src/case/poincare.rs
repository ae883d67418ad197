//! The table `[section]`: the Poincaré section of the motion that a case draws.

use toml::de::DeValue;

use super::ends::number;
use super::error::{Mistake, Problem};
use super::lines::FixedLine;
use super::section::{CaseTable, SpannedStr, numbers};
use crate::number::rational::Rational;

/// Default number of images of a line, as in the paper's figures.
const DEFAULT_IMAGES: usize = 10;

/// Limit on orbits, crossings and images: more than a picture can show.
const MOST_POINTS: u32 = 1_000_000;

/// An angle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Angle {
    /// Multiple of π/2.
    QuarterTurns(u32),
    /// Any other angle, in radians.
    Radians(Rational),
}

/// Crossings of a section that count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// Crossings with g' > 0.
    Up,
    /// Crossings with g' < 0.
    Down,
    /// All crossings.
    #[default]
    Both,
}

/// Plan of a Poincaré section g = g₀ in the Andoyer-like variables, and of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionPlan {
    /// Angle g₀.
    pub g0: Angle,
    /// Energy h.
    pub energy: Rational,
    /// Direction of the crossings that are drawn.
    pub direction: Direction,
    /// Number of orbits with starts spread over the sphere.
    pub orbits: Option<usize>,
    /// Number of crossings of each orbit.
    pub crossings: Option<usize>,
    /// Number of crossings left out at the beginning.
    pub skip: usize,
    /// Further starts (l, L/G).
    pub starts: Vec<[f64; 2]>,
    /// Name of the claim whose value colours the orbits.
    pub colour: Option<String>,
    /// Whether to follow the motion backwards in time.
    pub backwards: bool,
    /// Lines whose images under the section map are drawn.
    pub lines: Vec<FixedLine>,
    /// Number of images of each line, forwards and backwards.
    pub images: usize,
}

impl std::str::FromStr for Angle {
    type Err = String;

    /// Reads `0`, `π`, `pi/2`, `3π/2`, or radians.
    fn from_str(text: &str) -> Result<Self, String> {
        let plain: String = text.split_whitespace().collect();
        let plain = plain.replace("pi", "π").replace('*', "");
        let quarter = ["0", "π/2", "π", "3π/2"].iter().position(|name| *name == plain);
        match quarter {
            Some(turns) => Ok(Angle::QuarterTurns(turns as u32)),
            None => {
                let angle = number(text).ok_or_else(|| {
                    format!(
                        "`{text}` is not an angle; write 0, π/2, π, 3π/2, or a number of radians"
                    )
                })?;
                match angle.to_f64().0.abs() <= 2.0 * std::f64::consts::PI {
                    true => Ok(Angle::Radians(angle)),
                    false => Err(format!(
                        "`{text}` is more than one turn, and angles are in radians; write π/2 for 90°"
                    )),
                }
            }
        }
    }
}

impl std::fmt::Display for Angle {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Angle::QuarterTurns(turns) => {
                out.write_str(["0", "π/2", "π", "3π/2"][*turns as usize % 4])
            }
            Angle::Radians(value) => write!(out, "{value}"),
        }
    }
}

impl std::str::FromStr for Direction {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "up" => Ok(Direction::Up),
            "down" => Ok(Direction::Down),
            "both" => Ok(Direction::Both),
            _ => Err(format!("`{text}` is not a direction; write \"up\", \"down\" or \"both\"")),
        }
    }
}

/// Reads `[section]`; `None` where it is absent, or has a mistake.
pub(super) fn read(root: &CaseTable<'_>) -> Option<SectionPlan> {
    let section = root.table("section")?;
    let plan = section.keep(plan(&section));
    if plan.is_some() {
        section.finish();
    }
    plan
}

fn plan(section: &CaseTable<'_>) -> Result<SectionPlan, Mistake> {
    let wrong = |text: &SpannedStr, message: String| {
        let remedy = "docs/claims.md shows a [section]".to_string();
        Mistake::at(text.span.clone(), Problem::Other { message, remedy })
    };
    let g0 = section.required("g0", "add g0 = \"π\", the angle of the section")?;
    let energy = section.required("energy", "add energy = 1, the level of the energy")?;
    let direction = match section.text("direction")? {
        Some(text) => text.value.parse().map_err(|message| wrong(&text, message))?,
        None => Direction::default(),
    };
    let plan = SectionPlan {
        g0: g0.value.parse().map_err(|message| wrong(&g0, message))?,
        energy: energy
            .value
            .parse()
            .map_err(|_| wrong(&energy, format!("`{}` is not a number", energy.value)))?,
        direction,
        orbits: section.count("orbits", MOST_POINTS)?,
        crossings: crossings(section)?,
        skip: section.count("skip", MOST_POINTS)?.unwrap_or(0),
        starts: starts(section)?,
        colour: section.text("colour")?.map(|text| text.value),
        backwards: section.boolean("backwards")?.unwrap_or(false),
        lines: section
            .texts("lines")?
            .iter()
            .map(|text| text.value.parse().map_err(|message| wrong(text, message)))
            .collect::<Result<_, _>>()?,
        images: section.count("images", MOST_POINTS)?.unwrap_or(DEFAULT_IMAGES),
    };
    Ok(plan)
}

/// Reads the number of crossings, 1 or more.
fn crossings(section: &CaseTable<'_>) -> Result<Option<usize>, Mistake> {
    let count = section.count("crossings", MOST_POINTS)?;
    match (count, section.value("crossings")) {
        (Some(0), Some(value)) => {
            let message = "a section without crossings shows nothing".to_string();
            let remedy = "write 1 or more, or leave it out".to_string();
            Err(Mistake::at(value.span(), Problem::Other { message, remedy }))
        }
        _ => Ok(count),
    }
}

/// Reads `starts = [[l, z], …]`.
fn starts(section: &CaseTable<'_>) -> Result<Vec<[f64; 2]>, Mistake> {
    let Some(value) = section.value("starts") else { return Ok(Vec::new()) };
    let wrong = |span| section.wrong_type("starts", "a list of points [l, L/G]", span);
    let DeValue::Array(points) = value.get_ref() else { return Err(wrong(value.span())) };
    let point = |item: &toml::Spanned<DeValue<'_>>| {
        let DeValue::Array(pair) = item.get_ref() else { return None };
        let numbers: Vec<f64> =
            numbers(pair)?.iter().map(|text| text.parse().ok()).collect::<Option<_>>()?;
        <[f64; 2]>::try_from(numbers).ok()
    };
    points.iter().map(|item| point(item).ok_or_else(|| wrong(item.span()))).collect()
}
