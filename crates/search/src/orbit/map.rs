//! Search of a map: its density, integrals of finite orders, relations along its orbits, and integrals over densities.

use liouville::case::Case;

use super::super::{Effort, SearchError, SearchReport};
use super::setting::OrbitSetting;
use super::{
    along_orbits, counted, finite_order, further_limits, integrals, logarithms, map_densities,
    map_products, map_weighted,
};

/// Searches a map for a density and for integrals; proved ones go into the report. If `further`, the
/// limits grow while there is time.
pub fn search(
    case: &Case,
    effort: &Effort,
    further: bool,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    match OrbitSetting::of(case, effort)? {
        Ok(setting) => {
            map_densities::densities(&setting, report, progress)?;
            finite_order::finite_order(&setting, report)?;
            let before = report.orbits.len();
            let outcome = counted(case, effort, report, |report| {
                along_orbits(&setting, further_limits(further), report, progress)
            });
            // All points of an orbit but its first satisfy what all images do.
            if report.orbits.len() > before && !setting.fills_space()? {
                report.orbits.truncate(before);
                report.remark(
                    "relations along orbits are not counted: the images of the map do not fill the space"
                        .to_string(),
                );
            }
            outcome?;
            map_weighted::search(&setting, integrals(&report.orbits[before..]), report)
        }
        Err(reason) => {
            report.remark(format!("no relations along orbits: {reason}"));
            Ok(())
        }
    }?;
    logarithms::search(case, effort, report, progress)?;
    map_products::search(case, effort, report, progress)
}
