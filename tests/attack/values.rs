//! Values of the symbols of a system at points, in full precision.

use super::expr::Number;
use super::jet::Place;
use super::point::Point;
use super::real::{Found, Lack, Real, exactly, number, sign, sure_sign};
use super::scene::{Origin, Scene};

/// Values that are the same at points that differ in one coordinate.
pub struct Known {
    /// Values of what is drawn, or of all.
    values: Found<Vec<Found<Real>>>,
    /// Whether no other value depends on the coordinate.
    is_fixed: bool,
    /// Range of the coordinate, and those of dependent variables.
    own: Option<Range>,
    ends: Vec<Option<Range>>,
}

/// A range with its width.
struct Range {
    low: Real,
    high: Real,
    width: Real,
}

impl Range {
    fn new(low: &Number, high: &Number) -> Self {
        let (low, high) = (number(*low), number(*high));
        let width = &high - &low;
        Self { low, high, width }
    }

    /// Computes the value of a symbol from its position in its range.
    fn at(&self, point: &Point, place: usize) -> Real {
        let share = exactly(point.cube[place]);
        match point.fine[place] {
            0.0 => &self.low + &self.width * share,
            fine => &self.low + &self.width * (share + exactly(fine)),
        }
    }
}

impl Scene {
    /// Computes the values of all symbols at a point; `None` if it is not a state.
    pub fn values(&self, point: &Point) -> Option<Vec<Found<Real>>> {
        self.on_branch(self.drawn(point), point, &self.ranges(point)).ok()
    }

    /// Computes what is known about the values at points that differ from one in one coordinate.
    pub fn known(&self, point: &Point, place: usize) -> Known {
        let mut trees = self.branch(point).iter().map(|(_, tree)| tree).chain(self.formulas());
        let is_fixed = !trees.any(|tree| tree.has(place));
        let ends = self.ranges(point);
        let mut values = Ok(self.drawn(point));
        if is_fixed {
            values = values.and_then(|values| self.on_branch(values, point, &ends));
        }
        Known { values, is_fixed, own: self.range(place), ends }
    }

    /// Computes the values at a point that differs in one coordinate from that of which something is
    /// known; `Lack::Value` if it certainly is not a state.
    pub fn values_beside(
        &self,
        known: &Known,
        point: &Point,
        place: usize,
    ) -> Found<Vec<Found<Real>>> {
        let mut values = known.values.clone()?;
        if let Some(range) = &known.own {
            values[place] = Ok(range.at(point, place));
        }
        if known.is_fixed {
            return Ok(values);
        }
        for (place, symbol) in self.symbols.iter().enumerate() {
            if let Origin::Formula(tree) = &symbol.origin {
                values[place] = Place { values: &values, along: &[] }.value(tree);
            }
        }
        self.on_branch(values, point, &known.ends)
    }

    /// Returns the ranges of the dependent variables on a point's branch.
    fn ranges(&self, point: &Point) -> Vec<Option<Range>> {
        self.branch(point).iter().map(|(place, _)| self.range(*place)).collect()
    }

    /// Returns the range of a symbol, if it has one.
    fn range(&self, place: usize) -> Option<Range> {
        match &self.symbols[place].origin {
            Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b) => {
                Some(Range::new(a, b))
            }
            _ => None,
        }
    }

    /// Computes the values of all symbols at a point off the level.
    fn drawn(&self, point: &Point) -> Vec<Found<Real>> {
        let mut values: Vec<Found<Real>> = Vec::with_capacity(self.symbols.len());
        for place in 0..self.symbols.len() {
            let value = self.value(place, point, &values);
            values.push(value);
        }
        values
    }

    /// Computes the value of a symbol from those before it.
    fn value(&self, place: usize, point: &Point, values: &[Found<Real>]) -> Found<Real> {
        match &self.symbols[place].origin {
            Origin::State(a, b) | Origin::Range(a, b) | Origin::Input(a, b) => {
                Ok(Range::new(a, b).at(point, place))
            }
            Origin::Fixed(n) => Ok(number(*n)),
            Origin::List(list) => Ok(number(list[point.picks[place]])),
            Origin::Formula(tree) => Place { values, along: &[] }.value(tree),
        }
    }

    /// Puts the values of dependent variables in their places; `Lack::Value` if the point certainly
    /// is not a state. The ends of ranges belong to them.
    fn on_branch(
        &self,
        mut values: Vec<Found<Real>>,
        point: &Point,
        ends: &[Option<Range>],
    ) -> Found<Vec<Found<Real>>> {
        if self.level.as_ref().is_some_and(|level| point.branch >= level.branches.len()) {
            return Err(Lack::Value);
        }
        for ((place, tree), range) in self.branch(point).iter().zip(ends) {
            let value = Place { values: &values, along: &[] }.value(tree)?;
            for gap in range.iter().flat_map(|own| [&value - &own.low, &own.high - &value]) {
                if sign(&gap) < 0 {
                    return Err(sure_sign(&gap).map_or(Lack::Digits, |_| Lack::Value));
                }
            }
            values[*place] = Ok(value);
        }
        Ok(values)
    }
}
