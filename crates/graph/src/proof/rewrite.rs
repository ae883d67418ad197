//! Replacement of roots and moduli by simpler expressions.

use rustc_hash::FxHashMap;

use crate::graph::{Expr, Graph, Step};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, UnaryFunction};
use crate::order::StableOrder;
use crate::scalar::Scalar;

use super::angles::Angle;
use super::arctangent_sums::ArctangentSum;
use super::arctangents::PlainAngle;
use super::fact::SignFact;
use super::nested::DenestedRoot;
use super::powers::{Logarithm, split_exponential};
use super::squares::Square;

/// The root of a product of radicands.
#[derive(Clone, Debug)]
pub enum Root {
    /// √c |b|
    Found(Rational, Square),
    /// A denested root.
    Written(DenestedRoot),
}

/// A replacement of steps of a graph.
#[derive(Clone, Debug)]
pub enum Rewrite {
    /// |X| is X or -X.
    Signed {
        /// Place of |X|.
        place: usize,
        /// Whether |X| is X.
        positive: bool,
        /// Whether this holds only because of the facts, so that it is a fact itself: a radicand
        /// that becomes 0 by it does not say so any more.
        is_implied: bool,
    },
    /// |X| is 0.
    Vanishing {
        /// Place of |X|.
        place: usize,
    },
    /// √A is 0, and other non-integer powers of A are undefined.
    Zero {
        /// Places of A.
        arguments: Vec<usize>,
    },
    /// √A = √(A Π A_i)/Π√A_i.
    Root {
        /// Places of A.
        arguments: Vec<usize>,
        /// The root √(A Π A_i).
        root: Root,
        /// Places of the A_i.
        over: Vec<usize>,
    },
    /// √(u Π T_i) = √u Π √T_i for roots T_i.
    Split {
        /// Places of the product.
        arguments: Vec<usize>,
    },
    /// ln X and X^y, by the logarithm of X.
    Logarithm {
        /// Place of X.
        argument: usize,
        /// Its logarithm.
        logarithm: Logarithm,
    },
    /// X^y = e^(y ln X).
    Power {
        /// Places of the X^y.
        places: Vec<usize>,
    },
    /// e^E = e^R Π X_j^Y_j, where E = R + Σ Y_j ln X_j.
    Exponential {
        /// Place of E.
        argument: usize,
        /// Places of the ln X_j.
        logarithms: Vec<usize>,
    },
    /// sin E and cos E, by arctangents in E.
    Angle {
        /// Place of E.
        argument: usize,
        /// E as a sum.
        angle: Angle,
    },
    /// atan T, by the angle with the tangent T.
    Arctangent {
        /// Place of T.
        argument: usize,
        /// The angle between −π/2 and π/2.
        angle: PlainAngle,
    },
    /// An arctangent, by others.
    ArctangentSum {
        /// Place of the arctangent.
        place: usize,
        /// The sum.
        sum: ArctangentSum,
    },
}

impl Rewrite {
    /// Returns the places that the replacement needs, besides the arguments of the replaced step.
    pub fn needs(&self) -> Vec<usize> {
        match self {
            Rewrite::Root { root, over, .. } => {
                let mut needs = over.clone();
                match root {
                    Root::Found(_, square) => needs.extend(square.places()),
                    Root::Written(written) => needs.extend(written.places()),
                }
                needs
            }
            Rewrite::Logarithm { logarithm, .. } => {
                logarithm.terms.iter().map(|(place, _)| *place).collect()
            }
            _ => Vec::new(),
        }
    }

    /// Returns the place of X with its sign, if the replacement of |X| rests on facts.
    pub fn implied(&self, graph: &Graph) -> Option<(usize, bool)> {
        match self {
            Rewrite::Signed { place, positive, is_implied: true } => {
                graph.step(*place).arguments().next().map(|argument| (argument, *positive))
            }
            _ => None,
        }
    }

    /// Records the value of a step from the values at places, if the step is replaced.
    pub fn value(
        &self,
        graph: &Graph,
        place: usize,
        step: Step<'_>,
        values: &[Option<Expr>],
    ) -> Option<Expr> {
        match (self, step) {
            (Rewrite::Signed { place: own, positive, .. }, Step::Unary(UnaryFunction::Abs, a)) => {
                let value = values[a].filter(|_| *own == place)?;
                Some(if *positive { value } else { -value })
            }
            (Rewrite::Vanishing { place: own }, _) => {
                (*own == place).then(|| Expr::rational(&Rational::from(0)))
            }
            (Rewrite::Zero { arguments }, Step::Unary(UnaryFunction::Sqrt, a)) => {
                arguments.contains(&a).then(|| Expr::rational(&Rational::from(0)))
            }
            (Rewrite::Zero { arguments }, _) => {
                let (a, _) = power(step)?;
                let zero = || Expr::rational(&Rational::from(0));
                arguments.contains(&a).then(|| zero().apply(UnaryFunction::Recip))
            }
            (Rewrite::Root { arguments, root, over }, _) => {
                let (a, exponent) = power(step)?;
                if !arguments.contains(&a) {
                    return None;
                }
                let at = |place: usize| values.get(place).copied().flatten();
                let mut value = match root {
                    Root::Found(scale, square) => {
                        let scale = Expr::rational(scale).apply(UnaryFunction::Sqrt);
                        scale * square.value(at)?.modulus()
                    }
                    Root::Written(written) => written.value(at)?,
                };
                for other in over {
                    value /= at(*other)?.apply(UnaryFunction::Sqrt);
                }
                Some(value.power(&(&exponent * &Rational::from(2))))
            }
            (Rewrite::Split { arguments }, _) => {
                let (a, exponent) = power(step)?;
                if !arguments.contains(&a) {
                    return None;
                }
                split(graph, a, &exponent, values)
            }
            (Rewrite::Logarithm { argument, logarithm }, step) => match step {
                Step::Unary(UnaryFunction::Ln, a) if a == *argument => {
                    logarithm.value(graph, values)
                }
                Step::Binary(BinaryOperation::Pow, a, y) if a == *argument => {
                    logarithm.power(graph, values[y]?, values)
                }
                _ => None,
            },
            (Rewrite::Power { places }, Step::Binary(BinaryOperation::Pow, a, y)) => {
                let logarithm = values[a].filter(|_| places.contains(&place))?;
                let exponent = values[y]? * logarithm.apply(UnaryFunction::Ln);
                Some(exponent.apply(UnaryFunction::Exp))
            }
            (Rewrite::Exponential { argument, logarithms }, step) => match step {
                Step::Unary(UnaryFunction::Exp, a) if a == *argument => {
                    split_exponential(graph, a, logarithms, values)
                }
                _ => None,
            },
            (Rewrite::Angle { argument, angle }, step) => match step {
                Step::Unary(function @ (UnaryFunction::Sin | UnaryFunction::Cos), a)
                    if a == *argument =>
                {
                    angle.value(function == UnaryFunction::Sin, values)
                }
                _ => None,
            },
            (Rewrite::Arctangent { argument, angle }, Step::Unary(UnaryFunction::Atan, a)) => {
                (a == *argument).then(|| angle.value(values)).flatten()
            }
            (Rewrite::ArctangentSum { place: own, sum }, _) => {
                (*own == place).then(|| sum.value(values)).flatten()
            }
            (Rewrite::Signed { .. } | Rewrite::Power { .. } | Rewrite::Arctangent { .. }, _) => {
                None
            }
        }
    }
}

/// Returns argument and exponent of a non-integer power.
pub fn power(step: Step<'_>) -> Option<(usize, Rational)> {
    match step {
        Step::Unary(UnaryFunction::Sqrt, a) => Some((a, Rational::new(1, 2))),
        Step::Power(a, exponent) if exponent.to_integer().is_none() => Some((a, exponent.clone())),
        _ => None,
    }
}

/// Takes the power of a product factor by factor: roots as powers of their arguments, the rest at
/// once.
fn split(
    graph: &Graph,
    place: usize,
    exponent: &Rational,
    values: &[Option<Expr>],
) -> Option<Expr> {
    let one = || Expr::rational(&Rational::from(1));
    let (mut roots, mut rest): (FxHashMap<usize, Rational>, _) = (FxHashMap::default(), one());
    // Multiplicity of each factor, users before their arguments.
    let mut counts: std::collections::BTreeMap<usize, i64> = [(place, 1)].into();
    while let Some((at, count)) = counts.pop_last() {
        let mut add = |place: usize, more: i64| -> Option<()> {
            let own = counts.entry(place).or_insert(0);
            *own = own.checked_add(more)?;
            Some(())
        };
        match graph.step(at) {
            _ if count == 0 => {}
            Step::Binary(BinaryOperation::Mul, a, b) => {
                add(a, count)?;
                add(b, count)?;
            }
            Step::Unary(UnaryFunction::Recip, a) => add(a, -count)?,
            Step::Unary(UnaryFunction::Neg, a) => {
                add(a, count)?;
                rest = if count % 2 == 0 { rest } else { -rest };
            }
            step => match power(step) {
                Some((a, root)) => {
                    let more = &root * &Rational::from(count);
                    let own = roots.entry(a).or_insert_with(|| Rational::from(0));
                    *own = &*own + &more;
                }
                None => rest *= values[at]?.power(&Rational::from(count)),
            },
        }
    }
    let mut roots: Vec<(usize, Rational)> = roots.into_iter().collect();
    roots.order_by_key(|(place, _)| *place);
    let mut product = rest.power(exponent);
    for (place, root) in roots {
        product *= values[place]?.power(&(&root * exponent));
    }
    Some(product)
}

/// Lists the signs without which some steps are undefined: those of the arguments of roots,
/// logarithms and powers.
pub fn conditions(graph: &Graph, reached: &[bool]) -> Vec<(usize, SignFact)> {
    let condition = |step: Step<'_>| match step {
        Step::Unary(UnaryFunction::Sqrt, a) => Some((a, SignFact::NotNegative)),
        Step::Unary(UnaryFunction::Ln, a) | Step::Binary(BinaryOperation::Pow, a, _) => {
            Some((a, SignFact::Positive))
        }
        Step::Power(a, exponent) if exponent.to_integer().is_none() => {
            Some((a, SignFact::Positive))
        }
        _ => None,
    };
    let steps = graph.steps().zip(reached).filter(|(_, reached)| **reached);
    let all = steps.filter_map(|(step, _)| condition(step));
    all.filter(|(place, _)| !matches!(graph.step(*place), Step::Constant(_))).collect()
}
