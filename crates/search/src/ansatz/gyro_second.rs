//! Terms of second order in a rotor or gyroscopic term, and the proof of what survives.
//!
//! For directions S = Σ s_k S_k that are allowed to first order, with F₁ = Σ s_k F_k, the terms of second
//! order are Σ s_k s_l R_kl, R_kl = (∂F_k, A(S_l)) + (∂F_l, A(S_k)), once for k = l. They must be
//! −L_v F₀, or with a potential U of second order −L_v F₀ − (∂F, A(∇U)). The matrices T with
//! Σ T_kl R_kl of this form are a space, and s sᵀ is in it for each s that survives: s is in the span
//! of their columns. Directions are replaced by this span first. Those of third order,
//! (∂F₀, A(S)) + (∂F₁, A(∇U)) = 0, are linear in F₀ and U for one direction.

use super::super::ask::{holds, judged_alone};
use super::super::{Found, FoundKind, Given, SearchError, SearchReport};
use super::coefficients::PrimitiveVector;
use super::factors;
use super::forces::{with_constants, with_potential};
use super::gyro_family::GyroEntry;
use super::gyro_slots::{Part, Slots, multiple, summed};
use super::gyrostats::GyroSearch;
use super::system::{Column, LinearSystem, PrimePoint};
use crate::echelon::Echelon;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::graph::Expr;
use liouville::mechanics::Model;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// A direction of the rotor or term, with the terms added to the integral.
#[derive(Clone, Debug)]
pub struct GyroDirection {
    /// Formulas that enter the equations.
    pub slots: Slots,
    /// Coefficients of the generators; none of a combination of directions.
    pub parts: Vec<Part>,
    /// Terms of first order, if there are any.
    pub linear: Option<Formula>,
}

/// Terms of second order for a product of two directions.
struct SecondTerm {
    gain: Option<Formula>,
    potential: Option<Formula>,
}

/// The equations of second order.
struct SecondOrder {
    system: LinearSystem,
    at: PrimePoint,
    /// Columns of gains and potentials, none dependent on others.
    own: Vec<usize>,
    /// First column of a potential, and of a pair of directions.
    starts: [usize; 2],
}

/// The directions under which an integral survives.
pub struct Survivors<'a> {
    /// Search for one integral.
    pub search: &'a GyroSearch<'a>,
}

impl Survivors<'_> {
    /// Reports the integral with all directions that have terms of second order, each with a free
    /// constant; returns their number.
    pub fn tell(
        &self,
        directions: Vec<GyroDirection>,
        report: &mut SearchReport,
    ) -> Result<usize, SearchError> {
        let mut kept = directions;
        while !kept.is_empty() {
            let Some(second) = self.second(&kept)? else { return Ok(0) };
            let matrices = second.matrices(kept.len())?;
            let pairs = pairs(kept.len());
            if matrices.len() < pairs.len()
                && let Some(narrower) = second.narrowed(&kept, &matrices)?
            {
                kept = narrower;
                continue;
            }
            let terms: Vec<Option<SecondTerm>> = (0..pairs.len())
                .map(|pair| second.term(self.search, pair))
                .collect::<Result<_, _>>()?;
            // Drop a direction without a term for its square first, then the last one in a pair
            // that fails.
            let missing = pairs.iter().zip(&terms).filter(|(_, term)| term.is_none());
            let worst = missing.map(|((k, l), _)| (k == l, *k.max(l))).max();
            if let Some((_, index)) = worst {
                kept.remove(index);
                continue;
            }
            let mut terms: Vec<SecondTerm> = terms.into_iter().flatten().collect();
            if kept.len() > 1 && self.moves_positions() {
                // Alone, those of third order are respected.
                match self.squares(&kept)? {
                    Err(without) => {
                        kept.remove(without);
                        continue;
                    }
                    Ok(squares) => {
                        let mut squares = squares.into_iter();
                        for ((k, l), term) in pairs.iter().zip(&mut terms) {
                            if k == l
                                && let Some(square) = squares.next()
                            {
                                *term = square;
                            }
                        }
                    }
                }
            }
            if self.prove(&kept, &terms, report)? {
                return Ok(kept.len());
            }
            if kept.len() == 1 {
                return Ok(0);
            }
            // Where not all are proved together, those are told that are proved alone.
            let mut told = 0;
            for (k, own) in kept.iter().enumerate() {
                let square = pairs.iter().position(|pair| *pair == (k, k));
                let square = square.and_then(|place| terms.get(place));
                if let Some(square) = square {
                    let one = [SecondTerm {
                        gain: square.gain.clone(),
                        potential: square.potential.clone(),
                    }];
                    told += usize::from(self.prove(std::slice::from_ref(own), &one, report)?);
                }
            }
            return Ok(told);
        }
        Ok(0)
    }

    /// Whether there are terms of third order.
    fn moves_positions(&self) -> bool {
        !self.search.family.potentials.is_empty()
    }

    /// Terms of second order of each direction alone; or a direction without such.
    fn squares(
        &self,
        directions: &[GyroDirection],
    ) -> Result<Result<Vec<SecondTerm>, usize>, SearchError> {
        let mut found = Vec::new();
        for (k, direction) in directions.iter().enumerate() {
            let second = self.second(std::slice::from_ref(direction))?;
            let term = second.map(|own| own.term(self.search, 0)).transpose()?.flatten();
            match term {
                Some(term) => found.push(term),
                None => return Ok(Err(k)),
            }
        }
        Ok(Ok(found))
    }

    /// Sets up the equations of second order, and for one direction those of third order with them:
    /// their degrees in the velocities differ by one. `None` where states have no values.
    fn second(&self, directions: &[GyroDirection]) -> Result<Option<SecondOrder>, SearchError> {
        let GyroSearch { case, effort, family, integral, degree, .. } = self.search;
        let over = factors(&family.below)?;
        let models: Option<Vec<Model>> =
            directions.iter().map(|own| family.with(&case.model, &own.slots)).collect();
        let Some(models) = models else { return Ok(None) };
        let pairs = pairs(directions.len());
        let mut given = Vec::new();
        let mut system = LinearSystem::record(case, effort, |jet, recording| {
            let (state, field) = (jet.phase.state(), jet.phase.field());
            let zero = Formula::number(0);
            let alone = match directions {
                [only] if self.moves_positions() => Some(only),
                _ => None,
            };
            let shift = |model: &Model| -> Vec<Expr> {
                let beside = jet.phase.in_model(model, &state);
                beside.field().iter().zip(field).map(|(with, without)| *with - *without).collect()
            };
            let shifts: Vec<Vec<Expr>> = models.iter().map(shift).collect();
            let terms = &family.variables.terms;
            let whole: Vec<Expr> = match (alone, shifts.first()) {
                (Some(_), Some(own)) => field.iter().zip(own).map(|(v, own)| *v + *own).collect(),
                _ => field.to_vec(),
            };
            recording.derive(&jet.phase.lift(&whole), terms, &over);
            if self.moves_positions() {
                let mut direction = vec![Expr::rational(&Rational::from(0)); state.len()];
                let further = alone.and_then(|own| own.linear.as_ref()).unwrap_or(&zero);
                for (place, model) in
                    family.variables.positions().into_iter().zip(&family.potentials)
                {
                    let moved = jet.phase.lift(&shift(model));
                    direction[place] = moved.scalar(integral).eps + moved.scalar(further).eps;
                }
                recording.derive(&jet.phase.lift(&direction), terms, &over);
            }
            let gain = |k: usize, l: usize| {
                let linear = directions[k].linear.as_ref().unwrap_or(&zero);
                jet.phase.lift(&shifts[l]).scalar(linear).eps
            };
            given = pairs
                .iter()
                .map(|(k, l)| match k == l {
                    true => recording.give(gain(*k, *k)),
                    false => recording.give(gain(*k, *l) + gain(*l, *k)),
                })
                .collect();
        })?;
        let gains = if *degree < 2 { Vec::new() } else { family.second_gains() };
        let potentials = family.second_potentials();
        let starts = [gains.len(), gains.len() + potentials.len()];
        let pairs = given.into_iter().map(Column::Given);
        system.columns = gains.into_iter().chain(potentials).chain(pairs).collect();
        let Some(at) = system.at(0, 0) else { return Ok(None) };
        let gains: Vec<usize> = (0..starts[0]).collect();
        let Some(mut own) = system.distinct(&at, &gains)? else { return Ok(None) };
        // The constant is no term.
        own.retain(|column| *column != 0);
        own.extend(starts[0]..starts[1]);
        Ok(Some(SecondOrder { system, at, own, starts }))
    }

    /// Judges the integral with all directions, and reports it if it is proved.
    fn prove(
        &self,
        own: &[GyroDirection],
        terms: &[SecondTerm],
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        let GyroSearch { case, effort, family, integral, .. } = self.search;
        let (mut extended, names) = with_constants(case, "s", own.len())?;
        let mut formula = integral.clone();
        for (name, own) in names.iter().zip(own) {
            if let Some(linear) = &own.linear {
                formula = (formula + &multiple(name, linear)?)?;
            }
        }
        let mut potential: Option<Formula> = None;
        for ((k, l), term) in pairs(own.len()).iter().zip(terms) {
            let by = (&names[*k] * &names[*l])?;
            let times = |own: &Option<Formula>| -> Result<Option<Formula>, FormulaError> {
                own.as_ref().map(|own| multiple(&by, own)).transpose()
            };
            if let Some(own) = times(&term.gain)? {
                formula = (formula + &own)?;
            }
            if let Some(own) = times(&term.potential)? {
                potential = Some(potential.map_or(Ok(own.clone()), |before| before + &own)?);
            }
        }
        let parts: Vec<_> =
            names.iter().zip(own).map(|(name, own)| (name, own.slots.as_slice())).collect();
        let slots = family.combined(&parts)?;
        let Some(mut model) = family.with(&extended.model, &slots) else { return Ok(false) };
        if let Some(potential) = &potential {
            let Some(changed) = with_potential(&model, potential) else { return Ok(false) };
            model = changed;
        }
        extended.model = model;
        let verdict = judged_alone(&extended, Claim::integral(&formula), effort)?;
        let Some(verdict) = verdict else { return Ok(false) };
        let text = match family.entry {
            GyroEntry::Rotor => format!("S = {}", family.text(&slots)),
            _ => format!("the {} {}", family.word(), family.text(&slots)),
        };
        if !holds(&verdict) {
            if own.len() > 1 {
                return Ok(false);
            }
            report.remark(format!(
                "found, but not proved ({}): {formula} with {text}",
                verdict.verdict.word()
            ));
            return Ok(false);
        }
        let mut one = Found::new(FoundKind::Integral, &formula, None, verdict, &extended.model);
        one.with = vec![family.given(family.text(&slots))];
        one.with.extend(potential.map(|own| Given::Potential(own.to_string())));
        report.found.push(one);
        Ok(true)
    }
}

impl SecondOrder {
    /// Relations between the products of directions and terms of second order, by columns.
    fn matrices(&self, count: usize) -> Result<Vec<Vec<(usize, u64)>>, SearchError> {
        let pairs = self.starts[1]..self.starts[1] + pairs(count).len();
        let columns: Vec<usize> = self.own.iter().copied().chain(pairs).collect();
        let vectors = self.system.null_space(&self.at, &columns)?.unwrap_or_default();
        let support = |vector: &Vec<u64>| -> Vec<(usize, u64)> {
            let entries = columns.iter().copied().zip(vector.iter().copied());
            entries.filter(|(_, entry)| *entry != 0).collect()
        };
        let has_pair = |own: &Vec<(usize, u64)>| {
            own.last().is_some_and(|(column, _)| *column >= self.starts[1])
        };
        Ok(vectors.iter().map(support).filter(has_pair).collect())
    }

    /// Directions that span the columns of all matrices, where these are fewer.
    fn narrowed(
        &self,
        directions: &[GyroDirection],
        matrices: &[Vec<(usize, u64)>],
    ) -> Result<Option<Vec<GyroDirection>>, SearchError> {
        let count = directions.len();
        let pairs = pairs(count);
        let place = |k: usize, l: usize| {
            let pair = (k.min(l), k.max(l));
            pairs.iter().position(|own| *own == pair).map(|own| self.starts[1] + own)
        };
        let mut echelon = Echelon::new(count, self.at.modulus);
        let mut chosen = Vec::new();
        for matrix in matrices {
            for l in 0..count {
                let entry = |k: usize| {
                    let place = place(k, l);
                    matrix
                        .iter()
                        .find(|(own, _)| Some(*own) == place)
                        .map_or(0, |(_, value)| *value)
                };
                if echelon.push((0..count).map(entry).collect()) {
                    chosen.push((matrix, l));
                }
            }
        }
        if chosen.len() == count {
            return Ok(None);
        }
        let mut found = Vec::new();
        for (matrix, l) in chosen {
            let support: Vec<usize> = matrix.iter().map(|(column, _)| *column).collect();
            let Some(coefficients) = PrimitiveVector::of(&self.system, &support)? else {
                return Ok(None);
            };
            let mut weights = Vec::new();
            for (k, direction) in directions.iter().enumerate() {
                let at = support.iter().position(|own| Some(*own) == place(k, l));
                if let Some(at) = at {
                    weights.push((coefficients.formula(at)?, direction));
                }
            }
            let slots = (0..directions[0].slots.len()).map(|slot| {
                let own =
                    weights.iter().filter_map(|(by, own)| Some((by, own.slots[slot].as_ref()?)));
                summed(own)
            });
            let slots = slots.collect::<Result<Slots, FormulaError>>()?;
            let linear = weights.iter().filter_map(|(by, own)| Some((by, own.linear.as_ref()?)));
            found.push(GyroDirection { slots, parts: Vec::new(), linear: summed(linear)? });
        }
        Ok(Some(found))
    }

    /// Finds the terms of second order for one product of two directions; `None` where there are none.
    fn term(
        &self,
        search: &GyroSearch<'_>,
        pair: usize,
    ) -> Result<Option<SecondTerm>, SearchError> {
        let pair = self.starts[1] + pair;
        let columns: Vec<usize> = self.own.iter().copied().chain([pair]).collect();
        let vector = self.system.null_space(&self.at, &columns)?.and_then(|mut found| found.pop());
        let Some(vector) = vector else { return Ok(None) };
        let used = columns.iter().zip(&vector).filter(|(_, entry)| **entry != 0);
        let support: Vec<usize> = used.map(|(column, _)| *column).collect();
        if support.last() != Some(&pair) {
            return Ok(None);
        }
        let Some(coefficients) = PrimitiveVector::of(&self.system, &support)? else {
            return Ok(None);
        };
        let last = support.len() - 1;
        let (gains, potentials): (Vec<usize>, Vec<usize>) =
            (0..last).partition(|k| support[*k] < self.starts[0]);
        let below = coefficients.formula(last)?;
        let divided = |own: &[usize]| -> Result<Option<Formula>, FormulaError> {
            let sum = search.sum(&self.system, &coefficients, &support, own)?;
            let is_one = below.constant().is_some_and(|value| value == Rational::from(1));
            sum.map(|sum| if is_one { Ok(sum) } else { &sum / &below }).transpose()
        };
        Ok(Some(SecondTerm { gain: divided(&gains)?, potential: divided(&potentials)? }))
    }
}

fn pairs(count: usize) -> Vec<(usize, usize)> {
    (0..count).flat_map(|k| (k..count).map(move |l| (k, l))).collect()
}
