//! A claim recorded once over the coordinates of a chart, evaluated in balls and tested in prime
//! fields.

use num_dual::Dual;
use num_traits::{One, Zero};

use super::claim::{Parts, level_gradients};
use super::failure::{AssertionFailure, ChartProof, DrawnState, FieldWitness};
use super::notation::TestState;
use liouville::graph::{Evaluator, Expr, Graph, Tape, record};
use liouville::mechanics::elimination::gram_determinant;
use liouville::mechanics::{Draw, DrawSource, Range};
use liouville::number::Enclosing;
use liouville::number::arb::ArbBall;
use liouville::number::ball::Ball;
use liouville::number::rational::Rational;
use liouville::proof::{Certificate, Extent, Group, GroupOutcome, Prover};
use liouville::verdict::antiderivative_value;

/// Precision in bits of the second evaluation at a state, where balls over f64 contain 0.
const SECOND_BITS: u32 = 256;
/// Seed of primes, points and neighbours.
const SEED: u64 = 1;
/// Number of nearby states evaluated after a refutation in prime fields.
const NEIGHBOURS: u64 = 32;

/// A claim as a graph whose inputs are the coordinates of a chart.
pub struct RecordedField {
    graph: Graph,
    /// Premises, followed by the residual of the claim.
    rows: Vec<RecordedComponent>,
    point: Vec<Expr>,
    /// Value that is not 0 where the chart fills its level.
    filling: Expr,
}

/// One component that must vanish.
struct RecordedComponent {
    what: &'static str,
    component: usize,
    is_premise: bool,
    value: Expr,
}

/// Midpoint and radius of a ball, absent where the value is undefined.
type Enclosure = Option<(f64, f64)>;

impl RecordedField {
    /// Records the residual and the premises at the point of a place.
    pub fn new<const N: usize>(
        place: &impl TestState<N>,
        residual: impl FnOnce([Expr; N]) -> Parts<Expr>,
        premises: impl FnOnce([Expr; N]) -> Parts<Expr>,
    ) -> Result<Self, AssertionFailure> {
        let (graph, (rows, point, filling)) = record(place.coordinates().len(), |u| {
            let x = place.point(u);
            let mut rows = rows(premises(x), true);
            rows.extend(self::rows(residual(x), false));
            (rows, x.to_vec(), filling(place, u, x))
        })?;
        Ok(Self { graph, rows, point, filling })
    }

    /// Fails if an enclosure excludes 0, or if a value is undefined.
    ///
    /// A ball over f64 that contains 0, or is undefined, is computed again in 256 bits.
    pub fn look(&self, coordinates: &[f64]) -> Result<(), AssertionFailure> {
        let numbers = exact(coordinates).ok_or_else(|| self.undefined(0, coordinates))?;
        let values: Vec<Expr> = self.rows.iter().map(|row| row.value).collect();
        let coarse = enclosures(&Ball::<1>, &self.graph, &values, &numbers);
        self.refute(&coarse, coordinates)?;
        let fine = enclosures(&ArbBall::new(SECOND_BITS), &self.graph, &values, &numbers);
        self.refute(&fine, coordinates)?;
        match fine.iter().position(|(enclosure, _)| enclosure.is_none()) {
            Some(row) => Err(self.undefined(row, coordinates)),
            None => Ok(()),
        }
    }

    fn refute(
        &self,
        found: &[(Enclosure, bool)],
        coordinates: &[f64],
    ) -> Result<(), AssertionFailure> {
        for (row, (enclosure, excludes_zero)) in self.rows.iter().zip(found) {
            if let (Some(enclosure), true) = (*enclosure, *excludes_zero) {
                let at = self.state(coordinates);
                let RecordedComponent { what, component, .. } = *row;
                let witness = Box::new(FieldWitness { what, component, enclosure, at });
                return Err(match row.is_premise {
                    true => AssertionFailure::Premise(witness),
                    false => AssertionFailure::Refuted(witness),
                });
            }
        }
        Ok(())
    }

    /// Fails where the chart does not fill its level.
    pub fn check_chart(&self, coordinates: &[f64]) -> Result<(), AssertionFailure> {
        let excludes_zero = exact(coordinates).is_some_and(|numbers| {
            enclosures(&ArbBall::new(SECOND_BITS), &self.graph, &[self.filling], &numbers)[0].1
        });
        excludes_zero.then_some(()).ok_or_else(|| AssertionFailure::Chart(self.state(coordinates)))
    }

    /// Proves that all rows vanish, in prime fields.
    pub fn prove(&self, coordinates: &[f64]) -> Result<ChartProof, AssertionFailure> {
        // A proof is about a connected part of the chart on which no radicand and no modulus has a
        // zero: one state determines the signs of all.
        let numbers = exact(coordinates).unwrap_or_default();
        let extents: Vec<Extent> = numbers.iter().map(|x| Extent::between(x, x)).collect();
        let prover = Prover { sources: &[], extents: &extents, seed: SEED };
        let groups: Vec<Group> = self.rows.iter().map(|row| Group::of(vec![row.value])).collect();
        let outcomes = prover.prove(&self.graph, &groups)?;
        let mut proof: Option<Certificate> = None;
        for (row, outcome) in self.rows.iter().zip(outcomes) {
            let what = row.what;
            match outcome {
                GroupOutcome::Zero(found) => {
                    proof = Some(proof.map_or(found, |before| before.and(found)));
                }
                GroupOutcome::NonZero(_) => {
                    self.look_around(coordinates)?;
                    return Err(AssertionFailure::RefutedInFields { what });
                }
                GroupOutcome::Silent(why) => return Err(AssertionFailure::Unproved { what, why }),
                GroupOutcome::Void | GroupOutcome::Partial => {
                    let why = "it has no value".to_string();
                    return Err(AssertionFailure::Unproved { what, why });
                }
            }
        }
        let nothing =
            || AssertionFailure::Unproved { what: "nothing", why: "nothing was said".to_string() };
        proof.map(ChartProof).ok_or_else(nothing)
    }

    /// Evaluates states near the given one, and fails at the first that refutes.
    fn look_around(&self, coordinates: &[f64]) -> Result<(), AssertionFailure> {
        let step = Draw::Within(Range::between((-1, 8), (1, 8)));
        let steps = DrawSource::new(&vec![step; coordinates.len()]);
        for index in 0..NEIGHBOURS {
            let steps = steps.state(SEED, index);
            let moved = coordinates.iter().zip(&steps).map(|(x, step)| x + step.to_f64().0);
            match self.look(&moved.collect::<Vec<f64>>()) {
                Ok(()) | Err(AssertionFailure::Undefined { .. }) => {}
                refuted => return refuted,
            }
        }
        Ok(())
    }

    fn undefined(&self, row: usize, coordinates: &[f64]) -> AssertionFailure {
        let what = self.rows.get(row).map_or("the state", |row| row.what);
        AssertionFailure::Undefined { what, at: self.state(coordinates) }
    }

    fn state(&self, coordinates: &[f64]) -> DrawnState {
        let point = exact(coordinates).map(|numbers| {
            let found = enclosures(&Ball::<1>, &self.graph, &self.point, &numbers);
            found.iter().map(|(ball, _)| ball.map_or(f64::NAN, |(mid, _)| mid)).collect()
        });
        DrawnState { coordinates: coordinates.to_vec(), point: point.unwrap_or_default() }
    }
}

fn rows(parts: Parts<Expr>, is_premise: bool) -> Vec<RecordedComponent> {
    let row = |what, (component, value)| RecordedComponent { what, component, is_premise, value };
    parts
        .into_iter()
        .flat_map(|(what, values)| values.into_iter().enumerate().map(move |x| row(what, x)))
        .collect()
}

/// Computes det(J Jᵀ + G Gᵀ) of the chart's derivative J and the level's gradients G, which are
/// orthogonal to each other: 0 exactly where the chart misses some direction in the level, or the
/// level functions are dependent.
fn filling<const N: usize>(place: &impl TestState<N>, u: &[Expr], x: [Expr; N]) -> Expr {
    let gradients = level_gradients(place, x);
    let columns = (0..u.len()).map(|k| {
        let along = |j: usize| if j == k { Expr::one() } else { Expr::zero() };
        let moved: Vec<_> = u.iter().enumerate().map(|(j, u)| Dual::new(*u, along(j))).collect();
        place.point(&moved).map(|x| x.eps).to_vec()
    });
    let all: Vec<Vec<Expr>> = columns.chain(gradients).collect();
    let rows: Vec<Vec<Expr>> =
        (0..N).map(|i| all.iter().map(|column| column[i]).collect()).collect();
    gram_determinant(&rows)
}

/// Returns the exact values of f64s, if all are finite.
fn exact(coordinates: &[f64]) -> Option<Vec<Rational>> {
    coordinates.iter().map(|x| Rational::from_f64(*x)).collect()
}

/// Encloses values at a state; each flag tells whether the ball excludes 0.
fn enclosures<D: Enclosing + Clone>(
    domain: &D,
    graph: &Graph,
    values: &[Expr],
    numbers: &[Rational],
) -> Vec<(Enclosure, bool)> {
    let tape = Tape::new(graph, values);
    let mut evaluator = Evaluator::new(&tape, domain.clone());
    let free = (0..graph.inputs().saturating_sub(numbers.len())).map(antiderivative_value);
    let inputs: Vec<D::Block> =
        numbers.iter().cloned().chain(free).map(|x| domain.constant(&x)).collect();
    evaluator.run(&inputs);
    evaluator.outputs().map(|block| (D::enclosure(block, 0), D::excludes_zero(block, 0))).collect()
}
