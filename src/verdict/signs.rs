//! Signs of densities that hold.

use std::ops::Range;

use super::claim_state::{ClaimState, undecide};
use super::evidence::DensitySign;
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::run::{MOST_KEPT, Run, Values, waves};
use super::sampler::{Maker, Sampler, TAPE_LANES};
use crate::claim::ClaimKind;
use crate::graph::{Expr, Fault};
use crate::mechanics::combinations;
use crate::number::Enclosing;
use crate::number::ball::Ball;
use crate::number::double_double_ball::DoubleDoubleBall;
use crate::number::mixed::{Mixed, Number};
use crate::proof::{self, Group, KnownSign};

/// Number of parameter sets for which the sign of a density is observed.
const PARAMETER_SETS: usize = 4;
/// Number of states near the ends of ranges at which it is observed.
const EDGES: usize = 2 * TAPE_LANES;

/// Observed signs of a density, negative and positive, by parameter set.
type Signs = [[bool; 2]; PARAMETER_SETS];

/// Observations of a density.
#[derive(Clone, Default)]
struct DensityObservations {
    signs: Signs,
    /// Observed signs, negative and positive, at states with parameters of their own.
    apart: [bool; 2],
    /// Whether some lane contains no state known to exist.
    is_lacking: bool,
    /// Lanes of the first block at which the density is known to have a value other than 0.
    is_seen: Vec<bool>,
    /// Whether a state was met at which it is not known whether the density has a value.
    is_doubtful: bool,
}

impl DensityObservations {
    /// Whether nothing that is observed at further states can change the finding.
    fn is_decided(&self, proved: Option<&KnownSign>) -> bool {
        let sign = self.sign();
        match proved {
            Some(_) => sign.is_some(),
            None => sign == Some(DensitySign::Changes),
        }
    }

    /// The observed sign.
    fn sign(&self) -> Option<DensitySign> {
        if self.signs.contains(&[true, true]) {
            return Some(DensitySign::Changes);
        }
        let [negative, positive] =
            [0, 1].map(|sign| self.apart[sign] || self.signs.iter().any(|set| set[sign]));
        match (positive, negative) {
            (true, true) => Some(DensitySign::ChangesWithParameters),
            (true, false) => Some(DensitySign::Positive),
            (false, true) => Some(DensitySign::Negative),
            (false, false) => None,
        }
    }
}

/// Combines the signs that are observed for two choices of listed values.
fn for_both(a: Option<DensitySign>, b: Option<DensitySign>) -> Option<DensitySign> {
    match (a, b) {
        (None, sign) | (sign, None) => sign,
        (Some(a), Some(b)) if a == b => Some(a),
        (Some(DensitySign::Changes), _) | (_, Some(DensitySign::Changes)) => {
            Some(DensitySign::Changes)
        }
        _ => Some(DensitySign::ChangesWithParameters),
    }
}

impl Judging<'_> {
    /// Finds the signs of the densities among claims that hold, over all states for each of a few
    /// parameter sets; a density that is nowhere known to be nonzero is rejected.
    pub(super) fn settle_signs<'f, 'r: 'f>(
        &self,
        sampler: &Sampler,
        items: impl Iterator<Item = (&'f RecordedClaim<'r>, &'f mut ClaimState)>,
    ) -> Result<(), Fault> {
        let mut open: Vec<(Expr, &RecordedClaim<'_>, &mut ClaimState)> = items
            .filter(|(item, _)| matches!(item.claim.kind, ClaimKind::Density(_)))
            .filter_map(|(item, status)| Some((*item.context.value.first()?, item, status)))
            .collect();
        if open.is_empty() {
            return Ok(());
        }
        let proved = self.proved_signs(sampler, &open)?;
        let mut outputs: Vec<Expr> = open.iter().map(|(density, ..)| *density).collect();
        let first = outputs.len();
        outputs.extend(self.common.required_at(sampler.kept()));
        let common = first..outputs.len();
        let own = open.iter().map(|(_, item, _)| {
            let start = outputs.len();
            outputs.extend(&item.requirement);
            [common.clone(), start..outputs.len()]
        });
        let required: Vec<[Range<usize>; 2]> = own.collect();
        let run = self.run(&outputs);
        let mut found = vec![(None, false); required.len()];
        let choices = combinations(sampler.recipes());
        for fixed in choices.unwrap_or_else(|| vec![vec![None; sampler.recipes().len()]]) {
            let seen = self.observed(&run, &required, &sampler.with(&fixed), &proved);
            for ((sign, is_doubtful), seen) in found.iter_mut().zip(seen) {
                *sign = for_both(*sign, seen.sign());
                *is_doubtful |= seen.is_doubtful;
            }
        }
        let unreached = sampler.unreached()?;
        for (((_, _, status), (sign, is_doubtful)), proved) in
            open.iter_mut().zip(found).zip(proved)
        {
            let evidence = &mut status.evidence;
            evidence.sign = sign;
            let changes = [DensitySign::Changes, DensitySign::ChangesWithParameters];
            evidence.sign_is_proved =
                proved.is_some() || sign.is_some_and(|sign| changes.contains(&sign));
            evidence.sign_may_vanish = proved.is_some_and(|proved| proved.may_vanish);
            let is_open = evidence.sign.is_some() && !evidence.sign_is_proved;
            evidence.sign_is_partial = is_open && (is_doubtful || unreached.is_some());
            if let Some(reason) = unreached.filter(|_| is_open) {
                evidence.add_remark(format!("its sign is that of the states tried: {reason}"));
            }
            if status.evidence.sign.is_none() {
                status.evidence.sign_is_proved = false;
                undecide(status, "no state is known at which the density is not 0".to_string());
            }
        }
        Ok(())
    }

    /// Observes signs at states for one choice of listed values.
    fn observed(
        &self,
        run: &Run,
        required: &[[Range<usize>; 2]],
        sampler: &Sampler,
        proved: &[Option<KnownSign>],
    ) -> Vec<DensityObservations> {
        let mut seen: Vec<DensityObservations> =
            vec![DensityObservations::default(); required.len()];
        let mut is_first = true;
        for blocks in waves(0..self.blocks(), MOST_KEPT) {
            let sharing = |maker: &mut Maker<'_>, start| {
                maker.balls_sharing_parameters(start, PARAMETER_SETS)
            };
            for values in run.at_blocks(sampler, blocks, sharing) {
                let known = observe(&values, required, &mut seen);
                if std::mem::take(&mut is_first) {
                    seen.iter_mut().zip(known).for_each(|(seen, known)| seen.is_seen = known);
                }
            }
            if seen.iter().zip(proved).all(|(seen, proved)| seen.is_decided(proved.as_ref())) {
                break;
            }
        }
        let is_open =
            !seen.iter().zip(proved).all(|(seen, proved)| seen.is_decided(proved.as_ref()));
        if is_open && !sampler.is_numerical() {
            self.look_closely(run, required, sampler, proved, &mut seen);
        }
        if is_open {
            let values = run.at(&Ball::<TAPE_LANES>, &sampler.balls(0));
            for (index, (seen, required)) in seen.iter_mut().zip(required).enumerate() {
                let existing = values.existing(required).into_iter().enumerate();
                for (lane, _) in existing.filter(|(_, exists)| *exists) {
                    note::<Ball<TAPE_LANES>>(values.output(index), lane, &mut seen.apart);
                }
            }
        }
        seen
    }

    /// Observes signs near the ends of ranges; in double-double where none is known; and in exact
    /// numbers where f64 finds no state, as a root may be 0.
    fn look_closely(
        &self,
        run: &Run,
        required: &[[Range<usize>; 2]],
        sampler: &Sampler,
        proved: &[Option<KnownSign>],
        seen: &mut [DensityObservations],
    ) {
        if seen.iter().any(|seen| seen.sign().is_none()) {
            let domain = DoubleDoubleBall::<TAPE_LANES>;
            let states = sampler.states_sharing_parameters(&domain, 0, PARAMETER_SETS);
            observe(&run.at(&domain, &states), required, seen);
        }
        let domain = Ball::<TAPE_LANES>;
        for start in (0..EDGES).step_by(TAPE_LANES) {
            let states = sampler.states_at_edges(&domain, start as u64, PARAMETER_SETS);
            observe(&run.at(&domain, &states), required, seen);
        }
        let domain = Mixed::new(f64::MANTISSA_DIGITS * 4);
        for lane in 0..TAPE_LANES {
            // Where f64 knows the sign, exact numbers tell nothing more.
            let is_asked = |(seen, proved): (&DensityObservations, &Option<KnownSign>)| {
                seen.is_lacking
                    && seen.is_seen.get(lane) != Some(&true)
                    && !seen.is_decided(proved.as_ref())
            };
            if !seen.iter().zip(proved).any(is_asked) {
                continue;
            }
            let states = sampler.state_sharing_parameters(&domain, lane as u64, PARAMETER_SETS);
            let values = run.at(&domain, &states);
            for (index, (seen, required)) in seen.iter_mut().zip(required).enumerate() {
                if seen.is_lacking && values.existing(required)[0] {
                    let set = &mut seen.signs[lane * PARAMETER_SETS / TAPE_LANES];
                    note::<Mixed>(values.output(index), 0, set);
                } else if values.existing(&required[..1])[0] {
                    let own = values.range(required[1].clone());
                    seen.is_doubtful |= own.into_iter().any(|value| *value == Number::Doubtful);
                }
            }
        }
    }

    /// Proves signs by enclosures over all states.
    fn proved_signs(
        &self,
        sampler: &Sampler,
        densities: &[(Expr, &RecordedClaim<'_>, &mut ClaimState)],
    ) -> Result<Vec<Option<KnownSign>>, Fault> {
        let lists = combinations(sampler.recipes()).unwrap_or_default();
        if sampler.is_numerical() || lists.len() != 1 {
            return Ok(vec![None; densities.len()]);
        }
        let common = self.common.required_at(sampler.kept());
        let group = |(density, item, _): &(Expr, &RecordedClaim<'_>, &mut ClaimState)| Group {
            outputs: vec![*density],
            required: [&item.requirement[..], &common].concat(),
            ..Group::default()
        };
        let groups: Vec<Group> = densities.iter().map(group).collect();
        let (graph, groups) = sampler.compose_groups(self.graph, &groups, &lists[0])?;
        let extents = sampler.extents();
        let sign = |group: &Group| {
            let value = *group.outputs.first()?;
            proof::sign(&graph, &extents, &group.required, &group.facts, value)
        };
        Ok(groups.iter().map(sign).collect())
    }
}

/// Records the signs of a block of values at states, by parameter set; returns for each density in
/// which lanes its sign is known.
fn observe<D: Enclosing>(
    values: &Values<D>,
    required: &[[Range<usize>; 2]],
    seen: &mut [DensityObservations],
) -> Vec<Vec<bool>> {
    let mut all = vec![vec![false; D::LANES]; required.len()];
    for (index, (seen, required)) in seen.iter_mut().zip(required).enumerate() {
        let existing = values.existing(required);
        for (lane, (exists, is_known)) in existing.into_iter().zip(&mut all[index]).enumerate() {
            match exists {
                true => {
                    let set = &mut seen.signs[lane * PARAMETER_SETS / TAPE_LANES];
                    *is_known = note::<D>(values.output(index), lane, set);
                }
                false => seen.is_lacking = true,
            }
        }
    }
    all
}

/// Records the sign of one value, and returns whether it is known.
fn note<D: Enclosing>(block: &D::Block, lane: usize, seen: &mut [bool; 2]) -> bool {
    let is_known = D::excludes_zero(block, lane);
    if is_known {
        seen[usize::from(D::is_positive(block, lane))] = true;
    }
    is_known
}
