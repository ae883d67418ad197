//! Which roots are independent of those before them.

use crate::graph::{Evaluator, Expr, Tape};
use crate::number::prime::{Prime, UNDEFINED};

use super::algebraic::{Algebraic, Root};
use super::chance::Chance;
use super::digest::Digest;
use super::identity::{LANES, MOST_ROOTS, Trial, points};

/// Draws without a rejection after which a root is taken to depend on those before it.
const PATIENCE: usize = 64;

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

/// The standing of each root; moduli are dependent by nature.
pub fn standing(
    trial: &Trial<'_>,
    algebraic: &Algebraic,
    roots: &[Root],
    digest: Digest,
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
    let mut chance = Chance::of(digest, 3);
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
