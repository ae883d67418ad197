//! Pictures as SVG: a path of round points for each colour.

use std::fmt::Write;

use super::palette::colour;
use super::{Dot, Frame, Picture, Tint};
use crate::report::diagram::escape;

/// Diameter of a dot in pixels.
const DOT: f64 = 1.4;

/// Opens a picture, with dark colours where the reader prefers them.
pub(super) fn head(title: &str, frame: &Frame) -> String {
    let mut out = opening(title, frame);
    out.push_str(&format!(
        "<style>\ntext {{ font: 12px system-ui, sans-serif; fill: #222; }}\n.paper {{ fill: #fff; }}\n\
         path {{ fill: none; stroke-linecap: round; stroke-width: {DOT}; }}\n\
         .frame {{ stroke: #888; fill: none; stroke-width: 1; }}\n.over {{ stroke: #111; }}\n\
         .mark {{ stroke: #111; fill: none; stroke-width: 1.2; }}\n\
         @media (prefers-color-scheme: dark) {{\ntext {{ fill: #ddd; }}\n.paper {{ fill: #14171c; }}\n\
         .over, .mark {{ stroke: #f5f5f5; }}\n}}\n</style>\n\
         <rect class=\"paper\" width=\"{}\" height=\"{}\"/>\n",
        frame.total.0, frame.total.1
    ));
    out
}

fn opening(title: &str, frame: &Frame) -> String {
    let (width, height) = frame.total;
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" role=\"img\">\n<title>{}</title>\n",
        escape(title)
    )
}

/// Draws the picture of a section within a page, which provides the paper and the ink colour.
pub fn inline_svg(picture: &Picture) -> String {
    let frame = picture.frame();
    let mut out = opening(&picture.title, &frame);
    let group = format!(
        "<g font-size=\"12\" fill=\"currentColor\" stroke-linecap=\"round\" stroke-width=\"{DOT}\">\n"
    );
    out.push_str(&group);
    drawn(&mut out, picture, &frame);
    out + "</g>\n</svg>\n"
}

/// Draws the picture of a section.
pub fn svg(picture: &Picture) -> String {
    let frame = picture.frame();
    let mut out = head(&picture.title, &frame);
    drawn(&mut out, picture, &frame);
    out + "</svg>\n"
}

fn drawn(out: &mut String, picture: &Picture, frame: &Frame) {
    axes(out, frame);
    for layer in &picture.layers {
        let stroke = match layer.tint {
            Tint::Shade(shade) => hex(colour(shade)),
            Tint::Faint => "#888".to_string(),
        };
        let attributes = format!("stroke=\"{stroke}\"");
        match layer.joined {
            true => line(out, frame, &layer.dots, &attributes),
            false => path(out, frame, &layer.dots, &attributes),
        }
    }
    path(out, frame, &picture.overlay, "class=\"over\" stroke=\"currentColor\"");
    for mark in &picture.marks {
        let (x, y) = (frame.x(mark.x), frame.y(mark.y));
        let _ = writeln!(
            out,
            "<circle class=\"mark\" fill=\"none\" stroke=\"currentColor\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>"
        );
    }
}

pub(super) fn axes(out: &mut String, frame: &Frame) {
    let (left, top) = (frame.left, frame.top);
    let bottom = top + frame.height;
    let _ = writeln!(
        out,
        "<rect class=\"frame\" fill=\"none\" stroke=\"#888\" x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\"/>",
        frame.width, frame.height
    );
    for (value, word) in frame.across.ticks() {
        let x = frame.x(*value);
        let _ = writeln!(
            out,
            "<path class=\"frame\" stroke=\"#888\" d=\"M{x:.1} {bottom}v4\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{word}</text>",
            bottom + 18.0
        );
    }
    for (value, word) in frame.up.ticks() {
        let y = frame.y(*value);
        let _ = writeln!(
            out,
            "<path class=\"frame\" stroke=\"#888\" d=\"M{left} {y:.1}h-4\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{word}</text>",
            left - 7.0,
            y + 4.0
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-style=\"italic\">{}</text>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
        frame.x(frame.across.name_at()),
        bottom + 18.0,
        escape(&frame.across.name),
        left - 7.0,
        frame.y(frame.up.name_at()) + 4.0,
        escape(&frame.up.name)
    );
}

/// Formats a colour for SVG.
pub(super) fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Draws points as strokes of length zero, each relative to the one before.
fn path(out: &mut String, frame: &Frame, dots: &[Dot], attributes: &str) {
    if dots.is_empty() {
        return;
    }
    let _ = write!(out, "<path {attributes} d=\"");
    // Positions in tenths of a pixel.
    let place = |dot: &Dot| {
        let tenths = |x: f64| (x * 10.0).round() as i64;
        (tenths(frame.x(dot.x)), tenths(frame.y(dot.y)))
    };
    let mut seen: Vec<(i64, i64)> = dots.iter().map(place).collect();
    seen.sort_unstable();
    seen.dedup();
    let mut last = (0, 0);
    for (x, y) in seen {
        let (dx, dy) = (x - last.0, y - last.1);
        let _ = write!(out, "m{} {}h0", tenth(dx), tenth(dy));
        last = (x, y);
    }
    out.push_str("\"/>\n");
}

/// Draws a line through points; it is broken where one is undefined.
fn line(out: &mut String, frame: &Frame, dots: &[Dot], attributes: &str) {
    let _ = write!(out, "<path fill=\"none\" {attributes} d=\"");
    let mut last: Option<(i64, i64)> = None;
    for dot in dots {
        if !(dot.x.is_finite() && dot.y.is_finite()) {
            last = None;
            continue;
        }
        let tenths = |x: f64| (x * 10.0).round() as i64;
        let at = (tenths(frame.x(dot.x)), tenths(frame.y(dot.y)));
        match last {
            Some(before) if before == at => continue,
            Some((x, y)) => {
                let _ = write!(out, "l{} {}", tenth(at.0 - x), tenth(at.1 - y));
            }
            None => {
                let _ = write!(out, "M{} {}", tenth(at.0), tenth(at.1));
            }
        }
        last = Some(at);
    }
    out.push_str("\"/>\n");
}

/// Formats a number of tenths as a decimal.
fn tenth(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let (whole, part) = (value.abs() / 10, value.abs() % 10);
    match (whole, part) {
        (_, 0) => format!("{sign}{whole}"),
        (0, _) => format!("{sign}.{part}"),
        _ => format!("{sign}{whole}.{part}"),
    }
}
