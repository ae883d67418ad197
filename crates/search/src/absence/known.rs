//! Known integrals: those that the file claims and that are proved, and the energy.

use super::super::ansatz::system::LinearSystem;
use super::super::ask::{
    compared, components, given, independent, is_energy, judged_alone, proved_energy,
};
use super::super::continued::is_one_function;
use super::super::linear::SampledFunctions;
use super::super::local::Coordinates;
use super::super::products::{Generators, degree_in};
use super::super::terms::recorded;
use super::super::{Effort, SearchError};
use liouville::case::Case;
use liouville::claim::{Claim, ClaimKind, Integral};
use liouville::formula::{Formula, Type};
use liouville::mechanics::Draw;
use liouville::order::StableOrder;
use liouville::verdict::{ClaimReport, Verdict};

/// Largest number of products that are counted.
const MOST_PRODUCTS: usize = 2000;

/// Integrals of a case, each proved, component by component.
pub struct ProvedIntegrals {
    formulas: Vec<Formula>,
    /// Whether the first of them is the energy; no other is written as `energy`.
    has_energy: bool,
    /// Proved integrals that are not known to be one analytic function each, and are not counted.
    uncounted: Vec<Formula>,
}

/// Space of the polynomials in known integrals up to a degree.
pub struct ProductSpace {
    /// Number of independent polynomials among them.
    pub dimension: usize,
    /// Integrals that generate them.
    pub formulas: Vec<Formula>,
}

impl ProvedIntegrals {
    /// Collects the proved integrals among the claims of a case, from the reports on them, that are
    /// one analytic function each; `others` are not counted either.
    pub fn of(
        case: &Case,
        (reports, others): (&[ClaimReport], &[Formula]),
        effort: &Effort,
    ) -> Result<Self, SearchError> {
        let energy = proved_energy(case, effort)?;
        let has_energy = energy.is_some();
        let mut formulas: Vec<Formula> = energy.into_iter().collect();
        let mut uncounted = others.to_vec();
        let mut further: Vec<Formula> = Vec::new();
        for (claim, report) in case.claims.iter().zip(reports) {
            if report.verdict == Verdict::Proved {
                further.extend(functions_of_bracket(case, &claim.kind)?);
            }
            if let (ClaimKind::Integral(Integral(own)), Verdict::Proved) =
                (&claim.kind, report.verdict)
            {
                // A file may claim the energy by its name.
                for own in components(own)?.into_iter().filter(|own| !is_energy(own)) {
                    let counted = is_one_function(case, &own, effort)?;
                    let list = if counted { &mut formulas } else { &mut uncounted };
                    list.push(own);
                }
            }
        }
        // Functions that commute with the energy, as those of a bracket that are proved to commute with all functions.
        for own in further {
            let is_new = |known: &Formula| plain(known) != plain(&own);
            if !is_energy(&own)
                && formulas.iter().chain(&uncounted).all(is_new)
                && judged_alone(case, Claim::integral(&own), effort)?
                    .is_some_and(|report| report.verdict == Verdict::Proved)
            {
                let counted = is_one_function(case, &own, effort)?;
                let list = if counted { &mut formulas } else { &mut uncounted };
                list.push(own);
            }
        }
        Ok(Self { formulas, has_energy, uncounted })
    }

    /// Returns the integrals, the energy among them, that pass a test.
    pub fn filtered(
        &self,
        is_kept: impl Fn(&Formula) -> Result<bool, SearchError>,
    ) -> Result<Self, SearchError> {
        let (mut formulas, mut has_energy) = (Vec::new(), false);
        for (index, own) in self.formulas.iter().enumerate() {
            if is_kept(own)? {
                has_energy |= self.has_energy && index == 0;
                formulas.push(own.clone());
            }
        }
        Ok(Self { formulas, has_energy, uncounted: self.uncounted.clone() })
    }

    /// Proved integrals that no count contains: what is found may be a function of them.
    pub fn uncounted(&self) -> &[Formula] {
        &self.uncounted
    }

    /// Formulas of the integrals.
    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// Formula of the energy, if it is an integral.
    pub fn energy(&self) -> Option<&Formula> {
        self.formulas.first().filter(|_| self.has_energy)
    }

    /// Formulas of the integrals without the energy.
    pub fn claimed(&self) -> &[Formula] {
        &self.formulas[usize::from(self.has_energy)..]
    }

    /// Returns integrals that are independent of each other and of the given functions, such that the others are
    /// proved to be functions of these, short ones first; `None` where neither is proved of one.
    pub fn basis(&self, case: &Case, effort: &Effort) -> Result<Option<Vec<Formula>>, SearchError> {
        let mut basis = Vec::new();
        // That functions are dependent says something of the last if the others are independent.
        let given: Vec<Formula> = given(case).collect();
        let mut is_independent = match given.is_empty() {
            true => true,
            false => judged_alone(case, Claim::independent(given), effort)?
                .is_some_and(|report| report.verdict == Verdict::Proved),
        };
        let mut claimed: Vec<&Formula> = self.claimed().iter().collect();
        claimed.order_by_key(|own| own.text().chars().count());
        for own in claimed {
            match compared(case, &basis, own, effort)?.map(|report| report.verdict) {
                Some(Verdict::Proved) => {
                    basis.push(own.clone());
                    is_independent = true;
                }
                // With a list of values dependence for one of them is enough.
                Some(Verdict::Refuted) if is_independent && !has_lists(case) => {}
                _ => return Ok(None),
            }
        }
        Ok(Some(basis))
    }

    /// Returns the integrals that have values modulo a prime, as terms: those without exp, ln and
    /// the like, and without ∫, whose constant is open.
    pub fn terms(&self, case: &Case, effort: &Effort) -> Result<Vec<Formula>, SearchError> {
        let mut own = self.formulas.clone();
        own.retain(|term| {
            term.value_type() == Type::Scalar && !case.model.has_antiderivative(term)
        });
        let (graph, values) = recorded(case, |jet| {
            own.iter().map(|term| vec![jet.phase.scalar(term)]).collect::<Vec<_>>()
        })?;
        let defined = SampledFunctions::new(case, &graph, &values, effort)?.defined();
        Ok(defined.into_iter().map(|k| own[k].clone()).collect())
    }

    /// Returns the polynomials in the integrals up to a degree in the velocities.
    ///
    /// Products are independent over the numbers where their values at random states, modulo a prime
    /// and for one choice of the parameters, have full rank; or where the integrals are independent
    /// functions. The larger of the two numbers counts.
    pub fn of_degree(
        &self,
        (case, coordinates): (&Case, &Coordinates),
        most: u32,
        effort: &Effort,
    ) -> Result<ProductSpace, SearchError> {
        let seed = effort.options.seed;
        let fitting = |formula: &Formula| -> Result<Option<u32>, SearchError> {
            Ok(degree_in(case, formula, coordinates, seed)?
                .filter(|degree| (1..=most).contains(degree)))
        };
        let mut independents: Vec<(Formula, u32)> = Vec::new();
        if let Some(energy) = self.energy()
            && let Some(degree) = fitting(energy)?
        {
            independents.push((energy.clone(), degree));
        }
        let mut told: Vec<Formula> = Vec::new();
        for formula in self.claimed() {
            let Some(degree) = fitting(formula)? else { continue };
            // The energy is among those that it is compared with.
            if independent(case, &told, formula, effort)?.is_some() {
                told.push(formula.clone());
                independents.push((formula.clone(), degree));
            }
        }
        let by_gradients = Generators::of(independents.clone());
        let mut best = ProductSpace {
            dimension: by_gradients.products(most, true),
            formulas: independents.into_iter().map(|(formula, _)| formula).collect(),
        };
        if let Some(space) = self.by_values((case, coordinates), most, effort)?
            && space.dimension > best.dimension
        {
            best = space;
        }
        Ok(best)
    }

    /// Counts products by their values; `None` if lists of parameters would need more than one
    /// count, or if some product has no value modulo a prime.
    fn by_values(
        &self,
        (case, coordinates): (&Case, &Coordinates),
        most: u32,
        effort: &Effort,
    ) -> Result<Option<ProductSpace>, SearchError> {
        if has_lists(case) {
            return Ok(None);
        }
        let mut terms = Vec::new();
        let mut own = Vec::new();
        for term in self.terms(case, effort)? {
            let known = degree_in(case, &term, coordinates, effort.options.seed)?;
            let known = known.filter(|degree| *degree > 0);
            if let Some(degree) = known.filter(|degree| *degree <= most) {
                own.push((term.clone(), degree));
                terms.push(term);
            }
        }
        let products = Generators::of(own).exponents(most, true);
        let dimension = rank(case, &terms, &products, &[], effort)?;
        Ok(dimension.map(|dimension| ProductSpace { dimension, formulas: terms }))
    }
}

/// Lists the functions that a claim about a bracket names, component by component, in the names of the case.
fn functions_of_bracket(case: &Case, kind: &ClaimKind) -> Result<Vec<Formula>, SearchError> {
    let named = match kind {
        ClaimKind::Casimir(own) => vec![own.function().clone()],
        ClaimKind::Involution(own) => own.functions().to_vec(),
        _ => return Ok(Vec::new()),
    };
    let mut found = Vec::new();
    for own in named {
        // The bracket may have variables of its own.
        if let Ok(own) = Formula::parse(own.text(), &case.model.vocabulary) {
            found.extend(components(&own)?);
        }
    }
    Ok(found)
}

/// Text of a formula without spaces.
fn plain(formula: &Formula) -> String {
    formula.text().split_whitespace().collect()
}

/// Whether a parameter has a list of values.
pub fn has_lists(case: &Case) -> bool {
    let draws = case.model.parameter_draws();
    draws.iter().any(|draw| matches!(draw, Draw::OneOf(values) if values.len() > 1))
}

/// Returns the rank of the values of products of terms and of further formulas, at random states,
/// for one choice of the parameters; `None` if too few states have values.
///
/// The functions that have this rank are independent over the numbers: their determinant is not 0 at
/// the states, modulo a prime, so it is not 0.
pub fn rank(
    case: &Case,
    terms: &[Formula],
    products: &[Vec<u32>],
    further: &[Formula],
    effort: &Effort,
) -> Result<Option<usize>, SearchError> {
    if products.len() > MOST_PRODUCTS || contains_integrals(case)? {
        return Ok(None);
    }
    let mut outputs = (Vec::new(), Vec::new());
    let system = LinearSystem::record(case, effort, |jet, recording| {
        let mut give = |term: &Formula| recording.give(jet.phase.scalar(term));
        outputs.0 = terms.iter().map(&mut give).collect();
        outputs.1 = further.iter().map(&mut give).collect();
    })?;
    let Some(at) = system.at(0, 0) else { return Ok(None) };
    let product = |powers: &Vec<u32>| {
        let each = powers.iter().zip(&outputs.0);
        each.flat_map(|(power, output)| vec![*output; *power as usize]).collect()
    };
    let own = outputs.1.iter().map(|output| vec![*output]);
    let columns: Vec<Vec<usize>> = products.iter().map(product).chain(own).collect();
    let relations = system.combination_relations(&at, &[], &columns)?;
    Ok(relations.map(|relations| columns.len() - relations.len()))
}

/// Whether the equations of motion contain an ∫, which has no value in a prime field.
pub fn contains_integrals(case: &Case) -> Result<bool, SearchError> {
    let (graph, _) = recorded(case, |jet| jet.phase.field().to_vec())?;
    Ok(graph.inputs() > case.model.free_components() + case.model.dimension())
}
