//! A closed orbit of saddle kind as a chain of nodes with its unstable and stable directions.

use super::super::Obstacle;
use super::super::guess::Nodes;
use super::super::shooting::Shooting;
use super::chain::{Chain, Directions, Link, NodePlane, longest, settle};
use super::chart::SurfaceChart;
use super::vectors::{moved, plus, split, unit};

/// Factor by which the multipliers have to lie off the unit circle.
const APART: f64 = 1.1;
/// Limit on the iterations of Newton's method.
const MOST_ITERATIONS: usize = 12;
/// Steps below which the nodes are as accurate as f64 allows, and above which they are no orbit.
const CONVERGED: f64 = 1e-14;
const FAR: f64 = 0.3;
/// Steps below which gaps are computed in double-double.
const SHARP: f64 = 1e-8;

/// Saddle with the surface at its first node.
pub struct Saddle {
    /// Nodes of one period; the last is the first.
    pub chain: Chain,
    pub planes: Vec<NodePlane>,
    pub links: Vec<Link>,
    pub directions: Directions,
    /// Multipliers: the unstable one, then the stable one.
    pub multipliers: [f64; 2],
    /// Chart at the first node, along the eigenvectors.
    pub home: SurfaceChart,
    /// Charts at the nodes, the first included.
    pub charts: Vec<SurfaceChart>,
}

impl Saddle {
    /// Finds the closed orbit near a start by Newton's method.
    pub fn new(shooting: &Shooting, nodes: Nodes) -> Result<Self, Obstacle> {
        let size = nodes.states.iter().flatten().fold(0.0, |a: f64, b| a.max(b.abs()));
        let times = nodes.shares.iter().map(|share| share * nodes.period).collect();
        let mut chain = Chain { states: nodes.states, times };
        chain.states.push(chain.states[0].clone());
        chain.states.iter_mut().for_each(|state| settle(shooting, state));
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let end = chain.times.len();
            chain.states[end] = chain.states[0].clone();
            let planes = chain.planes(shooting, None).ok_or(Obstacle::Surface)?;
            let links =
                chain.links(shooting, &planes, last < SHARP * size).ok_or(Obstacle::NoStep(0.0))?;
            let steps = closing(&links);
            let longest = longest(&links, &steps);
            if longest.is_nan() || longest > FAR * size {
                return Err(Obstacle::NoOrbit);
            }
            if longest <= CONVERGED * size
                || (longest >= last && longest <= 100.0 * CONVERGED * size)
            {
                return Self::with(chain, planes, links);
            }
            last = longest;
            chain.shift(shooting, &planes, &links, &steps);
        }
        Err(Obstacle::NoOrbit)
    }

    fn with(chain: Chain, planes: Vec<NodePlane>, links: Vec<Link>) -> Result<Self, Obstacle> {
        let (multipliers, [first, last]) = eigen(&links).ok_or(Obstacle::NoSaddle)?;
        let directions = Directions::new(&links, first, last);
        let charts = chain.states.iter().zip(&planes).enumerate().map(|(k, (state, plane))| {
            plane.chart(state, directions.unstable[k], directions.stable[k])
        });
        let mut charts: Vec<SurfaceChart> = charts.collect();
        charts.pop();
        // Directions come back with a sign; the chart keeps that of the first node.
        let home = planes[0].chart(&chain.states[0], first, last);
        charts[0] = home.clone();
        Ok(Self { chain, planes, links, directions, multipliers, home, charts })
    }

    /// Time after which the orbit closes.
    pub fn period(&self) -> f64 {
        self.chain.times.iter().sum()
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.chain.times.len()
    }

    /// Products of the stretches, or of the squeezes, up to each node.
    pub fn growth(factors: &[f64]) -> Vec<f64> {
        let mut all = vec![1.0];
        for factor in factors {
            all.push(all[all.len() - 1] * factor);
        }
        all
    }

    /// Approximate states along a motion that leaves the first node by `distance` along the
    /// unstable direction, for one period, without the last.
    pub fn leaving(&self, distance: f64) -> Vec<Vec<f64>> {
        let growth = Self::growth(&self.directions.stretch);
        let axes = self.directions.unstable.iter();
        let axes: Vec<Vec<f64>> = axes.zip(&self.planes).map(|(e, p)| p.vector(*e)).collect();
        (0..self.len())
            .map(|k| plus(&self.chain.states[k], distance * growth[k], &axes[k]))
            .collect()
    }

    /// The same along the stable direction.
    pub fn arriving(&self, distance: f64) -> Vec<Vec<f64>> {
        let growth = Self::growth(&self.directions.squeeze);
        // The stable direction was followed backwards from the last node: at the first it may have
        // the other sign.
        let first = self.directions.stable[0];
        let last = self.directions.stable[self.len()];
        let sign = (first[0] * last[0] + first[1] * last[1]).signum();
        let axes = self.directions.stable.iter();
        let axes: Vec<Vec<f64>> = axes.zip(&self.planes).map(|(e, p)| p.vector(*e)).collect();
        (0..self.len())
            .map(|k| plus(&self.chain.states[k], sign * distance * growth[k], &axes[k]))
            .collect()
    }
}

/// Corrections of the nodes that close a ring of links.
fn closing(links: &[Link]) -> Vec<[f64; 2]> {
    let run = |start: [f64; 2]| {
        let mut steps = vec![start];
        for link in links {
            let [x, y] = moved(&link.slopes, steps[steps.len() - 1]);
            steps.push([x + link.gap[0], y + link.gap[1]]);
        }
        steps
    };
    let shift = run([0.0, 0.0])[links.len()];
    let image = |x: [f64; 2]| links.iter().fold(x, |x, link| moved(&link.slopes, x));
    let ([a, c], [b, d]) = (image([1.0, 0.0]), image([0.0, 1.0]));
    run(split([1.0 - a, -c], [-b, 1.0 - d], shift))
}

/// Real multipliers of a saddle, with unit eigenvectors.
fn eigen(links: &[Link]) -> Option<([f64; 2], [[f64; 2]; 2])> {
    let image = |x: [f64; 2]| links.iter().fold(x, |x, link| moved(&link.slopes, x));
    let ([a, c], [b, d]) = (image([1.0, 0.0]), image([0.0, 1.0]));
    let (half, determinant) = ((a + d) / 2.0, a * d - b * c);
    let square = half * half - determinant;
    if square.is_nan() || square <= 0.0 {
        return None;
    }
    let large = half + square.sqrt().copysign(half);
    let small = determinant / large;
    let vector = |value: f64| {
        let (first, second) = ([b, value - a], [value - d, c]);
        let longer = |x: [f64; 2]| libm::hypot(x[0], x[1]);
        unit(if longer(first) >= longer(second) { first } else { second }).0
    };
    let is_saddle = large.abs() > APART && small.abs() < 1.0 / APART && small != 0.0;
    is_saddle.then(|| ([large, small], [vector(large), vector(small)]))
}
