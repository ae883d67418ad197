//! Leading forms of polynomial integrals.
//!
//! Let v_d be the part of highest degree of a polynomial field v = v_d + …. The part F_n of highest degree
//! of a polynomial integral of degree n satisfies v_d(F_n) = 0: it is the part of degree n + d − 1 of
//! v(F). Where no form of degree n does, there is no integral of that degree.

use std::sync::{Arc, Mutex, PoisonError};

use super::super::echelon::Echelon;
use super::super::local::random;
use super::super::{Halt, SearchError};
use super::adjoin::PolynomialField;
use super::setting::OrbitSetting;
use crate::streams::SearchStream;
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::Phase;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::proof::{ProofRng, root_numbers, statement_seed};

/// Number of multiples of a state: the highest degree of a field is one less.
const MULTIPLES: usize = 8;
/// Number of successive dependent rows after which the rank is accepted.
const SPARE_ROWS: usize = 4;

/// The part of highest degree of a field, at random states and one choice of the parameters modulo a
/// prime.
pub struct LeadingField {
    tape: Tape,
    modulus: Modulus,
    parameters: Vec<u64>,
    dimension: usize,
    degree: usize,
    /// Variables of the forms.
    variables: Vec<usize>,
    /// Highest degree of the forms.
    highest: u32,
    states: Mutex<LeadingStates>,
    halt: Halt,
}

/// States so far, which all monomials share, and the random numbers of the next one.
struct LeadingStates {
    rng: ProofRng,
    /// `None` where the field has no value.
    made: Vec<Option<Arc<LeadingState>>>,
}

/// A state, with the leading field there.
struct LeadingState {
    /// v_d(x)/x for each variable.
    growth: Vec<u64>,
    /// Powers of each variable.
    powers: Vec<Vec<u64>>,
}

impl LeadingState {
    /// Computes the derivative of the monomial with these exponents along the leading field.
    fn derivative(&self, m: &Modulus, exponents: impl Iterator<Item = u32>) -> u64 {
        let (mut monomial, mut slope) = (m.one(), 0);
        for ((powers, growth), exponent) in self.powers.iter().zip(&self.growth).zip(exponents) {
            monomial = m.mul(monomial, powers[exponent as usize]);
            slope = m.add(slope, m.mul(m.integer(exponent.into()), *growth));
        }
        m.mul(monomial, slope)
    }
}

impl LeadingField {
    /// Records the field in some variables, for forms up to a degree; `None` on a level, or if the degree
    /// of the field is too high.
    pub fn of(
        setting: &OrbitSetting<'_>,
        field: &PolynomialField,
        variables: &[usize],
        highest: u32,
    ) -> Result<Option<Self>, SearchError> {
        let terms = variables.iter().flat_map(|variable| &field.rates[*variable]);
        let degree = terms.map(|term| term.iter().sum::<i64>()).max().unwrap_or(0);
        let degree = usize::try_from(degree).unwrap_or(MULTIPLES);
        if setting.is_on_level() || degree >= MULTIPLES {
            return Ok(None);
        }
        let model = &setting.case.model;
        let (draws, dimension) = (model.parameter_draws(), model.dimension());
        let (graph, rates) = record(draws.len() + dimension, |inputs| {
            let (given, state) = inputs.split_at(draws.len());
            let (parameters, _) = model.make_parameters(given);
            let field = Phase::new(model, &parameters, state).field().to_vec();
            variables.iter().map(|variable| field[*variable]).collect::<Vec<_>>()
        })?;
        let seed = statement_seed(setting.effort.options.seed, &graph, &rates);
        let mut rng = SearchStream::Equations.under(seed);
        let modulus = rng.prime_for(&root_numbers(&graph));
        let parameters = random(&draws, &modulus, &mut rng);
        let (tape, halt) = (Tape::new(&graph, &rates), setting.effort.halt.clone());
        let rng = SearchStream::Combinations.under(seed);
        let states = Mutex::new(LeadingStates { rng, made: Vec::new() });
        let variables = variables.to_vec();
        Ok(Some(Self {
            tape,
            modulus,
            parameters,
            dimension,
            degree,
            variables,
            highest,
            states,
            halt,
        }))
    }

    /// Whether no form of these monomials, all of one degree, is an integral of the leading field.
    pub fn excludes(&self, forms: &[&Vec<u32>]) -> Result<bool, SearchError> {
        let m = self.modulus;
        let mut echelon = Echelon::new(forms.len(), m);
        let (mut rank, mut dependent) = (0, 0);
        for place in 0.. {
            if rank == forms.len() || dependent == SPARE_ROWS {
                break;
            }
            self.halt.check()?;
            let Some(state) = self.state(place) else { return Ok(false) };
            let entry = |exponents: &&Vec<u32>| {
                let own = self.variables.iter().map(|k| exponents[*k]);
                state.derivative(&m, own)
            };
            match echelon.push(forms.iter().map(entry).collect()) {
                true => (rank, dependent) = (rank + 1, 0),
                false => dependent += 1,
            }
        }
        Ok(rank == forms.len())
    }

    /// Returns the state of a place, whose predecessors have been asked for; `None` if the field has no
    /// value there.
    fn state(&self, place: usize) -> Option<Arc<LeadingState>> {
        let mut states = self.states.lock().unwrap_or_else(PoisonError::into_inner);
        if place == states.made.len() {
            let next = self.next_state(&mut states.rng).map(Arc::new);
            states.made.push(next);
        }
        states.made.get(place)?.clone()
    }

    /// Draws the next state; `None` if the field has no value there.
    fn next_state(&self, rng: &mut ProofRng) -> Option<LeadingState> {
        let (m, variables) = (self.modulus, &self.variables);
        let state: Vec<u64> = (0..self.dimension).map(|_| rng.element(&m)).collect();
        let multiples = |x: &u64| std::array::from_fn(|s| m.mul(m.integer(s as u64), *x));
        let given = self.parameters.iter().map(|value| [*value; MULTIPLES]);
        let inputs: Vec<[u64; MULTIPLES]> = given.chain(state.iter().map(multiples)).collect();
        let mut evaluator = Evaluator::new(&self.tape, Prime::new([m; MULTIPLES]));
        evaluator.run(&inputs);
        let rates: Vec<u64> = evaluator.outputs().map(|own| self.highest(own)).collect();
        if rates.contains(&UNDEFINED) || variables.iter().any(|k| state[*k] == 0) {
            return None;
        }
        let growth = |(k, rate): (&usize, &u64)| m.mul(*rate, m.inverse(state[*k]));
        let growth = variables.iter().zip(&rates).map(growth).collect();
        let powers = |k: &usize| {
            let next = |power: &u64| Some(m.mul(*power, state[*k]));
            std::iter::successors(Some(m.one()), next).take(self.highest as usize + 1).collect()
        };
        Some(LeadingState { growth, powers: variables.iter().map(powers).collect() })
    }

    /// Coefficient of the highest power of s of a polynomial with the values at s = 0, 1, 2, …, up to a
    /// factor: its difference of this order.
    fn highest(&self, values: &[u64; MULTIPLES]) -> u64 {
        if values.contains(&UNDEFINED) {
            return UNDEFINED;
        }
        let mut differences = values[..=self.degree].to_vec();
        for _ in 0..self.degree {
            differences =
                differences.windows(2).map(|pair| self.modulus.sub(pair[1], pair[0])).collect();
        }
        differences[0]
    }
}
