//! Forces that change nothing about an integral, whatever functions of the positions multiply them.
//!
//! If a force Q satisfies Σ Q_i ∂F/∂w_i = 0, so does f Q for each function f. Forces whose matrices are
//! combinations of others, with functions as coefficients, are left out.

use super::super::ask::{holds, judged_alone};
use super::super::{Found, FoundKind, SearchError, SearchReport};
use super::at_random::values_at_random;
use super::forces::with_constants;
use super::gyro_second::{GyroDirection, Survivors};
use super::gyrostats::GyroSearch;
use crate::echelon::Echelon;
use crate::streams::SearchStream;
use crate::terms::recorded;
use liouville::claim::Claim;
use liouville::formula::Formula;

impl Survivors<'_> {
    /// Reports the forces that change nothing with arbitrary functions, if they are proved; returns
    /// their number, those that are left out included.
    pub fn tell_free(
        &self,
        directions: &[GyroDirection],
        report: &mut SearchReport,
    ) -> Result<usize, SearchError> {
        let GyroSearch { case, effort, family, integral, .. } = self.search;
        let heads = self.heads(directions)?;
        if heads.is_empty() {
            return Ok(0);
        }
        let (mut extended, names) = with_constants(case, "f", heads.len())?;
        let parts: Vec<_> =
            names.iter().zip(&heads).map(|(name, own)| (name, own.slots.as_slice())).collect();
        let slots = family.combined(&parts)?;
        let Some(model) = family.with(&extended.model, &slots) else { return Ok(0) };
        extended.model = model;
        let verdict = judged_alone(&extended, Claim::integral(integral), effort)?;
        let Some(verdict) = verdict.filter(holds) else { return Ok(0) };
        let positions = family.variables.positions().into_iter();
        let positions: Vec<&str> = positions.map(|k| family.variables.terms[k].text()).collect();
        let call = format!("({})", positions.join(", "));
        let names: Vec<String> = names.iter().map(|own| format!("{own}{call}")).collect();
        let functions = if let [only] = names.as_slice() {
            format!("any function {only}")
        } else {
            format!("any functions {}", names.join(", "))
        };
        let text = integral.to_string();
        let model = &extended.model;
        let mut one = Found::of_several(FoundKind::Integral, text, &[integral], verdict, model);
        one.with = vec![family.given(format!("{} for {functions}", family.text(&slots)))];
        report.found.push(one);
        Ok(directions.len())
    }

    /// Forces of which none is a combination of others with functions as coefficients, at a random
    /// state modulo a prime.
    fn heads<'d>(
        &self,
        directions: &'d [GyroDirection],
    ) -> Result<Vec<&'d GyroDirection>, SearchError> {
        let GyroSearch { case, effort, family, .. } = self.search;
        let zero = Formula::number(0);
        let (graph, values) = recorded(case, |jet| {
            let parts = directions.iter().flat_map(|own| &own.parts);
            let value = |part: &Option<(bool, Formula)>| match part {
                None => jet.phase.scalar(&zero),
                Some((false, own)) => jet.phase.scalar(own),
                Some((true, own)) => -jet.phase.scalar(own),
            };
            parts.map(value).collect::<Vec<_>>()
        })?;
        let found = values_at_random::<1>(&graph, &values, SearchStream::Gradients, effort);
        let Some((modulus, values)) = found else { return Ok(Vec::new()) };
        let values = values.concat();
        let mut echelon = Echelon::new(family.count(), modulus);
        let rows = directions.iter().zip(values.chunks(family.count()));
        Ok(rows.filter(|(_, row)| echelon.push(row.to_vec())).map(|(own, _)| own).collect())
    }
}
