//! Maps x_i → c_i Π x_j^(a_ij), which are affine in the logarithms of the state.

use liouville::case::Case;
use liouville::mechanics::{Draw, Model, Range, SamplerSpec, System};
use liouville::number::rational::Rational;

use super::super::super::SearchError;
use super::super::super::terms::recorded;
use super::back::with_words;
use super::is_constant;
use super::polynomial::RingPolynomial;
use super::read::StepReader;
use super::ring::{AdjoinedRing, Atom};
use super::write::{RingNames, written};

/// Beginnings of the names of logarithms, and of those of coefficients.
const NAMES: [&str; 2] = ["aux", "shift"];

/// A map by monomials in the logarithms X_i = ln |x_i| of the state.
pub struct MonomialMap {
    /// The map X_i → Σ a_ij X_j + ln |c_i|, with these constants as parameters.
    pub case: Case,
    /// Exponents a_ij, where they are numbers.
    pub exponents: Option<Vec<Vec<Rational>>>,
    /// Coefficients c_i in the names of the map, where they are not 1.
    coefficients: Vec<Option<String>>,
}

impl MonomialMap {
    /// Reads a map without a level; `None` if some component is no monomial.
    pub fn of(case: &Case) -> Result<Option<Self>, SearchError> {
        let model = &case.model;
        if !matches!(model.system, System::Map(_)) || !model.level.is_empty() {
            return Ok(None);
        }
        let (parameters, dimension) = (model.free_components(), model.dimension());
        let (graph, images) = recorded(case, |jet| jet.phase.field().to_vec())?;
        if graph.inputs() > parameters + dimension {
            return Ok(None);
        }
        let mut ring = AdjoinedRing::new(parameters, dimension, Vec::new());
        let mut reader = StepReader::new(&graph);
        let read = images.iter().map(|own| reader.read(graph.place(*own), &mut ring));
        let Some(images) = read.collect::<Option<Vec<RingPolynomial>>>() else { return Ok(None) };
        let parted = images.iter().map(|own| ring.parted_monomial(own, parameters, dimension));
        let Some(parted) = parted.collect::<Option<Vec<_>>>() else { return Ok(None) };
        let names = RingNames::of(case, &ring).original;
        Ok(Some(Self::written(&parted, &names, (parameters, dimension))?))
    }

    fn written(
        images: &[(RingPolynomial, Vec<RingPolynomial>)],
        names: &[String],
        (parameters, dimension): (usize, usize),
    ) -> Result<Self, SearchError> {
        let one = RingPolynomial::constant(Rational::from(1));
        let coefficients: Vec<Option<String>> =
            images.iter().map(|(own, _)| (*own != one).then(|| written(own, names))).collect();
        let range = || SamplerSpec::Scalar(Draw::Within(Range::between((1, 2), (1, 1))));
        // A name with an index stands for the components of vectors and matrices.
        let own = |k: usize| format!("own{k}");
        let shift = |k: usize| coefficients[k].as_ref().map(|_| format!("{}{k}", NAMES[1]));
        let mut map = Model::map().title("logarithms");
        for name in (0..parameters).map(own).chain((0..dimension).filter_map(shift)) {
            map = map.parameter(&name, range());
        }
        let logarithm = |k: usize| format!("{}{k}", NAMES[0]);
        let inner: Vec<String> = (0..names.len()).map(own).collect();
        for (k, (_, exponents)) in images.iter().enumerate() {
            let terms = exponents.iter().enumerate().filter(|(_, own)| !own.is_zero());
            let terms =
                terms.map(|(j, own)| format!("({})*{}", written(own, &inner), logarithm(j)));
            let all: Vec<String> = terms.chain(shift(k)).collect();
            let sum = if all.is_empty() { "0".to_string() } else { all.join(" + ") };
            map = map.state(&logarithm(k), range(), sum.as_str());
        }
        let exponents = images
            .iter()
            .map(|(_, own)| own.iter().map(RingPolynomial::value).collect::<Option<Vec<_>>>());
        let exponents = exponents.collect();
        let case = map.build().map_err(SearchError::Unbuilt)?;
        Ok(Self { case, exponents, coefficients })
    }

    /// Writes a formula of the logarithms in the names of the map; `logarithms` are those of the state,
    /// and `parameters` the names of the parameters' components.
    pub fn back(&self, text: &str, logarithms: &[String], parameters: &[String]) -> String {
        with_words(text, &|word| {
            let number = |prefix: &str| word.strip_prefix(prefix)?.parse::<usize>().ok();
            let own = number(NAMES[0]).and_then(|k| logarithms.get(k).cloned());
            let own = own.or_else(|| {
                let coefficient = self.coefficients.get(number(NAMES[1])?)?.as_ref()?;
                Some(format!("ln(|{coefficient}|)"))
            });
            own.or_else(|| parameters.get(number("own")?).cloned())
        })
    }

    /// Coefficients c_i in the names of the map, where they are not 1.
    pub fn coefficients(&self) -> &[Option<String>] {
        &self.coefficients
    }
}

impl AdjoinedRing {
    /// Splits a monomial into its coefficient and the exponents of the components of the state.
    fn parted_monomial(
        &self,
        own: &RingPolynomial,
        parameters: usize,
        dimension: usize,
    ) -> Option<(RingPolynomial, Vec<RingPolynomial>)> {
        // What stands beside the variables is a sum where it depends on parameters.
        let (_, common, rest) = own.split()?;
        if !self.is_constant(&rest) {
            return None;
        }
        let mut exponents = vec![RingPolynomial::default(); dimension];
        let mut variables = RingPolynomial::constant(Rational::from(1));
        for (variable, power) in common.iter().filter(|(k, _)| !is_constant(&self.atoms[*k])) {
            let power = Rational::from(i64::from(*power));
            let state = |base: &RingPolynomial| match base.single()? {
                (own, value) if value.is_one() => match own.as_slice() {
                    [(k, 1)] if matches!(self.atoms[*k], Atom::State) => Some(*k),
                    _ => None,
                },
                _ => None,
            };
            let (place, exponent) = match &self.atoms[*variable] {
                Atom::State => (*variable, RingPolynomial::constant(power)),
                Atom::Root(base, order) => {
                    let share = Rational::new(1, i64::from(*order));
                    (state(base)?, RingPolynomial::constant(&power * &share))
                }
                Atom::Inverse(base, order) => {
                    let share = Rational::new(-1, i64::from(*order));
                    (state(base)?, RingPolynomial::constant(&power * &share))
                }
                Atom::Power(base, exponent, _) => (state(base)?, exponent.times_number(&power)),
                _ => return None,
            };
            let all_of_parameters = exponent.variables().iter().all(|k| *k < parameters);
            let slot = exponents.get_mut(place.checked_sub(parameters)?)?;
            *slot = slot.plus(&exponent, &Rational::from(1)).filter(|_| all_of_parameters)?;
            let factor = common.iter().filter(|(other, _)| other == variable).copied().collect();
            variables = variables.times(&RingPolynomial::term(factor, Rational::from(1)))?;
        }
        Some((own.over(&variables)?, exponents))
    }
}
