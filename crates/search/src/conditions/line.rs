//! Zeros of a residual along random lines of parameters.

use super::residual::{RESIDUAL_LANES, Residual, ResidualPoint};
use crate::streams::SearchStream;
use crate::{Effort, Halt, SearchError};
use liouville::graph::Evaluator;
use liouville::number::prime::{Modulus, Prime};
use liouville::number::prime::{Polynomial, PrimePolynomials};
use liouville::proof::ProofRng;

/// Number of states whose residuals are compared.
const STATES: usize = 3;
/// Number of further states at which a zero is checked.
const CHECKS: usize = 16;
/// Smallest number of values of a residual along the line, followed by the largest.
const LEAST: usize = 16;
const MOST_RESIDUALS: usize = 1024;

/// Number of draws of states until the residual has values: a constant root exists for half of
/// them.
const DRAWS: usize = 16;

/// The reason why there are no numerators.
enum Gap {
    /// The residual has too few values on the line.
    Undefined,
    /// The values do not belong to a fraction of low degree.
    NoFraction,
}

/// The result along one line.
pub enum LineResult {
    /// The residual vanishes everywhere.
    Always,
    /// The residual is not a fraction of a degree within reach.
    Unknown,
    /// Components of the parameters at the points where it vanishes for all states, and the degree
    /// of the condition along the line.
    Points(Vec<Vec<u64>>, usize),
}

/// Random lines for one residual modulo one prime.
pub struct Lines<'r> {
    residual: &'r Residual,
    evaluator: Evaluator<'r, Prime<RESIDUAL_LANES>>,
    modulus: Modulus,
    rng: ProofRng,
    /// Number of values that sufficed before.
    enough: usize,
    /// Whether each draw moves along a line.
    moving: Vec<bool>,
    halt: Halt,
}

impl<'r> Lines<'r> {
    /// Prepares lines modulo a random prime; `None` if the residual is not a fraction along any.
    ///
    /// Draws under a root stay fixed along a line if the residual is not a fraction otherwise.
    pub fn new(residual: &'r Residual, effort: &Effort) -> Result<Option<Self>, SearchError> {
        let mut rng = SearchStream::Lines.under(effort.options.seed);
        let modulus = residual.prime(&mut rng);
        let evaluator = residual.evaluator(modulus);
        let free: Vec<bool> = residual.free().collect();
        let (moving, halt) = (free.clone(), effort.halt.clone());
        let mut lines = Self { residual, evaluator, modulus, rng, enough: LEAST, moving, halt };
        if !lines.is_fraction() {
            let alone = |draw: usize| (0..free.len()).map(|j| j == draw && free[j]).collect();
            let each = (0..free.len()).map(|draw| {
                lines.moving = alone(draw);
                free[draw] && lines.is_fraction()
            });
            lines.moving = each.collect::<Vec<bool>>();
        }
        let is_fraction = lines.moving.contains(&true) && lines.is_fraction();
        lines.halt.check()?;
        Ok(is_fraction.then_some(lines))
    }

    /// Whether the residual is a fraction along a line.
    fn is_fraction(&mut self) -> bool {
        self.enough = LEAST;
        let (origin, slope) = self.line();
        self.somewhere(&origin, &slope).is_some()
    }

    /// Finds the numerators for a random state at which the residual has values.
    fn somewhere(&mut self, origin: &[u64], slope: &[u64]) -> Option<Vec<Polynomial>> {
        for _ in 0..DRAWS {
            let state = self.residual.state(&self.modulus, &mut self.rng);
            match self.numerators(origin, slope, &state) {
                Ok(numerators) => return Some(numerators),
                Err(Gap::Undefined) => {}
                Err(Gap::NoFraction) => return None,
            }
        }
        None
    }

    /// Draws a random line.
    fn line(&mut self) -> (Vec<u64>, Vec<u64>) {
        let m = self.modulus;
        let origin = self.residual.parameters(&m, &mut self.rng);
        let slope = self.moving.iter().map(|moving| match moving {
            true => self.rng.element(&m),
            false => 0,
        });
        (origin, slope.collect())
    }

    /// Returns the prime modulus.
    pub fn modulus(&self) -> Modulus {
        self.modulus
    }

    /// Examines another line.
    pub fn next(&mut self) -> Result<LineResult, SearchError> {
        let found = self.examined();
        self.halt.check()?;
        Ok(found)
    }

    fn examined(&mut self) -> LineResult {
        let m = self.modulus;
        let ring = PrimePolynomials(m);
        let (origin, slope) = self.line();
        let mut common: Polynomial = Vec::new();
        for _ in 0..STATES {
            let Some(numerators) = self.somewhere(&origin, &slope) else {
                return LineResult::Unknown;
            };
            for numerator in numerators {
                common = ring.common(&common, &numerator);
            }
            if common.len() == 1 {
                return LineResult::Points(Vec::new(), 0);
            }
        }
        if common.is_empty() {
            return LineResult::Always;
        }
        let degree = common.len() - 1;
        let roots = ring.roots(&common);
        let points = roots.into_iter().filter_map(|t| self.confirmed(&m.along(&origin, &slope, t)));
        LineResult::Points(points.collect(), degree)
    }

    /// Finds the numerators of the residual's components, for one state.
    fn numerators(
        &mut self,
        origin: &[u64],
        slope: &[u64],
        state: &[u64],
    ) -> Result<Vec<Polynomial>, Gap> {
        let m = self.modulus;
        let ring = PrimePolynomials(m);
        let mut values: Vec<(u64, Vec<u64>)> = Vec::new();
        let mut wanted = self.enough;
        loop {
            let mut tries = 0;
            while values.len() < wanted {
                // The caller looks at the clock before it draws conclusions.
                self.halt.check().map_err(|_| Gap::NoFraction)?;
                tries += 1;
                if tries > DRAWS * wanted || (tries == DRAWS && values.is_empty()) {
                    return Err(Gap::Undefined);
                }
                let places: [u64; RESIDUAL_LANES] = std::array::from_fn(|_| self.rng.element(&m));
                let points = places.map(|t| [&m.along(origin, slope, t), state].concat());
                let seen = self.residual.at(&mut self.evaluator, &points);
                let defined = places.into_iter().zip(seen);
                values.extend(defined.filter_map(|(t, seen)| Some((t, seen.residual?))));
            }
            let component = |k: usize| -> Option<Polynomial> {
                self.halt.check().ok()?;
                let value = |f: &dyn Fn(u64) -> u64| -> Vec<(u64, u64)> {
                    values.iter().map(|(t, residual)| (*t, f(residual[k]))).collect()
                };
                // With a root as a factor its square is a fraction.
                let plain = ring.fraction(&value(&|x| x));
                plain.or_else(|| ring.fraction(&value(&|x| m.mul(x, x)))).map(|(above, _)| above)
            };
            let all: Option<Vec<Polynomial>> = (0..self.residual.height()).map(component).collect();
            if let Some(all) = all {
                self.enough = wanted;
                return Ok(all);
            }
            if wanted >= MOST_RESIDUALS {
                return Err(Gap::NoFraction);
            }
            wanted *= 2;
        }
    }

    /// Returns the components at parameters where the residual vanishes at further states too.
    fn confirmed(&mut self, parameters: &[u64]) -> Option<Vec<u64>> {
        let m = self.modulus;
        let (mut zeros, mut components) = (0, None);
        for _ in 0..8 * CHECKS {
            let points = std::array::from_fn(|_| {
                [parameters, &self.residual.state(&m, &mut self.rng)].concat()
            });
            for ResidualPoint { residual, components: own } in
                self.residual.at(&mut self.evaluator, &points)
            {
                match residual {
                    Some(residual) if residual.iter().any(|x| *x != 0) => return None,
                    Some(_) => (zeros, components) = (zeros + 1, Some(own)),
                    None => {}
                }
            }
            if zeros >= CHECKS {
                return components;
            }
        }
        None
    }
}
