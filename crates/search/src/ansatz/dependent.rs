//! Integrals of an ansatz that are not shown to be independent of those listed.

use super::super::SearchReport;
use liouville::formula::Formula;

/// Integrals that are not shown to be independent of those listed.
#[derive(Default)]
pub struct DependentIntegrals(Vec<Dependent>);

/// Those with one verdict on their independence: their number, and the shortest.
struct Dependent {
    verdict: &'static str,
    count: usize,
    shortest: Formula,
}

impl DependentIntegrals {
    /// Adds one.
    pub fn add(&mut self, verdict: &'static str, formula: &Formula) {
        let length = |own: &Formula| own.text().chars().count();
        match self.0.iter_mut().find(|own| own.verdict == verdict) {
            Some(own) => {
                own.count += 1;
                if length(formula) < length(&own.shortest) {
                    own.shortest = formula.clone();
                }
            }
            None => self.0.push(Dependent { verdict, count: 1, shortest: formula.clone() }),
        }
    }

    /// Notes them once for each verdict.
    pub fn note(&self, report: &mut SearchReport) {
        for Dependent { verdict, count, shortest } in &self.0 {
            report.remark(match count {
                1 => format!(
                    "an integral, whose independence of those listed is {verdict}: {shortest}"
                ),
                count => format!(
                    "{count} integrals, whose independence of those listed is {verdict}; the shortest is {shortest}"
                ),
            });
        }
    }
}
