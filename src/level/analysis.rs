//! Choice of the order in which the equations of a level are solved, and of their unknowns.
//!
//! Equations are taken in blocks: one with as few unknowns as possible, and all others that contain
//! no further unknowns. A block of j equations is solved for j of its unknowns; the rest of them
//! are free. The graph shows which entries of the equations' derivatives are free of which
//! components.

use super::derivatives::{EquationDerivatives, MOST_COMPONENTS, Set, bit, members};
use super::equation::Equation;
use super::frame::Frame;
use super::quadric::Quadric;
use super::solution::Solution;
use super::steps::{SolutionStep, choices};
use crate::graph::Expr;
use crate::mechanics::{Model, ParameterOrigin, components};
use crate::order::StableOrder;

/// Largest number of equations of a level.
const MOST_EQUATIONS: usize = 64;
/// Largest number of equations that are solved together.
const MOST_TOGETHER: usize = 6;
/// Largest number of choices of unknowns examined in one block.
const MOST_CHOICES: usize = 400;

/// A preference among orders of solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Few equations at a time.
    Usual,
    /// The same, without rational charts of quadrics and of orthogonal vectors.
    ByRoots,
    /// Linear equations together with as many as possible that contain further unknowns.
    Jointly,
}

/// Finds steps that solve the kept equations of a model; `None` if there are none.
pub fn solve(model: &Model, kept: &[bool], order: Order) -> Option<Solution> {
    let equations: Vec<usize> = (0..kept.len()).filter(|index| kept[*index]).collect();
    let dimension = model.dimension();
    if equations.is_empty() || equations.len() > MOST_EQUATIONS || dimension > MOST_COMPONENTS {
        return None;
    }
    let derivatives = |is_squared: bool| {
        let all: Option<Vec<EquationDerivatives>> = equations
            .iter()
            .map(|index| {
                let is_squared = is_squared && model.level[*index].root.is_some();
                EquationDerivatives::at(model, Equation { index: *index, is_squared })
            })
            .collect();
        all
    };
    // √A = e is solved as A = e² where it cannot be solved as it stands.
    let plain = derivatives(false).and_then(|derivatives| {
        let search = OrderSearch { model, derivatives, order };
        let frames = match order {
            Order::ByRoots => Vec::new(),
            Order::Usual | Order::Jointly if kept.iter().all(|kept| *kept) => {
                let all = Frame::all(&search.derivatives).into_iter();
                all.map(|frame| frame.oriented(model)).collect()
            }
            Order::Usual | Order::Jointly => Frame::all(&search.derivatives),
        };
        let last = search.determined_last();
        let framed = |last: &[(usize, usize)]| {
            (!frames.is_empty()).then(|| search.steps(frames.clone(), last)).flatten()
        };
        let later = || {
            (!last.is_empty()).then(|| framed(&last).or_else(|| search.steps(Vec::new(), &last)))
        };
        framed(&[]).or_else(|| search.steps(Vec::new(), &[])).or_else(|| later().flatten())
    });
    let steps = plain.or_else(|| {
        let has_roots = equations.iter().any(|index| model.level[*index].root.is_some());
        let derivatives = derivatives(true).filter(|_| has_roots)?;
        OrderSearch { model, derivatives, order }.steps(Vec::new(), &[])
    })?;
    Some(Solution { steps })
}

/// The search for an order of solution.
struct OrderSearch<'m> {
    model: &'m Model,
    derivatives: Vec<EquationDerivatives>,
    order: Order,
}

impl OrderSearch<'_> {
    /// Lists equations with a component that enters no other equation, and this one linearly with a number as factor.
    fn determined_last(&self) -> Vec<(usize, usize)> {
        let alone = |(index, own): (usize, &EquationDerivatives)| {
            let others = self.derivatives.iter().enumerate().filter(|(other, _)| *other != index);
            let elsewhere = others.fold(0, |set, (_, other)| set | other.contained());
            let has_number = |k: &usize| {
                let slope = own.graph.constant_value(own.slopes[*k]);
                slope.is_some_and(|slope| !slope.is_zero())
            };
            let component = members(own.contained() & !elsewhere).into_iter().find(has_number)?;
            Some((index, component))
        };
        self.derivatives.iter().enumerate().filter_map(alone).collect()
    }

    /// Solves the equations, with those of some frames first, and some at last for a component of each.
    fn steps(&self, frames: Vec<Frame>, last: &[(usize, usize)]) -> Option<Vec<SolutionStep>> {
        let is_left = |index: &usize| {
            let equation = &self.derivatives[*index].equation;
            !frames.iter().any(|frame| frame.equations.contains(equation))
                && !last.iter().any(|(own, _)| own == index)
        };
        let mut left: Vec<usize> = (0..self.derivatives.len()).filter(is_left).collect();
        // Components that are solved for, or free because an equation was solved for another
        // component.
        let (mut settled, mut solved): (Set, Set) = (0, 0);
        let mut steps: Vec<SolutionStep> = frames.into_iter().map(SolutionStep::Frame).collect();
        for component in steps.iter().flat_map(SolutionStep::components) {
            (settled, solved) = (settled | bit(component), solved | bit(component));
        }
        while !left.is_empty() {
            let unknown = |index: &usize| self.derivatives[*index].contained() & !settled;
            let mut blocks: Vec<Set> = left.iter().map(unknown).collect();
            blocks.order_by_key(|set| (set.count_ones(), *set));
            blocks.dedup();
            let solved_by = |block: Set| {
                let members: Vec<usize> =
                    left.iter().copied().filter(|index| unknown(index) & !block == 0).collect();
                let step = self.step(&members, block, settled, solved)?;
                Some((block, members, step))
            };
            let mut found = blocks.iter().find_map(|block| solved_by(*block));
            if let (Order::Jointly, Some((block, _, SolutionStep::Linear { .. }))) =
                (self.order, &found)
            {
                let is_wider = |own: &&Set| *own & block == *block && *own != block;
                let mut wider =
                    blocks.iter().rev().filter(is_wider).filter_map(|own| solved_by(*own));
                let is_plain = |step: &SolutionStep| {
                    matches!(step, SolutionStep::Linear { .. } | SolutionStep::Quadratic { .. })
                };
                found = wider.find(|(_, _, step)| is_plain(step)).or(found);
            }
            let (block, members, step) = match found {
                Some(found) => found,
                None => {
                    let (index, component) = self.parameter(&left)?;
                    let equation = self.derivatives[index].equation;
                    let block = unknown(&index);
                    (block, vec![index], SolutionStep::Parameter { equation, component })
                }
            };
            settled |= block;
            solved |= step.components().into_iter().fold(0, |set, k| set | bit(k));
            left.retain(|index| !members.contains(index));
            steps.push(step);
        }
        steps.extend(last.iter().map(|(index, component)| {
            let own = &self.derivatives[*index];
            let all = self.linear_together(&[*index], bit(*component), own.contained());
            let (equations, components) = (vec![own.equation], vec![*component]);
            SolutionStep::Linear { equations, components, all }
        }));
        // A parameter that is solved for depends on the whole state: it comes last.
        let is_parameter = |step: &SolutionStep| matches!(step, SolutionStep::Parameter { .. });
        let (parameters, mut others): (Vec<SolutionStep>, Vec<SolutionStep>) =
            steps.into_iter().partition(is_parameter);
        others.extend(parameters);
        Some(others)
    }

    /// Finds a step that solves a block of equations for the same number of its unknowns.
    fn step(
        &self,
        block: &[usize],
        unknown: Set,
        settled: Set,
        solved: Set,
    ) -> Option<SolutionStep> {
        let count = block.len();
        if count > MOST_TOGETHER || count > unknown.count_ones() as usize {
            return None;
        }
        let choices = choices(&members(unknown), count, MOST_CHOICES);
        let mut best: Option<(u32, SolutionStep)> = None;
        let mut offer = |cost: u32, step: SolutionStep| {
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, step));
            }
        };
        // The last components are preferred: γ₃ is solved for by the others.
        for chosen in choices.into_iter().rev() {
            let set = chosen.iter().fold(0, |set, k| set | bit(*k));
            if let Some(cost) = self.linear_cost(block, &chosen, set, solved) {
                let all = self.linear_together(block, set, unknown);
                let equations =
                    block.iter().map(|index| self.derivatives[*index].equation).collect();
                offer(cost, SolutionStep::Linear { equations, components: chosen, all });
            } else if let Some(step) = self.quadratic(block, chosen, set, unknown) {
                offer(20, step);
            }
        }
        // A rational parametrisation beats a root.
        let has_chart = self.order != Order::ByRoots;
        if let ([index], true, true) =
            (block, best.as_ref().is_none_or(|(cost, _)| *cost >= 20), has_chart)
        {
            best = self.quadric(*index, unknown, settled).map(|step| (0, step)).or(best);
        }
        best.map(|(_, step)| step)
    }

    /// Rates solving a block that is jointly linear in the chosen unknowns; `None` if it cannot be
    /// solved for them. Constant divisors cost least.
    fn linear_cost(&self, block: &[usize], chosen: &[usize], set: Set, solved: Set) -> Option<u32> {
        if !block.iter().all(|index| self.derivatives[*index].is_linear_in(set))
            || !self.is_regular(block, chosen)
        {
            return None;
        }
        let slopes = || {
            block.iter().flat_map(|index| {
                let derivatives = &self.derivatives[*index];
                chosen.iter().map(move |k| (derivatives, derivatives.slopes[*k]))
            })
        };
        let is_number = |(derivatives, slope): (&EquationDerivatives, Expr)| {
            derivatives.graph.constant_value(slope).is_some()
        };
        if slopes().all(is_number) {
            return Some(1);
        }
        let over_solved = slopes().any(|(derivatives, slope)| derivatives.set(slope) & solved != 0);
        Some(if over_solved { 3 } else { 2 })
    }

    /// Whether the square matrix of slopes of the equations is regular in general.
    fn is_regular(&self, block: &[usize], chosen: &[usize]) -> bool {
        let slope = |index: usize, k: usize| {
            let derivatives = &self.derivatives[index];
            !derivatives.is_zero(derivatives.slopes[k])
        };
        // A pairing in which no slope is identically 0; points at which the matrix is regular are
        // drawn.
        fn pairs(rows: &[usize], columns: &[usize], slope: &impl Fn(usize, usize) -> bool) -> bool {
            let Some((row, rows)) = rows.split_first() else { return true };
            columns.iter().any(|column| {
                let others: Vec<usize> = columns.iter().copied().filter(|k| k != column).collect();
                slope(*row, *column) && pairs(rows, &others, slope)
            })
        }
        pairs(block, chosen, &slope)
    }

    /// Returns all unknowns in which a block is jointly linear, including the chosen ones.
    fn linear_together(&self, block: &[usize], chosen: Set, unknown: Set) -> Vec<usize> {
        let mut set = chosen;
        for component in members(unknown & !chosen) {
            let more = set | bit(component);
            if block.iter().all(|index| self.derivatives[*index].is_linear_in(more)) {
                set = more;
            }
        }
        members(set)
    }

    /// Finds a step with one equation that is quadratic on the line left by the others.
    fn quadratic(
        &self,
        block: &[usize],
        chosen: Vec<usize>,
        set: Set,
        unknown: Set,
    ) -> Option<SolutionStep> {
        let is_linear = |index: &usize| self.derivatives[*index].is_linear_in(set);
        let (linear, others): (Vec<usize>, Vec<usize>) = block.iter().partition(|k| is_linear(k));
        let [last] = others[..] else { return None };
        if !self.derivatives[last].is_quadratic_in(set) {
            return None;
        }
        // The line may run along any of the components.
        let (mut components, line) = chosen.iter().rev().find_map(|line| {
            let rest: Vec<usize> = chosen.iter().copied().filter(|k| k != line).collect();
            self.is_regular(&linear, &rest).then_some((rest, *line))
        })?;
        components.push(line);
        // The divisor may be free of all unknowns of the block.
        let slopes = linear.iter().flat_map(|index| {
            let derivatives = &self.derivatives[*index];
            chosen.iter().map(|k| derivatives.set(derivatives.slopes[*k]))
        });
        let inside = |(i, j, _): &&(usize, usize, Expr)| set & bit(*i) != 0 && set & bit(*j) != 0;
        let derivatives = &self.derivatives[last];
        let bends =
            derivatives.bends.iter().filter(inside).map(|(_, _, bend)| derivatives.set(*bend));
        let pivots = slopes.chain(bends).fold(0, |all, own| all | own);
        let all = members(if pivots & unknown == 0 { unknown } else { set });
        let together = all.iter().fold(0, |set, k| set | bit(*k));
        let is_of_degree_2 = derivatives.is_quadratic_in(together)
            && linear.iter().all(|index| self.derivatives[*index].is_linear_in(together));
        let linear = linear.iter().map(|index| self.derivatives[*index].equation).collect();
        let quadratic = derivatives.equation;
        Some(SolutionStep::Quadratic { linear, quadratic, components, all, is_of_degree_2 })
    }

    /// Finds a step for a quadric that has a rational point on an axis and unknown components only.
    fn quadric(&self, index: usize, unknown: Set, settled: Set) -> Option<SolutionStep> {
        let derivatives = &self.derivatives[index];
        let contained = derivatives.contained();
        if contained != unknown || contained & settled != 0 {
            return None;
        }
        let mut components = members(contained);
        let quadric = derivatives.quadric(&components).filter(Quadric::is_irreducible)?;
        let found = (0..components.len()).rev().find_map(|k| Some((k, quadric.on_axis(k)?)));
        let (axis, point) = found?;
        let last = components.remove(axis);
        components.push(last);
        let is_bounded = quadric.is_bounded();
        Some(SolutionStep::Quadric {
            equation: derivatives.equation,
            components,
            point,
            is_bounded,
        })
    }

    /// Finds a remaining equation with a scalar parameter that enters it linearly, with a constant
    /// factor, and occurs in no other equation.
    fn parameter(&self, left: &[usize]) -> Option<(usize, usize)> {
        let is_scalar = scalar_components(self.model);
        left.iter().find_map(|index| {
            let derivatives = &self.derivatives[*index];
            let usable = |(k, slope): &&(usize, Expr)| {
                let elsewhere = |other: &EquationDerivatives| {
                    other.equation != derivatives.equation && other.parameters.contains(k)
                };
                is_scalar.contains(k)
                    && derivatives
                        .graph
                        .constant_value(*slope)
                        .is_some_and(|slope| !slope.is_zero())
                    && !self.derivatives.iter().any(elsewhere)
            };
            let (component, _) = derivatives.parameter_slopes.iter().find(usable)?;
            Some((*index, *component))
        })
    }
}

/// Returns the components of the free parameters that are scalars drawn from a range.
fn scalar_components(model: &Model) -> Vec<usize> {
    use crate::mechanics::{Draw, SamplerSpec};
    let mut start = 0;
    let mut found = Vec::new();
    for parameter in model.free_parameters() {
        if let ParameterOrigin::Free(SamplerSpec::Scalar(Draw::Within(_))) = &parameter.origin {
            found.push(start);
        }
        start += components(parameter.kind);
    }
    found
}
