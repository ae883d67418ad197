//! Plot of a branch: stable orbits as lines, unstable ones dashed, and signs at bifurcations.

use std::f64::consts::FRAC_PI_2;

use liouville::number::rational::Rational;
use liouville_draw::{
    Axis, CATEGORIES, Layer, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, math, plain,
};
use liouville_flow::{Bifurcation, Branch};

/// Draws a quantity over what varies; `has_angle` where the first one is an angle, taken modulo 2π.
pub fn plot(
    branch: &Branch,
    (name, range): (&str, &[Rational; 2]),
    (place, title): (usize, &str),
    has_angle: bool,
) -> Plot {
    let is_turn = has_angle && place == 0;
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
            let angle = |index: usize| branch.points[index].at.first().copied();
            let angles = (run.first..=run.last).map(|index| angle(index).filter(|_| has_angle));
            let line = broken(&values[run.first..=run.last], angles);
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

/// Breaks a line where an angle jumps, by a turn or by half of one: there the velocity vanishes, and
/// the branch goes on with the motion in the other direction.
fn broken(line: &[[f64; 2]], angles: impl Iterator<Item = Option<f64>>) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::new();
    let mut last = None;
    for (at, angle) in line.iter().zip(angles) {
        if let (Some(last), Some(angle)) = (last, angle)
            && f64::abs(angle - last) > FRAC_PI_2
        {
            out.push([f64::NAN; 2]);
        }
        out.push(*at);
        last = angle;
    }
    out
}
