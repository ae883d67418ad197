//! Remarks on what a search along orbits leaves out.

use super::super::origin::RemarkOrigin;
use super::super::{SearchReport, lists};
use super::setting::OrbitSetting;

/// Remark where integrals are counted and lists keep them from being written.
const OF_LISTS: &str = "an integral is written only if one formula holds for all listed values of the \
    parameters: give one value of each list, as with --set a=1";
/// Remark where the steps for coefficients that depend on the parameters are spent.
const OF_STEPS: &str = "coefficients that depend on the parameters, or are no fractions, are not all \
    sought: that takes longer than a quarter of --count-seconds; give values with --set, or more time";

/// Notes that steps are spent, that relations are counted for the first of listed values, and that
/// integrals counted there are not written.
pub fn note(
    setting: &OrbitSetting<'_>,
    is_of_lists: bool,
    is_open: bool,
    report: &mut SearchReport,
) {
    if !setting.steps.takes(0.0) {
        report.remark(OF_STEPS.to_string());
    }
    if is_of_lists {
        let values = lists::first_values(setting.case).unwrap_or_default();
        let text = format!("relations along an orbit are counted for {values}");
        report.remark_of(RemarkOrigin::FirstValues, text);
    }
    if is_open {
        report.remark_of(RemarkOrigin::Lists, OF_LISTS.to_string());
    }
}
