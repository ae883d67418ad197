//! The steps by which a level is solved, and how each makes a point.

use num_dual::DualNum;
use num_traits::{One, Zero};

use super::equation::{Equation, Point, determinant};
use crate::graph::Expr;
use crate::mechanics::calculus::gram_determinant;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Larger sets of minors are not written out.
const MOST_MINORS: usize = 40;

/// Equations solved together, for as many components of the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// An equation of degree 2 with numbers as coefficients.
    Quadric {
        /// The equation.
        equation: Equation,
        /// All components that it contains, the last one the axis that the point lies on.
        components: Vec<usize>,
        /// Where the axis meets it.
        point: Rational,
    },
    /// Equations that are linear in some components together.
    Linear {
        /// The equations.
        equations: Vec<Equation>,
        /// The components that are solved for.
        components: Vec<usize>,
        /// All components in which the equations are linear together.
        all: Vec<usize>,
    },
    /// The same with one equation more, quadratic on the line that the others leave.
    Quadratic {
        /// The linear equations.
        linear: Vec<Equation>,
        /// The quadratic one.
        quadratic: Equation,
        /// The components that are solved for, the last one along the line.
        components: Vec<usize>,
        /// Components of which what is divided by is free.
        all: Vec<usize>,
        /// Whether the equations are of degree 2 at most in these together.
        is_of_degree_2: bool,
    },
    /// An equation that is solved for a free parameter.
    Parameter {
        /// The equation.
        equation: Equation,
        /// The component of the free parameters.
        component: usize,
    },
}

/// Values one of which is not zero at any real point, lest a part of the level is missed.
#[derive(Clone, Debug)]
pub struct Pivot {
    /// The equations, by their numbers.
    pub equations: Vec<usize>,
    /// The determinant of the products of the equations' slopes by all unknowns of which what is
    /// divided by is free.
    pub slope: Expr,
    /// The minors of these slopes, where they are few: all of them vanish where `slope` does.
    pub minors: Vec<Expr>,
    /// The sum of squares of what is divided by and of what is left where that vanishes.
    pub whole: Expr,
    /// For one linear equation: its slopes and the rest. Where they have no common factor nothing
    /// can be missed by this step alone.
    pub entries: Vec<Expr>,
    /// The components of the state that the step makes.
    pub components: Vec<usize>,
}

impl Step {
    /// The components of the state that it makes.
    pub fn components(&self) -> &[usize] {
        match self {
            Step::Quadric { components, .. }
            | Step::Linear { components, .. }
            | Step::Quadratic { components, .. } => components,
            Step::Parameter { .. } => &[],
        }
    }

    /// The equations that it solves.
    pub fn equations(&self) -> Vec<Equation> {
        match self {
            Step::Quadric { equation, .. } | Step::Parameter { equation, .. } => vec![*equation],
            Step::Linear { equations, .. } => equations.clone(),
            Step::Quadratic { linear, quadratic, .. } => {
                linear.iter().copied().chain([*quadratic]).collect()
            }
        }
    }

    /// What must not vanish at a point of the level, from its coordinates.
    pub fn pivot(&self, point: &Point<'_>) -> Option<Pivot> {
        let mut completed = point.clone();
        let pivot = self.complete(&mut completed, None)?;
        // The slopes of a linear step are free of what it makes; a quadratic one has made a root.
        Some(match self {
            Step::Quadratic { linear, quadratic, all, is_of_degree_2, .. } => {
                let equations = self.equations();
                let mut rows: Vec<Vec<Expr>> =
                    equations.iter().map(|equation| point.slopes(*equation, all)).collect();
                let slope = gram_determinant(&rows);
                if *is_of_degree_2 {
                    let column = along_itself(point, linear, *quadratic, all);
                    rows.iter_mut().zip(column).for_each(|(row, value)| row.push(value));
                }
                Pivot { slope, minors: minors(&rows), ..pivot }
            }
            _ => pivot,
        })
    }

    /// Completes a point; the pivot, where one may vanish. `sign` chooses a root.
    pub fn complete(&self, point: &mut Point<'_>, sign: Option<Expr>) -> Option<Pivot> {
        match self {
            Step::Quadric { equation, components, point: start } => {
                quadric(point, *equation, components, start);
                None
            }
            Step::Linear { equations, components, all } => {
                Some(linear(point, equations, components, all))
            }
            Step::Quadratic { linear, quadratic, components, all, .. } => {
                let equations: Vec<Equation> = linear.iter().copied().chain([*quadratic]).collect();
                let whole = quadratic_step(point, linear, *quadratic, components, sign);
                // Where the equations are independent, points with another pivot are near.
                let rows: Vec<Vec<Expr>> =
                    equations.iter().map(|equation| point.slopes(*equation, all)).collect();
                let slope = gram_determinant(&rows);
                Some(Pivot {
                    equations: equations.iter().map(|equation| equation.index).collect(),
                    slope,
                    minors: Vec::new(),
                    whole,
                    entries: Vec::new(),
                    components: components.clone(),
                })
            }
            Step::Parameter { equation, component } => {
                point.parameters[*component] = Expr::zero();
                let slope = point.parameter_slope(*equation, *component);
                point.parameters[*component] = -(point.value(*equation) / slope);
                None
            }
        }
    }
}

/// x₀ − 2B(x₀,u)/q(u) · u for the direction u that the components hold, 1 along the axis.
fn quadric(point: &mut Point<'_>, equation: Equation, components: &[usize], start: &Rational) {
    let Some((axis, others)) = components.split_last() else { return };
    let mut direction: Vec<(usize, Expr)> =
        others.iter().map(|component| (*component, point.state[*component])).collect();
    direction.push((*axis, Expr::one()));
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

/// The matrix and the rest of equations that are linear in some components.
fn system(
    point: &mut Point<'_>,
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

/// The slopes of equations of degree 2 at most along the vector x of some components, at a point
/// that satisfies them: for F = q(x) + (l,x) + c it is 2q + (l,x) = 2F − 2c − (l,x), and F = 0 there.
fn along_itself(
    point: &Point<'_>,
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

/// The minors of all rows, unless there are many.
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

/// All choices of so many of some components, in lexicographic order; the last ones, where there are
/// more than a bound.
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

/// The solution of A x + m = 0, by Cramer's rule.
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
    point: &mut Point<'_>,
    equations: &[Equation],
    components: &[usize],
    all: &[usize],
) -> Pivot {
    // What may be solved for as well counts as unknown for the pivot.
    let kept: Vec<Expr> = all.iter().map(|component| point.state[*component]).collect();
    let (mut rows, rest) = system(point, equations, all);
    let (slope, minors) = (gram_determinant(&rows), minors(&rows));
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
        slope,
        minors,
        whole,
        entries,
        components: components.to_vec(),
    }
}

fn quadratic_step(
    point: &mut Point<'_>,
    linear: &[Equation],
    quadratic: Equation,
    components: &[usize],
    sign: Option<Expr>,
) -> Expr {
    let (mut direction, mut determinants) = (Vec::new(), Expr::one());
    let Some((last, others)) = components.split_last() else {
        return Expr::one();
    };
    point.state[*last] = Expr::zero();
    if !others.is_empty() {
        let along = |point: &Point<'_>| -> Vec<Expr> {
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
    // A root that is not chosen is the first of both.
    let root = (b * b - a * c).sqrt() * sign.unwrap_or_else(Expr::one);
    let length = (root - b) / a;
    for (component, slope) in direction {
        let base = point.state[component];
        point.state[component] = base + length * slope;
    }
    (a * a + b * b + c * c) * determinants
}
