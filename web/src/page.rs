//! Findings as the page shows them: formulas in MathML, grounds line by line.

use liouville::formula::Layout;
use liouville_report::evidence::command;
use liouville_report::survey::entry;
use liouville_report::typeset::mathml::formula;
use liouville_search::survey::TestedClaim;
use serde::Serialize;

/// A claim or a find for the page.
#[derive(Debug, Serialize)]
pub struct Shown {
    /// Statement in MathML, if it can be typeset.
    #[serde(skip_serializing_if = "Option::is_none")]
    formula: Option<String>,
    /// Definitions of the names that it uses, in MathML or as typed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    definitions: Vec<Definition>,
    /// Facts about the verdict, in a few words.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    remarks: Vec<String>,
    /// Command that evaluates the case at the witness.
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<String>,
    /// Grounds of the verdict, line by line.
    grounds: Vec<String>,
}

/// A definition of a name.
#[derive(Debug, Serialize)]
struct Definition {
    typed: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    formula: Option<String>,
}

impl Shown {
    /// A finding about the case at a path, with its evidence.
    pub fn of(path: &str, finding: &TestedClaim) -> Self {
        let entry = entry(finding);
        let set = |layout: &Layout, display| formula(layout, display);
        let definitions = entry.definitions.iter().map(|(typed, layout)| Definition {
            typed: typed.clone(),
            formula: layout.as_ref().map(|layout| set(layout, false)),
        });
        Self {
            formula: entry.layout.as_ref().map(|layout| set(layout, true)),
            definitions: definitions.collect(),
            remarks: entry.remarks,
            witness: finding.claim.evidence.witness.as_ref().map(|state| command(path, state)),
            grounds: entry.evidence,
        }
    }
}
