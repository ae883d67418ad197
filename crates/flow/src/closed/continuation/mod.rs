//! Branches of closed orbits: one of them followed while a parameter, the energy or an integral varies.
//!
//! ```text
//! point, λ ─ direction ─▶ guess ─ Newton, in a plane across ─▶ point, λ ─ functions change sign ─▶ bifurcation
//! ```
//!
//! Steps go along the branch and not along λ (pseudo-arclength, Keller 1977), so that folds are no
//! obstacle.

mod family;
mod linear;
mod locate;
mod node;
mod request;
mod solve;
mod walk;

pub use request::{
    Bifurcation, Branch, BranchEnd, BranchPoint, BranchRequest, BranchSection, declared_range,
};

use family::{Family, KeptFunction, Place, norm};
use linear::Plane;
use node::Node;
use solve::{Solver, Trouble};
use walk::{Half, Walk};

use crate::error::FlowError;
use crate::motion::conserved::Conserved;
use crate::motion::kept::keeps_energy;
use crate::motion::start::{LevelFunctions, two_sided};
use crate::section::coordinate::Coordinate;
use liouville::mechanics::{ParameterOrigin, components};
use liouville::number::double_double::DoubleDouble;
use liouville::number::rational::Rational;

/// Cosine between the branch and λ below which the start is near a fold.
const STEEP: f64 = 1e-3;

/// Follows the branch through a closed orbit, both ways. Calls `progress` after each point.
pub fn branch(
    request: &BranchRequest<'_>,
    progress: &dyn Fn(&BranchPoint),
) -> Result<Branch, FlowError> {
    two_sided(request.case)?;
    let (functions, value) = kept(request)?;
    let [from, to] = &request.range;
    if value < *from || value > *to {
        let [value, from, to] = [&value, from, to].map(|x| x.to_f64().0);
        return Err(FlowError::OutsideRange { value, from, to });
    }
    let family = Family::new(request, &functions)?;
    let size = norm(request.start.state.iter().map(|x| x.hi)).max(f64::MIN_POSITIVE);
    let solver = Solver { family: &family, size };
    let first = first(&solver, request, &value).map_err(|trouble| match trouble {
        Trouble::Flow(error) => error,
        Trouble::Lost => FlowError::NoClosedOrbit(request.time),
        Trouble::Singular => FlowError::Degenerate(request.time),
    })?;
    progress(&first.point);
    // The whole range is 2 long.
    let walk =
        Walk { solver: &solver, longest: 2.0 * request.longest, count: request.count, progress };
    let forward = walk.follow(&first, first.tangent.clone());
    let backward = match forward.end {
        BranchEnd::Closed | BranchEnd::Stopped => {
            Half { nodes: Vec::new(), end: forward.end.clone() }
        }
        _ => walk.follow(&first, first.tangent.reversed()),
    };
    let is_closed = forward.end == BranchEnd::Closed;
    let start = backward.nodes.len();
    let ends = [backward.end, forward.end];
    let again = is_closed.then(|| first.clone());
    let nodes = backward.nodes.into_iter().rev().chain([first]);
    let nodes: Vec<Node> = nodes.chain(forward.nodes).chain(again).collect();
    let keeps_area = family.count() == 2 && nodes.iter().all(Node::keeps_area);
    Ok(Branch {
        points: nodes.into_iter().map(|node| node.point).collect(),
        start,
        ends,
        keeps_area,
    })
}

/// The functions that are kept, and the value of what varies at the start.
fn kept(request: &BranchRequest<'_>) -> Result<(Vec<KeptFunction>, Rational), FlowError> {
    let (model, start) = (&request.case.model, &request.start);
    let is_kept = keeps_energy(request.case, model, start, request.time)?;
    let mut functions: Vec<Conserved> = is_kept.then_some(Conserved::Energy).into_iter().collect();
    functions.extend(request.integrals.iter().cloned());
    let varied = match request.varied {
        Coordinate::Energy if !model.system.has_energy() => return Err(FlowError::NoEnergy),
        Coordinate::Energy if !is_kept => return Err(FlowError::EnergyChanges),
        Coordinate::Energy => Some(Conserved::Energy),
        Coordinate::Integral(index) => {
            Some(Conserved::of_claim(request.case, index).ok_or(FlowError::NoStart)?)
        }
        _ => None,
    };
    if let Some(varied) = &varied
        && functions.iter().all(|own| own.name() != varied.name())
    {
        // An integral that varies along orbits isolated at their energy takes its place.
        functions.retain(|own| !matches!(own, Conserved::Energy));
        functions.push(varied.clone());
    }
    let values = LevelFunctions::with(model, &start.parameters, &|phase| {
        functions.iter().filter_map(|own| own.value(phase)).collect()
    })?;
    let values = values.at(&start.state).0.split_off(model.level.len());
    let is_varied = |own: &Conserved| varied.as_ref().is_some_and(|it| it.name() == own.name());
    let own = functions.iter().zip(&values).find(|(own, _)| is_varied(own));
    let given = request.fixed.iter().find(|fixed| is_varied(&fixed.function));
    let value = match own {
        Some((_, value)) => given.map(|fixed| fixed.value.clone()).or(Rational::from_f64(value.hi)),
        None => own_value(request),
    };
    let kept = functions.into_iter().zip(values).map(|(function, value)| {
        let value = (!is_varied(&function)).then_some(value);
        KeptFunction { function, value }
    });
    Ok((kept.collect(), value.ok_or(FlowError::NoStart)?))
}

/// Value of the component of a parameter that varies, at the start.
fn own_value(request: &BranchRequest<'_>) -> Option<Rational> {
    let (varied, component) = request.varied.parameter()?;
    let parameters = &request.case.model.parameters;
    let mut drawn = request.start.parameters.iter();
    for (index, parameter) in parameters.iter().enumerate() {
        let is_it = index == varied;
        match &parameter.origin {
            ParameterOrigin::Fixed(values) if is_it => return values.get(component).cloned(),
            ParameterOrigin::Free(_) if is_it => return drawn.nth(component).cloned(),
            ParameterOrigin::Free(_) => {
                drawn.by_ref().take(components(parameter.kind)).for_each(drop);
            }
            _ => {}
        }
    }
    None
}

/// The node at the start.
fn first(
    solver: &Solver<'_>,
    request: &BranchRequest<'_>,
    value: &Rational,
) -> Result<Node, Trouble> {
    let family = solver.family;
    let lambda = family.lambda(value);
    let guess = Place {
        state: request.start.state.clone(),
        lambda,
        time: DoubleDouble::from_f64(request.time),
    };
    let plane = Plane::of_lambda(family.dimension(), lambda);
    let solved = solver.point(guess, &plane)?;
    let tangent = solver.first_tangent(&solved.frame, &solved.linear).ok_or(Trouble::Singular)?;
    let across = solver.plane(&solved.place, &tangent, 0.0);
    let is_steep = tangent.lambda() < STEEP;
    solver.node(solved, if is_steep { &across } else { &plane })
}
