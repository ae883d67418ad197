//! Judgement of claims about motion: numbers, each compared with the one stated.

use crate::MeasuredNumber;
use liouville::claim::motion::Stated;
use liouville::verdict::{Evidence, Measurement, Method, Verdict};

/// Number of standard errors within which means agree.
pub const ERRORS: f64 = 3.0;

/// Judgement of a claim about motion.
#[derive(Default)]
pub struct MotionJudgement {
    measured: Vec<Measurement>,
    /// Reasons against the claim.
    against: Vec<String>,
    /// Reasons to leave the claim open.
    open: Vec<String>,
    /// Further consequence.
    pub remark: Option<String>,
    /// Theorem on which the judgement rests, in place of numbers with estimated errors.
    pub theorem: Option<String>,
}

impl MotionJudgement {
    /// Notes a number.
    pub fn show(&mut self, quantity: &str, found: MeasuredNumber) {
        self.note(quantity, found, None);
    }

    /// Notes a number with the one stated.
    pub fn note(&mut self, quantity: &str, found: MeasuredNumber, stated: Option<&Stated>) {
        self.measured.push(Measurement {
            quantity: quantity.to_string(),
            value: found.value,
            error: found.error,
            stated: stated.map(|stated| stated.text.clone()),
        });
    }

    /// Compares a number with the one stated: they agree within one unit of the last stated digit,
    /// three of its standard errors, and the number's error. A larger error leaves the claim open.
    pub fn compare(&mut self, quantity: &str, found: MeasuredNumber, stated: &Stated) {
        self.note(quantity, found, Some(stated));
        let difference = (found.value - stated.value).abs();
        if difference.is_nan() {
            self.leave_open(format!("the {quantity} is not known"));
        } else if difference > stated.unit + ERRORS * stated.error + found.error {
            self.refute(format!("the {quantity} is not {}", stated.text));
        }
        let digits = stated.unit + ERRORS * stated.error;
        if digits > 0.0 && found.error > digits {
            self.leave_open(format!("the error of the {quantity} is above the stated digits"));
        }
    }

    /// Notes a reason against the claim.
    pub fn refute(&mut self, reason: String) {
        self.against.push(reason);
    }

    /// Notes a reason to leave the claim open.
    pub fn leave_open(&mut self, reason: String) {
        self.open.push(reason);
    }

    /// Whether there is a reason against the claim.
    pub fn is_refuted(&self) -> bool {
        !self.against.is_empty()
    }

    /// Whether the claim is open.
    pub fn is_open(&self) -> bool {
        self.against.is_empty() && !self.open.is_empty()
    }

    /// Leaves the claim open in place of all reasons against it.
    pub fn withdraw(&mut self, reason: String) {
        self.against.clear();
        self.open = vec![reason];
    }

    /// Compares one of several possibilities with the one claimed; `None` where it is not decided.
    pub fn expect<T: PartialEq>(&mut self, seen: Option<T>, claimed: T, what: &str) {
        match seen {
            Some(seen) if seen == claimed => {}
            Some(_) => self.refute(format!("the {what} is another")),
            None => self.leave_open(format!("the {what} is not decided by these numbers")),
        }
    }

    /// Returns the verdict and its grounds.
    pub fn conclude(self) -> (Verdict, Evidence) {
        let verdict = match (self.against.is_empty(), self.open.is_empty()) {
            (false, _) => Verdict::Refuted,
            (true, false) => Verdict::Undecided,
            (true, true) if self.theorem.is_some() => Verdict::Proved,
            (true, true) => Verdict::Confirmed,
        };
        let method = match self.theorem {
            Some(_) => Method::EnclosedOrbit,
            None => Method::Motion,
        };
        let reasons = if verdict == Verdict::Refuted { self.against } else { self.open };
        let reason = (!reasons.is_empty()).then(|| reasons.join("; "));
        let (measured, remark, theorem) = (self.measured, self.remark, self.theorem);
        (verdict, Evidence { method, measured, reason, remark, theorem, ..Evidence::default() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(stated: &str, value: f64, error: f64) -> Verdict {
        let stated = Stated::parse(stated).expect("a number");
        let mut judgement = MotionJudgement::default();
        judgement.compare("number", MeasuredNumber { value, error }, &stated);
        judgement.conclude().0
    }

    #[test]
    fn digits_that_are_typed_are_claimed() {
        assert_eq!(verdict("0.25", 0.2549, 1e-9), Verdict::Confirmed, "to one unit");
        assert_eq!(verdict("0.2500", 0.2549, 1e-9), Verdict::Refuted, "two digits more");
        assert_eq!(verdict("0.25", 0.2549, 0.02), Verdict::Undecided, "the error hides digits");
        assert_eq!(verdict("0.98 ± 0.01", 1.0, 1e-9), Verdict::Confirmed, "two errors");
        assert_eq!(verdict("0.98 ± 0.01", 1.05, 1e-9), Verdict::Refuted, "seven errors");
        assert_eq!(verdict("1", 1.0 + 1e-15, 2e-15), Verdict::Confirmed, "exact, to its error");
        assert_eq!(verdict("1", 1.0 + 1e-12, 2e-15), Verdict::Refuted, "exact, beyond its error");
        assert_eq!(verdict("1", f64::NAN, 1e-9), Verdict::Undecided, "no number at all");
    }
}
