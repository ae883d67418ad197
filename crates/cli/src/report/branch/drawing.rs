//! Plot of a branch: stable orbits as lines, unstable ones dashed, and signs at bifurcations.

use std::f64::consts::PI;

use liouville::number::rational::Rational;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, math, plain,
};
use liouville_flow::{Bifurcation, Branch};

/// Draws a quantity over what varies; `is_turn` for an angle, which is taken modulo 2π.
pub fn plot(
    branch: &Branch,
    (name, range): (&str, &[Rational; 2]),
    (place, title): (usize, &str),
    is_turn: bool,
) -> Plot {
    let values: Vec<[f64; 2]> = branch
        .points
        .iter()
        .map(|point| [point.value, point.at.get(place).copied().unwrap_or(f64::NAN)])
        .collect();
    let [from, to] = range.each_ref().map(|x| x.to_f64().0);
    let across = match values.iter().any(|[x, _]| !(from..=to).contains(x)) {
        true => Axis::over(math(name), values.iter().map(|at| at[0])),
        false => Axis::new(math(name), from, to),
    };
    let up = match is_turn {
        true => Axis::turn(math(title)),
        false => Axis::over(math(title), values.iter().map(|at| at[1])),
    };
    let mut plot = Plot::new(across, up);
    let runs = runs(branch);
    let words = match branch.keeps_area {
        true => ["elliptic", "hyperbolic"],
        false => ["stable", "unstable"],
    };
    for (is_stable, word) in [true, false].into_iter().zip(words) {
        let paint = CATEGORIES[usize::from(!is_stable)];
        let own: Vec<&Run> = runs.iter().filter(|run| run.is_stable == is_stable).collect();
        for run in &own {
            let line = broken(&values[run.first..=run.last], is_turn);
            plot.layers.push(match is_stable {
                true => Layer::Line(line, paint),
                false => Layer::Dashes(line, paint),
            });
        }
        let mark = if is_stable { MarkShape::Line } else { MarkShape::Dashes };
        if !own.is_empty() {
            plot.legend.push(LegendEntry { mark, paint, text: plain(word) });
        }
    }
    for (point, at) in branch.points.iter().zip(&values) {
        let Some(kind) = point.bifurcation else { continue };
        let (mark, paint) = sign(kind);
        plot.marks.push(MarkedPoint { at: *at, mark, paint, label: None, has_rim: true });
        let entry = LegendEntry { mark, paint, text: plain(&kind.name().replace('-', "–")) };
        if !plot.legend.contains(&entry) {
            plot.legend.push(entry);
        }
    }
    plot
}

fn sign(kind: Bifurcation) -> (MarkShape, Paint) {
    match kind {
        Bifurcation::Fold => (MarkShape::Diamond, Paint::Ink),
        Bifurcation::BranchPoint => (MarkShape::Cross, Paint::Ink),
        Bifurcation::Flip => (MarkShape::Up, Paint::Ink),
        Bifurcation::NeimarkSacker => (MarkShape::Ring, Paint::Ink),
    }
}

/// Points of one stability.
struct Run {
    first: usize,
    last: usize,
    is_stable: bool,
}

/// Runs of pieces of one stability. A piece is stable if its ends are; at bifurcations the
/// other end decides.
fn runs(branch: &Branch) -> Vec<Run> {
    let points = &branch.points;
    let known = |index: usize| {
        let point = &points[index];
        point.bifurcation.is_none().then(|| point.is_stable())
    };
    let mut found: Vec<Run> = Vec::new();
    for index in 1..points.len() {
        let is_stable = match (known(index - 1), known(index)) {
            (Some(a), Some(b)) => a && b,
            (Some(a), None) | (None, Some(a)) => a,
            (None, None) => points[index].is_stable() && points[index - 1].is_stable(),
        };
        match found.last_mut() {
            Some(run) if run.is_stable == is_stable => run.last = index,
            _ => found.push(Run { first: index - 1, last: index, is_stable }),
        }
    }
    found
}

/// Breaks a line of angles where it jumps by a turn.
fn broken(line: &[[f64; 2]], is_turn: bool) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    for at in line {
        if let Some(last) = out.last()
            && is_turn
            && (at[1] - last[1]).abs() > PI
        {
            out.push([f64::NAN; 2]);
        }
        out.push(*at);
    }
    out
}
