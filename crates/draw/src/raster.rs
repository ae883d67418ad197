//! Scenes as PNG, with smooth edges.

use std::collections::BTreeMap;

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, PathBuilder, Pixmap, PixmapPaint, Rect, Stroke, Transform,
};

use crate::font::{self, Pen};
use crate::palette::{Paint, Paper};
use crate::scene::{Anchor, Outline, Scene, SceneItem};
use crate::text::{DROP, INDEX, Text};

/// Reasons why no PNG can be made.
#[derive(Debug)]
pub enum PngError {
    /// Picture of more pixels than are drawn.
    Size {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// Failure of the encoder.
    Encoding(png::EncodingError),
}

impl std::fmt::Display for PngError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Size { width, height } => {
                write!(f, "a picture of {width:.0} by {height:.0} pixels is too large")
            }
            Self::Encoding(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for PngError {}

/// Most pixels of a picture.
const MOST_PIXELS: f64 = 2e8;
const INCH: f64 = 25.4;

/// Draws a scene with a number of pixels to the inch.
pub fn png(scene: &Scene, dots_an_inch: f64, paper: Paper) -> Result<Vec<u8>, PngError> {
    let scale = dots_an_inch / INCH;
    let (width, height) = ((scene.width * scale).round(), (scene.height * scale).round());
    let fits = width >= 1.0 && height >= 1.0 && width * height <= MOST_PIXELS;
    let pixmap = if fits { Pixmap::new(width as u32, height as u32) } else { None };
    let mut canvas = Canvas {
        pixmap: pixmap.ok_or(PngError::Size { width, height })?,
        scale: scale as f32,
        paper,
    };
    let [r, g, b] = Paint::Paper.on(paper);
    canvas.pixmap.fill(Color::from_rgba8(r, g, b, 255));
    scene.items.iter().for_each(|item| canvas.item(item));
    let pixels: Vec<[u8; 4]> =
        canvas.pixmap.pixels().iter().map(|p| [p.red(), p.green(), p.blue(), 255]).collect();
    encoded(&pixels, width as usize, Some(dots_an_inch)).map_err(PngError::Encoding)
}

/// Encodes pixels, with a palette where 256 colours suffice.
pub(crate) fn encoded(
    pixels: &[[u8; 4]],
    columns: usize,
    dots_an_inch: Option<f64>,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut places: BTreeMap<[u8; 4], u8> = BTreeMap::new();
    let mut is_small = true;
    for pixel in pixels {
        if !places.contains_key(pixel) {
            if places.len() == 256 {
                is_small = false;
                break;
            }
            places.insert(*pixel, places.len() as u8);
        }
    }
    let rows = pixels.len() / columns.max(1);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, columns as u32, rows as u32);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    if let Some(density) = dots_an_inch {
        let metre = (density / INCH * 1000.0).round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: metre,
            yppu: metre,
            unit: png::Unit::Meter,
        }));
    }
    let is_solid = pixels.iter().all(|pixel| pixel[3] == 255);
    let data: Vec<u8> = if is_small {
        let mut palette = vec![[0; 4]; places.len()];
        places.iter().for_each(|(colour, place)| palette[usize::from(*place)] = *colour);
        encoder.set_color(png::ColorType::Indexed);
        encoder
            .set_palette(palette.iter().flat_map(|[r, g, b, _]| [*r, *g, *b]).collect::<Vec<_>>());
        if !is_solid {
            encoder.set_trns(palette.iter().map(|colour| colour[3]).collect::<Vec<_>>());
        }
        encoder.set_filter(png::Filter::NoFilter);
        pixels.iter().map(|pixel| places.get(pixel).copied().unwrap_or(0)).collect()
    } else {
        let kind = if is_solid { png::ColorType::Rgb } else { png::ColorType::Rgba };
        encoder.set_color(kind);
        encoder.set_filter(png::Filter::Adaptive);
        let parts = if is_solid { 3 } else { 4 };
        pixels.iter().flat_map(|pixel| pixel.iter().take(parts).copied()).collect()
    };
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&data)?;
    writer.finish()?;
    Ok(bytes)
}

struct Canvas {
    pixmap: Pixmap,
    /// Pixels to the millimetre.
    scale: f32,
    paper: Paper,
}

impl Canvas {
    fn paint(&self, paint: Paint, opacity: f64) -> tiny_skia::Paint<'static> {
        let [r, g, b] = paint.on(self.paper);
        let mut found = tiny_skia::Paint::default();
        found.set_color_rgba8(r, g, b, (255.0 * opacity.clamp(0.0, 1.0)).round() as u8);
        found.anti_alias = true;
        found
    }

    fn placed(&self) -> Transform {
        Transform::from_scale(self.scale, self.scale)
    }

    fn fill(&mut self, path: PathBuilder, paint: &tiny_skia::Paint<'_>, transform: Transform) {
        if let Some(path) = path.finish() {
            self.pixmap.fill_path(&path, paint, FillRule::Winding, transform, None);
        }
    }

    fn stroke(&mut self, path: PathBuilder, width: f64, paint: &tiny_skia::Paint<'_>) {
        let stroke = Stroke {
            width: width as f32,
            line_cap: LineCap::Butt,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        let transform = self.placed();
        if let Some(path) = path.finish() {
            self.pixmap.stroke_path(&path, paint, &stroke, transform, None);
        }
    }

    fn item(&mut self, item: &SceneItem) {
        match item {
            SceneItem::Dots { at, diameter, paint, opacity } => {
                let paint = self.paint(*paint, *opacity);
                let transform = self.placed();
                for [x, y] in at {
                    let mut path = PathBuilder::new();
                    path.push_circle(*x as f32, *y as f32, (*diameter / 2.0) as f32);
                    self.fill(path, &paint, transform);
                }
            }
            SceneItem::Lines { lines, width, paint, opacity } => {
                let mut path = PathBuilder::new();
                for line in lines {
                    follow(&mut path, line);
                }
                let paint = self.paint(*paint, *opacity);
                self.stroke(path, *width, &paint);
            }
            SceneItem::Boxes { boxes, paint } => {
                let mut paint = self.paint(*paint, 1.0);
                // Neighbours share their edges: half covered pixels would show them.
                paint.anti_alias = false;
                for [x, y, width, height] in boxes.iter().map(|place| place.map(|v| v as f32)) {
                    if let Some(place) = Rect::from_xywh(x, y, width, height) {
                        self.pixmap.fill_rect(place, &paint, self.placed(), None);
                    }
                }
            }
            SceneItem::Shape { outline, fill, stroke, opacity } => {
                if let Some(fill) = fill {
                    let (paint, transform) = (self.paint(*fill, *opacity), self.placed());
                    self.fill(outlined(outline), &paint, transform);
                }
                if let Some((paint, width)) = stroke {
                    let paint = self.paint(*paint, 1.0);
                    self.stroke(outlined(outline), *width, &paint);
                }
            }
            SceneItem::Words { at, text, size, anchor, turned, paint } => {
                let paint = self.paint(*paint, 1.0);
                let turn = Transform::from_rotate(if *turned { -90.0 } else { 0.0 });
                let there = self.placed().pre_translate(at[0] as f32, at[1] as f32);
                let mut path = LetterPath(PathBuilder::new(), [0.0; 2], 0.0);
                write(text, *size, *anchor, &mut path);
                self.fill(path.0, &paint, there.pre_concat(turn));
            }
            SceneItem::Image { place, columns, pixels } => self.image(*place, *columns, pixels),
        }
    }

    fn image(&mut self, [x, y, width, height]: [f64; 4], columns: usize, pixels: &[Option<Paint>]) {
        let rows = pixels.len() / columns.max(1);
        let Some(mut image) = Pixmap::new(columns as u32, rows as u32) else { return };
        for (to, from) in image.data_mut().chunks_exact_mut(4).zip(pixels) {
            if let Some([r, g, b]) = from.map(|paint| paint.on(self.paper)) {
                to.copy_from_slice(&[r, g, b, 255]);
            }
        }
        let (across, up) = (width as f32 / columns as f32, height as f32 / rows as f32);
        let transform = self.placed().pre_translate(x as f32, y as f32).pre_scale(across, up);
        self.pixmap.draw_pixmap(0, 0, image.as_ref(), &PixmapPaint::default(), transform, None);
    }
}

fn follow(path: &mut PathBuilder, line: &[[f64; 2]]) {
    for (place, [x, y]) in line.iter().enumerate() {
        match place {
            0 => path.move_to(*x as f32, *y as f32),
            _ => path.line_to(*x as f32, *y as f32),
        }
    }
}

fn outlined(outline: &Outline) -> PathBuilder {
    let mut path = PathBuilder::new();
    match outline {
        Outline::Circle([x, y], radius) => path.push_circle(*x as f32, *y as f32, *radius as f32),
        Outline::Polygon(corners) => {
            follow(&mut path, corners);
            path.close();
        }
    }
    path
}

/// Path of letters, with the place of the letter and its size.
struct LetterPath(PathBuilder, [f64; 2], f64);

impl LetterPath {
    fn at(&self, [x, y]: [f64; 2]) -> (f32, f32) {
        ((self.1[0] + self.2 * x) as f32, (self.1[1] - self.2 * y) as f32)
    }
}

impl Pen for LetterPath {
    fn go(&mut self, to: [f64; 2]) {
        let (x, y) = self.at(to);
        self.0.move_to(x, y);
    }

    fn line(&mut self, to: [f64; 2]) {
        let (x, y) = self.at(to);
        self.0.line_to(x, y);
    }

    fn curve(&mut self, control: [f64; 2], to: [f64; 2]) {
        let ((x1, y1), (x, y)) = (self.at(control), self.at(to));
        self.0.quad_to(x1, y1, x, y);
    }

    fn close(&mut self) {
        self.0.close();
    }
}

/// Distance from the position of words to their left end.
pub(crate) fn offset(text: &Text, size: f64, anchor: Anchor) -> f64 {
    match anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -text.width(size) / 2.0,
        Anchor::End => -text.width(size),
    }
}

fn write(text: &Text, size: f64, anchor: Anchor, path: &mut LetterPath) {
    path.1 = [offset(text, size, anchor), 0.0];
    for piece in &text.pieces {
        let face = font::face(piece.slanted);
        path.2 = if piece.lowered { INDEX * size } else { size };
        path.1[1] = if piece.lowered { DROP * size } else { 0.0 };
        for letter in piece.letters.chars() {
            let glyph = face.glyph(letter);
            face.draw(glyph, path);
            path.1[0] += face.advance(glyph) * path.2;
        }
    }
}
