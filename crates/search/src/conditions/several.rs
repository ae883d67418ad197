//! Equations between the parameters of a field under which it has more polynomial integrals.
//!
//! All conditions of codimension one are found ([`locus`](super::locus)), and those of higher
//! codimension that become such conditions where one or two simple equations hold: a parameter is 0, or
//! two components of a tensor are equal. Where a condition is linear in some parameter, this one is
//! eliminated, and the integrals are sought and proved.

use liouville::case::Case;
use liouville::verdict::is_filled;

use super::ParameterCondition;
use super::equations::ParametricEquations;
use super::hypersurface::Hypersurface;
use super::locus::{NoLocus, SpecialLocus, special};
use super::relation::unfilled;
use super::simple::{SimpleEquations, simple_equations};
use super::split::SplitCase;
use super::values::{self, integrals_with};
use crate::branches;
use crate::budget::STEPS;
use crate::origin::ConditionOrigin;
use crate::{Effort, Given, SearchError, SearchReport};

/// Steps of a search for integrals where a condition holds: half a second.
pub const SEARCH: f64 = STEPS / 2.0;

/// Finds the conditions on the parameters of a field under which there are more polynomial integrals of
/// at most the degree of the search, and the integrals there.
pub fn conditions(
    case: &Case,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    if !case.model.system.is_field() {
        return Ok(());
    }
    let whole = SplitCase::of(case);
    if whole.scalars.is_empty() {
        return Ok(());
    }
    if !branches::are_true(case, effort)? {
        report.remark(
            "no values of the parameters with more integrals are sought: the formulas contain a \
             modulus, or a root that depends on others"
                .to_string(),
        );
        return Ok(());
    }
    if in_all(&whole, effort, report, progress)? {
        return Ok(());
    }
    // A root of a parameter is no fraction: such parameters stay at random values.
    let held = held(&whole, effort)?;
    let whole = if held.len() < whole.scalars.len() { whole.holding(held) } else { whole };
    if !whole.held.is_empty() && in_all(&whole, effort, report, progress)? {
        return Ok(());
    }
    values::conditions(&whole, effort, report, progress)
}

/// Finds conditions on all scalars at once; `false` if the equations are not fractions of low degree in
/// them, or if there is a single one.
fn in_all(
    whole: &SplitCase,
    effort: &Effort,
    report: &mut SearchReport,
    progress: &mut dyn FnMut(&str),
) -> Result<bool, SearchError> {
    if whole.scalars.len() == 1 {
        return Ok(false);
    }
    let left = effort.seconds * STEPS;
    let mut search = ConditionSearch {
        whole,
        effort,
        report,
        progress,
        found: Vec::new(),
        open: Vec::new(),
        isolated: Vec::new(),
        singular: Vec::new(),
        left,
    };
    let none = SimpleEquations::none(whole.scalars.len());
    if !search.examined(&none, whole)? {
        return Ok(false);
    }
    // Some lines have been examined.
    if search.left < left {
        let simple = search.several(&none)?;
        search.isolated(&simple)?;
    }
    Ok(true)
}

/// Lists the scalars in which the equations are not fractions of low degree.
fn held(whole: &SplitCase, effort: &Effort) -> Result<Vec<String>, SearchError> {
    let Some(equations) = ParametricEquations::new(&whole.case, 1, effort)? else {
        return Ok(Vec::new());
    };
    let (mut held, mut left) = (Vec::new(), effort.seconds * STEPS);
    for scalar in &whole.scalars {
        if special(&equations, &[scalar.draw], &[], &mut left)?.is_err() {
            held.push(scalar.name.clone());
        }
    }
    Ok(held)
}

/// A condition: simple equations, and a further one in the scalars that remain free.
pub struct FoundCondition {
    /// The simple equations.
    pub simple: SimpleEquations,
    /// The further one.
    pub further: Option<Hypersurface>,
}

impl FoundCondition {
    /// Makes a condition of equations; a further one that is simple is one of the simple ones.
    fn of(simple: &SimpleEquations, further: Hypersurface) -> Self {
        match further.simple() {
            Some(own) => Self { simple: simple.with(own), further: None },
            None => Self { simple: simple.clone(), further: Some(further) },
        }
    }

    fn text(&self, whole: &SplitCase) -> String {
        let mut texts = self.simple.texts(&whole.scalars);
        texts.extend(self.further.iter().map(|own| own.equation(&whole.scalars)));
        texts.join(" and ")
    }

    /// Whether it follows from another condition.
    fn is_part_of(&self, other: &Self) -> bool {
        if !self.simple.implies(&other.simple) {
            return false;
        }
        let Some(further) = &other.further else { return true };
        match further.under(&self.simple) {
            None => true,
            Some(own) => self.further.as_ref().is_some_and(|further| further.is_multiple(&own)),
        }
    }
}

/// A search with the conditions found so far.
pub struct ConditionSearch<'s> {
    /// The case.
    pub whole: &'s SplitCase,
    /// Limits of the search.
    pub effort: &'s Effort,
    /// Report of the whole search.
    pub report: &'s mut SearchReport,
    /// Told of each part.
    pub progress: &'s mut dyn FnMut(&str),
    /// Conditions of codimension one, everywhere or where simple equations hold.
    pub found: Vec<FoundCondition>,
    /// Statements with simple equations where further ones may give more: the statement, the degree of
    /// these together, and the simple equations.
    open: Vec<(String, usize, Vec<String>)>,
    /// Conditions of several equations that belong to none of codimension one.
    pub isolated: Vec<Vec<Hypersurface>>,
    /// Real zeros of equations without real hypersurfaces, and the degree at which they may give more.
    pub singular: Vec<(u32, Vec<Hypersurface>)>,
    /// Number of elementary steps that may still be taken.
    pub left: f64,
}

impl ConditionSearch<'_> {
    /// Finds the conditions of codimension one where some simple equations hold; `false` if the
    /// equations are not fractions of low degree.
    fn examined(
        &mut self,
        simple: &SimpleEquations,
        split: &SplitCase,
    ) -> Result<bool, SearchError> {
        let draws: Vec<usize> = split.scalars.iter().map(|own| own.draw).collect();
        let free = simple.free();
        let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
        let names = names.join(", ");
        let is_first = simple.count() == 0;
        let (mut last, mut told) = (0, 0);
        let before = self.report.conditions.len();
        for degree in 1..=self.effort.degree {
            (self.progress)(&format!(
                "conditions on {names} for more integrals of degree {degree}"
            ));
            let Some(equations) = ParametricEquations::new(&split.case, degree, self.effort)?
            else {
                break;
            };
            let holds = |own: &&FoundCondition| simple.implies(&own.simple);
            let known = self.found.iter().filter(holds).filter_map(|own| own.further.as_ref());
            let known: Option<Vec<Hypersurface>> =
                known.map(|own| Some(own.under(simple)?.among(&free))).collect();
            let mut known = known.unwrap_or_default();
            known.extend(
                self.found
                    .iter()
                    .filter_map(|own| own.simple.addition(simple))
                    .map(|own| Hypersurface::from(own, simple.first().len()).among(&free)),
            );
            let own = match special(&equations, &draws, &known, &mut self.left)? {
                Ok(own) => own,
                Err(NoLocus::NoValues) => return Ok(true),
                Err(NoLocus::NoFractions) if degree == 1 && is_first => return Ok(false),
                Err(NoLocus::NoFractions) => {
                    self.report.remark(format!(
                        "conditions on {names} for more integrals of degree {degree} are not sought: \
                         the equations take longer than --count-seconds allows, or are not fractions of \
                         low degree"
                    ));
                    return Ok(true);
                }
            };
            last = degree;
            let conditions = self.report.conditions.len();
            self.tell(simple, split, degree, own)?;
            if self.report.conditions.len() > conditions {
                told = degree;
            }
        }
        if !is_first || last == told {
            return Ok(true);
        }
        if let Some(own) = self.report.conditions[before..].last_mut() {
            own.grounds.push_str(&format!("; none is added up to degree {last}"));
        } else {
            self.report.conditions.push(ParameterCondition {
                of: format!("more polynomial integrals of degree at most {last}, by {names}"),
                equations: Vec::new(),
                grounds: format!("{GROUNDS}; {NO_EQUATION}{}", split.reservation()),
                origin: ConditionOrigin::Polynomials,
            });
        }
        Ok(true)
    }

    /// Reports conditions, and searches for the integrals where they hold.
    fn tell(
        &mut self,
        simple: &SimpleEquations,
        split: &SplitCase,
        degree: u32,
        mut locus: SpecialLocus,
    ) -> Result<(), SearchError> {
        let free = simple.free();
        let unknown = self.without_thin(simple, degree, &mut locus)?;
        let mut equations = Vec::new();
        for own in &locus.surfaces {
            let spread = own.spread(&free, simple.first().len());
            let condition = FoundCondition::of(simple, spread);
            if self.found.iter().any(|known| condition.is_part_of(known)) {
                continue;
            }
            let text = condition.text(self.whole);
            self.found.push(condition);
            let solved = split.letters().and_then(|letters| own.solved(&letters)).ok().flatten();
            if let Some(fixed) = solved.and_then(|value| split.with(vec![value])) {
                if !is_filled(&fixed.case, &self.effort.options)? {
                    self.report.remark(unfilled(&text));
                    continue;
                }
                let with = Given::Condition(text.clone());
                if self.left > 0.0 {
                    integrals_with(&fixed.case, with, self.effort, self.report)?;
                    self.left -= SEARCH;
                } else {
                    self.report.remark(format!(
                        "integrals where {text} are not sought: the bound is {} s, see --count-seconds",
                        self.effort.seconds
                    ));
                }
            }
            equations.push(text);
        }
        if equations.is_empty() && locus.unexplained == 0 {
            return Ok(());
        }
        let reservation = format!("{unknown}{}", split.reservation());
        let of = format!("more polynomial integrals of degree at most {degree}");
        if simple.count() == 0 {
            let names: Vec<&str> = split.scalars.iter().map(|own| own.name.as_str()).collect();
            self.report.conditions.push(ParameterCondition {
                of: format!("{of}, by {}", names.join(", ")),
                equations,
                grounds: format!("{GROUNDS}; {}{reservation}", rest(locus.unexplained)),
                origin: ConditionOrigin::Polynomials,
            });
            return Ok(());
        }
        let of = format!("{of}, by several equations");
        if locus.unexplained > 0 {
            let texts = simple.texts(&self.whole.scalars).join(" and ");
            match self.open.iter_mut().find(|own| own.0 == of && own.1 == locus.unexplained) {
                Some((_, _, all)) => all.push(texts),
                None => self.open.push((of.clone(), locus.unexplained, vec![texts])),
            }
        }
        match self.report.conditions.iter_mut().find(|own| own.of == of) {
            Some(own) => own.equations.extend(equations),
            None => {
                let grounds = format!("{GROUNDS}{reservation}");
                let origin = ConditionOrigin::Polynomials;
                self.report.conditions.push(ParameterCondition { of, equations, grounds, origin });
            }
        }
        Ok(())
    }

    /// Finds conditions where one or two simple equations hold; returns words for these.
    fn several(&mut self, none: &SimpleEquations) -> Result<String, SearchError> {
        let all = simple_equations(self.whole);
        let mut sets: Vec<SimpleEquations> = all.iter().map(|own| none.with(*own)).collect();
        for place in 0..all.len() {
            for other in &all[..place] {
                let own = none.with(*other).with(all[place]);
                if own.count() == 2 && !sets.contains(&own) {
                    sets.push(own);
                }
            }
        }
        let mut admitted = 0;
        for simple in &sets {
            self.effort.halt.check()?;
            if self.left <= 0.0 {
                break;
            }
            admitted += 1;
            // Where they hold there are more integrals already.
            let is_special = |own: &FoundCondition| {
                let further = own.further.as_ref().map(|further| further.under(simple));
                simple.implies(&own.simple) && !matches!(further, Some(Some(_)))
            };
            if self.found.iter().any(is_special) {
                continue;
            }
            if let Some(split) = simple.applied(self.whole) {
                self.examined(simple, &split)?;
            }
        }
        for (of, degree, texts) in &self.open {
            if let Some(own) = self.report.conditions.iter_mut().find(|own| &own.of == of) {
                own.grounds.push_str(&format!(
                    "; {}, where {}",
                    rest(*degree),
                    texts.join("; or ")
                ));
            }
        }
        let scope = match (admitted == sets.len(), admitted >= all.len()) {
            (true, _) => "one or two",
            (false, true) => "one, and for some of them another,",
            (false, false) => "some",
        };
        let texts: Vec<String> =
            all.iter().flat_map(|own| none.with(*own).texts(&self.whole.scalars)).collect();
        Ok(format!("only where {scope} of these hold: {}", texts.join(", ")))
    }
}

/// Method by which conditions are found.
pub const GROUNDS: &str =
    "minors of the equations for the coefficients, on lines and planes of parameters";

/// Grounds where there is no condition.
const NO_EQUATION: &str = "modulo a prime of 61 bits no equation gives more";

/// Says how many conditions there may be besides those told.
fn rest(unexplained: usize) -> String {
    match unexplained {
        0 => "modulo a prime of 61 bits no other equation gives more".to_string(),
        n => format!(
            "further equations of degree {n} together, without short coefficients or too long to write, may give more"
        ),
    }
}
