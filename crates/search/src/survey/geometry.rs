//! Recognition of a geometry by the prover: each fact is a claim about the case, and is judged like
//! any other.
//!
//! A ball is recognised by its point of contact, ∂r = −R(E − γ⊗γ), whatever the case calls it.

use serde::Serialize;
use toml::de::DeTable;

use super::axis::{self, RevolutionAxis};
use super::data;
use super::definitions::{Definition, define, defined};
use liouville::case::Case;
use liouville::claim::{Claim, ClaimEntry, Identity, Integral, Statement};
use liouville::formula::{Scope, Type};
use liouville::mechanics::{Surface, System};
use liouville::verdict::{ClaimReport, JudgeError, Options, Verdict, judge};

/// A fact about a geometry, with its proof or its witness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GeometryFact {
    /// Name of the fact in conditions.
    pub id: String,
    /// Description of the fact.
    pub words: String,
    /// Whether the fact holds.
    pub holds: bool,
    /// Claim by which it was decided; `None` if the file states it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub claim: Option<ClaimReport>,
}

/// Facts about a geometry.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// All facts that were examined.
    pub facts: Vec<GeometryFact>,
    /// Axes of revolution.
    pub axes: Vec<RevolutionAxis>,
    /// Standard names for quantities that the case names differently.
    pub bindings: Vec<Definition>,
}

const TEXTS: [&str; 6] = [
    include_str!("facts/rolling.toml"),
    include_str!("facts/rubber.toml"),
    include_str!("facts/sphere.toml"),
    include_str!("facts/flat-base.toml"),
    include_str!("facts/surface-support.toml"),
    include_str!("facts/surface-level.toml"),
];

/// A fact to be examined: its claim, the fact that is its premise, and the fact that implies it.
struct PendingFact {
    id: String,
    words: String,
    given: Option<String>,
    unless: Option<String>,
    claim: Claim,
}

impl Geometry {
    /// Examines all facts.
    pub fn of(case: &Case, options: &Options) -> Result<Self, JudgeError> {
        let mut geometry = Self { bindings: bindings(case), ..Self::default() };
        geometry.read_features(case);
        for text in TEXTS {
            let Ok(document) = DeTable::parse(text) else { continue };
            geometry.ask_all(case, options, document.get_ref())?;
        }
        for axis in axis::tried(case) {
            if axis.index.is_none() && !geometry.axes.is_empty() {
                break;
            }
            geometry.try_axis(case, options, axis)?;
        }
        if case.model.system.body().is_some() {
            geometry.name_shape(case, options)?;
        }
        Ok(geometry)
    }

    /// Whether a fact holds.
    pub fn has(&self, id: &str) -> bool {
        self.facts.iter().any(|fact| fact.holds && fact.id == id)
    }

    /// Whether a fact holds, in general or about this axis.
    pub fn has_about(&self, id: &str, axis: Option<&RevolutionAxis>) -> bool {
        self.has(id) || axis.is_some_and(|axis| self.has(&format!("{id} about {}", axis.name)))
    }

    /// Examines the facts of a file.
    fn ask_all(
        &mut self,
        case: &Case,
        options: &Options,
        file: &DeTable<'_>,
    ) -> Result<(), JudgeError> {
        let system_fits = data::words(file, "system").contains(&case.system);
        if !system_fits || data::word(file, "given").is_some_and(|fact| !self.has(&fact)) {
            return Ok(());
        }
        let mut names = self.bindings.clone();
        names.extend(data::pairs(file, "let").iter().map(|(name, text)| define(name, text)));
        for fact in data::tables(file, "fact") {
            let Some(asked) = asked(fact) else { continue };
            let given = asked.given.as_ref().is_none_or(|fact| self.has(fact));
            if given && !asked.unless.as_ref().is_some_and(|fact| self.has(fact)) {
                self.decide(case, options, &names, asked)?;
            }
        }
        Ok(())
    }

    fn decide(
        &mut self,
        case: &Case,
        options: &Options,
        names: &[Definition],
        asked: PendingFact,
    ) -> Result<bool, JudgeError> {
        let claim = decided(case, options, names, &asked.claim)?;
        let holds = claim.as_ref().is_some_and(is_true);
        self.facts.push(GeometryFact { id: asked.id, words: asked.words, holds, claim });
        Ok(holds)
    }

    /// Notes the facts that the case file states.
    fn read_features(&mut self, case: &Case) {
        let mut note = |id: &str, words: &str| {
            let (id, words) = (id.to_string(), words.to_string());
            self.facts.push(GeometryFact { id, words, holds: true, claim: None });
        };
        let (forces, rotor) = match &case.model.system {
            system @ (System::Rubber(_) | System::Spinning(_)) => {
                let forces = system.has_potential() || system.moment().is_some();
                (forces, system.gyrostat().is_some())
            }
            System::FlatBase(body) => (body.potential.is_some(), body.gyrostat.is_some()),
            System::Ball(ball) => {
                match ball.surface {
                    Surface::Support(_) => note("support", "the surface has a support function"),
                    Surface::Level(_) | Surface::Arbitrary(_) => {
                        note("level", "the surface is a level of a function")
                    }
                }
                match ball.rotation {
                    Some(_) => note("rotating", "the surface turns"),
                    None => note("at rest", "the surface is at rest"),
                }
                (ball.potential.is_some(), false)
            }
            System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
                return;
            }
        };
        match forces {
            true => note("potential", "there are forces"),
            false => note("no forces", "there are no forces"),
        }
        match rotor {
            true => note("rotor", "there is a rotor"),
            false => note("no-rotor", "there is no rotor"),
        }
        if !case.model.system.energy_is_inhomogeneous() {
            note("free", "the motion is free");
        }
    }

    fn try_axis(
        &mut self,
        case: &Case,
        options: &Options,
        axis: RevolutionAxis,
    ) -> Result<(), JudgeError> {
        let (a, name) = (&axis.vector, &axis.name);
        let is_body = case.model.system.body().is_some();
        let (what, tensor) = match is_body {
            true => ("the body and its inertia are", format!("I*hat({a}) − hat({a})*I")),
            false => ("the surface is", "0*E".to_string()),
        };
        let names = self.bindings.clone();
        let asked = |id: &str, words: String, identity: String| PendingFact {
            id: format!("{id} about {name}"),
            words,
            given: None,
            unless: None,
            claim: Claim::of(Identity::NAME, ClaimEntry::Text(identity)),
        };
        let words = format!("{what} of revolution about {name}");
        let turned = asked("revolution", words, format!("(r, {a} × γ)*E + {tensor} = 0*E"));
        if !self.decide(case, options, &names, turned)? {
            return Ok(());
        }
        if is_body {
            let words = "it is a disk, with the mass centre in its plane".to_string();
            self.decide(case, options, &names, asked("disk", words, format!("(r, {a}) = 0")))?;
        }
        self.axes.push(axis);
        Ok(())
    }

    /// Binds R, c and B to the names that the case has for them, or to their definitions.
    fn name_shape(&mut self, case: &Case, options: &Options) -> Result<(), JudgeError> {
        let names = self.bindings.clone();
        let named = |name: &str, kind: Type, meaning: &str| -> Result<bool, JudgeError> {
            if !case.model.vocabulary.lookup(name).is_some_and(|(_, found)| found == kind) {
                return Ok(false);
            }
            let identity = ClaimEntry::Text(format!("{meaning} = {name}"));
            let claim = Claim::of(Identity::NAME, identity);
            Ok(decided(case, options, &names, &claim)?.as_ref().is_some_and(is_true))
        };
        if self.has("ball") {
            if !named("R", Type::Scalar, "−trace(∂r)/2")? {
                self.bindings.push(define("R", "−trace(∂r)/2"));
            }
            if !named("c", Type::VECTOR, "trace(∂r)/2*γ − r")? {
                self.bindings.push(define("c", "−(r + R*γ)"));
            }
        }
        if self.has("ellipsoid") && !named("B", Type::MATRIX, "r ⊗ r − h*∂r")? {
            self.bindings.push(define("B", "r ⊗ r − h*∂r"));
        }
        Ok(())
    }
}

/// Reads a fact of a file; a test ensures that each can be read.
fn asked(fact: &DeTable<'_>) -> Option<PendingFact> {
    let statement =
        |key: &'static str| Some(Claim::of(key, ClaimEntry::Text(data::word(fact, key)?)));
    Some(PendingFact {
        id: data::word(fact, "id")?,
        words: data::word(fact, "words")?,
        given: data::word(fact, "given"),
        unless: data::word(fact, "unless"),
        claim: statement(Identity::NAME).or_else(|| statement(Integral::NAME))?,
    })
}

/// Judges one claim; `None` if it cannot be stated.
fn decided(
    case: &Case,
    options: &Options,
    names: &[Definition],
    claim: &Claim,
) -> Result<Option<ClaimReport>, JudgeError> {
    let asked = defined(case, names);
    match asked.and_then(|named| named.with_claims(std::slice::from_ref(claim)).ok()) {
        Some(asked) => Ok(judge(&asked, options)?.claims.into_iter().next()),
        None => Ok(None),
    }
}

fn is_true(claim: &ClaimReport) -> bool {
    matches!(claim.verdict, Verdict::Proved | Verdict::Confirmed)
}

/// Binds the names of the families to quantities that the case names differently.
fn bindings(case: &Case) -> Vec<Definition> {
    let mut found: Vec<(&str, &str)> = Vec::new();
    if let Some(body) = case.model.system.body() {
        found.extend([("m", body.mass.text()), ("I", body.inertia.text())]);
        found.extend(body.curvature.as_ref().map(|k| ("k", k.text())));
        found.extend(body.gyrostat.as_ref().map(|s| ("S", s.text())));
    }
    match &case.model.system {
        System::FlatBase(body) => {
            found.extend([
                ("m", body.mass.text()),
                ("I", body.inertia.text()),
                ("k", body.curvature.text()),
                ("z", body.height.text()),
            ]);
            found.extend(body.gyrostat.as_ref().map(|s| ("S", s.text())));
        }
        System::Ball(ball) => {
            found.extend([
                ("m", ball.mass.text()),
                ("R", ball.radius.text()),
                ("μ", ball.moment.text()),
            ]);
            found.extend(ball.rotation.as_ref().map(|turning| ("Ω", turning.text())));
            found.extend(ball.potential.is_none().then_some(("U", "0")));
            if let Surface::Level(function) = &ball.surface {
                found.push(("F", function.text()));
            }
        }
        System::Rubber(_)
        | System::Spinning(_)
        | System::Lagrangian(_)
        | System::Hamiltonian(_)
        | System::Field(_)
        | System::Map(_) => {}
    }
    found.retain(|(name, text)| name != text);
    found.into_iter().map(|(name, text)| define(name, text)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fact_can_be_read() {
        for text in TEXTS {
            let document = DeTable::parse(text).expect("TOML");
            let facts = data::tables(document.get_ref(), "fact");
            assert!(!facts.is_empty(), "facts in\n{text}");
            for fact in facts {
                assert!(asked(fact).is_some(), "a fact has id, words and a claim:\n{text}");
            }
        }
    }
}
