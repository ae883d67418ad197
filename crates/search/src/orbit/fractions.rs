//! Fractions of polynomials that are integrals of a field with functions, bounded from above.
//!
//! Such an integral gives a relation along each orbit. If all relations follow from known integrals,
//! it is a function of these.

use liouville::case::Case;
use liouville::formula::Formula;

use super::super::continued::named;
use super::super::hypotheses::stated;
use super::super::lists::HAS_LISTS;
use super::super::origin::TheoremOrigin;
use super::super::{Effort, Excluded, SearchError, SearchReport};
use super::adjoin::{self, Extension};
use super::monomials;
use super::setting::OrbitSetting;

/// Largest number of monomials that are listed.
const LISTED: usize = 20_000;
/// Highest degree of a theorem that is stated unasked.
const DEGREE: u32 = 8;
/// Largest number of its monomials.
const UNASKED: usize = 300;

/// Degree of fractions of polynomials.
#[derive(Clone, Copy, Debug)]
pub enum Degree {
    /// In the state and the functions of the class.
    OfClass(u32),
    /// In the state, the functions of the class, and the exponentials, sines and cosines that the field contains.
    AsWritten(u32),
}

/// Relations between the polynomials of a class along one orbit, and those that are explained.
pub struct Compared {
    /// Degree of the polynomials of the class that are compared.
    pub degree: u32,
    /// Class of polynomials, in words.
    pub class: String,
    /// Number of its monomials.
    pub monomials: usize,
    /// Number of relations along the orbit of a random point, an upper bound for generic ones.
    pub relations: usize,
    /// Number of relations that known integrals imply.
    pub implied: usize,
    /// Places of these integrals among those given.
    pub by: Vec<usize>,
}

impl Compared {
    /// States that there are no other integrals, beginning with a small letter, if there are none.
    pub fn statement(
        &self,
        case: &Case,
        effort: &Effort,
        known: &[Formula],
    ) -> Result<Option<String>, SearchError> {
        if self.relations != self.implied {
            return Ok(None);
        }
        let class = &self.class;
        Ok(Some(match self.by.is_empty() {
            true => none_is(class),
            false => format!(
                "every integral P/Q that is a fraction of {class}, with any complex coefficients, is a \
                 function of {}",
                named(case, self.by.iter().map(|place| &known[*place]), effort)?
            ),
        }))
    }
}

/// States that no fraction of polynomials of a class is an integral.
pub fn none_is(class: &str) -> String {
    format!(
        "no fraction P/Q of {class} (Q = 1 included), with any complex coefficients, is an integral, \
         except constants"
    )
}

/// Completes a statement to a sentence that names the parameters for which it holds.
pub fn sentence(case: &Case, statement: &str) -> String {
    format!("{}.", stated(&case.model, statement))
}

/// Whether it is stated that all integrals of this degree, or more, are functions of known ones: that there
/// are none of a lower degree says less.
pub fn is_covered(report: &SearchReport, degree: u32) -> bool {
    let is_of_all = |own: &Excluded| own.origin == TheoremOrigin::Orbit && own.known > 0;
    (degree..=DEGREE)
        .map(family)
        .any(|family| report.excluded.iter().any(|own| is_of_all(own) && own.ansatz == family))
}

/// Family of a theorem.
pub fn family(degree: u32) -> String {
    format!("fractions of polynomials of degree up to {degree}")
}

/// States the theorem for the highest degree in reach: that there are no integrals besides the known
/// ones, or else, if the field has functions, that there are none of lower degree.
pub fn conclude(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
    has_functions: bool,
    report: &mut SearchReport,
) -> Result<(), SearchError> {
    for known in [known, &[]] {
        for degree in (1..=DEGREE).rev() {
            if known.is_empty() && is_covered(report, degree) {
                return Ok(());
            }
            let Ok(compared) = compared(case, effort, known, Degree::OfClass(degree), UNASKED)?
            else {
                continue;
            };
            let is_stated = compared.by.is_empty() && !has_functions;
            let Some(statement) = compared.statement(case, effort, known)?.filter(|_| !is_stated)
            else {
                continue;
            };
            let theorem = sentence(case, &statement);
            if report.excluded.iter().all(|own| own.theorem != theorem) {
                let known = compared.by.len();
                report.excluded.push(Excluded {
                    ansatz: family(degree),
                    dimension: known,
                    known,
                    error_log2: None,
                    theorem,
                    origin: TheoremOrigin::Orbit,
                    values: None,
                });
            }
            return Ok(());
        }
        if known.is_empty() || !has_functions {
            break;
        }
    }
    Ok(())
}

/// Counts the relations of a degree along an orbit of a field whose functions become variables, and
/// those that known integrals imply, for up to `most` monomials; the text is the reason why nothing can be
/// concluded.
pub fn compared(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
    degree: Degree,
    most: usize,
) -> Result<Result<Compared, String>, SearchError> {
    let none = |reason: &str| Ok(Err(reason.to_string()));
    let Some(extension) = adjoin::always_extended(case, effort, known)? else {
        return none(
            "the field contains functions that cannot be counted: only exp, sin, cos and roots of \
             polynomials in the state can be, and fractions of these",
        );
    };
    let Some(class) = &extension.class else {
        return none(
            "the functions in the field, or in the known integrals, may depend on each other, or are \
             functions inside of functions or logarithms: nothing is counted",
        );
    };
    let (asked, degree) = match degree {
        Degree::OfClass(degree) => (degree, degree),
        Degree::AsWritten(degree) => (degree, degree.saturating_mul(extension.share())),
    };
    let setting = match OrbitSetting::extended(case, &extension, effort)? {
        Ok(setting) => setting,
        Err(reason) => return Ok(Err(reason)),
    };
    if setting.has_lists() || !setting.flow.is_rational_in_state {
        return none(HAS_LISTS);
    }
    let variables = class.variables();
    let mut all = Vec::new();
    // Sines and roots are linear, so that fewer are left.
    let listed = monomials::count(variables.len(), degree);
    if listed <= LISTED {
        all = monomials::up_to(&variables, setting.dimension(), degree);
        all.retain(|monomial| class.has(monomial));
    }
    if all.is_empty() || all.len() > most {
        let count = if all.is_empty() { listed } else { all.len() };
        let words = match asked == degree {
            true => format!("degree {degree}"),
            false => format!("degree {asked}, which can be degree {degree} in {},", {
                extension.words(&setting.terms, class, degree)
            }),
        };
        return Ok(Err(format!(
            "{words} has {count} unknowns, more than {most}: claim a lower degree"
        )));
    }
    let Some(at) = setting.at(0, 0) else { return none("no orbit has a series modulo a prime") };
    let Some(relations) = setting.relations(&at, 0, &all)? else {
        return none("no orbit has a series modulo a prime");
    };
    let implied = extension.implied(&setting, &at, &relations.point, &all)?;
    Ok(Ok(Compared {
        degree,
        class: extension.words(&setting.terms, class, degree),
        monomials: all.len(),
        relations: relations.free.len(),
        implied: implied.rank,
        by: implied.by,
    }))
}

/// Whether an integral is a fraction of polynomials of a degree, as it is written or in the functions of the class;
/// `known` are the integrals that were given with the class, whose polynomials have the degree `counted`.
pub fn is_within(
    case: &Case,
    effort: &Effort,
    known: &[Formula],
    integral: &Formula,
    (class, counted, degree): (&str, u32, u32),
) -> Result<bool, SearchError> {
    let all: Vec<Formula> = known.iter().chain([integral]).cloned().collect();
    let Some(extension) = adjoin::always_extended(case, effort, &all)? else {
        return Ok(false);
    };
    let is_same = |extension: &Extension| -> Result<bool, SearchError> {
        let Some(own) = &extension.class else { return Ok(false) };
        let setting = OrbitSetting::extended(case, extension, effort)?;
        Ok(setting.is_ok_and(|setting| extension.words(&setting.terms, own, counted) == class))
    };
    let low = |own: Option<u32>| own.is_some_and(|own| own <= degree);
    Ok(low(extension.written_degree(known.len()))
        || low(extension.degree(known.len())) && is_same(&extension)?)
}
