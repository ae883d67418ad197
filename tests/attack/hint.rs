//! Signs that f64 shows with certainty: values with bounds of their errors, so generous that more
//! bits would show the same. What is close to 0, to a corner or to an end is left open.

use super::expr::{Expr, Function, Number, Tree};
use super::point::Point;
use super::scene::{Origin, Scene};

/// A number between value − error and value + error.
#[derive(Clone, Copy, Debug)]
struct Ball {
    value: f64,
    error: f64,
}

/// The reason why f64 shows no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unseen {
    /// There is none.
    Lack,
    /// More bits decide.
    Open,
}

type Seen<T> = Result<T, Unseen>;

/// Share of a value by which an operation changes the error at most, and that of a function.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;
const ROUGHNESS: f64 = 1.0 / (1u64 << 44) as f64;
/// Factor by which a number that is certainly not 0 exceeds its error.
const CLEARLY: f64 = 16.0;
/// Error of numbers that are too small for f64.
const TINY: f64 = 1e-290;
/// Bounds within which exp, sin, cos and powers are looked at.
const STEEP: f64 = 299.0;
const FAR: f64 = 9e5;
const HUGE: f64 = 1e100;

/// Looks at two parts: a part without a value leaves the whole without one.
fn both(a: Seen<Ball>, b: Seen<Ball>) -> Seen<(Ball, Ball)> {
    match (a, b) {
        (Ok(a), Ok(b)) => Ok((a, b)),
        (Err(Unseen::Lack), _) | (_, Err(Unseen::Lack)) => Err(Unseen::Lack),
        _ => Err(Unseen::Open),
    }
}

impl Ball {
    fn new(value: f64, error: f64) -> Seen<Self> {
        let error = error + value.abs() * ROUNDING + TINY;
        let ball = Self { value, error };
        if value.is_finite() && error.is_finite() { Ok(ball) } else { Err(Unseen::Open) }
    }

    /// Returns a sign other than 0.
    fn sign(self) -> Seen<i32> {
        match self.value.abs() > CLEARLY * self.error {
            true => Ok(if self.value < 0.0 { -1 } else { 1 }),
            false => Err(Unseen::Open),
        }
    }

    /// Returns the number if it certainly is not 0.
    fn clear(self) -> Seen<Self> {
        self.sign().map(|_| self)
    }

    /// Returns the number if it certainly is positive; there is no value if it is negative.
    fn positive(self) -> Seen<Self> {
        if self.sign()? < 0 { Err(Unseen::Lack) } else { Ok(self) }
    }

    /// Returns a sum that certainly is not 0.
    fn plus(self, other: Self) -> Seen<Self> {
        Self::new(self.value + other.value, self.error + other.error)?.clear()
    }

    fn negated(self) -> Self {
        Self { value: -self.value, ..self }
    }

    fn times(self, other: Self) -> Seen<Self> {
        let (a, b) = (self.value.abs(), other.value.abs());
        let error = a * other.error + b * self.error + self.error * other.error;
        Self::new(self.value * other.value, error)
    }

    fn over(self, other: Self) -> Seen<Self> {
        other.clear()?;
        let value = self.value / other.value;
        let error = (self.error + value.abs() * other.error) / (other.value.abs() - other.error);
        Self::new(value, error)
    }

    fn to_the(self, n: i64) -> Seen<Self> {
        const MOST: i64 = 16;
        if n.abs() > MOST {
            return Err(Unseen::Open);
        }
        let one = Self { value: 1.0, error: 0.0 };
        let product = (0..n.abs()).try_fold(one, |product, _| product.times(self))?;
        if n < 0 { one.over(product) } else { Ok(product) }
    }

    /// Computes x^power for x > 0, with another error of the power.
    fn raised(self, power: f64, error: f64) -> Seen<Self> {
        let base = self.positive()?;
        let logarithm = base.value.ln();
        let is_near_1 = (base.value - 1.0).abs() < CLEARLY * base.error + ROUGHNESS;
        let share = 2.0 * error * logarithm.abs() + 2.0 * power.abs() * base.error / base.value;
        let share = share + ROUGHNESS * (1.0 + (power * logarithm).abs());
        let is_far = !(base.value < HUGE && base.value > HUGE.recip());
        if is_near_1 || is_far || (power * logarithm).abs() > STEEP || share > 0.25 {
            return Err(Unseen::Open);
        }
        let value = base.value.powf(power);
        Self::new(value, 2.0 * share * value)
    }

    fn of(self, function: Function) -> Seen<Self> {
        let Self { value, error } = self;
        match function {
            Function::Root => {
                let value = self.positive()?.value.sqrt();
                Self::new(value, error / value)
            }
            Function::Modulus => Ok(Self { value: self.clear()?.value.abs(), error }),
            Function::Exp if value.abs() < STEEP && error < 0.25 => {
                Self::new(value.exp(), value.exp() * (2.0 * error + ROUGHNESS))
            }
            Function::Log => {
                let base = self.positive()?;
                Self::new(value.ln(), 2.0 * base.error / value + ROUGHNESS)?.clear()
            }
            Function::Sin | Function::Cos if value.abs() < FAR => {
                let both = [value.sin(), value.cos()].map(|own| Self::new(own, error + ROUGHNESS));
                let [sin, cos] = both.map(|own| own.and_then(Self::clear));
                let (sin, cos) = (sin?, cos?);
                Ok(if function == Function::Sin { sin } else { cos })
            }
            Function::Atan => Self::new(value.atan(), error + ROUGHNESS),
            Function::Exp | Function::Sin | Function::Cos => Err(Unseen::Open),
        }
    }
}

fn look(tree: &Tree, values: &[Seen<Ball>]) -> Seen<Ball> {
    let at = |part: &Tree| look(part, values);
    match &**tree {
        Expr::Number(n) => number(n),
        Expr::Symbol(place) => values[*place],
        Expr::Neg(a) => at(a).map(Ball::negated),
        Expr::Add(a, b) => both(at(a), at(b)).and_then(|(a, b)| a.plus(b)),
        Expr::Sub(a, b) => both(at(a), at(b)).and_then(|(a, b)| a.plus(b.negated())),
        Expr::Mul(a, b) => both(at(a), at(b)).and_then(|(a, b)| a.times(b)),
        Expr::Div(a, b) => both(at(a), at(b)).and_then(|(a, b)| a.over(b)),
        Expr::Power(a, top, 1) => at(a)?.to_the(*top),
        Expr::Power(a, top, bottom) => at(a)?.raised(*top as f64 / *bottom as f64, ROUNDING),
        Expr::PowerTo(a, b) => both(at(a), at(b)).and_then(|(a, b)| a.raised(b.value, b.error)),
        Expr::Of(function, a) => at(a)?.of(*function),
        Expr::Norm([a, b, c]) => {
            let square = |part: &Tree| at(part).and_then(|part| part.times(part));
            let two = both(square(a), square(b)).and_then(|(a, b)| a.plus(b));
            both(two, square(c)).and_then(|(two, c)| two.plus(c))?.of(Function::Root)
        }
    }
}

/// Adds two floats without an error, in two parts.
fn exact(a: f64, b: f64) -> (f64, f64) {
    let total = a + b;
    let part = total - a;
    (total, (a - (total - part)) + (b - part))
}

/// Converts a number to two floats and an error.
fn wide(n: &Number) -> (f64, f64, f64) {
    let (top, bottom) = (n.top as f64, n.bottom as f64);
    let value = top / bottom;
    match n.tens {
        0 => (value, -value.mul_add(bottom, -top) / bottom, value.abs() * 2f64.powi(-100)),
        tens => {
            let value = value * 10f64.powi(tens);
            (value, 0.0, value.abs() * ROUGHNESS)
        }
    }
}

fn number(n: &Number) -> Seen<Ball> {
    let (value, rest, error) = wide(n);
    Ball::new(value, rest.abs() + error)
}

/// Computes low + (high − low) · (cube + fine).
fn between(low: &Number, high: &Number, (cube, fine): (f64, f64)) -> Seen<Ball> {
    let ((a, a_rest, a_error), (b, b_rest, b_error)) = (wide(low), wide(high));
    let (width, rest) = exact(b, -a);
    let rest = rest + b_rest - a_rest;
    let (share, more) = exact(cube, fine);
    let product = width * share;
    let below = width.mul_add(share, -product) + width * more + rest * share;
    let (total, last) = exact(a, product);
    let error = a_error + b_error + (a.abs() + b.abs()) * 2f64.powi(-95);
    Ball::new(total + (last + below + a_rest), 2.0 * error)
}

/// Values of the symbols of a scene in f64 on a line through a point.
pub struct Hints<'h> {
    scene: &'h Scene,
    from: &'h Point,
    place: usize,
    /// Values of what is drawn.
    drawn: Vec<Seen<Ball>>,
}

impl<'h> Hints<'h> {
    pub fn new(scene: &'h Scene, from: &'h Point, place: usize) -> Self {
        let value = |(place, symbol): (usize, &super::scene::Symbol)| match &symbol.origin {
            Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b) => {
                between(a, b, (from.cube[place], from.fine[place]))
            }
            Origin::Fixed(n) => number(n),
            Origin::List(list) => number(&list[from.picks[place]]),
            Origin::Formula(_) => Err(Unseen::Open),
        };
        let drawn = scene.symbols.iter().enumerate().map(value).collect();
        Self { scene, from, place, drawn }
    }

    /// Returns the values at a position; a lack if there certainly is no state.
    fn values(&self, at: (f64, f64)) -> Seen<Vec<Seen<Ball>>> {
        if self.scene.level.as_ref().is_some_and(|level| level.branches.is_empty()) {
            return Err(Unseen::Lack);
        }
        let mut values = self.drawn.clone();
        for (place, symbol) in self.scene.symbols.iter().enumerate() {
            match &symbol.origin {
                Origin::Formula(tree) => values[place] = look(tree, &values),
                Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b)
                    if place == self.place =>
                {
                    values[place] = between(a, b, at);
                }
                _ => {}
            }
        }
        for (place, tree) in self.scene.branch(self.from) {
            let value = look(tree, &values)?;
            if let Origin::State(a, b) | Origin::Range(a, b) = &self.scene.symbols[*place].origin {
                for gap in [value.plus(number(a)?.negated()), number(b)?.plus(value.negated())] {
                    gap?.positive()?;
                }
            }
            values[*place] = Ok(value);
        }
        Ok(values)
    }

    /// Returns the signs of parts at a position where there certainly is a state; a lack if there
    /// certainly is none.
    pub fn signs<'t>(
        &self,
        at: (f64, f64),
        parts: impl Iterator<Item = &'t Tree>,
    ) -> Seen<Vec<Seen<i32>>> {
        let values = self.values(at)?;
        Ok(parts.map(|part| look(part, &values)?.sign()).collect())
    }
}

/// Returns the sign of a formula at a point, where f64 shows that it is a state, and that all have
/// values that belong to every claim.
pub fn sign(scene: &Scene, point: &Point, tree: &Tree) -> Option<i32> {
    let hints = Hints::new(scene, point, scene.symbols.len());
    let values = hints.values((0.0, 0.0)).ok()?;
    let rates = scene.field.iter().map(|(_, rate)| look(rate, &values));
    match values.iter().copied().chain(rates).all(|found| found.is_ok()) {
        true => look(tree, &values).and_then(Ball::sign).ok(),
        false => None,
    }
}
