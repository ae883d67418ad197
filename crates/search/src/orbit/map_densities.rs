//! Densities of maps: P or 1/P with a polynomial P; fractions P/Q are sought at last.
//!
//! ρ is the density of a measure that a map Φ preserves if |ρ∘Φ det DΦ| = |ρ|. For ρ = 1/P this is
//! P∘Φ = ±det DΦ P: P is a discrete Darboux polynomial with the cofactor ±det DΦ (Celledoni, Evripidou,
//! McLaren, Owren, Quispel, Tapley, van der Kamp, J. Phys. A 52 (2019) 31LT01), and for ρ = P its cofactor
//! is ±1/det DΦ. Either way the equation is linear in the coefficients of P.

use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::graph::Tape;
use liouville::verdict::{ClaimReport, Verdict};

use super::super::ansatz::note_unwritten_density;
use super::super::ansatz::system::PrimePoint;
use super::super::ask::judged_alone;
use super::super::echelon::Echelon;
use super::super::origin::RemarkOrigin;
use super::super::terms::{one, recorded};
use super::super::{FoundKind, SearchError, SearchReport};
use super::claims::{self, OrbitStatement};
use super::images::{self, Images};
use super::map_fractions;
use super::monomials;
use super::setting::{OrbitSetting, SPARE_ORDERS, run};

/// Largest number of monomials of P.
const MONOMIALS: usize = 300;
/// Largest degree of P.
const DEGREE: u32 = 8;

/// The form of a density and the sign of the cofactor.
#[derive(Clone, Copy)]
struct DensityForm {
    is_inverse: bool,
    is_negative: bool,
}

const FORMS: [DensityForm; 4] = [
    DensityForm { is_inverse: true, is_negative: false },
    DensityForm { is_inverse: false, is_negative: false },
    DensityForm { is_inverse: true, is_negative: true },
    DensityForm { is_inverse: false, is_negative: true },
];

/// Searches for a density of a map; the one of least degree goes into the report if it is proved.
pub fn densities(
    setting: &OrbitSetting<'_>,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if setting.is_on_level() || !setting.fills_space()? {
        return Ok(());
    }
    let (graph, outputs) = recorded(setting.case, |jet| {
        let mut outputs = jet.phase.field().to_vec();
        outputs.push(jet.expansion(&[]));
        outputs
    })?;
    let tape = Tape::new(&graph, &outputs);
    let variables: Vec<usize> = (0..setting.dimension()).collect();
    for degree in 0..=DEGREE {
        if monomials::count(setting.dimension(), degree) > MONOMIALS {
            break;
        }
        progress(&format!("densities of the map, degree {degree}"));
        let all = monomials::up_to(&variables, setting.dimension(), degree);
        for form in FORMS {
            if let Some(is_told) = density(setting, &tape, &all, form, report)? {
                if is_told {
                    return Ok(());
                }
                let what = format!("a density of degree {degree} with {} terms", all.len());
                note_unwritten_density(setting.case, &what, report);
                return Ok(());
            }
        }
    }
    map_fractions::density(setting, &tape, report, progress).map(|_| ())
}

/// Searches for a density of one form; returns whether it was written, `None` if there is none. One that
/// is not proved is noted.
fn density(
    setting: &OrbitSetting<'_>,
    tape: &Tape,
    all: &[Vec<u32>],
    form: DensityForm,
    report: &mut SearchReport,
) -> Result<Option<bool>, SearchError> {
    let echelon_at = |at: &PrimePoint| -> Option<Echelon> {
        let m = at.modulus;
        let mut echelon = Echelon::new(all.len(), m);
        let wanted = all.len() + SPARE_ORDERS;
        let mut rows = 0;
        // A root exists at half of all points.
        for number in 0..4 * wanted as u64 {
            setting.effort.halt.check().ok()?;
            let point = setting.point(at, number)?;
            let inputs = [point.parameters.as_slice(), &point.state].concat();
            let Some(mut image) = run(tape, m, &inputs) else { continue };
            let factor = image.pop()?;
            let factor = if form.is_negative { m.sub(0, factor) } else { factor };
            let row = all.iter().map(|own| {
                let (here, there) =
                    (monomials::value(&m, &point.state, own), monomials::value(&m, &image, own));
                match form.is_inverse {
                    true => m.sub(there, m.mul(factor, here)),
                    false => m.sub(m.mul(factor, there), here),
                }
            });
            echelon.push(row.collect());
            rows += 1;
            if rows == wanted {
                return Some(echelon);
            }
        }
        None
    };
    let first = setting.at(0, 0).and_then(|at| echelon_at(&at));
    setting.effort.halt.check()?;
    let Some(last) = first.and_then(|echelon| echelon.free().first().copied()) else {
        return Ok(None);
    };
    // The vector whose last entry is the first that can be: the others are 0 behind it.
    let make = |at: &PrimePoint| {
        let echelon = echelon_at(at)?;
        if echelon.free().first() != Some(&last) {
            return None;
        }
        let mut vector = echelon.null_vector(last);
        vector.truncate(last);
        Some(vector)
    };
    let images = Images { setting, width: last, is_split: false, make };
    let coefficients = images::coefficients(&images)?;
    setting.effort.halt.check()?;
    let Some(coefficients) = coefficients else { return Ok(Some(false)) };
    let functions = setting.functions(&all[..=last])?;
    let places: Vec<usize> = (0..=last).collect();
    let Some(polynomial) = coefficients.sum(&places, &functions)? else { return Ok(Some(false)) };
    let density: Formula = match (last, form.is_inverse) {
        (0, _) => one(),
        (_, false) => polynomial,
        (_, true) => (one() / &polynomial.bracketed())?,
    };
    let statement = OrbitStatement::Density(density.clone());
    if !claims::other(setting, FoundKind::Density, &density, &statement, None, report)? {
        let claim = Claim::density(&density);
        if let Some(judged) = judged_alone(setting.case, claim, setting.effort)? {
            note_unproved(&density, &judged, report);
        }
    }
    Ok(Some(true))
}

/// Notes a density that satisfies its equation, and is not proved, with the reason.
pub fn note_unproved(density: &Formula, judged: &ClaimReport, report: &mut SearchReport) {
    if judged.verdict != Verdict::Refuted {
        let reason = judged.evidence.reason.as_ref().map(|own| format!(": {own}"));
        let reason = reason.unwrap_or_default();
        let text = format!("found, but not proved: the density {density}{reason}");
        report.remark_of(RemarkOrigin::Unproved, text);
    }
}
