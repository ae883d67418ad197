//! Products of known integrals: how many there are of each degree in the velocities.

use num_dual::Dual;

use super::SearchError;
use super::ask::{holds, judged};
use super::local::Coordinates;
use super::{Effort, Report, ask};
use crate::case::Case;
use crate::formula::Formula;
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::Phase;
use crate::number::prime::{Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::proof::{Chance, reconstruct};

/// The highest degree that is recognised.
const MOST: usize = 16;

/// Independent integrals with their degrees in the velocities.
#[derive(Clone, Debug, Default)]
pub struct Generators(Vec<(String, u32)>);

impl Generators {
    /// The energy, where it is an integral.
    pub fn energy(case: &Case, effort: &Effort) -> Result<Self, SearchError> {
        let mut generators = Self::default();
        if case.model.vocabulary.find("energy").is_some() {
            let reports = judged(case, &["integral = \"energy\"".to_string()], effort)?;
            if reports.iter().any(holds) {
                generators.add(case, "energy", effort.options.seed)?;
            }
        }
        Ok(generators)
    }

    /// With all that was found, or is claimed.
    pub fn all(case: &Case, effort: &Effort, report: &Report) -> Result<Self, SearchError> {
        let mut generators = Self::energy(case, effort)?;
        let mut told: Vec<String> = report.formulas("integral").map(str::to_string).collect();
        for ask::Claimed { formula, .. } in &report.claimed {
            if ask::independent(case, &told, formula, effort)?.is_some() {
                told.push(formula.clone());
            }
        }
        for formula in told {
            generators.add(case, &formula, effort.options.seed)?;
        }
        Ok(generators)
    }

    /// Adds an integral if its degree can be told.
    fn add(&mut self, case: &Case, formula: &str, seed: u64) -> Result<(), SearchError> {
        if let Some(degree) = degree(case, formula, seed)?.filter(|degree| *degree > 0) {
            self.0.push((formula.to_string(), degree));
        }
        Ok(())
    }

    /// The formulas.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }

    /// The formulas with their degrees in the velocities.
    pub fn each(&self) -> impl Iterator<Item = (&str, u32)> {
        self.0.iter().map(|(name, degree)| (name.as_str(), *degree))
    }

    /// The products of this degree, or with `mixed` of at most it, as exponents of the formulas.
    pub fn exponents(&self, degree: u32, mixed: bool) -> Vec<Vec<u32>> {
        let mut found: Vec<(u32, Vec<u32>)> = vec![(0, Vec::new())];
        for (_, own) in &self.0 {
            let raised = |(total, powers): (u32, Vec<u32>)| {
                (0..=(degree - total) / own).map(move |power| {
                    (total + power * own, powers.iter().copied().chain([power]).collect())
                })
            };
            found = found.into_iter().flat_map(raised).collect();
        }
        let wanted = found.into_iter().filter(|(total, _)| mixed || *total == degree);
        wanted.map(|(_, powers)| powers).collect()
    }

    /// How many products have this degree; with `mixed`, how many at most it, 1 among them.
    pub fn products(&self, degree: u32, mixed: bool) -> usize {
        // ways[d]: products of degree d of the generators so far
        let mut ways = vec![0usize; degree as usize + 1];
        ways[0] = 1;
        for (_, own) in &self.0 {
            for d in *own as usize..ways.len() {
                ways[d] += ways[d - *own as usize];
            }
        }
        if mixed { ways.iter().sum() } else { ways[degree as usize] }
    }
}

/// The degree of a formula in the velocities at a random point modulo a prime; nothing if it is no
/// polynomial in them, or has no value there.
fn degree(case: &Case, formula: &str, seed: u64) -> Result<Option<u32>, SearchError> {
    let model = &case.model;
    let Ok(coordinates) = Coordinates::of(case) else { return Ok(None) };
    let Ok(formula) = Formula::parse(formula, &model.vocabulary) else { return Ok(None) };
    let all = model.vocabulary.with_abbreviations(&formula, &model.abbreviations);
    let draws = model.parameter_draws();
    let inputs = draws.len() + coordinates.count() + 1;
    let (graph, (outputs, moving)) = record(inputs, |inputs| {
        let (given, point) = inputs.split_at(draws.len());
        let (scale, point) = (point[point.len() - 1], &point[..point.len() - 1]);
        let (parameters, _) = model.make_parameters(given);
        let (positions, velocities) = point.split_at(coordinates.positions);
        let at = |factors: Vec<Dual<Expr>>| {
            let positions = positions.iter().map(|q| Dual::from_re(*q));
            let lifted: Vec<Dual<Expr>> = positions.chain(factors).collect();
            let parameters: Vec<Dual<Expr>> =
                parameters.iter().map(|p| Dual::from_re(*p)).collect();
            (coordinates.state(&lifted), parameters)
        };
        let (state, lifted) = at(velocities.iter().map(|w| Dual::new(*w, *w)).collect());
        let growing = Phase::new(model, &lifted, &state);
        // (w,∂ ln F/∂w) = n for a homogeneous F
        let growth = formula.logarithmic_derivative(&mut |symbol| growing.value(symbol));
        // An ∫ whose variable changes with the velocities has a degree that is not seen here.
        let integrals = all.iter().flat_map(|f| f.antiderivatives(&mut |s| growing.value(s)));
        let moving: Vec<Expr> = integrals.map(|(_, variable)| variable.eps).collect();
        let (state, lifted) = at(velocities.iter().map(|w| Dual::from_re(*w * scale)).collect());
        ([growth, Phase::new(model, &lifted, &state).scalar(&formula).re], moving)
    })?;
    if moving.iter().any(|rate| !graph.constant_value(*rate).is_some_and(|rate| rate.is_zero())) {
        return Ok(None);
    }
    let mut chance = Chance::new(seed, 42);
    let modulus = chance.prime(&[3, 5], &[2, 3]);
    let tape = Tape::new(&graph, &outputs);
    let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; MOST]));
    for _ in 0..64 {
        let mut values: Vec<[u64; MOST]> =
            (0..inputs - 1).map(|_| [chance.element(&modulus); MOST]).collect();
        values.push(std::array::from_fn(|s| modulus.integer(s as u64)));
        evaluator.run(&values);
        let found: Vec<[u64; MOST]> = evaluator.outputs().copied().collect();
        let homogeneous = (found[0][1] != UNDEFINED)
            .then(|| reconstruct(found[0][1], &modulus))
            .flatten()
            .and_then(|degree: Rational| degree.to_integer())
            .filter(|degree| (0..MOST as i64).contains(degree));
        if let Some(degree) = homogeneous {
            return Ok(u32::try_from(degree).ok());
        }
        if !found[1].contains(&UNDEFINED) {
            return Ok(polynomial_degree(found[1].to_vec(), |a, b| modulus.sub(a, b)));
        }
    }
    Ok(None)
}

/// The degree of the polynomial with these values at 0, 1, 2, …: after so many differences it is a
/// constant.
fn polynomial_degree(mut values: Vec<u64>, minus: impl Fn(u64, u64) -> u64) -> Option<u32> {
    for degree in 0..values.len() as u32 - 1 {
        if values.iter().all(|value| value == &values[0]) {
            return Some(degree);
        }
        values = values.windows(2).map(|pair| minus(pair[1], pair[0])).collect();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_are_counted() {
        let generators = Generators(vec![("E".into(), 2), ("F".into(), 2), ("G".into(), 1)]);
        // E², EF, F², EG², FG², G⁴
        assert_eq!(generators.products(4, false), 6);
        assert_eq!(generators.exponents(4, false).len(), 6);
        assert_eq!(generators.exponents(2, true).len(), 5);
        // 1, G, and E, F, G²
        assert_eq!(generators.products(2, true), 5);
    }

    #[test]
    fn degrees_come_from_differences() {
        let minus = |a: u64, b: u64| a.wrapping_sub(b);
        let cubes = (0..8u64).map(|x| x * x * x + 5).collect();
        assert_eq!(polynomial_degree(cubes, minus), Some(3));
        assert_eq!(polynomial_degree(vec![7; 8], minus), Some(0));
        let powers = (0..8).map(|x| 1 << x).collect();
        assert_eq!(polynomial_degree(powers, minus), None, "2^x is no polynomial");
    }
}
