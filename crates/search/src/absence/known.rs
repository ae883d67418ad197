//! The integrals that are known: what the file claims and is proved, and the energy.

use super::super::ansatz::coordinates;
use super::super::ansatz::system::System;
use super::super::ask::{components, independent, judged};
use super::super::linear::Functions;
use super::super::products::{Generators, degree};
use super::super::terms::{Term, read, recorded};
use super::super::{Effort, SearchError};
use liouville::case::Case;
use liouville::claim::{Integral, Kind};
use liouville::mechanics::Draw;
use liouville::verdict::{ClaimReport, Verdict};

/// Products beyond which they are not counted.
const MOST: usize = 2000;

/// Integrals of a case, each proved, component by component.
pub struct Known {
    names: Vec<String>,
}

/// The polynomials of at most one degree that known integrals make up.
pub struct Space {
    /// Number of independent polynomials among them.
    pub dimension: usize,
    /// Integrals that they are made of.
    pub names: Vec<String>,
}

impl Known {
    /// The integrals among the claims of a case, by the reports on them.
    pub fn of(case: &Case, reports: &[ClaimReport], effort: &Effort) -> Result<Self, SearchError> {
        let mut names = Vec::new();
        if case.model.vocabulary.find("energy").is_some() {
            let reports = judged(case, &["integral = \"energy\"".to_string()], effort)?;
            if reports.iter().any(|report| report.verdict == Verdict::Proved) {
                names.push("energy".to_string());
            }
        }
        for (claim, report) in case.claims.iter().zip(reports) {
            if let (Kind::Integral(Integral(own)), Verdict::Proved) = (&claim.kind, report.verdict)
            {
                names.extend(components(own.text(), own.value_type()));
            }
        }
        Ok(Self { names })
    }

    /// The formulas.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The same without the energy.
    pub fn claimed(&self) -> Vec<String> {
        self.names.iter().filter(|name| *name != "energy").cloned().collect()
    }

    /// Those that have values modulo a prime, as terms: without exp, ln and the like, and without ∫,
    /// whose constant is open.
    pub fn terms(&self, case: &Case, seed: u64) -> Result<Vec<Term>, SearchError> {
        let mut own = read(self.names.clone(), &case.model.vocabulary);
        own.retain(|term| !case.model.has_antiderivative(&term.formula));
        let (graph, values) = recorded(case, |jet| {
            own.iter().map(|term| vec![jet.phase.scalar(&term.formula)]).collect::<Vec<_>>()
        })?;
        let defined = Functions::new(case, &graph, &values, seed)?.defined();
        Ok(defined.into_iter().map(|k| own[k].clone()).collect())
    }

    /// The polynomials in the integrals that have at most a degree in the velocities.
    ///
    /// Products are independent over the numbers where their values at random states, modulo a prime
    /// and for one choice of the parameters, have full rank; or where the integrals are independent
    /// functions. The larger number of both counts.
    pub fn of_degree(&self, case: &Case, most: u32, effort: &Effort) -> Result<Space, SearchError> {
        let seed = effort.options.seed;
        let mut independents = Vec::new();
        for name in &self.names {
            let known = degree(case, name, seed)?.filter(|degree| *degree > 0);
            let Some(degree) = known.filter(|degree| *degree <= most) else { continue };
            let claimed = independents.iter().map(|(name, _)| String::clone(name));
            let told: Vec<String> = claimed.filter(|name| name != "energy").collect();
            let is_new = match name.as_str() {
                "energy" => true,
                name => independent(case, &told, name, effort)?.is_some(),
            };
            if is_new {
                independents.push((name.clone(), degree));
            }
        }
        let by_gradients = Generators::of(independents.clone());
        let mut best = Space {
            dimension: by_gradients.products(most, true),
            names: independents.into_iter().map(|(name, _)| name).collect(),
        };
        if let Some(space) = self.by_values(case, most, seed)?
            && space.dimension > best.dimension
        {
            best = space;
        }
        Ok(best)
    }

    /// Products counted by their values; nothing where lists of parameters would need more than one
    /// count, or some have no value modulo a prime.
    fn by_values(&self, case: &Case, most: u32, seed: u64) -> Result<Option<Space>, SearchError> {
        if has_lists(case) {
            return Ok(None);
        }
        let mut terms = Vec::new();
        let mut own = Vec::new();
        for term in self.terms(case, seed)? {
            let known = degree(case, &term.text, seed)?.filter(|degree| *degree > 0);
            if let Some(degree) = known.filter(|degree| *degree <= most) {
                own.push((term.text.clone(), degree));
                terms.push(term);
            }
        }
        let products = Generators::of(own).exponents(most, true);
        let dimension = rank(case, &terms, &products, &[], seed)?;
        let names = terms.into_iter().map(|term| term.text).collect();
        Ok(dimension.map(|dimension| Space { dimension, names }))
    }
}

/// Whether a parameter has a list of values.
pub fn has_lists(case: &Case) -> bool {
    let draws = case.model.parameter_draws();
    draws.iter().any(|draw| matches!(draw, Draw::OneOf(values) if values.len() > 1))
}

/// The rank of the values of products of terms and of further formulas, at random states, for one
/// choice of the parameters; nothing if too few states have values.
///
/// The functions that have this rank are independent over the numbers: their determinant is not 0 at
/// the states, modulo a prime, so it is not 0.
pub fn rank(
    case: &Case,
    terms: &[Term],
    products: &[Vec<u32>],
    further: &[Term],
    seed: u64,
) -> Result<Option<usize>, SearchError> {
    if products.len() > MOST || contains_integrals(case)? {
        return Ok(None);
    }
    let mut outputs = (Vec::new(), Vec::new());
    let system = System::record(case, &coordinates(case), seed, |jet, recording| {
        let mut give = |term: &Term| recording.give(jet.phase.scalar(&term.formula));
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
    let relations = system.combination_relations(&at, &[], &columns);
    Ok(relations.map(|relations| columns.len() - relations.len()))
}

/// Whether the equations of motion contain an ∫, which has no value in a prime field.
pub fn contains_integrals(case: &Case) -> Result<bool, SearchError> {
    let (graph, _) = recorded(case, |jet| jet.phase.field().to_vec())?;
    Ok(graph.inputs() > case.model.free_components() + case.model.dimension())
}
