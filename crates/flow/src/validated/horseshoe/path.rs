//! Homoclinic orbits as chains of nodes, from the saddle's surface back to it.

use super::super::guess::Nodes;
use super::super::shooting::Shooting;
use super::chain::{Chain, Directions, Link, NodePlane, longest, settle};
use super::chart::SurfaceChart;
use super::saddle::Saddle;
use super::vectors::{dot, minus, plus};

/// Limit on the iterations of Newton's method.
const MOST_ITERATIONS: usize = 12;
/// Steps below which the nodes are as accurate as f64 allows, and above which they are no chain.
const CONVERGED: f64 = 1e-13;
const FAR: f64 = 0.3;
/// Steps below which gaps are computed in double-double.
const SHARP: f64 = 1e-8;

/// Homoclinic orbit that starts on the saddle's unstable direction and ends on its stable one.
pub struct Path {
    pub chain: Chain,
    pub links: Vec<Link>,
    pub directions: Directions,
    /// Charts at all nodes but the last; the first has the origin of the saddle's surface.
    pub charts: Vec<SurfaceChart>,
}

impl Path {
    /// Moves the nodes of an approximate path by Newton's method. `None` if it diverges.
    pub fn new(shooting: &Shooting, saddle: &Saddle, mut chain: Chain) -> Option<Self> {
        let home = &saddle.home;
        let size = dot(&home.origin, &home.origin).sqrt();
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let end = chain.times.len();
            land(shooting, home, &mut chain.states[0]);
            land(shooting, home, &mut chain.states[end]);
            let planes = chain.planes(shooting, Some(&home.normal))?;
            let links = chain.links(shooting, &planes, last < SHARP * size)?;
            let directions = directions(home, &planes, &links)?;
            let off = |k: usize| home.coordinates(&chain.states[k]);
            let slope =
                |row: usize, k: usize, x: [f64; 2]| dot(&home.rows[row], &planes[k].vector(x));
            let first = -off(0)[1] / slope(1, 0, directions.stable[0]);
            let behind = -off(end)[0] / slope(0, end, directions.unstable[end]);
            let steps = directions.closing(&links, first, behind);
            let longest = longest(&links, &steps);
            if longest.is_nan() || longest > FAR * size {
                return None;
            }
            if longest <= CONVERGED * size
                || (longest >= last && longest <= 10.0 * CONVERGED * size)
            {
                return Some(Self::charted(home, &planes, chain, links, directions));
            }
            chain.shift(shooting, &planes, &links, &steps);
            last = longest;
        }
        None
    }

    fn charted(
        home: &SurfaceChart,
        planes: &[NodePlane],
        chain: Chain,
        links: Vec<Link>,
        directions: Directions,
    ) -> Self {
        let charts = (0..chain.times.len()).map(|k| {
            let origin = if k == 0 { &home.origin } else { &chain.states[k] };
            let mut chart = planes[k].chart(origin, directions.unstable[k], directions.stable[k]);
            if k == 0 {
                chart.normal.clone_from(&home.normal);
            }
            chart
        });
        Self { charts: charts.collect(), chain, links, directions }
    }
}

/// Follows the saddle's directions from the ends of a path.
fn directions(home: &SurfaceChart, planes: &[NodePlane], links: &[Link]) -> Option<Directions> {
    let seen = |plane: &NodePlane, axis: &[f64]| {
        let [x, y] = plane.coordinates(axis);
        let length = libm::hypot(x, y);
        [x / length, y / length]
    };
    let (first, last) = (planes.first()?, planes.last()?);
    Some(Directions::new(links, seen(first, &home.axes[0]), seen(last, &home.axes[1])))
}

/// Moves a state to the plane of a chart, and to the level.
fn land(shooting: &Shooting, chart: &SurfaceChart, state: &mut Vec<f64>) {
    for _ in 0..4 {
        settle(shooting, state);
        let height = dot(&chart.normal, &minus(state, &chart.origin));
        *state = plus(state, -height, &chart.normal);
    }
}

/// Approximate path: some turns along the saddle while its distance grows, an excursion, some turns
/// while the distance shrinks.
pub fn joined(
    saddle: &Saddle,
    before: (f64, usize),
    excursion: &Nodes,
    after: (f64, usize),
) -> Chain {
    let (mut states, mut times) = (Vec::new(), Vec::new());
    let [out, back] = saddle.multipliers;
    let mut distance = before.0;
    for _ in 0..before.1 {
        states.extend(saddle.leaving(distance));
        times.extend_from_slice(&saddle.chain.times);
        distance *= out;
    }
    states.extend(excursion.states.iter().cloned());
    times.extend(excursion.shares.iter().map(|share| share * excursion.period));
    let mut distance = after.0;
    for _ in 0..after.1 {
        states.extend(saddle.arriving(distance));
        times.extend_from_slice(&saddle.chain.times);
        distance *= back;
    }
    states.push(plus(&saddle.home.origin, distance, &saddle.home.axes[1]));
    Chain { states, times }
}
