//! Coordinates of a Lagrangian system: positions and independent velocities.
//!
//! Constraints that are linear in the velocities are solved for as many of them. An angle φ of which only sines
//! and cosines occur becomes t = tan φ/2, and a position x of which only exponentials e^(n r x) with whole n
//! occur becomes u = e^(r x), so that the equations are rational.

use num_dual::Dual;

use super::exponentials::logarithm;
use super::spheres::UnitVectors;
use super::unwound::{Replaceable, rational, twice_the_arctangent};
use crate::SearchError;
use crate::echelon::Echelon;
use crate::streams::SearchStream;
use crate::symbols::symbolised;
use liouville::case::Case;
use liouville::graph::{Evaluator, Expr, Graph, Step, Tape, record};
use liouville::mechanics::elimination::solve_by_minors;
use liouville::mechanics::{Draw, Lagrangian, Model, Phase, VariableRole};
use liouville::number::prime::{Prime, UNDEFINED};
use liouville::number::rational::Rational;
use liouville::order::StableOrder;
use liouville::proof::root_numbers;
use liouville::scalar::Scalar;

/// Number of points at which constraints are looked at.
const TRIALS: usize = 64;

/// Coordinates of a Lagrangian system.
#[derive(Clone, Debug)]
pub struct Mechanical {
    /// Components of the state that are positions, and what each is in place of.
    positions: Vec<(usize, Place)>,
    /// Components that are independent velocities.
    free: Vec<usize>,
    /// Components that are velocities given by the constraints.
    dependent: Vec<usize>,
    /// Meaning of each draw of a parameter.
    turned: Vec<Place>,
    /// Unit vectors, of which two components stand for their coordinates.
    units: UnitVectors,
}

/// Number in place of a variable.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Place {
    /// The variable itself.
    Plain,
    /// tan φ/2.
    Angle,
    /// The exponential of a multiple of the variable.
    Exponential {
        /// Rational factor of the multiple.
        number: Rational,
        /// A parameter that is a further factor.
        letter: Option<Letter>,
    },
}

/// A parameter by its draw and by its component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Letter {
    draw: usize,
    component: usize,
}

impl Place {
    /// The variable, from the number in place of it; letters are looked up.
    fn value<T: Scalar>(&self, x: T, letters: &dyn Fn(Letter) -> T) -> T {
        match self {
            Place::Plain => x,
            Place::Angle => twice_the_arctangent(x),
            Place::Exponential { number, letter } => logarithm(x, number, letter.map(letters)),
        }
    }

    /// Rate of the number, from that of the variable.
    fn rate(&self, x: Expr, rate: Expr, parameters: &[Expr]) -> Expr {
        match self {
            Place::Plain => rate,
            Place::Angle => {
                let one = Expr::rational(&Rational::from(1));
                rate * Expr::rational(&Rational::new(1, 2)) * (one + x * x)
            }
            Place::Exponential { number, letter } => {
                let rate = rate * x * Expr::rational(number);
                letter.map_or(rate, |letter| rate * parameters[letter.component])
            }
        }
    }
}

impl Mechanical {
    /// Finds coordinates of a system whose level consists of constraints that are linear in the velocities
    /// and independent.
    pub fn of(case: &Case, lagrangian: &Lagrangian) -> Result<Self, SearchError> {
        let model = &case.model;
        let allowed = if lagrangian.vakonomic { 0 } else { lagrangian.constraints.len() };
        let units = UnitVectors::of(model, lagrangian)?;
        if model.level.len() != allowed + units.count() || units.others.len() != allowed {
            return Err(SearchError::Unsplit(match lagrangian.vakonomic {
                true => {
                    "the constraints of a vakonomic system are a level set, which leaves no independent \
                     velocities"
                }
                false => {
                    "the system has a constraint on the coordinates alone, or a level of its own; write it in \
                     coordinates of the surface, such as two angles for a sphere"
                }
            }));
        }
        let (mut positions, mut velocities, mut start) = (Vec::new(), Vec::new(), 0);
        for (role, variable) in lagrangian.roles.iter().zip(&model.state) {
            let own = start..start + variable.len();
            match role {
                VariableRole::Coordinate(_) | VariableRole::Carried(_) | VariableRole::Time => {
                    positions.extend(own);
                }
                VariableRole::Velocity | VariableRole::Multiplier(_) => velocities.extend(own),
            }
            start += variable.len();
        }
        if positions.is_empty() {
            return Err(SearchError::Unsplit("it has velocities alone, and no positions"));
        }
        let draws = model.parameter_draws();
        let mut turned = turned(model, &draws)?;
        let angles = turned.split_off(draws.len());
        let place = |component: &usize| match units.contains(*component) {
            true => (*component, Place::Plain),
            false => (*component, angles[*component].clone()),
        };
        positions.retain(|component| !units.is_last(*component));
        let plain = Self {
            positions: positions.iter().map(place).collect(),
            free: velocities,
            dependent: Vec::new(),
            turned,
            units,
        };
        match allowed {
            0 => Ok(plain),
            _ => plain.constrained(case),
        }
    }

    /// Solves the constraints for as many velocities.
    fn constrained(mut self, case: &Case) -> Result<Self, SearchError> {
        let velocities = std::mem::take(&mut self.free);
        let slopes = Slopes::of(&case.model, &self, &velocities)?;
        let pivots = slopes.pivots()?;
        self.dependent = pivots.into_iter().map(|place| velocities[place]).collect();
        self.free = velocities;
        self.free.retain(|place| !self.dependent.contains(place));
        Ok(self)
    }

    /// Number of positions.
    pub fn positions(&self) -> usize {
        self.positions.len()
    }

    /// Number of independent velocities.
    pub fn velocities(&self) -> usize {
        self.free.len()
    }

    /// Whether a number is in place of what is drawn for a parameter.
    pub fn is_turned(&self, draw: usize) -> bool {
        self.turned.get(draw).is_some_and(|own| *own != Place::Plain)
    }

    /// Whether a number is in place of another variable.
    pub fn is_substituted(&self) -> bool {
        self.positions
            .iter()
            .map(|(_, own)| own)
            .chain(&self.turned)
            .any(|own| *own != Place::Plain)
    }

    /// Makes draws of the parameters from coordinates of them.
    pub fn draws<T: Scalar>(&self, given: &[T]) -> Vec<T> {
        let own = given.iter().zip(&self.turned);
        own.map(|(x, turned)| turned.value(*x, &|letter| given[letter.draw])).collect()
    }

    /// Returns the state at a point.
    pub fn state<T: Scalar>(&self, model: &Model, parameters: &[T], point: &[T]) -> Vec<T> {
        let mut state = vec![T::zero(); model.dimension()];
        let (positions, velocities) = point.split_at(self.positions.len());
        for ((component, own), x) in self.positions.iter().zip(positions) {
            state[*component] = own.value(*x, &|letter| parameters[letter.component]);
        }
        self.units.lift(&mut state);
        for (component, x) in self.free.iter().zip(velocities) {
            state[*component] = *x;
        }
        if self.dependent.is_empty() {
            return state;
        }
        // f_k + Σ ∂f_k/∂w_d w_d = 0, from the f_k where the w_d are 0.
        let parameters: Vec<Dual<T>> = parameters.iter().map(|p| Dual::from_re(*p)).collect();
        let along = |component: usize| -> Vec<Dual<T>> {
            let mut lifted: Vec<Dual<T>> = state.iter().map(|x| Dual::from_re(*x)).collect();
            lifted[component] = lifted[component].derivative();
            constraints(model, &parameters, &lifted, &self.units.others)
        };
        let columns: Vec<Vec<Dual<T>>> = self.dependent.iter().map(|d| along(*d)).collect();
        let count = columns.len();
        let rows: Vec<Vec<T>> =
            (0..count).map(|k| columns.iter().map(|column| column[k].eps).collect()).collect();
        let sides: Vec<T> = columns[0].iter().map(|f| -f.re).collect();
        let solved = solve_by_minors(&rows, &[sides]).remove(0);
        for (component, x) in self.dependent.iter().zip(solved) {
            state[*component] = x;
        }
        state
    }

    /// Returns the rates of the coordinates.
    pub fn rates(&self, parameters: &[Expr], point: &[Expr], field: &[Expr]) -> Vec<Expr> {
        let coordinate = |component: usize| {
            let place = self.positions.iter().position(|(own, _)| *own == component);
            place.map(|place| point[place])
        };
        let of_unit = |component: usize| {
            let first = self.units.first(component)?;
            let coordinates = [coordinate(first)?, coordinate(first + 1)?];
            self.units.rate(component, coordinates, field)
        };
        let own = self.positions.iter().zip(point);
        let positions = own.map(|((component, own), x)| {
            of_unit(*component).unwrap_or_else(|| own.rate(*x, field[*component], parameters))
        });
        positions.chain(self.free.iter().map(|component| field[*component])).collect()
    }
}

/// Derivatives of constraints by velocities, functions of the parameters and the positions.
struct Slopes {
    graph: Graph,
    /// The derivatives by each velocity.
    columns: Vec<Vec<Expr>>,
}

impl Slopes {
    /// Records the derivatives; fails unless the constraints are linear in the velocities.
    fn of(model: &Model, at: &Mechanical, velocities: &[usize]) -> Result<Self, SearchError> {
        let draws = model.parameter_draws().len();
        let count = draws + model.dimension();
        let (graph, slopes) = record(count, |inputs| {
            let (given, state) = inputs.split_at(draws);
            let (parameters, _) = model.make_parameters(&at.draws(given));
            let parameters: Vec<Dual<Expr>> =
                parameters.iter().map(|p| Dual::from_re(*p)).collect();
            let mut state: Vec<Dual<Expr>> = state.iter().map(|x| Dual::from_re(*x)).collect();
            for (component, own) in &at.positions {
                let letter = |letter: Letter| parameters[letter.component];
                state[*component] = own.value(state[*component], &letter);
            }
            at.units.lift(&mut state);
            let along = |component: &usize| {
                let mut lifted = state.clone();
                lifted[*component] = lifted[*component].derivative();
                constraints(model, &parameters, &lifted, &at.units.others)
            };
            let columns = velocities.iter().flat_map(along);
            columns.map(|slope| slope.eps).collect::<Vec<Expr>>()
        })?;
        let (graph, slopes) = rational(&graph, &slopes)?;
        // Others are random numbers: where these are none, the rates have no series.
        let (graph, slopes) = match symbolised(&graph, std::slice::from_ref(&slopes)) {
            Some((graph, slopes)) => (graph, slopes.concat()),
            None => (graph, slopes),
        };
        let is_velocity = |input: &usize| *input >= draws && velocities.contains(&(*input - draws));
        if slopes.iter().any(|slope| graph.inputs_of(*slope).iter().any(is_velocity)) {
            return Err(SearchError::Unsplit("the constraints are not linear in the velocities"));
        }
        let size = (slopes.len() / velocities.len().max(1)).max(1);
        Ok(Self { columns: slopes.chunks(size).map(<[Expr]>::to_vec).collect(), graph })
    }

    /// Chooses as many velocities as there are constraints, such that the constraints can be solved for
    /// them: first those with constant derivatives. Fails with `NoSeries` if the derivatives have values
    /// at no point modulo a prime, as where a variable occurs in a sine and outside of it.
    fn pivots(&self) -> Result<Vec<usize>, SearchError> {
        let slopes = self.columns.concat();
        let count = self.columns.first().map_or(0, Vec::len);
        let mut has_values = false;
        let mut order: Vec<usize> = (0..self.columns.len()).collect();
        order.order_by_key(|column| {
            let varies = |slope: &&Expr| self.graph.constant_value(**slope).is_none();
            self.columns[*column].iter().filter(varies).count()
        });
        let mut rng = SearchStream::Constraints.under(0);
        let modulus = rng.prime_for(&root_numbers(&self.graph));
        let tape = Tape::new(&self.graph, &slopes);
        let mut evaluator = Evaluator::new(&tape, Prime::new([modulus; 1]));
        let found = (0..TRIALS).find_map(|_| {
            let point: Vec<[u64; 1]> =
                (0..self.graph.inputs()).map(|_| [rng.element(&modulus)]).collect();
            evaluator.run(&point);
            let values: Vec<u64> = evaluator.outputs().map(|value| value[0]).collect();
            if values.contains(&UNDEFINED) {
                return None;
            }
            has_values = true;
            let mut echelon = Echelon::new(count, modulus);
            let own = |column: &usize| values[column * count..(column + 1) * count].to_vec();
            let mut pivots = order.clone();
            pivots.retain(|column| echelon.push(own(column)));
            (pivots.len() == count).then_some(pivots)
        });
        found.ok_or(match has_values {
            true => SearchError::Unsplit(
                "no velocities were found for which the constraints can be solved",
            ),
            false => SearchError::NoSeries,
        })
    }
}

/// The left sides of some equations of the level.
pub fn constraints<T: Scalar>(
    model: &Model,
    parameters: &[T],
    state: &[T],
    equations: &[usize],
) -> Vec<T> {
    let phase = Phase::new(model, parameters, state);
    let all: Vec<_> = model.level_formulas().collect();
    equations.iter().map(|equation| phase.configuration.scalar(all[*equation])).collect()
}

/// Tells what numbers stand in place of the draws and the components of the state: of angles where sines or
/// cosines occur in the equations, and of exponents where exponentials do.
fn turned(model: &Model, draws: &[Draw]) -> Result<Vec<Place>, SearchError> {
    let count = draws.len() + model.dimension();
    let (graph, (values, parameters)) = record(count, |inputs| {
        let (given, state) = inputs.split_at(draws.len());
        let (parameters, _) = model.make_parameters(given);
        let phase = Phase::new(model, &parameters, state);
        let formulas = model.dynamics().into_iter().chain(model.level_formulas());
        let values = formulas.flat_map(|f| phase.evaluate(f).components()).collect::<Vec<Expr>>();
        (values, parameters)
    })?;
    let mut found = vec![Place::Plain; count];
    // Inputs beyond the state stand for values of ∫.
    let is_free = |input: usize| {
        let is_range = |draw: &Draw| matches!(draw, Draw::Within(_) | Draw::Of(..));
        input < count && draws.get(input).is_none_or(is_range)
    };
    let (own, ..) = Replaceable::of(&graph, &values, &is_free, &|input| input < draws.len())?;
    for (input, rate) in own.exponents {
        let component = |draw: usize| {
            let is_own = |own: &Expr| matches!(graph.step(graph.place(*own)), Step::Input(input) if input == draw);
            parameters.iter().position(is_own).map(|component| Letter { draw, component })
        };
        let letter = match rate.letter {
            None => None,
            // A component is needed for its value, and its own one is itself.
            Some(draw) => match component(draw).filter(|_| !own.angles.contains(&draw)) {
                None => continue,
                letter => letter,
            },
        };
        found[input] = Place::Exponential { number: rate.number, letter };
    }
    own.angles.into_iter().for_each(|input| found[input] = Place::Angle);
    Ok(found)
}
