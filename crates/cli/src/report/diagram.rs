//! Work–precision diagram as SVG: error to the right, time upwards, both logarithmic; a shape for
//! each method, a colour for each domain.
//!
//! The layout depends on the rows alone. Up to six claims have a panel each, with a label at every
//! point that has room for one; more are drawn together.

mod axes;
mod labels;

pub(super) use super::typeset::mathml::escaped as escape;

use std::fmt::Write;

use self::axes::Axes;
use self::labels::Labels;
use liouville_lab::bench::{Measured, Method, Row};

/// Number of claims above which all share one panel.
const MOST_PANELS: usize = 6;
const WIDTH: f64 = 860.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 24.0;
const PANEL: f64 = 330.0;
/// Heights of the title above a panel and of the axis below.
const ABOVE: f64 = 34.0;
const BELOW: f64 = 46.0;
const LEGEND_LINE: f64 = 22.0;

/// Colours of the domains in the order of the rows, for a light and for a dark background.
const COLOURS: [(&str, &str); 8] = [
    ("#0067a5", "#5db8f5"),
    ("#c2500a", "#ff9a4d"),
    ("#00765a", "#3fcfa4"),
    ("#8a6d00", "#e3c13c"),
    ("#6b3fa0", "#b89af0"),
    ("#a8326e", "#f08abb"),
    ("#5a5a5a", "#b5b5b5"),
    ("#8c2f2f", "#f08a8a"),
];

/// Draws the diagram of some claims.
pub fn svg(measured: &[Measured]) -> String {
    let domains = domains(measured);
    // A residual that is nowhere defined has no error, and no place in the diagram.
    let shown = |m: &&Row| m.max_error.is_some();
    let panels: Vec<(String, Vec<&Row>)> = if measured.len() <= MOST_PANELS {
        let title = |m: &Measured| match m.item == m.claim {
            true => m.item.clone(),
            false => format!("{}: {}", m.item, m.claim),
        };
        measured.iter().map(|m| (title(m), m.rows.iter().filter(shown).collect())).collect()
    } else {
        let rows = measured.iter().flat_map(|m| &m.rows).filter(shown).collect();
        vec![(format!("{} claims", measured.len()), rows)]
    };
    let mut legend = String::new();
    let legend_height = legend_lines(&mut legend, &methods(measured), &domains);
    let height = legend_height + panels.len() as f64 * (ABOVE + PANEL + BELOW) + 6.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" \
         width=\"{WIDTH}\" height=\"{height}\" role=\"img\">\n\
         <title>Run time against error</title>\n<style>\n{}</style>\n\
         <rect class=\"paper\" width=\"{WIDTH}\" height=\"{height}\"/>\n",
        style(domains.len())
    );
    out.push_str(&legend);
    let axes = Axes::of(panels.iter().flat_map(|(_, rows)| rows.iter().copied()));
    for (index, (title, rows)) in panels.iter().enumerate() {
        let top = legend_height + index as f64 * (ABOVE + PANEL + BELOW) + ABOVE;
        panel(&mut out, title, rows, &axes, top, &domains, panels.len() == measured.len());
    }
    out.push_str("</svg>\n");
    out
}

fn domains(measured: &[Measured]) -> Vec<&'static str> {
    let mut domains = Vec::new();
    for row in measured.iter().flat_map(|m| &m.rows) {
        if !domains.contains(&row.domain) {
            domains.push(row.domain);
        }
    }
    domains
}

fn methods(measured: &[Measured]) -> Vec<Method> {
    let used =
        |method: &Method| measured.iter().any(|m| m.rows.iter().any(|r| r.method == *method));
    Method::ALL.into_iter().filter(|method| *method != Method::Floor && used(method)).collect()
}

fn style(domains: usize) -> String {
    let mut light = String::from(
        "text { font: 12px system-ui, sans-serif; fill: #222; }\n.paper { fill: #fff; }\n\
         .title { font-size: 14px; font-weight: 600; }\n.small { font-size: 11px; }\n\
         .grid { stroke: #e2e2e2; }\n.frame { stroke: #888; fill: none; }\n\
         .lead { stroke: #999; stroke-width: 0.7; }\n.plain { fill: #555; }\n",
    );
    let mut dark = String::from(
        "text { fill: #ddd; }\n.paper { fill: #14171c; }\n.grid { stroke: #2b3038; }\n\
         .plain { fill: #aaa; }\n",
    );
    for index in 0..domains {
        let (on_light, on_dark) = COLOURS[index % COLOURS.len()];
        let _ = writeln!(light, ".d{index} {{ fill: {on_light}; }}");
        let _ = writeln!(dark, ".d{index} {{ fill: {on_dark}; }}");
    }
    format!("{light}@media (prefers-color-scheme: dark) {{\n{dark}}}\n")
}

/// Draws shapes and colours with their names, in lines. Returns the height they take.
fn legend_lines(out: &mut String, methods: &[Method], domains: &[&'static str]) -> f64 {
    let mut y = 22.0;
    let mut x = LEFT;
    let mut entry = |mark: &dyn Fn(f64, f64) -> String, text: &str, x: &mut f64, y: &mut f64| {
        let width = 24.0 + labels::width(text) + 14.0;
        if *x + width > WIDTH - RIGHT {
            (*x, *y) = (LEFT, *y + LEGEND_LINE);
        }
        out.push_str(&mark(*x + 6.0, *y));
        let _ = writeln!(
            out,
            "<text x=\"{:.1}\" y=\"{:.1}\">{}</text>",
            *x + 18.0,
            *y + 4.0,
            escape(text)
        );
        *x += width;
    };
    for method in methods {
        entry(&|x, y| marker(*method, "plain", x, y), method.name(), &mut x, &mut y);
    }
    (x, y) = (LEFT, y + LEGEND_LINE);
    for (index, domain) in domains.iter().enumerate() {
        let class = format!("d{index}");
        let swatch = |x: f64, y: f64| {
            let (left, top) = (x - 6.0, y - 5.0);
            format!(
                "<rect class=\"{class}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"12\" height=\"10\"/>\n"
            )
        };
        entry(&swatch, domain, &mut x, &mut y);
    }
    y + 14.0
}

fn panel(
    out: &mut String,
    title: &str,
    rows: &[&Row],
    axes: &Axes,
    top: f64,
    domains: &[&'static str],
    labelled: bool,
) {
    let _ = writeln!(
        out,
        "<text class=\"title\" x=\"{LEFT}\" y=\"{:.1}\">{}</text>",
        top - 12.0,
        escape(&labels::shortened(title))
    );
    axes.draw(out, top);
    let points: Vec<(f64, f64)> =
        rows.iter().map(|row| axes.place(row.max_error, row.ns_per_state, top)).collect();
    if !labelled {
        out.push_str("<g fill-opacity=\"0.5\">\n");
    }
    for (row, (x, y)) in rows.iter().zip(&points) {
        let class = domains.iter().position(|domain| *domain == row.domain).unwrap_or(0);
        out.push_str(&marker(row.method, &format!("d{class}"), *x, *y));
    }
    if labelled {
        // From the right: points there have the fewest places for a label.
        let mut order: Vec<usize> = (0..rows.len()).collect();
        order.sort_by(|a, b| points[*b].0.total_cmp(&points[*a].0));
        let mut labels = Labels::new(axes.frame(top), &points);
        for index in order {
            let row = rows[index];
            let text = match row.method {
                Method::Tape | Method::MergedTape => {
                    format!("{}, {}", row.method.name(), row.domain)
                }
                // The others run in one domain each.
                method => method.name().to_string(),
            };
            labels.put(out, points[index], &text);
        }
    }
    if !labelled {
        out.push_str("</g>\n");
    }
}

/// Draws a marker with the shape of a method, about 10 pixels wide.
fn marker(method: Method, class: &str, x: f64, y: f64) -> String {
    let polygon = |corners: &[(f64, f64)]| {
        let corners: Vec<String> =
            corners.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + dx, y + dy)).collect();
        format!("<polygon class=\"{class}\" points=\"{}\"/>\n", corners.join(" "))
    };
    match method {
        Method::Tape | Method::Floor => {
            format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>\n")
        }
        Method::MergedTape => polygon(&[(-6.0, -2.0), (6.0, -2.0), (6.0, 2.0), (-6.0, 2.0)]),
        Method::NumDualByHand => polygon(&[(0.0, -6.0), (6.0, 0.0), (0.0, 6.0), (-6.0, 0.0)]),
        Method::NumDualClosedForm => polygon(&[(0.0, -6.0), (3.0, 0.0), (0.0, 6.0), (-3.0, 0.0)]),
        Method::ComplexStep => polygon(&[(0.0, -5.5), (5.5, 4.5), (-5.5, 4.5)]),
        Method::CentralDifference => polygon(&[(0.0, 5.5), (5.5, -4.5), (-5.5, -4.5)]),
    }
}
