//! Search for brackets of a field with a known Hamiltonian: skew P with v = P ∂H/∂x.
//!
//! The entries of P are sums of c w xᵃ with unknown numbers c, where w is 1, a component of a
//! parameter, or the inverse of one. v = P ∂H is linear in c; constants and low degrees come first,
//! so that the reported solution consists of them where possible. Jacobi's identity is quadratic in
//! c: the ladder tests it for this solution, and for some others.

use num_bigint::BigInt;
use num_integer::Integer;

use super::super::ask::{holds, judged, judged_alone};
use super::super::linear::SampledFunctions;
use super::super::series::exponents;
use super::super::terms::{integers, one, recorded};
use super::super::{Effort, Excluded, Found, SearchError, SearchReport};
use super::brackets::Weight;
use super::components;
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, Type};
use liouville::graph::Expr;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;
use liouville::verdict::Verdict;

/// Highest degree of the entries of a bracket.
const DEGREE: u32 = 2;
/// Largest number of state components.
const DIMENSION: usize = 8;
/// Number of unknowns above which the degree is lowered.
const UNKNOWNS: usize = 1500;
/// Number of solutions of P ∂H = 0 that are added, once with each sign, where Jacobi's identity
/// fails.
const BESIDE: usize = 12;

/// The Hamiltonians for which brackets are searched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hamiltonians {
    /// All integrals found or claimed.
    Known,
    /// The given formula.
    Given(String),
}

/// Searches for a bracket for each Hamiltonian.
pub fn brackets(
    case: &Case,
    wanted: &Hamiltonians,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let model = &case.model;
    let is_matrix = model.state.iter().any(|variable| matches!(variable.kind, Type::Matrix(..)));
    if !model.level.is_empty()
        || !model.extension.is_empty()
        || model.dimension() > DIMENSION
        || is_matrix
    {
        report.remark(format!(
            "no search for brackets: it takes at most {DIMENSION} variables, none a matrix, and no level set"
        ));
        return Ok(());
    }
    let known: Vec<Formula> = {
        let claimed = report.claimed.iter().map(|one| &one.formula);
        report.functions("integral").chain(claimed).cloned().collect()
    };
    let functions = match wanted {
        Hamiltonians::Known => known.clone(),
        Hamiltonians::Given(text) => {
            vec![super::super::FurtherTerm::from(text.as_str()).read(model)?]
        }
    };
    if functions.is_empty() {
        report.remark(
            "no search for brackets: no integral is known; give a Hamiltonian with --poisson=H"
                .to_string(),
        );
    }
    let weights = weights(case, effort)?;
    for hamiltonian in functions {
        effort.halt.check()?;
        let name = hamiltonian.to_string();
        progress(&format!("brackets with the Hamiltonian {name}"));
        let family = BracketSearch::new(case, effort, hamiltonian, weights.clone())?;
        // A function that claims about a bracket cannot read, such as `energy`, is not tried as a
        // Hamiltonian.
        if family.with_bracket(&[]).and_then(|asked| family.reads(&asked)).is_err() {
            report.remark(format!(
                "no search for brackets with the Hamiltonian {name}: write it in the state and the parameters alone"
            ));
            continue;
        }
        family.search(&known, report)?;
    }
    Ok(())
}

/// Lists 1, the components of the parameters, and their inverses, without those that depend on
/// others.
fn weights(case: &Case, effort: &Effort) -> Result<Vec<Weight>, SearchError> {
    let own = components(case);
    let above = [one()].into_iter().chain(own.iter().cloned()).map(Weight::Above);
    let all: Vec<Weight> = above.chain(own.iter().cloned().map(Weight::Below)).collect();
    let mut formulas = Vec::new();
    for weight in &all {
        formulas.push(weight.formula()?);
    }
    let (graph, values) = recorded(case, |jet| {
        formulas.iter().map(|weight| vec![jet.phase.scalar(weight)]).collect::<Vec<_>>()
    })?;
    let mut functions = SampledFunctions::new(case, &graph, &values, effort)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let independent = functions.relations()?.independent();
    Ok(independent.into_iter().map(|k| all[defined[k]].clone()).collect())
}

/// The unknown coefficient of w xᵃ in P_ij, i < j.
pub(super) struct BracketUnknown {
    pub(super) pair: (usize, usize),
    pub(super) weight: usize,
    pub(super) exponents: Vec<u32>,
}

/// The search for brackets with one Hamiltonian.
pub(super) struct BracketSearch<'a> {
    pub(super) case: &'a Case,
    effort: &'a Effort,
    hamiltonian: Formula,
    pub(super) weights: Vec<Weight>,
    /// Components of the state.
    pub(super) names: Vec<Formula>,
    degree: u32,
    pub(super) unknowns: Vec<BracketUnknown>,
}

impl<'a> BracketSearch<'a> {
    fn new(
        case: &'a Case,
        effort: &'a Effort,
        hamiltonian: Formula,
        weights: Vec<Weight>,
    ) -> Result<Self, SearchError> {
        let dimension = case.model.dimension();
        let pairs: Vec<(usize, usize)> =
            (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))).collect();
        let unknowns = |degree: u32| -> Vec<BracketUnknown> {
            let mut found = Vec::new();
            for weight in 0..weights.len() {
                for monomial in (0..=degree).flat_map(|total| exponents(dimension, total)) {
                    let one = |pair: &(usize, usize)| BracketUnknown {
                        pair: *pair,
                        weight,
                        exponents: monomial.clone(),
                    };
                    found.extend(pairs.iter().map(one));
                }
            }
            found
        };
        let (mut degree, mut own) = (DEGREE, unknowns(DEGREE));
        while own.len() > UNKNOWNS && degree > 0 {
            degree -= 1;
            own = unknowns(degree);
        }
        let mut names = Vec::new();
        for k in 0..dimension {
            names.push(case.formula(&case.model.component_name(k))?);
        }
        Ok(Self { case, effort, hamiltonian, weights, names, degree, unknowns: own })
    }

    fn search(&self, known: &[Formula], report: &mut SearchReport) -> Result<(), SearchError> {
        let name = &self.hamiltonian;
        let (graph, columns) = self.recorded()?;
        let functions = SampledFunctions::new(self.case, &graph, &columns, self.effort);
        let relations = match functions.and_then(|mut functions| functions.relations()) {
            Err(error @ (SearchError::NoChart | SearchError::NoPoints)) => {
                report.remark(format!("no search for brackets with {name}: {error}"));
                return Ok(());
            }
            relations => relations?,
        };
        let (vectors, irrational) = relations.rational()?;
        // The field is the last column: 1 in the solution, 0 in those of P ∂H = 0.
        let is_solution = |vector: &Vec<Rational>| vector.last().is_some_and(|c| !c.is_zero());
        let (solutions, beside): (Vec<_>, Vec<_>) = vectors.into_iter().partition(is_solution);
        match solutions.first() {
            Some(solution) => self.judge(solution, &beside, known, report),
            None if irrational > 0 => {
                report.remark(format!(
                    "brackets with {name}: their coefficients are not small rational numbers"
                ));
                Ok(())
            }
            None => self.exclude(&beside, report),
        }
    }

    /// Records the contribution of each unknown to P ∂H as a column; the last column is v.
    fn recorded(&self) -> Result<(liouville::graph::Graph, Vec<Vec<Expr>>), SearchError> {
        let dimension = self.names.len();
        let zero = || Expr::rational(&Rational::from(0));
        let mut weights = Vec::new();
        for weight in &self.weights {
            weights.push(weight.formula()?);
        }
        Ok(recorded(self.case, |jet| {
            let state = jet.phase.state().to_vec();
            let slope = |i| jet.phase.lift_along(i).scalar(&self.hamiltonian).eps;
            let slopes: Vec<Expr> = (0..dimension).map(slope).collect();
            let weights: Vec<Expr> =
                weights.iter().map(|weight| jet.phase.scalar(weight)).collect();
            let column = |unknown: &BracketUnknown| {
                let (i, j) = unknown.pair;
                let powers = state.iter().zip(&unknown.exponents);
                let factors = powers.flat_map(|(x, a)| (0..*a).map(move |_| *x));
                let size = factors.fold(weights[unknown.weight], |product, x| product * x);
                let mut column = vec![zero(); dimension];
                column[i] = size * slopes[j];
                column[j] = -(size * slopes[i]);
                column
            };
            let columns = self.unknowns.iter().map(column);
            columns.chain([jet.phase.field().to_vec()]).collect()
        })?)
    }

    /// Tests Jacobi's identity, first for the solution, then for its sums and differences with
    /// solutions of P ∂H = 0.
    fn judge(
        &self,
        solution: &[Rational],
        beside: &[Vec<Rational>],
        known: &[Formula],
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let model = &self.case.model;
        let name = &self.hamiltonian;
        let sum = |a: &Rational, b: &Rational, sign: i64| {
            let ((a, below_a), (b, below_b)) = (a.parts(), b.parts());
            (a * &below_b + b * sign * &below_a, below_a * below_b)
        };
        let shifted = beside.iter().take(BESIDE).flat_map(|other| {
            [1, -1].map(|sign| {
                let pairs = solution.iter().zip(other);
                let parts: Vec<(BigInt, BigInt)> = pairs.map(|(a, b)| sum(a, b, sign)).collect();
                let below = parts.iter().fold(BigInt::from(1), |lcm, (_, own)| lcm.lcm(own));
                parts.iter().map(|(above, own)| above * (&below / own)).collect::<Vec<_>>()
            })
        });
        let mut tried = 0;
        for multiples in [integers(solution)].into_iter().chain(shifted) {
            self.effort.halt.check()?;
            tried += 1;
            let entries = self.entries(&multiples)?;
            let asked = self.with_bracket(&entries)?;
            let claims = [Claim::hamiltonian(asked.in_variables(name)?), Claim::jacobi_identity()];
            let reports = judged(&asked, &claims, self.effort)?;
            if !reports.iter().all(holds) {
                continue;
            }
            let mut with = vec![("Hamiltonian", name.to_string())];
            for casimir in known.iter().filter(|other| other.text() != name.text()) {
                if self.is_casimir(&asked, casimir)? {
                    with.push(("Casimir", casimir.to_string()));
                }
            }
            // Use the weaker of the two verdicts.
            let weaker = reports.into_iter().min_by_key(|own| own.verdict == Verdict::Proved);
            if let Some(weaker) = weaker {
                let (text, parts) = (self.shown(&entries), entries.iter().collect::<Vec<_>>());
                let mut found = Found::of_several("bracket", text, &parts, weaker, model);
                found.with = with;
                report.found.push(found);
            }
            return Ok(());
        }
        let entries = self.entries(&integers(solution))?;
        report.remark(format!(
            "v = P ∂H with H = {name} and {}, but this P fails Jacobi's identity, or is not proved; so do {} others of the {}-dimensional family that were tried",
            self.shown(&entries),
            tried - 1,
            beside.len()
        ));
        Ok(())
    }

    /// States a theorem, once all solutions of P ∂H = 0 modulo the prime are proved to be
    /// solutions: then the rank of the unknowns' columns is that modulo the prime, and the rank
    /// with v is not below that.
    fn exclude(
        &self,
        beside: &[Vec<Rational>],
        report: &mut SearchReport,
    ) -> Result<(), SearchError> {
        let name = &self.hamiltonian;
        for vector in beside {
            self.effort.halt.check()?;
            let asked = self.with_bracket(&self.entries(&integers(vector))?)?;
            if !self.is_casimir(&asked, name)? {
                report
                    .remark(format!("no bracket was found with {name}; its absence is not proved"));
                return Ok(());
            }
        }
        let mut weights = Vec::new();
        for weight in &self.weights {
            weights.push(weight.formula()?.to_string());
        }
        let (degree, weights) = (self.degree, weights.join(", "));
        let coefficients = match weights.as_str() {
            "1" => "numbers as coefficients".to_string(),
            _ => format!(
                "coefficients that are sums, with numbers in front that are the same for all parameters, of {weights}"
            ),
        };
        report.excluded.push(Excluded {
            ansatz: format!(
                "brackets P, polynomials of degree at most {degree} in the state, with the Hamiltonian {name}"
            ),
            dimension: 0,
            known: 0,
            error_log2: None,
            theorem: format!(
                "There is no skew P with v = P ∂H, H = {name}, whose entries are polynomials of degree at most {degree} in the state with {coefficients}."
            ),
        });
        Ok(())
    }

    fn is_casimir(&self, asked: &Case, function: &Formula) -> Result<bool, SearchError> {
        // The function may contain names that formulas in the variables of a bracket cannot.
        let Ok(function) = asked.in_variables(function) else { return Ok(false) };
        let report = judged_alone(asked, Claim::casimir(function), self.effort)?;
        Ok(report.is_some_and(|own| own.verdict == Verdict::Proved))
    }

    /// Checks that the Hamiltonian can be read in the variables of a bracket.
    fn reads(&self, asked: &Case) -> Result<(), SearchError> {
        asked.with_claims(&[Claim::casimir(asked.in_variables(&self.hamiltonian)?)])?;
        Ok(())
    }
}
