//! Functions that motions keep, by whose values one of a family of motions is chosen: the energy, and
//! integrals that the case claims and that are proved.

use crate::FlowError;
use crate::motion::kept::{is_energy_proved, is_proved};
use crate::motion::recorded::point;
use crate::motion::start::{LevelFunctions, Start};
use crate::section::axis::{AxisMistake, number_with_pi};
use liouville::case::{Case, Expect};
use liouville::claim::ClaimKind;
use liouville::formula::{Formula, Type, canonical_name};
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::elimination::rejection;
use liouville::mechanics::{Model, Phase};
use liouville::number::double_double::DoubleDoubles;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Options;

/// Name of the energy among the functions that are kept.
const ENERGY: &str = "energy";
/// Part of a gradient across others below which it depends on them.
const DEPENDENT: f64 = 1e-6;

/// A function that motions keep.
#[derive(Clone, Debug)]
pub enum Conserved {
    /// Energy of the system.
    Energy,
    /// Claimed integral, with its name.
    Integral {
        /// Name of the claim.
        name: String,
        /// Formula of the claim.
        formula: Formula,
    },
}

impl Conserved {
    /// Name in the case.
    pub fn name(&self) -> &str {
        match self {
            Conserved::Energy => ENERGY,
            Conserved::Integral { name, .. } => name,
        }
    }

    /// Value at a point, if the system has one.
    pub(crate) fn value<T: Scalar>(&self, phase: &Phase<'_, T>) -> Option<T> {
        match self {
            Conserved::Energy => phase.model().system.energy(phase),
            Conserved::Integral { formula, .. } => Some(phase.scalar(formula)),
        }
    }

    /// Scalar integrals that the case claims to hold, proved or not, in their order.
    pub(crate) fn claimed(case: &Case) -> impl Iterator<Item = (usize, Self)> {
        case.claims.iter().enumerate().filter_map(|(index, claim)| {
            let ClaimKind::Integral(integral) = &claim.kind else { return None };
            let formula = integral.0.clone();
            let is_one = formula.value_type() == Type::Scalar && !formula.has_antiderivative();
            let counts = is_one && claim.expect != Expect::Fails && claim.name != ENERGY;
            counts.then(|| (index, Self::Integral { name: claim.name.clone(), formula }))
        })
    }

    /// Integral of the claim with this index.
    pub(crate) fn of_claim(case: &Case, index: usize) -> Option<Self> {
        Self::claimed(case).find(|(own, _)| *own == index).map(|(_, integral)| integral)
    }

    /// Whether it is proved that the motions of the case keep the function.
    pub(crate) fn is_proved(&self, case: &Case) -> bool {
        let options = Options::default();
        match self {
            Conserved::Energy => is_energy_proved(case, &options),
            Conserved::Integral { formula, .. } => is_proved(case, formula, &options),
        }
    }

    /// Index of the claimed integral of a name, if it is proved; the energy has none.
    pub(crate) fn named(case: &Case, name: &str) -> Result<Option<usize>, AxisMistake> {
        let canonical = canonical_name(name).unwrap_or_else(|| name.to_string());
        let has_energy = case.model.system.has_energy();
        if canonical == ENERGY && has_energy {
            return Ok(None);
        }
        let found =
            Self::claimed(case).find(|(_, own)| own.name() == name || own.name() == canonical);
        match found {
            Some((index, own)) if own.is_proved(case) => Ok(Some(index)),
            Some(_) => Err(AxisMistake {
                message: format!("it is not proved that the motions keep `{name}`"),
                help: "name an integral that `liouville check` proves".to_string(),
            }),
            None => {
                let own = has_energy.then(|| ENERGY.to_string());
                let names = Self::claimed(case).map(|(_, own)| own.name().to_string());
                let names: Vec<String> = own.into_iter().chain(names).collect();
                Err(AxisMistake {
                    message: format!("the case claims no scalar integral `{name}`"),
                    help: match names.is_empty() {
                        true => "claim one: [[claims]] with name = \"J\" and integral = \"…\""
                            .to_string(),
                        false => format!("name one of {}", names.join(", ")),
                    },
                })
            }
        }
    }

    /// The proved integrals of a case, besides those that are held already, whose gradients at a state
    /// do not depend on one another and on what is held.
    pub(crate) fn further(
        case: &Case,
        model: &Model,
        start: &Start,
        held: &[Self],
    ) -> Result<Vec<Self>, FlowError> {
        let is_new = |own: &Self| held.iter().all(|known| known.name() != own.name());
        let claimed = Self::claimed(case).map(|(_, own)| own);
        let new: Vec<Self> = claimed.filter(|own| is_new(own) && own.is_proved(case)).collect();
        let all: Vec<&Self> = held.iter().chain(&new).collect();
        let functions = LevelFunctions::with(model, &start.parameters, &|phase| {
            all.iter().filter_map(|own| own.value(phase)).collect()
        })?;
        let mut unit: Vec<Vec<f64>> = Vec::new();
        let mut independent = Vec::new();
        for gradient in functions.at(&start.state).1 {
            let gradient: Vec<f64> = gradient.iter().map(|x| x.hi).collect();
            let rest = rejection(&gradient, &unit);
            let norm = |parts: &[f64]| parts.iter().map(|x| x * x).sum::<f64>().sqrt();
            let length = norm(&rest);
            independent.push(length > DEPENDENT * norm(&gradient));
            if length > 0.0 {
                unit.push(rest.into_iter().map(|x| x / length).collect());
            }
        }
        let first = independent.len().saturating_sub(new.len());
        Ok(new
            .into_iter()
            .zip(&independent[first..])
            .filter(|(_, own)| **own)
            .map(|(own, _)| own)
            .collect())
    }
}

/// A function that motions keep, with its value.
#[derive(Clone, Debug)]
pub struct Fixed {
    /// Function.
    pub function: Conserved,
    /// Value of all motions.
    pub value: Rational,
}

impl Fixed {
    /// Motions of this energy.
    pub fn energy(value: Rational) -> Self {
        Self { function: Conserved::Energy, value }
    }

    /// Reads `NAME=VALUE` of the energy or of a proved integral of the case.
    pub fn read(case: &Case, text: &str) -> Result<Self, AxisMistake> {
        let wrong = |message: String| AxisMistake {
            message,
            help: "write NAME=VALUE, such as J=3.1, with the name of a claimed integral"
                .to_string(),
        };
        let (name, value) =
            text.rsplit_once('=').ok_or_else(|| wrong(format!("`{text}` has no `=`")))?;
        let value = number_with_pi(value).filter(|value| value.to_f64().0.is_finite());
        let value = value.ok_or_else(|| wrong(format!("`{text}` has no number behind `=`")))?;
        let index = Conserved::named(case, name.trim())?;
        let function = index.and_then(|index| Conserved::of_claim(case, index));
        Ok(Self { function: function.unwrap_or(Conserved::Energy), value })
    }

    /// Value of the function at a state, in words of its numbers.
    pub(crate) fn at(
        &self,
        model: &Model,
        parameters: &[Rational],
        state: &[Rational],
    ) -> Option<f64> {
        let (graph, value) = record(model.dimension(), |inputs| {
            self.function.value(&point(model, parameters, inputs))
        })
        .ok()?;
        let tape = Tape::new(&graph, &[value?]);
        let mut evaluator = Evaluator::new(&tape, DoubleDoubles);
        let state: Vec<_> = state
            .iter()
            .map(liouville::number::double_double::DoubleDouble::from_rational)
            .collect();
        evaluator.run(&state);
        Some(evaluator.output(0).hi).filter(|value| value.is_finite())
    }
}
