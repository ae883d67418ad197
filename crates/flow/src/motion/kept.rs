//! Level and energy along a motion: kept by a proof, or else as measured within the rounding of the motion itself.

use crate::error::FlowError;
use crate::motion::carry::MOST_STEPS;
use crate::motion::recorded::program;
use crate::motion::start::Start;
use crate::taylor::stepper::{Accuracy, Stepper};
use liouville::case::Case;
use liouville::claim::{Claim, ClaimEntry};
use liouville::mechanics::{Meaning, Model, Quantity};
use liouville::number::double_double::DoubleDouble;
use liouville::verdict::{self, JudgeError, Options, Trust, Verdict};

/// Checks that the motions of a case stay on its level.
///
/// # Errors
/// The equation that is seen not to be kept.
pub fn check_level(case: &Case, seed: u64) -> Result<(), JudgeError> {
    if case.model.level.is_empty() || case.model.system.conserves_level() {
        return Ok(());
    }
    let Ok(bare) = case.with_claims(&[]) else { return Ok(()) };
    match verdict::judge(&bare, &Options { seed, ..Options::default() }) {
        Err(error @ JudgeError::NotInvariant { .. }) => Err(error),
        _ => Ok(()),
    }
}

/// Name of the energy of a system, unless a file gives it to another function.
const ENERGY: &str = "energy";

/// Verdict on the claim that a function is an integral on the level, if it can be judged.
fn judged(case: &Case, function: impl Into<ClaimEntry>, options: &Options) -> Option<Verdict> {
    let asked = case.with_claims(&[Claim::integral(function)]).ok()?;
    let options = Options { trust: Trust::Best, mutants: false, ..*options };
    let report = verdict::judge(&asked, &options).ok()?;
    report.claims.first().map(|claim| claim.verdict)
}

/// Whether a function is proved to be an integral on the level.
pub(crate) fn is_proved(case: &Case, function: impl Into<ClaimEntry>, options: &Options) -> bool {
    judged(case, function, options) == Some(Verdict::Proved)
}

/// Whether the energy of the system is proved to be an integral.
pub(crate) fn is_energy_proved(case: &Case, options: &Options) -> bool {
    judged_energy(case, options) == Some(Verdict::Proved)
}

/// Verdict on the claim that the energy of the system is an integral, also where the file gives its name to
/// another function.
fn judged_energy(case: &Case, options: &Options) -> Option<Verdict> {
    let energy = case.model.vocabulary.formula_of(Meaning::Quantity(Quantity::Energy))?;
    judged(case, &energy, options)
}

/// Whether the name of the energy means another function in a file.
pub(crate) fn has_other_energy(model: &Model) -> bool {
    let own = model.vocabulary.find(ENERGY);
    own.is_some_and(|own| !matches!(own.meaning, Meaning::Quantity(Quantity::Energy)))
}

/// Whether motions keep the energy. Where that is neither proved nor refuted, the energy is followed
/// along the motion from a start: it counts as kept while it changes by no more than rounding does.
pub(crate) fn keeps_energy(
    case: &Case,
    model: &Model,
    start: &Start,
    time: f64,
) -> Result<bool, FlowError> {
    if !model.system.has_energy() {
        return Ok(false);
    }
    match judged_energy(case, &Options::default()) {
        Some(Verdict::Proved) => Ok(true),
        Some(Verdict::Refuted) => Ok(false),
        _ => drifts_by_rounding(model, start, time),
    }
}

/// Whether the energy changes along a motion by no more than rounding does. A step leaves the state
/// wrong by a rounding of its norm; from there on the energy stays wrong by what that makes, which adds
/// up over the steps.
fn drifts_by_rounding(model: &Model, start: &Start, time: f64) -> Result<bool, FlowError> {
    let program = program(model, &start.parameters, |phase| {
        model.system.energy(phase).into_iter().collect()
    })?;
    let mut stepper = Stepper::<f64>::new(&program, Accuracy::FLOAT);
    stepper.start(0, &start.state, DoubleDouble::from_f64(time));
    let (mut first, mut rounding) = (None, 0.0);
    while !stepper.is_done(0) && stepper.steps(0) < MOST_STEPS {
        stepper.expand();
        stepper.check(0)?;
        let state = stepper.pairs(0);
        let size = state.iter().map(|x| x.hi * x.hi).sum::<f64>().sqrt();
        let energy = stepper.piece(0).output(0)[0];
        rounding += program.rounding::<f64>(0, &state, size);
        let change = (energy - *first.get_or_insert(energy)).abs();
        if change.is_nan() || change > 2.0 * rounding {
            return Ok(false);
        }
        stepper.advance();
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use liouville::number::rational::Rational;

    fn case(text: &str) -> Case {
        Case::parse(text, &[]).expect("a case")
    }

    const OSCILLATOR: &str = r#"
        title = "Oscillator whose energy is 0 at rest of a turn"
        [state]
        q = "-2..2"
        p = "-2..2"
        [hamiltonian]
        function = "(p^2 + q^2)/2 - 1/2"
        pairs = [["q", "p"]]
    "#;

    fn start(case: &Case, at: [i64; 2]) -> Start {
        let state = at.map(Rational::from);
        Start::new(case, Some(&state), 1, 0).expect("a start")
    }

    #[test]
    fn an_energy_of_0_is_kept_too() {
        let case = case(OSCILLATOR);
        let begin = start(&case, [1, 0]);
        assert_eq!(keeps_energy(&case, &case.model, &begin, 6.3), Ok(true), "proved");
        assert_eq!(drifts_by_rounding(&case.model, &begin, 6300.0), Ok(true), "measured");
        let rest = start(&case, [0, 0]);
        assert_eq!(drifts_by_rounding(&case.model, &rest, 6.3), Ok(true));
    }

    #[test]
    fn a_level_that_is_left_is_refused() {
        let text = |rate: &str| {
            format!(
                "title = 'Circle'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\n\"x'\" = 'y'\n\
                 \"y'\" = '{rate}'\n[level]\nequations = ['x² + y² = 1']"
            )
        };
        assert!(check_level(&case(&text("-x")), 1).is_ok());
        let left = check_level(&case(&text("-x + y/1000")), 1);
        assert!(matches!(left, Err(JudgeError::NotInvariant { .. })), "{left:?}");
    }

    #[test]
    fn an_energy_that_changes_is_not_kept() {
        let case = case(
            r#"
            title = "Friction"
            [state]
            q = "-2..2"
            "q'" = "-2..2"
            [lagrangian]
            kinetic = "q'²/2"
            potential = "q²/2"
            forces = { q = "-q'/1000000000000" }
        "#,
        );
        let begin = start(&case, [1, 0]);
        assert_eq!(keeps_energy(&case, &case.model, &begin, 6.3), Ok(false), "refuted");
        assert_eq!(drifts_by_rounding(&case.model, &begin, 6.3), Ok(false), "measured");
    }
}
