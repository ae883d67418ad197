//! Chains of points along a motion, in f64: nodes, the maps between surfaces across the motion at
//! the nodes, their unstable and stable directions.

use super::super::enclosure::Enclosure;
use super::super::functions::{across, normalised};
use super::super::motion::Boxed;
use super::super::shooting::Shooting;
use super::chart::SurfaceChart;
use super::vectors::{dot, minus, moved, plus, split, unit};

/// Nodes of a motion, the last of them where it ends, and the times between them.
#[derive(Clone, Debug)]
pub struct Chain {
    pub states: Vec<Vec<f64>>,
    pub times: Vec<f64>,
}

/// Map from the surface at a node to that at the next, to first order, in orthonormal bases.
pub struct Link {
    pub slopes: [[f64; 2]; 2],
    /// Image of the node.
    pub gap: [f64; 2],
    /// Change of the time to the next surface with the coordinates, and at the node.
    pub late: [f64; 2],
    late_here: f64,
    /// Height of the end of the motion from the node over the next surface.
    height: f64,
}

/// Largest distance by which a chain is off: of corrections within the surfaces, and of ends from the
/// next surface, which corrections of the times remove.
pub fn longest(links: &[Link], steps: &[[f64; 2]]) -> f64 {
    let heights = links.iter().map(|link| &link.height);
    let parts = steps.iter().flatten().chain(heights);
    // A maximum would leave out a part without a value.
    parts.fold(0.0, |a: f64, x| if x.abs() <= a { a } else { x.abs() })
}

/// Surface at a node with an orthonormal basis of its tangents.
pub struct NodePlane {
    pub normal: Vec<f64>,
    pub basis: [Vec<f64>; 2],
}

impl NodePlane {
    /// Surface across the motion at a state. `None` unless the level of all conserved functions has
    /// dimension 3.
    pub fn new(shooting: &Shooting, state: &[f64], field: &[f64]) -> Option<Self> {
        let normal = normalised(field);
        let tangents = shooting.functions.complement(state);
        if tangents.len() != 3 {
            return None;
        }
        let mut units = vec![normal.clone()];
        while units.len() < 3 {
            let rests = tangents.iter().map(|tangent| across(tangent, &units));
            let longest = rests.max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)))?;
            units.push(normalised(&longest));
        }
        let second = units.pop()?;
        let first = units.pop()?;
        let basis = [first, second];
        let is_known = normal.iter().chain(basis.iter().flatten()).all(|x| x.is_finite());
        is_known.then_some(Self { normal, basis })
    }

    /// Coordinates of a vector.
    pub fn coordinates(&self, vector: &[f64]) -> [f64; 2] {
        [dot(&self.basis[0], vector), dot(&self.basis[1], vector)]
    }

    /// Vector with these coordinates.
    pub fn vector(&self, x: [f64; 2]) -> Vec<f64> {
        let first: Vec<f64> = self.basis[0].iter().map(|e| x[0] * e).collect();
        plus(&first, x[1], &self.basis[1])
    }

    /// Chart with these unit vectors as axes.
    pub fn chart(&self, origin: &[f64], unstable: [f64; 2], stable: [f64; 2]) -> SurfaceChart {
        let area = unstable[0] * stable[1] - unstable[1] * stable[0];
        let rows = [[stable[1], -stable[0]], [-unstable[1], unstable[0]]];
        SurfaceChart {
            origin: origin.to_vec(),
            normal: self.normal.clone(),
            axes: [self.vector(unstable), self.vector(stable)],
            rows: rows.map(|row| self.vector(row.map(|x| x / area))),
        }
    }
}

impl Chain {
    /// Velocities at the nodes.
    pub fn fields(&self, shooting: &Shooting) -> Vec<Vec<f64>> {
        let fields = shooting.motion.field(&exact(&self.states));
        fields.iter().map(|field| field.iter().map(|x| x.mid).collect()).collect()
    }

    /// Surfaces at all nodes; at the ends across `ends`, where given.
    pub fn planes(&self, shooting: &Shooting, ends: Option<&[f64]>) -> Option<Vec<NodePlane>> {
        let mut fields = self.fields(shooting);
        if let (Some(normal), [first, .., last]) = (ends, fields.as_mut_slice()) {
            *first = normal.to_vec();
            *last = normal.to_vec();
        }
        let nodes = self.states.iter().zip(&fields);
        nodes.map(|(state, field)| NodePlane::new(shooting, state, field)).collect()
    }

    /// Links between the nodes, the gaps in double-double where asked. `None` where they are not
    /// known.
    pub fn links(
        &self,
        shooting: &Shooting,
        planes: &[NodePlane],
        is_sharp: bool,
    ) -> Option<Vec<Link>> {
        let starts = &self.states[..self.times.len()];
        let steps = shooting.motion.approximate(starts, &self.times);
        let targets: Vec<&[f64]> = self.states[1..].iter().map(Vec::as_slice).collect();
        let gaps: Vec<Option<Vec<f64>>> = match is_sharp {
            true => shooting
                .motion
                .gaps(starts, &self.times, 1.0, &targets)
                .into_iter()
                .map(|gap| Some(gap?.iter().map(|x| x.mid).collect()))
                .collect(),
            false => {
                steps.iter().zip(&targets).map(|((end, _), next)| Some(minus(end, next))).collect()
            }
        };
        let ends: Vec<Vec<f64>> = steps.iter().map(|(end, _)| end.clone()).collect();
        let fields = shooting.motion.field(&exact(&ends));
        let mut links = Vec::new();
        for (index, ((_, flow), gap)) in steps.iter().zip(gaps).enumerate() {
            let gap = gap?;
            let field: Vec<f64> = fields[index].iter().map(|x| x.mid).collect();
            let (own, next) = (&planes[index], &planes[index + 1]);
            let speed = dot(&next.normal, &field);
            let turned = |vector: &[f64]| {
                let late = -dot(&next.normal, vector) / speed;
                (next.coordinates(&plus(vector, late, &field)), late)
            };
            let along =
                |k: usize| -> Vec<f64> { flow.iter().map(|row| dot(row, &own.basis[k])).collect() };
            let ([a, c], first) = turned(&along(0));
            let ([b, d], second) = turned(&along(1));
            let (here, late_here) = turned(&gap);
            let height = dot(&next.normal, &gap);
            links.push(Link {
                slopes: [[a, b], [c, d]],
                gap: here,
                late: [first, second],
                late_here,
                height,
            });
        }
        Some(links)
    }

    /// Moves the nodes by vectors in their surfaces, and on to the level; adapts the times.
    pub fn shift(
        &mut self,
        shooting: &Shooting,
        planes: &[NodePlane],
        links: &[Link],
        steps: &[[f64; 2]],
    ) {
        for ((time, link), step) in self.times.iter_mut().zip(links).zip(steps) {
            *time += link.late_here + link.late[0] * step[0] + link.late[1] * step[1];
        }
        for ((state, plane), step) in self.states.iter_mut().zip(planes).zip(steps) {
            *state = plus(state, 1.0, &plane.vector(*step));
            settle(shooting, state);
        }
    }
}

/// Moves a state to the level of all conserved functions, along the gradients.
pub fn settle(shooting: &Shooting, state: &mut Vec<f64>) {
    for _ in 0..3 {
        let at: Boxed = state.iter().map(|x| Enclosure::exact(*x)).collect();
        let slopes = shooting.functions.slopes(&at);
        let values = shooting.functions.sharp(state, &shooting.values);
        // Gauss and Seidel: the gradients are few, and not nearly dependent.
        let mut units: Vec<(Vec<f64>, f64)> = Vec::new();
        for (slope, value) in slopes.iter().zip(&values) {
            let mut rest: Vec<f64> = slope.iter().map(|x| x.mid).collect();
            let mut height = value.mid;
            for (unit, known) in &units {
                let share = dot(&rest, unit);
                rest = plus(&rest, -share, unit);
                height -= share * known;
            }
            let length = dot(&rest, &rest).sqrt();
            units.push((rest.iter().map(|x| x / length).collect(), height / length));
        }
        for (unit, height) in &units {
            *state = plus(state, -height, unit);
        }
    }
}

/// Unstable directions from the first node on, stable ones from the last node back, and how links
/// stretch them.
pub struct Directions {
    pub unstable: Vec<[f64; 2]>,
    pub stable: Vec<[f64; 2]>,
    pub stretch: Vec<f64>,
    pub squeeze: Vec<f64>,
}

impl Directions {
    /// Follows directions given at the ends.
    pub fn new(links: &[Link], first: [f64; 2], last: [f64; 2]) -> Self {
        let (mut unstable, mut stretch) = (vec![first], Vec::new());
        let mut now = first;
        for link in links {
            let (next, factor) = unit(moved(&link.slopes, now));
            now = next;
            unstable.push(now);
            stretch.push(factor);
        }
        let (mut stable, mut squeeze) = (vec![last], Vec::new());
        let mut now = last;
        for link in links.iter().rev() {
            let [[a, b], [c, d]] = link.slopes;
            let (before, factor) = unit(split([a, c], [b, d], now));
            now = before;
            stable.push(now);
            squeeze.push(1.0 / factor);
        }
        stable.reverse();
        squeeze.reverse();
        Self { unstable, stable, stretch, squeeze }
    }

    /// Corrections of the nodes that close the gaps of a chain, where the first node moves along
    /// the stable direction by `first` and the last along the unstable one by `last`.
    pub fn closing(&self, links: &[Link], first: f64, last: f64) -> Vec<[f64; 2]> {
        let gaps: Vec<[f64; 2]> = links
            .iter()
            .enumerate()
            .map(|(k, link)| split(self.unstable[k + 1], self.stable[k + 1], link.gap))
            .collect();
        let mut along = vec![first];
        for (squeeze, gap) in self.squeeze.iter().zip(&gaps) {
            along.push(along[along.len() - 1] * squeeze + gap[1]);
        }
        let mut across = vec![last];
        for (stretch, gap) in self.stretch.iter().zip(&gaps).rev() {
            across.push((across[across.len() - 1] - gap[0]) / stretch);
        }
        across.reverse();
        let places = across.iter().zip(&along).enumerate();
        places
            .map(|(k, (u, s))| {
                let (e, f) = (self.unstable[k], self.stable[k]);
                [u * e[0] + s * f[0], u * e[1] + s * f[1]]
            })
            .collect()
    }
}

/// States as boxes without width.
pub fn exact(states: &[Vec<f64>]) -> Vec<Boxed> {
    states.iter().map(|state| state.iter().map(|x| Enclosure::exact(*x)).collect()).collect()
}

/// Length of a difference of two states.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    let off = minus(a, b);
    dot(&off, &off).sqrt()
}
