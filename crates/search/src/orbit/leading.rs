//! Leading forms of polynomial integrals.
//!
//! Let v_d be the part of highest degree of a polynomial field v = v_d + …. The part F_n of highest degree
//! of a polynomial integral of degree n satisfies v_d(F_n) = 0: it is the part of degree n + d − 1 of
//! v(F). Where no form of degree n does, there is no integral of that degree.

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
    rng: ProofRng,
    /// States so far, which all monomials share.
    states: Vec<LeadingState>,
    halt: Halt,
}

/// A state, with the leading field there.
struct LeadingState {
    /// v_d(x)/x for each variable.
    growth: Vec<u64>,
    /// Powers of each variable so far.
    powers: Vec<Vec<u64>>,
}

impl LeadingState {
    /// Computes the derivative of the monomial with these exponents along the leading field.
    fn derivative(&mut self, m: &Modulus, exponents: impl Iterator<Item = u32>) -> u64 {
        let (mut monomial, mut slope) = (m.one(), 0);
        for ((powers, growth), exponent) in self.powers.iter_mut().zip(&self.growth).zip(exponents)
        {
            while powers.len() <= exponent as usize {
                powers.push(m.mul(powers[powers.len() - 1], powers[1]));
            }
            monomial = m.mul(monomial, powers[exponent as usize]);
            slope = m.add(slope, m.mul(m.integer(exponent.into()), *growth));
        }
        m.mul(monomial, slope)
    }
}

impl LeadingField {
    /// Records the field in some variables; `None` on a level, or if its degree is too high.
    pub fn of(
        setting: &OrbitSetting<'_>,
        field: &PolynomialField,
        variables: &[usize],
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
        let states = Vec::new();
        Ok(Some(Self { tape, modulus, parameters, dimension, degree, rng, states, halt }))
    }

    /// Whether no form of these monomials, all of one degree in the variables, is an integral of the
    /// leading field.
    pub fn excludes(
        &mut self,
        variables: &[usize],
        forms: &[&Vec<u32>],
    ) -> Result<bool, SearchError> {
        let m = self.modulus;
        let mut echelon = Echelon::new(forms.len(), m);
        let (mut rank, mut dependent) = (0, 0);
        for place in 0.. {
            if rank == forms.len() || dependent == SPARE_ROWS {
                break;
            }
            self.halt.check()?;
            if place == self.states.len() {
                let Some(next) = self.next_state(variables) else { return Ok(false) };
                self.states.push(next);
            }
            let state = &mut self.states[place];
            let entry = |exponents: &&Vec<u32>| {
                let own = variables.iter().map(|k| exponents[*k]);
                state.derivative(&m, own)
            };
            match echelon.push(forms.iter().map(entry).collect()) {
                true => (rank, dependent) = (rank + 1, 0),
                false => dependent += 1,
            }
        }
        Ok(rank == forms.len())
    }

    /// Draws the next state; `None` if the field has no value there.
    fn next_state(&mut self, variables: &[usize]) -> Option<LeadingState> {
        let m = self.modulus;
        let state: Vec<u64> = (0..self.dimension).map(|_| self.rng.element(&m)).collect();
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
        let powers = variables.iter().map(|k| vec![m.one(), state[*k]]).collect();
        Some(LeadingState { growth, powers })
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
