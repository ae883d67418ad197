//! Pictures of a plane of points in a few colours, with a legend below.

use std::fmt::Write;

use super::glyphs::SIZE;
use super::palette::Paper;
use super::png::{Canvas, FIRST};
use super::svg::{axes, head, hex};
use super::{BELOW, Frame, Scale};
use crate::report::diagram::escape;

/// Height of a line of the legend, and width of an entry.
const LINE: f64 = 18.0;
const WORD: f64 = 210.0;
const SQUARE: f64 = 10.0;

/// A colour of the picture with its meaning.
#[derive(Clone, Debug)]
pub struct Swatch {
    /// Red, green and blue.
    pub colour: [u8; 3],
    /// Meaning of the colour.
    pub name: String,
}

/// A plane of coloured points.
#[derive(Clone, Debug)]
pub struct Map {
    /// Title of the picture.
    pub title: String,
    /// Horizontal axis.
    pub across: Scale,
    /// Vertical axis.
    pub up: Scale,
    /// Colours with their meanings.
    pub swatches: Vec<Swatch>,
    /// Colour of each point as an index of `swatches`, row by row from below.
    pub rows: Vec<Vec<usize>>,
    /// Width in pixels.
    pub width: u32,
}

impl Map {
    fn frame(&self) -> Frame {
        let lines = self.swatches.len().div_ceil(self.words_a_line());
        let below = LINE * lines as f64 + 6.0;
        Frame::new(self.width, self.across.clone(), self.up.clone(), below)
    }

    fn words_a_line(&self) -> usize {
        ((f64::from(self.width) / WORD) as usize).max(1)
    }

    /// Positions of the swatches in the legend: upper left corners, with the index of each.
    fn legend(&self, frame: &Frame) -> impl Iterator<Item = (f64, f64, usize)> {
        let (left, top) = (frame.left, frame.top + frame.height + BELOW);
        let a_line = self.words_a_line();
        (0..self.swatches.len()).map(move |index| {
            let (line, word) = (index / a_line, index % a_line);
            (left + WORD * word as f64, top + LINE * line as f64, index)
        })
    }

    /// Renders the picture as SVG: a path for each colour.
    pub fn svg(&self) -> String {
        let frame = self.frame();
        let mut out = head(&self.title, &frame);
        let columns = self.rows.first().map_or(1, Vec::len).max(1);
        let (wide, high) = (frame.width / columns as f64, frame.height / self.rows.len() as f64);
        for (index, swatch) in self.swatches.iter().enumerate() {
            let mut path = String::new();
            for (row, cells) in self.rows.iter().enumerate() {
                let y = frame.top + frame.height - high * (row + 1) as f64;
                let mut column = 0;
                // A run of one colour is drawn as one rectangle.
                while column < cells.len() {
                    let run = cells[column..].iter().take_while(|cell| **cell == index).count();
                    if run > 0 {
                        let (x, length) = (frame.left + wide * column as f64, wide * run as f64);
                        let _ = write!(path, "M{x:.2} {y:.2}h{length:.2}v{high:.2}h-{length:.2}z");
                    }
                    column += run.max(1);
                }
            }
            if !path.is_empty() {
                let fill = hex(swatch.colour);
                let style = format!("fill:{fill};stroke:none");
                let _ = writeln!(
                    out,
                    "<path shape-rendering=\"crispEdges\" style=\"{style}\" d=\"{path}\"/>"
                );
            }
        }
        axes(&mut out, &frame);
        for (x, y, index) in self.legend(&frame) {
            let Swatch { colour, name } = &self.swatches[index];
            let _ = writeln!(
                out,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{SQUARE}\" height=\"{SQUARE}\" fill=\"{}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                hex(*colour),
                x + SQUARE + 6.0,
                y + SQUARE - 0.5,
                escape(name)
            );
        }
        out + "</svg>\n"
    }

    /// Renders the picture as PNG.
    pub fn png(&self, paper: Paper) -> Result<Vec<u8>, png::EncodingError> {
        let frame = self.frame();
        let mut canvas = Canvas::new(&frame);
        let (wide, high) = (frame.width as i64, frame.height as i64);
        for y in 0..high {
            let row = (high - 1 - y) as usize * self.rows.len() / high as usize;
            let cells = &self.rows[row];
            for x in 0..wide {
                let column = x as usize * cells.len() / wide as usize;
                let index = FIRST + cells[column] as u8;
                canvas.set(frame.left as i64 + x, frame.top as i64 + y, index);
            }
        }
        canvas.axes(&frame);
        for (x, y, index) in self.legend(&frame) {
            let (x, y) = (x as i64, y as i64);
            for (dx, dy) in (0..SQUARE as i64).flat_map(|a| (0..SQUARE as i64).map(move |b| (a, b)))
            {
                canvas.set(x + dx, y + dy, FIRST + index as u8);
            }
            let top = y + (SQUARE as i64 - SIZE.1) / 2 + 1;
            canvas.write(&self.swatches[index].name, x + SQUARE as i64 + 6, top);
        }
        canvas.encode(paper, self.swatches.iter().map(|swatch| swatch.colour))
    }
}
