//! A claim is some scalars that must vanish identically on a level set.
//!
//! Each kind of claim is one file that says what its residual is; sampling, the ladder, verdicts and
//! reports are written once for all of them.

mod criterion;
mod density;
mod integral;
mod place;

use crate::formula::Formula;
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, rejection};
use crate::mechanics::{Meaning, Model};
use crate::scalar::Scalar;

pub use place::Place;

/// What is claimed.
#[derive(Clone, Debug)]
pub enum Kind {
    /// F is a first integral: L_vF = 0.
    Integral(Formula),
    /// ρ is an invariant density: v(ln ρ) + div v = 0 on the level.
    Density(Formula),
    /// A density that is positive and analytic near ω = 0 exists.
    AnalyticDensity,
    /// A density of the configuration alone, ρ(γ) or ρ(r₁,r₂), exists.
    PositionDensity,
}

impl Kind {
    /// The kind's name in case files and reports.
    pub fn name(&self) -> &'static str {
        match self {
            Kind::Integral(_) => "integral",
            Kind::Density(_) => "density",
            Kind::AnalyticDensity => "analytic-density",
            Kind::PositionDensity => "position-density",
        }
    }

    /// The formula that the claim is about, if it has one.
    pub fn formula(&self) -> Option<&Formula> {
        match self {
            Kind::Integral(formula) | Kind::Density(formula) => Some(formula),
            Kind::AnalyticDensity | Kind::PositionDensity => None,
        }
    }

    /// The same claim about another formula; a claim about none stays as it is.
    pub fn about(&self, formula: Formula) -> Self {
        match self {
            Kind::Integral(_) => Kind::Integral(formula),
            Kind::Density(_) => Kind::Density(formula),
            Kind::AnalyticDensity => Kind::AnalyticDensity,
            Kind::PositionDensity => Kind::PositionDensity,
        }
    }

    /// The gradient of F, or of ln ρ.
    pub fn slope(&self, jet: &Jet<'_, Expr>) -> Option<Vec<Expr>> {
        match self {
            Kind::Integral(formula) => Some(jet.gradient(|at| at.scalar(formula))),
            Kind::Density(formula) => Some(density::slope(jet, formula)),
            Kind::AnalyticDensity | Kind::PositionDensity => None,
        }
    }

    /// The scalars that vanish where the claim holds.
    pub fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T> {
        match self {
            Kind::Integral(formula) => integral::residual(jet, formula),
            Kind::Density(formula) => density::residual(jet, formula, kept),
            Kind::AnalyticDensity | Kind::PositionDensity => criterion::residual(&jet.phase),
        }
    }

    /// What is asked beside the residual, on a few states only.
    pub fn context(&self, jet: &Jet<'_, Expr>, kept: &[bool]) -> Context {
        let mut context = match self {
            Kind::Integral(formula) => integral::context(jet, formula, kept),
            Kind::Density(formula) => density::context(jet, formula),
            Kind::AnalyticDensity | Kind::PositionDensity => criterion::context(&jet.phase),
        };
        context.quadrature_defects = self.quadrature_defects(jet, kept);
        context
    }

    /// What vanishes exactly when the integrand of each ∫ is a function of its variable there:
    /// ∇f less its part along ∇x and the level functions.
    pub fn quadrature_defects(&self, jet: &Jet<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        self.formula().map_or(Vec::new(), |formula| quadrature_defects(jet, formula, kept))
    }

    /// Why this kind of claim cannot be made about `model`, if it cannot.
    pub fn objection(&self, model: &Model) -> Option<String> {
        let criterion = matches!(self, Kind::AnalyticDensity | Kind::PositionDensity);
        (criterion && matches!(model.system, crate::mechanics::System::Field(_))).then(|| {
            format!(
                "`{}` is decided by a criterion that is known for the rubber systems and the flat \
                 base only; state a density instead",
                self.name()
            )
        })
    }

    /// What a non-zero residual excludes, where that is less than the whole claim.
    pub fn limit_of_refutation(&self, model: &Model) -> Option<&'static str> {
        (matches!(self, Kind::AnalyticDensity) && !model.system.is_free()).then_some(
            "the criterion is not zero, which excludes every density of the configuration alone; with \
             a potential or a gyrostat one that depends on ω as well stays open",
        )
    }
}

/// Quantities that tell what a vanishing residual means.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// The square of what the residual is small against; a residual is resolved when its error
    /// bound is far below the root of this.
    pub scale: Option<Expr>,
    /// F or ρ itself: a claim about a formula that has no value is no claim.
    pub value: Option<Expr>,
    /// Of an integral: |∇F|².
    pub slope: Option<Expr>,
    /// Zero exactly when the integral is constant on the level.
    pub off_level: Vec<Expr>,
    /// Zero exactly when the integral depends on the level functions and the energy.
    pub off_general: Vec<Expr>,
    /// Zero exactly when the integrand of each ∫ is a function of its variable, on the level.
    pub quadrature_defects: Vec<Expr>,
}

/// ∇f less its part along ∇x and the level functions, for each ∫(f, x) that a formula uses.
fn quadrature_defects(jet: &Jet<'_, Expr>, formula: &Formula, kept: &[bool]) -> Vec<Expr> {
    let model = jet.phase.model();
    let mut defects = Vec::new();
    for used in with_abbreviations(model, formula).into_iter().filter(|f| f.has_antiderivative()) {
        let level = jet.level_gradients(kept);
        let columns: Vec<_> = jet
            .along_axes()
            .iter()
            .map(|moved| used.antiderivatives(&mut |symbol| moved.value(symbol)))
            .collect();
        let count = columns.first().map_or(0, Vec::len);
        defects.extend((0..count).flat_map(|k| {
            let integrand: Vec<Expr> = columns.iter().map(|pairs| pairs[k].0.eps).collect();
            let variable: Vec<Expr> = columns.iter().map(|pairs| pairs[k].1.eps).collect();
            let mut others = level.clone();
            others.push(variable);
            rejection(&integrand, &others)
        }));
    }
    defects
}

/// A formula with the abbreviations it uses, and those that they use.
fn with_abbreviations<'m>(model: &'m Model, formula: &'m Formula) -> Vec<&'m Formula> {
    let mut met = vec![false; model.abbreviations.len()];
    let mut all = vec![formula];
    let mut next = 0;
    while let Some(formula) = all.get(next).copied() {
        next += 1;
        for symbol in formula.symbols() {
            if let Meaning::Abbreviation(index) = model.vocabulary.entry(symbol).meaning
                && !std::mem::replace(&mut met[index], true)
            {
                all.push(&model.abbreviations[index]);
            }
        }
    }
    all
}
