//! Ranges of expressions, by intervals over the declared ranges; for rewriting only.

use super::expr::{Expr, Function, Tree};

/// A closed interval, rounded outwards.
pub type Interval = (f64, f64);

const ALL: Interval = (f64::NEG_INFINITY, f64::INFINITY);

/// Encloses all values of the expression; `None` where it may be undefined.
pub fn range(tree: &Tree, symbols: &[Interval]) -> Option<Interval> {
    let at = |part: &Tree| range(part, symbols);
    let found = match &**tree {
        Expr::Number(n) => {
            let value = n.top as f64 / n.bottom as f64 * 10f64.powi(n.tens);
            (value, value)
        }
        Expr::Symbol(place) => return Some(symbols[*place]),
        Expr::Neg(a) => at(a).map(|(l, h)| (-h, -l))?,
        Expr::Add(a, b) => added(at(a)?, at(b)?),
        Expr::Sub(a, b) => {
            let (l, h) = at(b)?;
            added(at(a)?, (-h, -l))
        }
        Expr::Mul(a, b) if a == b => squared(at(a)?),
        Expr::Mul(a, b) => product(at(a)?, at(b)?),
        Expr::Div(a, b) => {
            let (l, h) = at(b)?;
            if l <= 0.0 && h >= 0.0 {
                return None;
            }
            product(at(a)?, (1.0 / h, 1.0 / l))
        }
        Expr::Power(a, 2, 1) => squared(at(a)?),
        Expr::Power(a, n, 1) if *n > 0 => {
            (1..*n).try_fold(at(a)?, |found, _| Some(product(found, at(a)?)))?
        }
        Expr::Power(a, top, bottom) => {
            let (l, h) = at(a)?;
            if l <= 0.0 {
                return None;
            }
            let q = *top as f64 / *bottom as f64;
            let (x, y) = (l.powf(q), h.powf(q));
            (x.min(y), x.max(y))
        }
        Expr::PowerTo(a, b) => {
            at(a).filter(|(l, _)| *l > 0.0)?;
            at(b)?;
            (0.0, f64::INFINITY)
        }
        Expr::Of(function, a) => of(*function, at(a)?)?,
        Expr::Norm(parts) => {
            let mut total = (0.0, 0.0);
            for part in parts {
                total = added(total, squared(at(part)?));
            }
            of(Function::Root, outward(total))?
        }
    };
    Some(outward(found))
}

fn of(function: Function, (l, h): Interval) -> Option<Interval> {
    Some(match function {
        Function::Root if l < -1e-12 => return None,
        Function::Root => (l.max(0.0).sqrt(), h.sqrt()),
        Function::Modulus if l > 0.0 => (l, h),
        Function::Modulus if h < 0.0 => (-h, -l),
        Function::Modulus => (0.0, h.max(-l)),
        Function::Exp => (l.exp(), h.exp()),
        Function::Log if l <= 0.0 => return None,
        Function::Log => (l.ln(), h.ln()),
        Function::Sin | Function::Cos => (-1.0, 1.0),
        Function::Atan => (l.atan(), h.atan()),
    })
}

fn added(a: Interval, b: Interval) -> Interval {
    (a.0 + b.0, a.1 + b.1)
}

fn product(a: Interval, b: Interval) -> Interval {
    let all = [a.0 * b.0, a.0 * b.1, a.1 * b.0, a.1 * b.1];
    if all.iter().any(|x| x.is_nan()) {
        return ALL;
    }
    (
        all.iter().copied().fold(f64::INFINITY, f64::min),
        all.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    )
}

fn squared((l, h): Interval) -> Interval {
    let most = (l * l).max(h * h);
    if l <= 0.0 && h >= 0.0 { (0.0, most) } else { ((l * l).min(h * h), most) }
}

/// Widens an interval slightly; 0 stays in place, as sums of squares are not negative.
fn outward((l, h): Interval) -> Interval {
    let slack = |x: f64| 1e-12 * x.abs();
    (l - slack(l), h + slack(h))
}

/// Whether the expression is defined and positive over the ranges.
pub fn is_positive(tree: &Tree, symbols: &[Interval]) -> bool {
    range(tree, symbols).is_some_and(|(l, _)| l > 1e-9)
}

/// Whether the expression is defined and not negative over the ranges.
pub fn is_nonnegative(tree: &Tree, symbols: &[Interval]) -> bool {
    range(tree, symbols).is_some_and(|(l, _)| l >= 0.0)
}
