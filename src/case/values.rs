//! Claims, names and variables that a case takes as values, with the checks of the file's reader.

use super::claim_error::ClaimError;
use super::claim_table::{ClaimTable, stranger};
use super::{Case, PlacedClaim, TABLE_ROWS};
use crate::claim::{Claim, ClaimKind, Reader, STATEMENTS, jets};
use crate::formula::{Formula, FormulaError, canonical_name};
use crate::mechanics::Dependence;

impl Case {
    /// Reads a formula in the names of the case.
    pub fn formula(&self, text: &str) -> Result<Formula, FormulaError> {
        Formula::parse(text, &self.model.vocabulary)
    }

    /// Returns the same system with these claims, and no others.
    ///
    /// # Errors
    /// A claim is about another kind of system, or its formulas are in the names of another case or
    /// do not have the types that the kind of claim requires.
    pub fn with_claims(&self, claims: &[Claim]) -> Result<Self, ClaimError> {
        let mut taken = self.without_claims();
        let mut other = self.case_without_time().map(Self::without_claims);
        let mut names = Vec::new();
        for claim in claims {
            let own = self.placed(claim, &names);
            // What does not use `t` is placed in the system without it, too.
            let elsewhere = other.as_ref().and_then(|other| other.placed(claim, &names).ok());
            match &own {
                Err(error) if elsewhere.is_none() => return Err(error.clone()),
                _ => {}
            }
            let placed = own.as_ref().ok().or(elsewhere.as_ref());
            names.extend(placed.map(|placed| placed.name.clone()));
            taken.claims.extend(own.ok());
            if let (Some(other), Some(placed)) = (&mut other, elsewhere) {
                other.claims.push(placed);
            }
        }
        if let Some(other) = other {
            taken.attach(other, names);
        }
        Ok(taken)
    }

    /// Returns the same system without claims.
    fn without_claims(&self) -> Self {
        let mut bare = self.clone();
        bare.claims.clear();
        bare.motions.clear();
        bare.absences.clear();
        bare.without_time = None;
        bare
    }

    fn placed(&self, claim: &Claim, taken: &[String]) -> Result<PlacedClaim, ClaimError> {
        let model = &self.model;
        let values = ClaimTable { claim, model };
        values.check_keys()?;
        let kind = ClaimKind::read(claim.key(), &values).unwrap_or_else(|| {
            let remedy = format!("use one of {}", STATEMENTS.join(", "));
            Err(values.complaint(claim.key(), "this kind of claim is unknown".to_string(), &remedy))
        })?;
        let formulas = kind.formulas();
        let rigid = |index: &usize| model.is_rigid(*index, &formulas);
        if let Some(index) = kind.changes().into_iter().find(rigid) {
            let name = &model.parameters[index].name;
            let message = format!("`{name}` is used in a size or an index, and cannot change");
            return Err(values.complaint(kind.name(), message, "change another parameter"));
        }
        if let Some(objection) = kind.objection(model) {
            return Err(values.complaint(kind.name(), objection.message, objection.remedy));
        }
        self.check_degree(kind.name()).map_err(|(message, remedy)| {
            values.complaint(kind.name(), message.to_string(), remedy)
        })?;
        if let Some(cell) = claim.cell().filter(|cell| !TABLE_ROWS.contains(cell)) {
            let message = format!("`{cell}` is not a row of the paper's tables");
            let remedy = format!("the rows are {}", TABLE_ROWS.join(", "));
            return Err(values.complaint(kind.name(), message, &remedy));
        }
        let (place, only_there) = values.place()?;
        Ok(PlacedClaim {
            name: values.name(&kind, taken)?,
            source: claim.source().to_string(),
            place,
            only_there,
            is_wanted: true,
            expect: claim.expect(),
            cell: claim.cell().map(str::to_string),
            note: claim.note().map(str::to_string),
            kind,
        })
    }

    /// Checks that the arbitrary functions, whose degree fits the claims of the case, fit a claim of
    /// this kind; otherwise returns the reason and a remedy.
    pub(super) fn check_degree(&self, key: &str) -> Result<(), (&'static str, &'static str)> {
        let has = self.claims.iter().map(|claim| jets(claim.kind.name())).max();
        if jets(key) <= has.unwrap_or_default() || !self.model.system.has_arbitrary_function() {
            return Ok(());
        }
        Err((
            "the arbitrary functions of this case have too low a degree for this claim",
            "state a claim of this kind in the case file",
        ))
    }

    /// Defines a name for a formula; it hides an earlier meaning of the name.
    pub fn define(&mut self, name: &str, formula: &Formula) -> Result<(), ClaimError> {
        let canonical = canonical_name(name).ok_or_else(|| {
            ClaimError::new(name, "this is not a name", "write letters, then digits, primes or _")
        })?;
        self.model.vocabulary.check_own(formula).map_err(|other| stranger(name, &other))?;
        let without_time = self.take_without_time();
        let model = &mut self.model;
        let reach =
            model.vocabulary.reach(formula).map_or(Dependence::Parameters, |entry| entry.reach);
        model.vocabulary.define(&canonical, model.abbreviations.len(), formula, reach);
        model.abbreviations.push(formula.clone());
        if let Some((mut other, order)) = without_time {
            // A name for what uses `t` is left out there.
            if let Ok(formula) = other.formula(formula.text()) {
                other.define(name, &formula)?;
            }
            self.attach(other, order);
        }
        Ok(())
    }
}
