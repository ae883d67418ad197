//! A system of the attack: symbols with ranges, a field, a level, and states.

use super::expr::{Number, Tree};
use super::interval::Interval;
use super::jet::Place;
use super::point::Point;
use super::random::Stream;
use super::real::{Found, Real, both, difference, exactly, number, sign};
use super::scout;

/// The source of the values of a symbol.
#[derive(Clone, Debug)]
pub enum Origin {
    /// A state variable with its range.
    State(Number, Number),
    /// A parameter drawn from a range.
    Range(Number, Number),
    /// An input of a given chart.
    Input(Number, Number),
    /// A parameter with one value.
    Fixed(Number),
    /// A parameter with a list of values.
    List(Vec<Number>),
    /// A parameter computed from those before it.
    Formula(Tree),
}

/// A name with its origin.
#[derive(Clone, Debug)]
pub struct Symbol {
    pub name: String,
    pub origin: Origin,
}

/// A level set with all its branches.
#[derive(Clone, Debug)]
pub struct Level {
    /// Both sides of each equation.
    pub equations: Vec<(Tree, Tree)>,
    /// Dependent variables of each branch as functions of the drawn ones; together the branches are
    /// the whole level.
    pub branches: Vec<Vec<(usize, Tree)>>,
    /// Chart, if one is given.
    pub chart: Option<Vec<(usize, Tree)>>,
}

/// A system.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    pub symbols: Vec<Symbol>,
    /// Rates of state variables; others are constant.
    pub field: Vec<(usize, Tree)>,
    pub level: Option<Level>,
}

/// Returns a number in f64.
pub fn rough(n: &Number) -> f64 {
    match (n.bottom, n.tens) {
        (1, 0) => n.top as f64,
        (bottom, tens) => n.top as f64 / bottom as f64 * 10f64.powi(tens),
    }
}

impl Scene {
    pub fn names(&self) -> Vec<String> {
        self.symbols.iter().map(|symbol| symbol.name.clone()).collect()
    }

    /// Returns the indices of the state variables.
    pub fn states(&self) -> Vec<usize> {
        let is_state = |place: &usize| matches!(self.symbols[*place].origin, Origin::State(..));
        (0..self.symbols.len()).filter(is_state).collect()
    }

    /// Whether a given chart fills the level.
    pub fn is_filled(&self) -> bool {
        let fills = |level: &Level| match &level.chart {
            Some(chart) => level.branches.first() == Some(chart),
            None => true,
        };
        self.level.as_ref().is_none_or(fills)
    }

    /// Whether an expression depends on a parameter.
    pub fn has_parameter(&self, tree: &Tree) -> bool {
        let is_state = |place: usize| matches!(self.symbols[place].origin, Origin::State(..));
        (0..self.symbols.len()).any(|place| !is_state(place) && tree.has(place))
    }

    /// Returns the rate of a state variable, if it has one.
    pub fn rate(&self, place: usize) -> Option<&Tree> {
        self.field.iter().find(|(own, _)| *own == place).map(|(_, rate)| rate)
    }

    /// Returns the range of each symbol.
    pub fn intervals(&self) -> Vec<Interval> {
        let value = |n: &Number| n.top as f64 / n.bottom as f64 * 10f64.powi(n.tens);
        let mut found: Vec<Interval> = Vec::new();
        for symbol in &self.symbols {
            let own = match &symbol.origin {
                Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b) => {
                    (value(a), value(b))
                }
                Origin::Fixed(n) => (value(n), value(n)),
                Origin::List(list) => list
                    .iter()
                    .map(value)
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                        (low.min(x), high.max(x))
                    }),
                Origin::Formula(tree) => super::interval::range(tree, &found)
                    .unwrap_or((f64::NEG_INFINITY, f64::INFINITY)),
            };
            found.push(own);
        }
        found
    }

    /// Draws a random point: anywhere, or near the ends of ranges.
    pub fn point(&self, stream: &mut Stream, near_ends: bool) -> Point {
        let branches = self.level.as_ref().map_or(1, |level| level.branches.len());
        let pick = |symbol: &Symbol, stream: &mut Stream| match &symbol.origin {
            Origin::List(list) => stream.below(list.len()),
            _ => 0,
        };
        let branch = stream.below(branches);
        let picks = self.symbols.iter().map(|symbol| pick(symbol, stream)).collect();
        let coordinate = |stream: &mut Stream| match near_ends && stream.once_in(2) {
            false => stream.unit(),
            true => {
                let off = 10f64.powf(-9.0 * stream.unit());
                if stream.once_in(2) { off } else { 1.0 - off }
            }
        };
        let cube = self.symbols.iter().map(|_| coordinate(stream)).collect();
        Point { branch, picks, cube, fine: vec![0.0; self.symbols.len()] }
    }

    /// Returns the formulas of parameters.
    pub fn formulas(&self) -> impl Iterator<Item = &Tree> {
        self.symbols.iter().filter_map(|symbol| match &symbol.origin {
            Origin::Formula(tree) => Some(tree),
            _ => None,
        })
    }

    /// Whether intervals show that no state lies on the level.
    pub fn is_empty(&self) -> bool {
        let ranges = self.intervals();
        let misses = |(place, tree): &(usize, Tree)| {
            let (low, high) = ranges[*place];
            super::interval::range(tree, &ranges).is_some_and(|(a, b)| b < low || high < a)
        };
        let is_empty =
            |level: &Level| level.branches.iter().all(|branch| branch.iter().any(misses));
        self.level.as_ref().is_some_and(is_empty)
    }

    /// Makes the same scene in the whole space.
    pub fn without_level(&self) -> Self {
        Self { level: None, ..self.clone() }
    }

    /// Makes the same scene on each branch of its level.
    pub fn branches(&self) -> Vec<Self> {
        let Some(level) = &self.level else { return vec![self.clone()] };
        let on = |branch: &Vec<(usize, Tree)>| {
            let level = Level { branches: vec![branch.clone()], ..level.clone() };
            Self { level: Some(level), ..self.clone() }
        };
        level.branches.iter().map(on).collect()
    }

    /// Makes the same scene for each choice of listed values.
    pub fn unlisted(&self) -> Vec<Self> {
        let mut all = vec![self.clone()];
        for (place, symbol) in self.symbols.iter().enumerate() {
            let Origin::List(list) = &symbol.origin else { continue };
            let fixed = |scene: &Self, value: &Number| {
                let mut scene = scene.clone();
                scene.symbols[place].origin = Origin::Fixed(*value);
                scene
            };
            all = all
                .iter()
                .flat_map(|scene| list.iter().map(move |value| fixed(scene, value)))
                .collect();
        }
        all
    }

    /// Whether the value is certainly outside the declared range, by more than `slack`.
    pub fn is_out_of_range(&self, place: usize, value: &Real, slack: f64) -> bool {
        let is_below = |a: &Real, b: &Real| {
            difference(b, &(a + exactly(slack))).is_ok_and(|gap| sign(&gap) > 0)
        };
        match &self.symbols[place].origin {
            Origin::State(a, b) | Origin::Range(a, b) => {
                is_below(value, &number(*a)) || is_below(&number(*b), value)
            }
            _ => false,
        }
    }

    /// Returns the symbols that vary independently: those drawn from ranges.
    pub fn free(&self) -> Vec<usize> {
        let branches = self.level.iter().flat_map(|level| &level.branches);
        let bound: Vec<usize> = match self.level.as_ref().map_or(0, |level| level.branches.len()) {
            1 => branches.flatten().map(|(place, _)| *place).collect(),
            _ => Vec::new(),
        };
        let varies = |place: &usize| {
            let origin = &self.symbols[*place].origin;
            matches!(origin, Origin::State(..) | Origin::Range(..) | Origin::Input(..))
        };
        (0..self.symbols.len()).filter(|place| varies(place) && !bound.contains(place)).collect()
    }

    /// Returns the ends of a symbol's range in f64.
    pub fn ends(&self, place: usize) -> (f64, f64) {
        match &self.symbols[place].origin {
            Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b) => (rough(a), rough(b)),
            _ => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// Returns a symbol's value in f64, if it is not given by a formula.
    pub fn given(&self, point: &Point, place: usize) -> f64 {
        match &self.symbols[place].origin {
            Origin::Fixed(n) => rough(n),
            Origin::List(list) => rough(&list[point.picks[place]]),
            Origin::Formula(_) => f64::NAN,
            Origin::State(..) | Origin::Range(..) | Origin::Input(..) => {
                let (low, high) = self.ends(place);
                low + (high - low) * point.cube[place]
            }
        }
    }

    /// Returns the dependent variables on a point's branch of the level.
    pub fn branch(&self, point: &Point) -> &[(usize, Tree)] {
        let level = self.level.as_ref();
        level.and_then(|level| level.branches.get(point.branch)).map_or(&[], |branch| branch)
    }

    /// Computes the values in f64.
    pub fn rough_values(&self, point: &Point) -> Option<Vec<f64>> {
        let mut values: Vec<f64> = Vec::new();
        for (place, symbol) in self.symbols.iter().enumerate() {
            let found = match &symbol.origin {
                Origin::Formula(tree) => scout::value(tree, &values).unwrap_or(f64::NAN),
                _ => self.given(point, place),
            };
            values.push(found);
        }
        let Some(level) = &self.level else { return Some(values) };
        for (place, tree) in level.branches.get(point.branch)? {
            let found = scout::value(tree, &values)?;
            let (low, high) = self.ends(*place);
            // The ends belong to the range; full precision decides what is next to them.
            let slack = 1e-9 * (high - low).min(1.0);
            if !(found >= low - slack && found <= high + slack) {
                return None;
            }
            values[*place] = found;
        }
        Some(values)
    }

    /// Checks that what the claim does not mention is defined as well: the equations of motion belong to every
    /// claim, and the parameters that these, the level or the claim's formulas use.
    pub fn lack_elsewhere(&self, values: &[Found<Real>], claim: &[&Tree]) -> Found<()> {
        let place = Place { values, along: &[] };
        let rates = self.field.iter().map(|(_, rate)| place.value(rate));
        let used =
            values.iter().enumerate().filter(|(at, own)| own.is_ok() || self.uses(*at, claim));
        let parts = used.map(|(_, own)| own.clone()).chain(rates).map(|found| found.map(|_| ()));
        let mut all = Ok(());
        for part in parts {
            all = both(all, part).map(|_| ());
        }
        all
    }

    /// Whether a symbol matters to a claim with these formulas.
    fn uses(&self, place: usize, claim: &[&Tree]) -> bool {
        let level = self.level.iter().flat_map(|level| &level.equations);
        let mut trees = claim
            .iter()
            .copied()
            .chain(self.field.iter().map(|(_, rate)| rate))
            .chain(level.flat_map(|(a, b)| [a, b]));
        let is_free = !matches!(self.symbols[place].origin, Origin::Formula(_));
        let has_chart = self.level.as_ref().is_some_and(|level| level.chart.is_some());
        is_free || has_chart || trees.any(|tree| tree.has(place))
    }
}
