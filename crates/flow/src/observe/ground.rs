//! Grounds on which a closed orbit of a case is proved: the conditions on the case, the functions
//! that its motion is proved to keep, and the values of its parameters.

use std::borrow::Cow;

use super::scene::FollowedCase;
use crate::motion::kept::{is_energy_proved, is_proved};
use crate::validated::is_alone;
use crate::{Enclosure, FlowError, Loose, Obstacle, ProvedHorseshoe, ProvedOrbit, Request, Start};
use liouville::case::Case;
use liouville::claim::motion::{Beginning, ClosedOrbit, Horseshoe, Neighbourhood};
use liouville::claim::{ClaimEntry, clock};
use liouville::formula::Formula;
use liouville::mechanics::{
    Chart, Draw, LevelFunction, NumberLine, Parameter, ParameterOrigin, SamplerSpec,
};
use liouville::number::rational::Rational;
use liouville::verdict::Options;

/// Closed orbit that a claim is about.
pub struct ClaimedOrbit<'g> {
    beginning: &'g Beginning,
    period: f64,
    integrals: &'g [Formula],
    parameters: &'g [Neighbourhood],
    wants_multipliers: bool,
}

impl<'g> From<&'g ClosedOrbit> for ClaimedOrbit<'g> {
    fn from(claim: &'g ClosedOrbit) -> Self {
        Self {
            beginning: &claim.beginning,
            period: claim.period.value,
            integrals: &claim.integrals,
            parameters: &claim.parameters,
            wants_multipliers: claim.stability.is_some(),
        }
    }
}

impl<'g> From<&'g Horseshoe> for ClaimedOrbit<'g> {
    fn from(claim: &'g Horseshoe) -> Self {
        Self {
            beginning: &claim.beginning,
            period: claim.period.value,
            integrals: &claim.integrals,
            parameters: &[],
            wants_multipliers: false,
        }
    }
}

/// Case with all that a proof of a closed orbit rests on.
pub struct Ground<'g> {
    /// The case; parameters that vary are free in it.
    case: Cow<'g, Case>,
    start: Start,
    period: f64,
    keeps_energy: bool,
    energy: Option<&'g Rational>,
    integrals: Cow<'g, [Formula]>,
    loose: Vec<Loose>,
    wants_multipliers: bool,
}

impl<'g> Ground<'g> {
    /// Grounds of a claim, or the reason why nothing is proved.
    pub fn of(
        asked: ClaimedOrbit<'g>,
        scene: &'g FollowedCase<'_>,
        options: &Options,
    ) -> Result<Result<Self, String>, FlowError> {
        let case: &'g Case = scene.case;
        if case.model.system.has_arbitrary_function() {
            return Err(FlowError::Arbitrary);
        }
        if let Some(reason) = objection(case) {
            return Ok(Err(reason.to_string()));
        }
        let mut start = scene.start(asked.beginning)?;
        let energy = match asked.beginning {
            Beginning::Section(_) => case.section.as_ref().map(|plan| &plan.energy),
            Beginning::State(_) => None,
        };
        let Some((case, loose)) = freed(case, asked.parameters) else {
            return Ok(Err("some parameters have no fixed value to vary about".to_string()));
        };
        start.parameters = centres(&case);
        Ok(kept(&case, asked.integrals, options).map(|keeps_energy| Self {
            case,
            start,
            period: asked.period,
            keeps_energy,
            energy,
            integrals: Cow::Borrowed(asked.integrals),
            loose,
            wants_multipliers: asked.wants_multipliers,
        }))
    }

    /// Grounds of an orbit near a start that keeps these integrals, with its multipliers.
    pub fn near(
        case: &'g Case,
        (start, integrals): (Start, Vec<Formula>),
        period: f64,
        energy: Option<&'g Rational>,
        options: &Options,
    ) -> Result<Self, String> {
        if let Some(reason) = objection(case) {
            return Err(reason.to_string());
        }
        Ok(Self {
            case: Cow::Borrowed(case),
            start,
            period,
            keeps_energy: kept(case, &integrals, options)?,
            energy,
            integrals: Cow::Owned(integrals),
            loose: Vec::new(),
            wants_multipliers: true,
        })
    }

    /// The same for the values of the parameters in the middle of their ranges alone.
    pub fn at_centres(&self) -> Ground<'_> {
        Ground {
            case: Cow::Borrowed(&self.case),
            start: self.start.clone(),
            integrals: Cow::Borrowed(&self.integrals),
            loose: Vec::new(),
            ..*self
        }
    }

    /// Encloses the orbit by a proof, and checks that it lies where its integrals are proved.
    pub fn enclosed(
        &self,
        proof: impl FnOnce(&Request<'_>) -> Result<ProvedOrbit, Obstacle>,
    ) -> Result<ProvedOrbit, String> {
        let found = self.asked_of(proof)?;
        self.checked(found.kept, &found.start)?;
        Ok(found)
    }

    /// The same with the horseshoe at the orbit.
    pub fn chaotic(
        &self,
        proof: impl FnOnce(&Request<'_>) -> Result<ProvedHorseshoe, Obstacle>,
    ) -> Result<ProvedHorseshoe, String> {
        let found = self.asked_of(proof)?;
        self.checked(found.kept, &found.start)?;
        Ok(found)
    }

    /// Whether no other closed orbit than that found begins as near to the start and has a period within
    /// `unit` of that of the claim.
    pub fn is_alone(&self, unit: f64, found: (&[Enclosure], Enclosure)) -> bool {
        self.asked_of(|request| is_alone(request, unit, found)) == Ok(true)
    }

    /// Checks that a box of states lies where the integrals are proved.
    fn checked(&self, kept: usize, start: &[Enclosure]) -> Result<(), String> {
        match outside(&self.case, start) {
            Some(reason) if kept > 0 => Err(reason),
            _ => Ok(()),
        }
    }

    fn asked_of<T>(
        &self,
        proof: impl FnOnce(&Request<'_>) -> Result<T, Obstacle>,
    ) -> Result<T, String> {
        let integrals: Vec<&Formula> = self.integrals.iter().collect();
        let request = Request {
            model: &self.case.model,
            start: &self.start,
            period: self.period,
            keeps_energy: self.keeps_energy,
            energy: self.energy,
            integrals: &integrals,
            loose: &self.loose,
            wants_multipliers: self.wants_multipliers,
        };
        proof(&request).map_err(|obstacle| match obstacle {
            Obstacle::Motion(problem) => format!("{problem}: {}", problem.help()),
            other => other.to_string(),
        })
    }
}

/// Reason why no orbit of a case is proved, whatever the claim.
fn objection(case: &Case) -> Option<&'static str> {
    if case.model.free_components() > 0 {
        return Some("some parameters have ranges, and an orbit is proved for fixed values");
    }
    if clock(&case.model).is_some() {
        return Some(
            "no motion closes, as `t` is a variable of rate 1 and grows: write a phase in place of it, \
             variables c and s with c' = -w*s, s' = w*c and the level c^2 + s^2 = 1",
        );
    }
    let is_one_sided = case.one_sided.is_some();
    is_one_sided.then_some("under a one-sided constraint no orbit is proved")
}

/// Case in which some fixed parameters are free to vary about their values.
fn freed<'c>(case: &'c Case, varied: &[Neighbourhood]) -> Option<(Cow<'c, Case>, Vec<Loose>)> {
    if varied.is_empty() {
        return Some((Cow::Borrowed(case), Vec::new()));
    }
    let mut own = case.clone();
    for one in varied {
        one.free(&mut own.model)?;
    }
    let (mut loose, mut first) = (Vec::new(), 0);
    for parameter in own.model.free_parameters() {
        let ParameterOrigin::Free(SamplerSpec::Around { centres, half, .. }) = &parameter.origin
        else {
            return None;
        };
        let places = places(parameter, centres.len());
        loose.extend(centres.iter().zip(places).map(|(centre, place)| Loose {
            component: first + place,
            centre: centre.clone(),
            half: half.clone(),
            tied: Vec::new(),
        }));
        first += parameter.kind.size();
    }
    Some((Cow::Owned(own), loose))
}

/// Places of the numbers of a recipe among the components of a parameter: all, or the diagonal.
fn places(parameter: &Parameter, count: usize) -> impl Iterator<Item = usize> + use<> {
    let step = if parameter.kind.size() == count { 1 } else { count + 1 };
    (0..count).map(move |index| index * step)
}

/// Components of the free parameters in the middle of their ranges.
fn centres(case: &Case) -> Vec<Rational> {
    let mut all = Vec::new();
    for parameter in case.model.free_parameters() {
        let mut own = vec![Rational::from(0); parameter.kind.size()];
        if let ParameterOrigin::Free(SamplerSpec::Around { centres, .. }) = &parameter.origin {
            for (place, centre) in places(parameter, centres.len()).zip(centres) {
                own[place] = centre.clone();
            }
        }
        all.extend(own);
    }
    all
}

/// Checks that the level functions and the claimed integrals are proved to be conserved. Returns
/// whether the energy is.
fn kept(case: &Case, integrals: &[Formula], options: &Options) -> Result<bool, String> {
    let level = case.model.level.iter().map(|equation| {
        let function = match &equation.function {
            LevelFunction::UnitNormal => ClaimEntry::from("(γ,γ)"),
            LevelFunction::NoSpin => ClaimEntry::from("(ω,γ)"),
            LevelFunction::Formula(formula) => ClaimEntry::from(formula),
        };
        (function, equation.text.as_str())
    });
    let integrals = integrals.iter().map(|formula| (ClaimEntry::from(formula), formula.text()));
    for (function, text) in level.chain(integrals) {
        if !is_proved(case, function, options) {
            return Err(format!("it is not proved that the motion keeps {}", text.trim()));
        }
    }
    Ok(case.model.system.has_energy() && is_energy_proved(case, options))
}

/// Reason why a box of states does not lie where identities are proved: near a state that can be drawn
/// they hold, and an analytic function that is 0 there is 0 along the orbit.
fn outside(case: &Case, state: &[Enclosure]) -> Option<String> {
    let of_chart =
        "the level and the integrals are proved at the drawn states, and the start is none";
    match case.chart {
        Chart::Rolling | Chart::Sphere => return None,
        Chart::Given(_) => return Some(of_chart.to_string()),
        Chart::Free | Chart::Equations => {}
    }
    if case.free_draws.len() != state.len() {
        return Some(of_chart.to_string());
    }
    let place = case.free_draws.iter().zip(state).position(|(draw, x)| !is_within(draw, x))?;
    let (name, draw, start) =
        (case.model.component_name(place), &case.free_draws[place], &state[place]);
    // An end of a range belongs to it, but is no inner point.
    let touches = |end: f64| (end - start.mid).abs() <= start.rad;
    Some(match draw {
        Draw::Within(range) => {
            let (low, high) = (range.low.to_f64().0, range.high.to_f64().0);
            let ends = range.to_string();
            match touches(low) || touches(high) {
                true => format!(
                    "the enclosure of the start passes the end of the range of `{name}` ({ends}), and \
                     the level and the integrals are proved inside it: declare a wider one"
                ),
                false => format!(
                    "the orbit starts outside the range of `{name}` ({ends}), and the level and the \
                     integrals are proved inside it: declare a wider one"
                ),
            }
        }
        _ => format!(
            "the orbit starts outside the values of `{name}`, for which the level and the integrals are \
             proved"
        ),
    })
}

/// Whether an enclosure lies inside the values of a draw.
fn is_within(draw: &Draw, x: &Enclosure) -> bool {
    let (low, high) = (x.mid - x.rad, x.mid + x.rad);
    match draw {
        Draw::Within(range) => range.low.to_f64().0 < low && high < range.high.to_f64().0,
        Draw::Of(NumberLine::All | NumberLine::Directions, _) => true,
        Draw::Of(NumberLine::Positive, _) => low > 0.0,
        Draw::OneOf(_) | Draw::Sign => false,
    }
}
