//! Pictures as SVG: the body, a function on the sphere of normals, the place in the hierarchy.

use std::fmt::Write;

use liouville_search::survey::{HierarchyClass, HierarchyPlace, SphereMap, Wireframe};

/// A picture with its caption.
pub struct Picture {
    /// SVG element of the picture.
    pub svg: String,
    /// Caption of the picture.
    pub caption: String,
}

fn svg(width: f64, height: f64, caption: &str, inner: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         role=\"img\" aria-label=\"{caption}\" font-size=\"12\" fill=\"currentColor\">{inner}</svg>"
    )
}

/// Draws the body, seen from slightly above, with pale lines on the far side.
pub fn body(frame: &Wireframe) -> Picture {
    const SIZE: f64 = 260.0;
    // Orthonormal frame of the picture: right, up, towards the eye.
    let (right, up, eye) = ([-0.6, 0.8, 0.0], [-0.32, -0.24, 0.9165], [0.7332, 0.5499, 0.4]);
    let along = |a: [f64; 3], b: [f64; 3]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let reach = frame.lines.iter().flatten().map(|(r, _)| along(*r, *r).sqrt()).fold(0.0, f64::max);
    let scale = if reach > 0.0 { 0.46 * SIZE / reach } else { 1.0 };
    let place =
        |r: [f64; 3]| (SIZE / 2.0 + scale * along(r, right), SIZE / 2.0 - scale * along(r, up));
    let mut inner = String::new();
    for line in &frame.lines {
        for pair in line.windows(2) {
            let [(from, normal), (to, _)] = pair else { continue };
            let ((x1, y1), (x2, y2)) = (place(*from), place(*to));
            let opacity = if along(*normal, eye) > 0.0 { "0.9" } else { "0.18" };
            let _ = write!(
                inner,
                "<path d=\"M{x1:.1} {y1:.1}L{x2:.1} {y2:.1}\" stroke=\"currentColor\" stroke-width=\"1\" opacity=\"{opacity}\"/>"
            );
        }
    }
    let (x, y) = place([0.0; 3]);
    let _ = write!(inner, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.5\" fill=\"#c0392b\"/>");
    for (k, axis) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
        let end = axis.map(|x: f64| x * reach * 0.45);
        let (ex, ey) = place(end);
        let _ = write!(
            inner,
            "<path d=\"M{x:.1} {y:.1}L{ex:.1} {ey:.1}\" stroke=\"#c0392b\" stroke-width=\"1.5\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\" fill=\"#c0392b\">e{}</text>",
            ex + 3.0,
            ey - 2.0,
            k + 1
        );
    }
    let caption =
        "The surface of the body with its mass centre and the axes of the frame".to_string();
    Picture { svg: svg(SIZE, SIZE, &caption, &inner), caption }
}

/// Draws a function on the sphere, longitude to the right and latitude upwards.
pub fn sphere(map: &SphereMap) -> Picture {
    const CELL: f64 = 11.0;
    const LEFT: f64 = 44.0;
    const TOP: f64 = 8.0;
    let values = map.values.iter().flatten().flatten();
    let (low, high) = values
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
    // The criterion has both signs, and 0 in the middle of the scale.
    let is_signed = map.quantity.starts_with('C');
    let (low, high) = match is_signed {
        true => (-low.abs().max(high.abs()), low.abs().max(high.abs())),
        false => (low, high),
    };
    let colour = |x: f64| {
        let share = if high > low { (x - low) / (high - low) } else { 0.5 };
        if is_signed { mixed(&SIGNED, share) } else { mixed(&RISING, share) }
    };
    let (rows, columns) = (map.values.len(), map.longitudes.len());
    let (width, height) = (columns as f64 * CELL, rows as f64 * CELL);
    let mut inner = String::from("<g shape-rendering=\"crispEdges\">");
    for (k, row) in map.values.iter().enumerate() {
        for (j, value) in row.iter().enumerate() {
            let Some(value) = value else { continue };
            let (x, y) = (LEFT + j as f64 * CELL, TOP + (rows - 1 - k) as f64 * CELL);
            let _ = write!(
                inner,
                "<path d=\"M{x} {y}h{CELL}v{CELL}h-{CELL}z\" fill=\"{}\"/>",
                colour(*value)
            );
        }
    }
    inner.push_str("</g>");
    let mut label = |x: f64, y: f64, anchor: &str, words: &str| {
        let _ = write!(
            inner,
            "<text x=\"{x:.0}\" y=\"{y:.0}\" text-anchor=\"{anchor}\">{words}</text>"
        );
    };
    for (share, words) in [(0.0, "e₁"), (0.25, "e₂"), (0.5, "−e₁"), (0.75, "−e₂"), (1.0, "e₁")]
    {
        label(LEFT + share * width, TOP + height + 16.0, "middle", words);
    }
    for (share, words) in [(0.0, "e₃"), (0.5, "0°"), (1.0, "−e₃")] {
        label(LEFT - 6.0, TOP + share * height + 4.0, "end", words);
    }
    const STEPS: usize = 24;
    let (bar, step) = (LEFT + width + 18.0, height / STEPS as f64);
    for k in 0..STEPS {
        let share = (k as f64 + 0.5) / STEPS as f64;
        let y = TOP + height - (k as f64 + 1.0) * step;
        let fill = if is_signed { mixed(&SIGNED, share) } else { mixed(&RISING, share) };
        let _ =
            write!(inner, "<path d=\"M{bar} {y:.2}h14v{:.2}h-14z\" fill=\"{fill}\"/>", step + 0.3);
    }
    for (y, value) in [(TOP + 9.0, high), (TOP + height, low)] {
        let _ = write!(inner, "<text x=\"{:.0}\" y=\"{y:.0}\">{value:.3}</text>", bar + 20.0);
    }
    let caption = match is_signed {
        true => "The criterion over the sphere of normals γ".to_string(),
        false => "ln ρ over the sphere of normals γ".to_string(),
    };
    Picture { svg: svg(bar + 82.0, TOP + height + 26.0, &caption, &inner), caption }
}

/// Colour scale from dark to light, legible without colours too.
const RISING: [[f64; 3]; 5] = [
    [59.0, 15.0, 112.0],
    [49.0, 87.0, 149.0],
    [33.0, 145.0, 140.0],
    [94.0, 201.0, 98.0],
    [250.0, 230.0, 60.0],
];
/// Colour scale of negative, zero and positive values.
const SIGNED: [[f64; 3]; 5] = [
    [33.0, 72.0, 150.0],
    [130.0, 170.0, 215.0],
    [240.0, 240.0, 238.0],
    [228.0, 150.0, 120.0],
    [165.0, 30.0, 40.0],
];

fn mixed(stops: &[[f64; 3]], share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let k = (at.floor() as usize).min(stops.len() - 2);
    let t = at - k as f64;
    let part = |i: usize| (stops[k][i] * (1.0 - t) + stops[k + 1][i] * t).round() as u8;
    format!("#{:02x}{:02x}{:02x}", part(0), part(1), part(2))
}

/// Draws the four classes, with that of the system marked.
pub fn hierarchy(standing: &HierarchyPlace) -> Picture {
    const WIDE: f64 = 150.0;
    const HIGH: f64 = 52.0;
    let cells = [
        (0, 0, HierarchyClass::IntegralAndMeasure, "integral and measure"),
        (1, 0, HierarchyClass::MeasureOnly, "measure only"),
        (0, 1, HierarchyClass::IntegralOnly, "integral only"),
        (1, 1, HierarchyClass::Neither, "neither"),
    ];
    let mut inner = String::new();
    for (column, row, class, words) in cells {
        let (x, y) = (92.0 + column as f64 * WIDE, 22.0 + row as f64 * HIGH);
        let here = class == standing.class;
        let (fill, ink) = if here { ("#1f6f8b", "#ffffff") } else { ("none", "currentColor") };
        let _ = write!(
            inner,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{WIDE}\" height=\"{HIGH}\" fill=\"{fill}\" stroke=\"currentColor\" stroke-opacity=\"0.5\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"{ink}\">{words}</text>",
            x + WIDE / 2.0,
            y + HIGH / 2.0 + 4.0
        );
    }
    let labels = [
        (92.0 + WIDE / 2.0, 15.0, "middle", "integral"),
        (92.0 + WIDE * 1.5, 15.0, "middle", "none known"),
        (84.0, 22.0 + HIGH / 2.0 + 4.0, "end", "measure"),
        (84.0, 22.0 + HIGH * 1.5 + 4.0, "end", "no measure"),
    ];
    for (x, y, anchor, words) in labels {
        let _ = write!(inner, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{words}</text>");
    }
    let caption = format!("The hierarchy; this system: {}", standing.class.words());
    Picture { svg: svg(394.0, 128.0, &caption, &inner), caption }
}
