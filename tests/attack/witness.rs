//! Witnesses of verdicts, as exact states of the oracle.
//!
//! A state on a level is printed with rounded digits. Newton's method takes it to the level, and the
//! claim is evaluated at the state that it finds.

use liouville::verdict::Witness;

use super::claim::{At, Claim, Values, gradients};
use super::jet::Place;
use super::real::{
    Found, LADDER, Lack, Real, difference, height, is_zero, modulus, nearest, number, quotient,
    whole, with_bits,
};
use super::scene::{Origin, Scene};
use super::told::read;

/// Largest relative distance of a printed state from the level.
const NEAR: f64 = 1e-6;
/// Number of steps of Newton's method.
const STEPS: usize = 24;
/// Number of bits that the error of a state on a level may exceed rounding.
const BLUR: isize = 60;
/// Smallest height of a slope by which a variable is moved.
const STEEP: isize = -30;

/// Result at a witness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown {
    /// Value of the claim there.
    At(At),
    /// The witness is not a state.
    NoState,
    /// Newton's method does not show whether it is one.
    Open,
}

/// Evaluates a claim at a witness, in the highest precision if it seems to hold there.
pub fn shown(scene: &Scene, claim: &Claim, witness: &Witness) -> Shown {
    let mut last = Shown::Open;
    for bits in LADDER {
        last = with_bits(bits, || match state(scene, witness) {
            Ok(Some(values)) => Shown::At(claim.at(scene, &values)),
            Ok(None) => Shown::NoState,
            Err(_) => Shown::Open,
        });
        if !matches!(last, Shown::At(At::Zero | At::Without(Lack::Digits))) {
            break;
        }
    }
    last
}

/// Reads a witness as values of the scene's symbols; `None` if it is not a state.
fn state(scene: &Scene, witness: &Witness) -> Found<Option<Values>> {
    let given = |name: &str| -> Option<&str> {
        let of_state = witness.state.split_whitespace().find_map(|part| {
            part.split_once('=').filter(|(own, _)| *own == name).map(|(_, value)| value)
        });
        of_state.or_else(|| witness.parameters.get(name).map(String::as_str))
    };
    let mut values: Values = Vec::new();
    for symbol in &scene.symbols {
        let value = match &symbol.origin {
            Origin::Fixed(n) => Ok(number(*n)),
            Origin::Formula(tree) => Place { values: &values, along: &[] }.value(tree),
            // No claim names the input of a chart, and the witness gives what depends on it.
            Origin::Input(..) => Ok(whole(0)),
            Origin::State(..) | Origin::Range(..) | Origin::List(_) => {
                match given(&symbol.name).and_then(read) {
                    Some(value) => Ok(value),
                    None => return Ok(None),
                }
            }
        };
        values.push(value);
    }
    let Some(moved) = onto_level(scene, &mut values)? else { return Ok(None) };
    let slack = if moved { 1e-12 } else { 0.0 };
    let is_out = |(place, value): (usize, &Found<Real>)| {
        value.as_ref().is_ok_and(|value| scene.is_out_of_range(place, value, slack))
    };
    Ok((!values.iter().enumerate().any(is_out)).then_some(values))
}

/// Moves a state to the level; returns whether it moved, `None` if it is far from the level.
fn onto_level(scene: &Scene, values: &mut Values) -> Found<Option<bool>> {
    if scene.level.is_none() {
        return Ok(Some(false));
    }
    let states = scene.states();
    let mut moved: Vec<usize> = Vec::new();
    for _ in 0..STEPS {
        let rows = gradients(scene, &Place { values, along: &states })?;
        if rows.iter().all(|row| is_zero(&row.value)) {
            for place in &moved {
                let x = values[*place].clone()?;
                values[*place] = Ok(x.blurred(rounding(&x) + 2 * BLUR));
            }
            return Ok(Some(!moved.is_empty()));
        }
        let rows = rows.into_iter().map(|row| (row.slopes, row.value)).collect();
        let mut moving = Vec::new();
        for (column, step) in step(rows)? {
            let place = states[column];
            let x = values[place].clone()?;
            let near = NEAR * (1.0 + nearest(&modulus(&x)));
            if moved.is_empty() && nearest(&modulus(&step)) > near {
                return Ok(None);
            }
            let x = (x - step).middle();
            values[place] = Ok(x.blurred(rounding(&x) + BLUR));
            moving.push(place);
        }
        moved = moving;
    }
    Err(Lack::Decision)
}

/// Exponent of the rounding of a number, or of 1 if that is larger.
fn rounding(x: &Real) -> isize {
    height(x).max(0) - super::real::bits() as isize
}

/// Solves linear equations for as many variables, by the largest coefficients.
fn step(mut rows: Vec<(Vec<Real>, Real)>) -> Found<Vec<(usize, Real)>> {
    let mut pivots: Vec<usize> = Vec::new();
    for k in 0..rows.len() {
        let columns = (0..rows[k].0.len()).filter(|c| !pivots.contains(c));
        let pivot = columns.max_by_key(|c| height(&rows[k].0[*c])).ok_or(Lack::Decision)?;
        if height(&rows[k].0[pivot]) < STEEP {
            return Err(Lack::Decision);
        }
        pivots.push(pivot);
        let own = rows[k].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(j, _)| *j != k) {
            let factor = quotient(&row.0[pivot], &own.0[pivot])?;
            for (entry, by) in row.0.iter_mut().zip(&own.0) {
                *entry = difference(entry, &(&factor * by))?;
            }
            row.0[pivot] = whole(0);
            row.1 = difference(&row.1, &(&factor * &own.1))?;
        }
    }
    let solved =
        |(k, pivot): (usize, &usize)| Ok((*pivot, quotient(&rows[k].1, &rows[k].0[*pivot])?));
    pivots.iter().enumerate().map(solved).collect()
}
