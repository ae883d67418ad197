//! Does a level set that is solved for some variables fall apart? An equation a x + b = 0 whose a and
//! b vanish together, as in (y − 1)x + (y − 1) = 0, has a branch a = 0 that x = −b/a leaves out.
//!
//! Looked for in f64 on random lines through the ranges of the state, and beyond them: each zero of a
//! is approached, and b looked at there. Where a and b have no common factor, such a b is not small.

use num_dual::Dual;
use num_traits::{One, Zero};

use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::{Chart, Draw, Draws, Model, Phase, Step};
use crate::number::float::Float;

/// Lines that are looked along.
const LINES: u64 = 8;
/// Points of a line that are seen at once.
const LANES: usize = 64;
/// Blocks of points on each line.
const BLOCKS: usize = 4;
/// How far a line goes, in units of the distance between two states.
const REACH: f64 = 12.0;
/// Least values of |a| that are approached on each line.
const MOST_APPROACHED: usize = 6;
/// Each approach divides an interval by half the number of lanes: these exhaust the digits of f64.
const APPROACHES: usize = 11;
/// What counts as zero for a, and for b, against their means on the line.
const ZERO: [f64; 2] = [1e-10, 1e-6];

/// The equations whose solution leaves out a branch, with the components they are solved for.
pub fn left_out(model: &Model, free_draws: &[Draw], steps: &[Step]) -> Vec<Step> {
    let leaves_out = |index: &usize| match Parts::of(model, &steps[..*index], steps[*index]) {
        Some(parts) => (0..LINES).any(|line| parts.vanish_together(model, free_draws, line)),
        None => false,
    };
    (0..steps.len()).filter(leaves_out).map(|index| steps[index]).collect()
}

/// a and b of an equation a x + b = 0, as functions of the parameters and the state.
struct Parts {
    tape: Tape,
}

impl Parts {
    /// Nothing where a is a function of the parameters alone.
    fn of(model: &Model, earlier: &[Step], step: Step) -> Option<Self> {
        let parameters = model.free_components();
        let inputs = parameters + model.dimension();
        let (graph, [slope, rest]) = record(inputs, |inputs| {
            let (parameters, state) = inputs.split_at(parameters);
            let lift = |x: &Expr| Dual::from_re(*x);
            let parameters: Vec<Dual<Expr>> = parameters.iter().map(lift).collect();
            let mut state: Vec<Dual<Expr>> = state.iter().map(lift).collect();
            state[step.component] = Dual::new(Expr::zero(), Expr::one());
            let kept = vec![true; model.level.len()];
            let completed =
                Chart::Solved(earlier.to_vec()).point(model, &kept, &parameters, &state);
            let phase = Phase::new(model, &parameters, &completed);
            let value = phase.level_function(&model.level[step.equation].function);
            [value.eps, value.re]
        })
        .ok()?;
        let moves = (parameters..inputs).any(|input| graph.depends_on(slope, input));
        moves.then(|| Self { tape: Tape::new(&graph, &[slope, rest]) })
    }

    /// Is b as good as zero where a is, somewhere on a line?
    fn vanish_together(&self, model: &Model, free_draws: &[Draw], line: u64) -> bool {
        let mut recipes = model.parameter_draws();
        recipes.extend_from_slice(free_draws);
        let draws = Draws::new(&recipes);
        let numbers = |index| -> Vec<f64> {
            draws.state(0, index).iter().map(|number| number.to_f64().0).collect()
        };
        let (from, to) = (numbers(2 * line), numbers(2 * line + 1));
        let (parameters, start) = model.make_parameters(&from);
        let end = &to[to.len() - start.len()..];
        let mut evaluator = Evaluator::new(&self.tape, Float::<LANES>);
        // |a| and |b| at some places of the line
        let mut at = |places: &[f64; LANES]| -> [[f64; LANES]; 2] {
            let fixed = parameters.iter().map(|value| [*value; LANES]);
            let moving = start.iter().zip(end).map(|(x, y)| places.map(|t| x + t * (y - x)));
            evaluator.run(&fixed.chain(moving).collect::<Vec<_>>());
            let mut values = evaluator.outputs().map(|block| block.map(f64::abs));
            [0, 1].map(|_| values.next().unwrap_or([f64::NAN; LANES]))
        };
        let places: Vec<f64> = spread(-REACH, REACH, BLOCKS * LANES).collect();
        let (mut slopes, mut rests) = (Vec::new(), Vec::new());
        for block in places.as_chunks::<LANES>().0 {
            let [slope, rest] = at(block);
            slopes.extend(slope);
            rests.extend(rest);
        }
        let scales = [mean(&slopes), mean(&rests)];
        let mut lowest: Vec<usize> = (1..places.len() - 1)
            .filter(|i| slopes[*i] <= slopes[i - 1] && slopes[*i] <= slopes[i + 1])
            .collect();
        lowest.sort_by(|i, j| slopes[*i].total_cmp(&slopes[*j]));
        lowest.into_iter().take(MOST_APPROACHED).any(|i| {
            let (mut low, mut high) = (places[i - 1], places[i + 1]);
            let mut nearest = [f64::INFINITY; 2];
            for _ in 0..APPROACHES {
                let mut inside = [0.0; LANES];
                inside.iter_mut().zip(spread(low, high, LANES)).for_each(|(x, t)| *x = t);
                let [slope, rest] = at(&inside);
                let best = (0..LANES).min_by(|i, j| slope[*i].total_cmp(&slope[*j])).unwrap_or(0);
                nearest = [slope[best], rest[best]];
                low = inside[best.saturating_sub(1)];
                high = inside[(best + 1).min(LANES - 1)];
            }
            nearest
                .iter()
                .zip(scales)
                .zip(ZERO)
                .all(|((value, scale), zero)| *value <= zero * scale)
        })
    }
}

/// Places from `low` to `high`, at equal distances.
fn spread(low: f64, high: f64, count: usize) -> impl Iterator<Item = f64> {
    let step = (high - low) / (count - 1) as f64;
    (0..count).map(move |k| low + k as f64 * step)
}

/// The mean of those values that are numbers.
fn mean(values: &[f64]) -> f64 {
    let known: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    known.iter().sum::<f64>() / known.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use crate::case::Case;

    #[test]
    fn branches_are_told_from_zeros_of_a_slope() {
        for (equation, apart) in [
            ("(x − 1)*(y − 1) = 0", true),
            ("x*y*z = 0", true),
            ("(x − 1)²*(y + z) = 0", true),
            ("x*sin(y) − sin(y) = 0", true),
            ("x*y + z*x² − y − z*x = 0", true),
            ("(1 + x²)*(y − z) = 0", false),
            ("k*x + y = 0", false),
            ("x*y + z = 1", false),
            ("x*sin(y) − z*cos(y) = 0", false),
            ("x²*y − y + z*x = 0", false),
        ] {
            let text = format!(
                "title = 'x'\n[parameters]\nk = '1..2'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n\
                 [field]\n\"x'\" = '0'\n\"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['{equation}']\n"
            );
            let case = Case::parse(&text, &[]).expect("a case");
            let warned = case.warnings.iter().any(|warning| warning.contains("falls apart"));
            assert_eq!(warned, apart, "{equation}");
        }
    }
}
