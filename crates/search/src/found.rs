//! Invariants that a search finds, as values: text is made where they are printed.

use std::fmt;

use serde::{Serialize, Serializer};

use super::library;
use liouville::formula::Formula;
use liouville::mechanics::{Meaning, Model};
use liouville::verdict::{ClaimReport, Evidence, Verdict};

/// Kind of an invariant that a search finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundKind {
    /// Integral.
    Integral,
    /// Integral that is near almost every state a function of others, though no polynomial in them of its
    /// degree.
    FurtherIntegral,
    /// Vector whose components are integrals.
    VectorIntegral,
    /// Density of an invariant measure.
    Density,
    /// Field that commutes with the system's, up to a multiple of that.
    SymmetryField,
    /// Poisson bracket for which the system is Hamiltonian.
    Bracket,
    /// Polynomial that divides its rate.
    DarbouxPolynomial,
    /// Function whose rate is constant along every motion.
    ConstantRate,
}

impl FoundKind {
    /// Name in JSON and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Integral => "integral",
            Self::FurtherIntegral => "further-integral",
            Self::VectorIntegral => "vector-integral",
            Self::Density => "density",
            Self::SymmetryField => "symmetry-field",
            Self::Bracket => "bracket",
            Self::DarbouxPolynomial => "darboux-polynomial",
            Self::ConstantRate => "function-of-constant-rate",
        }
    }
}

impl fmt::Display for FoundKind {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.pad(self.name())
    }
}

impl Serialize for FoundKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Data that belongs to a find: what it holds with, or where it comes from.
#[derive(Clone, Debug)]
pub enum Given {
    /// Rate of a function of constant rate.
    Rate(Formula),
    /// Cofactor of a Darboux polynomial.
    Cofactor(Formula),
    /// Component of a vector that was found itself.
    Component(Formula),
    /// Hamiltonian of a bracket.
    Hamiltonian(Formula),
    /// Factor N of v = N P ∂H.
    Multiplier(Formula),
    /// Casimir function of a bracket.
    Casimir(Formula),
    /// Potential that the case does not have.
    Potential(String),
    /// Force that the case does not have.
    Force(String),
    /// Gyrostat that the case does not have.
    Gyrostat(String),
    /// Gyroscopic term that the case does not have.
    GyroscopicTerm(String),
    /// Values of parameters.
    Value(String),
    /// Condition on several parameters.
    Condition(String),
    /// Integrals of which a further integral is the bracket.
    Bracket(String),
    /// Field along which a further integral is the derivative of another.
    DerivativeAlong(String),
}

impl Given {
    /// Name in JSON and in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Rate(_) => "rate",
            Self::Cofactor(_) => "cofactor",
            Self::Component(_) => "component",
            Self::Hamiltonian(_) => "Hamiltonian",
            Self::Multiplier(_) => "multiplier",
            Self::Casimir(_) => "Casimir",
            Self::Potential(_) => "potential",
            Self::Force(_) => "force",
            Self::Gyrostat(_) => "gyrostat",
            Self::GyroscopicTerm(_) => "gyroscopic term",
            Self::Value(_) => "value",
            Self::Condition(_) => "condition",
            Self::Bracket(_) => "bracket",
            Self::DerivativeAlong(_) => "derivative along",
        }
    }

    /// Text of the formula or condition.
    pub fn text(&self) -> &str {
        match self {
            Self::Rate(own)
            | Self::Cofactor(own)
            | Self::Component(own)
            | Self::Hamiltonian(own)
            | Self::Multiplier(own)
            | Self::Casimir(own) => own.text().trim(),
            Self::Potential(text)
            | Self::Force(text)
            | Self::Gyrostat(text)
            | Self::GyroscopicTerm(text)
            | Self::Value(text)
            | Self::Condition(text)
            | Self::Bracket(text)
            | Self::DerivativeAlong(text) => text,
        }
    }
}

impl Given {
    /// The same with another formula, where it is one; `None` where there is none.
    pub(crate) fn mapped(&self, map: impl Fn(&Formula) -> Option<Formula>) -> Option<Self> {
        Some(match self {
            Self::Rate(own) => Self::Rate(map(own)?),
            Self::Cofactor(own) => Self::Cofactor(map(own)?),
            Self::Component(own) => Self::Component(map(own)?),
            Self::Hamiltonian(own) => Self::Hamiltonian(map(own)?),
            Self::Multiplier(own) => Self::Multiplier(map(own)?),
            Self::Casimir(own) => Self::Casimir(map(own)?),
            text => text.clone(),
        })
    }
}

impl PartialEq for Given {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name() && self.text() == other.text()
    }
}

impl Serialize for Given {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.name(), self.text()).serialize(serializer)
    }
}

/// Formula of a find.
#[derive(Clone, Debug)]
pub enum FoundFormula {
    /// One function of the case.
    Function(Formula),
    /// Text of several functions, as those of a field or a bracket, or of one with names that the case
    /// does not have.
    Text(String),
}

/// An invariant that was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// Kind of the invariant.
    pub kind: FoundKind,
    /// Formula in the names of the case.
    pub formula: FoundFormula,
    /// Abbreviations used in the formula that the case does not define, in order.
    pub abbreviations: Vec<(&'static str, &'static str)>,
    /// Additional data under which it holds, or from which it comes.
    pub with: Vec<Given>,
    /// Names of the claims of the case that imply it.
    pub known: Option<String>,
    /// Verdict on the claim.
    pub verdict: Verdict,
    /// Evidence for the verdict.
    pub evidence: Evidence,
    /// Components of a symmetry field by variable.
    pub(crate) fields: Vec<(String, Formula)>,
}

impl Serialize for Found {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Written<'f> {
            kind: FoundKind,
            formula: &'f str,
            #[serde(rename = "let", skip_serializing_if = "<[_]>::is_empty")]
            abbreviations: &'f [(&'static str, &'static str)],
            #[serde(skip_serializing_if = "<[_]>::is_empty")]
            with: &'f [Given],
            trivial: bool,
            #[serde(skip_serializing_if = "Option::is_none")]
            known: &'f Option<String>,
            verdict: Verdict,
            evidence: &'f Evidence,
        }
        Written {
            kind: self.kind,
            formula: self.text(),
            abbreviations: &self.abbreviations,
            with: &self.with,
            // Functions of the energy and the level are not reported.
            trivial: false,
            known: &self.known,
            verdict: self.verdict,
            evidence: &self.evidence,
        }
        .serialize(serializer)
    }
}

impl Found {
    /// Makes a find from a function and its evidence.
    pub(crate) fn new(
        kind: FoundKind,
        function: &Formula,
        known: Option<String>,
        report: ClaimReport,
        model: &Model,
    ) -> Self {
        let formula = FoundFormula::Function(function.clone());
        Self { known, ..Self::made(kind, formula, &[function], report, model) }
    }

    /// Makes a find that consists of several formulas, with its text.
    pub(crate) fn of_several(
        kind: FoundKind,
        text: String,
        formulas: &[&Formula],
        report: ClaimReport,
        model: &Model,
    ) -> Self {
        Self::made(kind, FoundFormula::Text(text), formulas, report, model)
    }

    fn made(
        kind: FoundKind,
        formula: FoundFormula,
        formulas: &[&Formula],
        report: ClaimReport,
        model: &Model,
    ) -> Self {
        let mut needed = formulas.to_vec();
        let mut abbreviations = library::abbreviations(model);
        abbreviations.reverse();
        abbreviations.retain(|(name, _)| {
            let used = needed.iter().any(|formula| formula.uses(name));
            if let (true, Some(own)) = (used, abbreviation(model, name)) {
                needed.push(own);
            }
            used
        });
        abbreviations.reverse();
        Self {
            kind,
            formula,
            fields: Vec::new(),
            abbreviations,
            with: Vec::new(),
            known: None,
            verdict: report.verdict,
            evidence: report.evidence,
        }
    }

    /// Text of the formula.
    pub fn text(&self) -> &str {
        match &self.formula {
            FoundFormula::Function(own) => own.text().trim(),
            FoundFormula::Text(text) => text,
        }
    }

    /// The invariant itself, where it is one function of the case.
    pub fn function(&self) -> Option<&Formula> {
        match &self.formula {
            FoundFormula::Function(own) => Some(own),
            FoundFormula::Text(_) => None,
        }
    }

    /// Cofactor of a Darboux polynomial.
    pub(crate) fn cofactor(&self) -> Option<&Formula> {
        self.with.iter().find_map(|own| match own {
            Given::Cofactor(cofactor) => Some(cofactor),
            _ => None,
        })
    }

    /// Whether it is an integral of the case as it is.
    pub(crate) fn is_integral(&self) -> bool {
        self.kind == FoundKind::Integral && self.with.is_empty()
    }

    /// Whether another find says the same: the same formula or, for brackets, one with the same
    /// Hamiltonian.
    pub(crate) fn says(&self, other: &Self) -> bool {
        self.kind == other.kind
            && match self.kind {
                FoundKind::Bracket => self.with.first() == other.with.first(),
                _ => self.text() == other.text() && self.with == other.with,
            }
    }
}

/// Formula of an abbreviation, by its name.
fn abbreviation<'m>(model: &'m Model, name: &str) -> Option<&'m Formula> {
    match model.vocabulary.find(name)?.meaning {
        Meaning::Abbreviation(index) => model.abbreviations.get(index),
        _ => None,
    }
}
