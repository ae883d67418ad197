//! The interface of a language: names, numbers, operations, and the frame of a file.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;

/// Binding strength of a term, from the weakest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Rank {
    /// A sum, a difference, or a negative value.
    Sum,
    /// A product or a quotient.
    Product,
    /// A power.
    Power,
    /// A name, a number, a call, or anything in brackets.
    Atom,
}

/// An expression as text.
#[derive(Clone, Debug)]
pub struct TargetTerm {
    /// Text of the expression.
    pub text: String,
    /// Binding strength of its outermost operation.
    pub rank: Rank,
    /// Number of names and numbers in it.
    pub weight: usize,
}

impl TargetTerm {
    /// Makes a term of one name, number or call.
    pub fn atom(text: impl Into<String>) -> Self {
        Self { text: text.into(), rank: Rank::Atom, weight: 1 }
    }

    /// Makes a term with the given binding strength.
    pub fn of(text: String, rank: Rank) -> Self {
        Self { text, rank, weight: 1 }
    }

    /// Text as an operand that has to bind at least as strongly as `rank`.
    pub fn at_least(&self, rank: Rank) -> String {
        match self.rank >= rank {
            true => self.text.clone(),
            false => format!("({})", self.text),
        }
    }
}

/// A language to which a program is written.
///
/// The defaults are those of most languages: infix operations, `f(x)`, quotients as `a/b`, powers as
/// `a^b`.
pub trait Target {
    /// Whether numbers are exact rationals, not doubles.
    fn is_exact(&self) -> bool;

    /// Words that cannot be names.
    fn reserved(&self) -> &'static [&'static str];

    /// Largest number of names and numbers in one expression.
    fn width(&self) -> usize {
        24
    }

    /// Spelling of a name of the case.
    fn name(&self, name: &str) -> String;

    /// Spelling of the name of a function: a word, and the words of a claim's name.
    fn function_name(&self, words: &[&str]) -> String {
        words.join("_")
    }

    /// Spelling of a name that is taken already, or reserved, for the nth time.
    fn another(&self, name: &str, count: usize) -> String {
        format!("{name}_{count}")
    }

    /// Name of an intermediate value.
    fn temporary(&self, count: usize) -> String {
        format!("t{count}")
    }

    /// Number.
    fn number(&self, value: &Rational) -> TargetTerm;

    /// f(x), for functions other than the sign and the reciprocal.
    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm;

    /// tanh x; `None` where it is written as a quotient of exponential functions.
    fn tangent(&self, _: &TargetTerm) -> Option<TargetTerm> {
        None
    }

    /// x^q for a constant q.
    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm;

    /// x^y.
    fn power_of(&self, base: &TargetTerm, exponent: &TargetTerm) -> TargetTerm {
        let text = format!("{}^{}", base.at_least(Rank::Atom), exponent.at_least(Rank::Atom));
        TargetTerm::of(text, Rank::Power)
    }

    /// −x
    fn negative(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("-{}", a.at_least(Rank::Product)), Rank::Sum)
    }

    /// 1/x
    fn reciprocal(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("{}/{}", self.one(), a.at_least(Rank::Power)), Rank::Product)
    }

    /// a/b; `None` if quotients are written as products with reciprocals.
    fn quotient(&self, a: &TargetTerm, b: &TargetTerm) -> Option<TargetTerm> {
        let text = format!("{}/{}", a.at_least(Rank::Product), b.at_least(Rank::Power));
        Some(TargetTerm::of(text, Rank::Product))
    }

    /// a + b, a − b
    fn sum(&self, a: &TargetTerm, sign: &str, b: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("{} {sign} {}", a.text, b.at_least(Rank::Product)), Rank::Sum)
    }

    /// a b
    fn product(&self, a: &TargetTerm, b: &TargetTerm) -> TargetTerm {
        let text = format!("{}*{}", a.at_least(Rank::Product), b.at_least(Rank::Power));
        TargetTerm::of(text, Rank::Product)
    }

    /// The number 1.
    fn one(&self) -> String {
        self.number(&Rational::from(1)).text
    }

    /// Whole file.
    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String;
}

/// A number in doubles: integers and short decimals as they are, others as a quotient of integers
/// where both are doubles, or rounded. `point` is written after integers.
pub fn double(value: &Rational, point: &str) -> TargetTerm {
    let (nearest, _) = value.to_f64();
    let rank = |own: Rank| if value.is_negative() { Rank::Sum } else { own };
    const EXACT: i64 = 1 << 53;
    let is_exact = |n: i64| (-EXACT..=EXACT).contains(&n);
    match value.small_parts() {
        Some((above, 1)) if is_exact(above) => {
            TargetTerm::of(format!("{above}{point}"), rank(Rank::Atom))
        }
        Some((above, below)) if is_exact(above) && is_exact(below) => {
            let decimal = format!("{nearest:?}");
            let is_decimal = decimal.len() < 9 && decimal.parse() == Ok(value.clone());
            match is_decimal {
                true => TargetTerm::of(decimal, rank(Rank::Atom)),
                false => {
                    TargetTerm::of(format!("{above}{point}/{below}{point}"), rank(Rank::Product))
                }
            }
        }
        _ => TargetTerm::of(format!("{nearest:?}"), rank(Rank::Atom)),
    }
}

/// Whether a power has a value for negative numbers too, and an exponent that is a double.
pub fn is_plain(exponent: &Rational) -> bool {
    exponent.to_integer().is_some_and(|n| n.unsigned_abs() <= 1 << 53)
}

/// An exact number: an integer or a quotient of integers.
pub fn exact(value: &Rational) -> TargetTerm {
    let rank = |own: Rank| if value.is_negative() { Rank::Sum } else { own };
    let (above, below) = value.parts();
    match below == 1.into() {
        true => TargetTerm::of(above.to_string(), rank(Rank::Atom)),
        false => TargetTerm::of(format!("{above}/{below}"), rank(Rank::Product)),
    }
}

/// A power with an exact exponent, as x^q.
pub fn raised(base: &TargetTerm, exponent: &Rational) -> TargetTerm {
    let exponent = exact(exponent).at_least(Rank::Atom);
    TargetTerm::of(format!("{}^{exponent}", base.at_least(Rank::Atom)), Rank::Power)
}

/// Name of a function as most languages have it.
pub fn usual(function: UnaryFunction) -> &'static str {
    match function {
        UnaryFunction::Sqrt => "sqrt",
        UnaryFunction::Abs => "abs",
        UnaryFunction::Exp => "exp",
        UnaryFunction::Ln => "log",
        UnaryFunction::Sin => "sin",
        UnaryFunction::Cos => "cos",
        UnaryFunction::Atan => "atan",
        UnaryFunction::Neg => "-",
        UnaryFunction::Recip => "1/",
    }
}

/// Lines as comments.
pub fn comments(lines: &[String], before: &str, after: &str) -> String {
    lines.iter().map(|line| format!("{before}{line}{after}\n")).collect()
}
