//! Powers whose exponents are whole numbers for some listed values.

use super::field::TOO_MANY_COMBINATIONS;
use super::judge::JudgeError;
use super::judging::Judging;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::mechanics::{Draw, combinations};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Extent, Group, GroupOutcome, Prover, sign};
use crate::scalar::Scalar;

const WHOLE_POWER: &str = "a power has an exponent from a list that contains whole numbers: it counts for positive \
                           bases alone, and the same number in the file for all; give the exponent by --set, or \
                           ranges in which the base is positive";

impl Judging<'_> {
    /// Returns the reason why a claim that holds may fail for negative bases: ln X belongs to what a claim requires
    /// for each power X^a with a parameter a, while the same whole number in the file takes any base.
    ///
    /// `residual` is what vanishes if the claim holds. A claim that is proved without these logarithms, for listed values for which the exponent is whole, fails for
    /// no base.
    pub(super) fn lost_bases(
        &self,
        place: &LevelSubset,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
        residual: &[Expr],
    ) -> Result<Option<&'static str>, JudgeError> {
        if !sampler.recipes().iter().any(|own| matches!(own, Draw::OneOf(_))) {
            return Ok(None);
        }
        let common = self.common.required_at(sampler.kept());
        let required = [&item.requirement[..], &common].concat();
        let all = [&required[..], residual, &self.common.field].concat();
        let own = powers(self.graph, all);
        let made = powers(sampler.graph(), sampler.made().to_vec());
        if own.is_empty() && made.is_empty() {
            return Ok(None);
        }
        let Some(choices) = combinations(sampler.recipes()) else {
            return Ok(Some(TOO_MANY_COMBINATIONS));
        };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        let outputs = [residual, &self.level_values(place, sampler)?].concat();
        for fixed in choices {
            let (graph, drawn) = sampler.compose(self.graph, &own, &fixed)?;
            let (made_graph, made) = with_listed(sampler.graph(), &made, &fixed)?;
            let lost = lost_bases(&graph, &drawn, &extents);
            if lost.is_empty() && lost_bases(&made_graph, &made, &extents).is_empty() {
                continue;
            }
            let bases: Vec<usize> =
                lost.into_iter().map(|index| self.graph.place(own[index][0])).collect();
            let is_of_base = |value: &&Expr| match self.graph.step(self.graph.place(**value)) {
                Step::Unary(UnaryFunction::Ln, a) => bases.contains(&a),
                _ => false,
            };
            let kept = required.iter().filter(|value| !is_of_base(value)).copied().collect();
            let presence = item.presence.clone();
            let group =
                Group { outputs: outputs.clone(), required: kept, presence, ..Group::default() };
            let (graph, groups) = sampler.compose_groups(self.graph, &[group], &fixed)?;
            let outcomes = prover.prove(&graph, &groups)?;
            let is_proved =
                |one: &GroupOutcome| matches!(one, GroupOutcome::Zero(_) | GroupOutcome::Void);
            if sampler.is_numerical() || !outcomes.iter().all(is_proved) {
                return Ok(Some(WHOLE_POWER));
            }
        }
        Ok(None)
    }
}

/// Lists base and exponent of each power in some values whose exponent is no number.
fn powers(graph: &Graph, values: Vec<Expr>) -> Vec<Vec<Expr>> {
    let reached = graph.reached(values);
    let power = |(place, step): (usize, Step<'_>)| match step {
        Step::Binary(BinaryOperation::Pow, a, b) if reached[place] => {
            Some(vec![graph.at(a), graph.at(b)])
        }
        _ => None,
    };
    graph.steps().enumerate().take(reached.len()).filter_map(power).collect()
}

/// Records values over draws once more, with listed values.
fn with_listed(
    graph: &Graph,
    groups: &[Vec<Expr>],
    fixed: &[Option<Rational>],
) -> Result<(Graph, Vec<Vec<Expr>>), Fault> {
    let (made, values) = record(fixed.len(), |draws| {
        let pairs = draws.iter().zip(fixed);
        let draws: Vec<Expr> =
            pairs.map(|(draw, own)| own.as_ref().map_or(*draw, Expr::rational)).collect();
        let reached = graph.reached(groups.iter().flatten().copied());
        let values = graph.repeated(&reached, &draws);
        let group = |group: &Vec<Expr>| {
            group.iter().map(|value| values[graph.place(*value)]).collect::<Option<Vec<Expr>>>()
        };
        groups.iter().map(group).collect::<Option<Vec<Vec<Expr>>>>()
    })?;
    values.map(|values| (made, values)).ok_or(Fault::ForeignValue)
}

/// Lists the powers with a whole exponent and a base that is not known to be positive.
fn lost_bases(graph: &Graph, powers: &[Vec<Expr>], extents: &[Extent]) -> Vec<usize> {
    let is_lost = |power: &Vec<Expr>| {
        let [base, exponent] = power[..] else { return false };
        let is_whole =
            graph.constant_value(exponent).is_some_and(|value| value.to_integer().is_some());
        let known = || sign(graph, extents, &[base], &[], base);
        is_whole && !known().is_some_and(|known| known.is_positive && !known.may_vanish)
    };
    (0..powers.len()).filter(|index| is_lost(&powers[*index])).collect()
}
