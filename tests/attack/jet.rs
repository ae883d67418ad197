//! Values and derivatives of expressions, by the oracle's forward differentiation.

use super::expr::{Expr, Function, Tree};
use super::real::{
    Found, Lack, Real, atan, both, difference, exactly, exp, is_zero, log, modulus, nearest,
    number, quotient, root, sum, sure_sign, to_the, waves, whole,
};

/// A value with its partial derivatives.
#[derive(Clone, Debug)]
pub struct Jet {
    pub value: Real,
    pub slopes: Vec<Real>,
}

/// Values of the symbols, and the symbols of differentiation.
pub struct Place<'a> {
    pub values: &'a [Found<Real>],
    pub along: &'a [usize],
}

/// Number of points next to a state at which a function that vanishes there is tested.
const BESIDE: i64 = 3;

impl Place<'_> {
    /// Evaluates an expression.
    pub fn value(&self, tree: &Tree) -> Found<Real> {
        Place { values: self.values, along: &[] }.jet(tree).map(|jet| jet.value)
    }

    /// Evaluates an expression with its derivatives.
    pub fn jet(&self, tree: &Tree) -> Found<Jet> {
        match &**tree {
            Expr::Number(known) => Ok(self.constant(number(*known))),
            Expr::Symbol(place) => {
                let slope = |by: &usize| whole(i64::from(by == place));
                let value = self.values[*place].as_ref().map_err(|lack| *lack)?;
                let slopes = self.along.iter().map(slope).collect();
                Ok(Jet { value: value.clone(), slopes })
            }
            Expr::Neg(a) => self.jet(a).map(|a| scaled(&a, &whole(-1))),
            Expr::Add(a, b) => together(&self.jet(a), &self.jet(b), |a, b| combined(a, b, sum)),
            Expr::Sub(a, b) => {
                together(&self.jet(a), &self.jet(b), |a, b| combined(a, b, difference))
            }
            Expr::Mul(a, b) => together(&self.jet(a), &self.jet(b), product),
            Expr::Div(a, b) => together(&self.jet(a), &self.jet(b), |a, b| {
                let inverse = quotient(&whole(1), &b.value)?;
                let slope = |inverse: &Real| -(inverse * inverse);
                product(a, &chained(b, inverse, slope))
            }),
            Expr::Power(a, top, 1) => {
                let inner = self.jet(a)?;
                let value = to_the(&inner.value, *top)?;
                let below = match top {
                    0 => whole(0),
                    _ if self.along.is_empty() => whole(0),
                    n => to_the(&inner.value, n - 1)?,
                };
                Ok(chained(&inner, value, |_| whole(*top) * below))
            }
            Expr::Power(a, top, bottom) => {
                let inner = self.jet(a)?;
                self.fractional(a, &inner, *top, *bottom)
            }
            Expr::PowerTo(a, b) => {
                let (a, b) = both(self.jet(a), self.jet(b))?;
                match sure_sign(&a.value)? {
                    -1 => return Err(Lack::Value),
                    // 0^b is 0 for b > 0; whether it counts as defined is a convention.
                    0 => return Err(Lack::Decision),
                    _ => {}
                }
                let logarithm = chained(&a, log(&a.value)?, |_| whole(1) / &a.value);
                let exponent = product(&b, &logarithm)?;
                let value = exp(&exponent.value)?;
                Ok(chained(&exponent, value, Real::clone))
            }
            Expr::Of(function, a) => {
                let inner = self.jet(a)?;
                self.of(*function, a, &inner)
            }
            Expr::Norm(parts) => self.norm(tree, parts),
        }
    }

    fn constant(&self, value: Real) -> Jet {
        Jet { value, slopes: vec![whole(0); self.along.len()] }
    }

    /// Returns 0 with derivatives 0 where `of` vanishes around the place as well; no derivative
    /// otherwise.
    fn corner(&self, of: &Tree) -> Found<Jet> {
        if self.along.is_empty() {
            return Ok(self.constant(whole(0)));
        }
        for step in 1..=BESIDE {
            let mut values = self.values.to_vec();
            for (k, place) in self.along.iter().enumerate() {
                // Directions in general position, and steps that f64 would still see.
                let turn = (step * 7 + k as i64 * 5) % 11 - 5;
                let by = exactly((turn as f64 + 0.37) * 2f64.powi(-40));
                values[*place] = values[*place].clone().map(|x| x + by);
            }
            let beside = Place { values: &values, along: &[] }.value(of)?;
            if !is_zero(&beside) {
                return Err(Lack::Value);
            }
        }
        Ok(self.constant(whole(0)))
    }

    fn of(&self, function: Function, a: &Tree, inner: &Jet) -> Found<Jet> {
        let x = &inner.value;
        Ok(match function {
            Function::Root | Function::Modulus if is_zero(x) => return self.corner(a),
            Function::Root => rooted(inner)?,
            Function::Modulus => {
                let sign = whole(i64::from(sure_sign(x)?));
                chained(inner, modulus(x), |_| sign)
            }
            Function::Exp => chained(inner, exp(x)?, Real::clone),
            Function::Log => chained(inner, log(x)?, |_| whole(1) / x),
            Function::Sin | Function::Cos if nearest(x).abs() > 1e6 => return Err(Lack::Decision),
            Function::Sin | Function::Cos => match (function, waves(x)?) {
                (Function::Sin, (sin, cos)) => chained(inner, sin, |_| cos),
                (_, (sin, cos)) => chained(inner, cos, |_| -sin),
            },
            Function::Atan => chained(inner, atan(x), |_| whole(1) / (whole(1) + x * x)),
        })
    }

    /// Computes x^(top/bottom), for x > 0; at 0 too if only roots are taken.
    fn fractional(&self, a: &Tree, inner: &Jet, top: i64, bottom: i64) -> Found<Jet> {
        let x = &inner.value;
        match sure_sign(x)? {
            -1 => return Err(Lack::Value),
            0 if top < 0 => return Err(Lack::Value),
            0 if bottom == 2 => return self.corner(a),
            0 => return Err(Lack::Decision),
            _ => {}
        }
        let base = match bottom {
            2 => root(x)?,
            4 => root(&root(x)?)?,
            8 => root(&root(&root(x)?)?)?,
            _ => exp(&(log(x)? / whole(bottom)))?,
        };
        let value = to_the(&base, top)?;
        Ok(chained(inner, value, |value| value * whole(top) / (x * whole(bottom))))
    }

    fn norm(&self, whole_norm: &Tree, parts: &[Tree; 3]) -> Found<Jet> {
        let mut total = self.constant(whole(0));
        let mut lack = None;
        for part in parts {
            match self.jet(part) {
                Ok(part) => total = combined(&total, &product(&part, &part)?, sum)?,
                Err(Lack::Value) => return Err(Lack::Value),
                Err(found) => lack = Some(found),
            }
        }
        match lack {
            Some(lack) => Err(lack),
            None if is_zero(&total.value) => self.corner(whole_norm),
            None => rooted(&total),
        }
    }
}

/// Combines two parts: an undefined part leaves the whole undefined.
fn together(
    a: &Found<Jet>,
    b: &Found<Jet>,
    by: impl FnOnce(&Jet, &Jet) -> Found<Jet>,
) -> Found<Jet> {
    match (a, b) {
        (Ok(a), Ok(b)) => by(a, b),
        (a, b) => {
            let lack = |found: &Found<Jet>| found.as_ref().map(|_| ()).map_err(|lack| *lack);
            Err(both(lack(a), lack(b)).err().unwrap_or(Lack::Decision))
        }
    }
}

/// Applies the chain rule to f(a), with f' computed from the value where there are slopes.
fn chained(a: &Jet, value: Real, slope: impl FnOnce(&Real) -> Real) -> Jet {
    if a.slopes.is_empty() {
        return Jet { value, slopes: Vec::new() };
    }
    let slope = slope(&value);
    Jet { value, slopes: a.slopes.iter().map(|by| times(by, &slope)).collect() }
}

/// Computes the root of a positive value.
fn rooted(a: &Jet) -> Found<Jet> {
    let value = root(&a.value)?;
    let twice = &value * whole(2);
    // The error of a root may hide it.
    sure_sign(&twice)?;
    Ok(chained(a, value, |_| whole(1) / twice))
}

fn scaled(a: &Jet, by: &Real) -> Jet {
    Jet { value: &a.value * by, slopes: a.slopes.iter().map(|slope| times(slope, by)).collect() }
}

fn times(a: &Real, b: &Real) -> Real {
    if is_zero(a) || is_zero(b) { whole(0) } else { a * b }
}

fn combined(a: &Jet, b: &Jet, by: impl Fn(&Real, &Real) -> Found<Real>) -> Found<Jet> {
    if a.slopes.is_empty() {
        return Ok(Jet { value: by(&a.value, &b.value)?, slopes: Vec::new() });
    }
    let slopes: Found<Vec<Real>> = a.slopes.iter().zip(&b.slopes).map(|(a, b)| by(a, b)).collect();
    Ok(Jet { value: by(&a.value, &b.value)?, slopes: slopes? })
}

fn product(a: &Jet, b: &Jet) -> Found<Jet> {
    if a.slopes.is_empty() {
        return Ok(Jet { value: times(&a.value, &b.value), slopes: Vec::new() });
    }
    let slope = |(x, y): (&Real, &Real)| sum(&times(x, &b.value), &times(&a.value, y));
    let slopes: Found<Vec<Real>> = a.slopes.iter().zip(&b.slopes).map(slope).collect();
    Ok(Jet { value: times(&a.value, &b.value), slopes: slopes? })
}
