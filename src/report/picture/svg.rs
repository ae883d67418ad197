//! The picture as SVG: a path of round points for each colour.

use std::fmt::Write;

use super::palette::colour;
use super::{Dot, Frame, Picture, TICKS_L, TICKS_Z};
use crate::report::diagram::escape;

/// The diameter of a dot in pixels.
const DOT: f64 = 1.4;

/// The picture; dark where the reader prefers that.
pub fn svg(picture: &Picture) -> String {
    let frame = picture.frame();
    let (width, height) = frame.total;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" role=\"img\">\n<title>{}</title>\n<style>\n\
         text {{ font: 12px system-ui, sans-serif; fill: #222; }}\n.paper {{ fill: #fff; }}\n\
         path {{ fill: none; stroke-linecap: round; stroke-width: {DOT}; }}\n\
         .frame {{ stroke: #888; fill: none; stroke-width: 1; }}\n.over {{ stroke: #111; }}\n\
         .mark {{ stroke: #111; fill: none; stroke-width: 1.2; }}\n\
         @media (prefers-color-scheme: dark) {{\ntext {{ fill: #ddd; }}\n.paper {{ fill: #14171c; }}\n\
         .over, .mark {{ stroke: #f5f5f5; }}\n}}\n</style>\n\
         <rect class=\"paper\" width=\"{width}\" height=\"{height}\"/>\n",
        escape(&picture.title)
    );
    axes(&mut out, &frame);
    for layer in &picture.layers {
        let [r, g, b] = colour(layer.shade);
        path(&mut out, &frame, &layer.dots, &format!("stroke=\"#{r:02x}{g:02x}{b:02x}\""));
    }
    path(&mut out, &frame, &picture.overlay, "class=\"over\"");
    for mark in &picture.marks {
        let (x, y) = (frame.x(mark.l), frame.y(mark.z));
        let _ = writeln!(out, "<circle class=\"mark\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\"/>");
    }
    out.push_str("</svg>\n");
    out
}

fn axes(out: &mut String, frame: &Frame) {
    let (left, top) = (frame.left, frame.top);
    let (right, bottom) = (left + frame.width, top + frame.height);
    let _ = writeln!(
        out,
        "<rect class=\"frame\" x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\"/>",
        frame.width, frame.height
    );
    for (l, name) in TICKS_L {
        let x = frame.x(l);
        let _ = writeln!(
            out,
            "<path class=\"frame\" d=\"M{x:.1} {bottom}v4\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{name}</text>",
            bottom + 18.0
        );
    }
    for (z, name) in TICKS_Z {
        let y = frame.y(z);
        let _ = writeln!(
            out,
            "<path class=\"frame\" d=\"M{left} {y:.1}h-4\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{name}</text>",
            left - 7.0,
            y + 4.0
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{:.1}\" y=\"{:.1}\" font-style=\"italic\">l</text>\
         <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">L/G</text>",
        (frame.x(TICKS_L[3].0) + right) / 2.0,
        bottom + 18.0,
        left - 7.0,
        frame.y(0.75) + 4.0
    );
}

/// Points as strokes of no length, each relative to the one before.
fn path(out: &mut String, frame: &Frame, dots: &[Dot], attributes: &str) {
    if dots.is_empty() {
        return;
    }
    let _ = write!(out, "<path {attributes} d=\"");
    // Tenths of a pixel.
    let place = |dot: &Dot| {
        let tenths = |x: f64| (x * 10.0).round() as i64;
        (tenths(frame.x(dot.l)), tenths(frame.y(dot.z)))
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

/// A number of tenths as a decimal.
fn tenth(value: i64) -> String {
    let sign = if value < 0 { "-" } else { "" };
    let (whole, part) = (value.abs() / 10, value.abs() % 10);
    match (whole, part) {
        (_, 0) => format!("{sign}{whole}"),
        (0, _) => format!("{sign}.{part}"),
        _ => format!("{sign}{whole}.{part}"),
    }
}
