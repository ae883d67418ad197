//! Sums of squares that rates of Lyapunov functions may be, found in numbers.

use std::collections::BTreeSet;

use super::dissipation::MOST_RATES;
use crate::case::Case;
use crate::formula::{Formula, Type};
use crate::number::rational::Rational;

/// Largest number of squares that are tried.
const MOST_SQUARES: usize = 32;

/// Source of a square.
#[derive(Clone, Copy, PartialEq, Eq)]
enum SquareKind {
    /// Rate of a variable.
    Rate,
    /// Slope of F along a variable.
    Slope,
    /// Part of a formula of the file.
    Part,
    /// Rate of a variable, over the variable.
    Relative,
}

/// The square of a vector or scalar, of which the rate may consist.
pub(super) struct Square {
    pub(super) formula: Formula,
    kind: SquareKind,
}

/// Lists squares of vectors and scalars.
pub(super) fn squares(case: &Case, function: &Formula) -> Vec<Square> {
    let model = &case.model;
    let mut texts: Vec<(String, SquareKind)> = Vec::new();
    for variable in &model.state {
        let name = &variable.name;
        texts.push((format!("{name}'"), SquareKind::Rate));
        texts.push((format!("∂({})/∂{name}", function.text()), SquareKind::Slope));
    }
    let formulas = model.dynamics().into_iter().chain(&model.abbreviations).chain([function]);
    let parts = formulas.flat_map(Formula::parts);
    texts.extend(parts.map(|text| (text.trim().to_string(), SquareKind::Part)));
    let mut seen = BTreeSet::new();
    texts.retain(|(text, _)| seen.insert(text.clone()));
    let square = |(text, kind): (String, SquareKind)| {
        let square = square_of(&case.formula(&text).ok()?);
        Some(Square { formula: case.formula(&square).ok()?, kind })
    };
    let relative = model.state.iter().filter_map(|variable| {
        let text = relative_square(&variable.name, variable.kind)?;
        Some(Square { formula: case.formula(&text).ok()?, kind: SquareKind::Relative })
    });
    relative.chain(texts.into_iter().filter_map(square)).take(MOST_SQUARES).collect()
}

/// Writes the sum of the squares of the components.
fn square_of(vector: &Formula) -> String {
    let text = vector.text();
    match vector.value_type() {
        Type::Matrix(..) => format!("tr(({text})ᵀ*({text}))"),
        _ => format!("({text})^2"),
    }
}

/// Writes Σ xᵢ'²/xᵢ.
fn relative_square(name: &str, kind: Type) -> Option<String> {
    match kind {
        Type::Scalar => Some(format!("{name}'^2/{name}")),
        Type::Vector(size) => {
            let terms = (1..=size).map(|k| format!("({name}')[{k}]^2/{name}[{k}]"));
            Some(terms.collect::<Vec<String>>().join(" + ")).map(|sum| format!("({sum})"))
        }
        Type::Matrix(..) => None,
    }
}

/// Lists the scalars among the free parameters, as formulas.
pub(super) fn numbers(case: &Case) -> Vec<Formula> {
    let scalars = case.model.free_parameters().filter(|own| own.kind == Type::Scalar);
    scalars.filter_map(|own| case.formula(&own.name).ok()).collect()
}

/// Lists sums of squares, with numbers as negative factors, that the rate is equal to, up to a
/// parameter as a further factor: of one square or two, of all rates, and of all slopes.
pub(super) fn sums(
    table: &[Vec<f64>],
    squares: &[Square],
    numbers: &[Formula],
    may_divide: bool,
) -> Vec<String> {
    let of_kind =
        |kind: SquareKind| (0..squares.len()).filter(|k| squares[*k].kind == kind).collect();
    let single = (0..squares.len()).map(|k| vec![k]);
    let pairs = (0..squares.len()).flat_map(|i| (0..i).map(move |j| vec![j, i]));
    let whole = [SquareKind::Rate, SquareKind::Slope, SquareKind::Relative].map(of_kind);
    let choices: Vec<Vec<usize>> = single.chain(whole).chain(pairs).collect();
    let mut factors: Vec<(String, Vec<f64>)> = vec![(String::new(), vec![1.0; table.len()])];
    for (p, number) in numbers.iter().enumerate() {
        let column = squares.len() + 1 + p;
        let name = number.text();
        factors.push((format!("{name}*"), table.iter().map(|row| row[column]).collect()));
        if may_divide {
            let inverses = table.iter().map(|row| 1.0 / row[column]).collect();
            factors.push((format!("1/{name}*"), inverses));
        }
    }
    let mut all = Vec::new();
    for (factor, values) in &factors {
        let target: Vec<f64> =
            table.iter().zip(values).map(|(row, value)| row[0] / value).collect();
        let written = |chosen: &Vec<usize>| {
            let multiples = fitted(table, &target, chosen)?;
            let term = |(k, multiple): (&usize, &f64)| match multiple.abs() < 1e-9 {
                true => Some(String::new()),
                false => {
                    let multiple = near(*multiple).filter(|multiple| multiple.is_negative())?;
                    Some(format!("({multiple})*{factor}{}", squares[*k].formula.text()))
                }
            };
            let terms: Vec<String> =
                chosen.iter().zip(&multiples).map(term).collect::<Option<_>>()?;
            let terms: Vec<String> = terms.into_iter().filter(|term| !term.is_empty()).collect();
            (terms.len() == chosen.len()).then(|| terms.join(" + "))
        };
        all.extend(choices.iter().filter_map(written).take(MOST_RATES));
    }
    all
}

/// Finds a fraction with a small denominator next to a number.
fn near(number: f64) -> Option<Rational> {
    const LARGEST: i64 = 120;
    (1..=LARGEST).find_map(|below| {
        let above = (number * below as f64).round();
        let is_near = (above / below as f64 - number).abs() < 1e-9 * number.abs().max(1.0);
        (is_near && above.abs() < 1e9).then(|| Rational::new(above as i64, below))
    })
}

/// Finds factors with which a column of values is a sum of some columns of squares, at all rows.
fn fitted(table: &[Vec<f64>], target: &[f64], chosen: &[usize]) -> Option<Vec<f64>> {
    let count = chosen.len();
    if count == 0 || table.len() < 2 * count {
        return None;
    }
    let equation = |(row, value): (&Vec<f64>, &f64)| -> Vec<f64> {
        chosen.iter().map(|k| row[k + 1]).chain([*value]).collect()
    };
    let mut rows: Vec<Vec<f64>> = table.iter().zip(target).take(count).map(equation).collect();
    for column in 0..count {
        let largest =
            |a: &usize, b: &usize| rows[*a][column].abs().total_cmp(&rows[*b][column].abs());
        let best = (column..count).max_by(largest)?;
        rows.swap(column, best);
        let pivot = rows[column].clone();
        if pivot[column].abs() < 1e-12 {
            return None;
        }
        for row in rows.iter_mut().enumerate().filter(|(at, _)| *at != column).map(|(_, row)| row) {
            let factor = row[column] / pivot[column];
            row.iter_mut().zip(&pivot).for_each(|(x, y)| *x -= factor * y);
        }
    }
    let factors: Vec<f64> = (0..count).map(|k| rows[k][count] / rows[k][k]).collect();
    let fits = |(row, value): (&Vec<f64>, &f64)| {
        let terms = chosen.iter().zip(&factors).map(|(k, factor)| factor * row[k + 1]);
        let size: f64 = terms.clone().map(f64::abs).sum::<f64>() + value.abs();
        (terms.sum::<f64>() - value).abs() <= 1e-9 * size
    };
    table.iter().zip(target).all(fits).then_some(factors)
}
