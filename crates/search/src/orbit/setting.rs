//! Random points of a case modulo a prime, their orbits, and relations along them.

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::graph::{Evaluator, Tape};
use liouville::mechanics::Draw;
use liouville::number::GOLDEN;
use liouville::number::prime::{Modulus, Prime, UNDEFINED};
use liouville::verdict::Sampler;

use super::super::ansatz::Coordinates;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::Echelon;
use super::super::local::{random, sign};
use super::super::streams::SearchStream;
use super::super::terms::recorded;
use super::super::{Effort, SearchError};
use super::adjoin::Extension;
use super::conic::ConicShape;
use super::draws::without_ranges;
use super::level_shape::LevelShape;
use super::limits::StepsLeft;
use super::monomials::{self, MonomialSeries};
use super::primes;
use super::tangents::Tangents;
use super::taylor::Flow;
use liouville::formula::Formula;

/// Number of orders beyond those that the unknowns take: accidents have probability p⁻⁸.
pub const SPARE_ORDERS: usize = 8;
/// Number of primes of each kind.
const PRIMES: u64 = 8;
/// Number of points drawn until an orbit has a series.
const TRIES: u64 = 16;
/// Largest number of combinations of listed values.
const MOST_COMBINATIONS: usize = 64;
/// Number of values of a parameter that is a small whole number.
const SMALL: u64 = 64;
/// Number of points drawn until one has a value, roots included, of fields without roots and with.
const DRAWS: [usize; 2] = [512, 8192];

/// A point of phase space modulo a prime.
#[derive(Clone, Debug)]
pub struct PrimePhasePoint {
    /// Components of the free parameters.
    pub parameters: Vec<u64>,
    /// Components of the state.
    pub state: Vec<u64>,
}

/// A case whose orbits are expanded modulo primes.
pub struct OrbitSetting<'c> {
    /// Case that is searched.
    pub case: &'c Case,
    /// Case whose functions are further variables here.
    pub origin: Option<ExtendedCase<'c>>,
    /// Limits of the search.
    pub effort: &'c Effort,
    /// Field of the case.
    pub flow: Flow,
    /// Directions of the state and the level.
    pub tangents: Tangents,
    /// Components of the state as terms.
    pub terms: Vec<Formula>,
    /// Relations between adjoined functions, where they are circles and hyperbolas alone, or a sphere.
    pub conic: Option<ConicShape>,
    /// Form of the level, where lines or conics lie on it.
    pub shape: Option<LevelShape>,
    /// Steps that may still be taken for coefficients which depend on the parameters.
    pub steps: StepsLeft,
    points: Points,
    coordinates: Vec<Formula>,
    primes: Vec<Modulus>,
    split_primes: Vec<Modulus>,
}

/// A case with the extension that is searched in its place.
#[derive(Clone, Copy)]
pub struct ExtendedCase<'c> {
    /// Case itself.
    pub case: &'c Case,
    /// Its functions as variables.
    pub extension: &'c Extension,
}

/// A point with the Taylor coefficients of its orbit, component by component.
pub type Orbit = (PrimePhasePoint, Vec<Vec<u64>>);

/// The map from random numbers to parameters and states.
struct Points {
    tape: Tape,
    draws: Vec<Draw>,
    /// Number of draws for the parameters.
    of_parameters: usize,
    /// Number of components of the free parameters.
    parameters: usize,
    /// Coordinates of the parameters as functions of parameters and state.
    coordinates: Tape,
}

impl<'c> OrbitSetting<'c> {
    /// Records the extension of a case; the text is the reason why it has no orbits modulo primes.
    pub fn extended(
        case: &'c Case,
        extension: &'c Extension,
        effort: &'c Effort,
    ) -> Result<Result<Self, String>, SearchError> {
        let made = Self::of(&extension.case, effort)?;
        let tangents = Tangents::of(&extension.case, &extension.axes)?;
        let origin = Some(ExtendedCase { case, extension });
        let conic = extension.conic();
        Ok(made.map(|own| Self { origin, tangents, conic, shape: None, ..own }))
    }

    /// Records a case; the text is the reason why it has no orbits modulo primes.
    pub fn of(case: &'c Case, effort: &'c Effort) -> Result<Result<Self, String>, SearchError> {
        let model = &case.model;
        let Some(flow) = Flow::of(case)? else {
            let what = if model.system.is_map() { "map" } else { "field" };
            let functions = Flow::missing(case)?;
            return Ok(Err(format!(
                "the {what} has no values modulo a prime, as it contains {functions}"
            )));
        };
        let terms = model.state_formulas()?;
        let sampler = Sampler::new(case, &LevelSubset::level(model), effort.options.seed)?;
        if sampler.is_numerical() {
            return Ok(Err(SearchError::NoChart.to_string()));
        }
        let Coordinates { names: named, radicands } = Coordinates::of(case)?;
        let (graph, values) = recorded(case, |jet| {
            named.iter().map(|term| jet.phase.scalar(term)).collect::<Vec<_>>()
        })?;
        let parameters = model.free_components();
        let points = Points {
            tape: without_ranges(&sampler)?,
            draws: sampler.recipes().to_vec(),
            of_parameters: sampler.parameter_draws(),
            parameters,
            coordinates: Tape::new(&graph, &values),
        };
        let seed = effort.options.seed;
        let prime = |number| Coordinates::prime(&radicands, seed, number);
        let primes = (0..PRIMES).map(prime).collect();
        let split_primes = primes::split(seed, PRIMES as usize, &radicands);
        let mut setting = Self {
            case,
            origin: None,
            effort,
            flow,
            tangents: Tangents::of(case, &[])?,
            terms,
            conic: None,
            shape: None,
            steps: StepsLeft::of(effort),
            points,
            coordinates: named,
            primes,
            split_primes,
        };
        if setting.is_on_level() && setting.flow.is_rational_in_state && !setting.flow.is_map {
            setting.shape = LevelShape::of(&setting)?;
            let sphere = setting.shape.iter().find(|own| !own.sphere.is_empty());
            setting.conic = sphere.map(|own| ConicShape::Sphere(own.sphere.clone()));
        }
        Ok(Ok(setting))
    }

    /// Number of components of the state.
    pub fn dimension(&self) -> usize {
        self.terms.len()
    }

    /// Whether states are restricted to a level.
    pub fn is_on_level(&self) -> bool {
        !self.case.model.level.is_empty()
    }

    /// Keeps the monomials that no relation between adjoined functions writes in others.
    pub fn standard(&self, mut monomials: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
        if let Some(origin) = self.origin {
            monomials.retain(|own| origin.extension.is_standard(own));
        }
        monomials
    }

    /// The same on the level of the case, where its shape is known, in the variables of a list.
    pub fn independent(&self, monomials: Vec<Vec<u32>>, variables: &[usize]) -> Vec<Vec<u32>> {
        let mut all = self.standard(monomials);
        if let Some(shape) = &self.shape {
            all.retain(|own| shape.is_independent(own, variables));
        }
        all
    }

    /// Whether polynomials are found on lines of states, or on conics: the field is rational there. Roots of
    /// numbers and parameters are coefficients like others; theorems ask for a rational field themselves.
    pub fn has_lines(&self) -> bool {
        (!self.is_on_level() || self.shape.is_some())
            && self.flow.is_rational_in_state
            && !self.flow.is_map
    }

    /// Whether a parameter has a list of several values.
    pub fn has_lists(&self) -> bool {
        let draws = self.case.model.parameter_draws();
        draws.iter().any(|draw| matches!(draw, Draw::OneOf(values) if values.len() > 1))
    }

    /// Makes choice `index` of the parameters modulo the prime with number `prime`.
    pub fn at(&self, prime: u64, index: u64) -> Option<PrimePoint> {
        self.within(*self.primes.get(prime as usize)?, index, false)
    }

    /// Makes choice `index` of the parameters modulo the prime p = 1 mod 840 with number `prime`, in
    /// whose field the roots of −1, 2, 3, 5 and 7 exist, and those of the numbers under roots.
    pub fn split(&self, prime: u64, index: u64) -> Option<PrimePoint> {
        self.within(*self.split_primes.get(prime as usize)?, index, false)
    }

    /// The same with small whole numbers as parameters, each in a range of its own.
    pub fn small(&self, prime: u64, index: u64) -> Option<PrimePoint> {
        self.within(*self.split_primes.get(prime as usize)?, index, true)
    }

    /// Makes choice `index` of the parameters in a given field.
    fn within(&self, modulus: Modulus, index: u64, is_small: bool) -> Option<PrimePoint> {
        let seed = self.effort.options.seed ^ index.wrapping_mul(GOLDEN);
        let mut rng = SearchStream::Orbits.under(seed);
        let own = &self.points.draws[..self.points.of_parameters];
        for _ in 0..TRIES {
            let mut parameters = random(own, &modulus, &mut rng);
            let is_free = |draw: &Draw| matches!(draw, Draw::Within(_) | Draw::Of(..));
            for place in (0..own.len()).filter(|place| is_small && is_free(&own[*place])) {
                let drawn = modulus.to_integer(parameters[place]) % SMALL;
                parameters[place] = modulus.integer(SMALL * (place as u64 + 1) + drawn);
            }
            let mut at = PrimePoint { modulus, parameters, coordinates: Vec::new() };
            let Some(point) = self.point(&at, u64::MAX) else { continue };
            let inputs = [point.parameters, point.state].concat();
            let Some(values) = run(&self.points.coordinates, modulus, &inputs) else { continue };
            at.coordinates = values;
            // A root of parameters exists for half of their values.
            if !matches!(self.orbit(&at, u64::MAX, 2), Ok(None)) {
                return Some(at);
            }
        }
        None
    }

    /// The same choice of the parameters with each combination of listed values; `None` if these are
    /// many, or have no images.
    pub fn with_listed(&self, at: &PrimePoint) -> Option<Vec<PrimePoint>> {
        let mut all = vec![at.clone()];
        for (place, draw) in self.points.draws[..self.points.of_parameters].iter().enumerate() {
            let values: Vec<u64> = match draw {
                Draw::OneOf(values) => {
                    values.iter().map(|own| at.modulus.rational(own)).collect::<Option<_>>()?
                }
                Draw::Sign => vec![at.modulus.one(), at.modulus.sub(0, at.modulus.one())],
                Draw::Within(_) | Draw::Of(..) => continue,
            };
            if all.len() * values.len() > MOST_COMBINATIONS {
                return None;
            }
            let with = |own: &PrimePoint, value: u64| {
                let mut own = own.clone();
                own.parameters[place] = value;
                own
            };
            all = all.iter().flat_map(|own| values.iter().map(move |x| with(own, *x))).collect();
        }
        Some(all)
    }

    /// The parameters' coordinates.
    pub fn coordinates(&self) -> &[Formula] {
        &self.coordinates
    }

    /// Draws the random point of a number.
    pub fn point(&self, at: &PrimePoint, number: u64) -> Option<PrimePhasePoint> {
        let seed = self.effort.options.seed ^ number.wrapping_mul(0xd1b5_4a32_d192_ed03);
        let mut rng = SearchStream::OrbitPoints.under(seed);
        let Points { tape, draws, of_parameters, parameters, .. } = &self.points;
        let (flow, halt) = (&self.flow, &self.effort.halt);
        for _ in 0..DRAWS[usize::from(!flow.is_rational)] {
            let own = draws[*of_parameters..].iter().map(|draw| match draw {
                Draw::Sign => sign(&at.modulus, &mut rng),
                _ => rng.element(&at.modulus),
            });
            let inputs: Vec<u64> = at.parameters.iter().copied().chain(own).collect();
            let Some(made) = run(tape, at.modulus, &inputs) else { continue };
            let (parameters, state) = made.split_at(*parameters);
            if flow.is_rational || flow.has_values(&at.modulus, parameters, state, halt) {
                let (parameters, state) = (parameters.to_vec(), state.to_vec());
                return Some(PrimePhasePoint { parameters, state });
            }
        }
        None
    }

    /// Expands the orbit through the random point of a number.
    pub fn orbit(
        &self,
        at: &PrimePoint,
        number: u64,
        orders: usize,
    ) -> Result<Option<Orbit>, SearchError> {
        for attempt in 0..TRIES {
            let Some(point) = self.point(at, number.wrapping_add(attempt << 32)) else {
                return Ok(None);
            };
            if let Some(orbit) = self.along(at, &point, orders)? {
                return Ok(Some((point, orbit)));
            }
        }
        Ok(None)
    }

    /// Expands the orbit through a point.
    pub fn along(
        &self,
        at: &PrimePoint,
        point: &PrimePhasePoint,
        orders: usize,
    ) -> Result<Option<Vec<Vec<u64>>>, SearchError> {
        let PrimePhasePoint { parameters, state } = point;
        self.flow.orbit(&at.modulus, parameters, state, orders, &self.effort.halt)
    }

    /// Whether the images of a map fill the space, or the level: det DΦ is not 0 at a random point.
    pub fn fills_space(&self) -> Result<bool, SearchError> {
        let kept = LevelSubset::level(&self.case.model).kept;
        let (graph, factor) = recorded(self.case, |jet| jet.expansion(&kept))?;
        let Some(at) = self.at(0, 0) else { return Ok(false) };
        let Some(point) = self.point(&at, 0) else { return Ok(false) };
        let inputs = [point.parameters, point.state].concat();
        let found = run(&Tape::new(&graph, &[factor]), at.modulus, &inputs);
        Ok(found.is_some_and(|values| values != [0]))
    }

    /// Finds the relations between monomials along the orbit of this number, in reduced form: each
    /// has coefficient 1 at its last monomial, which occurs in no other relation.
    pub fn relations(
        &self,
        at: &PrimePoint,
        number: u64,
        all: &[Vec<u32>],
    ) -> Result<Option<OrbitRelations>, SearchError> {
        let orders = all.len() + SPARE_ORDERS;
        let Some((point, orbit)) = self.orbit(at, number, orders)? else { return Ok(None) };
        let rows = match self.flow.is_map {
            true => monomials::at_points(&at.modulus, &orbit, all, &self.effort.halt)?,
            false => MonomialSeries::of(all).rows(&at.modulus, &orbit, &self.effort.halt)?,
        };
        let mut echelon = Echelon::new(all.len(), at.modulus);
        let mut dependent = 0;
        for row in rows {
            self.effort.halt.check()?;
            dependent = if echelon.push(row) { 0 } else { dependent + 1 };
            if dependent == SPARE_ORDERS {
                break;
            }
        }
        let series = (all.len() * orders) as f64 * orders as f64 / 2.0;
        self.steps.takes(series + echelon.steps() as f64);
        let free = echelon.free();
        let mut vectors = Vec::with_capacity(free.len());
        for own in &free {
            self.effort.halt.check()?;
            vectors.push(echelon.null_vector(*own));
        }
        Ok(Some(OrbitRelations { point, vectors, free }))
    }
}

/// Runs a tape at one point; `None` where an output has no value.
pub fn run(tape: &Tape, modulus: Modulus, inputs: &[u64]) -> Option<Vec<u64>> {
    let mut evaluator = Evaluator::new(tape, Prime::new([modulus]));
    let mut inputs: Vec<[u64; 1]> = inputs.iter().map(|x| [*x]).collect();
    inputs.resize(tape.inputs(), [modulus.one()]);
    evaluator.run(&inputs);
    let values: Vec<u64> = evaluator.outputs().map(|[value]| *value).collect();
    (!values.contains(&UNDEFINED)).then_some(values)
}

/// Relations between monomials along one orbit.
pub struct OrbitRelations {
    /// Point of the orbit.
    pub point: PrimePhasePoint,
    /// Coefficients of the relations.
    pub vectors: Vec<Vec<u64>>,
    /// Monomial of each relation's own.
    pub free: Vec<usize>,
}
