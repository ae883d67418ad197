//! Steps that solve a level, and the points they make.

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::equation::{Equation, PartialPoint};
use super::frame::Frame;
use crate::graph::Expr;
use crate::mechanics::elimination::{determinant, gram, gram_determinant};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Largest number of minors that are written out.
const MOST_MINORS: usize = 40;

/// A step that solves equations together, for the same number of components of the state.
#[derive(Clone, Debug, PartialEq)]
pub enum SolutionStep {
    /// An equation of degree 2 with constant coefficients.
    Quadric {
        /// Equation to solve.
        equation: Equation,
        /// All components of the equation, the last one being the axis through the rational point.
        components: Vec<usize>,
        /// Coordinate of the rational point on the axis.
        point: Rational,
        /// Whether the equation has a definite quadratic form.
        is_bounded: bool,
    },
    /// Equations of all products of some vectors.
    Frame(Frame),
    /// Equations that are jointly linear in some components.
    Linear {
        /// Equations to solve.
        equations: Vec<Equation>,
        /// Components to solve for.
        components: Vec<usize>,
        /// All components in which the equations are jointly linear.
        all: Vec<usize>,
    },
    /// Linear equations, and one that is quadratic on the line left by them.
    Quadratic {
        /// Linear equations.
        linear: Vec<Equation>,
        /// Quadratic equation.
        quadratic: Equation,
        /// Components to solve for, the last one along the line.
        components: Vec<usize>,
        /// Components on which the divisor does not depend.
        all: Vec<usize>,
        /// Whether the equations are of degree at most 2 jointly in the components `all`.
        is_of_degree_2: bool,
    },
    /// An equation that is solved for a free parameter.
    Parameter {
        /// Equation to solve.
        equation: Equation,
        /// Component of the free parameters to solve for.
        component: usize,
    },
}

/// Values attached to the divisor of a step: no part of the level is missed if one of them vanishes
/// at no real point.
#[derive(Clone, Debug)]
pub struct Pivot {
    /// Indices of the equations.
    pub equations: Vec<usize>,
    /// Divisor of the step.
    pub divisor: Expr,
    /// Gram determinant of the equations' slopes along all unknowns that the divisor does not
    /// depend on.
    pub slope: Expr,
    /// Gram matrix of these slopes.
    pub gram: Vec<Vec<Expr>>,
    /// Minors of these slopes, if there are few: all of them vanish where `slope` does.
    pub minors: Vec<Expr>,
    /// Sum of squares of the divisor and of the terms that remain where it vanishes.
    pub whole: Expr,
    /// Slopes and constant term of a single linear equation. If they have no common factor, the
    /// step alone misses nothing.
    pub entries: Vec<Expr>,
    /// Components of the state that the step makes.
    pub components: Vec<usize>,
}

impl SolutionStep {
    /// Returns the components of the state that the step makes.
    pub fn components(&self) -> Vec<usize> {
        match self {
            SolutionStep::Quadric { components, .. }
            | SolutionStep::Linear { components, .. }
            | SolutionStep::Quadratic { components, .. } => components.clone(),
            SolutionStep::Frame(frame) => frame.vectors.concat(),
            SolutionStep::Parameter { .. } => Vec::new(),
        }
    }

    /// Returns the components whose draws are directions, of which all count.
    pub fn directions(&self) -> Vec<usize> {
        match self {
            SolutionStep::Quadric { components, .. } => components[..components.len() - 1].to_vec(),
            SolutionStep::Frame(frame) => frame.drawn().collect(),
            _ => Vec::new(),
        }
    }

    /// Whether the step makes two points of the same draws.
    pub fn has_sign(&self) -> bool {
        match self {
            SolutionStep::Quadratic { .. } => true,
            SolutionStep::Frame(frame) => frame.has_sign(),
            _ => false,
        }
    }

    /// Returns the equations that the step solves.
    pub fn equations(&self) -> Vec<Equation> {
        match self {
            SolutionStep::Quadric { equation, .. } | SolutionStep::Parameter { equation, .. } => {
                vec![*equation]
            }
            SolutionStep::Linear { equations, .. } => equations.clone(),
            SolutionStep::Frame(frame) => frame.equations.clone(),
            SolutionStep::Quadratic { linear, quadratic, .. } => {
                linear.iter().copied().chain([*quadratic]).collect()
            }
        }
    }

    /// Returns the pivot at a point of the level, from its coordinates.
    pub fn pivot(&self, point: &PartialPoint<'_>) -> Option<Pivot> {
        let mut completed = point.clone();
        let pivot = self.complete(&mut completed, None)?;
        // The slopes of a linear step do not depend on its results; a quadratic step has taken a
        // root.
        Some(match self {
            SolutionStep::Quadratic { linear, quadratic, all, is_of_degree_2, .. } => {
                let equations = self.equations();
                let mut rows: Vec<Vec<Expr>> =
                    equations.iter().map(|equation| point.slopes(*equation, all)).collect();
                let (slope, gram) = (gram_determinant(&rows), gram(&rows));
                if *is_of_degree_2 {
                    let column = along_itself(point, linear, *quadratic, all);
                    rows.iter_mut().zip(column).for_each(|(row, value)| row.push(value));
                }
                Pivot { slope, gram, minors: minors(&rows), ..pivot }
            }
            _ => pivot,
        })
    }

    /// Completes a point and returns the pivot if it may vanish; `sign` chooses a root.
    pub fn complete(&self, point: &mut PartialPoint<'_>, sign: Option<Expr>) -> Option<Pivot> {
        match self {
            SolutionStep::Quadric { equation, components, point: start, is_bounded } => {
                quadric(point, *equation, components, start, *is_bounded);
                None
            }
            SolutionStep::Frame(frame) => {
                frame.make(&mut point.state, sign);
                None
            }
            SolutionStep::Linear { equations, components, all } => {
                Some(linear(point, equations, components, all))
            }
            SolutionStep::Quadratic { linear, quadratic, components, .. } => {
                let (divisor, whole) = quadratic_step(point, linear, *quadratic, components, sign);
                // Slopes at the results say nothing of points that the step misses.
                Some(Pivot {
                    equations: self.equations().iter().map(|equation| equation.index).collect(),
                    divisor,
                    slope: whole,
                    gram: Vec::new(),
                    minors: Vec::new(),
                    whole,
                    entries: Vec::new(),
                    components: components.clone(),
                })
            }
            SolutionStep::Parameter { equation, component } => {
                point.parameters[*component] = Expr::zero();
                let slope = point.parameter_slope(*equation, *component);
                point.parameters[*component] = -(point.value(*equation) / slope);
                None
            }
        }
    }
}

/// Makes x₀ − 2B(x₀,u)/q(u) · u for the direction u in the components, 1 along the axis. On a
/// quadric that is not bounded, where a branch may take steep directions alone, u is 2v in the
/// components and 1 − v² along the axis, so that all directions come from a bounded range.
fn quadric(
    point: &mut PartialPoint<'_>,
    equation: Equation,
    components: &[usize],
    start: &Rational,
    is_bounded: bool,
) {
    let Some((axis, others)) = components.split_last() else { return };
    let mut direction: Vec<(usize, Expr)> =
        others.iter().map(|component| (*component, point.state[*component])).collect();
    let mut along = Expr::one();
    if !is_bounded {
        for (_, drawn) in &mut direction {
            along -= *drawn * *drawn;
            *drawn = *drawn + *drawn;
        }
    }
    direction.push((*axis, along));
    for component in others {
        point.state[*component] = Expr::zero();
    }
    point.state[*axis] = Expr::rational(start);
    let [_, slope, bend] = point.along(equation, &direction);
    let length = -((slope + slope) / bend);
    for (component, along) in direction {
        let base = point.state[component];
        point.state[component] = base + length * along;
    }
}

/// Returns the matrix and the constant terms of equations that are linear in some components.
fn system(
    point: &mut PartialPoint<'_>,
    equations: &[Equation],
    components: &[usize],
) -> (Vec<Vec<Expr>>, Vec<Expr>) {
    for component in components {
        point.state[*component] = Expr::zero();
    }
    let rows = equations.iter().map(|equation| point.slopes(*equation, components)).collect();
    let rest = equations.iter().map(|equation| point.value(*equation)).collect();
    (rows, rest)
}

/// Computes the slopes of equations of degree at most 2 along the vector x of some components, at a
/// point of the level: for F = q(x) + (l,x) + c this is 2q + (l,x) = 2F − 2c − (l,x), and F = 0
/// there.
fn along_itself(
    point: &PartialPoint<'_>,
    linear: &[Equation],
    quadratic: Equation,
    components: &[usize],
) -> Vec<Expr> {
    let mut origin = point.clone();
    for component in components {
        origin.state[*component] = Expr::zero();
    }
    let rest = linear.iter().map(|equation| -origin.value(*equation));
    let slopes = origin.slopes(quadratic, components);
    let slope = slopes
        .iter()
        .zip(components)
        .fold(Expr::zero(), |sum, (slope, component)| sum + *slope * point.state[*component]);
    let constant = origin.value(quadratic);
    rest.chain([-(constant + constant) - slope]).collect()
}

/// Returns the maximal minors of the rows, unless there are too many.
fn minors(rows: &[Vec<Expr>]) -> Vec<Expr> {
    let width = rows.first().map_or(0, Vec::len);
    let of = |columns: &Vec<usize>| {
        let row = |row: &Vec<Expr>| columns.iter().map(|column| row[*column]).collect();
        determinant(&rows.iter().map(row).collect::<Vec<Vec<Expr>>>())
    };
    let columns: Vec<usize> = (0..width).collect();
    let all = choices(&columns, rows.len(), MOST_MINORS + 1);
    if all.len() > MOST_MINORS { Vec::new() } else { all.iter().map(of).collect() }
}

/// Lists all choices of `count` components in lexicographic order; only the last ones if there are
/// more than `most`.
pub fn choices(from: &[usize], count: usize, most: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> = vec![Vec::new()];
    for round in 0..count {
        let mut next = Vec::new();
        for chosen in &all {
            let start = chosen
                .last()
                .map_or(0, |last| from.iter().position(|k| k == last).map_or(0, |place| place + 1));
            let end = (from.len() + round + 1).saturating_sub(count);
            for component in from.get(start..end).unwrap_or_default() {
                next.push([chosen.as_slice(), &[*component]].concat());
            }
        }
        if next.len() > most {
            next.drain(..next.len() - most);
        }
        all = next;
    }
    all
}

/// Solves A x + m = 0 by Cramer's rule.
fn solved(rows: &[Vec<Expr>], rest: &[Expr]) -> Vec<Expr> {
    let whole = determinant(rows);
    let replaced = |column: usize| {
        let row = |(row, m): (&Vec<Expr>, &Expr)| {
            let mut row = row.clone();
            row[column] = *m;
            row
        };
        determinant(&rows.iter().zip(rest).map(row).collect::<Vec<_>>())
    };
    (0..rest.len()).map(|column| -(replaced(column) / whole)).collect()
}

fn linear(
    point: &mut PartialPoint<'_>,
    equations: &[Equation],
    components: &[usize],
    all: &[usize],
) -> Pivot {
    // Components that could be solved for as well count as unknown for the pivot.
    let kept: Vec<Expr> = all.iter().map(|component| point.state[*component]).collect();
    let (mut rows, rest) = system(point, equations, all);
    let (slope, gram, minors) = (gram_determinant(&rows), gram(&rows), minors(&rows));
    rows.iter_mut().zip(&rest).for_each(|(row, m)| row.push(*m));
    let whole = gram_determinant(&rows);
    let entries = if let [row] = &rows[..] { row.clone() } else { Vec::new() };
    for (component, value) in all.iter().zip(kept) {
        point.state[*component] = value;
    }
    let (rows, rest) = system(point, equations, components);
    for (component, value) in components.iter().zip(solved(&rows, &rest)) {
        point.state[*component] = value;
    }
    Pivot {
        equations: equations.iter().map(|equation| equation.index).collect(),
        divisor: determinant(&rows),
        slope,
        gram,
        minors,
        whole,
        entries,
        components: components.to_vec(),
    }
}

fn quadratic_step(
    point: &mut PartialPoint<'_>,
    linear: &[Equation],
    quadratic: Equation,
    components: &[usize],
    sign: Option<Expr>,
) -> (Expr, Expr) {
    let (mut direction, mut determinants) = (Vec::new(), Expr::one());
    let Some((last, others)) = components.split_last() else {
        return (Expr::one(), Expr::one());
    };
    point.state[*last] = Expr::zero();
    if !others.is_empty() {
        let along = |point: &PartialPoint<'_>| -> Vec<Expr> {
            linear.iter().flat_map(|equation| point.slopes(*equation, &[*last])).collect()
        };
        let (rows, rest) = system(point, linear, others);
        let slopes = along(point);
        let (start, slope) = (solved(&rows, &rest), solved(&rows, &slopes));
        determinants = gram_determinant(&rows);
        for ((component, value), slope) in others.iter().zip(start).zip(slope) {
            point.state[*component] = value;
            direction.push((*component, slope));
        }
    }
    direction.push((*last, Expr::one()));
    let [c, b, a] = point.along(quadratic, &direction);
    // On a line along a generator of a cone the equation is linear, as x² + y² = z² is for x + y +
    // z = 1.
    let (length, divisor) = match a.is_zero() {
        true => (-(c / (b + b)), b),
        // Without a sign the positive root is taken.
        false => {
            let root = (b * b - a * c).sqrt() * sign.unwrap_or_else(Expr::one);
            ((root - b) / a, a)
        }
    };
    for (component, slope) in direction {
        let base = point.state[component];
        point.state[component] = base + length * slope;
    }
    (divisor * determinants, (a * a + b * b + c * c) * determinants)
}
