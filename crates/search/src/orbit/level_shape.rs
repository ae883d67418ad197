//! Levels on which lines or conics through random states lie: affine spaces and spheres.

use super::super::SearchError;
use super::super::ansatz::system::PrimePoint;
use super::super::echelon::{Echelon, nonzero};
use super::super::streams::SearchStream;
use super::super::terms::recorded;
use super::angle::{ConjugatePair, SquareOfRoot};
use super::setting::{OrbitSetting, run};
use liouville::claim::LevelSubset;
use liouville::formula::Formula;
use liouville::graph::Tape;

/// Number of points, on the level or not, at which slopes are compared.
const POINTS: u64 = 3;

/// Largest number of components of a sphere whose angles take part.
const MOST_ON_SPHERE: usize = 4;

/// Form of a level.
#[derive(Clone, Debug)]
pub struct LevelShape {
    /// Components (x, x) of which is given; none if all equations are linear.
    pub sphere: Vec<usize>,
    /// Powers of variables that the equations write in others, each with all variables of these equations.
    leading: Vec<((usize, u32), Vec<usize>)>,
}

impl LevelShape {
    /// Recognises the level of a case by the slopes of its functions at random points; `None` of others.
    pub fn of(setting: &OrbitSetting<'_>) -> Result<Option<Self>, SearchError> {
        let kept = LevelSubset::level(&setting.case.model).kept;
        let (graph, slopes) = recorded(setting.case, |jet| jet.level_gradients(&kept))?;
        let Some(at) = setting.split(0, 0) else { return Ok(None) };
        let Some(point) = setting.point(&at, 0) else { return Ok(None) };
        let tape = Tape::new(&graph, &slopes.concat());
        let mut rng = SearchStream::OrbitPoints.under(setting.effort.options.seed ^ 0x11);
        let mut all = Vec::new();
        for _ in 0..POINTS {
            let state = point.state.iter().map(|_| rng.element(&at.modulus));
            let state: Vec<u64> = state.collect();
            let inputs = [point.parameters.as_slice(), &state].concat();
            let Some(values) = run(&tape, at.modulus, &inputs) else { return Ok(None) };
            all.push((state, values));
        }
        Ok(affine(&at, &all, setting.dimension()).or_else(|| sphere(&at, &all)))
    }

    /// Whether no equation of the level writes a monomial in others, in the variables of a list.
    pub fn is_independent(&self, monomial: &[u32], variables: &[usize]) -> bool {
        self.leading.iter().all(|((variable, power), bound)| {
            monomial[*variable] < *power || !bound.iter().all(|k| variables.contains(k))
        })
    }
}

/// The shape of a level whose slopes are the same everywhere.
fn affine(at: &PrimePoint, all: &[(Vec<u64>, Vec<u64>)], dimension: usize) -> Option<LevelShape> {
    let (_, first) = all.first()?;
    if all.iter().any(|(_, other)| other != first) {
        return None;
    }
    // The last variable of each equation is written in the others.
    let mut echelon = Echelon::new(dimension, at.modulus);
    for row in first.chunks(dimension) {
        echelon.push(row.iter().rev().copied().collect());
    }
    let leading = |row: Vec<u64>| {
        let used = (0..dimension).filter(|k| row[dimension - 1 - k] != 0);
        let bound: Vec<usize> = used.collect();
        Some(((*bound.last()?, 1), bound))
    };
    let leading = echelon.rows().map(leading).collect::<Option<_>>()?;
    Some(LevelShape { sphere: Vec::new(), leading })
}

/// The shape of a level of one equation whose slopes are multiples of some variables.
fn sphere(at: &PrimePoint, all: &[(Vec<u64>, Vec<u64>)]) -> Option<LevelShape> {
    let m = at.modulus;
    let (state, slopes) = all.first()?;
    let block = nonzero(slopes);
    let last = *block.last().filter(|_| block.len() > 1 && slopes.len() == state.len())?;
    let is_zero = state.contains(&0);
    let ratio = (!is_zero).then(|| m.mul(slopes[last], m.inverse(state[last])))?;
    let is_multiple = |(state, slopes): &(Vec<u64>, Vec<u64>)| {
        slopes.iter().enumerate().all(|(k, slope)| match block.contains(&k) {
            true => *slope == m.mul(ratio, state[k]),
            false => *slope == 0,
        })
    };
    let leading = vec![((last, 2), block.clone())];
    all.iter().all(is_multiple).then_some(LevelShape { sphere: block, leading })
}

/// Pairs x ± iy of components of a sphere in these variables: the zeros of both are zeros of other factors there.
pub fn pairs(
    setting: &OrbitSetting<'_>,
    variables: &[usize],
) -> Result<Vec<ConjugatePair>, SearchError> {
    let sphere: &[usize] = setting.shape.as_ref().map_or(&[], |own| own.sphere.as_slice());
    let mut pairs = Vec::new();
    if sphere.len() > MOST_ON_SPHERE || sphere.iter().any(|k| !variables.contains(k)) {
        return Ok(pairs);
    }
    for (place, second) in sphere.iter().enumerate() {
        for first in &sphere[..place] {
            let parts = [&setting.terms[*first], &setting.terms[*second]];
            let square = SquareOfRoot::of(Formula::number(-1));
            pairs.extend(ConjugatePair::rated(setting, parts, square, 1)?);
        }
    }
    Ok(pairs)
}
