//! Planes across a motion, with coordinates along its unstable and its stable direction.
//!
//! On the level of all conserved functions a plane (n, x - o) = 0 is a surface. The numbers
//! z = L (x - o), one along the unstable direction and one along the stable direction, are
//! coordinates of it.

use super::super::enclosure::Enclosure;
use super::super::krawczyk::{Inverse, is_regular};
use super::super::motion::Boxed;
use super::super::shooting::{Columns, Shooting, combined};
use super::vectors::{dot, minus};

/// Surface across a motion, with coordinates.
#[derive(Clone, Debug)]
pub struct SurfaceChart {
    /// Point o of the plane.
    pub origin: Vec<f64>,
    /// Vector n across the plane.
    pub normal: Vec<f64>,
    /// Unit vectors along the unstable and the stable direction.
    pub axes: [Vec<f64>; 2],
    /// Rows of L, dual to the axes.
    pub rows: [Vec<f64>; 2],
}

impl SurfaceChart {
    /// Coordinates of a state.
    pub fn coordinates(&self, state: &[f64]) -> [f64; 2] {
        let off = minus(state, &self.origin);
        [dot(&self.rows[0], &off), dot(&self.rows[1], &off)]
    }
}

/// Part of a surface over a rectangle of coordinates, enclosed.
pub struct Patch {
    /// Box that contains exactly one point for each pair of coordinates.
    pub states: Boxed,
    /// Derivatives of the points by the coordinates, component by component.
    pub slopes: Vec<[Enclosure; 2]>,
    /// Point of the middle of the rectangle, less the centre.
    pub middle: Boxed,
}

/// Limit on the boxes tried, and the growth from one to the next.
const MOST_BOXES: usize = 5;
const GROWTH: f64 = 1.2;
/// First radius of a box against the one expected, and the least, relative to the state.
const ROOM: f64 = 1.05;
const LEAST: f64 = 4e-16;

impl Patch {
    /// Encloses the points of a chart with coordinates within `half` of `middle`. The centre is an
    /// approximate point with the coordinates of the middle. `None` where it is not proved that
    /// each pair of coordinates has one point.
    ///
    /// The equations L (x - o) = z, (n, x - o) = 0, F(x) = c are solved by Krawczyk's operator, for
    /// all z of the rectangle at once.
    pub fn new(
        shooting: &Shooting,
        chart: &SurfaceChart,
        centre: &[f64],
        middle: [f64; 2],
        half: [f64; 2],
    ) -> Option<Self> {
        let off: Boxed = centre
            .iter()
            .zip(&chart.origin)
            .map(|(x, o)| Enclosure::exact(*x) - Enclosure::exact(*o))
            .collect();
        let mut residual: Boxed = vec![
            combined(&chart.rows[0], &off) - Enclosure::exact(middle[0]),
            combined(&chart.rows[1], &off) - Enclosure::exact(middle[1]),
            combined(&chart.normal, &off),
        ];
        residual.extend(shooting.functions.sharp(centre, &shooting.values));
        let at: Boxed = centre.iter().map(|x| Enclosure::exact(*x)).collect();
        let order: Vec<usize> = (0..centre.len()).collect();
        let inverse = Inverse::new(&derivative(shooting, chart, &at)?, &order)?;
        let shift = inverse.bounds(&residual);
        let edge = |row: usize| {
            let row = inverse.row(row);
            up(up(row[0].abs() * half[0]) + up(row[1].abs() * half[1]))
        };
        let floor = |x: &f64| LEAST * x.abs().max(1.0);
        let mut radii: Vec<f64> = centre
            .iter()
            .enumerate()
            .map(|(row, x)| ROOM * edge(row) + 2.0 * shift[row] + floor(x))
            .collect();
        for _ in 0..MOST_BOXES {
            let states: Boxed =
                centre.iter().zip(&radii).map(|(x, r)| Enclosure::about(*x, *r)).collect();
            let columns = derivative(shooting, chart, &states)?;
            let (moved, norm) = inverse.defects(&columns, &radii);
            let images: Vec<f64> =
                (0..centre.len()).map(|row| up(up(shift[row] + edge(row)) + moved[row])).collect();
            if images.iter().zip(&radii).all(|(image, radius)| image < radius) && norm < 1.0 {
                return Self::solved(centre, &images, &inverse, &columns, &shift);
            }
            if !images.iter().all(|x| x.is_finite()) {
                return None;
            }
            radii = images.iter().zip(centre).map(|(x, c)| GROWTH * x + floor(c)).collect();
        }
        None
    }

    /// Gathers the enclosures. With R = 1 - C G', ‖R‖ < 1, each vector v has
    /// (1 - R)⁻¹ v - v = R v + R² (1 - R)⁻¹ v.
    fn solved(
        centre: &[f64],
        radii: &[f64],
        inverse: &Inverse,
        columns: &Columns,
        shift: &[f64],
    ) -> Option<Self> {
        let (sums, norm) = inverse.defects(columns, &vec![1.0; centre.len()]);
        let room = 1.0 - up(norm);
        if room.is_nan() || room <= 0.0 {
            return None;
        }
        let errors = |sizes: &[f64]| -> Vec<f64> {
            let (first, _) = inverse.defects(columns, sizes);
            let largest = first.iter().fold(0.0, |a, b| if *b <= a { a } else { *b });
            first.iter().zip(&sums).map(|(x, sum)| up(x + up(up(sum * largest) / room))).collect()
        };
        let column = |k: usize| -> Vec<f64> {
            (0..centre.len()).map(|row| inverse.row(row)[k]).collect::<Vec<f64>>()
        };
        let [first, second] = [column(0), column(1)];
        let bound = |column: &[f64]| errors(&column.iter().map(|x| x.abs()).collect::<Vec<_>>());
        let (first_errors, second_errors) = (bound(&first), bound(&second));
        let slopes = (0..centre.len()).map(|row| {
            [
                Enclosure::about(first[row], first_errors[row]),
                Enclosure::about(second[row], second_errors[row]),
            ]
        });
        let off = errors(shift);
        let middle = shift.iter().zip(&off).map(|(x, more)| Enclosure::about(0.0, up(x + more)));
        let states = centre.iter().zip(radii).map(|(x, r)| Enclosure::about(*x, *r));
        Some(Self { states: states.collect(), slopes: slopes.collect(), middle: middle.collect() })
    }
}

/// Bound of a number computed by one operation on non-negative numbers.
fn up(x: f64) -> f64 {
    super::super::enclosure::raised(x, 1)
}

/// Encloses the derivative of the equations of a chart over a box, by rows.
fn rows(shooting: &Shooting, chart: &SurfaceChart, states: &[Enclosure]) -> Vec<Boxed> {
    let known = [&chart.rows[0], &chart.rows[1], &chart.normal];
    let exact = |row: &Vec<f64>| -> Boxed { row.iter().map(|x| Enclosure::exact(*x)).collect() };
    let mut rows: Vec<Boxed> = known.into_iter().map(exact).collect();
    rows.extend(shooting.functions.slopes(states));
    rows
}

/// The same by columns. `None` where there are not as many equations as components.
fn derivative(shooting: &Shooting, chart: &SurfaceChart, states: &[Enclosure]) -> Option<Columns> {
    let (rows, n) = (rows(shooting, chart, states), states.len());
    (rows.len() == n).then(|| {
        let column = |column: usize| (0..n).map(|row| (row, rows[row][column])).collect();
        (0..n).map(column).collect()
    })
}

/// Whether points of two boxes on the surface of a chart are equal where their coordinates are: by
/// the mean value theorem, where the derivative of the equations is regular over both.
pub fn are_joined(
    shooting: &Shooting,
    chart: &SurfaceChart,
    ends: &[Enclosure],
    states: &[Enclosure],
) -> bool {
    let hull: Boxed = ends.iter().zip(states).map(|(x, y)| x.hull(*y)).collect();
    is_regular(&rows(shooting, chart, &hull))
}
