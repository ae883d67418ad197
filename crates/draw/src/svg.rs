//! Scenes as SVG: light or dark by the reader's setting; words stay words.

use std::fmt::Write;

use crate::palette::{Paint, Paper};
use crate::raster;
use crate::scene::{Anchor, Outline, Scene, SceneItem};
use crate::text::{DROP, INDEX, Text};

/// Typefaces of the words: the one that widths are measured with, then others.
const FACES: &str = "'DejaVu Sans Condensed', 'Helvetica Neue', Arial, sans-serif";

/// Draws a scene as a file.
pub fn svg(scene: &Scene) -> String {
    let (width, height) = (number(scene.width), number(scene.height));
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}mm\" height=\"{height}mm\" role=\"img\">\n<title>{}</title>\n<style>\n\
         text {{ font-family: {FACES}; }}\n",
        escaped(&scene.title)
    );
    let mut writer = SvgWriter::new(false);
    let body = writer.body(scene);
    out.push_str(&writer.colours(Paper::Light));
    let dark = writer.colours(Paper::Dark);
    let _ = write!(out, "@media (prefers-color-scheme: dark) {{\n{dark}}}\n</style>\n");
    let _ = writeln!(
        out,
        "<rect class=\"paper\" fill=\"currentColor\" width=\"{width}\" height=\"{height}\"/>"
    );
    out + &body + "</svg>\n"
}

/// Draws a scene within a page, which provides the paper and the colour of the words.
pub fn inline_svg(scene: &Scene) -> String {
    let (width, height) = (number(scene.width), number(scene.height));
    let mut writer = SvgWriter::new(true);
    let body = writer.body(scene);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         style=\"width:{width}mm;max-width:100%;height:auto\" role=\"img\">\n<title>{}</title>\n\
         <g font-family=\"{FACES}\">\n{body}</g>\n</svg>\n",
        escaped(&scene.title)
    )
}

/// Writer of items, which notes the colours that they use.
struct SvgWriter {
    /// Whether a page provides the ink, and colours are written in place.
    is_inline: bool,
    /// Colours that differ between light and dark paper.
    used: Vec<Paint>,
}

impl SvgWriter {
    fn new(is_inline: bool) -> Self {
        let used = match is_inline {
            true => Vec::new(),
            false => vec![Paint::Paper, Paint::Ink, Paint::Soft, Paint::Grid],
        };
        Self { is_inline, used }
    }

    /// Rules for the classes of the colours.
    fn colours(&self, paper: Paper) -> String {
        let rule = |(place, paint): (usize, &Paint)| {
            format!(".{} {{ color: {}; }}\n", class(*paint, place), hex(paint.on(paper)))
        };
        self.used.iter().enumerate().map(rule).collect()
    }

    /// Attributes that give an item its colour, by the class if light and dark differ.
    fn painted(&mut self, paint: Paint, inside: bool, outline: bool) -> String {
        let (fill, stroke) = match (self.is_inline, paint) {
            (true, Paint::Ink) => ("currentColor".to_string(), String::new()),
            (true, Paint::Each(light, _)) | (_, Paint::Same(light)) => (hex(light), String::new()),
            (true, other) => (hex(other.on(Paper::Light)), String::new()),
            (false, _) => {
                let place = self.used.iter().position(|used| *used == paint);
                let place = place.unwrap_or_else(|| {
                    self.used.push(paint);
                    self.used.len() - 1
                });
                ("currentColor".to_string(), format!("class=\"{}\" ", class(paint, place)))
            }
        };
        let fill_of = if inside { &fill } else { "none" };
        let mut out = format!("{stroke}fill=\"{fill_of}\"");
        if outline {
            let _ = write!(out, " stroke=\"{fill}\"");
        }
        out
    }

    fn body(&mut self, scene: &Scene) -> String {
        let mut out = String::new();
        for item in &scene.items {
            self.item(&mut out, item);
        }
        out
    }

    fn item(&mut self, out: &mut String, item: &SceneItem) {
        match item {
            SceneItem::Dots { at, diameter, paint, opacity } => {
                let attributes = self.painted(*paint, false, true);
                let round =
                    format!("stroke-linecap=\"round\" stroke-width=\"{}\"", number(*diameter));
                dots(out, at, &format!("{attributes} {round}"), *opacity);
            }
            SceneItem::Lines { lines, width, paint, opacity } => {
                let attributes = self.painted(*paint, false, true);
                let path: String = lines.iter().map(|line| path(line)).collect();
                let _ = writeln!(
                    out,
                    "<path {attributes} stroke-linejoin=\"round\" stroke-width=\"{}\"{} d=\"{path}\"/>",
                    number(*width),
                    faint("opacity", *opacity)
                );
            }
            SceneItem::Boxes { boxes, paint } => {
                let attributes = self.painted(*paint, true, false);
                let _ = write!(out, "<path {attributes} shape-rendering=\"crispEdges\" d=\"");
                for place in boxes {
                    let [x, y, width, height] = place.map(number);
                    let _ = write!(out, "M{x} {y}h{width}v{height}h-{width}z");
                }
                out.push_str("\"/>\n");
            }
            SceneItem::Shape { outline, fill, stroke, opacity } => {
                if let Some(fill) = fill {
                    let attributes = self.painted(*fill, true, false);
                    shape(out, outline, &format!("{attributes}{}", faint("opacity", *opacity)));
                }
                if let Some((paint, width)) = stroke {
                    let attributes = self.painted(*paint, false, true);
                    shape(
                        out,
                        outline,
                        &format!("{attributes} stroke-width=\"{}\"", number(*width)),
                    );
                }
            }
            SceneItem::Words { at, text, size, anchor, turned, paint } => {
                let attributes = self.painted(*paint, true, false);
                let anchor = match anchor {
                    Anchor::Start => "start",
                    Anchor::Middle => "middle",
                    Anchor::End => "end",
                };
                let [x, y] = at.map(number);
                let turn = if *turned {
                    format!(" transform=\"rotate(-90 {x} {y})\"")
                } else {
                    String::new()
                };
                let _ = writeln!(
                    out,
                    "<text {attributes} x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\"{turn}>{}</text>",
                    number(*size),
                    words(text, *size)
                );
            }
            SceneItem::Image { place, columns, pixels } => {
                let colour = |paint: &Option<Paint>| match paint.map(|paint| paint.on(Paper::Light))
                {
                    Some([r, g, b]) => [r, g, b, 255],
                    None => [0; 4],
                };
                let pixels: Vec<[u8; 4]> = pixels.iter().map(colour).collect();
                let Ok(bytes) = raster::encoded(&pixels, *columns, None) else { return };
                let [x, y, width, height] = place.map(number);
                let _ = writeln!(
                    out,
                    "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
                     preserveAspectRatio=\"none\" image-rendering=\"pixelated\" \
                     href=\"data:image/png;base64,{}\"/>",
                    base64(&bytes)
                );
            }
        }
    }
}

fn class(paint: Paint, place: usize) -> String {
    match paint {
        Paint::Paper => "paper".to_string(),
        Paint::Ink => "ink".to_string(),
        Paint::Soft => "soft".to_string(),
        Paint::Grid => "grid".to_string(),
        _ => format!("c{place}"),
    }
}

fn faint(name: &str, opacity: f64) -> String {
    if opacity < 1.0 { format!(" {name}=\"{}\"", number(opacity)) } else { String::new() }
}

fn shape(out: &mut String, outline: &Outline, attributes: &str) {
    let _ = match outline {
        Outline::Circle([x, y], radius) => {
            let [x, y, radius] = [*x, *y, *radius].map(number);
            writeln!(out, "<circle {attributes} cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"/>")
        }
        Outline::Polygon(corners) => {
            let corners: Vec<String> =
                corners.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y))).collect();
            writeln!(out, "<polygon {attributes} points=\"{}\"/>", corners.join(" "))
        }
    };
}

/// Draws dots as strokes of length zero: one path, or one each where overlaps have to add up.
fn dots(out: &mut String, at: &[[f64; 2]], attributes: &str, opacity: f64) {
    let mut seen: Vec<[i64; 2]> = at.iter().map(|point| point.map(hundredths)).collect();
    if opacity < 1.0 {
        let _ = writeln!(out, "<g {attributes} stroke-opacity=\"{}\">", number(opacity));
        for [x, y] in seen {
            let _ = writeln!(out, "<path d=\"M{} {}h0\"/>", decimal(x), decimal(y));
        }
        out.push_str("</g>\n");
        return;
    }
    seen.sort_unstable();
    seen.dedup();
    if seen.is_empty() {
        return;
    }
    let _ = write!(out, "<path {attributes} d=\"");
    let mut last = [0, 0];
    for [x, y] in seen {
        let _ = write!(out, "m{} {}h0", decimal(x - last[0]), decimal(y - last[1]));
        last = [x, y];
    }
    out.push_str("\"/>\n");
}

/// Path through points.
fn path(points: &[[f64; 2]]) -> String {
    let mut out = String::new();
    let mut last: Option<[i64; 2]> = None;
    for point in points {
        let at = point.map(hundredths);
        let _ = match last {
            Some(before) if before == at => continue,
            Some([x, y]) => write!(out, "l{} {}", decimal(at[0] - x), decimal(at[1] - y)),
            None => write!(out, "M{} {}", decimal(at[0]), decimal(at[1])),
        };
        last = Some(at);
    }
    out
}

/// Words of a text, with spans for slanted letters and indices.
fn words(text: &Text, size: f64) -> String {
    let mut out = String::new();
    let mut is_low = false;
    for piece in &text.pieces {
        let letters = escaped(&piece.letters);
        let slant = if piece.slanted { " font-style=\"italic\"" } else { "" };
        let shift = match (is_low, piece.lowered) {
            (false, true) => format!(" dy=\"{}\"", number(DROP * size)),
            (true, false) => format!(" dy=\"-{}\"", number(DROP * size)),
            _ => String::new(),
        };
        let small = match piece.lowered {
            true => format!(" font-size=\"{}\"", number(INDEX * size)),
            false => String::new(),
        };
        is_low = piece.lowered;
        match slant.is_empty() && shift.is_empty() && small.is_empty() {
            true => out.push_str(&letters),
            false => {
                let _ = write!(out, "<tspan{slant}{shift}{small}>{letters}</tspan>");
            }
        }
    }
    out
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Millimetres as whole hundredths.
fn hundredths(value: f64) -> i64 {
    (value * 100.0).round() as i64
}

fn number(value: f64) -> String {
    decimal(hundredths(value))
}

/// Hundredths as a decimal.
fn decimal(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let (whole, part) = (value.abs() / 100, value.abs() % 100);
    match (whole, part) {
        (_, 0) => format!("{sign}{whole}"),
        (0, _) => format!("{sign}.{}", format!("{part:02}").trim_end_matches('0')),
        _ => format!("{sign}{whole}.{}", format!("{part:02}").trim_end_matches('0')),
    }
}

/// Bytes in the alphabet of base 64.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::new();
    for three in bytes.chunks(3) {
        let byte = |k: usize| u32::from(three.get(k).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for k in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= three.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_decimals() {
        let shown = [0.0, 1.5, -0.25, 12.346, -3.0, 0.05].map(number);
        assert_eq!(shown, ["0", "1.5", "-.25", "12.35", "-3", ".05"]);
        assert_eq!([&b"M"[..], b"Ma", b"Man"].map(base64), ["TQ==", "TWE=", "TWFu"]);
    }
}
