//! Parts read from the recording of a case: its field, known integrals and further functions, as
//! polynomials of one ring.

use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::{Expr, Graph, Step};
use liouville::mechanics::Chart;
use liouville::mechanics::calculus::DualPoint;

use super::super::super::terms::recorded;
use super::super::super::{Effort, FurtherTerm, SearchError};
use super::absence;
use super::polynomial::RingPolynomial;
use super::read::StepReader;
use super::ring::{AdjoinedRing, Divided};

/// Largest number of times that arguments are divided.
const TRIES: usize = 8;

/// A ring with the polynomials that are read from one recording.
pub struct Read {
    /// Ring of the functions.
    pub ring: AdjoinedRing,
    /// Polynomials.
    pub parts: ReadParts,
}

/// Polynomials that are read from one recording.
pub struct ReadParts {
    /// Rates of the components of the state.
    pub field: Vec<RingPolynomial>,
    /// Divergence of the field.
    pub divergence: RingPolynomial,
    /// Known integrals by their places among those given.
    pub known: Vec<(usize, RingPolynomial)>,
    /// Functions that are 0 on the level set of the case.
    pub level: Vec<RingPolynomial>,
    /// Further functions; `None` for those that are no polynomials of the ring.
    pub further: Vec<Option<RingPolynomial>>,
    /// Number of variables of the ring that the field and its divergence need.
    pub of_field: usize,
    /// Number of exponentials, sines and cosines that they contain.
    pub functions_of_field: usize,
    /// Components of the state whose rates are others, with these.
    pub moved_by: Vec<(usize, usize)>,
}

/// Functions at a point of phase space.
type Functions<'f> = &'f dyn Fn(&DualPoint<'_, Expr>) -> Vec<Expr>;

/// Reads the field and known integrals as polynomials; unless `all`, without integrals that contain
/// functions of which nothing can be counted.
pub fn read(
    case: &Case,
    effort: &Effort,
    known: (&[Formula], bool),
    divided: Vec<Divided>,
) -> Result<Option<Read>, SearchError> {
    read_with(case, effort, known, divided, &|_| Vec::new())
}

/// Reads further functions as well.
pub fn read_with(
    case: &Case,
    effort: &Effort,
    (known, all): (&[Formula], bool),
    divided: Vec<Divided>,
    further: Functions<'_>,
) -> Result<Option<Read>, SearchError> {
    let model = &case.model;
    if !matches!(case.chart, Chart::Free | Chart::Equations) {
        return Ok(None);
    }
    let known: Vec<(usize, &Formula)> =
        known.iter().enumerate().filter(|(_, own)| own.value_type() == Type::Scalar).collect();
    let typed: Vec<Formula> = effort
        .terms
        .iter()
        .filter_map(|term: &FurtherTerm| term.read(model).ok())
        .filter(|formula| formula.value_type() == Type::Scalar)
        .collect();
    let (graph, (field, divergence, (known, typed, level), further)) = recorded(case, |jet| {
        let known: Vec<_> =
            known.iter().map(|(place, own)| (*place, jet.phase.scalar(own))).collect();
        let typed: Vec<_> = typed.iter().map(|own| jet.phase.scalar(own)).collect();
        let level = model.level.iter().map(|own| jet.phase.level_function(&own.function));
        let level: Vec<_> = level.collect();
        (jet.phase.field().to_vec(), jet.divergence(), (known, typed, level), further(jet))
    })?;
    let parameters = model.free_components();
    if graph.inputs() > parameters + model.dimension() {
        return Ok(None);
    }
    let place = |own: &_| graph.place(*own);
    let read = |ring: &mut AdjoinedRing| -> Option<ReadParts> {
        let mut reader = StepReader::new(&graph);
        let mut each = |own: &[Expr], ring: &mut AdjoinedRing| -> Option<Vec<RingPolynomial>> {
            own.iter().map(|own| reader.read(place(own), ring)).collect()
        };
        let (field, level) = (each(&field, ring)?, each(&level, ring)?);
        let divergence = reader.read(place(&divergence), ring)?;
        let (of_field, functions_of_field) = (ring.atoms.len(), ring.functions.len());
        for own in &typed {
            reader.read(place(own), ring);
        }
        let mut integrals = Vec::new();
        for (k, own) in &known {
            let before = (ring.clone(), reader.clone());
            let made = reader.read(place(own), ring);
            let added = &ring.atoms[before.0.atoms.len()..];
            if !ring.is_refined && !all && added.iter().any(absence::is_beyond) {
                (*ring, reader) = before;
                continue;
            }
            integrals.extend(made.map(|made| (*k, made)));
        }
        let further = further.iter().map(|own| reader.read(place(own), ring)).collect();
        let moved_by = Vec::new();
        let known = integrals;
        Some(ReadParts {
            field,
            divergence,
            known,
            level,
            further,
            of_field,
            functions_of_field,
            moved_by,
        })
    };
    let made = refined((parameters, model.dimension()), divided, read);
    Ok(made.map(|(ring, parts)| {
        let moved_by = moved_by(&graph, &field, parameters);
        Read { ring, parts: ReadParts { moved_by, ..parts } }
    }))
}

/// Reads something with a ring, and again where an argument has to be divided; the ring starts with the
/// components of parameters and state.
pub fn refined<R>(
    (parameters, state): (usize, usize),
    mut divided: Vec<Divided>,
    read: impl Fn(&mut AdjoinedRing) -> Option<R>,
) -> Option<(AdjoinedRing, R)> {
    for _ in 0..TRIES {
        let mut ring = AdjoinedRing::new(parameters, state, std::mem::take(&mut divided));
        let found = read(&mut ring);
        if ring.is_refined {
            divided = ring.divided;
            continue;
        }
        return found.map(|found| (ring, found));
    }
    None
}

/// Components of the state whose rates are other components, each with that component.
fn moved_by(graph: &Graph, field: &[Expr], first: usize) -> Vec<(usize, usize)> {
    let other = |(place, rate): (usize, &Expr)| match graph.step(graph.place(*rate)) {
        Step::Input(input) if input >= first && input != first + place => {
            Some((place, input - first))
        }
        _ => None,
    };
    field.iter().enumerate().filter_map(other).collect()
}
