//! Claims of absence: proved by a count, refuted by a proved find.
//!
//! ```text
//! known        the integrals that the file claims and that are proved, with the energy
//! velocities   polynomials in the velocities with any smooth coefficients, by Taylor coefficients
//! polynomials  polynomials in all variables of a field, by random states
//! polynomial_densities  densities P^(1/α) and exp P with such polynomials
//! gradients    whether an integral is no function of others
//! leading      when products of known integrals cannot cancel
//! found        integrals of a field that a search finds
//! functions    fractions of polynomials in the state and functions of it, along an orbit
//! reports      outcomes as reports
//! relations    Darboux polynomials of a field, on random lines
//! by_value     each combination of listed values where no count takes all of them
//! claimed_densities  densities of the file, and 1, that refute a claim
//! ```
//!
//! A count bounds the number of integrals or densities from above; the known ones bound it from
//! below. If both bounds agree, there are no others. Otherwise one of the others is sought and
//! proved: a witness that refutes the claim.

mod by_value;
mod claimed_densities;
mod found;
mod functions;
mod gradients;
mod known;
mod leading;
mod polynomial_densities;
mod polynomials;
mod relations;
mod reports;
mod velocities;

use std::time::Duration;

use super::ansatz::monomials::AnsatzVariables;
use super::ask::{components, independent};
use super::continued::named;
use super::local::Coordinates;
use super::terms::recorded;
use super::{Ansatz, Effort, Halt, SearchError, abbreviated, branches, lists};
use known::ProvedIntegrals;
pub use known::{has_lists, rank};
use liouville::case::{AbsenceClaim, Case, PlacedClaim};
use liouville::claim::absence::Absence;
use liouville::claim::{ClaimKind, Integral};
use liouville::formula::Formula;
use liouville::graph::Step;
use liouville::mechanics::{Draw, Model, System};
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::verdict::{self, CaseReport, ClaimReport, JudgeError, Options, Trust, Verdict};

/// Limit on the estimated time of a count, in seconds; longer counts are left out.
const SECONDS: f64 = 20.0;
/// Limit on the time for a claim.
const MOST_TIME: Duration = Duration::from_secs(60);

/// The invariants that are counted.
#[derive(Clone, Copy)]
enum Counted {
    Integrals,
    Densities,
}

/// The outcome of a claim of absence.
enum AbsenceOutcome {
    /// No such integral, density or relation exists.
    Excluded {
        /// Theorem with its hypotheses.
        theorem: String,
        /// The count, in a few words.
        counted: String,
    },
    /// A proved invariant that contradicts the claim.
    Exhibited(String),
    /// Undecided, for this reason.
    Open(String),
    /// Undecided: a count leaves room for more, in words that hold where the count does.
    Bounded(String),
}

/// Judges all claims of a case except those about motion; claims of absence come last.
pub fn judge(case: &Case, options: &Options) -> Result<CaseReport, JudgeError> {
    let mut report = verdict::judge(case, options)?;
    complete(case, options, &mut report)?;
    Ok(report)
}

/// Adds verdicts on the claims of absence to a report on the others.
pub fn complete(case: &Case, options: &Options, report: &mut CaseReport) -> Result<(), JudgeError> {
    let told = match case.time_parts() {
        Some(parts) => {
            // Two integrals with t may have a function without it.
            let timed = proved_integrals(&parts.with_time, report);
            let timed = if timed.len() > 1 { timed } else { Vec::new() };
            let mut both = reports_of(&parts.without_time, options, report, &timed)?;
            both.extend(reports_of(&parts.with_time, options, report, &[])?);
            parts.sort(&mut both, |claim| &claim.name);
            both
        }
        None => reports_of(case, options, report, &[])?,
    };
    report.claims.extend(told);
    report.absences_left = 0;
    Ok(())
}

/// Formulas of the claimed integrals of a case that are proved, component by component.
fn proved_integrals(case: &Case, report: &CaseReport) -> Vec<Formula> {
    let is_proved = |name: &str| {
        let own = report.claims.iter().find(|claim| claim.name == name);
        own.is_some_and(|own| own.verdict == Verdict::Proved)
    };
    let of = |claim: &PlacedClaim| match &claim.kind {
        ClaimKind::Integral(Integral(own)) if is_proved(&claim.name) => {
            components(own).unwrap_or_else(|_| vec![own.clone()])
        }
        _ => Vec::new(),
    };
    case.claims.iter().flat_map(of).collect()
}

/// Reports on the claims of absence of a case; `report` contains those on its other claims, and `others` are
/// proved integrals that the case does not contain.
fn reports_of(
    case: &Case,
    options: &Options,
    report: &CaseReport,
    others: &[Formula],
) -> Result<Vec<ClaimReport>, JudgeError> {
    if case.absences.is_empty() {
        return Ok(Vec::new());
    }
    let known = match options.trust {
        // Counts rest on proved integrals.
        Trust::Float => {
            let best = Options { trust: Trust::Best, mutants: false, ..*options };
            verdict::judge(case, &best)?.claims
        }
        Trust::Best | Trust::Proof => {
            let of = |name: &str| report.claims.iter().find(|claim| claim.name == name).cloned();
            case.claims.iter().filter_map(|claim| of(&claim.name)).collect()
        }
    };
    Ok(judged(case, (&known, others), options))
}

/// Reports on all claims of absence; `judged` are the reports on the other claims.
fn judged(
    case: &Case,
    (judged, others): (&[ClaimReport], &[Formula]),
    options: &Options,
) -> Vec<ClaimReport> {
    let options = Options { trust: Trust::Best, mutants: false, ..*options };
    let moving = lists::with_motion(case);
    let ground = abbreviated(moving.as_ref().map_or(case, |(own, _)| own)).and_then(|case| {
        let effort = Effort { options, ..Effort::default() };
        let known = ProvedIntegrals::of(&case, (judged, others), &effort)?;
        let coordinates = Coordinates::of(&case);
        Ok((case, known, coordinates))
    });
    let outcome = |claim: &AbsenceClaim| {
        let (case, known, coordinates) = match &ground {
            Ok((case, known, coordinates)) => (case, known, coordinates),
            Err(error) => return AbsenceOutcome::Open(error.to_string()),
        };
        match by_value::judged(case, &claim.kind, coordinates, (judged, others), options) {
            Ok(Some(outcome)) => return outcome,
            Err(error) => return AbsenceOutcome::Open(error.to_string()),
            Ok(None) => {}
        }
        let asked = AbsenceCase::new(case, (known, coordinates), judged, options);
        let open = |error: SearchError| AbsenceOutcome::Open(error.to_string());
        let outcome = asked.judge(&claim.kind).unwrap_or_else(open);
        if !matches!(outcome, AbsenceOutcome::Open(_)) {
            return outcome;
        }
        match by_value::contradicted(case, &claim.kind, (judged, others), options) {
            Ok(Some(what)) => AbsenceOutcome::Exhibited(what),
            _ => outcome,
        }
    };
    case.absences.iter().map(|claim| reports::report(claim, outcome(claim), &moving)).collect()
}

/// A case whose claims of absence are judged.
struct AbsenceCase<'a> {
    case: &'a Case,
    /// The case whose parameters are named in theorems: with the lists of which `case` has one value.
    named: &'a Model,
    known: &'a ProvedIntegrals,
    /// Coordinates of the level, or the reason why positions and velocities are not known.
    coordinates: &'a Result<Coordinates, SearchError>,
    /// Reports on the claims of the case.
    reports: &'a [ClaimReport],
    effort: Effort,
}

impl<'a> AbsenceCase<'a> {
    fn new(
        case: &'a Case,
        (known, coordinates): (&'a ProvedIntegrals, &'a Result<Coordinates, SearchError>),
        reports: &'a [ClaimReport],
        options: Options,
    ) -> Self {
        let has_branches = |formula: &&Formula| has_branches(case, formula).unwrap_or(true);
        let branching = known.formulas().iter().filter(has_branches);
        let effort = Effort {
            seconds: SECONDS,
            // Roots in known integrals must have the right branch as well; other functions have one.
            terms: branching.cloned().map(Into::into).collect(),
            ansatz: Ansatz { wanted: true, ..Ansatz::default() },
            by_class: false,
            halt: Halt::within(MOST_TIME),
            options,
            ..Effort::default()
        };
        Self { case, named: &case.model, known, coordinates, reports, effort }
    }

    fn judge(&self, kind: &Absence) -> Result<AbsenceOutcome, SearchError> {
        let mut outcome = self.judge_once(kind)?;
        if let (AbsenceOutcome::Exhibited(what), Absence::NoIntegral(_), [own, ..]) =
            (&outcome, kind, self.known.uncounted())
        {
            outcome = AbsenceOutcome::Open(format!(
                "{what}; it may be a polynomial in proved integrals that are not counted, such as `{}`",
                own.text()
            ));
        }
        if !matches!(outcome, AbsenceOutcome::Open(_)) || self.effort.terms.is_empty() {
            return Ok(outcome);
        }
        // Known integrals with branches need not be among those counted. Without them nothing is
        // refuted: what is found may be a function of one of them.
        let known = self.known.filtered(|own| Ok(!has_branches(self.case, own)?))?;
        let effort = Effort { terms: Vec::new(), ..self.effort.clone() };
        let fewer = AbsenceCase { known: &known, effort, ..*self };
        Ok(match fewer.judge_once(kind)? {
            excluded @ AbsenceOutcome::Excluded { .. } => excluded,
            _ => outcome,
        })
    }

    /// Judges a claim with the known integrals as they are.
    fn judge_once(&self, kind: &Absence) -> Result<AbsenceOutcome, SearchError> {
        let system = &self.case.model.system;
        if system.has_arbitrary_function() {
            let reason = "a function of the body is arbitrary, and a count needs a given one";
            return Ok(AbsenceOutcome::Open(reason.to_string()));
        }
        if system.is_map() {
            let reason = "this is a map, and such claims are judged for fields: `search` says what it excludes";
            return Ok(AbsenceOutcome::Open(reason.to_string()));
        }
        let (counted, degree) = match kind {
            Absence::NoIntegral(claim) => (Counted::Integrals, claim.degree),
            Absence::NoDensity(claim) => (Counted::Densities, claim.degree),
            Absence::NoInvariantRelation(claim) => {
                return relations::no_invariant_relation(self, claim.degree);
            }
        };
        if matches!(counted, Counted::Densities)
            && let Some(density) = claimed_densities::witness(self, degree)?
        {
            return Ok(AbsenceOutcome::Exhibited(density));
        }
        let coordinates = self.coordinates;
        let outcome = if coordinates.is_ok() {
            velocities::judge(self, counted, degree)?
        } else {
            let own = AnsatzVariables::of(self.case).filter(|own| !own.have_velocities());
            match own {
                Some(variables) => {
                    match (polynomials::judge(self, &variables, counted, degree)?, counted) {
                        (Some(outcome), _) => outcome,
                        // Its theorem holds on all branches of roots, and moduli have no part in it.
                        (None, Counted::Integrals) => return functions::no_integral(self, degree),
                        (None, Counted::Densities) => polynomials::nothing(),
                    }
                }
                None => AbsenceOutcome::Open(match coordinates {
                    Err(error) if matches!(system, System::Lagrangian(_)) => error.to_string(),
                    _ => "velocities are not known apart, and polynomials in all variables are \
                          counted without a level set only"
                        .to_string(),
                }),
            }
        };
        if matches!(counted, Counted::Densities)
            && matches!(outcome, AbsenceOutcome::Open(_) | AbsenceOutcome::Bounded(_))
            && let Some(exhibit) = found::density(self, degree)?
        {
            return Ok(AbsenceOutcome::Exhibited(exhibit));
        }
        let is_true = match coordinates.is_ok() {
            true => branches::are_counts_true,
            false => branches::are_true,
        };
        match outcome {
            AbsenceOutcome::Excluded { .. } | AbsenceOutcome::Bounded(_)
                if !is_true(self.case, &self.effort)? =>
            {
                Ok(AbsenceOutcome::Open(
                    "the formulas contain a modulus, a root that depends on others, or a function such \
                     as atan: a count modulo a prime says nothing about them"
                        .to_string(),
                ))
            }
            AbsenceOutcome::Bounded(bound) => Ok(AbsenceOutcome::Open(bound)),
            outcome => Ok(outcome),
        }
    }

    /// Whether an integral is proved to be no function of the known ones.
    fn is_new(&self, formula: &Formula) -> Result<bool, SearchError> {
        let (case, known) = (self.case, self.known);
        if independent(case, known.claimed(), formula, &self.effort)?.is_some() {
            return Ok(true);
        }
        // The known ones may depend on each other.
        if let Some(basis) = known.basis(case, &self.effort)?
            && independent(case, &basis, formula, &self.effort)?.is_some()
        {
            return Ok(true);
        }
        // Roots have several branches modulo a prime.
        for own in known.formulas().iter().chain([formula]) {
            if has_branches(case, own)? {
                return Ok(false);
            }
        }
        gradients::is_new(case, known.formulas(), formula, self.effort.options.seed)
    }

    /// Returns the beginning of a sentence that names the parameters for which a count holds.
    fn parameters(&self) -> String {
        let draws = self.named.parameter_draws();
        let is_listed = |draw: &&Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
        let is_fixed = |draw: &Draw| matches!(draw, Draw::OneOf(_));
        let listed = draws.iter().any(|draw| is_listed(&draw));
        match (draws.iter().all(is_fixed), listed) {
            (true, false) if self.named.parameters.is_empty() => "",
            (true, false) => "For the given values of the parameters, ",
            (true, true) => "For each combination of the listed values of the parameters, ",
            (false, false) => {
                "For all values of the free parameters but those of a proper algebraic set, "
            }
            (false, true) => {
                "For each combination of listed values, and all values of the other free \
                 parameters but those of a proper algebraic set, "
            }
        }
        .to_string()
    }

    /// Composes a theorem from its hypotheses and its statement, which begins with a small letter.
    fn theorem(&self, statement: &str) -> String {
        let hypotheses = self.parameters();
        match hypotheses.is_empty() {
            false => format!("{hypotheses}{statement}."),
            true => {
                let mut letters = statement.chars();
                let first: String =
                    letters.next().into_iter().flat_map(char::to_uppercase).collect();
                format!("{first}{}.", letters.as_str())
            }
        }
    }
}

/// Whether a formula contains a root, a power or a modulus.
fn has_branches(case: &Case, formula: &Formula) -> Result<bool, SearchError> {
    let (graph, values) = recorded(case, |jet| jet.phase.evaluate(formula).components())?;
    let reached = graph.reached(values.iter().copied());
    let branches = |step: Step<'_>| match step {
        Step::Unary(function, _) => matches!(function, UnaryFunction::Sqrt | UnaryFunction::Abs),
        Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
        Step::Power(..) => true,
        _ => false,
    };
    Ok((0..reached.len()).any(|place| reached[place] && branches(graph.step(place))))
}

/// States that all integrals of a class are polynomials in the given ones.
fn generated(
    asked: &AbsenceCase<'_>,
    class: &str,
    formulas: &[Formula],
) -> Result<String, SearchError> {
    Ok(match formulas {
        [] => format!("no integral but a constant is {class}"),
        formulas => {
            let names = named(asked.case, formulas, &asked.effort)?;
            let comma = if class.contains(',') { "," } else { "" };
            format!("every integral that is {class}{comma} is a polynomial in {names}")
        }
    })
}
