//! Pictures as PNG: a palette image, independent of time and machine.

use super::glyphs::{ADVANCE, SIZE, rows};
use super::palette::{Paper, colour};
use super::{Dot, Frame, Picture, Tint};

/// Number of colours of dots; paper, frame and ink come before them in the palette.
const SHADES: u8 = 96;
const PAPER: u8 = 0;
const LINE: u8 = 1;
pub(super) const INK: u8 = 2;
pub(super) const FIRST: u8 = 3;

/// Pixels of a picture as palette indices.
pub(super) struct Canvas {
    width: i64,
    height: i64,
    pixels: Vec<u8>,
}

/// Renders the picture of a section as PNG.
pub fn png(picture: &Picture, paper: Paper) -> Result<Vec<u8>, png::EncodingError> {
    let frame = picture.frame();
    let mut canvas = Canvas::new(&frame);
    for layer in &picture.layers {
        let index = match layer.tint {
            Tint::Shade(shade) => {
                FIRST + (shade.clamp(0.0, 1.0) * f64::from(SHADES - 1)).round() as u8
            }
            Tint::Faint => LINE,
        };
        match layer.joined {
            true => canvas.line(&frame, &layer.dots, index),
            false => canvas.dots(&frame, &layer.dots, index),
        }
    }
    canvas.dots(&frame, &picture.overlay, INK);
    for mark in &picture.marks {
        canvas.ring(frame.x(mark.x), frame.y(mark.y));
    }
    canvas.axes(&frame);
    let shades = (0..SHADES).map(|shade| colour(f64::from(shade) / f64::from(SHADES - 1)));
    canvas.encode(paper, shades)
}

impl Canvas {
    pub fn new(frame: &Frame) -> Self {
        let (width, height) = (frame.total.0 as i64, frame.total.1 as i64);
        Self { width, height, pixels: vec![PAPER; (width * height) as usize] }
    }

    pub fn set(&mut self, x: i64, y: i64, index: u8) {
        if (0..self.width).contains(&x) && (0..self.height).contains(&y) {
            self.pixels[(y * self.width + x) as usize] = index;
        }
    }

    fn dots(&mut self, frame: &Frame, dots: &[Dot], index: u8) {
        for dot in dots {
            self.set(frame.x(dot.x) as i64, frame.y(dot.y) as i64, index);
        }
    }

    /// Draws a line through points; it is broken where one is undefined.
    fn line(&mut self, frame: &Frame, dots: &[Dot], index: u8) {
        for pair in dots.windows(2) {
            let [from, to] = [&pair[0], &pair[1]].map(|dot| (frame.x(dot.x), frame.y(dot.y)));
            let (dx, dy) = (to.0 - from.0, to.1 - from.1);
            let steps = dx.abs().max(dy.abs()).ceil();
            if !steps.is_finite() {
                continue;
            }
            for step in 0..=steps as u32 {
                let share = if steps > 0.0 { f64::from(step) / steps } else { 0.0 };
                self.set((from.0 + share * dx) as i64, (from.1 + share * dy) as i64, index);
            }
        }
    }

    /// Draws a circle of radius 4.
    fn ring(&mut self, x: f64, y: f64) {
        for step in 0..64 {
            let angle = f64::from(step) * std::f64::consts::PI / 32.0;
            self.set((x + 4.0 * libm::cos(angle)) as i64, (y + 4.0 * libm::sin(angle)) as i64, INK);
        }
    }

    pub fn axes(&mut self, frame: &Frame) {
        let (left, top) = (frame.left as i64 - 1, frame.top as i64 - 1);
        let (right, bottom) = (left + frame.width as i64 + 1, top + frame.height as i64 + 1);
        for x in left..=right {
            self.set(x, top, LINE);
            self.set(x, bottom, LINE);
        }
        for y in top..=bottom {
            self.set(left, y, LINE);
            self.set(right, y, LINE);
        }
        let extent = |text: &str| ADVANCE * spelled(text).chars().count() as i64;
        for (value, word) in frame.across.ticks() {
            let x = frame.x(*value) as i64;
            (1..5).for_each(|k| self.set(x.min(right), bottom + k, LINE));
            let width = extent(word) - 1;
            self.write(word, (x - width / 2).min(self.width - width - 1), bottom + 8);
        }
        for (value, word) in frame.up.ticks() {
            let y = (frame.y(*value) as i64).clamp(top, bottom);
            (1..5).for_each(|k| self.set(left - k, y, LINE));
            self.write(word, left - 6 - extent(word), (y - SIZE.1 / 2).max(0));
        }
        let name = |name: &str| if name == "l" { "ℓ".to_string() } else { name.to_string() };
        let (across, up) = (name(&frame.across.name), name(&frame.up.name));
        let x = frame.x(frame.across.name_at()) as i64 - extent(&across) / 2;
        self.write(&across, x, bottom + 8);
        let y = frame.y(frame.up.name_at()) as i64 - SIZE.1 / 2;
        self.write(&up, left - 6 - extent(&up), y);
    }

    /// Writes a text from the left. Returns the position of the next letter.
    pub fn write(&mut self, text: &str, left: i64, top: i64) -> i64 {
        let mut place = left;
        for letter in spelled(text).chars() {
            for (row, bits) in rows(letter).into_iter().enumerate() {
                for column in 0..SIZE.0 {
                    if bits >> (SIZE.0 - 1 - column) & 1 == 1 {
                        self.set(place + column, top + row as i64, INK);
                    }
                }
            }
            place += ADVANCE;
        }
        place
    }

    pub fn encode(
        self,
        paper: Paper,
        colours: impl IntoIterator<Item = [u8; 3]>,
    ) -> Result<Vec<u8>, png::EncodingError> {
        let mut palette = paper.colours().concat();
        palette.extend(colours.into_iter().flatten());
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(palette);
        encoder.set_filter(png::Filter::NoFilter);
        encoder.set_compression(png::Compression::High);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&self.pixels)?;
        writer.finish()?;
        Ok(bytes)
    }
}

/// Spells out Greek letters that have no glyph.
fn spelled(text: &str) -> String {
    let names = [
        ("α", "alpha"),
        ("β", "beta"),
        ("γ", "gamma"),
        ("ε", "eps"),
        ("θ", "theta"),
        ("κ", "kappa"),
        ("λ", "lambda"),
        ("μ", "mu"),
        ("ν", "nu"),
        ("ρ", "rho"),
        ("σ", "sigma"),
        ("φ", "phi"),
        ("ψ", "psi"),
        ("ω", "omega"),
        ("Ω", "Omega"),
    ];
    names.iter().fold(text.to_string(), |text, (letter, name)| text.replace(letter, name))
}
