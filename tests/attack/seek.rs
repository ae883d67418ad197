//! Search for thin sets of states: descent, in f64, to where formulas have values, and from there to
//! where their parts have either sign. Found points are examined in full precision by the survey.

use super::expr::{Expr, Function, Tree};
use super::point::Point;
use super::random::Stream;
use super::scene::{Origin, Scene, Symbol, rough};

/// Factor of a step after a failure.
const FRACTION: f64 = 0.3;
/// Smallest step.
const LEAST: f64 = 1e-11;
/// Largest number of parts whose signs are sought.
const PARTS: usize = 24;

/// A goal of a descent: less of the second is better only for equal first parts.
type Height = (f64, f64);

/// What is sought, given the strain of a point and the values of its parts.
#[derive(Clone, Copy, Debug)]
enum Goal {
    /// A state at which all formulas have values.
    Value,
    /// Such a state at which part `k` is negative (-1) or positive (1).
    Sign(usize, f64),
    /// The state at which part `k` is smallest (-1) or largest (1).
    End(usize, f64),
}

/// Finds states at which some formulas have values, and the divisors and the arguments of roots,
/// moduli and powers in them either sign; from so many points, by descents of so many steps.
pub fn thin(
    scene: &Scene,
    trees: &[&Tree],
    stream: &mut Stream,
    (starts, steps): (usize, usize),
) -> Vec<Point> {
    let seeker = Seeker { scene, trees, steps, sums: false };
    (0..starts).flat_map(|start| seeker.found(scene.point(stream, start % 3 == 2))).collect()
}

/// Finds states at which a formula has either sign, from one point by descents of so many steps.
pub fn of_each_sign(scene: &Scene, tree: &Tree, from: Point, steps: usize) -> Vec<Point> {
    Seeker { scene, trees: &[tree], steps, sums: true }.extremes(from)
}

/// A search for states at which some formulas have values.
struct Seeker<'a> {
    scene: &'a Scene,
    trees: &'a [&'a Tree],
    /// Largest number of steps of a descent.
    steps: usize,
    /// Whether sums are among the parts whose signs are sought.
    sums: bool,
}

impl Seeker<'_> {
    /// Finds a state, and from there states at which parts have the other sign.
    fn found(&self, from: Point) -> Vec<Point> {
        let Some(state) = self.descended(from, Goal::Value) else { return Vec::new() };
        let parts = self.look(&state).1;
        let mut found = Vec::new();
        let last = parts.len().checked_sub(1);
        for part in (0..parts.len().min(PARTS)).chain(last) {
            let sign = if parts[part] > 0.0 { -1.0 } else { 1.0 };
            found.extend(self.descended(state.clone(), Goal::Sign(part, sign)));
        }
        found.push(state);
        found
    }

    /// Finds states at which the first formula has either sign, from states at which its parts are
    /// as small and as large as descents make them.
    fn extremes(&self, from: Point) -> Vec<Point> {
        let Some(state) = self.descended(from, Goal::Value) else { return Vec::new() };
        let parts = self.look(&state).1.len();
        let Some(last) = parts.checked_sub(1) else { return Vec::new() };
        let mut found = vec![state.clone()];
        for part in (0..parts.min(PARTS)).chain([last]) {
            for end in [-1.0, 1.0] {
                let from = self.descent(state.clone(), Goal::End(part, end)).0;
                for sign in [-1.0, 1.0] {
                    found.extend(self.descended(from.clone(), Goal::Sign(last, sign)));
                }
            }
        }
        found
    }

    /// Descends from a point; `None` if the goal is not reached.
    fn descended(&self, from: Point, goal: Goal) -> Option<Point> {
        let (point, is_reached) = self.descent(from, goal);
        is_reached.then_some(point)
    }

    /// Descends from a point by steps along one or two coordinates, and tells whether the goal is
    /// reached.
    fn descent(&self, from: Point, goal: Goal) -> (Point, bool) {
        let mut slope = Slope::new(self, from, goal);
        let free = self.scene.free();
        let mut step = 0.3;
        for _ in 0..self.steps {
            if slope.is_reached() || step < LEAST {
                break;
            }
            let mut helped = false;
            for place in &free {
                for by in [step, -step] {
                    helped |= slope.attempt([(*place, by)]);
                }
            }
            // A valley may lie between two axes.
            for (k, first) in free.iter().enumerate() {
                for second in &free[..k] {
                    for (by, across) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                        helped |= slope.attempt([(*first, by * step), (*second, across * step)]);
                        if helped {
                            break;
                        }
                    }
                }
            }
            step = if helped { (2.0 * step).min(0.5) } else { FRACTION * step };
        }
        let is_reached = slope.is_reached();
        (slope.point, is_reached)
    }

    /// Returns how far a point is from a state at which some formulas have values, 0 for such a state;
    /// with the arguments of roots, moduli and powers, and with the value of the first formula.
    fn look(&self, point: &Point) -> (f64, Vec<f64>) {
        let mut slope = Slope::new(self, point.clone(), Goal::Value);
        (slope.strain(f64::INFINITY), slope.relaxed.parts)
    }
}

/// The source of the value of a symbol at points of one branch and choice of lists.
#[derive(Clone, Copy, Debug)]
enum Source<'s> {
    /// Low end and width of a range.
    Range(f64, f64),
    Given(f64),
    Formula(&'s Tree),
}

/// The best point of a descent, with space for the evaluation of others.
struct Slope<'s> {
    seeker: &'s Seeker<'s>,
    point: Point,
    goal: Goal,
    best: Height,
    sources: Vec<Source<'s>>,
    /// Ranges of dependent variables.
    ends: Vec<(f64, f64)>,
    relaxed: Relaxed,
}

impl<'s> Slope<'s> {
    fn new(seeker: &'s Seeker<'s>, point: Point, goal: Goal) -> Self {
        let scene = seeker.scene;
        let source = |(place, symbol): (usize, &'s Symbol)| match &symbol.origin {
            Origin::State(..) | Origin::Range(..) | Origin::Input(..) => {
                let (low, high) = scene.ends(place);
                Source::Range(low, high - low)
            }
            Origin::Fixed(_) | Origin::List(_) => Source::Given(scene.given(&point, place)),
            Origin::Formula(tree) => Source::Formula(tree),
        };
        let sources = scene.symbols.iter().enumerate().map(source).collect();
        let ends = scene.branch(&point).iter().map(|(place, _)| scene.ends(*place)).collect();
        let sums = seeker.sums;
        let relaxed = Relaxed { values: Vec::new(), strain: 0.0, parts: Vec::new(), sums };
        let best = (f64::INFINITY, f64::INFINITY);
        let mut slope = Self { seeker, point, goal, best, sources, ends, relaxed };
        slope.best = slope.height();
        slope
    }

    fn height(&mut self) -> Height {
        let strain = self.strain(self.best.0);
        let value = match self.goal {
            Goal::Value => 0.0,
            Goal::Sign(part, sign) | Goal::End(part, sign) => {
                -sign * self.relaxed.parts.get(part).copied().unwrap_or(0.0)
            }
        };
        (strain, value)
    }

    fn is_reached(&self) -> bool {
        match self.goal {
            Goal::Value => self.best.0 == 0.0,
            Goal::Sign(..) => self.best.0 == 0.0 && self.best.1 < 0.0,
            Goal::End(..) => false,
        }
    }

    /// Moves the point by steps along coordinates inside their ranges, if that is better.
    fn attempt<const N: usize>(&mut self, steps: [(usize, f64); N]) -> bool {
        let before = steps.map(|(place, _)| self.point.cube[place]);
        for (place, by) in steps {
            self.point.cube[place] = (self.point.cube[place] + by).clamp(0.0, 1.0);
        }
        let reached = self.height();
        let is_better = reached < self.best;
        if is_better {
            self.best = reached;
        } else {
            for ((place, _), before) in steps.into_iter().zip(before) {
                self.point.cube[place] = before;
            }
        }
        is_better
    }

    /// Returns the strain of the point, or of a part of the formulas if that is above a bound.
    fn strain(&mut self, most: f64) -> f64 {
        let Seeker { scene, trees, .. } = *self.seeker;
        let relaxed = &mut self.relaxed;
        relaxed.values.clear();
        relaxed.parts.clear();
        relaxed.strain = 0.0;
        for (place, source) in self.sources.iter().enumerate() {
            let value = match source {
                Source::Range(low, width) => low + width * self.point.cube[place],
                Source::Given(value) => *value,
                Source::Formula(tree) => relaxed.look(tree),
            };
            relaxed.values.push(value);
        }
        for ((place, tree), (low, high)) in scene.branch(&self.point).iter().zip(&self.ends) {
            let value = relaxed.look(tree);
            relaxed.strain += (low - value).max(0.0) + (value - high).max(0.0);
            relaxed.values[*place] = value;
        }
        let mut first = None;
        for tree in trees {
            if relaxed.strain > most {
                return relaxed.strain;
            }
            let value = relaxed.look(tree);
            first.get_or_insert(value);
        }
        for (_, rate) in &scene.field {
            relaxed.look(rate);
        }
        relaxed.parts.extend(first);
        if relaxed.strain.is_nan() { f64::INFINITY } else { relaxed.strain }
    }
}

/// Evaluation that goes on where a formula has no value.
struct Relaxed {
    values: Vec<f64>,
    strain: f64,
    parts: Vec<f64>,
    sums: bool,
}

impl Relaxed {
    fn look(&mut self, tree: &Tree) -> f64 {
        match &**tree {
            Expr::Number(n) => rough(n),
            Expr::Symbol(place) => self.values[*place],
            Expr::Neg(a) => -self.look(a),
            Expr::Add(a, b) => {
                let total = self.look(a) + self.look(b);
                self.summed(total)
            }
            Expr::Sub(a, b) => {
                let total = self.look(a) - self.look(b);
                self.summed(total)
            }
            Expr::Mul(a, b) => self.look(a) * self.look(b),
            Expr::Div(a, b) => {
                let (a, b) = (self.look(a), self.look(b));
                self.parts.push(b);
                // A descent to an infinite value would end there.
                if b == 0.0 {
                    self.strain += 1.0;
                }
                a / b
            }
            Expr::Power(a, top, 1) => {
                let a = self.look(a);
                self.parts.push(a);
                a.powi(i32::try_from(*top).unwrap_or(i32::MAX))
            }
            Expr::Power(a, top, bottom) => {
                let a = self.look(a);
                self.not_below(a, *top < 0).powf(*top as f64 / *bottom as f64)
            }
            Expr::PowerTo(a, b) => {
                let a = self.look(a);
                let b = self.look(b);
                self.not_below(a, true).powf(b)
            }
            Expr::Of(function, a) => {
                let a = self.look(a);
                match function {
                    Function::Root => self.not_below(a, false).sqrt(),
                    Function::Modulus => {
                        self.parts.push(a);
                        a.abs()
                    }
                    Function::Exp => a.exp(),
                    Function::Log => self.not_below(a, true).ln(),
                    Function::Sin => a.sin(),
                    Function::Cos => a.cos(),
                    Function::Atan => a.atan(),
                }
            }
            Expr::Norm(parts) => {
                parts.iter().map(|part| self.look(part).powi(2)).sum::<f64>().sqrt()
            }
        }
    }

    fn summed(&mut self, total: f64) -> f64 {
        if self.sums {
            self.parts.push(total);
        }
        total
    }

    /// Adds to the strain if the argument is negative, and returns it, or 0 instead.
    fn not_below(&mut self, a: f64, strictly: bool) -> f64 {
        self.parts.push(a);
        let least = if strictly { f64::MIN_POSITIVE } else { 0.0 };
        if a < least {
            self.strain += least - a;
            return least;
        }
        a
    }
}
