//! Sets of simple equations between scalars: some are 0, and some are equal.

use liouville::formula::Formula;

use super::relation::ScalarParameter;
use super::split::SplitCase;

/// A simple equation between scalars, by their places.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimpleEquation {
    /// x = 0.
    Zero(usize),
    /// x = y.
    Equal(usize, usize),
}

/// A set of simple equations, up to equivalence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SimpleEquations {
    /// For each scalar the first that it equals; `None` if it is 0.
    first: Vec<Option<usize>>,
}

impl SimpleEquations {
    /// The empty set, for some number of scalars.
    pub fn none(scalars: usize) -> Self {
        Self { first: (0..scalars).map(Some).collect() }
    }

    /// Adds an equation.
    pub fn with(&self, equation: SimpleEquation) -> Self {
        let (one, other) = match equation {
            SimpleEquation::Zero(x) => (self.first[x], None),
            SimpleEquation::Equal(x, y) => (self.first[x], self.first[y]),
        };
        // `None` is before all others.
        let (kept, merged) = (one.min(other), one.max(other));
        let own = |first: &Option<usize>| if *first == merged { kept } else { *first };
        Self { first: self.first.iter().map(own).collect() }
    }

    /// For each scalar the first that it equals; `None` if it is 0.
    pub fn first(&self) -> &[Option<usize>] {
        &self.first
    }

    /// Places of the scalars that remain free.
    pub fn free(&self) -> Vec<usize> {
        (0..self.first.len()).filter(|place| self.first[*place] == Some(*place)).collect()
    }

    /// Lists independent equations.
    pub fn equations(&self) -> Vec<SimpleEquation> {
        let own = |(place, first): (usize, &Option<usize>)| match first {
            None => Some(SimpleEquation::Zero(place)),
            Some(first) if *first != place => Some(SimpleEquation::Equal(*first, place)),
            Some(_) => None,
        };
        self.first.iter().enumerate().filter_map(own).collect()
    }

    /// Number of independent equations.
    pub fn count(&self) -> usize {
        self.first.len() - self.free().len()
    }

    /// Whether all equations of another set follow.
    pub fn implies(&self, other: &Self) -> bool {
        let holds = |(place, first): (usize, &Option<usize>)| match first {
            None => self.first[place].is_none(),
            Some(first) => self.first[place] == self.first[*first],
        };
        other.first.iter().enumerate().all(holds)
    }

    /// The one equation by which this set follows from another; `None` if it follows anyway, or from no
    /// single one.
    pub fn addition(&self, other: &Self) -> Option<SimpleEquation> {
        if other.implies(self) {
            return None;
        }
        let equations = self.first.iter().enumerate().map(|(place, first)| match first {
            None => SimpleEquation::Zero(place),
            Some(first) => SimpleEquation::Equal(*first, place),
        });
        let missing = equations.into_iter().find(|own| other.with(*own) != *other)?;
        let own = match missing {
            SimpleEquation::Zero(x) => SimpleEquation::Zero(other.first[x]?),
            SimpleEquation::Equal(x, y) => match (other.first[x], other.first[y]) {
                (Some(x), Some(y)) => SimpleEquation::Equal(x, y),
                (Some(x), None) | (None, Some(x)) => SimpleEquation::Zero(x),
                (None, None) => return None,
            },
        };
        other.with(own).implies(self).then_some(own)
    }

    /// Writes the equations: `z = 0`, `J1 = J2 = J3`.
    pub fn texts(&self, scalars: &[ScalarParameter]) -> Vec<String> {
        let name = |place: usize| scalars[place].name.as_str();
        let own = |first: Option<usize>| {
            (0..self.first.len()).filter(move |place| self.first[*place] == first)
        };
        let zeros = own(None).map(|place| format!("{} = 0", name(place)));
        let classes = self.free().into_iter().filter_map(|first| {
            let names: Vec<&str> = own(Some(first)).map(name).collect();
            (names.len() > 1).then(|| names.join(" = "))
        });
        zeros.chain(classes).collect()
    }

    /// The case where the equations hold; `None` if it cannot be written.
    pub fn applied(&self, whole: &SplitCase) -> Option<SplitCase> {
        let letters = whole.letters().ok()?;
        let bound = self.first.iter().enumerate().filter(|(place, first)| **first != Some(*place));
        let value = |first: &Option<usize>| match first {
            Some(first) => letters[*first].clone(),
            None => Formula::number(0),
        };
        let split = whole.with(bound.map(|(place, first)| (place, value(first))).collect())?;
        (!split.scalars.is_empty()).then_some(split)
    }
}

/// Lists the simple equations of a case: zero scalars, and equal components of a tensor or scalars of
/// the case.
pub fn simple_equations(whole: &SplitCase) -> Vec<SimpleEquation> {
    let count = whole.scalars.len();
    let zeros = (0..count).map(SimpleEquation::Zero);
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let alike = pairs.filter(|(i, j)| whole.tensors[*i] == whole.tensors[*j]);
    zeros.chain(alike.map(|(i, j)| SimpleEquation::Equal(i, j))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equations_imply_each_other_by_their_classes() {
        use SimpleEquation::{Equal, Zero};
        let none = SimpleEquations::none(4);
        let by = |own: &[SimpleEquation]| own.iter().fold(none.clone(), |all, own| all.with(*own));
        assert_eq!(by(&[Equal(0, 1), Equal(1, 2)]), by(&[Equal(0, 2), Equal(1, 2)]));
        assert_eq!(by(&[Equal(0, 1), Zero(1)]), by(&[Zero(0), Zero(1)]));
        assert!(by(&[Equal(0, 1), Zero(3)]).implies(&by(&[Zero(3)])));
        assert!(by(&[Zero(0), Zero(1)]).implies(&by(&[Equal(0, 1)])));
        assert!(!by(&[Equal(0, 1)]).implies(&by(&[Zero(0)])));
        assert_eq!(by(&[Equal(0, 1), Equal(1, 2)]).count(), 2);
        assert_eq!(by(&[Equal(0, 2), Zero(3)]).free(), [0, 1]);
        let (two, one) = (by(&[Equal(0, 1), Equal(1, 2)]), by(&[Equal(0, 2), Zero(3)]));
        assert_eq!(two.addition(&one), Some(Equal(0, 1)), "0 = 1 gives all three");
        assert_eq!(one.addition(&one), None);
        assert_eq!(two.addition(&none), None, "no single equation does");
        let names: Vec<ScalarParameter> = (0..4)
            .map(|draw| ScalarParameter { name: ["a", "b", "c", "d"][draw].to_string(), draw })
            .collect();
        assert_eq!(by(&[Equal(0, 2), Zero(3)]).texts(&names), ["d = 0", "a = c"]);
    }
}
