//! Dependent roots and moduli are replaced by what they are.
//!
//! A root that is no square in the field of those before it is independent (see `standing`). Otherwise
//! A = b² for some b there, and √A = |b|, which is ±b where b has one sign (see `extent`). Such a b
//! is looked for among the values computed before (see `squares`), and the identity is proved.

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::Function;
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::algebraic::{Algebraic, Root};
use super::digest::Digest;
use super::extent::{Extent, Setting};
use super::identity::{Certificate, Outcome, Trial};
use super::squares::{Base, Samples};
use super::standing::Standing;

/// A root's new value: c |b| / Π √A_i.
struct Replacement {
    place: usize,
    base: Base,
    /// c
    factor: Rational,
    /// The sign of b wherever the inputs can be, if it is known.
    sign: Option<bool>,
    /// The same where all roots of the group are real.
    sign_where_real: Option<bool>,
    /// The places of the roots √A_i.
    over: Vec<usize>,
    /// Is it |X| that is replaced?
    is_modulus: bool,
}

impl Replacement {
    /// The new value, where the values at places are known; `None` where the old one has to stay.
    fn value(&self, where_real: bool, values: &[Option<Expr>]) -> Option<Expr> {
        if !where_real && !self.over.is_empty() {
            return None;
        }
        let sign = if where_real { self.sign_where_real } else { self.sign };
        let base = self.base.from(|at| values[at])?;
        let size = match sign {
            Some(true) => base,
            Some(false) => -base,
            None if self.is_modulus => return None,
            None => base.modulus(),
        };
        let mut value = size * Expr::rational(&self.factor);
        for root in &self.over {
            value /= values[*root]?;
        }
        Some(value)
    }
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

/// A group as the fields see it.
pub struct Lowered<'l> {
    /// Made from the group's part of the graph.
    pub algebraic: &'l Algebraic,
    /// Its test.
    pub trial: &'l Trial<'l>,
    /// The roots it contains.
    pub roots: &'l [(Root, Standing)],
}

/// The original graph with those of a group's dependent roots and moduli replaced that could be, if
/// any; in the other groups too, as far as that is right for them.
///
/// Where the other roots of the group are real decides signs, and √(xy) = √x √y needs x > 0. A group
/// that lacks one of these roots has a value at other states too, and keeps its own.
pub fn eliminate(
    graph: &Graph,
    group: &[Expr],
    groups: &[&[Expr]],
    lowered: &Lowered<'_>,
    extents: &[Extent],
    digest: Digest,
) -> Result<Option<Eliminated>, Fault> {
    let Lowered { algebraic, trial, roots } = *lowered;
    let reached = graph.reached(group.iter().copied());
    let (real, positive) = radicands(graph, &reached);
    let anywhere = Setting { inputs: extents, positive: &[] };
    let where_real = Setting { inputs: extents, positive: &positive };
    let signs = |base: Base| {
        // An even number of negative factors.
        let sign = |setting: Setting<'_>| {
            base.places().try_fold(true, |sign, place| Some(sign == setting.sign(graph, place)?))
        };
        let sign_anywhere = sign(anywhere);
        (sign_anywhere, sign_anywhere.or_else(|| sign(where_real)))
    };
    let mut replacements = moduli(graph, roots, signs);
    let is_dependent =
        |(root, standing): &(Root, Standing)| *standing == Standing::Dependent && !root.is_modulus;
    let samples = match roots.iter().any(is_dependent) {
        true => Samples::of(algebraic, trial, roots, digest),
        false => None,
    };
    let known = where_real.at_sight(graph, &reached);
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
        let found = samples.as_ref().and_then(|s| s.square(place, root, &earlier, &known));
        let Some((base, square, over)) = found else { continue };
        let proved = square_is(algebraic, root, base, &square, &over, roots, digest)?;
        if let (Some(factor), Some(certificate)) = (square_root(&square), proved) {
            found_certificate =
                Some(found_certificate.map_or(certificate, |c: Certificate| c.and(certificate)));
            let (sign, sign_where_real) = signs(base);
            let is_modulus = false;
            replacements.push(Replacement {
                place,
                base,
                factor,
                sign,
                sign_where_real,
                over,
                is_modulus,
            });
        }
    }
    if replacements.is_empty() {
        return Ok(None);
    }
    let (replaced, outputs) = record(graph.inputs(), |inputs| {
        let replayed = |where_real: bool, group: &[Expr]| {
            let reached = graph.reached(group.iter().copied());
            graph.replay(&reached, inputs, |place, _, values| {
                replacements.iter().find(|r| r.place == place)?.value(where_real, values)
            })
        };
        let is_as_real = |group: &&&[Expr]| {
            let reached = graph.reached(group.iter().copied());
            real.iter().all(|place| reached[*place])
        };
        let (alike, others): (Vec<&&[Expr]>, Vec<&&[Expr]>) = groups.iter().partition(is_as_real);
        let alike: Vec<Expr> = alike.into_iter().flat_map(|group| group.iter().copied()).collect();
        let others: Vec<Expr> =
            others.into_iter().flat_map(|group| group.iter().copied()).collect();
        let (in_alike, in_others) = (replayed(true, &alike), replayed(false, &others));
        groups
            .iter()
            .flat_map(|group| {
                let values = if is_as_real(&group) { &in_alike } else { &in_others };
                group.iter().map(|output| values[graph.place(*output)])
            })
            .collect::<Option<Vec<Expr>>>()
    })?;
    Ok(outputs.map(|outputs| Eliminated {
        graph: replaced,
        outputs,
        certificate: found_certificate,
    }))
}

/// The places of the roots among the reached steps, and of what they are taken of.
fn radicands(graph: &Graph, reached: &[bool]) -> (Vec<usize>, Vec<usize>) {
    graph
        .steps()
        .enumerate()
        .filter_map(|(place, step)| match step {
            Step::Unary(Function::Sqrt, a) if reached[place] => Some((place, a)),
            _ => None,
        })
        .unzip()
}

/// Proves A Π A_i = c² b² for a root of A, the value b and other roots A_i.
fn square_is(
    algebraic: &Algebraic,
    root: &Root,
    base: Base,
    square: &Rational,
    over: &[usize],
    roots: &[(Root, Standing)],
    digest: Digest,
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
    Ok(match Trial::new(&claim, digest).test(&[difference], &contained, &[]) {
        Outcome::Zero(certificate) => Some(certificate),
        _ => None,
    })
}

/// |X| becomes ±X where X has one sign.
fn moduli(
    graph: &Graph,
    roots: &[(Root, Standing)],
    signs: impl Fn(Base) -> (Option<bool>, Option<bool>),
) -> Vec<Replacement> {
    let replacement = |root: &Root| {
        let place = root.place?;
        let base = Base { value: graph.step(place).arguments().next()?, beside: None };
        let (sign, sign_where_real) = signs(base);
        sign_where_real?;
        let (factor, over) = (Rational::from(1), Vec::new());
        let is_modulus = true;
        Some(Replacement { place, base, factor, sign, sign_where_real, over, is_modulus })
    };
    let moduli = roots.iter().filter(|(root, _)| root.is_modulus);
    moduli.filter_map(|(root, _)| replacement(root)).collect()
}
