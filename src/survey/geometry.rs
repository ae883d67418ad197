//! What the prover recognises of a geometry: each fact is a claim about the case, and is judged like
//! any other.
//!
//! A ball is known by its point of contact, not by the word that the file uses: r' = −R(E − γ⊗γ)γ'.

use serde::Serialize;

use super::question::{Definition, Question};
use crate::case::Case;
use crate::formula::{Scope, Type};
use crate::mechanics::{Origin, Surface, System};
use crate::verdict::{ClaimReport, JudgeError, Options, Verdict};

/// A fact about a geometry, with its proof or its witness.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fact {
    /// Its name in conditions.
    pub id: String,
    /// In words.
    pub words: String,
    /// Does it hold?
    pub holds: bool,
    /// The claim by which it was decided; none where the file says it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub claim: Option<ClaimReport>,
}

/// An axis about which the body and its tensor of inertia may be turned.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Its name.
    pub name: String,
    /// Unit vector along it.
    pub vector: String,
    /// Its number, if it is one of the frame's.
    pub index: Option<usize>,
}

/// What is known about a geometry.
#[derive(Clone, Debug, Default)]
pub struct Geometry {
    /// All facts that were tried.
    pub facts: Vec<Fact>,
    /// The axes of revolution.
    pub axes: Vec<Axis>,
    /// Names for what the case calls otherwise.
    pub bindings: Vec<Definition>,
}

/// Facts of a system: name, words, statement of a claim.
type Statement = (&'static str, &'static str, &'static str);

const RUBBER: [Statement; 8] = [
    ("ball", "the surface is a sphere", "identity = \"∂r = trace(∂r)/2*(E − γ ⊗ γ)\""),
    ("central", "the surface is a sphere about the mass centre", "identity = \"r × γ = [0, 0, 0]\""),
    ("ellipsoid", "the surface is an ellipsoid about the mass centre", "integral = \"Q\""),
    (
        "aligned",
        "its axes and those of inertia are the frame's",
        "identity = \"[Q12² + I12², Q13² + I13², Q23² + I23²] = [0, 0, 0]\"",
    ),
    ("spherical inertia", "the tensor of inertia is spherical", "identity = \"I = I1*E\""),
    (
        "I = mB + μE",
        "I = mB + μE, with the matrix B of the ellipsoid",
        "identity = \"I − m*Q = trace(I − m*Q)/3*E\"",
    ),
    (
        "(3.8)",
        "the moments of inertia and the axes satisfy (3.8)",
        "identity = \"(Q2 − Q3)*(m*Q1*I1 − I2*I3) + (Q3 − Q1)*(m*Q2*I2 − I1*I3) + (Q1 − Q2)*(m*Q3*I3 − I1*I2) = 0\"",
    ),
    ("I₁ = I₂", "I₁ = I₂", "identity = \"I1 = I2\""),
];

const CURVED: [Statement; 3] = [
    ("kR = 1", "the ball and the sphere are equal, kR = 1", "identity = \"k*Rb = 1\""),
    ("κ = −1", "κ = 1/(1 + kR) = −1", "identity = \"k*Rb = −2\""),
    ("K = k²", "the Gaussian curvature of the body is k²", "identity = \"k²*trace(adj(∂r)) = 1\""),
];

const FLAT: [Statement; 3] = [
    ("z = 0", "the mass centre is in the plane of the base", "identity = \"z = 0\""),
    ("I₁ = I₂", "I₁ = I₂", "identity = \"I1 = I2\""),
    ("diagonal inertia", "I is diagonal", "identity = \"[I12, I13, I23] = [0, 0, 0]\""),
];

const SUPPORT: [Statement; 2] = [
    ("sphere", "the centre moves on a sphere", "identity = \"∂r = trace(∂r)/2*(E − γ ⊗ γ)\""),
    ("quadric", "the centre moves on a quadric", "integral = \"r ⊗ r + h*∂r\""),
];

const LEVEL: [Statement; 2] = [
    ("sphere", "the centre moves on a sphere about the origin", "identity = \"r × γ = [0, 0, 0]\""),
    (
        "circular cylinder",
        "the centre moves on a circular cylinder about e3",
        "identity = \"[γ3, r1*γ2 − r2*γ1, 0] = [0, 0, 0]\"",
    ),
];

impl Geometry {
    /// Recognises what it can.
    pub fn of(case: &Case, options: &Options) -> Result<Self, JudgeError> {
        let mut geometry = Self { bindings: bindings(case), ..Self::default() };
        geometry.read_features(case);
        let statements: Vec<Statement> = match &case.model.system {
            System::Rubber(body) if body.curvature.is_some() => [&RUBBER[..], &CURVED].concat(),
            System::Rubber(_) => RUBBER.to_vec(),
            System::FlatBase(_) => FLAT.to_vec(),
            System::Ball(ball) => match ball.surface {
                Surface::Support(_) => SUPPORT.to_vec(),
                Surface::Level(_) => LEVEL.to_vec(),
            },
            System::Lagrangian(_) | System::Field(_) => Vec::new(),
        };
        let is_rubber = matches!(case.model.system, System::Rubber(_));
        let mut names = geometry.bindings.clone();
        if is_rubber {
            names.extend([
                define("Q", "r ⊗ r − h*∂r"),
                define("Rb", "−trace(∂r)/2"),
                define("cb", "−(r + Rb*γ)"),
            ]);
        }
        for (id, words, statement) in statements {
            geometry.decide(case, options, &names, (id, words, statement))?;
        }
        if geometry.has("potential") {
            let constant = ("constant potential", "the potential is constant", "integral = \"U\"");
            geometry.decide(case, options, &names, constant)?;
        }
        geometry.find_axes(case, options, &names)?;
        if is_rubber {
            geometry.name_shape(case, options, &names)?;
        }
        Ok(geometry)
    }

    /// Does a fact hold?
    pub fn has(&self, id: &str) -> bool {
        self.facts.iter().any(|fact| fact.holds && fact.id == id)
    }

    fn decide(
        &mut self,
        case: &Case,
        options: &Options,
        names: &[Definition],
        (id, words, statement): (&str, &str, &str),
    ) -> Result<bool, JudgeError> {
        let claim = decided(case, options, names, &format!("[[claim]]\n{statement}\n"))?;
        let holds = claim.as_ref().is_some_and(is_true);
        let (id, words) = (id.to_string(), words.to_string());
        self.facts.push(Fact { id, words, holds, claim });
        Ok(holds)
    }

    /// What the file itself says.
    fn read_features(&mut self, case: &Case) {
        let mut note = |id: &str, words: &str| {
            let (id, words) = (id.to_string(), words.to_string());
            self.facts.push(Fact { id, words, holds: true, claim: None });
        };
        let (potential, rotor) = match &case.model.system {
            System::Rubber(body) => (body.potential.is_some() || body.moment.is_some(), body.gyrostat.is_some()),
            System::FlatBase(body) => (false, body.gyrostat.is_some()),
            System::Ball(ball) => {
                match ball.surface {
                    Surface::Support(_) => note("support", "the surface has a support function"),
                    Surface::Level(_) => note("level", "the surface is a level of a function"),
                }
                match ball.rotation {
                    Some(_) => note("rotating", "the surface turns"),
                    None => note("at rest", "the surface is at rest"),
                }
                (ball.potential.is_some(), ball.rotation.is_some())
            }
            System::Lagrangian(_) | System::Field(_) => return,
        };
        if potential {
            note("potential", "there are forces");
        }
        let is_ball = matches!(case.model.system, System::Ball(_));
        match (rotor, is_ball) {
            (true, false) => note("rotor", "there is a rotor"),
            (false, false) => note("no-rotor", "there is no rotor"),
            _ => {}
        }
        if !potential && !rotor {
            note("free", "the motion is free");
        }
    }

    fn find_axes(
        &mut self,
        case: &Case,
        options: &Options,
        names: &[Definition],
    ) -> Result<(), JudgeError> {
        let turning_tensor = match case.model.system {
            System::Rubber(_) => true,
            System::Ball(_) => false,
            _ => return Ok(()),
        };
        let mut tried: Vec<Axis> = (0..3)
            .map(|k| Axis {
                name: format!("e{}", k + 1),
                vector: ["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"][k].to_string(),
                index: Some(k),
            })
            .collect();
        let vectors = case.model.parameters.iter().filter(|parameter| {
            parameter.kind == Type::Vector && !matches!(parameter.origin, Origin::Fixed(_))
        });
        tried.extend(vectors.map(|parameter| Axis {
            name: parameter.name.clone(),
            vector: format!("{0}/|{0}|", parameter.name),
            index: None,
        }));
        for axis in tried {
            if axis.index.is_none() && !self.axes.is_empty() {
                break;
            }
            let a = axis.vector.as_str();
            let tensor = if turning_tensor { format!("I*hat({a}) − hat({a})*I") } else { "0*E".into() };
            let statement = format!("identity = \"(r, {a} × γ)*E + {tensor} = 0*E\"");
            let words = format!("the body and its inertia are of revolution about {}", axis.name);
            let id = format!("revolution about {}", axis.name);
            if self.decide(case, options, names, (&id, &words, &statement))? {
                if turning_tensor {
                    let flat = format!("identity = \"(r, {a}) = 0\"");
                    let (id, words) = (format!("disk about {}", axis.name), "a disk, and the mass centre in its plane");
                    self.decide(case, options, names, (&id, words, &flat))?;
                }
                self.axes.push(axis);
            }
        }
        Ok(())
    }

    /// R, c and B by the names that the case has for them, or by what they are.
    fn name_shape(
        &mut self,
        case: &Case,
        options: &Options,
        names: &[Definition],
    ) -> Result<(), JudgeError> {
        let named = |name: &str, kind: Type, statement: &str| -> Result<bool, JudgeError> {
            if !case.model.vocabulary.lookup(name).is_some_and(|(_, found)| found == kind) {
                return Ok(false);
            }
            let claim = format!("[[claim]]\nidentity = \"{statement}\"\n");
            Ok(decided(case, options, names, &claim)?.as_ref().is_some_and(is_true))
        };
        if self.has("ball") {
            if !named("R", Type::Scalar, "Rb = R")? {
                self.bindings.push(define("R", "−trace(∂r)/2"));
            }
            if !named("c", Type::Vector, "cb = c")? {
                self.bindings.push(define("c", "−(r + R*γ)"));
            }
        }
        if self.has("ellipsoid") && !named("B", Type::Matrix, "Q = B")? {
            self.bindings.push(define("B", "r ⊗ r − h*∂r"));
        }
        Ok(())
    }
}

impl Axis {
    /// What stands for the placeholders of a family.
    pub fn words(&self) -> Vec<(&'static str, String)> {
        let a = &self.vector;
        let component = |name: &str| match self.index {
            Some(k) => format!("{name}{}", k + 1),
            None => format!("({name},{a})"),
        };
        let (across, along) = match self.index {
            Some(k) => (format!("I{}", (k + 1) % 3 + 1), format!("I{}", k + 1)),
            None => (format!("(trace(I) − ({a},I*{a}))/2"), format!("({a},I*{a})")),
        };
        vec![
            ("@name", self.name.clone()),
            ("@I1", across),
            ("@I3", along),
            ("@a", a.clone()),
            ("@ω", component("ω")),
            ("@γ", component("γ")),
            ("@S", component("S")),
        ]
    }
}

/// Asks one claim; `None` where it cannot be stated.
fn decided(
    case: &Case,
    options: &Options,
    names: &[Definition],
    claim: &str,
) -> Result<Option<ClaimReport>, JudgeError> {
    let question = Question::plain("geometry", names, claim.to_string());
    let findings = question.ask(case, options)?.unwrap_or_default();
    Ok(findings.into_iter().next().map(|finding| finding.claim))
}

fn is_true(claim: &ClaimReport) -> bool {
    matches!(claim.verdict, Verdict::Proved | Verdict::Confirmed)
}

fn define(name: &str, formula: &str) -> Definition {
    Definition { name: name.to_string(), formula: formula.to_string() }
}

/// The names of the families for what the case writes otherwise.
fn bindings(case: &Case) -> Vec<Definition> {
    let mut found: Vec<(&str, &str)> = Vec::new();
    match &case.model.system {
        System::Rubber(body) => {
            found.extend([("m", body.mass.text()), ("I", body.inertia.text())]);
            found.extend(body.curvature.as_ref().map(|k| ("k", k.text())));
            found.extend(body.gyrostat.as_ref().map(|s| ("S", s.text())));
        }
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
        }
        System::Lagrangian(_) | System::Field(_) => {}
    }
    found.retain(|(name, text)| name != text);
    found.into_iter().map(|(name, text)| define(name, text)).collect()
}
