//! Independent integrals found so far.

use liouville::case::Case;
use liouville::graph::{Step, Tape};
use liouville::number::{BinaryOperation, UnaryFunction};

use super::super::ansatz::system::PrimePoint;
use super::super::ask::given;
use super::super::products::degree_in_state;
use super::super::terms::{recorded, varying};
use super::super::{FoundKind, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::setting::{OrbitSetting, PrimePhasePoint, run};
use super::tangents::LocalGradients;
use liouville::formula::{Formula, Type};

/// Number of the random point at which gradients are compared.
const POINT: u64 = 1 << 50;

/// Whether so many independent integrals are all that a case may have: of a field one less than its dimension.
pub fn has_all(case: &Case, integrals: usize) -> bool {
    integrals + usize::from(!case.model.system.is_map()) >= case.model.dimension()
}

/// Whether the integrals of a report are all that the case may have.
pub fn has_told_all(case: &Case, report: &SearchReport) -> bool {
    has_all(case, report.functions(FoundKind::Integral).count())
}

/// An integral with the variables that it may contain.
#[derive(Clone, Debug)]
struct KnownIntegral {
    formula: Formula,
    /// Degree of a polynomial.
    degree: Option<u32>,
    variables: Vec<usize>,
    /// Whether it is an algebraic function of the state, as those that relations along an orbit count.
    is_algebraic: bool,
}

/// Independent integrals found so far.
#[derive(Clone, Debug, Default)]
pub struct IndependentIntegrals {
    all: Vec<KnownIntegral>,
    /// Case in whose names they are written.
    case: Option<Box<Case>>,
    /// Numerators and denominators of rational ones, with their degrees.
    pub parts: Vec<(Formula, u32)>,
}

impl IndependentIntegrals {
    /// Collects what the search has found before, and the energy where it is conserved, and the
    /// function of a surface.
    pub fn of(setting: &OrbitSetting<'_>, report: &SearchReport) -> Result<Self, SearchError> {
        let case = Some(Box::new(setting.case.clone()));
        let mut known = Self { case, ..Self::default() };
        if let Some(origin) = setting.origin {
            for formula in &origin.extension.known {
                known.add(formula.clone(), None, &used(setting, formula)?);
            }
            return Ok(known);
        }
        let all: Vec<usize> = (0..setting.dimension()).collect();
        for formula in given(setting.case) {
            let statement = OrbitStatement::Integral(formula.clone());
            if claims::proved(setting, &statement)?.is_some() {
                let degree = degree(setting, &formula)?;
                known.add(formula, degree, &all);
            }
        }
        for formula in report.functions(FoundKind::Integral) {
            known.add(formula.clone(), degree(setting, formula)?, &used(setting, formula)?);
        }
        Ok(known)
    }

    /// No integrals of the same case.
    pub fn none(&self) -> Self {
        Self { case: self.case.clone(), ..Self::default() }
    }

    /// Adds an integral that is independent of the others.
    pub fn add(&mut self, formula: Formula, degree: Option<u32>, variables: &[usize]) {
        let is_algebraic = degree.is_some()
            || self.case.as_deref().is_none_or(|case| is_algebraic(case, &formula));
        let variables = variables.to_vec();
        self.all.push(KnownIntegral { formula, degree, variables, is_algebraic });
    }

    /// A random point, and the gradients of the level and of the known integrals there; `None` where there
    /// is no point.
    pub fn gradients(
        &self,
        setting: &OrbitSetting<'_>,
        at: &PrimePoint,
    ) -> Result<Option<(PrimePhasePoint, LocalGradients)>, SearchError> {
        let Some(point) = setting.point(at, POINT) else { return Ok(None) };
        let Some(mut gradients) = setting.tangents.at(at, &point) else { return Ok(None) };
        let inputs = [point.parameters.as_slice(), &point.state].concat();
        for formula in self.formulas() {
            let (graph, slopes) = recorded(setting.case, |jet| {
                jet.along_axes().iter().map(|own| own.scalar(formula).eps).collect::<Vec<_>>()
            })?;
            if let Some(gradient) = run(&Tape::new(&graph, &slopes), at.modulus, &inputs) {
                gradients.push(at, gradient);
            }
        }
        Ok(Some((point, gradients)))
    }

    /// Iterates over the formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.all.iter().map(|one| &one.formula)
    }

    /// Iterates over those that are algebraic functions of these variables alone.
    pub fn algebraic(&self, variables: &[usize]) -> impl Iterator<Item = &Formula> {
        self.inside(variables).filter(|one| one.is_algebraic).map(|one| &one.formula)
    }

    /// Number of integrals in these variables alone.
    pub fn within(&self, variables: &[usize]) -> usize {
        self.inside(variables).count()
    }

    /// Number of algebraic integrals in these variables alone.
    pub fn algebraic_within(&self, variables: &[usize]) -> usize {
        self.inside(variables).filter(|one| one.is_algebraic).count()
    }

    fn inside(&self, variables: &[usize]) -> impl Iterator<Item = &KnownIntegral> {
        self.all.iter().filter(|one| one.variables.iter().all(|k| variables.contains(k)))
    }

    /// Lists the products of algebraic integrals of these variables alone that are polynomials of at most
    /// this degree, as exponents; an integral of unknown degree counts as of degree 1, since products
    /// beyond the wanted ones do no harm.
    pub fn products(&self, degree: u32, variables: &[usize]) -> Vec<Vec<u32>> {
        let mut found: Vec<(u32, Vec<u32>)> = vec![(0, Vec::new())];
        for one in self.inside(variables).filter(|one| one.is_algebraic) {
            let own = one.degree.unwrap_or(1).max(1);
            let raised = |(total, powers): (u32, Vec<u32>)| {
                (0..=(degree - total) / own).map(move |power| {
                    (total + power * own, powers.iter().copied().chain([power]).collect())
                })
            };
            found = found.into_iter().flat_map(raised).collect();
        }
        found
            .into_iter()
            .map(|(_, powers)| powers)
            .filter(|own| own.iter().any(|a| *a > 0))
            .collect()
    }
}

/// Degree of an integral that is a polynomial in the state; `None` on a level.
fn degree(setting: &OrbitSetting<'_>, formula: &Formula) -> Result<Option<u32>, SearchError> {
    let case = setting.case;
    if !case.model.level.is_empty() || formula.value_type() != Type::Scalar {
        return Ok(None);
    }
    degree_in_state(case, formula, setting.effort.options.seed)
}

/// Whether a formula contains no exponentials, logarithms, angles and general powers of the state.
fn is_algebraic(case: &Case, formula: &Formula) -> bool {
    if formula.value_type() != Type::Scalar {
        return true;
    }
    let Ok((graph, value)) = recorded(case, |jet| jet.phase.scalar(formula)) else { return true };
    let parameters = case.model.free_components();
    let reached = graph.reached([value]);
    let varies = varying(&graph, parameters);
    for (place, step) in graph.steps().enumerate() {
        let is_other = match step {
            Step::Unary(function, _) => !matches!(
                function,
                UnaryFunction::Neg
                    | UnaryFunction::Recip
                    | UnaryFunction::Sqrt
                    | UnaryFunction::Abs
            ),
            Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
            Step::Constant(_) | Step::Input(_) | Step::Power(..) => false,
        };
        if is_other && varies[place] && reached[place] {
            return false;
        }
    }
    true
}

/// Variables that a formula contains.
fn used(setting: &OrbitSetting<'_>, formula: &Formula) -> Result<Vec<usize>, SearchError> {
    let case = setting.case;
    let is_scalar = formula.value_type() == Type::Scalar;
    let terms: Vec<&Formula> = [formula].into_iter().filter(|_| is_scalar).collect();
    let (graph, values) =
        recorded(case, |jet| terms.iter().map(|term| jet.phase.scalar(term)).collect::<Vec<_>>())?;
    let first = case.model.free_components();
    let contains = |k: &usize| values.iter().any(|value| graph.depends_on(*value, first + k));
    Ok((0..setting.dimension()).filter(contains).collect())
}
