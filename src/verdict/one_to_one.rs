//! Proofs that a map takes no two states to one image, but for states of measure 0.

use super::judging::Judging;
use super::preimages::SecondState;
use super::sampler::{Sampler, TAPE_LANES};
use crate::claim::LevelSubset;
use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::{Chart, Draw, NumberLine, Phase, combinations};
use crate::number::ball::{Ball, Balls};
use crate::number::rational::Rational;
use crate::proof::{Determination, Group, Prover, is_nowhere_zero, sign};

impl Judging<'_> {
    /// Whether the map is proved to be one-to-one on the states of a place, for each choice of
    /// listed values, in the declared ranges or on all states.
    pub(super) fn is_one_to_one(
        &self,
        sampler: &Sampler,
        states: SecondState,
    ) -> Result<bool, Fault> {
        let key = (sampler.kept().to_vec(), states);
        if let Some(known) = self.one_to_one.borrow().get(&key) {
            return Ok(*known);
        }
        if sampler.is_numerical() {
            let space = self.sampler_at(&LevelSubset::everywhere(&self.case.model))?;
            let is_proved = !space.is_numerical() && self.is_one_to_one(&space, states)?;
            self.one_to_one.borrow_mut().insert(key, is_proved);
            return Ok(is_proved);
        }
        // Each part of a level would have a relation of its own, and parts may have common images.
        let is_whole = self.missed_part(sampler)?.is_none() && self.pieces(sampler)?.is_none();
        let is_proved = is_whole
            && match states {
                SecondState::InRanges => {
                    self.has_inverse(sampler)? || self.has_reversor(sampler)?
                }
                SecondState::Anywhere => match self.without_ranges(sampler)? {
                    Some(unbounded) => self.has_inverse(&unbounded)?,
                    None => false,
                },
            };
        self.one_to_one.borrow_mut().insert(key, is_proved);
        Ok(is_proved)
    }

    /// Makes a sampler of the same place whose variables take all values; `None` if a chart was
    /// typed for it.
    fn without_ranges(&self, sampler: &Sampler) -> Result<Option<Sampler>, Fault> {
        let is_charted = match &self.case.chart {
            Chart::Free | Chart::Equations => false,
            Chart::Rolling | Chart::Sphere | Chart::Given(_) => sampler.kept().contains(&true),
        };
        if is_charted {
            return Ok(None);
        }
        let mut case = self.case.clone();
        for draw in &mut case.free_draws {
            if let Draw::Within(range) = draw {
                *draw = Draw::Of(NumberLine::All, range.clone());
            }
        }
        let place = LevelSubset { kept: sampler.kept().to_vec() };
        let unbounded = Sampler::new(&case, &place, self.options.seed)?;
        Ok((!unbounded.is_numerical()).then_some(unbounded))
    }

    /// Whether the state is proved to be a function of its image and the parameters, outside of a set
    /// of measure 0.
    fn has_inverse(&self, sampler: &Sampler) -> Result<bool, Fault> {
        let Some(combinations) = combinations(sampler.recipes()) else { return Ok(false) };
        for fixed in combinations {
            let known = self.monotone_variables(sampler, &fixed)?;
            if known.len() < self.case.model.dimension()
                && !self.is_determined(sampler, &fixed, &known)?
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the state is proved to be a function of its image, the parameters and those of its
    /// components that are known.
    fn is_determined(
        &self,
        sampler: &Sampler,
        fixed: &[Option<Rational>],
        known: &[usize],
    ) -> Result<bool, Fault> {
        let model = &self.case.model;
        let mut inputs: Vec<Option<Expr>> = vec![None; self.graph.inputs()];
        for (place, step) in self.graph.steps().enumerate() {
            if let Step::Input(input) = step {
                inputs[input] = Some(self.graph.at(place));
            }
        }
        let inputs: Vec<Expr> = inputs.into_iter().flatten().collect();
        // Antiderivatives are further inputs.
        if inputs.len() != self.inputs || self.graph.inputs() > self.inputs {
            return Ok(false);
        }
        let (constants, state) = inputs.split_at(model.free_components());
        let group = |outputs: &[Expr]| Group::of(outputs.to_vec());
        let states = Group { required: self.common.required_at(sampler.kept()), ..group(state) };
        let groups = [states, group(&self.common.field), group(constants)];
        let (graph, groups) = sampler.compose_groups(self.graph, &groups, fixed)?;
        let [states, images, constants] = groups.try_into().map_err(|_| Fault::ForeignValue)?;
        let mut given = images.outputs;
        given.extend(known.iter().map(|component| states.outputs[*component]));
        let question = Determination {
            wanted: states.outputs,
            given,
            constants: constants.outputs,
            required: states.required,
            facts: states.facts,
        };
        let (extents, sources) = (sampler.extents(), sampler.sources());
        let prover = Prover { sources: &sources, extents: &extents, seed: self.options.seed };
        prover.is_determined(&graph, &question)
    }

    /// Lists the variables found one after another from components of the image, each of which is
    /// proved to be monotone in one variable and to contain no other that is not known.
    fn monotone_variables(
        &self,
        sampler: &Sampler,
        fixed: &[Option<Rational>],
    ) -> Result<Vec<usize>, Fault> {
        let (model, mut known) = (&self.case.model, Vec::new());
        let (free, dimension) = (model.free_components(), model.dimension());
        let draw = |value: &Expr| match sampler.graph().step(sampler.graph().place(*value)) {
            Step::Input(draw) => Some(draw),
            _ => None,
        };
        let is_free = !sampler.kept().contains(&true);
        let draws: Option<Vec<usize>> = sampler.made()[free..].iter().map(draw).collect();
        let Some(draws) = draws.filter(|_| is_free) else { return Ok(known) };
        let recorded = |with_slopes: bool| {
            record(free + dimension, |inputs| {
                let (parameters, state) = inputs.split_at(free);
                let jet = DualPoint::new(Phase::new(model, parameters, state));
                let mut values = vec![jet.phase.field().to_vec()];
                if with_slopes {
                    values.extend(jet.derivative());
                }
                values
            })
        };
        let (graph, values) = recorded(false)?;
        let (graph, values) = sampler.compose(&graph, &values, fixed)?;
        let images: Vec<Vec<usize>> = values
            .concat()
            .iter()
            .map(|image| {
                let inputs = graph.inputs_of(*image);
                (0..dimension).filter(|k| inputs.contains(&draws[*k])).collect()
            })
            .collect();
        // Where every component contains two variables none comes first, and slopes take long.
        if images.iter().all(|image| image.len() != 1) {
            return Ok(known);
        }
        let (graph, values) = recorded(true)?;
        let (graph, mut values) = sampler.compose(&graph, &values, fixed)?;
        let slopes = values.split_off(1);
        let mut open: Vec<usize> = (0..images.len()).collect();
        while let Some((place, variable)) = open.iter().enumerate().find_map(|(place, image)| {
            let mut unknown = images[*image].iter().filter(|k| !known.contains(*k));
            let variable = unknown.next().filter(|_| unknown.next().is_none())?;
            Some((place, *variable))
        }) {
            let image = open.swap_remove(place);
            let slope = slopes[variable][image];
            if is_monotone(&graph, sampler, fixed, values[0][image], slope) {
                known.push(variable);
            }
        }
        Ok(known)
    }
}

/// Whether a value is proved to be differentiable at all draws and strictly monotone, for almost all
/// values of the others, in that draw along which it has the given slope.
fn is_monotone(
    graph: &Graph,
    sampler: &Sampler,
    fixed: &[Option<Rational>],
    value: Expr,
    slope: Expr,
) -> bool {
    let extents = sampler.extents();
    let is_nonzero = |value: Expr| is_nowhere_zero(graph, &extents, &[], &[value]);
    let has_none =
        |value: Expr| edges(graph, &[value]).is_some_and(|edges| edges.into_iter().all(is_nonzero));
    // A slope as x²·2/x is 0 nowhere, and has no value at 0.
    has_none(value)
        && (is_nonzero(slope) && has_none(slope)
            || sign(graph, &extents, &[], &[], slope).is_some()
                && is_nonzero_somewhere(graph, &sampler.with(fixed), slope))
}

/// Whether a value is proved to be other than 0 at some draws of the first block.
fn is_nonzero_somewhere(graph: &Graph, sampler: &Sampler, value: Expr) -> bool {
    let tape = Tape::new(graph, &[value]);
    let mut evaluator = Evaluator::new(&tape, Ball::<TAPE_LANES>);
    evaluator.run(&sampler.drawn(&Ball::<TAPE_LANES>, TAPE_LANES, 0));
    let is_nonzero = |block: &Balls<TAPE_LANES>| {
        (0..TAPE_LANES).any(|lane| block.is_defined(lane) && block.excludes_zero(lane))
    };
    evaluator.outputs().all(is_nonzero)
}

/// Lists the values that must not be 0 for others to be differentiable on the whole range; `None`
/// if they contain moduli.
fn edges(graph: &Graph, values: &[Expr]) -> Option<Vec<Expr>> {
    let reached = graph.reached(values.iter().copied());
    let is_modulus = |step: Step<'_>| step.is_modulus();
    let mut steps = graph.steps().zip(&reached).filter(|(_, reached)| **reached);
    let has_moduli = steps.any(|(step, _)| is_modulus(step));
    (!has_moduli).then(|| graph.needs(&reached).map(|(place, _)| graph.at(place)).collect())
}
