//! Answers of the verifier on a case, in this process.

use std::panic::{AssertUnwindSafe, catch_unwind};

use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};
use num_bigint::BigInt;

use super::real::{Real, whole};

/// The answer on a claim.
#[derive(Clone, Debug)]
pub enum Told {
    Report(Box<ClaimReport>),
    /// An unreadable file.
    Unreadable(String),
    /// A case that cannot be judged.
    Unjudged(String),
    Panicked(String),
}

impl Told {
    /// Returns the verdict, if there is one.
    pub fn verdict(&self) -> Option<Verdict> {
        match self {
            Told::Report(report) => Some(report.verdict),
            _ => None,
        }
    }

    /// Returns the answer in one word.
    pub fn word(&self) -> &'static str {
        match self {
            Told::Report(report) => report.verdict.word(),
            Told::Unreadable(_) => "unreadable",
            Told::Unjudged(_) => "error",
            Told::Panicked(_) => "panic",
        }
    }

    /// Writes the answer with its grounds.
    pub fn grounds(&self) -> String {
        match self {
            Told::Unreadable(error) | Told::Unjudged(error) | Told::Panicked(error) => {
                format!("{}: {error}", self.word())
            }
            Told::Report(report) => {
                let evidence = &report.evidence;
                let mut told = format!("{} by {}", report.verdict.word(), evidence.method);
                if let Some(witness) = &evidence.witness {
                    told.push_str(&format!(
                        " at {} {:?}, residual {:e}",
                        witness.state, witness.parameters, witness.residual
                    ));
                }
                for line in evidence.reason.iter().chain(&evidence.silence) {
                    told.push_str(&format!("; {line}"));
                }
                told
            }
        }
    }
}

/// Judges a case with `count` claims and returns the answers.
pub fn told(text: &str, seed: u64, count: usize) -> Vec<Told> {
    let all = |told: Told| vec![told; count];
    let judged = catch_unwind(AssertUnwindSafe(|| {
        let case = match Case::parse(text, &[]) {
            Ok(case) => case,
            Err(error) => return all(Told::Unreadable(error.to_string())),
        };
        match judge(&case, &Options { seed, ..Options::default() }) {
            Ok(report) => {
                report.claims.into_iter().map(|claim| Told::Report(Box::new(claim))).collect()
            }
            Err(error) => all(Told::Unjudged(error.to_string())),
        }
    }));
    judged.unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().cloned();
        let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string()));
        all(Told::Panicked(text.unwrap_or_default()))
    })
}

/// Reads a number such as `-0.39`, `3/7`, `1.5e-7`.
pub fn read(text: &str) -> Option<Real> {
    let (above, below) = text.split_once('/').unwrap_or((text, "1"));
    super::real::quotient(&decimal(above)?, &decimal(below)?).ok()
}

fn decimal(text: &str) -> Option<Real> {
    let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
    let (before, after) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: BigInt = format!("{before}{after}").parse().ok()?;
    let exponent = exponent.parse::<i32>().ok()? - i32::try_from(after.len()).ok()?;
    let mut value = whole(0);
    for letter in digits.magnitude().to_string().bytes() {
        value = value * whole(10) + whole(i64::from(letter - b'0'));
    }
    if digits.sign() == num_bigint::Sign::Minus {
        value = -value;
    }
    let tens = super::real::to_the(&whole(10), i64::from(exponent.abs())).ok()?;
    Some(if exponent < 0 { value / tens } else { value * tens })
}
