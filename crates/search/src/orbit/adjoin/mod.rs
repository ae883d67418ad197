//! Functions of the state as further variables.
//!
//! ```text
//! plain        exponents of a field that is polynomial without further functions
//! polynomial   sparse polynomials with rational coefficients
//! atom         variables of the ring
//! odd_powers   polynomials that are odd powers of others
//! ring         which functions are adjoined, and what is written in them
//! rates        rates of the functions, and monomials that relations make superfluous
//! parts        what is read from a recording of the case
//! read         recorded formulas as polynomials of the ring
//! bases        denominators, radicands and other functions as factors
//! absence      the polynomials that a theorem of absence covers
//! share        degrees in the functions that a file writes, and in those of a ring
//! implied      relations between these that known integrals imply
//! equations, constrained  equations of a Lagrangian, solved for independent accelerations
//! explicit     their field as a case
//! reduction    normal form on circles
//! matrices     determinants and adjugates of polynomials
//! derivations  derivatives of integrals along symmetry fields and the fields of other integrals
//! logarithmic  maps by monomials, in the logarithms of the state
//! write        the extended field as a case, with the functions' relations as a level set
//! back         formulas of the extended case in the names of the case itself
//! parsed       texts taken apart at signs outside of brackets
//! ```
//!
//! Exponentials, sines and cosines, roots, logarithms, powers and denominators that occur in a field
//! have rates that are polynomials in them. So the field becomes a polynomial field of more
//! variables. What is found there is written in the names of the case, and judged as a claim about
//! it; nothing rests on the extension but the theorem of absence.

pub mod absence;
mod atom;
mod back;
mod bases;
mod constrained;
mod derivations;
mod equations;
mod explicit;
mod factored;
mod implied;
mod logarithmic;
mod matrices;
mod odd_powers;
pub mod parsed;
mod parts;
mod plain;
mod polynomial;
mod rates;
mod read;
mod reduction;
mod ring;
mod roots;
mod share;
mod write;

pub use self::write::{with_parameters, written as polynomial_text};

use liouville::case::{Case, ModelBuilder};
use liouville::formula::Formula;
use liouville::graph::Expr;
use liouville::mechanics::calculus::DualPoint;
use liouville::number::rational::Rational;

use self::absence::AdjoinedPolynomials;
use self::back::Back;
pub use self::back::{merged, with_signs};
use self::bases::{circles, factors};
pub use self::derivations::{FieldComponents, IntegralAlgebra};
pub use self::explicit::ExplicitField;
pub use self::factored::polynomial_factors;
pub use self::logarithmic::MonomialMap;
pub use self::parsed::{joined as joined_terms, terms as signed_terms};
use self::parts::{Read, ReadParts, read, read_with};
pub use self::plain::{PolynomialField, polynomial_field, reduced};
use self::polynomial::Monomial;
pub use self::polynomial::RingPolynomial;
pub use self::ring::Divided;
use self::ring::{AdjoinedRing, Atom, Of};
pub use self::roots::{has_independent_roots, root_steps, roots};
use self::write::RingNames;
use super::super::{Effort, SearchError};
use super::conic::{ConicRole, ConicShape};

/// Largest number of variables.
const VARIABLES: usize = 30;

/// A case whose state has the functions of its field as further components.
pub struct Extension {
    /// Extended case.
    pub case: Case,
    /// Rates of all variables along each component of the state of the case itself.
    pub axes: Vec<Vec<Formula>>,
    /// Divergence of the field of the case itself.
    pub divergence: Formula,
    /// Integrals that are known.
    pub known: Vec<Formula>,
    /// Darboux polynomials that are known, with their degrees.
    pub curves: Vec<(Formula, u32)>,
    /// Polynomials that a theorem of absence covers.
    pub class: Option<AdjoinedPolynomials>,
    /// The known integrals as polynomials of the ring, by their places among those given.
    read: Vec<(usize, RingPolynomial)>,
    ring: AdjoinedRing,
    /// Number of the functions of the ring that the field contains.
    functions_of_field: usize,
    /// Functions whose powers may be factors of densities and integrals.
    pub factors: Vec<Formula>,
    /// g, h and D of such functions g² − D h², with components g and h of the state and a number D.
    pub circles: Vec<[Formula; 3]>,
    back: Back,
    /// Exponentials by their names, with their arguments.
    exponentials: Vec<(String, Formula)>,
    /// Arguments of sines and cosines.
    angles: Vec<RingPolynomial>,
    /// Monomials of the extended state that relations between the functions write in others.
    leading: Vec<Monomial>,
    /// Names of inverses.
    inverses: Vec<String>,
    /// The extended field without its level.
    field: ModelBuilder,
    /// Names of the variables of the ring in the extended case.
    names: Vec<String>,
    /// Whether the case itself has a level.
    has_level: bool,
}

impl Extension {
    /// Writes a formula of the extended case in the names of the case itself.
    pub fn back(&self, formula: &Formula) -> String {
        self.back.rewritten(formula.text())
    }

    /// Writes an integral in the names of the case itself, up to a factor or as its inverse.
    pub fn back_integral(&self, formula: &Formula) -> String {
        self.back.integral(formula.text())
    }

    /// Describes the polynomials of a class up to a degree; `terms` are the components of the extended
    /// state.
    pub fn words(&self, terms: &[Formula], class: &AdjoinedPolynomials, degree: u32) -> String {
        let own = class.variables().into_iter().filter_map(|place| terms.get(place));
        let names: Vec<String> = own.map(|term| self.back(term)).collect();
        let addition = if class.is_linear { ", linear in each root" } else { "" };
        format!("polynomials in {} of degree at most {degree}{addition}", names.join(", "))
    }

    /// Whether no relation between the functions writes a monomial in others of its degree.
    pub fn is_standard(&self, monomial: &[u32]) -> bool {
        let divides = |own: &[(usize, u32)]| {
            own.iter().all(|(variable, power)| monomial[*variable] >= *power)
        };
        !self.leading.iter().any(|own| divides(own))
    }

    /// The extended field without the relations between its functions; `None` if these are exponentials
    /// and denominators alone.
    pub fn unbound(&self) -> Result<Option<Case>, SearchError> {
        let is_free = |atom: &Atom| matches!(atom, Atom::Exponential(_) | Atom::Inverse(..));
        let is_bound =
            |atom: &Atom| !is_constant(atom) && !is_free(atom) && !matches!(atom, Atom::State);
        let is_unbound = self.ring.atoms.iter().any(is_bound);
        let built = is_unbound.then(|| self.field.clone().build()).transpose();
        built.map_err(SearchError::Unbuilt)
    }

    /// The relations between the functions of a case without a level, if they are circles and hyperbolas
    /// alone, and some.
    pub fn conic(&self) -> Option<ConicShape> {
        let atoms = &self.ring.atoms;
        let shifted =
            |place: usize| place - atoms[..place].iter().filter(|a| is_constant(a)).count();
        let role = |atom: &Atom| match atom {
            Atom::State => Some(ConicRole::Free),
            Atom::Sine(_) => Some(ConicRole::Sine),
            Atom::Cosine(_) => Some(ConicRole::Cosine),
            Atom::Exponential(_) => Some(ConicRole::Exponential),
            Atom::ExponentialOf(_, powers) => match powers.as_slice() {
                [(other, -1)] => Some(ConicRole::InverseOf(shifted(*other))),
                _ => None,
            },
            _ => None,
        };
        let varying = atoms.iter().filter(|atom| !is_constant(atom));
        let roles: Vec<ConicRole> = varying.map(role).collect::<Option<_>>()?;
        let binds = |own: &ConicRole| matches!(own, ConicRole::Sine | ConicRole::InverseOf(_));
        (!self.has_level && roles.iter().any(binds)).then_some(ConicShape::Functions(roles))
    }

    /// The first of the given integrals, the energy if there is one, where it is read in the ring.
    pub fn first_known(&self) -> Option<&Formula> {
        let (place, _) = self.read.first()?;
        self.known.first().filter(|_| *place == 0)
    }

    /// Adjoined exponentials.
    pub fn exponentials(&self) -> impl Iterator<Item = &str> {
        self.exponentials.iter().map(|(name, _)| name.as_str())
    }

    /// Names of the variables of the ring in the extended case.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Whether a formula contains a denominator as a variable.
    pub fn has_inverse(&self, formula: &Formula) -> bool {
        self.inverses.iter().any(|name| formula.uses(name))
    }

    /// Sine of the argument of a cosine by its name, or the other way round.
    pub fn partner(&self, name: &Formula) -> Option<Formula> {
        let place = self.names.iter().position(|own| own == name.text())?;
        let is_partner = |atom: &Atom| match (&self.ring.atoms[place], atom) {
            (Atom::Sine(a), Atom::Cosine(b)) | (Atom::Cosine(a), Atom::Sine(b)) => a == b,
            _ => false,
        };
        let other = self.ring.atoms.iter().position(is_partner)?;
        self.case.formula(&self.names[other]).ok()
    }

    /// Half of each argument of a sine or cosine.
    pub fn halves(&self) -> Vec<Divided> {
        let angles = self.angles.iter();
        angles.map(|argument| Divided { argument: argument.clone(), by: 2 }).collect()
    }

    /// Argument of an adjoined exponential; `None` of another formula.
    pub fn exponent(&self, formula: &Formula) -> Option<&Formula> {
        let own = self.exponentials.iter().find(|(name, _)| name == formula.text());
        own.map(|(_, argument)| argument)
    }
}

/// Adjoins the functions of a field and of known integrals, if there are any, without integrals of whose
/// functions nothing can be counted, as logarithms; `None` if the field
/// contains functions whose rates are not polynomials in them, or has a level set.
pub fn always_extended(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
) -> Result<Option<Extension>, SearchError> {
    if !case.model.level.is_empty() {
        return Ok(None);
    }
    match read(case, effort, (known, false), Vec::new())? {
        Some(made) => written(case, made, effort.options.seed),
        None => Ok(None),
    }
}

/// Adjoins the functions of a field; `None` if it is polynomial, or contains functions whose rates are
/// not polynomials in them. Functions in the integrals `known` are adjoined as well; `curves` are Darboux
/// polynomials.
pub fn extended(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
    curves: &[Formula],
    divided: Vec<Divided>,
) -> Result<Option<Extension>, SearchError> {
    let further = |jet: &DualPoint<'_, Expr>| -> Vec<Expr> {
        curves.iter().map(|own| jet.phase.scalar(own)).collect()
    };
    let made = read_with(case, effort, (known, true), divided, &further)?;
    let Some(made) = made else { return Ok(None) };
    match functions(&made.ring) > 0 || names_are_foreign(case) {
        true => written(case, made, effort.options.seed),
        false => Ok(None),
    }
}

/// Number of functions that are adjoined.
fn functions(ring: &AdjoinedRing) -> usize {
    let is_plain = |atom: &&Atom| {
        matches!(atom, Atom::Parameter | Atom::State | Atom::Constant(Of::Inverse(_) | Of::Root(_)))
    };
    ring.atoms.len() - ring.atoms.iter().filter(is_plain).count()
}

fn written(case: &Case, read: Read, seed: u64) -> Result<Option<Extension>, SearchError> {
    let ring = &read.ring;
    if functions(ring) + case.model.dimension() > VARIABLES {
        return Ok(None);
    }
    let names = RingNames::of(case, ring);
    let ReadParts { field, divergence, known, level, further, functions_of_field, .. } = read.parts;
    let Some(rates) = ring.rates(&field) else { return Ok(None) };
    let Some((field, whole)) = write::case(case, ring, (&rates, &level), &names) else {
        return Ok(None);
    };
    let extended = whole.build().map_err(SearchError::Unbuilt)?;
    let formula =
        |own: &RingPolynomial| extended.formula(&write::written(own, &names.extended)).ok();
    let Some(divergence) = formula(&divergence) else { return Ok(None) };
    let Some(axes) = axes(ring, case.model.dimension(), formula) else { return Ok(None) };
    let written = known.iter().filter_map(|(_, own)| formula(own)).collect();
    let curves = further.iter().flatten().filter_map(|own| Some((formula(own)?, ring.degree(own))));
    let curves = curves.collect();
    let exponentials =
        ring.atoms.iter().zip(&names.extended).filter_map(|(atom, name)| match atom {
            Atom::Exponential(argument) | Atom::ExponentialOf(argument, _) => {
                Some((name.clone(), formula(argument)?))
            }
            _ => None,
        });
    let is_inverse = |atom: &Atom| matches!(atom, Atom::Inverse(..));
    let inverses = ring.atoms.iter().zip(&names.extended).filter(|(atom, _)| is_inverse(atom));
    Ok(Some(Extension {
        inverses: inverses.map(|(_, name)| name.clone()).collect(),
        axes,
        divergence,
        known: written,
        curves,
        class: AdjoinedPolynomials::of(&case.model, ring, seed),
        factors: factors(ring, &names, formula),
        circles: circles(ring, formula),
        angles: angles(ring),
        leading: ring.leading(),
        back: Back::of(ring, &names),
        exponentials: exponentials.collect(),
        case: extended,
        field,
        read: known,
        names: names.extended,
        has_level: !case.model.level.is_empty(),
        ring: read.ring,
        functions_of_field,
    }))
}

/// Rates of the variables of the extended state along each component of the state itself.
fn axes(
    ring: &AdjoinedRing,
    dimension: usize,
    formula: impl Fn(&RingPolynomial) -> Option<Formula>,
) -> Option<Vec<Vec<Formula>>> {
    let along = |axis: usize| -> Option<Vec<Formula>> {
        let unit = |k| RingPolynomial::constant(Rational::from(i64::from(k == axis)));
        let rates = ring.rates(&(0..dimension).map(unit).collect::<Vec<_>>())?;
        let of_state = rates.iter().zip(&ring.atoms).filter(|(_, atom)| !is_constant(atom));
        of_state.map(|(rate, _)| formula(rate)).collect()
    };
    (0..dimension).map(along).collect()
}

/// Whether a variable of a ring is constant along every motion.
fn is_constant(atom: &Atom) -> bool {
    matches!(atom, Atom::Parameter | Atom::Constant(_))
}

/// Whether some component of the state has a name that a variable of a field cannot have, as x'.
fn names_are_foreign(case: &Case) -> bool {
    let is_plain = |name: &str| name.chars().all(char::is_alphanumeric);
    case.model.state_names().iter().any(|name| !is_plain(name))
}

/// Arguments of sines and cosines.
fn angles(ring: &AdjoinedRing) -> Vec<RingPolynomial> {
    let argument = |atom: &Atom| match atom {
        Atom::Sine(argument) => Some(argument.clone()),
        _ => None,
    };
    ring.atoms.iter().filter_map(argument).collect()
}
