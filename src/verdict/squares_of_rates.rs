//! Sums of squares that rates of Lyapunov functions may be, found in numbers.

use std::collections::BTreeSet;

use super::dissipation::MOST_RATES;
use crate::case::Case;
use crate::formula::{Formula, Type};
use crate::number::rational::Rational;

/// Largest number of squares that are tried.
const MOST_SQUARES: usize = 32;

/// Largest number of products of a square and a factor of which pairs are tried.
const MOST_PRODUCTS: usize = 400;

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

/// A factor of squares: 1, a parameter or its inverse.
struct Factor {
    text: String,
    values: Vec<f64>,
}

/// Lists the factors of squares, with their values by row.
fn factors(table: &[Vec<f64>], squares: usize, numbers: &[Formula]) -> Vec<Factor> {
    let mut factors = vec![Factor { text: String::new(), values: vec![1.0; table.len()] }];
    for (p, number) in numbers.iter().enumerate() {
        let values: Vec<f64> = table.iter().map(|row| row[squares + 1 + p]).collect();
        let inverses = values.iter().map(|value| 1.0 / value).collect();
        factors.push(Factor { text: format!("{}*", number.text()), values });
        factors.push(Factor { text: format!("1/{}*", number.text()), values: inverses });
    }
    factors
}

/// Lists sums of squares that the rate is equal to, each with a negative number, and a parameter or its inverse, as
/// factors: of one square or two, and with one parameter of all rates, and of all slopes.
pub(super) fn sums(table: &[Vec<f64>], squares: &[Square], numbers: &[Formula]) -> Vec<String> {
    let of_kind =
        |kind: SquareKind| (0..squares.len()).filter(|k| squares[*k].kind == kind).collect();
    let whole: Vec<Vec<usize>> =
        [SquareKind::Rate, SquareKind::Slope, SquareKind::Relative].map(of_kind).to_vec();
    let factors = factors(table, squares.len(), numbers);
    let target: Vec<f64> = table.iter().map(|row| row[0]).collect();
    let column = |factor: usize, square: usize| -> Vec<f64> {
        let rows = table.iter().zip(&factors[factor].values);
        rows.map(|(row, value)| row[square + 1] * value).collect()
    };
    let products: Vec<(usize, usize)> = (0..factors.len())
        .flat_map(|factor| (0..squares.len()).map(move |square| (factor, square)))
        .take(MOST_PRODUCTS)
        .collect();
    let columns: Vec<Vec<f64>> =
        products.iter().map(|(factor, square)| column(*factor, *square)).collect();
    let written = |chosen: &[(usize, usize)], columns: &[&Vec<f64>]| {
        let multiples = fitted(columns, &target)?;
        let term = |((factor, square), multiple): (&(usize, usize), &f64)| {
            let multiple = near(*multiple).filter(|multiple| multiple.is_negative())?;
            let (factor, square) = (&factors[*factor].text, squares[*square].formula.text());
            Some(format!("({multiple})*{factor}{square}"))
        };
        let terms: Option<Vec<String>> = chosen.iter().zip(&multiples).map(term).collect();
        terms.map(|terms| terms.join(" + "))
    };
    let single = (0..products.len()).filter_map(|k| written(&[products[k]], &[&columns[k]]));
    let all_of_a_kind = (0..factors.len()).flat_map(|factor| {
        let with_factor = move |of: &Vec<usize>| of.iter().map(|own| (factor, *own)).collect();
        whole.iter().map(with_factor).collect::<Vec<Vec<(usize, usize)>>>()
    });
    let all_of_a_kind = all_of_a_kind.filter_map(|chosen| {
        let columns: Vec<Vec<f64>> =
            chosen.iter().map(|(factor, square)| column(*factor, *square)).collect();
        written(&chosen, &columns.iter().collect::<Vec<_>>())
    });
    let pairs = (0..products.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let pairs = pairs.filter(|(j, i)| products[*j].1 != products[*i].1);
    let pairs = pairs
        .filter_map(|(j, i)| written(&[products[j], products[i]], &[&columns[j], &columns[i]]));
    single
        .take(MOST_RATES)
        .chain(all_of_a_kind.take(MOST_RATES))
        .chain(pairs.take(MOST_RATES))
        .collect()
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

/// Finds factors with which a column of values is a sum of some others, at all rows.
fn fitted(columns: &[&Vec<f64>], target: &[f64]) -> Option<Vec<f64>> {
    let count = columns.len();
    if count == 0 || target.len() < 2 * count {
        return None;
    }
    let equation = |row: usize| -> Vec<f64> {
        columns.iter().map(|column| column[row]).chain([target[row]]).collect()
    };
    let mut rows: Vec<Vec<f64>> = (0..count).map(equation).collect();
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
    let fits = |(row, value): (usize, &f64)| {
        let terms = columns.iter().zip(&factors).map(|(column, factor)| factor * column[row]);
        let size: f64 = terms.clone().map(f64::abs).sum::<f64>() + value.abs();
        (terms.sum::<f64>() - value).abs() <= 1e-9 * size
    };
    // The last rows are no part of the equations, so that most choices end at once.
    target.iter().enumerate().rev().all(fits).then_some(factors)
}
