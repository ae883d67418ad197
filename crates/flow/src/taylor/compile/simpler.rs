//! Rows of moduli, signs, and functions that tend to constants.

use super::Compiler;
use crate::error::FlowError;
use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::program::Rule;
use crate::taylor::quotients::{Factor, Simpler, modulus_at};
use crate::taylor::saturating::{Saturating, area, hyperbolic};
use liouville::graph::{Graph, Step};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};

impl Compiler {
    /// Form of |x| = s x, and of 1/|x| = s/x.
    pub(super) fn modulus(
        &mut self,
        graph: &Graph,
        step: Step<'_>,
    ) -> Result<Option<BilinearForm>, FlowError> {
        Ok(match step {
            Step::Unary(UnaryFunction::Abs, a) => {
                let ((factor, x), sign) = (self.factor(a), self.sign(a));
                Some(BilinearForm::of_product(factor, x, sign))
            }
            Step::Unary(UnaryFunction::Recip, a) => match modulus_at(graph, a) {
                Some(argument) => {
                    let ((factor, row), sign) = (self.reciprocal(argument)?, self.sign(argument));
                    Some(BilinearForm::of_product(factor, row, sign))
                }
                None => None,
            },
            _ => None,
        })
    }

    /// Form of ±x + |y| or x − |y| where terms of x ± y cancel, as in max(a, b) = (a + b + |a − b|)/2: it
    /// is (x + y) where y > 0, and (x − y) elsewhere, so that what cancels leaves no rounding.
    pub(super) fn extreme(&mut self, graph: &Graph, step: Step<'_>) -> Option<BilinearForm> {
        let is_modulus = |place: usize| modulus_at(graph, place).is_some();
        let (x, weight, modulus, sign) = match step {
            Step::Binary(BinaryOperation::Add, a, b) if is_modulus(b) => (a, 1, b, 1),
            Step::Binary(BinaryOperation::Add, a, b) => (b, 1, a, 1),
            Step::Binary(BinaryOperation::Sub, a, b) if is_modulus(b) => (a, 1, b, -1),
            Step::Binary(BinaryOperation::Sub, a, b) => (b, -1, a, 1),
            _ => return None,
        };
        let y = modulus_at(graph, modulus)?;
        let (own, other) = (self.forms[x].clone()?, self.forms[y].clone()?);
        let own = own.times(&Rational::from(weight));
        let beside = |sign: i64| own.clone().plus(other.clone().times(&Rational::from(sign)));
        let sides = [beside(sign), beside(-sign)];
        if sides.iter().any(|side| side.len() >= own.len() + other.len()) {
            return None;
        }
        let turn = self.sign(y);
        let half = Rational::new(1, 2);
        let mut found = BilinearForm::of_constant(&Rational::from(0));
        for (side, weight) in sides.into_iter().zip([1, -1]) {
            let is_on = BilinearForm::of_row(&half * &Rational::from(weight), turn);
            let is_on = BilinearForm::of_constant(&half).plus(is_on);
            let is_on = self.emit(Rule::Sum, is_on);
            found = found.plus(match (side.as_constant(), side.as_row()) {
                (Some(constant), _) => BilinearForm::of_row(constant, is_on),
                (_, Some((factor, row))) => BilinearForm::of_product(factor.clone(), row, is_on),
                _ => {
                    let row = self.emit(Rule::Sum, side);
                    Self::product(row, is_on)
                }
            });
        }
        Some(found)
    }

    /// Form of eᵘ − e⁻ᵘ = 2 sinh u, and of the logarithms that are asinh u and 2 atanh u.
    pub(super) fn area_or_sine(&mut self, graph: &Graph, place: usize) -> Option<BilinearForm> {
        if let Some((function, u)) = area(graph, place) {
            let x = self.row(u);
            let weight = if function == Saturating::Atanh { 2 } else { 1 };
            let area = self.saturating(function, x);
            return Some(BilinearForm::of_row(Rational::from(weight), area));
        }
        let Some((true, [u, _])) = hyperbolic(graph, place) else { return None };
        let x = self.row(u);
        let sine = self.saturating(Saturating::Sinh, x);
        Some(BilinearForm::of_row(Rational::from(2), sine))
    }

    /// Whether the base of a root may be 0 over a time and is never negative, as max(x, 0).
    pub(super) fn may_be_void(&self, base: usize) -> bool {
        self.moduli.get(base).is_some_and(|has| *has)
    }

    /// Row of the base of a root with 1 in place of what is not positive, and a row that is 0 there and 1
    /// elsewhere, by which the root is multiplied: so it has a series where the base is 0 for a while.
    pub(super) fn base(&mut self, place: usize) -> (Row, Row) {
        let x = self.row(place);
        if let Some((_, base, on)) = self.voids.iter().find(|(row, ..)| *row == x) {
            return (*base, *on);
        }
        let void = self.emit(Rule::Void(x), BilinearForm::default());
        let on = BilinearForm::of_constant(&Self::one());
        let on = self.emit(Rule::Sum, on.plus(BilinearForm::of_row(Rational::from(-1), void)));
        let base = Self::product(on, x).plus(BilinearForm::of_row(Self::one(), void));
        let base = self.emit(Rule::Sum, base);
        self.voids.push((x, base, on));
        (base, on)
    }

    /// Row of the sign of a step.
    fn sign(&mut self, place: usize) -> Row {
        let x = self.row(place);
        if let Some((_, sign)) = self.signs.iter().find(|(row, _)| *row == x) {
            return *sign;
        }
        let sign = self.emit(Rule::Sign(x), BilinearForm::default());
        self.signs.push((x, sign));
        sign
    }

    /// Form of a product with functions in place of quotients.
    pub(super) fn simpler(&mut self, simpler: &Simpler) -> Result<BilinearForm, FlowError> {
        let mut coefficient = simpler.rest.coefficient.clone();
        let mut rows: Vec<Row> = Vec::new();
        for factor in &simpler.factors {
            rows.push(match factor {
                Factor::Sign(place) => self.sign(*place),
                Factor::Saturating(function, place) => {
                    let x = self.row(*place);
                    self.saturating(*function, x)
                }
                Factor::Rising(place) => {
                    let x = self.row(*place);
                    let x = self.emit(Rule::Sum, BilinearForm::of_row(Rational::from(-1), x));
                    self.saturating(Saturating::Logistic, x)
                }
            });
        }
        for own in &simpler.limits {
            rows.push(match &own.proved {
                Some(proved) if self.is_exact => self.proved_limit(own, proved),
                _ => self.limit(own),
            });
        }
        let mut others: Vec<Row> = Vec::new();
        for (place, power) in &simpler.rest.factors {
            let (factor, row) = match power {
                1.. => self.factor(*place),
                _ => self.reciprocal(*place)?,
            };
            for _ in 0..power.unsigned_abs() {
                coefficient = &coefficient * &factor;
                others.push(row);
            }
        }
        // Small functions and large factors in turn, so that no part of the product is too large or small.
        let count = rows.len().max(others.len());
        let turn = |k: usize| [rows.get(k), others.get(k)].into_iter().flatten();
        let rows = (0..count).flat_map(turn).copied().collect();
        Ok(self.product_of(coefficient, rows))
    }

    /// Form of a product of rows.
    pub(super) fn product_of(&mut self, coefficient: Rational, mut rows: Vec<Row>) -> BilinearForm {
        while rows.len() > 2 {
            let (a, b) = (rows.remove(0), rows.remove(0));
            let both = self.emit(Rule::Sum, Self::product(a, b));
            rows.insert(0, both);
        }
        match rows[..] {
            [a, b] => BilinearForm::of_product(coefficient, a, b),
            [a] => BilinearForm::of_row(coefficient, a),
            _ => BilinearForm::of_constant(&coefficient),
        }
    }

    /// Row of a function that tends to constants.
    fn saturating(&mut self, function: Saturating, x: Row) -> Row {
        let known = self.saturating.iter().find(|(own, row, _)| (*own, *row) == (function, x));
        if let Some((.., row)) = known {
            return *row;
        }
        let theta = self.theta(x);
        let [first, second, third] = [0, 1, 2].map(|k| self.next + k);
        if function == Saturating::Logistic {
            // z' = −v u' and v' = −v(1 − 2z)u': v has digits where z is 1 to rounding
            let rule = |function, slope| Rule::Saturating { function, x, slope };
            self.emit(rule(function, second), Self::product(theta, second));
            self.emit(rule(Saturating::Hump, third), Self::product(theta, third));
            let twice = BilinearForm::of_product(Rational::from(-2), first, second);
            self.emit(Rule::Sum, BilinearForm::of_row(Self::one(), second).plus(twice));
            self.saturating.push((function, x, first));
            return first;
        }
        if function == Saturating::Bell {
            // s' = −y s u'
            let tanh = self.saturating(Saturating::Tanh, x);
            let [first, second] = [0, 1].map(|k| self.next + k);
            self.emit(
                Rule::Saturating { function, x, slope: second },
                Self::product(theta, second),
            );
            self.emit(Rule::Sum, Self::product(tanh, first));
            self.saturating.push((function, x, first));
            return first;
        }
        if matches!(function, Saturating::Asinh | Saturating::Atanh) {
            // z' = u'/√(1 + u²), or u'/(1 − u²)
            let sign = if function == Saturating::Asinh { 1 } else { -1 };
            let square = BilinearForm::of_product(Rational::from(sign), x, x);
            let square = BilinearForm::of_constant(&Self::one()).plus(square);
            let mut below = self.emit(Rule::Sum, square);
            if function == Saturating::Asinh {
                let out = self.next;
                below = self.emit(Rule::Sqrt(below), Self::product(out, out));
            }
            let out = self.next;
            let slope = self.emit(Rule::Recip(below), Self::product(below, out));
            let rule = Rule::Saturating { function, x, slope };
            let row = self.emit(rule, Self::product(theta, slope));
            self.saturating.push((function, x, row));
            return row;
        }
        if matches!(function, Saturating::Sinh | Saturating::Cosh) {
            let (sine, cosine) = (Saturating::Sinh, Saturating::Cosh);
            let rule = |function, slope| Rule::Saturating { function, x, slope };
            self.emit(rule(sine, second), Self::product(theta, second));
            self.emit(rule(cosine, first), Self::product(theta, first));
            self.saturating.extend([(sine, x, first), (cosine, x, second)]);
            return if function == sine { first } else { second };
        }
        // y' = w u' and w' = −2 y w u'
        let (tanh, fall) = (Saturating::Tanh, Saturating::Fall);
        let rule = |function, slope| Rule::Saturating { function, x, slope };
        self.emit(rule(tanh, second), Self::product(theta, second));
        self.emit(rule(fall, third), Self::product(theta, third));
        self.emit(Rule::Sum, Self::product(first, second));
        self.saturating.extend([(tanh, x, first), (fall, x, second)]);
        if function == tanh { first } else { second }
    }
}
