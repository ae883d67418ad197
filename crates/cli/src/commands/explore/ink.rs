//! Options of pictures: file, size, dots, words.

use std::path::{Path, PathBuf};

use clap::Args;
use liouville_draw::{Figure, Paper, Plot, Size, Text, pdf, plain, png, svg};

use super::output::{Ending, Output};
use super::write;

/// Width of a picture of one plot, and of several, in millimetres.
const SINGLE: f64 = 120.0;
const SEVERAL: f64 = 180.0;
/// Size of a cell of a shaded density in millimetres, and part of the width that a frame takes.
const CELL: f64 = 0.3;
const FRAME: f64 = 0.8;

/// File and style of a picture.
#[derive(Clone, Debug, Args)]
pub struct Ink {
    /// Write to this file: a picture to .svg, .pdf or .png; data to .csv or .json, of `orbit` and
    /// `section` also to .npy, and of `chart --part` the folder of the parts
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Width of the picture in millimetres; 120 by default, 180 for several plots
    #[arg(long, value_name = "MM", value_parser = parse_length)]
    width: Option<f64>,
    /// Height of the picture in millimetres; by default that of its parts
    #[arg(long, value_name = "MM", value_parser = parse_length)]
    height: Option<f64>,
    /// Pixels to the inch of a PNG
    #[arg(long, default_value_t = 200, value_parser = clap::value_parser!(u32).range(30..=2400))]
    dpi: u32,
    /// Diameter of dots in millimetres
    #[arg(long, value_name = "MM", default_value_t = 0.2, value_parser = parse_dot)]
    point_size: f64,
    /// Opacity of dots and lines, from 0 to 1; where dots overlap, they become darker
    #[arg(long, default_value_t = 1.0, value_parser = parse_opacity)]
    opacity: f64,
    /// Title above the picture; by default that of the case, and none if it is empty: --title ''
    #[arg(long)]
    title: Option<String>,
    /// Words below the picture; by default what was drawn and the parameters, and none if it is empty
    #[arg(long)]
    caption: Option<String>,
    /// Dark background for PNG and PDF; an SVG follows the viewer's colour scheme
    #[arg(long)]
    dark: bool,
}

fn parse_number(text: &str, low: f64, high: f64) -> Option<f64> {
    text.parse().ok().filter(|number| (low..=high).contains(number))
}

fn parse_length(text: &str) -> Result<f64, String> {
    let found = parse_number(text, 30.0, 600.0);
    found.ok_or("write millimetres from 30 to 600; --dpi sets the pixels of a PNG".to_string())
}

fn parse_dot(text: &str) -> Result<f64, String> {
    parse_number(text, 0.02, 5.0).ok_or("write millimetres from 0.02 to 5".to_string())
}

fn parse_opacity(text: &str) -> Result<f64, String> {
    parse_number(text, 0.005, 1.0).ok_or("write a number from 0.005 to 1".to_string())
}

/// Results for a file: rows with commas, a document, and plots with the words below them.
pub struct Sheet<'s> {
    pub title: &'s str,
    pub csv: &'s dyn Fn() -> String,
    pub json: &'s dyn Fn() -> Result<String, String>,
    pub picture: &'s dyn Fn() -> (Text, Vec<Plot>),
}

impl Ink {
    /// Options of the style with a value.
    pub const VALUED: &'static [&'static str] =
        &["--width", "--height", "--dpi", "--point-size", "--opacity", "--title", "--caption"];
    /// Options of the style without one.
    pub const FLAGS: &'static [&'static str] = &["--dark"];

    /// Returns the file with its format, so that errors are found before any long computation.
    pub fn output(&self, allowed: &[Ending], inputs: &[&Path]) -> Result<Option<Output>, String> {
        self.out.as_deref().map(|path| Output::new(path, allowed, inputs)).transpose()
    }

    fn width(&self, columns: usize) -> f64 {
        self.width.unwrap_or(if columns > 1 { SEVERAL } else { SINGLE })
    }

    /// Numbers of cells, across and upwards, of a shaded density in one of several columns.
    pub fn cells(&self, columns: usize, aspect: f64) -> [usize; 2] {
        let across = FRAME * self.width(columns) / columns.max(1) as f64 / CELL;
        [across, across * aspect].map(|count| (count.round() as usize).max(8))
    }

    /// Writes a sheet to its file, in the format of the ending.
    pub fn save(&self, out: Option<&Output>, sheet: &Sheet<'_>) -> Result<(), String> {
        let Some(out) = out else { return Ok(()) };
        let bytes = match out.ending {
            Ending::Csv => (sheet.csv)().into_bytes(),
            Ending::Json => (sheet.json)()?.into_bytes(),
            ending => {
                let (caption, plots) = (sheet.picture)();
                let columns = plots.len().min(2);
                self.drawn((sheet.title, vec![caption]), plots, columns, ending)?
            }
        };
        write(&out.path, "--out", bytes)
    }

    /// Draws plots with the words of the command line, or else with these.
    pub fn drawn(
        &self,
        (title, caption): (&str, Vec<Text>),
        plots: Vec<Plot>,
        columns: usize,
        ending: Ending,
    ) -> Result<Vec<u8>, String> {
        let caption = match self.caption.as_deref() {
            None => caption,
            Some("") => Vec::new(),
            Some(words) => vec![plain(words)],
        };
        let figure = Figure {
            title: self.title.clone().unwrap_or_else(|| title.to_string()),
            caption,
            plots,
            columns,
            size: Size {
                width: self.width(columns),
                height: self.height,
                dot: self.point_size,
                opacity: self.opacity,
            },
        };
        let mut scene = figure.scene();
        if scene.title.is_empty() {
            scene.title = title.to_string();
        }
        let paper = if self.dark { Paper::Dark } else { Paper::Light };
        match ending {
            Ending::Png => png(&scene, f64::from(self.dpi), paper)
                .map_err(|error| format!("error: {error}\nhelp: give a smaller --width or --dpi")),
            Ending::Pdf => Ok(pdf(&scene, paper)),
            _ => Ok(svg(&scene).into_bytes()),
        }
    }
}
