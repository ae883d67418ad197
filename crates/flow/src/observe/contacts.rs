//! Times at which a motion meets a one-sided constraint, in f64 and in double-double.

use super::judgement::MotionJudgement;
use super::scene::FollowedCase;
use crate::{Contact, FlowError, MeasuredNumber, Precision, orbit};
use liouville::claim::motion::{Contacts, Touch};
use liouville::number::double_double::DoubleDouble;

/// Compares the events at the constraint with the claim; grazing does not count.
pub fn judge(claim: &Contacts, scene: &FollowedCase<'_>) -> Result<MotionJudgement, FlowError> {
    let start = scene.start(&claim.beginning)?;
    let events = |precision| {
        let found =
            orbit(scene.case, start.clone(), DoubleDouble::from_f64(claim.time), precision)?;
        let touches = found.events.into_iter().filter_map(|event| match event.kind {
            Contact::Arrives => Some((Touch::Arrives, event.time.hi)),
            Contact::Leaves => Some((Touch::Leaves, event.time.hi)),
            Contact::Grazes => None,
        });
        Ok::<Vec<(Touch, f64)>, FlowError>(touches.collect())
    };
    let (float, pair) = (events(Precision::Float)?, events(Precision::Pair)?);
    let mut judgement = MotionJudgement::default();
    let kinds =
        |events: &[(Touch, f64)]| events.iter().map(|(touch, _)| *touch).collect::<Vec<_>>();
    if kinds(&float) != kinds(&pair) {
        judgement.leave_open("f64 and double-double see other events".to_string());
        return Ok(judgement);
    }
    let stated: Vec<Touch> = claim.events.iter().map(|(touch, _)| *touch).collect();
    if kinds(&pair) != stated {
        judgement.refute("other events happen".to_string());
    }
    for (index, ((touch, time), (_, rough))) in pair.iter().zip(&float).enumerate() {
        let quantity = match touch {
            Touch::Arrives => "time of arrival",
            Touch::Leaves => "time of leaving",
        };
        let found = MeasuredNumber::twice(*rough, *time);
        match claim.events.get(index) {
            Some((claimed, when)) if claimed == touch => judgement.compare(quantity, found, when),
            _ => judgement.show(quantity, found),
        }
    }
    Ok(judgement)
}
