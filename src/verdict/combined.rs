//! Claims proved on a level without its states: their residuals are sums Σ m F of the level functions F, with
//! multipliers m that have values where the residuals have.
//!
//! docs/soundness-levels.md, "Combinations of the equations", states the theorem.

use super::circles::Circles;
use super::claim_state::{ClaimState, are_zero};
use super::evidence::{Method, Proof, Verdict};
use super::judging::Judging;
use super::ladder::Open;
use super::recorded::RecordedClaim;
use super::sampler::Sampler;
use crate::claim::ClaimKind;
use crate::graph::{Expr, Fault, Graph, Need, Step, record};
use crate::number::{BinaryOperation, UnaryFunction};
use crate::proof::{Certificate, combination_certificate};

/// Largest number of products of a multiplier and a level function.
const MOST_PRODUCTS: usize = 400;
/// Largest number of quotients that are tried as multipliers.
const MOST_QUOTIENTS: usize = 24;

impl Judging<'_> {
    /// Proves open claims whose residuals are combinations of the level functions; those about motions need that
    /// the rates of these functions are, too.
    pub(super) fn combine(&self, sampler: &Sampler, open: &mut Open<'_, '_>) -> Result<(), Fault> {
        let (mut level, rates) = self.common.level_at(sampler.kept());
        // No motion leaves a half of the whole level.
        if sampler.kept().iter().all(|kept| *kept) {
            level.extend(&self.common.halves);
        }
        let is_map = self.case.model.system.is_map();
        let mut of_rates: Option<Option<Certificate>> = None;
        for (item, status) in open.iter_mut() {
            if status.settled.is_some() || status.is_zero {
                continue;
            }
            let is_of_points = match &item.claim.kind {
                ClaimKind::Identity(_) => true,
                ClaimKind::Integral(_) | ClaimKind::Rate(_) => false,
                // The image of a motion on the level is one.
                ClaimKind::Symmetry(_) | ClaimKind::Reversor(_) if !is_map => false,
                _ => continue,
            };
            let is_sound = are_zero(self.graph, &item.context.quadrature_defects)
                && self.has_value_where_asked(sampler, item, is_of_points);
            if !is_sound {
                continue;
            }
            let Some(own) = self.combination(&level, &item.residual)? else { continue };
            let certificate = match is_of_points {
                true => own,
                false => {
                    if of_rates.is_none() {
                        of_rates = Some(self.combination(&level, &rates)?);
                    }
                    let Some(Some(kept)) = of_rates else { continue };
                    own.and(kept)
                }
            };
            prove(status, Proof::from(certificate));
        }
        Ok(())
    }

    /// Whether the rates of the level functions are combinations of these, with values wherever the field has one.
    pub(super) fn is_kept_by_combination(&self, kept: &[bool]) -> Result<bool, Fault> {
        let (level, rates) = self.common.level_at(kept);
        let known =
            self.needs(&[&self.common.required_at(kept)[..], self.field_where_known()].concat());
        let needed = self.needs(&rates);
        let has_value = needed.into_iter().all(|need| is_among(&known, need));
        Ok(has_value && self.combination(&level, &rates)?.is_some())
    }

    /// The rates, whose needs are those of the motion; none where elimination may divide by 0 though motions go on.
    fn field_where_known(&self) -> &[Expr] {
        match self.common.open_divisors.is_empty() {
            true => &self.common.field,
            false => &[],
        }
    }

    /// Lists what operations in values need of their arguments.
    fn needs(&self, values: &[Expr]) -> Vec<(usize, Need)> {
        let reached = self.graph.reached(values.iter().copied());
        self.graph.needs(&reached).collect()
    }

    /// Whether the residual of a claim, and what is written elsewhere, have values wherever the claim asks for
    /// them: what they need is needed by the formulas as they are written, or by the motion.
    fn has_value_where_asked(
        &self,
        sampler: &Sampler,
        item: &RecordedClaim<'_>,
        is_of_points: bool,
    ) -> bool {
        let mut asked = [&item.requirement[..], &self.common.required_at(sampler.kept())].concat();
        let mut needed = [&item.residual[..], &item.presence].concat();
        if !is_of_points {
            asked.extend(self.field_where_known());
            needed.extend(&self.common.level_rates);
        }
        let known = self.needs(&asked);
        self.needs(&needed).into_iter().all(|need| is_among(&known, need))
    }

    /// Proves that values are combinations of the level functions.
    fn combination(&self, level: &[Expr], values: &[Expr]) -> Result<Option<Certificate>, Fault> {
        let graph = self.graph;
        let all = [values, level].concat();
        let reached = graph.reached(all.iter().copied());
        let places = || (0..reached.len()).filter(|place| reached[*place]);
        let circles = Circles::of(graph, places());
        let symbols: Vec<usize> = places()
            .filter(|place| is_symbol(graph.step(*place)) && !circles.contains(*place))
            .collect();
        let multipliers = multipliers(graph, &reached, &symbols);
        // Sines, cosines, and their products with parameters.
        let parameters = self.case.model.free_components().min(graph.inputs());
        let count = multipliers.len() + 2 * circles.count() + 1;
        let all = count + 2 * circles.count() * parameters;
        if level.is_empty() || count * level.len() > MOST_PRODUCTS {
            return Ok(None);
        }
        let parameters = if all * level.len() > MOST_PRODUCTS { 0 } else { parameters };
        let has_room_for = |more: usize| (all + more) * level.len() <= MOST_PRODUCTS;
        let first = graph.inputs();
        let inputs = first + symbols.len() + circles.count();
        let (graph, made) = record(inputs, |inputs| {
            let (inputs, turns) = inputs.split_at(first + symbols.len());
            let points = Circles::points(turns);
            let turned = circles.values(&points)?;
            let given = |place: usize| {
                let symbol = || inputs.get(first + symbols.binary_search(&place).ok()?).copied();
                turned.get(&place).copied().or_else(symbol)
            };
            let made = graph.repeated_with(&reached, &inputs[..first], given);
            let at = |value: &Expr| made[graph.place(*value)];
            let values: Option<Vec<Expr>> = values.iter().map(at).collect();
            let own: Vec<Expr> = level.iter().map(at).collect::<Option<_>>()?;
            let mut factors: Vec<Expr> =
                multipliers.iter().map(|place| made[*place]).collect::<Option<_>>()?;
            // Sines of sums are products of these, and may be multiples themselves.
            if has_room_for(turned.len()) {
                factors.extend(turned.values());
            }
            for point in points.concat() {
                factors.push(point);
                factors.extend(inputs[..parameters].iter().map(|parameter| point * *parameter));
            }
            let products =
                factors.iter().flat_map(|factor| own.iter().map(move |own| *factor * *own));
            let basis: Vec<Expr> = own.iter().copied().chain(products).collect();
            Some((values?, basis))
        })?;
        let Some((values, basis)) = made else { return Ok(None) };
        combination_certificate(&graph, &values, &basis, self.options.seed)
    }
}

/// Whether what an operation needs of an argument is known.
fn is_among(known: &[(usize, Need)], (place, need): (usize, Need)) -> bool {
    known.iter().any(|(own, known)| *own == place && known.includes(need))
}

/// Settles a claim as proved at all points of its level.
fn prove(status: &mut ClaimState, proof: Proof) {
    status.rung(Method::PrimeField, proof.to_string());
    status.evidence.proof = Some(proof);
    (status.is_zero, status.is_combination) = (true, true);
    (status.blurred, status.partial, status.evidence.silence) = (None, None, None);
    status.nonzero.clear();
    // Whether there is a state is not yet known.
    if status.undefined.is_none() {
        status.evidence.method = Method::PrimeField;
        status.settled = Some(Verdict::Proved);
    }
}

/// Whether a step makes a value that counts as a symbol: it is no sum, product or quotient.
fn is_symbol(step: Step<'_>) -> bool {
    match step {
        Step::Constant(_) | Step::Input(_) => false,
        Step::Unary(function, _) => !matches!(function, UnaryFunction::Neg | UnaryFunction::Recip),
        Step::Binary(operation, ..) => operation == BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_none(),
    }
}

/// Lists the places of the multipliers that are tried: inputs, symbols, and quotients, such as the reactions of
/// constraints.
fn multipliers(graph: &Graph, reached: &[bool], symbols: &[usize]) -> Vec<usize> {
    let places = || (0..reached.len()).filter(|place| reached[*place]);
    let is_input = |place: &usize| matches!(graph.step(*place), Step::Input(_));
    let is_inverse =
        |place: usize| matches!(graph.step(place), Step::Unary(UnaryFunction::Recip, _));
    let is_quotient = |place: &usize| match graph.step(*place) {
        Step::Binary(BinaryOperation::Mul, a, b) => is_inverse(a) || is_inverse(b),
        _ => false,
    };
    let mut found: Vec<usize> = places().filter(is_input).collect();
    found.extend(symbols);
    // Those that were made last are nearest to the values.
    let mut quotients: Vec<usize> = places().filter(is_quotient).collect();
    quotients.reverse();
    quotients.truncate(MOST_QUOTIENTS);
    found.extend(quotients);
    found
}
