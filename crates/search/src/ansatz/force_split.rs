//! Positions of a system of the user's own: the variables on which an unknown potential or force may
//! depend.
//!
//! ```text
//! flat base     the place of the contact
//! Lagrangian    its coordinates
//! Hamiltonian   the largest set of variables that commute with each other
//! field         the largest set whose rates are linear in the other variables, without a constant
//! ```

use super::at_random::values_at_random;
use super::forces::with_potential;
use crate::streams::SearchStream;
use crate::terms::recorded;
use crate::{Effort, SearchError};
use liouville::case::Case;
use liouville::graph::{Evaluator, Expr, Tape};
use liouville::mechanics::calculus::DualPoint;
use liouville::mechanics::{
    BracketBlock, HamiltonianSystem, Lagrangian, LevelFunction, Model, System, VariableRole,
};
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::{root_numbers, statement_seed};

/// Largest number of variables of which all sets are tried.
const MOST_VARIABLES: usize = 12;
/// Reason why Hamilton's equations on a level take no further terms.
pub const NO_CASIMIRS: &str = "the functions of the level set are no Casimir functions";
/// Number of multiples of the velocities at which rates are compared.
const MULTIPLES: usize = 4;
/// Number of random states that are tried, as roots exist at some only.
const TRIALS: usize = 64;

/// Finds the components of the state that are positions; the text is the reason why there are none.
pub fn positions(case: &Case, effort: &Effort) -> Result<Result<Vec<usize>, String>, SearchError> {
    let model = &case.model;
    let found = match &model.system {
        System::FlatBase(_) => Ok(vec![2, 3]),
        System::Lagrangian(_) if !model.level.is_empty() => {
            Err("the Lagrangian has a level set; write it in coordinates of the level")
        }
        System::Lagrangian(own) => coordinates(model, own),
        System::Hamiltonian(_) if !has_casimirs(case, effort)? => Err(NO_CASIMIRS),
        System::Hamiltonian(own) => match commuting(model, own) {
            Ok(set) if set.is_empty() => Err("no two variables commute"),
            other => other,
        },
        System::Field(_) => driven(case, effort)?,
        _ => Err("the system admits none, or has one with free coefficients"),
    };
    Ok(found.map_err(str::to_string))
}

/// Components of some variables.
fn components(model: &Model, keep: impl Fn(usize) -> bool) -> Vec<usize> {
    let sizes = model.state.iter().enumerate();
    let all = sizes.flat_map(|(index, variable)| vec![index; variable.len()]);
    all.enumerate().filter(|(_, variable)| keep(*variable)).map(|(place, _)| place).collect()
}

fn coordinates(model: &Model, own: &Lagrangian) -> Result<Vec<usize>, &'static str> {
    let is_position = |role: &VariableRole| {
        matches!(role, VariableRole::Coordinate(_) | VariableRole::Carried(_))
    };
    let found = components(model, |index| own.roles.get(index).is_some_and(is_position));
    if found.is_empty() { Err("the Lagrangian has no coordinates") } else { Ok(found) }
}

/// Variables of which each is the first of a canonical pair.
fn firsts(model: &Model, own: &HamiltonianSystem) -> Vec<usize> {
    let has_unit =
        |a: usize| own.blocks[a].iter().any(|block| matches!(block, Some(BracketBlock::Unit)));
    let count = model.state.len().min(own.blocks.len());
    (0..count).filter(|k| own.clock != Some(*k) && has_unit(*k)).collect()
}

/// Whether all variables but the time are those of canonical pairs.
pub fn is_canonical(model: &Model, own: &HamiltonianSystem) -> bool {
    let count = model.state.len().min(own.blocks.len());
    let commute = |a: usize, b: usize| own.blocks[a].get(b).is_none_or(Option::is_none);
    let first = firsts(model, own);
    first.iter().all(|a| first.iter().all(|b| commute(*a, *b)))
        && 2 * first.len() + usize::from(own.clock.is_some()) == count
}

/// The largest set of variables that commute; empty if there is none.
pub fn commuting(model: &Model, own: &HamiltonianSystem) -> Result<Vec<usize>, &'static str> {
    if is_canonical(model, own) {
        let first = firsts(model, own);
        return Ok(components(model, |index| first.contains(&index)));
    }
    let count = model.state.len().min(own.blocks.len());
    let commute = |a: usize, b: usize| own.blocks[a].get(b).is_none_or(Option::is_none);
    let may = |index: usize| own.clock != Some(index) && index < count;
    let sets = sets(count, may).ok_or("the system has too many variables")?;
    let is_free = |set: &&Vec<usize>| set.iter().all(|a| set.iter().all(|b| commute(*a, *b)));
    let size = |set: &Vec<usize>| set.iter().map(|k| model.state[*k].len()).sum::<usize>();
    let mut best: Option<&Vec<usize>> = None;
    for set in sets.iter().filter(is_free) {
        if best.is_none_or(|own| size(own) < size(set)) {
            best = Some(set);
        }
    }
    Ok(best.map(|set| components(model, |index| set.contains(&index))).unwrap_or_default())
}

/// Whether the level functions of Hamilton's equations change nothing as Hamiltonians, modulo a prime.
/// Then potentials that are equal on the level make the same field.
pub fn has_casimirs(case: &Case, effort: &Effort) -> Result<bool, SearchError> {
    let model = &case.model;
    let mut formulas = Vec::new();
    for own in &model.level {
        match &own.function {
            LevelFunction::Formula(formula) => formulas.push(formula),
            _ => return Ok(false),
        }
    }
    let changed: Option<Vec<Model>> =
        formulas.into_iter().map(|formula| with_potential(model, formula)).collect();
    let Some(changed) = changed else { return Ok(false) };
    let (graph, values) = recorded(case, |jet| added(jet, &changed))?;
    let found = values_at_random::<MULTIPLES>(&graph, &values, SearchStream::Equations, effort);
    Ok(found.is_some_and(|(_, values)| values.iter().flatten().all(|value| *value == 0)))
}

/// Differences between the fields of some models and that of the case at a state, one after the other.
pub fn added(jet: &DualPoint<'_, Expr>, changed: &[Model]) -> Vec<Expr> {
    let (state, field) = (jet.phase.state(), jet.phase.field());
    let of_model = |model: &Model| {
        let other = jet.phase.in_model(model, &state);
        other.field().iter().zip(field).map(|(with, without)| *with - *without).collect::<Vec<_>>()
    };
    changed.iter().flat_map(of_model).collect()
}

/// Sets of the first `count` numbers that are allowed, early ones first; `None` if there are too many.
fn sets(count: usize, may: impl Fn(usize) -> bool) -> Option<Vec<Vec<usize>>> {
    let allowed: Vec<usize> = (0..count).filter(|index| may(*index)).collect();
    (allowed.len() <= MOST_VARIABLES).then(|| {
        let mut all: Vec<Vec<usize>> = (1..1usize << allowed.len())
            .map(|bits| {
                let chosen = (0..allowed.len()).filter(|k| bits >> k & 1 == 1);
                chosen.map(|k| allowed[k]).collect()
            })
            .collect();
        all.order();
        all
    })
}

fn driven(case: &Case, effort: &Effort) -> Result<Result<Vec<usize>, &'static str>, SearchError> {
    let model = &case.model;
    if !model.level.is_empty() {
        return Ok(Err(
            "forces must keep the level of a field; write the equations with [hamiltonian] or \
             [lagrangian]",
        ));
    }
    let Some(sets) = sets(model.state.len(), |_| true) else {
        return Ok(Err("the field has too many variables"));
    };
    let rates = ScaledRates::of(case, effort)?;
    let size = |set: &Vec<usize>| set.iter().map(|k| model.state[*k].len()).sum::<usize>();
    let mut all: Vec<&Vec<usize>> =
        sets.iter().filter(|set| set.len() < model.state.len()).collect();
    all.order_by_key(|set| std::cmp::Reverse(size(set)));
    let found = all.into_iter().find_map(|set| {
        let own = components(model, |index| set.contains(&index));
        rates.are_linear(&own).then_some(own)
    });
    Ok(found
        .ok_or("no variables of the field have rates that are linear in the others, as x' = u has"))
}

/// Rates of a field at states with multiples of some components.
struct ScaledRates {
    tape: Tape,
    /// Number of inputs before the state.
    parameters: usize,
    dimension: usize,
    seed: u64,
    /// Numbers that are squares modulo the prime.
    numbers: Vec<Rational>,
}

impl ScaledRates {
    fn of(case: &Case, effort: &Effort) -> Result<Self, SearchError> {
        let (graph, field) = recorded(case, |jet| jet.phase.field().to_vec())?;
        let seed = statement_seed(effort.options.seed, &graph, &field);
        let (parameters, dimension) = (case.model.free_components(), case.model.dimension());
        let numbers = root_numbers(&graph);
        Ok(Self { tape: Tape::new(&graph, &field), parameters, dimension, seed, numbers })
    }

    /// Whether the rates of some components are linear in the other ones, and none of them is 0.
    fn are_linear(&self, positions: &[usize]) -> bool {
        let mut rng = SearchStream::Equations.under(self.seed);
        let modulus = rng.prime_for(&self.numbers);
        let m = &modulus;
        let mut evaluator = Evaluator::new(&self.tape, Prime::new([modulus; MULTIPLES]));
        let multiples: [u64; MULTIPLES] = std::array::from_fn(|k| m.integer(k as u64 + 1));
        let state = self.parameters..self.parameters + self.dimension;
        for _ in 0..TRIALS {
            let inputs: Vec<[u64; MULTIPLES]> = (0..self.tape.inputs())
                .map(|input| {
                    let own = rng.element(m);
                    let is_velocity =
                        state.contains(&input) && !positions.contains(&(input - state.start));
                    multiples.map(|factor| if is_velocity { m.mul(factor, own) } else { own })
                })
                .collect();
            evaluator.run(&inputs);
            let rates: Vec<[u64; MULTIPLES]> =
                positions.iter().map(|place| *evaluator.output(*place)).collect();
            if rates.iter().any(|own| own.contains(&UNDEFINED)) {
                continue;
            }
            return rates.iter().all(|own| {
                own[0] != 0
                    && own
                        .iter()
                        .zip(multiples)
                        .all(|(rate, factor)| *rate == m.mul(own[0], factor))
            });
        }
        false
    }
}
