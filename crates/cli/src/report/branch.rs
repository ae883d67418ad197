//! Report of `continue`: a branch of closed orbits as text, JSON, CSV and plots.

mod drawing;

use serde_json::{Value, json};

use super::cycle::{kind, multiplier, shown};
use super::data::quoted;
use super::facts;
use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville_draw::{Plot, Text, plain};
use liouville_flow::{Branch, BranchEnd, BranchPoint, MeasuredNumber, Multiplier};

/// Number of multipliers printed of a point.
const MOST_SHOWN: usize = 4;
/// Largest number of digits printed.
const DIGITS: f64 = 10.0;

/// A branch with what it was asked for.
pub struct BranchReport<'r> {
    /// Case of the orbits.
    pub case: &'r Case,
    /// Name of what varies.
    pub name: &'r str,
    /// Its range.
    pub range: &'r [Rational; 2],
    /// Names of the reported quantities.
    pub titles: &'r [String],
    /// Surface that the orbits cross; `None` for g = g₀ of a rolling body.
    pub surface: Option<&'r str>,
    /// Number of crossings after which the first orbit closed.
    pub period: u32,
    /// Number of times that the orbit at the start is run through until then.
    pub turns: u32,
    /// Theorem that this orbit closes, or the reason why there is none.
    pub proof: Result<String, String>,
    /// Branch.
    pub branch: &'r Branch,
}

/// Words for the end of a branch.
fn words(end: &BranchEnd) -> String {
    match end {
        BranchEnd::Range => "the end of the range".to_string(),
        BranchEnd::Count => "as many points as asked for; --count N allows more".to_string(),
        BranchEnd::Closed => "back at its start: the branch is closed".to_string(),
        BranchEnd::Lost(None) => {
            "the next point is not found, with steps at their limit; --step S takes shorter ones"
                .to_string()
        }
        BranchEnd::Lost(Some(problem)) => {
            format!("the next point is not found, with steps at their limit: {problem}")
        }
        BranchEnd::Touch => {
            "the orbit touches the section; another --section or --g0 goes on".to_string()
        }
        BranchEnd::Rest => "the orbit shrinks to a rest".to_string(),
        BranchEnd::Stopped => "stopped before its end".to_string(),
    }
}

/// Key of the end of a branch in JSON.
fn key(end: &BranchEnd) -> &'static str {
    match end {
        BranchEnd::Range => "range",
        BranchEnd::Count => "count",
        BranchEnd::Closed => "closed",
        BranchEnd::Lost(_) => "lost",
        BranchEnd::Touch => "touch",
        BranchEnd::Rest => "rest",
        BranchEnd::Stopped => "stopped",
    }
}

/// A multiplier in those of a few digits that its error leaves.
fn brief(one: &Multiplier) -> String {
    if one.im == 0.0 {
        return known(one.re, one.error);
    }
    let modulus = one.modulus();
    let angle = known(libm::atan2(one.im, one.re), one.error / modulus);
    format!("{} e^±{angle}i", known(modulus, one.modulus_error))
}

/// A number in those of ten digits that its error leaves; of none that it leaves, the error.
fn known(x: f64, error: f64) -> String {
    match x.abs() > error {
        true => in_digits(x, libm::log10(x.abs() / error)),
        false if error == 0.0 => "0".to_string(),
        false => format!("0 ± {error:.0e}"),
    }
}

/// A number in ten digits.
fn figures(x: f64) -> String {
    in_digits(x, DIGITS)
}

fn in_digits(x: f64, digits: f64) -> String {
    let digits = libm::ceil(digits).clamp(1.0, DIGITS);
    match x.abs() {
        0.0 => "0".to_string(),
        size if (1e-3..1e6).contains(&size) => {
            let whole = libm::floor(libm::log10(size));
            // Zeros behind the point of a number below 1 are no digits, and ten places are enough.
            let places = (digits - 1.0 - whole).clamp(0.0, DIGITS - 1.0 - whole.max(0.0));
            format!("{x:.*}", places as usize)
        }
        _ => format!("{x:.*e}", (digits - 1.0).min(6.0) as usize),
    }
}

impl BranchReport<'_> {
    /// Whether the branch was stopped before its end.
    pub fn is_stopped(&self) -> bool {
        self.branch.ends.contains(&BranchEnd::Stopped)
    }

    fn ends(&self) -> [String; 2] {
        self.range.each_ref().map(|x| x.to_f64().0.to_string())
    }

    /// Renders a line for each point.
    pub fn text(&self) -> String {
        let [from, to] = self.ends();
        let points = &self.branch.points;
        let marked = points.iter().filter(|point| point.bifurcation.is_some()).count();
        let mut out = format!(
            "{}\nclosed orbits of {} crossing{} along {} from {from} to {to}: {} points, {marked} bifurcation{}\n",
            self.case.title,
            self.period,
            if self.period == 1 { "" } else { "s" },
            self.name,
            points.len() - marked,
            if marked == 1 { "" } else { "s" },
        );
        if self.turns > 1 {
            out.push_str(&format!(
                "the orbit at the start is run through {} times in its period\n",
                self.turns
            ));
        }
        let titles = self.titles.iter().map(|title| format!(" {title:>15}"));
        out.push_str(&format!(
            "{:>17}{} {:>15}  multipliers\n",
            self.name,
            titles.collect::<String>(),
            "period"
        ));
        for (index, point) in points.iter().enumerate() {
            let at: String = point.at.iter().map(|x| format!(" {:>15}", figures(*x))).collect();
            let shown: Vec<String> = point
                .multipliers
                .iter()
                .filter(|one| one.im >= 0.0)
                .take(MOST_SHOWN)
                .map(brief)
                .collect();
            let mut notes = vec![kind(point.kind).to_string()];
            if index == self.branch.start {
                notes.push("start".to_string());
            }
            if let Some(name) = point.bifurcation {
                notes = vec![name.name().to_uppercase()];
            }
            out.push_str(&format!(
                "{:>17}{at} {:>15}  {:<32} {}\n",
                figures(point.value),
                figures(point.period.value),
                shown.join(", "),
                notes.join(", ")
            ));
        }
        for point in points {
            let (Some(kind), Some(error)) = (point.bifurcation, point.value_error) else {
                continue;
            };
            let value = shown(MeasuredNumber { value: point.value, error });
            let period = shown(point.period);
            out.push_str(&format!("{}: {} = {value}, period {period}\n", kind.name(), self.name));
        }
        if self.branch.keeps_area {
            out.push_str("the product of the multipliers is 1 at all points, within its error\n");
        }
        out.push_str(&match &self.proof {
            Ok(theorem) => format!("proved at the start: {theorem}\nnumerical: all other points\n"),
            Err(reason) => {
                format!("numerical: all points, the one at the start not proved: {reason}\n")
            }
        });
        let [first, last] = self.branch.ends.each_ref().map(words);
        out.push_str(&format!("begins: {first}\nends: {last}\n"));
        out
    }

    /// Renders the branch as JSON.
    pub fn json(&self) -> Result<String, String> {
        let point = |point: &BranchPoint| -> Value {
            json!({
                "value": point.value,
                "value_error": point.value_error,
                "at": point.at,
                "state": point.state,
                "time": point.period.value,
                "time_error": point.period.error,
                "residual": point.residual,
                "trace": point.trace.value,
                "trace_error": point.trace.error,
                "product": point.product.value,
                "product_error": point.product.error,
                "multipliers": point.multipliers.iter().map(multiplier).collect::<Vec<_>>(),
                "kind": kind(point.kind),
                "bifurcation": point.bifurcation.map(|kind| kind.name()),
            })
        };
        let root = json!({
            "title": self.case.title,
            "parameter": self.name,
            "from": self.range[0].to_f64().0,
            "to": self.range[1].to_f64().0,
            "section": self.surface,
            "period": self.period,
            "turns": self.turns,
            "axes": self.titles,
            "points": self.branch.points.iter().map(point).collect::<Vec<_>>(),
            "start": self.branch.start,
            "ends": self.branch.ends.each_ref().map(key),
            "reasons": self.branch.ends.each_ref().map(words),
            "keeps_area": self.branch.keeps_area,
            "theorem": self.proof.as_ref().ok(),
            "unproved": self.proof.as_ref().err(),
        });
        let text = serde_json::to_string_pretty(&root);
        Ok(text.map_err(|error| format!("error: {error}"))? + "\n")
    }

    /// Renders a line for each point with commas, below a line of titles.
    pub fn csv(&self) -> String {
        let mut titles = vec![quoted(self.name)];
        titles.extend(self.titles.iter().map(|title| quoted(title)));
        let others =
            ["period", "trace", "product", "largest_modulus", "kind", "bifurcation", "error"];
        titles.extend(others.map(str::to_string));
        let mut out = titles.join(",") + "\n";
        for point in &self.branch.points {
            let mut cells = vec![format!("{:?}", point.value)];
            cells.extend(point.at.iter().map(|x| format!("{x:?}")));
            cells.extend(
                [&point.period, &point.trace, &point.product].map(|x| format!("{:?}", x.value)),
            );
            let largest = point.multipliers.iter().map(Multiplier::modulus).reduce(f64::max);
            cells.push(largest.map_or(String::new(), |x| format!("{x:?}")));
            cells.push(kind(point.kind).to_string());
            cells.push(point.bifurcation.map_or(String::new(), |kind| kind.name().to_string()));
            cells.push(point.value_error.map_or(String::new(), |x| format!("{x:?}")));
            out.push_str(&cells.join(","));
            out.push('\n');
        }
        out
    }

    /// Plots of the quantities over what varies.
    pub fn plots(&self) -> Vec<Plot> {
        let has_angle =
            self.surface.is_none() && self.titles.first().is_some_and(|first| first == "l");
        let titles = self.titles.iter().enumerate();
        titles
            .map(|(place, title)| {
                drawing::plot(self.branch, (self.name, self.range), (place, title), has_angle)
            })
            .collect()
    }

    /// Words below the picture.
    pub fn caption(&self) -> Text {
        let crossings =
            format!("{} crossing{}", self.period, if self.period == 1 { "" } else { "s" });
        let mut found = vec![facts::section(self.surface), plain(&facts::unbroken(&crossings))];
        found.extend(facts::parameters(self.case, &[self.name]));
        facts::listed(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_ten_digits() {
        assert_eq!(
            [0.0, 0.25, -123.456, 1e-5, 2.5e7].map(figures),
            ["0", "0.250000000", "-123.4560000", "1.000000e-5", "2.500000e7"]
        );
    }
}
