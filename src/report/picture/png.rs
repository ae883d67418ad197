//! The picture as PNG: a palette image, without anything that depends on time or place.

use super::glyphs::{ADVANCE, SIZE, rows};
use super::palette::colour;
use super::{Dot, Frame, Picture, TICKS_L, TICKS_Z};

/// Colours of dots; paper, frame and overlay come before them.
const SHADES: u8 = 96;
const PAPER: u8 = 0;
const LINE: u8 = 1;
const INK: u8 = 2;
const FIRST: u8 = 3;

/// The pixels of a picture as palette indices.
struct Canvas {
    width: i64,
    height: i64,
    pixels: Vec<u8>,
}

/// The picture on white paper.
pub fn png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let frame = picture.frame();
    let (width, height) = (frame.total.0 as i64, frame.total.1 as i64);
    let pixels = vec![PAPER; (width * height) as usize];
    let mut canvas = Canvas { width, height, pixels };
    for layer in &picture.layers {
        let shade = (layer.shade.clamp(0.0, 1.0) * f64::from(SHADES - 1)).round() as u8;
        canvas.dots(&frame, &layer.dots, FIRST + shade);
    }
    canvas.dots(&frame, &picture.overlay, INK);
    for mark in &picture.marks {
        canvas.ring(frame.x(mark.l), frame.y(mark.z));
    }
    canvas.axes(&frame);
    canvas.encode()
}

impl Canvas {
    fn set(&mut self, x: i64, y: i64, index: u8) {
        if (0..self.width).contains(&x) && (0..self.height).contains(&y) {
            self.pixels[(y * self.width + x) as usize] = index;
        }
    }

    fn dots(&mut self, frame: &Frame, dots: &[Dot], index: u8) {
        for dot in dots {
            self.set(frame.x(dot.l) as i64, frame.y(dot.z) as i64, index);
        }
    }

    /// A circle of radius 4.
    fn ring(&mut self, x: f64, y: f64) {
        for step in 0..64 {
            let angle = f64::from(step) * std::f64::consts::PI / 32.0;
            self.set((x + 4.0 * libm::cos(angle)) as i64, (y + 4.0 * libm::sin(angle)) as i64, INK);
        }
    }

    fn axes(&mut self, frame: &Frame) {
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
        for (l, name) in TICKS_L {
            let x = frame.x(l) as i64;
            (1..5).for_each(|k| self.set(x.min(right), bottom + k, LINE));
            let width = ADVANCE * name.chars().count() as i64 - 1;
            self.write(name, (x - width / 2).min(self.width - width - 1), bottom + 8);
        }
        for (z, name) in TICKS_Z {
            let y = (frame.y(z) as i64).clamp(top, bottom);
            (1..5).for_each(|k| self.set(left - k, y, LINE));
            let width = ADVANCE * name.chars().count() as i64;
            self.write(name, left - 6 - width, (y - SIZE.1 / 2).max(0));
        }
        self.write("l", (frame.x(TICKS_L[3].0) as i64 + right) / 2, bottom + 8);
        self.write("L/G", left - 6 - 3 * ADVANCE, frame.y(0.75) as i64 - SIZE.1 / 2);
    }

    fn write(&mut self, text: &str, left: i64, top: i64) {
        for (place, letter) in text.chars().enumerate() {
            for (row, bits) in rows(letter).into_iter().enumerate() {
                for column in 0..SIZE.0 {
                    if bits >> (SIZE.0 - 1 - column) & 1 == 1 {
                        self.set(left + place as i64 * ADVANCE + column, top + row as i64, INK);
                    }
                }
            }
        }
    }

    fn encode(self) -> Result<Vec<u8>, png::EncodingError> {
        let mut palette = vec![255, 255, 255, 136, 136, 136, 17, 17, 17];
        for shade in 0..SHADES {
            palette.extend(colour(f64::from(shade) / f64::from(SHADES - 1)));
        }
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
