//! Functions that are one analytic function on all parts of their domain.
//!
//! Absence is counted at a random state, and holds there and at all states to which the known
//! integrals are continued. F = J(1 + |x - 1|/(x - 1)) is an integral if J is; it is 0 for x < 1, where
//! J is a further one. Written with ln, no branch shows that.
//!
//! The draws of states fill a box B. A value is *even* if it is built from them by sums, products,
//! exp, sin, cos, arctan, and by 1/X, √X, X^a, ln X and |X| of an X that is not 0 on B, or positive:
//! it is analytic around B. Quotients, exp, sin and cos of even values are *single-valued* outside of the
//! complex zeros of denominators, which divide no complex neighbourhood of B.
//!
//! A function of rational values, of roots, and of ln a and a^y of rational a, is 0 on all parts of its
//! domain if it is on one, provided that all roots, and all √a, are proved to have independent branches;
//! exponentials, sines and cosines may occur, too (docs/soundness.md, "Known integrals"). exp(½ ln x²)/x
//! has the values ±1, as √(x²) is no independent root.

use num_dual::DualNum;

use liouville::case::Case;
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::{Expr, Graph, Step, record};
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::proof::{Extent, Prover, is_never_negative, is_single_valued, sign};
use liouville::verdict::Sampler;

use super::ask::is_energy;
use super::terms::recorded;
use super::{Effort, SearchError};

/// Form of a value, as far as it tells where the value is continued.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Form {
    /// Analytic around the box of draws.
    Even,
    /// Single-valued.
    Single,
    /// With roots.
    Root,
    /// With logarithms or powers.
    Logarithm,
    /// Another value on other parts, perhaps.
    Divided,
}

/// Values as functions of draws.
struct Drawn {
    graph: Graph,
    values: Vec<Expr>,
    extents: Vec<Extent>,
}

impl Drawn {
    /// Records a formula on the level; `None` if states are numerical.
    fn of(case: &Case, formula: &Formula, effort: &Effort) -> Result<Option<Self>, SearchError> {
        let (graph, values) = recorded(case, |jet| jet.phase.evaluate(formula).components())?;
        Self::composed(case, &graph, values, effort)
    }

    /// Records what stands under roots and logarithms of a formula as written.
    fn bases(case: &Case, formula: &Formula, effort: &Effort) -> Result<Option<Self>, SearchError> {
        let (graph, values) = recorded(case, |jet| jet.phase.literal_values([formula]))?;
        let reached = graph.reached(values.iter().copied());
        let base = |step: Step<'_>| {
            let is_root = step.is_root();
            step.arguments().next().filter(|_| is_root || is_logarithm(&step))
        };
        let steps = graph.steps().zip(reached).filter(|(_, is_reached)| *is_reached);
        let bases = steps.filter_map(|(step, _)| base(step)).map(|place| graph.at(place)).collect();
        Self::composed(case, &graph, bases, effort)
    }

    fn composed(
        case: &Case,
        graph: &Graph,
        values: Vec<Expr>,
        effort: &Effort,
    ) -> Result<Option<Self>, SearchError> {
        let sampler = Sampler::new(case, &LevelSubset::level(&case.model), effort.options.seed)?;
        if sampler.is_numerical() {
            return Ok(None);
        }
        let fixed = vec![None; sampler.recipes().len()];
        let (graph, values) = sampler.compose(graph, &[values], &fixed)?;
        Ok(Some(Self { graph, values: values.concat(), extents: sampler.extents() }))
    }

    /// Whether the values are known to be nowhere negative.
    fn are_never_negative(&self) -> bool {
        let Self { graph, values, extents } = self;
        let is_known = |a: usize| {
            sign(graph, extents, &[], &[], graph.at(a)).is_some_and(|sign| sign.is_positive)
        };
        let mut places = values.iter().map(|value| graph.place(*value));
        places.all(|a| is_known(a) || is_never_negative(graph, a, &is_known))
    }

    /// The form of all values together.
    fn form(&self) -> Form {
        let forms = forms(&self.graph, &self.values, &self.extents);
        let reached = self.graph.reached(self.values.iter().copied());
        let own = forms.into_iter().zip(reached).filter(|(_, is_reached)| *is_reached);
        own.map(|(form, _)| form).max().unwrap_or(Form::Even)
    }
}

/// Whether a formula is known to be one analytic function on all parts of its domain on the level.
pub fn is_one_function(
    case: &Case,
    formula: &Formula,
    effort: &Effort,
) -> Result<bool, SearchError> {
    let (graph, values) = recorded(case, |jet| jet.phase.evaluate(formula).components())?;
    if is_single_valued(&graph, &values) {
        return Ok(true);
    }
    let Some(drawn) = Drawn::of(case, formula, effort)? else { return Ok(false) };
    match drawn.form() {
        Form::Even | Form::Single => Ok(true),
        Form::Root | Form::Logarithm => {
            let Drawn { graph, values, extents } = drawn;
            has_independent_roots(&graph, &values, extents, effort.options.seed)
        }
        Form::Divided => Ok(false),
    }
}

/// Names the integrals of a theorem, and says where it holds if some may have no value on a part of the
/// states.
pub fn named<'f>(
    case: &Case,
    formulas: impl IntoIterator<Item = &'f Formula>,
    effort: &Effort,
) -> Result<String, SearchError> {
    let (mut names, mut partial) = (Vec::new(), Vec::new());
    for formula in formulas {
        names.push(if is_energy(formula) { "the energy" } else { formula.text() });
        let (graph, values) = recorded(case, |jet| jet.phase.literal_values([formula]))?;
        let is_everywhere = is_single_valued(&graph, &values)
            || Drawn::bases(case, formula, effort)?.is_some_and(|drawn| drawn.are_never_negative());
        if !is_everywhere {
            partial.push(formula.text());
        }
    }
    let names = enumerated(&names);
    Ok(match partial.as_slice() {
        [] => names,
        [only] => format!("{names}, where {only} has a value"),
        several => format!("{names}, where {} have values", enumerated(several)),
    })
}

/// Writes a list: a; a and b; a, b and c.
fn enumerated(names: &[&str]) -> String {
    match names {
        [before @ .., last] if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => names.concat(),
    }
}

/// Whether roots, moduli, and roots of what stands under logarithms, have arguments without functions
/// and are proved to have independent branches.
fn has_independent_roots(
    graph: &Graph,
    values: &[Expr],
    mut extents: Vec<Extent>,
    seed: u64,
) -> Result<bool, SearchError> {
    let reached = graph.reached(values.iter().copied());
    let steps = || graph.steps_at(&reached);
    let mut contains_function = vec![false; graph.len()];
    let (mut functions, mut bases) = (Vec::new(), Vec::new());
    for (place, step) in steps() {
        let is_below = step.arguments().any(|a| contains_function[a]);
        contains_function[place] = is_below || step.is_transcendental();
        let winding = step.arguments().next().filter(|_| is_branched(&step) || is_logarithm(&step));
        // An exponential has no zeros to wind about, and functions may be related.
        let is_winding_arc = matches!(step, Step::Unary(UnaryFunction::Atan, _));
        if is_winding_arc || winding.is_some_and(|base| contains_function[base]) {
            return Ok(false);
        }
        bases.extend(winding.filter(|_| is_logarithm(&step)));
        functions.extend(step.is_transcendental().then_some(place));
    }
    let first = graph.inputs();
    extents.resize(first + functions.len(), Extent::ALL);
    let mut wanted: Vec<usize> = values.iter().map(|value| graph.place(*value)).collect();
    for place in &functions {
        wanted.extend(graph.step(*place).arguments());
    }
    let (replaced, outputs) = record(extents.len(), |inputs| {
        let number = |place: usize| functions.iter().position(|own| *own == place);
        let all = graph.replay(&reached, inputs, |place, _, _| {
            number(place).map(|number| inputs[first + number])
        });
        let roots = bases.iter().map(|place| all[*place].map(|base| base.sqrt()));
        wanted.iter().map(|place| all[*place]).chain(roots).collect::<Option<Vec<Expr>>>()
    })?;
    let Some(outputs) = outputs else { return Ok(false) };
    let prover = Prover { sources: &[], extents: &extents, seed };
    Ok(prover.is_true_to_branches(&replaced, &outputs)?)
}

/// Whether a step has branches.
fn is_branched(step: &Step<'_>) -> bool {
    step.is_root() || step.is_modulus()
}

/// Whether a step winds with its argument.
fn is_logarithm(step: &Step<'_>) -> bool {
    matches!(step, Step::Unary(UnaryFunction::Ln, _) | Step::Binary(BinaryOperation::Pow, ..))
}

/// Forms of the values that are reached, by place; inputs behind the extents have none.
fn forms(graph: &Graph, values: &[Expr], extents: &[Extent]) -> Vec<Form> {
    let reached = graph.reached(values.iter().copied());
    let mut forms: Vec<Form> = Vec::with_capacity(graph.len());
    for (place, step) in graph.steps().enumerate() {
        let form = match reached[place] {
            true => form(graph, step, &forms, extents),
            false => Form::Even,
        };
        forms.push(form);
    }
    forms
}

fn form(graph: &Graph, step: Step<'_>, forms: &[Form], extents: &[Extent]) -> Form {
    use UnaryFunction::{Abs, Atan, Cos, Exp, Ln, Neg, Recip, Sin, Sqrt};
    let worst = step.arguments().map(|a| forms[a]).max().unwrap_or(Form::Even);
    let known = |a: usize| match forms[a] {
        Form::Even => sign(graph, extents, &[], &[], graph.at(a)).filter(|s| !s.may_vanish),
        _ => None,
    };
    let is_positive = |a: usize| known(a).is_some_and(|sign| sign.is_positive);
    let even_if = |is_even: bool, otherwise: Form| match is_even {
        true => worst,
        false => worst.max(otherwise),
    };
    // A value under a root or a logarithm has to be of a simple form itself.
    let of = |a: usize, is_even: bool, most: Form, form: Form| match () {
        () if is_even => worst,
        () if forms[a] <= most => worst.max(form),
        () => Form::Divided,
    };
    match step {
        Step::Input(input) if input >= extents.len() => Form::Divided,
        Step::Constant(_) | Step::Input(_) | Step::Unary(Neg | Exp | Sin | Cos, _) => worst,
        Step::Binary(BinaryOperation::Pow, a, _) | Step::Unary(Ln, a) => {
            of(a, is_positive(a), Form::Single, Form::Logarithm)
        }
        Step::Binary(..) => worst,
        Step::Unary(Atan, _) if worst == Form::Even => Form::Even,
        Step::Unary(Atan, _) => Form::Divided,
        Step::Unary(Abs, a) => of(a, known(a).is_some(), Form::Root, Form::Root),
        Step::Unary(Sqrt, a) => of(a, is_positive(a), Form::Root, Form::Root),
        Step::Unary(Recip, a) => even_if(known(a).is_some(), Form::Single),
        Step::Power(a, exponent) => match exponent.to_integer() {
            Some(exponent) if exponent >= 0 => worst,
            Some(_) => even_if(known(a).is_some(), Form::Single),
            None => of(a, is_positive(a), Form::Root, Form::Root),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_one(formula: &str) -> bool {
        let text =
            "title = 'x'\n[state]\nx = '-2..2'\ny = '1..2'\n[field]\n\"x'\" = 'y'\n\"y'\" = '0'\n";
        let case = Case::parse(text, &[]).expect("a case");
        let formula = Formula::parse(formula, &case.model.vocabulary).expect("a formula");
        is_one_function(&case, &formula, &Effort::default()).expect("recorded")
    }

    #[test]
    fn functions_are_continued_from_part_to_part() {
        for one in [
            "x*y",
            "1/x",
            "exp(1/x)",
            "√(x² + y²)",
            "√x",
            "√(x³ + 3*x)",
            "ln(y)",
            "ln(x² + 1)",
            "atan(x)/x",
            "|y|",
            "exp(x)/sin(x)",
            "y^x",
            "x^(1/3)",
            "x*exp(−2*x) + y*√(1 + 4*x² + 8*x*y + 4*y²)",
            "√(1 + exp(2*x))*exp(√(x² + 3))",
            "ln(x)",
            "ln(x² + y²)*√(x² + y²*x)",
            "x*(2*x² + y²)^(y/2)",
            // Around y = 0 they become those on the other side of x = 0.
            "√(x²*y)",
            "√(y*x²)/x",
            "ln(x²*y)",
        ] {
            assert!(is_one(one), "{one}");
        }
        for divided in [
            "exp(ln(x²)/2)",
            "1 + exp(ln(x²)/2)/x",
            "atan(x) + atan(1/x)",
            "|x|",
            "x + |x|",
            "1 + sign(x)",
            "√(x²)/x",
            "exp(√(x²)/x)",
            "ln(x²)",
            "ln(x) + ln(x*(y − 3/2)²)",
            "√x*ln(x*(y − 3/2)²)",
            "√(y*x²)/√y",
            "√(exp(x)*x²)/(exp(x/2)*x)",
            "√(exp(2*x) − exp(x)² + x²)/x",
            "√(sin(x)² + cos(x)² − 1 + x²)/x",
            "√x*atan(y)",
            "ln(y) − ln(y*x²)",
            "max(x, 1)",
        ] {
            assert!(!is_one(divided), "{divided}");
        }
    }
}
