//! Equations of a closed orbit by multiple shooting.
//!
//! ```text
//! Π_{i+1}ᵀ (φ(τ_i T, x_i) - x_{i+1}) = 0     n - k rows for each segment
//! F_j(x_i) - c_j = 0                         k rows for each node
//! (v(x̂_0), x_0 - x̂_0) = 0                    the phase
//! ```
//!
//! The F_j are conserved by the motion; Π_i spans the directions along which none changes. Rows and
//! unknowns go node by node, the period last.

use super::enclosure::Enclosure;
use super::functions::Functions;
use super::guess::Nodes;
use super::motion::{Boxed, EnclosedMotion, EnclosedPassage};
use liouville::number::rational::Rational;

/// System with the functions that it conserves, and their values on the orbit.
pub struct Shooting {
    pub motion: EnclosedMotion,
    pub functions: Functions,
    pub values: Vec<Rational>,
}

/// Matrix by columns, each a list of rows and entries.
pub type Columns = Vec<Vec<(usize, Enclosure)>>;

/// Directions across the level at each node, and the velocity at the first.
pub struct Frames {
    pub across: Vec<Vec<Vec<f64>>>,
    pub phase: Vec<f64>,
}

/// Sum of products of f64 with enclosures.
pub fn combined(weights: &[f64], values: &[Enclosure]) -> Enclosure {
    let terms = weights.iter().zip(values);
    terms.fold(Enclosure::ZERO, |sum, (weight, value)| sum + Enclosure::exact(*weight) * *value)
}

/// Encloses the times of the segments, given that of the orbit.
pub fn times(nodes: &Nodes, period: Enclosure) -> Vec<Enclosure> {
    nodes.shares.iter().map(|share| Enclosure::exact(*share) * period).collect()
}

/// Encloses states by boxes around the nodes with these radii; points without.
pub fn boxes(nodes: &Nodes, radii: Option<&[f64]>) -> Vec<Boxed> {
    let mut index = 0;
    let mut boxed = |x: &f64| {
        let rad = radii.map_or(0.0, |radii| radii[index]);
        index += 1;
        Enclosure::about(*x, rad)
    };
    nodes.states.iter().map(|state| state.iter().map(&mut boxed).collect()).collect()
}

impl Shooting {
    /// Computes frames at the nodes. `None` where the field is not known at the first.
    pub fn frames(&self, nodes: &Nodes) -> Option<Frames> {
        let across = nodes.states.iter().map(|state| self.functions.complement(state)).collect();
        let field = self.motion.field(&boxes(nodes, None)[..1]).pop()?;
        let phase: Vec<f64> = field.iter().map(|x| x.mid).collect();
        phase.iter().all(|x| x.is_finite()).then_some(Frames { across, phase })
    }

    /// Encloses the left sides of all equations at the nodes. Fails at the first segment that is not
    /// proved.
    pub fn residual(&self, nodes: &Nodes, frames: &Frames) -> Result<Vec<Enclosure>, usize> {
        let count = nodes.states.len();
        let next = |index: usize| (index + 1) % count;
        let targets: Vec<&[f64]> =
            (0..count).map(|index| nodes.states[next(index)].as_slice()).collect();
        let gaps = self.motion.gaps(&nodes.states, &nodes.shares, nodes.period, &targets);
        let mut rows = Vec::new();
        for (index, gap) in gaps.into_iter().enumerate() {
            let gap = gap.ok_or(index)?;
            let directions = frames.across[next(index)].iter();
            rows.extend(directions.map(|direction| combined(direction, &gap)));
            rows.extend(self.functions.sharp(&nodes.states[index], &self.values));
        }
        // The node itself has the phase.
        rows.push(Enclosure::ZERO);
        Ok(rows)
    }

    /// Encloses the derivative of the equations over boxes of the nodes, given the passages.
    pub fn derivative(
        &self,
        nodes: &Nodes,
        frames: &Frames,
        boxes: &[Boxed],
        passages: &[EnclosedPassage],
    ) -> Columns {
        let (n, count) = (self.motion.dimension, nodes.states.len());
        let across = n - self.functions.len();
        let mut columns: Columns = vec![Vec::new(); n * count + 1];
        let ends: Vec<Boxed> = passages.iter().map(|passage| passage.end.clone()).collect();
        let fields = self.motion.field(&ends);
        for (index, passage) in passages.iter().enumerate() {
            let next = (index + 1) % count;
            for (row, direction) in frames.across[next].iter().enumerate() {
                let row = n * index + row;
                for (component, along) in direction.iter().enumerate() {
                    let column: Boxed =
                        passage.derivative.iter().map(|row| row[component]).collect();
                    let moved = combined(direction, &column);
                    let own = Enclosure::exact(-along);
                    if count == 1 {
                        columns[component].push((row, moved + own));
                    } else {
                        columns[n * index + component].push((row, moved));
                        columns[n * next + component].push((row, own));
                    }
                }
                let share = Enclosure::exact(nodes.shares[index]);
                columns[n * count].push((row, share * combined(direction, &fields[index])));
            }
            let gradients = self.functions.slopes(&boxes[index]);
            for (row, gradient) in gradients.iter().enumerate() {
                for (component, slope) in gradient.iter().enumerate() {
                    columns[n * index + component].push((n * index + across + row, *slope));
                }
            }
        }
        for (component, slope) in frames.phase.iter().enumerate() {
            columns[component].push((n * count, Enclosure::exact(*slope)));
        }
        columns
    }

    /// Encloses the derivative of the equations with respect to each loose parameter, a column each.
    pub fn by_parameters(
        &self,
        frames: &Frames,
        boxes: &[Boxed],
        passages: &[EnclosedPassage],
    ) -> Vec<Boxed> {
        let (n, count) = (self.motion.dimension, boxes.len());
        let mut columns = vec![Boxed::new(); self.motion.loose];
        for (index, passage) in passages.iter().enumerate() {
            let next = (index + 1) % count;
            let gradients = self.functions.gradients(&boxes[index]);
            for (parameter, column) in columns.iter_mut().enumerate() {
                let moved: Boxed =
                    passage.derivative.iter().map(|row| row[n + parameter]).collect();
                let directions = frames.across[next].iter();
                column.extend(directions.map(|direction| combined(direction, &moved)));
                column.extend(gradients.iter().map(|gradient| gradient[n + parameter]));
            }
        }
        // The phase does not depend on them.
        columns.iter_mut().for_each(|column| column.push(Enclosure::ZERO));
        columns
    }
}

/// Order of the unknowns in which the equations of a closed chain lie near the diagonal: nodes 0,
/// m - 1, 1, m - 2, …, and the period.
pub fn folded(n: usize, count: usize) -> Vec<usize> {
    let node = |k: usize| if k.is_multiple_of(2) { k / 2 } else { count - k.div_ceil(2) };
    let nodes = (0..count).flat_map(|k| (0..n).map(move |component| n * node(k) + component));
    nodes.chain([n * count]).collect()
}
