//! Residual as a function of the draws of parameters and state, modulo a prime.

use super::coordinates::components;
use crate::SearchError;
use crate::local::random;
use crate::streams::SearchStream;
use crate::terms::recorded;
use liouville::case::{Case, PlacedClaim};
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Expr, Tape};
use liouville::mechanics::Draw;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::proof::{ProofRng, root_numbers};
use liouville::verdict::Sampler;

/// Number of points evaluated at a time.
pub const RESIDUAL_LANES: usize = 8;

/// Number of rounds of random points at which rates are looked at: a root has values at half of them.
const TRIALS: usize = 4;

/// A residual that has to vanish for all states.
pub struct Residual {
    tape: Tape,
    /// Number of draws of parameters and state, and constants of integration.
    inputs: usize,
    /// Names of the parameters' components.
    names: Vec<String>,
    /// Number of outputs that belong to the residual; the components follow.
    height: usize,
    /// Number of outputs at the end that are rates of the motion with values modulo primes.
    rates: usize,
    /// Whether all rates have.
    has_all_rates: bool,
    /// Draws of the parameters; those of the state follow.
    parameters: Vec<Draw>,
    /// Numbers that are squares modulo primes.
    numbers: Vec<Rational>,
    /// Whether it contains a root, which has either sign modulo a prime.
    has_roots: bool,
}

/// One point of an evaluation: the residual, and the parameters' components.
pub struct ResidualPoint {
    /// Values of the residual; `None` where it or the motion is undefined.
    pub residual: Option<Vec<u64>>,
    /// Values of the parameters' components.
    pub components: Vec<u64>,
}

impl Residual {
    /// Whether it contains a root, which has either sign modulo a prime.
    pub fn has_roots(&self) -> bool {
        self.has_roots
    }

    /// Records the residual of a claim or, without one, of the criterion for a density of the
    /// configuration.
    pub fn of(
        case: &Case,
        claim: Option<&PlacedClaim>,
        seed: u64,
    ) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        let terms = components(case);
        let (graph, (residual, values, rates)) = recorded(case, |jet| {
            let residual: Option<Vec<Expr>> = match claim {
                Some(claim) => Some(claim.kind.residual(jet, &claim.place.kept)),
                None => {
                    Some(model.system.criterion(&jet.phase)).filter(|values| !values.is_empty())
                }
            };
            let values = terms.iter().map(|term| jet.phase.scalar(term)).collect();
            // A claim about a motion says nothing where there is none.
            let rates = claim.map(|_| jet.phase.field().to_vec()).unwrap_or_default();
            (residual, values, rates)
        })?;
        let Some(residual) = residual else { return Ok(None) };
        let place = claim.map_or_else(|| LevelSubset::level(model), |claim| claim.place.clone());
        let sampler = Sampler::new(case, &place, seed)?;
        if sampler.is_numerical() {
            return Err(SearchError::NoChart);
        }
        let fixed = vec![None; sampler.recipes().len()];
        let height = residual.len();
        let count = rates.len();
        let (graph, outputs) = sampler.compose(&graph, &[residual, values, rates], &fixed)?;
        let names = terms.iter().map(ToString::to_string).collect();
        let parameters = model.parameter_draws();
        let laid_out = |outputs: &[Vec<Expr>]| Tape::new(&graph, &outputs.concat());
        let (inputs, numbers) = (graph.inputs(), root_numbers(&graph));
        let reached = graph.reached(outputs[0].iter().copied());
        let has_roots = graph.steps_at(&reached).any(|(_, step)| step.is_root());
        let mut residual = Self {
            tape: laid_out(&outputs[..2]),
            names,
            height,
            rates: 0,
            has_all_rates: true,
            parameters,
            inputs,
            numbers,
            has_roots,
        };
        let varying = residual.varying(seed);
        let kept: Vec<Expr> = varying.iter().map(|k| outputs[1][*k]).collect();
        residual.names = varying.iter().map(|k| residual.names[*k].clone()).collect();
        // A sine has no values modulo primes.
        let alone = Tape::new(&graph, &outputs[2]);
        let mut rates = outputs[2].clone();
        let mut has_values = residual.defined(&alone, seed).into_iter();
        rates.retain(|_| has_values.next() == Some(true));
        (residual.rates, residual.has_all_rates) = (rates.len(), rates.len() == count);
        residual.tape = laid_out(&[outputs[0].clone(), kept, rates]);
        Ok(Some(residual))
    }

    /// Draws a prime modulo which the roots of the residual keep their ratios.
    pub fn prime(&self, rng: &mut ProofRng) -> Modulus {
        rng.prime_for(&self.numbers)
    }

    /// Whether the rates of the motion have values modulo primes.
    pub fn has_all_rates(&self) -> bool {
        self.has_all_rates
    }

    /// Tells which outputs of a tape with the same inputs have values at some points.
    fn defined(&self, tape: &Tape, seed: u64) -> Vec<bool> {
        let mut rng = SearchStream::Residuals.under(seed.wrapping_add(50));
        let modulus = self.prime(&mut rng);
        let mut evaluator: Evaluator<'_, Prime<RESIDUAL_LANES>> =
            Evaluator::new(tape, Prime::new([modulus; RESIDUAL_LANES]));
        let mut found: Vec<bool> = Vec::new();
        for _ in 0..TRIALS {
            let mut lane =
                || [self.parameters(&modulus, &mut rng), self.state(&modulus, &mut rng)].concat();
            let lanes: [Vec<u64>; RESIDUAL_LANES] = std::array::from_fn(|_| lane());
            let inputs: Vec<[u64; RESIDUAL_LANES]> =
                (0..self.inputs).map(|k| lanes.each_ref().map(|own| own[k])).collect();
            evaluator.run(&inputs);
            let seen: Vec<bool> =
                evaluator.outputs().map(|own| own.iter().any(|x| *x != UNDEFINED)).collect();
            found.resize(seen.len(), false);
            found.iter_mut().zip(seen).for_each(|(found, seen)| *found |= seen);
        }
        found
    }

    /// Returns the components that differ between draws, and from those before them.
    fn varying(&self, seed: u64) -> Vec<usize> {
        let mut rng = SearchStream::Residuals.under(seed);
        let modulus = self.prime(&mut rng);
        let mut evaluator = self.evaluator(modulus);
        let mut point = || {
            let parameters = self.parameters(&modulus, &mut rng);
            [parameters, self.state(&modulus, &mut rng)].concat()
        };
        let points: [Vec<u64>; RESIDUAL_LANES] = std::array::from_fn(|_| point());
        let seen = self.at(&mut evaluator, &points);
        let column = |k: usize| seen.each_ref().map(|seen| seen.components[k]);
        let is_new = |k: &usize| {
            let own = column(*k);
            own.iter().any(|x| *x != own[0]) && (0..*k).all(|j| column(j) != own)
        };
        (0..self.names.len()).filter(is_new).collect()
    }

    /// Returns the names of the components.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Number of components of the residual.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Draws the parameters at random; of a list the first value is taken.
    pub fn parameters(&self, modulus: &Modulus, rng: &mut ProofRng) -> Vec<u64> {
        random(&self.parameters, modulus, rng)
    }

    /// Whether each draw of the parameters is from a range rather than a list.
    pub fn free(&self) -> impl Iterator<Item = bool> {
        self.parameters.iter().map(|draw| !matches!(draw, Draw::OneOf(_)))
    }

    /// Draws a random state.
    pub fn state(&self, modulus: &Modulus, rng: &mut ProofRng) -> Vec<u64> {
        (self.parameters.len()..self.inputs).map(|_| rng.element(modulus)).collect()
    }

    /// Makes an evaluator modulo a prime.
    pub fn evaluator(&self, modulus: Modulus) -> Evaluator<'_, Prime<RESIDUAL_LANES>> {
        Evaluator::new(&self.tape, Prime::new([modulus; RESIDUAL_LANES]))
    }

    /// Evaluates residual and components at points, each given by draws of parameters and state.
    pub fn at(
        &self,
        evaluator: &mut Evaluator<'_, Prime<RESIDUAL_LANES>>,
        points: &[Vec<u64>; RESIDUAL_LANES],
    ) -> [ResidualPoint; RESIDUAL_LANES] {
        let inputs: Vec<[u64; RESIDUAL_LANES]> =
            (0..self.inputs).map(|input| std::array::from_fn(|lane| points[lane][input])).collect();
        evaluator.run(&inputs);
        let values: Vec<&[u64; RESIDUAL_LANES]> = evaluator.outputs().collect();
        std::array::from_fn(|lane| {
            let (values, rates) = values.split_at(values.len() - self.rates);
            let (residual, components) = values.split_at(self.height);
            let residual: Vec<u64> = residual.iter().map(|block| block[lane]).collect();
            let is_defined = residual.iter().chain(rates.iter().map(|own| &own[lane]));
            let is_defined = is_defined.into_iter().all(|x| *x != UNDEFINED);
            ResidualPoint {
                residual: is_defined.then_some(residual),
                components: components.iter().map(|block| block[lane]).collect(),
            }
        })
    }
}
