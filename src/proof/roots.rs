//! Dependent roots and moduli are replaced by what they are.
//!
//! A root that is no square in the field of those before it is independent (see `standing`). Otherwise
//! A = b² for some b there, and √A = ±b with the sign that b has at real states. Such a b is looked for
//! among the values computed before (see `squares`), and the identity is proved.

use crate::graph::{Expr, Fault, Graph, Step, record};
use crate::number::exact::square_root;
use crate::number::rational::Rational;
use crate::scalar::Scalar;

use super::algebraic::{Algebraic, Root};
use super::digest::Digest;
use super::identity::{Certificate, Outcome, Trial};
use super::squares::{Base, Samples};
use super::standing::Standing;

/// Signs of values of a graph at real states, where all states agree on them.
pub type Signs<'s> = &'s dyn Fn(&Graph, &[Expr]) -> Vec<Option<bool>>;

/// A root's new value: ±c b / Π √A_i.
struct Replacement {
    place: usize,
    base: Base,
    /// c, negative where b is.
    factor: Rational,
    /// Is it |b|, because the sign of b is not known?
    modulus: bool,
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
/// any.
///
/// `group` and `outputs` are values of `graph`; the latter are wanted in the new graph.
pub fn eliminate(
    graph: &Graph,
    group: &[Expr],
    outputs: &[Expr],
    lowered: &Lowered<'_>,
    signs: Signs<'_>,
    digest: Digest,
) -> Result<Option<Eliminated>, Fault> {
    let Lowered { algebraic, trial, roots } = *lowered;
    let reached = graph.reached(group.iter().copied());
    let mut replacements = moduli(graph, &reached, roots, signs)?;
    let samples = Samples::of(algebraic, trial, roots, digest);
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
            let proved = square_is(algebraic, root, base, &square, &over, roots, digest)?;
            if let (Some(factor), Some(certificate)) = (square_root(&square), proved) {
                found_certificate = Some(
                    found_certificate.map_or(certificate, |c: Certificate| c.and(certificate)),
                );
                // √(b²) = |b| whatever the sign; where it is known no modulus is left.
                let factor = if sign == Some(false) { -&factor } else { factor };
                let modulus = sign.is_none();
                replacements.push(Replacement { place, base, factor, modulus, over });
            }
        }
    }
    if replacements.is_empty() {
        return Ok(None);
    }
    let reached = graph.reached(outputs.iter().copied());
    let (replaced, values) = record(graph.inputs(), |inputs| {
        let values = graph.replay(&reached, inputs, |place, _, values| {
            let replacement = replacements.iter().find(|r| r.place == place)?;
            let base = replacement.base.from(|at| values[at])?;
            let base = if replacement.modulus { base.modulus() } else { base };
            let mut value = base * Expr::rational(&replacement.factor);
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
        Some(Replacement { place, base, factor, modulus: false, over: Vec::new() })
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
