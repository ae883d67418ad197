//! Axes of a plane of motions: quantities that vary, by their names in a case.

use crate::motion::conserved::Conserved;
use crate::section::andoyer::applies;
use crate::section::coordinate::{ChartAxis, Coordinate};
use liouville::case::{Case, number};
use liouville::formula::{Type, canonical_name};
use liouville::mechanics::{ParameterOrigin, StiffEntry};
use liouville::number::rational::Rational;

/// Correct form of an axis.
const FORM: &str = "write NAME=a..b, such as a_g=0..14 or l=0..2pi";

/// Mistake in an axis that a user has given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct AxisMistake {
    /// Description of the mistake.
    pub message: String,
    /// Correction.
    pub help: String,
}

impl AxisMistake {
    fn new(message: &str, help: &str) -> Self {
        Self { message: message.to_string(), help: help.to_string() }
    }
}

/// Reads `NAME=a..b`.
pub(crate) fn range(text: &str) -> Result<(&str, Rational, Rational), AxisMistake> {
    let wrong = |message: &str| AxisMistake::new(message, FORM);
    let (name, range) = text.split_once('=').ok_or_else(|| wrong("there is no `=`"))?;
    let (from, to) = range.split_once("..").ok_or_else(|| wrong("there is no `..`"))?;
    let read = |part: &str| number_with_pi(part).ok_or_else(|| wrong("is no range"));
    let (from, to) = (read(from)?, read(to)?);
    let ends = [&from, &to].map(|end| end.to_f64().0);
    if !ends.iter().all(|end| end.is_finite()) {
        return Err(wrong("an end of the range is too large for f64"));
    }
    if ends[0] == ends[1] {
        return Err(wrong(match from == to {
            true => "the range is empty",
            false => "the ends of the range are one number in f64",
        }));
    }
    Ok((name.trim(), from, to))
}

impl ChartAxis {
    /// Reads an axis `NAME=a..b` of `count` points; also returns its canonical name.
    pub fn read(case: &Case, text: &str, count: usize) -> Result<(String, Self), AxisMistake> {
        let (name, from, to) = range(text)?;
        let (name, coordinate) = Coordinate::varying(case, name, &known(case))?;
        Ok((name, Self { coordinate, from, to, count }))
    }
}

impl Coordinate {
    /// Coordinate of a name, if it may vary; also returns the canonical name. `known` is the help
    /// where there is none.
    pub(crate) fn varying(
        case: &Case,
        name: &str,
        known: &str,
    ) -> Result<(String, Self), AxisMistake> {
        let name = canonical_name(name).unwrap_or_else(|| name.to_string());
        let is_of_state =
            (0..case.model.dimension()).any(|place| case.model.component_name(place) == name);
        let none = || match is_of_state {
            true => format!("`{name}` is a state variable, and changes along the motion"),
            false => format!("there is no `{name}` to vary"),
        };
        let coordinate =
            Coordinate::of(case, &name).ok_or_else(|| AxisMistake::new(&none(), known))?;
        let Some((index, component)) = coordinate.parameter() else {
            return Ok((name, coordinate));
        };
        if matches!(case.model.parameters[index].origin, ParameterOrigin::Formula(_)) {
            let message = format!("`{name}` is computed from other parameters");
            return Err(AxisMistake::new(&message, "vary those that it is computed from"));
        }
        if case.model.is_rigid(index, &[]) {
            let message = format!("`{name}` is a size, or stands in an index");
            return Err(AxisMistake::new(&message, "vary another parameter"));
        }
        let own = &case.model.parameters[index].name;
        let tied = case.model.tied(index, component).map_err(|stiff| match stiff {
            StiffEntry::Zero => AxisMistake::new(
                &format!("`{name}` is 0 in all values of `{own}`"),
                "vary another entry, or declare the matrix by its entries",
            ),
            StiffEntry::Rotation => AxisMistake::new(
                &format!("`{name}` is an entry of a rotation, and cannot vary alone"),
                "write the rotation with an angle, a parameter, and vary that",
            ),
        })?;
        // The first of equal entries stands for them, so that two axes of one quantity are seen.
        let equal = tied.iter().filter(|one| !one.is_negative).map(|one| one.component);
        let component = equal.min().map_or(component, |other| other.min(component));
        Ok((name, Coordinate::Parameter { index, component }))
    }

    /// Coordinate of a name that varies along a branch of closed orbits: a parameter, a component of
    /// one, the energy, or a proved integral; also returns the canonical name.
    pub fn of_branch(case: &Case, name: &str) -> Result<(String, Self), AxisMistake> {
        let names = parameters(case);
        let energy = case.model.system.has_energy().then(|| "energy".to_string());
        let integrals = Conserved::claimed(case).map(|(_, own)| own.name().to_string());
        let kept: Vec<String> = energy.into_iter().chain(integrals).collect();
        let help = match (names.as_slice(), kept.split_last()) {
            ([], None) => "declare what varies in [parameters], as a = \"0.5..2\"".to_string(),
            ([], Some((only, []))) => format!("vary {only}: the case has no parameters"),
            (names, None) => format!("vary {}", names.join(", ")),
            (names, Some((last, others))) => {
                format!("vary {}, or {last}", [names, others].concat().join(", "))
            }
        };
        let found = match Self::varying(case, name, &help) {
            Err(mistake) => match Conserved::named(case, name) {
                Ok(Some(index)) => return Ok((name.to_string(), Coordinate::Integral(index))),
                // Of a claimed integral the reason counts.
                Err(reason) if Conserved::claimed(case).any(|(_, own)| own.name() == name) => {
                    return Err(reason);
                }
                _ => return Err(mistake),
            },
            Ok(found) => found,
        };
        match found {
            (name, Coordinate::L | Coordinate::Z) => {
                let message = format!("`{name}` is a coordinate of the section");
                Err(AxisMistake::new(&message, &help))
            }
            found => Ok(found),
        }
    }

    /// Coordinate of a name: a parameter, a component of one, or a coordinate of the start.
    pub fn of(case: &Case, name: &str) -> Option<Self> {
        let find = |name: &str| case.model.parameters.iter().position(|known| known.name == name);
        if let Some(index) = find(name)
            && case.model.parameters[index].kind == Type::Scalar
        {
            return Some(Coordinate::Parameter { index, component: 0 });
        }
        match name {
            "l" => return Some(Coordinate::L),
            "L/G" => return Some(Coordinate::Z),
            "energy" => return Some(Coordinate::Energy),
            _ => {}
        }
        let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
        let index = find(name.strip_suffix(digits)?)?;
        let places: Vec<usize> = digits
            .bytes()
            .map(|digit| usize::from(digit).wrapping_sub(usize::from(b'1')))
            .collect();
        let component = match (case.model.parameters[index].kind, &places[..]) {
            (Type::Vector(length), _) => {
                digits.parse::<usize>().ok()?.checked_sub(1).filter(|k| *k < length)?
            }
            (Type::Matrix(rows, columns), [k]) if *k < rows.min(columns) => (columns + 1) * k,
            (Type::Matrix(rows, columns), [i, j]) if *i < rows && *j < columns => columns * i + j,
            _ => return None,
        };
        Some(Coordinate::Parameter { index, component })
    }
}

/// Help that lists the possible axes of a case.
fn known(case: &Case) -> String {
    let own = match () {
        () if applies(&case.model) => &["l", "L/G", "energy"][..],
        () if case.model.system.has_energy() => &["energy"],
        () => &[],
    };
    let names = parameters(case).into_iter().chain(own.iter().map(ToString::to_string));
    match names.collect::<Vec<_>>().as_slice() {
        [] => "declare what varies in [parameters], as a = \"0.5..2\"".to_string(),
        [only] => format!("vary {only}"),
        names => format!("vary one of {}", names.join(", ")),
    }
}

/// Names of the parameters of a case, and of components of them.
fn parameters(case: &Case) -> Vec<String> {
    let names = case.model.parameters.iter().map(|parameter| match parameter.kind {
        Type::Scalar => parameter.name.clone(),
        _ => format!("{0}1, {0}2, {0}3", parameter.name),
    });
    names.collect()
}

/// Reads a number, which may be a multiple of π or another formula of numbers: `3/2`, `2pi`, `√2/2`.
pub fn number_with_pi(text: &str) -> Option<Rational> {
    multiple_of_pi(text).or_else(|| number(text))
}

fn multiple_of_pi(text: &str) -> Option<Rational> {
    let plain: String = text.split_whitespace().collect();
    let plain = plain.replace("pi", "π").replace('*', "");
    let (before, behind) = plain.split_once('π')?;
    let factor: Rational = match before {
        "" => Rational::from(1),
        "-" | "−" => Rational::from(-1),
        number => number.parse().ok()?,
    };
    let divisor: Rational = match behind.strip_prefix('/') {
        Some(number) => number.parse().ok()?,
        None if behind.is_empty() => Rational::from(1),
        None => return None,
    };
    let pi = Rational::from_f64(std::f64::consts::PI)?;
    Some(&(&pi * &factor) * &divisor.recip()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_entries_of_a_matrix_are_one_axis() {
        let case = Case::parse(
            "title = 'a'\n[parameters]\nJ = [[2, 1, 0], [1, 3, 0], [0, 0, 4]]\nQ = 'rotation'\n\
             K = 'skew(3, 1..2)'\n[state]\nx = 'vector(-1..1)'\n[field]\n\"x'\" = 'J*Q*K*x'\n",
            &[],
        );
        let case = case.expect("a case");
        let [one, other] = ["J12=0..1", "J21=0..1"]
            .map(|text| ChartAxis::read(&case, text, 4).expect("an axis").1.coordinate);
        assert_eq!(one, other, "one quantity");
        for (text, wrong) in [
            ("Q12=0..1", "`Q12` is an entry of a rotation, and cannot vary alone"),
            ("K2=0..1", "`K2` is 0 in all values of `K`"),
        ] {
            let mistake = ChartAxis::read(&case, text, 4).expect_err(text);
            assert_eq!(mistake.message, wrong, "{text}");
        }
    }

    #[test]
    fn axes_are_read_by_name() {
        let case = Case::parse(
            "title = 'a'\n[parameters]\nn = 2\na = 1\nc = '[0, 0, 1]'\nb = '2*a'\n\
             [state]\nx = 'vector(n, -1..1)'\n[field]\n\"x'\" = 'a*b*c[1]*x'\n",
            &[],
        );
        let case = case.expect("a case");
        let (name, axis) = ChartAxis::read(&case, "c3 = -1/2 .. 2pi", 4).expect("an axis");
        let component = Coordinate::Parameter { index: 2, component: 2 };
        assert_eq!((name.as_str(), axis.coordinate, axis.count), ("c3", component, 4));
        assert_eq!(axis.from, Rational::new(-1, 2));
        for (text, wrong) in [
            ("a", "there is no `=`"),
            ("a=1", "there is no `..`"),
            ("a=1..x", "is no range"),
            ("a=1..1", "the range is empty"),
            ("a=1..1.00000000000000000001", "the ends of the range are one number in f64"),
            ("a=0..1e-400", "the ends of the range are one number in f64"),
            ("a=0..1e400", "an end of the range is too large for f64"),
            ("d=0..1", "there is no `d` to vary"),
            ("c4=0..1", "there is no `c4` to vary"),
            ("b=0..1", "`b` is computed from other parameters"),
            ("n=0..1", "`n` is a size, or stands in an index"),
        ] {
            let mistake = ChartAxis::read(&case, text, 4).expect_err(text);
            assert_eq!(mistake.message, wrong, "{text}");
        }
    }
}
