//! Potentials and forces under which an integral persists, within a linear ansatz.
//!
//! Let F be an integral of degree 1 or 2 in the velocities, and A(∇U) the contribution of a potential U
//! of the positions to the field, linear in ∇U. Then F + G, with a function G of the positions, is an
//! integral with U exactly when (∂F, A(∇U)) + L_v G = 0: linear in U and G. For forces Q of a field it
//! is Σ Qᵢ ∂F/∂wᵢ + L_v G = 0. All functions are polynomials over some denominators.

use super::super::ask::{holds, is_energy, judged_alone};
use super::super::branches::are_true;
use super::super::products::{degree_in, told};
use super::super::terms::one;
use super::super::{Effort, Excluded, Found, FoundKind, Given, SearchError, SearchReport};
use super::coefficients::{PrimitiveVector, Ratio};
use super::force_family::{ForceEntry, ForceFamily};
use super::force_text::{ForcedIntegral, SurvivingForce};
use super::note_unwritten;
use super::size::SystemSize;
use super::system::{Column, LinearSystem};
use super::theorem::at_most;
use crate::hypotheses::stated;
use crate::origin::{RemarkOrigin, TheoremOrigin};
use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::{Formula, FormulaError};
use liouville::mechanics::Draw;
use liouville::order::StableOrder;
use liouville::verdict::ClaimReport;

/// Largest number of products of integrals of degree 1.
const PRODUCTS: usize = 6;
/// Largest number of forces that are written out.
const LISTED: usize = 24;

/// Finds, for each known integral of degree 1 or 2, the potentials or forces under which it persists.
pub fn potentials(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let family = match ForceFamily::of(case, effort)? {
        Ok(family) => family,
        Err(reason) => {
            report.remark(format!("no search for potentials: {reason}"));
            return Ok(());
        }
    };
    let coordinates = family.coordinates(case);
    let (mut own, mut linear) = (Vec::new(), Vec::new());
    for formula in told(case, effort, report)?.into_iter().filter(|own| !is_energy(own)) {
        let degree = degree_in(case, &formula, &coordinates, effort.options.seed)?;
        if degree == Some(1) {
            linear.push(formula.clone());
        }
        if degree.is_some_and(|degree| (1..=2).contains(&degree)) {
            own.push(formula);
        }
    }
    own.extend(products(&linear)?);
    if own.is_empty() {
        report.remark(
            "no integral of degree 1 or 2 in the velocities is known that could survive a potential"
                .to_string(),
        );
    }
    let is_list = |draw: &Draw| matches!(draw, Draw::OneOf(values) if values.len() > 1);
    let has_theorem = are_true(case, effort)? && !case.model.parameter_draws().iter().any(is_list);
    for integral in own {
        effort.halt.check()?;
        let search = ForceSearch { case, effort, family: &family, integral, has_theorem };
        match search.search(report, progress) {
            Err(error @ SearchError::NoChart) => {
                report.remark(format!("no search for potentials: {error}"));
                return Ok(());
            }
            other => other?,
        }
    }
    Ok(())
}

/// Products of two of some integrals of degree 1, squares first: under a potential that separates the
/// variables the square of a momentum survives with an added function, and the momentum does not.
fn products(linear: &[Formula]) -> Result<Vec<Formula>, FormulaError> {
    let squares = linear.iter().map(|own| own.raised(2));
    let pairs = (0..linear.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    let products = pairs.map(|(i, j)| &linear[i] * &linear[j]);
    squares.chain(products).take(PRODUCTS).collect()
}

/// Columns of the unknowns, and a basis of the relations between them.
type Solutions = (Vec<usize>, Vec<Vec<u64>>);

/// The search for the forces that preserve one integral.
struct ForceSearch<'a> {
    case: &'a Case,
    effort: &'a Effort,
    family: &'a ForceFamily,
    integral: Formula,
    /// Whether what is missing modulo a prime is missing at real states.
    has_theorem: bool,
}

impl ForceSearch<'_> {
    fn search(
        &self,
        report: &mut SearchReport,
        progress: &mut dyn FnMut(&str),
    ) -> Result<(), SearchError> {
        let family = self.family;
        let mut outcome = Ok(());
        let mut system = LinearSystem::record(self.case, self.effort, |jet, recording| {
            outcome = family.record(&self.integral, jet, recording);
        })?;
        outcome?;
        // The forces' columns are last, so that their coefficients are the free ones.
        let gains = family.gains();
        let first = gains.len();
        system.columns = gains.into_iter().chain(family.forces()).collect();
        let count = system.columns.len();
        let size = SystemSize::of(&[(0..count).collect()]);
        let what = format!("{} that preserve {}", self.kind(), self.integral);
        progress(&format!("{what}: {size}"));
        if let Some(reason) = size.beyond(self.effort) {
            let text = format!("{what}: not tried; {size}; {reason}");
            report.remark_of(RemarkOrigin::NotTried, text);
            return Ok(());
        }
        let Some((columns, vectors)) = self.solved(&system, first)? else {
            report.remark(format!(
                "{what}: not tried; formulas with exp, ln, sin, cos or general powers have no values \
                 modulo a prime"
            ));
            return Ok(());
        };
        let (mut dimension, mut supports) = (0, Vec::new());
        for vector in &vectors {
            let pairs = columns.iter().zip(vector).filter(|(_, entry)| **entry != 0);
            let support: Vec<usize> = pairs.map(|(column, _)| *column).collect();
            if support.last().is_some_and(|last| *last >= first) {
                dimension += 1;
                supports.push(support);
            }
        }
        // Polynomials come first, and what has no gain: members of a family are left out then.
        let is_fraction = |column: &usize| matches!(&system.columns[*column], Column::Product { factor, .. } if *factor > 0);
        let has_gain = |support: &Vec<usize>| support.first().is_some_and(|own| *own < first);
        supports.order_by_key(|own| (has_gain(own), own.iter().any(is_fraction), own.len()));
        let (free, gaining): (Vec<_>, Vec<_>) =
            supports.into_iter().partition(|own| !has_gain(own));
        let mut found = Vec::new();
        for support in free.iter().take(LISTED).chain(gaining.iter().take(LISTED)) {
            match PrimitiveVector::of(&system, support)? {
                Some(coefficients) => {
                    found.push(self.written(&system, support, first, &coefficients)?);
                }
                None => {
                    let what = format!("a {} with {} terms", self.word(), support.len());
                    note_unwritten(self.case, &what, report);
                }
            }
        }
        let told = if self.tell(&mut found, report)? { dimension } else { found.len() };
        if self.has_theorem {
            report.excluded.push(self.theorem(dimension, told));
        }
        Ok(())
    }

    fn word(&self) -> &'static str {
        match self.family.entry {
            ForceEntry::Potential(_) => "potential",
            ForceEntry::Rates(_) => "force",
        }
    }

    fn given(&self, text: String) -> Given {
        match self.family.entry {
            ForceEntry::Potential(_) => Given::Potential(text),
            ForceEntry::Rates(_) => Given::Force(text),
        }
    }

    fn kind(&self) -> String {
        format!("{}s", self.word())
    }

    /// Columns of the unknowns, and a basis of the relations between them; `None` without values.
    fn solved(
        &self,
        system: &LinearSystem,
        first: usize,
    ) -> Result<Option<Solutions>, SearchError> {
        let Some(columns) = self.columns(system, first)? else { return Ok(None) };
        let Some(at) = system.at(0, 0) else { return Ok(None) };
        Ok(system.null_space(&at, &columns)?.map(|vectors| (columns, vectors)))
    }

    /// Selects columns of which none depends on others, without constants that have no effect.
    fn columns(
        &self,
        system: &LinearSystem,
        first: usize,
    ) -> Result<Option<Vec<usize>>, SearchError> {
        let Some(at) = system.at(0, 0) else { return Ok(None) };
        let each = (system.columns.len() - first) / self.family.ways();
        let starts = (0..self.family.ways()).map(|way| first + way * each);
        let mut columns = Vec::new();
        let forces = starts.map(|start| start..start + each);
        for range in std::iter::once(0..first).chain(forces) {
            let own: Vec<usize> = range.collect();
            let Some(distinct) = system.distinct(&at, &own)? else { return Ok(None) };
            let is_idle = own[0] < first || matches!(self.family.entry, ForceEntry::Potential(_));
            columns.extend(distinct.into_iter().filter(|column| !is_idle || *column != own[0]));
        }
        Ok(Some(columns))
    }

    /// Writes the force and the gain that a null vector consists of.
    fn written(
        &self,
        system: &LinearSystem,
        support: &[usize],
        first: usize,
        coefficients: &PrimitiveVector,
    ) -> Result<SurvivingForce, SearchError> {
        let derivation = |k: &usize| match &system.columns[support[*k]] {
            Column::Product { derivation, .. } => *derivation,
            Column::Given(_) => usize::MAX,
        };
        let all: Vec<usize> = (0..support.len()).collect();
        let sum = |own: &[usize]| -> Result<Option<Formula>, FormulaError> {
            let function = |k: &usize| match &system.columns[support[*k]] {
                Column::Product { factor, exponents, .. } => {
                    self.family.written(*factor, exponents)
                }
                Column::Given(_) => Ok(Ratio::of(one())),
            };
            let functions: Vec<Ratio> = own.iter().map(function).collect::<Result<_, _>>()?;
            coefficients.sum(own, &functions)
        };
        let parts = (0..self.family.ways()).map(|way| {
            let own: Vec<usize> = all
                .iter()
                .copied()
                .filter(|k| support[*k] >= first && derivation(k) == way)
                .collect();
            sum(&own)
        });
        let parts: Vec<Option<Formula>> = parts.collect::<Result<_, FormulaError>>()?;
        let (gains, forces): (Vec<usize>, Vec<usize>) =
            all.iter().copied().partition(|k| support[*k] < first);
        let key = |k: &usize| match &system.columns[support[*k]] {
            Column::Product { factor, exponents, .. } => (*factor, exponents.clone()),
            Column::Given(_) => (usize::MAX, Vec::new()),
        };
        let ratio = coefficients.ratio(&gains, &forces, &key)?;
        Ok(SurvivingForce { parts, gain: sum(&gains)?, ratio })
    }

    /// Reports the integral with all forces, each with a free constant or function, and keeps those that
    /// are proved; returns whether these are all functions.
    fn tell(
        &self,
        found: &mut Vec<SurvivingForce>,
        report: &mut SearchReport,
    ) -> Result<bool, SearchError> {
        // Where not all are proved together, those are told that are proved alone.
        for attempt in 0..2 {
            if found.is_empty() {
                return Ok(false);
            }
            let Some((forced, verdict)) = self.judged(found)? else { break };
            if holds(&verdict) {
                let model = &forced.case.model;
                let texts = (forced.integral, forced.force);
                let judged = [&forced.judged];
                let mut one =
                    Found::of_several(FoundKind::Integral, texts.0, &judged, verdict, model);
                one.with = vec![self.given(texts.1)];
                report.found.push(one);
                return Ok(forced.is_whole);
            }
            report.remark(format!(
                "found, but not proved ({}): {} with the {} {}",
                verdict.verdict.word(),
                forced.integral,
                self.word(),
                forced.force
            ));
            if attempt == 0 {
                let mut kept = Vec::new();
                for own in found.drain(..) {
                    let alone = self.judged(std::slice::from_ref(&own))?;
                    if alone.is_some_and(|(_, verdict)| holds(&verdict)) {
                        kept.push(own);
                    }
                }
                *found = kept;
            }
        }
        found.clear();
        Ok(false)
    }

    /// Judges the integral with forces.
    fn judged(
        &self,
        found: &[SurvivingForce],
    ) -> Result<Option<(ForcedIntegral, ClaimReport)>, SearchError> {
        let Self { case, family, integral, effort, .. } = self;
        let Some(forced) = ForcedIntegral::of(case, family, integral, found, effort)? else {
            return Ok(None);
        };
        let verdict = judged_alone(&forced.case, Claim::integral(&forced.judged), effort)?;
        Ok(verdict.map(|verdict| (forced, verdict)))
    }

    fn theorem(&self, dimension: usize, told: usize) -> Excluded {
        let ForceFamily { below, degree, gain, names, .. } = self.family;
        let over: Vec<&str> = below.iter().map(Formula::text).collect();
        let over = over.join(", ");
        let (symbol, aside) = match self.family.entry {
            ForceEntry::Potential(_) => ("U", ", constants aside,"),
            ForceEntry::Rates(_) => ("Q", ""),
        };
        let kind = self.kind();
        Excluded {
            ansatz: format!(
                "{kind} {symbol} = Σ p/d, p a polynomial in {names} of degree at most {degree}, d one of {over}"
            ),
            dimension,
            known: told,
            origin: TheoremOrigin::Forces,
            values: None,
            error_log2: None,
            theorem: stated(
                &self.case.model,
                &format!(
                    "{} an integral {} + G({names}) with G = Σ p/d, p of degree at most {gain}{}.",
                    at_most(dimension, self.word(), &kind, &format!(" of this form{aside}")),
                    self.integral,
                    if told == dimension && told > 0 { ": those listed here" } else { "" }
                ),
            ),
        }
    }
}
