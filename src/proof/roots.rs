//! Which roots are independent, and what becomes of those that are not.
//!
//! √A is independent of the roots before it when A is no square in the field that they generate: one
//! point at which they all exist and A is no square modulo p proves that. Otherwise A = b² for some
//! b there, and √A = ±b with the sign that b has at real states. Such a b is looked for among
//! the steps computed before, times roots: A Π A_i = b² with some of the earlier radicands A_i.

use rustc_hash::FxHashMap;

use crate::graph::{Evaluator, Expr, Fault, Graph, Step, Tape, record};
use crate::number::prime::{Modulus, Prime, UNDEFINED};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::algebraic::{Algebraic, Root};
use super::chance::Chance;
use super::identity::{Certificate, LANES, MOST_ROOTS, Outcome, Trial, points};

/// Draws without a rejection after which a root is taken to depend on those before it.
const PATIENCE: usize = 64;
/// Products of at most this many earlier radicands are tried.
const MOST_FACTORS: usize = 4;
/// Points that a square must fit before a proof is tried.
const SAMPLES: usize = LANES;
/// c² for the constants c with which √A = ±c b is looked for.
const SQUARES: [(i64, i64); 7] = [(1, 1), (4, 1), (1, 4), (9, 1), (1, 9), (16, 1), (1, 16)];

/// What is known of a root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Its radicand is no square in the field of the roots before it.
    Independent,
    /// Its radicand was a square at every point.
    Dependent,
    /// It was hardly ever reached.
    Unknown,
}

/// Signs of values of a graph at real states, where all states agree on them.
pub type Signs<'s> = &'s dyn Fn(&Graph, &[Expr]) -> Vec<Option<bool>>;

/// The standing of each root; moduli are dependent by nature.
pub fn standing(
    trial: &Trial<'_>,
    algebraic: &Algebraic,
    roots: &[Root],
    seed: u64,
) -> Vec<Standing> {
    let mut standing = vec![Standing::Unknown; roots.len()];
    let mut accepted = vec![0usize; roots.len()];
    for (root, standing) in roots.iter().zip(&mut standing) {
        if root.is_modulus {
            *standing = Standing::Dependent;
        }
    }
    let radicands: Vec<Expr> = roots.iter().map(|root| root.radicand).collect();
    let tape = Tape::new(&algebraic.graph, &radicands);
    let mut evaluator = Evaluator::new(&tape, Prime::new(*trial.moduli()));
    let mut chance = Chance::new(seed, 3);
    let most = (PATIENCE << roots.len().min(MOST_ROOTS)) / LANES + 1;
    for _ in 0..most {
        evaluator.run(&points(trial.moduli(), &algebraic.sources, &[], &mut chance));
        for (lane, modulus) in trial.moduli().iter().enumerate() {
            for index in (0..roots.len()).filter(|index| !roots[*index].is_modulus) {
                let radicand = evaluator.output(index)[lane];
                if radicand == UNDEFINED || radicand == 0 {
                    break;
                }
                if !modulus.is_square(radicand) {
                    standing[index] = Standing::Independent;
                    break;
                }
                accepted[index] += 1;
            }
        }
        for (standing, accepted) in standing.iter_mut().zip(&accepted) {
            if *standing == Standing::Unknown && *accepted >= PATIENCE {
                *standing = Standing::Dependent;
            }
        }
        if !standing.contains(&Standing::Unknown) {
            break;
        }
    }
    standing
}

/// b, the product or quotient of two values or one alone, by places of the original graph.
#[derive(Clone, Copy)]
struct Base {
    value: usize,
    /// Another place, and whether it divides.
    beside: Option<(usize, bool)>,
}

impl Base {
    fn places(self) -> impl Iterator<Item = usize> {
        [Some(self.value), self.beside.map(|(place, _)| place)].into_iter().flatten()
    }

    fn from(self, at: impl Fn(usize) -> Option<Expr>) -> Option<Expr> {
        let value = at(self.value)?;
        Some(match self.beside {
            None => value,
            Some((place, false)) => value * at(place)?,
            Some((place, true)) => value / at(place)?,
        })
    }
}

/// A root's new value: ±c b / Π √A_i.
struct Replacement {
    place: usize,
    base: Base,
    /// c, negative where b is.
    factor: Rational,
    over: Vec<usize>,
}

/// A graph without some of its roots.
pub struct Eliminated {
    /// The graph.
    pub graph: Graph,
    /// The outputs in it.
    pub outputs: Vec<Expr>,
    /// How sure it is that what replaced the roots are their values, if anything did.
    pub certificate: Option<Certificate>,
}

/// The original graph with those dependent roots and moduli replaced that could be, if any.
///
/// `outputs` are values of `graph`, whose steps `reached` has, and `algebraic` was made from it.
pub fn eliminate(
    graph: &Graph,
    outputs: &[Expr],
    algebraic: &Algebraic,
    trial: &Trial<'_>,
    roots: &[(Root, Standing)],
    signs: Signs<'_>,
    seed: u64,
) -> Result<Option<Eliminated>, Fault> {
    let reached = graph.reached(outputs.iter().copied());
    let mut replacements = moduli(graph, &reached, roots, signs)?;
    let samples = Samples::of(algebraic, trial, roots, seed);
    let mut found_certificate = None;
    for (index, (root, standing)) in roots.iter().enumerate() {
        let (Some(place), Standing::Dependent, false) = (root.place, standing, root.is_modulus)
        else {
            continue;
        };
        let earlier: Vec<&Root> = roots[..index]
            .iter()
            .filter(|(root, standing)| *standing == Standing::Independent && root.place.is_some())
            .map(|(root, _)| root)
            .collect();
        if let Some(found) = samples.as_ref().and_then(|s| s.square(place, root, &earlier)) {
            let (base, square, over) = found;
            let places: Vec<usize> = base.places().collect();
            let signs = real_signs(graph, &reached, &places, signs)?;
            // An even number of negative factors.
            let sign = signs.into_iter().try_fold(true, |sign, next| Some(sign == next?));
            let proved = square_is(algebraic, root, base, &square, &over, roots, seed)?;
            if let (Some(positive), Some(factor), Some(certificate)) =
                (sign, crate::number::exact::square_root(&square), proved)
            {
                found_certificate = Some(
                    found_certificate.map_or(certificate, |c: Certificate| c.and(certificate)),
                );
                let factor = if positive { factor } else { -&factor };
                replacements.push(Replacement { place, base, factor, over });
            }
        }
    }
    if replacements.is_empty() {
        return Ok(None);
    }
    let (replaced, values) = record(graph.inputs(), |inputs| {
        let values = graph.replay(&reached, inputs, |place, _, values| {
            let replacement = replacements.iter().find(|r| r.place == place)?;
            let mut value =
                replacement.base.from(|at| values[at])? * Expr::rational(&replacement.factor);
            for root in &replacement.over {
                value /= values[*root]?;
            }
            Some(value)
        });
        outputs.iter().map(|output| values[graph.place(*output)]).collect::<Option<Vec<Expr>>>()
    })?;
    Ok(values.map(|outputs| Eliminated {
        graph: replaced,
        outputs,
        certificate: found_certificate,
    }))
}

/// Proves A Π A_i = c² b² for a root of A, the value b and other roots A_i.
fn square_is(
    algebraic: &Algebraic,
    root: &Root,
    base: Base,
    square: &Rational,
    over: &[usize],
    roots: &[(Root, Standing)],
    seed: u64,
) -> Result<Option<Certificate>, Fault> {
    let factors =
        || roots.iter().filter(|(r, _)| r.place.is_some_and(|place| over.contains(&place)));
    let mut needed: Vec<Expr> = factors().map(|(other, _)| other.radicand).collect();
    needed.push(root.radicand);
    needed.extend(base.places().filter_map(|place| algebraic.values[place]));
    let (graph, difference) = record(algebraic.sources.len(), |inputs| {
        let reached = algebraic.graph.reached(needed.iter().copied());
        let values = algebraic.graph.replay(&reached, inputs, |_, _, _| None);
        let at = |expr: Expr| values[algebraic.graph.place(expr)];
        let mut product = at(root.radicand)?;
        for (other, _) in factors() {
            product *= at(other.radicand)?;
        }
        let b = base.from(|place| at(algebraic.values[place]?))?;
        let odd = algebraic.odd.iter().filter_map(|(base, index)| Some((at(*base)?, *index)));
        Some((product - b * b * Expr::rational(square), odd.collect::<Vec<_>>()))
    })?;
    let Some((difference, odd)) = difference else { return Ok(None) };
    let claim = Algebraic {
        graph,
        values: Vec::new(),
        sources: algebraic.sources.clone(),
        original_inputs: algebraic.original_inputs,
        roots: algebraic.roots.clone(),
        squares: algebraic.squares.clone(),
        odd,
    };
    let contained: Vec<Root> = claim.roots_of(&[difference]).collect();
    let standing = |root: &Root| roots.iter().find(|(r, _)| r.sign == root.sign).map(|(_, s)| *s);
    if contained.iter().any(|root| standing(root) != Some(Standing::Independent)) {
        return Ok(None);
    }
    Ok(match Trial::new(&claim, seed).test(&[difference], &contained, &[]) {
        Outcome::Zero(certificate) => Some(certificate),
        _ => None,
    })
}

/// |X| becomes ±X where X has one sign at all real states.
fn moduli(
    graph: &Graph,
    reached: &[bool],
    roots: &[(Root, Standing)],
    signs: Signs<'_>,
) -> Result<Vec<Replacement>, Fault> {
    let found: Vec<(usize, usize)> = roots
        .iter()
        .filter(|(root, _)| root.is_modulus)
        .filter_map(|(root, _)| {
            let place = root.place?;
            Some((place, graph.step(place).arguments().next()?))
        })
        .collect();
    let arguments: Vec<usize> = found.iter().map(|(_, argument)| *argument).collect();
    let signs = real_signs(graph, reached, &arguments, signs)?;
    let replacements = found.into_iter().zip(signs).filter_map(|((place, value), sign)| {
        let factor = Rational::from(if sign? { 1 } else { -1 });
        let base = Base { value, beside: None };
        Some(Replacement { place, base, factor, over: Vec::new() })
    });
    Ok(replacements.collect())
}

/// The signs of the values at these places.
fn real_signs(
    graph: &Graph,
    reached: &[bool],
    places: &[usize],
    signs: Signs<'_>,
) -> Result<Vec<Option<bool>>, Fault> {
    if places.is_empty() {
        return Ok(Vec::new());
    }
    let (copy, values) = record(graph.inputs(), |inputs| {
        let values = graph.replay(reached, inputs, |_, _, _| None);
        places.iter().map(|place| values[*place]).collect::<Option<Vec<Expr>>>()
    })?;
    let found = values.map_or(vec![None; places.len()], |values| signs(&copy, &values));
    let constant = |place: &usize| match graph.step(*place) {
        Step::Constant(value) => Some(!value.is_negative()),
        _ => None,
    };
    Ok(places.iter().zip(found).map(|(place, sign)| constant(place).or(sign)).collect())
}

/// All values of the original graph at points where the independent roots exist.
struct Samples {
    moduli: Vec<Modulus>,
    /// By place; `None` where the graph has no value that a field can compute.
    values: Vec<Option<Vec<u64>>>,
    /// For each root: its radicand at these points.
    radicands: Vec<(usize, Vec<u64>)>,
}

impl Samples {
    fn of(
        algebraic: &Algebraic,
        trial: &Trial<'_>,
        roots: &[(Root, Standing)],
        seed: u64,
    ) -> Option<Self> {
        let kept: Vec<usize> =
            (0..algebraic.values.len()).filter(|at| algebraic.values[*at].is_some()).collect();
        let mut outputs: Vec<Expr> =
            kept.iter().filter_map(|place| algebraic.values[*place]).collect();
        let count = outputs.len();
        outputs.extend(roots.iter().map(|(root, _)| root.radicand));
        let tape = Tape::new(&algebraic.graph, &outputs);
        let mut evaluator = Evaluator::new(&tape, Prime::new(*trial.moduli()));
        let mut chance = Chance::new(seed, 4);
        let mut samples = Self {
            moduli: Vec::new(),
            values: algebraic.values.iter().map(|value| value.map(|_| Vec::new())).collect(),
            radicands: roots.iter().map(|(root, _)| (root.sign, Vec::new())).collect(),
        };
        for _ in 0..(PATIENCE << MOST_ROOTS) / LANES {
            evaluator.run(&points(trial.moduli(), &algebraic.sources, &[], &mut chance));
            for (lane, modulus) in trial.moduli().iter().enumerate() {
                let exists = |index: usize| {
                    let radicand = evaluator.output(count + index)[lane];
                    roots[index].0.is_modulus
                        || (radicand != UNDEFINED && modulus.is_square(radicand))
                };
                if !(0..roots.len()).all(exists) {
                    continue;
                }
                samples.moduli.push(*modulus);
                for (index, place) in kept.iter().enumerate() {
                    if let Some(values) = &mut samples.values[*place] {
                        values.push(evaluator.output(index)[lane]);
                    }
                }
                for (index, (_, values)) in samples.radicands.iter_mut().enumerate() {
                    values.push(evaluator.output(count + index)[lane]);
                }
            }
            if samples.moduli.len() >= SAMPLES {
                return Some(samples);
            }
        }
        None
    }

    fn radicand(&self, root: &Root) -> Option<&Vec<u64>> {
        self.radicands.iter().find(|(sign, _)| *sign == root.sign).map(|(_, values)| values)
    }

    /// A base b from earlier places, a square c² and earlier roots with A Π A_i = c² b² at all
    /// points.
    fn square(
        &self,
        place: usize,
        root: &Root,
        earlier: &[&Root],
    ) -> Option<(Base, Rational, Vec<usize>)> {
        let radicand = self.radicand(root)?;
        let squares = Squares::of(self, place);
        for subset in 0u32..1 << earlier.len().min(MOST_FACTORS) {
            let chosen = || earlier.iter().enumerate().filter(move |(k, _)| subset >> k & 1 == 1);
            let mut target = radicand.clone();
            for (_, root) in chosen() {
                for ((entry, factor), m) in
                    target.iter_mut().zip(self.radicand(root)?).zip(&self.moduli)
                {
                    *entry = m.mul(*entry, *factor);
                }
            }
            for (n, d) in SQUARES {
                let square = Rational::new(n, d);
                let scaled: Option<Vec<u64>> = target
                    .iter()
                    .zip(&self.moduli)
                    .map(|(x, m)| Some(m.mul(*x, m.rational(&square.recip()?)?)))
                    .collect();
                if let Some(base) = squares.find(&self.moduli, &scaled?) {
                    let over = chosen().filter_map(|(_, root)| root.place).collect();
                    return Some((base, square, over));
                }
            }
        }
        None
    }
}

/// The squares of all values before a place, by what they are at the first point.
struct Squares {
    squares: Vec<(usize, Vec<u64>)>,
    at_first: FxHashMap<u64, usize>,
}

impl Squares {
    fn of(samples: &Samples, before: usize) -> Self {
        let mut all = Self { squares: Vec::new(), at_first: FxHashMap::default() };
        for (place, values) in samples.values.iter().enumerate().take(before) {
            let Some(values) = values else { continue };
            // 0 has no inverse, and is the square of nothing that is asked for.
            if values.iter().all(|value| *value != UNDEFINED && *value != 0) {
                let square = values.iter().zip(&samples.moduli).map(|(x, m)| m.mul(*x, *x));
                let square: Vec<u64> = square.collect();
                if let Some(first) = square.first() {
                    all.at_first.entry(*first).or_insert(all.squares.len());
                    all.squares.push((place, square));
                }
            }
        }
        all
    }

    /// The place whose square this is.
    fn place(&self, target: &[u64]) -> Option<usize> {
        let (place, square) = &self.squares[*self.at_first.get(target.first()?)?];
        (square == target).then_some(*place)
    }

    fn find(&self, moduli: &[Modulus], target: &[u64]) -> Option<Base> {
        if let Some(value) = self.place(target) {
            return Some(Base { value, beside: None });
        }
        let combined = |square: &[u64], over: bool| -> Vec<u64> {
            let pairs = target.iter().zip(square).zip(moduli);
            pairs.map(|((t, s), m)| m.mul(*t, if over { *s } else { m.inverse(*s) })).collect()
        };
        self.squares.iter().find_map(|(place, square)| {
            [false, true].into_iter().find_map(|over| {
                // The first point decides almost always.
                let first = combined(&square[..1], over);
                self.at_first.get(first.first()?)?;
                let value = self.place(&combined(square, over))?;
                Some(Base { value, beside: Some((*place, over)) })
            })
        })
    }
}
