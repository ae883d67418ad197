//! The suite that every domain passes: field laws, agreement with exact rationals, undefined results
//! where there are none.

use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, UnaryFunction};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::common::{exact, rational};
use crate::domains::tested::{Tested, unit};

/// Numbers at the edges: exact and inexact, large and small, next to each other.
const VALUES: [&str; 22] = [
    "1",
    "-1",
    "2",
    "1/3",
    "-2/7",
    "0.1",
    "1e16",
    "-1e-16",
    "9007199254740993",
    "1e150",
    "-1e-150",
    "0.70710678118654752440084436210485",
    "1.0000000000000002220446049250313",
    "123456789/1000",
    "-0.99999999999999988897769753748434",
    "5e-324",
    "1e-310",
    "1e300",
    "3",
    "-355/113",
    "1267650600228229401496703205377",
    "1/1267650600228229401496703205376",
];

/// The checks of one domain.
pub struct Suite<D: Tested> {
    pub domain: D,
    pub name: &'static str,
}

impl<D: Tested> Suite<D> {
    pub fn of(&self, value: &BigRational) -> D::Block {
        self.domain.constant(&rational(value))
    }

    pub fn unary(&self, f: UnaryFunction, x: &D::Block) -> D::Block {
        let mut out = x.clone();
        self.domain.unary(f, x, &mut out);
        out
    }

    pub fn binary(&self, f: BinaryOperation, x: &D::Block, y: &D::Block) -> D::Block {
        let mut out = x.clone();
        self.domain.binary(f, x, y, &mut out);
        out
    }

    pub fn power(&self, x: &D::Block, exponent: (i64, i64)) -> D::Block {
        let mut out = x.clone();
        self.domain.power(x, &Rational::new(exponent.0, exponent.1), &mut out);
        out
    }

    /// Checks that a result in range agrees with the exact one.
    fn check(&self, block: &D::Block, value: &BigRational, what: &str) {
        self.check_scaled(block, value, &value.abs(), what);
    }

    fn check_scaled(&self, block: &D::Block, value: &BigRational, scale: &BigRational, what: &str) {
        let range = unit(-1000)..unit(1000);
        if D::ROUNDS && !value.is_zero() && !range.contains(&value.abs()) {
            // Out of the range of f64: undefined, or still an enclosure.
            assert!(
                !D::ENCLOSES
                    || !self.domain.is_defined(block)
                    || self.domain.stands_for(block, value, scale),
                "{}: {what} out of range",
                self.name
            );
            return;
        }
        assert!(self.domain.is_defined(block), "{}: {what} has a value", self.name);
        assert!(
            self.domain.stands_for(block, value, scale),
            "{}: {what} is another number",
            self.name
        );
    }

    pub fn run(&self) {
        let mut values: Vec<BigRational> = VALUES.iter().map(|text| exact(text)).collect();
        // Subnormal numbers have no bound on the relative error.
        values.retain(|value| D::ENCLOSES || value.abs() > unit(-1000));
        for a in &values {
            self.one(a);
            for b in &values {
                self.two(a, b);
                for c in values.iter().step_by(5) {
                    self.three(a, b, c);
                }
            }
        }
        self.undefined();
    }

    fn one(&self, a: &BigRational) {
        let x = self.of(a);
        self.check(&x, a, "a constant");
        self.check(&self.unary(UnaryFunction::Neg, &x), &-a, "-x");
        self.check(&self.unary(UnaryFunction::Recip, &x), &a.recip(), "1/x");
        if D::MODULI {
            self.check(&self.unary(UnaryFunction::Abs, &x), &a.abs(), "|x|");
        }
        let square = self.binary(BinaryOperation::Mul, &x, &x);
        self.check(&square, &(a * a), "x x");
        let tiny = !D::ROUNDS || (unit(-480)..unit(480)).contains(&a.abs());
        if tiny {
            self.check(&self.unary(UnaryFunction::Sqrt, &square), &a.abs(), "√(x x)");
        }
        for n in [-3i64, -1, 1, 2, 5] {
            let power = a.pow(n as i32);
            if !D::ROUNDS || (unit(-300)..unit(300)).contains(&a.abs()) && a.is_positive() {
                self.check(&self.power(&x, (n, 1)), &power, "x^n");
            }
        }
        let zero = self.binary(BinaryOperation::Sub, &x, &x);
        self.check(&zero, &BigRational::zero(), "x - x");
    }

    fn two(&self, a: &BigRational, b: &BigRational) {
        let (x, y) = (self.of(a), self.of(b));
        let size = a.abs() + b.abs();
        self.check_scaled(&self.binary(BinaryOperation::Add, &x, &y), &(a + b), &size, "x + y");
        self.check_scaled(&self.binary(BinaryOperation::Sub, &x, &y), &(a - b), &size, "x - y");
        self.check(&self.binary(BinaryOperation::Mul, &x, &y), &(a * b), "x y");
        for operation in [BinaryOperation::Add, BinaryOperation::Mul] {
            let (xy, yx) = (self.binary(operation, &x, &y), self.binary(operation, &y, &x));
            self.equal(&xy, &yx, &BigRational::zero(), "commutes");
        }
        if !D::ENCLOSES && !(unit(-1000)..unit(1000)).contains(&(a / b).abs()) {
            return;
        }
        let quotient = self.binary(BinaryOperation::Mul, &x, &self.unary(UnaryFunction::Recip, &y));
        let back = self.binary(BinaryOperation::Mul, &quotient, &y);
        self.equal(&back, &x, &a.abs(), "(x/y) y = x");
    }

    fn three(&self, a: &BigRational, b: &BigRational, c: &BigRational) {
        let (x, y, z) = (self.of(a), self.of(b), self.of(c));
        let op = |f, x: &D::Block, y: &D::Block| self.binary(f, x, y);
        let (add, mul) = (BinaryOperation::Add, BinaryOperation::Mul);
        let sum = a.abs() + b.abs() + c.abs();
        self.equal(
            &op(add, &op(add, &x, &y), &z),
            &op(add, &x, &op(add, &y, &z)),
            &sum,
            "x + y + z",
        );
        let product = (a * b * c).abs();
        self.equal(
            &op(mul, &op(mul, &x, &y), &z),
            &op(mul, &x, &op(mul, &y, &z)),
            &product,
            "x y z",
        );
        let left = op(mul, &x, &op(add, &y, &z));
        let right = op(add, &op(mul, &x, &y), &op(mul, &x, &z));
        self.equal(&left, &right, &(a.abs() * (b.abs() + c.abs())), "x (y + z)");
    }

    fn equal(&self, a: &D::Block, b: &D::Block, scale: &BigRational, what: &str) {
        // Values that left the range of f64 on either side obey no law.
        if self.domain.is_defined(a) && self.domain.is_defined(b) {
            let out_of_range = D::ROUNDS && !(unit(-900)..unit(900)).contains(scale);
            let same = self.domain.may_equal(a, b, scale);
            assert!(same || (out_of_range && !scale.is_zero()), "{}: {what}", self.name);
        } else {
            assert!(D::ROUNDS, "{}: {what} is defined", self.name);
        }
    }

    fn undefined(&self) {
        let number = |text: &str| self.of(&exact(text));
        let (zero, minus) = (number("0"), number("-2"));
        let none = |block: &D::Block, what: &str| {
            assert!(!self.domain.is_defined(block), "{}: {what} has no value", self.name);
        };
        none(&self.unary(UnaryFunction::Recip, &zero), "1/0");
        none(&self.unary(UnaryFunction::Ln, &zero), "ln 0");
        none(&self.power(&zero, (-1, 1)), "0^-1");
        if D::ORDERED {
            none(&self.power(&minus, (1, 3)), "(-2)^(1/3)");
            none(&self.unary(UnaryFunction::Sqrt, &minus), "√-2");
            none(&self.unary(UnaryFunction::Ln, &minus), "ln -2");
            self.check(&self.unary(UnaryFunction::Sqrt, &zero), &BigRational::zero(), "√0");
        }
        let gone = self.unary(UnaryFunction::Recip, &zero);
        none(&self.binary(BinaryOperation::Mul, &gone, &zero), "(1/0) 0");
        none(&self.binary(BinaryOperation::Sub, &gone, &gone), "1/0 - 1/0");
        none(&self.unary(UnaryFunction::Abs, &gone), "|1/0|");
    }
}
