//! A case under judgement: its graph, the evaluation of parts of it, and the checks common to all
//! cases.

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::branches::Missed;
use super::claim_state::BlockResult;
use super::judge::{JudgeError, Options};
use super::ladder::{LADDER_BITS, PRECISE_STATES};
use super::level_slopes::FlatEquation;
use super::overflow;
use super::physics;
use super::pieces::Pieces;
use super::preimages::SecondState;
use super::recorded::SharedTerms;
use super::run::{Doubles, Run};
use super::sampler::{Sampler, TAPE_LANES};
use super::slopes_of_constraints;
use crate::case::Case;
use crate::claim::LevelSubset;
use crate::graph::{Expr, Fault, Graph};
use crate::level::{self, Order};
use crate::mechanics::{Chart, Variable};
use crate::number::arb::ArbBall;
use crate::number::ball::{Ball, Balls};
use crate::number::double_double_ball::DoubleDoubleBall;
use crate::number::mixed::{Mixed, Number};

/// A case under judgement, with its graph and the evaluation of parts of it.
pub struct Judging<'a> {
    pub case: &'a Case,
    pub common: &'a SharedTerms,
    pub options: &'a Options,
    pub graph: &'a Graph,
    pub inputs: usize,
    /// Takes numbers of claims that are decided, also fractions.
    pub(super) decided: &'a (dyn Fn(f64) + Sync),
    /// Reasons why the states of a place may miss a part of it, by the equations that hold there.
    pub(super) missed: RefCell<FxHashMap<Vec<bool>, Vec<Missed>>>,
    /// Reason why a part of the image of a given chart may have no interior.
    pub(super) thin_image: OnceCell<Option<String>>,
    /// Parts of a place, by the equations that hold there.
    pub(super) pieces: RefCell<FxHashMap<Vec<bool>, Option<Pieces>>>,
    /// Equations of the level whose slopes depend on each other at the states.
    pub(super) flat: RefCell<Vec<FlatEquation>>,
    /// Whether the motion is proved to stay on the equations of a place, on all parts of it that were judged.
    pub(super) kept: RefCell<FxHashMap<Vec<bool>, bool>>,
    /// Reason why nothing is proved of the motion, where an ∫ in its equations may depend on more than its variable.
    pub(super) open_quadrature: RefCell<Option<String>>,
    /// Samplers of whole places, by the equations that hold there.
    samplers: RefCell<FxHashMap<Vec<bool>, Rc<Sampler>>>,
    /// Whether the map is proved to be one-to-one, by the equations that hold at a place and by the
    /// states that count.
    pub(super) one_to_one: RefCell<FxHashMap<(Vec<bool>, SecondState), bool>>,
}

impl<'a> Judging<'a> {
    /// Puts a recorded case on the bench.
    pub fn new(
        case: &'a Case,
        common: &'a SharedTerms,
        options: &'a Options,
        graph: &'a Graph,
        inputs: usize,
    ) -> Self {
        Self {
            case,
            common,
            options,
            graph,
            inputs,
            decided: &|_| (),
            missed: RefCell::default(),
            thin_image: OnceCell::new(),
            pieces: RefCell::default(),
            flat: RefCell::default(),
            kept: RefCell::default(),
            open_quadrature: RefCell::default(),
            samplers: RefCell::default(),
            one_to_one: RefCell::default(),
        }
    }

    /// Tells how many claims more are decided.
    pub fn telling(self, decided: &'a (dyn Fn(f64) + Sync)) -> Self {
        Self { decided, ..self }
    }

    /// Says that so many claims more are decided, for those who watch.
    pub(super) fn tell(&self, decided: f64) {
        (self.decided)(decided);
    }
}

impl Judging<'_> {
    /// Returns the sampler of a whole place.
    pub(super) fn sampler_at(&self, place: &LevelSubset) -> Result<Rc<Sampler>, Fault> {
        if let Some(known) = self.samplers.borrow().get(&place.kept) {
            return Ok(Rc::clone(known));
        }
        let made = Rc::new(Sampler::new(self.case, place, self.options.seed)?);
        self.samplers.borrow_mut().insert(place.kept.clone(), Rc::clone(&made));
        Ok(made)
    }

    pub(super) fn run(&self, outputs: &[Expr]) -> Run {
        Run::new(self.graph, outputs, self.inputs)
    }

    /// Checks that states are on the level and that the field is defined and tangent to it; returns
    /// physical warnings.
    pub fn check(&self) -> Result<Vec<String>, JudgeError> {
        self.check_independence()?;
        let level = LevelSubset::level(&self.case.model);
        let sampler = self.sampler_at(&level)?;
        let Some(pieces) = self.pieces(&sampler)? else { return self.check_on(&sampler) };
        // A part may have no states in the declared ranges, or none at which the field exists, as the
        // apex of a cone.
        let (mut warnings, mut lacking) = (None, None);
        for sampler in pieces.iter().flatten() {
            match self.check_on(sampler) {
                Ok(found) => warnings = warnings.or(Some(found)),
                Err(
                    error @ (JudgeError::Unreachable(_)
                    | JudgeError::Overflow(_)
                    | JudgeError::Singular(_)
                    | JudgeError::Slopeless(..)
                    | JudgeError::FieldOverflow(_)),
                ) => lacking = Some(error),
                Err(error) => return Err(error),
            }
        }
        match (warnings, lacking) {
            (Some(warnings), _) => Ok(warnings),
            (None, Some(error)) => Err(error),
            (None, None) => Ok(Vec::new()),
        }
    }

    /// Checks the states of a sampler.
    fn check_on(&self, sampler: &Sampler) -> Result<Vec<String>, JudgeError> {
        let (model, common) = (&self.case.model, self.common);
        let states = sampler.balls(0);
        let defined =
            |blocks: &[&Balls<TAPE_LANES>], lane: usize| blocks.iter().all(|b| b.is_defined(lane));
        let drawn: Vec<&Balls<TAPE_LANES>> = states.iter().collect();
        // Draws that lead to no state leave some of its components without a value.
        let is_state = |lane: usize| defined(&drawn, lane);
        let is_nowhere = !(0..TAPE_LANES).any(is_state);
        if is_nowhere && !self.has_field_with_more_digits(sampler) {
            let found = TAPE_LANES as u64;
            return Err(match sampler.is_numerical() || sampler.is_guarded() {
                true => JudgeError::Unreachable(found),
                false => JudgeError::Overflow(found),
            });
        }
        let mut outputs =
            [&common.field[..], &common.level, &common.level_rates, &common.physics].concat();
        let skew = outputs.len();
        outputs.extend(&common.symmetric);
        let halves = outputs.len();
        if matches!(self.case.chart, Chart::Given(_)) {
            outputs.extend(&common.halves);
        }
        let values = self.run(&outputs).at(&Ball::<TAPE_LANES>, &states);
        let fields = common.field.len();
        let rates = fields + common.level.len();
        let physics = rates + common.level_rates.len();
        let physical = values.range(physics..skew);
        if physics::is_asymmetric(&physical) {
            return Err(JudgeError::AsymmetricInertia);
        }
        let is_off = |index: usize| (0..TAPE_LANES).any(|k| values.output(index).excludes_zero(k));
        if let Some(place) = (skew..halves).find(|index| is_off(*index)) {
            return Err(JudgeError::NotSkew(block_of(&model.state, place - skew)));
        }
        let chosen = model.orientations.iter().map(|own| &own.equation).zip(halves..outputs.len());
        for (equation, index) in model.level.iter().zip(fields..rates).chain(chosen) {
            let off = values.output(index);
            let is_off = |lane: &usize| is_state(*lane) && off.excludes_zero(*lane);
            if let Some(lane) = (0..TAPE_LANES).find(is_off) {
                let (equation, by) = (equation.text.clone(), format!("{:e}", off.mid[lane]));
                return Err(self.off_level(equation, by));
            }
        }
        let undefined = (0..TAPE_LANES).all(|lane| !defined(&values.range(0..fields), lane));
        if undefined
            && !self.has_field_with_more_digits(sampler)
            && !self.has_field_for_some_exponents(sampler)?
        {
            let all = TAPE_LANES as u64;
            let overflows = |lane: usize| {
                let at: Vec<f64> = states.iter().map(|block| block.mid[lane]).collect();
                overflow::is_cause(self.graph, &common.field, &at)
            };
            return Err(match (0..TAPE_LANES).all(overflows) {
                true => JudgeError::FieldOverflow(all),
                false => match slopes_of_constraints::slopeless(model, &states) {
                    Some(text) => JudgeError::Slopeless(text, all),
                    None => JudgeError::Singular(all),
                },
            });
        }
        for (equation, index) in model.level.iter().zip(rates..physics) {
            let rate = values.output(index);
            let changes = |lane: &usize| is_state(*lane) && rate.excludes_zero(*lane);
            if let Some(lane) = self.first_with_motion(sampler, &states, changes) {
                let (equation, rate) = (equation.text.clone(), format!("{:e}", rate.mid[lane]));
                return Err(match model.system.is_map() {
                    true => JudgeError::NotMapped { equation, by: rate },
                    false => JudgeError::NotInvariant { equation, rate },
                });
            }
        }
        self.check_slopes(sampler)?;
        sampler.check_coverage(self.case)?;
        let mut warnings = physics::warnings(&physical);
        warnings.extend(self.states_without_motion(sampler, &states)?);
        warnings.extend(self.check_quadratures()?);
        if sampler.is_numerical() {
            warnings.push(
                "the level set has no parametrisation: states are found numerically, and what holds \
                 at them alone is not proved"
                    .to_string(),
            );
        }
        warnings.extend(slopes_of_constraints::on_still_factors(model, sampler)?);
        warnings.extend(self.missed_part(sampler)?);
        warnings.extend(self.jump_of_level(sampler));
        Ok(warnings)
    }

    /// Returns a warning on drawn states at which the equations of motion have no value, as a mass is 0 there; an
    /// error if masses are 0 at all of them.
    fn states_without_motion(
        &self,
        sampler: &Sampler,
        states: &[Balls<TAPE_LANES>],
    ) -> Result<Option<String>, JudgeError> {
        let listed = self.case.model.undetermined.len();
        let hidden = self.common.motion.get(listed..).unwrap_or_default();
        let open = &self.common.open_divisors;
        if !open.is_empty() {
            let values = self.run(open).at(&Ball::<TAPE_LANES>, states);
            let is_defined = |lane| (0..open.len()).all(|k| values.output(k).is_defined(lane));
            if !(0..TAPE_LANES).any(is_defined) {
                return Err(JudgeError::Singular(TAPE_LANES as u64));
            }
        }
        let written = [hidden, &self.common.requirement].concat();
        // A power is a whole one for each listed exponent by itself, and then has values at all bases.
        if written.is_empty() || self.case.model.has_listed_exponents() {
            return Ok(None);
        }
        let values = self.run(&written).at(&Ball::<TAPE_LANES>, states);
        let is_state = |lane: &usize| states.iter().all(|block| block.is_defined(*lane));
        // Numbers beyond the range of f64, as in tanh 1000v by exponentials, are values nevertheless.
        let closer = OnceCell::new();
        let is_defined_closer = |lane: usize| {
            let defined = closer.get_or_init(|| self.defined_in_double_double(&written, sampler));
            defined.get(lane) == Some(&true)
        };
        let moves = |lane: &usize| {
            (0..written.len()).all(|k| values.output(k).is_defined(*lane))
                || is_defined_closer(*lane)
                || self.are_defined_with_more_digits(&written, sampler, *lane as u64)
        };
        let all = (0..TAPE_LANES).filter(is_state).count();
        let count = (0..TAPE_LANES).filter(is_state).filter(|lane| !moves(lane)).count();
        if count > 0 && count == all && !hidden.is_empty() {
            return Err(JudgeError::Singular(TAPE_LANES as u64));
        }
        Ok((count > 0).then(|| {
            format!("at {count} of {all} states the equations of motion have no value: these do not count")
        }))
    }

    /// Returns the error that states do not fulfil an equation of the level.
    pub(super) fn off_level(&self, equation: String, by: String) -> JudgeError {
        match self.case.chart {
            Chart::Equations => JudgeError::OffSolution { equation, by },
            _ => JudgeError::OffLevel { equation, by },
        }
    }

    /// Whether the field is defined at some state, in double-double.
    fn has_field_with_more_digits(&self, sampler: &Sampler) -> bool {
        let field = &self.common.field;
        if sampler.is_numerical() {
            return false;
        }
        let domain = DoubleDoubleBall::<TAPE_LANES>;
        let states = sampler.states(&domain, TAPE_LANES, 0);
        let values = self.run(field).at(&domain, &states);
        let blocks: Vec<_> = states.iter().chain(values.range(0..field.len())).collect();
        if (0..TAPE_LANES).any(|lane| blocks.iter().all(|block| block.is_defined(lane))) {
            return true;
        }
        // Only exact arithmetic knows that √0 exists.
        (0..PRECISE_STATES).any(|index| self.are_defined_with_more_digits(field, sampler, index))
    }

    /// At which states of the first block values are defined in double-double.
    fn defined_in_double_double(&self, values: &[Expr], sampler: &Sampler) -> Vec<bool> {
        if sampler.is_numerical() {
            return Vec::new();
        }
        let domain = DoubleDoubleBall::<TAPE_LANES>;
        let found = self.run(values).at(&domain, &sampler.states(&domain, TAPE_LANES, 0));
        found.existing(std::slice::from_ref(&(0..values.len())))
    }

    /// Whether values are defined at a state in balls of many digits, or in exact numbers, which take longer.
    fn are_defined_with_more_digits(&self, values: &[Expr], sampler: &Sampler, index: u64) -> bool {
        if sampler.is_numerical() {
            return false;
        }
        let is_defined = |values: &[&Number]| {
            values.iter().all(|value| matches!(value, Number::Exact(_) | Number::Ball(_)))
        };
        let run = self.run(values);
        for bits in &LADDER_BITS[..2] {
            let domain = ArbBall::new(*bits);
            let states = sampler.states(&domain, 1, index);
            if states.iter().all(Option::is_some)
                && run.at(&domain, &states).existing(std::slice::from_ref(&(0..values.len())))[0]
            {
                return true;
            }
        }
        let domain = Mixed::new(LADDER_BITS[0]);
        let states = sampler.states(&domain, 1, index);
        let found = run.at(&domain, &states);
        is_defined(&states.iter().collect::<Vec<_>>()) && is_defined(&found.range(0..values.len()))
    }

    /// Checks that no level equation of the user follows from those before it.
    fn check_independence(&self) -> Result<(), JudgeError> {
        if self.common.dependence.is_empty() {
            return Ok(());
        }
        let everywhere = LevelSubset::everywhere(&self.case.model);
        let sampler = self.sampler_at(&everywhere)?;
        let values =
            self.run(&self.common.dependence.concat()).at(&Ball::<TAPE_LANES>, &sampler.balls(0));
        let width = self.case.model.dimension();
        let kept = vec![true; self.case.model.level.len()];
        for (index, equation) in self.case.model.level.iter().enumerate() {
            let left = values.range(index * width..(index + 1) * width);
            let seen = BlockResult::at::<Doubles>(&left, None, &[true; TAPE_LANES]);
            // A slope may be undefined where a solution exists, such as that of √(y + |y|) for y <
            // 0.
            let is_solved = || {
                seen.is_nowhere_defined()
                    && level::solve(&self.case.model, &kept, Order::Usual).is_some()
            };
            if !seen.excludes_zero() && !is_solved() {
                return Err(JudgeError::Dependent(equation.text.clone()));
            }
        }
        Ok(())
    }

    /// Returns the rates of the level functions that a place keeps, if it is a part of the level: a
    /// claim there is meaningful only if the motion stays.
    pub(super) fn rates_at(&self, place: &LevelSubset) -> Vec<Expr> {
        let all = place.kept.iter().all(|kept| *kept);
        let rates = self.common.level_rates.iter().zip(&place.kept);
        rates.filter(|(_, kept)| **kept && !all).map(|(rate, _)| *rate).collect()
    }

    pub(super) fn blocks(&self) -> u64 {
        self.options.states.div_ceil(TAPE_LANES as u64).max(1)
    }
}

/// Name of the variable whose block holds an entry of P + Pᵀ, in the order of the variables.
fn block_of(state: &[Variable], entry: usize) -> String {
    let mut before = 0;
    for variable in state {
        before += variable.len() * (variable.len() + 1) / 2;
        if entry < before {
            return variable.name.clone();
        }
    }
    String::new()
}
