//! Bifurcation diagrams: crossings of a section over values of a parameter or of the energy.

use liouville::case::Case;
use liouville::mechanics::{ParameterOrigin, components};
use liouville::number::rational::Rational;

use crate::error::FlowError;
use crate::motion::conserved::{Conserved, Fixed};
use crate::motion::start::{drawn, fixed_parameters};
use crate::section::coordinate::{ChartAxis, Coordinate};
use crate::section::launch::{Begin, Launches, Launchpad};
use crate::section::rolling::{SectionOrbit, SectionRequest, section};
use crate::section::surface::{SurfaceOrbit, SurfaceRequest, surface_section};
use crate::taylor::batch::each;

/// Request for a bifurcation diagram.
pub struct DiagramRequest<'r> {
    /// Quantity that varies, with its values.
    pub axis: &'r ChartAxis,
    /// Section and starts of the motions.
    pub section: DiagramSection<'r>,
    /// Seed of the free parameters and of drawn states.
    pub seed: u64,
}

/// Section of a diagram, with the starts at each value.
#[derive(Clone, Copy)]
pub enum DiagramSection<'r> {
    /// Section g = g₀ of a rolling body, at the energy and from the starts of the request where they
    /// do not vary.
    Andoyer(&'r SectionRequest),
    /// Surface.
    Surface {
        /// Surface, values recorded, and crossings that count.
        request: &'r SurfaceRequest<'r>,
        /// Beginnings of the motions.
        begins: &'r [Begin],
        /// Functions whose values all starts share; by default each start has those of its state.
        fixed: &'r [Fixed],
    },
}

/// Crossings of one motion at one value.
#[derive(Clone, Debug, PartialEq)]
pub struct DiagramOrbit {
    /// Values of the axes at each crossing.
    pub crossings: Vec<Vec<f64>>,
    /// Reason why the motion ended early, or did not start.
    pub problem: Option<FlowError>,
}

/// Computes the crossings at each value, in order; at each the motions in the order of their starts.
/// Calls `progress` after each value.
pub fn diagram(
    case: &Case,
    request: &DiagramRequest<'_>,
    threads: usize,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Vec<DiagramOrbit>>, FlowError> {
    let parameters = fixed_parameters(case, request.seed, 0)?;
    let begins = request.begins(case)?;
    let column = |index: usize| {
        let value = request.axis.value(index);
        let fixed = fixed(case, &parameters, request.axis.coordinate, &value);
        let found = fixed.ok_or(FlowError::NoStart).and_then(|case| match request.section {
            DiagramSection::Andoyer(own) => request.through_angle(&case, own, &value),
            DiagramSection::Surface { request: own, fixed, .. } => {
                request.through_surface(&case, own, (&begins, fixed), &value)
            }
        });
        progress(1.0);
        match found {
            // The motions of one value fail alone.
            Err(problem) if problem != FlowError::Stopped => {
                let orbit = DiagramOrbit { crossings: Vec::new(), problem: Some(problem) };
                Ok(vec![orbit; request.count()])
            }
            found => found,
        }
    };
    each(request.axis.count, threads, &column).into_iter().collect()
}

impl DiagramRequest<'_> {
    /// Number of motions at each value.
    pub fn count(&self) -> usize {
        match self.section {
            DiagramSection::Andoyer(request) => request.starts.len(),
            DiagramSection::Surface { begins, .. } => begins.len(),
        }
    }

    /// Beginnings on a surface; drawn states are the same at all values.
    fn begins(&self, case: &Case) -> Result<Vec<Begin>, FlowError> {
        let DiagramSection::Surface { begins, .. } = self.section else { return Ok(Vec::new()) };
        let begin = |begin: &Begin| match begin {
            Begin::Drawn(index) => Ok(Begin::State(drawn(case, self.seed, *index)?.1)),
            other => Ok(other.clone()),
        };
        begins.iter().map(begin).collect()
    }

    fn through_angle(
        &self,
        case: &Case,
        request: &SectionRequest,
        value: &Rational,
    ) -> Result<Vec<DiagramOrbit>, FlowError> {
        let mut request = request.clone();
        match self.axis.coordinate {
            Coordinate::Energy => request.energy = value.clone(),
            Coordinate::L => request.starts.iter_mut().for_each(|at| at[0] = value.to_f64().0),
            Coordinate::Z => request.starts.iter_mut().for_each(|at| at[1] = value.to_f64().0),
            Coordinate::Parameter { .. } | Coordinate::Integral(_) => {}
        }
        let orbits = section(case, &request, 1, &|_| {})?.into_iter();
        let orbit = |orbit: SectionOrbit| DiagramOrbit {
            crossings: orbit.crossings.iter().map(|met| met.at.to_vec()).collect(),
            problem: orbit.problem,
        };
        Ok(orbits.map(orbit).collect())
    }

    fn through_surface(
        &self,
        case: &Case,
        own: &SurfaceRequest<'_>,
        (begins, fixed): (&[Begin], &[Fixed]),
        value: &Rational,
    ) -> Result<Vec<DiagramOrbit>, FlowError> {
        let (surface, axes) = (own.surface.of(case), own.axes.of(case));
        let mut fixed = fixed.to_vec();
        if self.axis.coordinate == Coordinate::Energy {
            fixed.retain(|own| !matches!(own.function, Conserved::Energy));
            fixed.push(Fixed::energy(value.clone()));
        }
        let pad = Launchpad { surface: &surface, axes: &axes, direction: own.direction };
        let launches = Launches { case, fixed: &fixed, pad: Some(pad), seed: self.seed, index: 0 };
        let starts: Vec<_> = begins.iter().map(|begin| launches.start(begin)).collect();
        let request = SurfaceRequest { surface: &surface, axes: &axes, ..*own };
        let orbits = surface_section(case, &request, &starts, 1, &|_| {})?.into_iter();
        let orbit = |orbit: SurfaceOrbit| DiagramOrbit {
            crossings: orbit.crossings.into_iter().map(|met| met.at).collect(),
            problem: orbit.problem,
        };
        Ok(orbits.map(orbit).collect())
    }
}

/// The case with all parameters fixed: free ones as drawn, and the one that varies at a value.
fn fixed(case: &Case, drawn: &[Rational], varied: Coordinate, value: &Rational) -> Option<Case> {
    let mut fixed = case.clone();
    let (mut drawn, zero) = (drawn, Rational::from(0));
    let own = varied.parameter().map(|(index, component)| case.model.tied(index, component));
    // An entry that cannot vary is refused by its name, before.
    let tied = own.and_then(Result::ok).unwrap_or_default();
    for (place, parameter) in fixed.model.parameters.iter_mut().enumerate() {
        if let ParameterOrigin::Free(_) = parameter.origin {
            let (own, others) = drawn.split_at_checked(components(parameter.kind))?;
            parameter.origin = ParameterOrigin::Fixed(own.to_vec());
            drawn = others;
        }
        match (varied.parameter(), &mut parameter.origin) {
            (Some((index, component)), ParameterOrigin::Fixed(values)) if index == place => {
                *values.get_mut(component)? = value.clone();
                for one in &tied {
                    *values.get_mut(one.component)? =
                        if one.is_negative { &zero - value } else { value.clone() };
                }
            }
            _ => {}
        }
    }
    Some(fixed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_entries_have_one_value() {
        let text = "title = 'a'\n[parameters]\nJ = [[2, 1], [1, 3]]\nK = 'skew(2, 1..2)'\n[state]\n\
             x = 'vector(2, -1..1)'\n[field]\n\"x'\" = 'J*K*x'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let [zero, one, seven] = [0, 1, 7].map(Rational::from);
        let drawn = [zero.clone(), one.clone(), &zero - &one, zero];
        for (index, component, text) in [(0, 1, "2 7 7 3"), (1, 2, "0 -7 7 0")] {
            let varied = Coordinate::Parameter { index, component };
            let fixed = fixed(&case, &drawn, varied, &seven).expect("a value");
            let ParameterOrigin::Fixed(values) = &fixed.model.parameters[index].origin else {
                panic!("it is fixed")
            };
            let values: Vec<String> = values.iter().map(ToString::to_string).collect();
            assert_eq!(values.join(" "), text, "J12 = J21, K21 = −K12");
        }
    }
}
