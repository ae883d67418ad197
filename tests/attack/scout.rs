//! Fast evaluation of expressions in f64: the pattern of signs of all arguments of roots, moduli,
//! logarithms and powers. Functions with corners differ between states of different patterns.

use super::expr::{Expr, Function, Tree};

/// A value with the size of the terms in its sums.
#[derive(Clone, Copy, Debug)]
pub struct Rough {
    value: f64,
    size: f64,
}

/// Share of its terms below which a sum counts as 0.
const NOISE: f64 = 1e-11;

/// The pattern of some expressions at one state.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sight {
    /// Digest of the signs.
    pub pattern: u64,
    /// Whether all of them are defined, as far as f64 shows.
    pub defined: bool,
}

/// Finds the pattern of some expressions at a state.
pub fn sight<'t>(trees: impl IntoIterator<Item = &'t Tree>, values: &[f64]) -> Sight {
    let mut scout = Scout { values, pattern: 0 };
    let mut defined = true;
    for tree in trees {
        defined &= scout.look(tree).is_some();
    }
    Sight { pattern: scout.pattern, defined }
}

/// Evaluates an expression at a state.
pub fn value(tree: &Tree, values: &[f64]) -> Option<f64> {
    Scout { values, pattern: 0 }.look(tree).map(|found| found.value)
}

struct Scout<'a> {
    values: &'a [f64],
    pattern: u64,
}

impl Scout<'_> {
    fn sign(&mut self, x: Rough) -> i32 {
        let sign = match x.value {
            v if v.abs() <= NOISE * x.size => 0,
            v if v < 0.0 => -1,
            _ => 1,
        };
        self.pattern =
            (self.pattern.rotate_left(7) ^ (sign + 2) as u64).wrapping_mul(0x2545_f491_4f6c_dd1d);
        sign
    }

    /// Evaluates an expression after recording the signs of all parts; `None` if it is undefined.
    fn look(&mut self, tree: &Tree) -> Option<Rough> {
        let exact = |value: f64| Rough { value, size: value.abs() };
        let found = match &**tree {
            Expr::Number(n) => exact(n.top as f64 / n.bottom as f64 * 10f64.powi(n.tens)),
            Expr::Symbol(place) => exact(self.values[*place]),
            Expr::Neg(a) => self.look(a).map(|a| Rough { value: -a.value, size: a.size })?,
            Expr::Add(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                let (a, b) = (a?, b?);
                Rough { value: a.value + b.value, size: a.size + b.size }
            }
            Expr::Sub(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                let (a, b) = (a?, b?);
                Rough { value: a.value - b.value, size: a.size + b.size }
            }
            Expr::Mul(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                let (a, b) = (a?, b?);
                Rough { value: a.value * b.value, size: a.size * b.size }
            }
            Expr::Div(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                let (a, b) = (a?, b?);
                if self.sign(b) == 0 {
                    return None;
                }
                let value = a.value / b.value;
                Rough { value, size: (a.size / b.value).abs() * (b.size / b.value.abs()) }
            }
            Expr::Power(a, top, 1) => {
                let a = self.look(a)?;
                if *top < 0 && self.sign(a) == 0 {
                    return None;
                }
                if top % 2 == 0 {
                    // √(a²) has a corner where a is 0.
                    self.sign(a);
                }
                let n = i32::try_from(*top).unwrap_or(i32::MAX);
                let value = a.value.powi(n);
                let blow = (a.size / a.value.abs()).max(1.0);
                Rough { value, size: if n > 0 { a.size.powi(n) } else { value.abs() * blow } }
            }
            Expr::Power(a, top, bottom) => {
                let a = self.look(a)?;
                match self.sign(a) {
                    1 => exact(a.value.powf(*top as f64 / *bottom as f64)),
                    0 if *top > 0 => exact(0.0),
                    _ => return None,
                }
            }
            Expr::PowerTo(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                let (a, b) = (a?, b?);
                if self.sign(a) <= 0 {
                    return None;
                }
                exact(a.value.powf(b.value))
            }
            Expr::Of(function, a) => {
                let a = self.look(a)?;
                self.of(*function, a)?
            }
            Expr::Norm(parts) => {
                let parts = parts.each_ref().map(|part| self.look(part));
                let mut total = Rough { value: 0.0, size: 0.0 };
                for part in parts {
                    let part = part?;
                    total.value += part.value * part.value;
                    total.size += part.size * part.size;
                }
                self.sign(total);
                exact(total.value.sqrt())
            }
        };
        (found.value.is_finite() && found.size.is_finite()).then_some(found)
    }

    fn of(&mut self, function: Function, a: Rough) -> Option<Rough> {
        let exact = |value: f64| Rough { value, size: value.abs() };
        // Exact parts of a keep their size where the function is smooth.
        let smooth = |value: f64| Rough { value, size: value.abs() + a.size };
        Some(match function {
            Function::Root => match self.sign(a) {
                -1 => return None,
                0 => exact(0.0),
                _ => exact(a.value.sqrt()),
            },
            Function::Modulus => match self.sign(a) {
                0 => exact(0.0),
                _ => Rough { value: a.value.abs(), size: a.size },
            },
            Function::Exp => exact(a.value.exp()),
            Function::Log => match self.sign(a) {
                1 => smooth(a.value.ln()),
                _ => return None,
            },
            Function::Sin => smooth(a.value.sin()),
            Function::Cos => smooth(a.value.cos()),
            Function::Atan => smooth(a.value.atan()),
        })
    }
}
