//! Searches, and the theorems that they state.

use libtest_mimic::{Failed, Trial};
use liouville::case::Case;
use liouville::verdict::Options;
use liouville_search::{Effort, Hamiltonians, search};

use crate::file::Asked;

/// Tests that no theorem is one of the wrong ones.
pub fn trial(asked: Asked) -> Trial {
    Trial::test(asked.shows.clone(), move || {
        (1..=asked.seeds).try_for_each(|seed| check(&asked, seed))
    })
}

fn check(asked: &Asked, seed: u64) -> Result<(), Failed> {
    let case = Case::parse(&asked.case, &[]).map_err(|error| Failed::from(error.to_string()))?;
    let options = Options { seed, ..Options::default() };
    let poisson = asked.hamiltonian.clone().map(Hamiltonians::Given);
    let effort = Effort { degree: 4, poisson, options, ..Effort::default() };
    let report =
        search(&case, &effort, &mut |_| {}).map_err(|error| Failed::from(error.to_string()))?;
    for excluded in &report.excluded {
        let said = &excluded.theorem;
        if let Some(wrong) = asked.wrong.iter().find(|wrong| said.contains(*wrong)) {
            return Err(Failed::from(format!("at seed {seed}, \"{wrong}\" is wrong in\n{said}")));
        }
    }
    if asked.density && report.multipliers.iter().any(|one| one.degree == 0 && one.dimension == 0) {
        return Err(Failed::from(format!(
            "at seed {seed}, there is a density of the configuration"
        )));
    }
    let Some((degree, least)) = asked.least else { return Ok(()) };
    match report.counts.iter().find(|count| count.degree == degree) {
        Some(count) if count.dimension < least => {
            let found = count.dimension;
            let told =
                format!("at seed {seed}, degree {degree} has {least} integrals, not {found}");
            Err(Failed::from(told))
        }
        // A system that cannot be counted is not miscounted.
        _ => Ok(()),
    }
}
