//! Answers, and their comparison with the correct ones.

use liouville::verdict::{ClaimReport, Verdict};

/// The answer on a claim.
#[derive(Clone, Debug)]
pub enum Answer {
    /// A refused file, or a case that could not be judged.
    Error(String),
    /// A verdict.
    Verdict(Box<ClaimReport>),
}

impl Answer {
    /// Whether the answer is one of these, such as "refuted or undecided", "not proved", "any".
    pub fn is(&self, right: &str) -> bool {
        match right.strip_prefix("not ") {
            Some(wrong) => !self.is(wrong),
            None => right.split(" or ").any(|word| self.is_one(word.trim())),
        }
    }

    fn is_one(&self, word: &str) -> bool {
        let verdict = match self {
            Answer::Error(_) => None,
            Answer::Verdict(report) => Some(report.verdict),
        };
        match word {
            "any" => true,
            "error" => verdict.is_none(),
            "proved" => verdict == Some(Verdict::Proved),
            "confirmed" => verdict == Some(Verdict::Confirmed),
            "refuted" => verdict == Some(Verdict::Refuted),
            "undecided" => verdict == Some(Verdict::Undecided),
            // True as stated, with a remark on its limited meaning.
            "remarked" => match self {
                Answer::Error(_) => false,
                Answer::Verdict(report) => {
                    report.evidence.remark.is_some() || report.evidence.reason.is_some()
                }
            },
            other => panic!("`{other}` is no answer"),
        }
    }

    /// Writes the answer with its grounds.
    pub fn told(&self) -> String {
        match self {
            Answer::Error(error) => format!("error: {error}"),
            Answer::Verdict(report) => {
                let evidence = &report.evidence;
                let mut told = format!("{} by {}", report.verdict.word(), evidence.method);
                if let Some(witness) = &evidence.witness {
                    told.push_str(&format!(
                        "\n  at {} {:?}, off by {:e}",
                        witness.state, witness.parameters, witness.residual
                    ));
                }
                for line in evidence.reason.iter().chain(&evidence.silence) {
                    told.push_str(&format!("\n  {line}"));
                }
                told
            }
        }
    }
}
