//! Files in which claims alone use `t`: each claim that does not is judged in the system without `t`.
//!
//! The variable `t` of rate 1 changes what some claims say: nothing rests, no orbit is closed, and e^(−ct) is a
//! density of each field of divergence c. So a claim that does not use `t` has the meaning that it has in a file of
//! its own.

use std::collections::{BTreeMap, BTreeSet};

use crate::order::StableOrder;

use super::Case;

/// Names of claims by their places in the file.
pub(super) type Places = BTreeMap<usize, String>;

/// The same system without `t`.
#[derive(Clone, Debug)]
pub(super) struct WithoutTime {
    /// The system with the claims that do not use `t`.
    case: Box<Case>,
    /// Names of all claims in the order of the file.
    order: Vec<String>,
    /// Description of the system with `t`, for which this one stands.
    stands_for: String,
}

/// A case in two parts with different claims.
#[derive(Debug)]
pub struct TimeParts {
    /// The system without `t`, and the claims that do not use it.
    pub without_time: Case,
    /// The system with `t`, and the claims that use it.
    pub with_time: Case,
    /// Names of all claims in the order of the file.
    order: Vec<String>,
}

impl TimeParts {
    /// Sorts what has names of claims into the order of the file.
    pub fn sort<T>(&self, items: &mut [T], name: impl Fn(&T) -> &str) {
        let place = |item: &T| self.order.iter().position(|own| own == name(item));
        items.order_by_key(place);
    }
}

impl Case {
    /// Splits a case of which claims alone use `t`; `None` for all others, and where the system was changed since
    /// it was read.
    pub fn time_parts(&self) -> Option<TimeParts> {
        let WithoutTime { case, order, .. } = self.stands_without_time()?;
        let mut with_time = self.clone();
        with_time.without_time = None;
        let names: BTreeSet<&str> = case.claim_names().collect();
        with_time.claims.retain(|own| !names.contains(own.name.as_str()));
        with_time.motions.retain(|own| !names.contains(own.name.as_str()));
        with_time.absences.retain(|own| !names.contains(own.name.as_str()));
        Some(TimeParts { without_time: (**case).clone(), with_time, order: order.clone() })
    }

    /// Returns the case in which a claim is judged.
    pub fn home(&self, claim: &str) -> &Case {
        let other = self.stands_without_time().map(|own| &*own.case);
        other.filter(|own| own.claim_names().any(|name| name == claim)).unwrap_or(self)
    }

    /// Iterates over the cases in which claims are judged: this one, and that without `t`.
    pub fn homes(&self) -> impl Iterator<Item = &Case> {
        std::iter::once(self).chain(self.stands_without_time().map(|own| &*own.case))
    }

    /// Changes the case, and the same case without `t`; the system has to stay as it is.
    pub fn change_claims(&mut self, change: &dyn Fn(&mut Case)) {
        change(self);
        if let Some(other) = &mut self.without_time {
            change(&mut other.case);
        }
    }

    /// Attaches the same system without `t`, if it has claims; `own` and `other` are the names of the claims that
    /// could be read in both, by their places in the file.
    pub(super) fn attach_without_time(&mut self, own: &Places, mut case: Case, other: &Places) {
        let mut order = own.clone();
        for (place, name) in other {
            let name = order.get(place).cloned().unwrap_or_else(|| {
                let is_taken = |name: &String| order.values().any(|taken| taken == name);
                let numbered = (2..).map(|number| format!("{name} ({number})"));
                let mut names = std::iter::once(name.clone()).chain(numbered);
                names.find(|name| !is_taken(name)).unwrap_or_default()
            });
            order.insert(*place, name);
        }
        let names = other.iter().map(|(place, name)| (name.clone(), order[place].clone()));
        case.rename_claims(&names.collect());
        self.attach(case, order.into_values().collect());
    }

    /// Attaches the same system without `t`, if it has claims, with the names of all in their order.
    pub(super) fn attach(&mut self, case: Case, order: Vec<String>) {
        let stands_for = self.description();
        let has_claims = case.claim_names().next().is_some();
        let attached = || WithoutTime { case: Box::new(case), order, stands_for };
        self.without_time = has_claims.then(attached);
    }

    fn rename_claims(&mut self, names: &BTreeMap<String, String>) {
        let claims = self.claims.iter_mut().map(|own| &mut own.name);
        let motions = self.motions.iter_mut().map(|own| &mut own.name);
        let absences = self.absences.iter_mut().map(|own| &mut own.name);
        for own in claims.chain(motions).chain(absences) {
            if let Some(name) = names.get(own) {
                own.clone_from(name);
            }
        }
    }

    /// Detaches the same system without `t`, with the names of all claims in their order.
    pub(super) fn take_without_time(&mut self) -> Option<(Case, Vec<String>)> {
        let stands = self.stands_without_time().is_some();
        let own = self.without_time.take().filter(|_| stands)?;
        Some((*own.case, own.order))
    }

    /// Returns the same system without `t`, with its claims.
    pub(super) fn case_without_time(&self) -> Option<&Case> {
        self.stands_without_time().map(|own| &*own.case)
    }

    fn stands_without_time(&self) -> Option<&WithoutTime> {
        self.without_time.as_ref().filter(|own| own.stands_for == self.description())
    }

    /// Describes the system and how its states are drawn.
    fn description(&self) -> String {
        format!("{:?}", (&self.model, &self.chart, &self.free_draws))
    }

    fn claim_names(&self) -> impl Iterator<Item = &str> {
        let claims = self.claims.iter().map(|own| own.name.as_str());
        let motions = self.motions.iter().map(|own| own.name.as_str());
        claims.chain(motions).chain(self.absences.iter().map(|own| own.name.as_str()))
    }
}
