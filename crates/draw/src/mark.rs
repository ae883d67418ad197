//! Signs of points, for marks in plots and entries of legends.

use crate::palette::Paint;
use crate::scene::{Outline, Point, SceneItem};

/// Shape of a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkShape {
    /// Filled circle.
    Disc,
    /// Circle with an empty inside.
    Ring,
    /// Two crossed lines.
    Cross,
    /// Triangle that points up.
    Up,
    /// Triangle that points down.
    Down,
    /// Low bar.
    Bar,
    /// Square on its corner.
    Diamond,
    /// Narrow square on its corner.
    Needle,
    /// Filled box.
    Box,
    /// Piece of a line.
    Line,
    /// Piece of a dashed line.
    Dashes,
    /// Dot of the size of a section's.
    Dot,
}

impl MarkShape {
    /// Items that draw the sign, about twice `size` across.
    pub(crate) fn items(self, [x, y]: Point, size: f64, paint: Paint) -> Vec<SceneItem> {
        let filled = |corners: &[(f64, f64)]| {
            let corners = corners.iter().map(|(dx, dy)| [x + dx * size, y + dy * size]).collect();
            vec![SceneItem::Shape {
                outline: Outline::Polygon(corners),
                fill: Some(paint),
                stroke: None,
                opacity: 1.0,
            }]
        };
        let disc = |radius: f64| {
            vec![SceneItem::Shape {
                outline: Outline::Circle([x, y], radius),
                fill: Some(paint),
                stroke: None,
                opacity: 1.0,
            }]
        };
        let lines = |lines: Vec<Vec<Point>>, paint, width| SceneItem::Lines {
            lines,
            width,
            paint,
            opacity: 1.0,
        };
        match self {
            MarkShape::Disc => disc(0.9 * size),
            MarkShape::Dot => disc(0.35 * size),
            MarkShape::Ring => vec![SceneItem::Shape {
                outline: Outline::Circle([x, y], 0.9 * size),
                fill: Some(Paint::Paper),
                stroke: Some((paint, 0.35 * size)),
                opacity: 1.0,
            }],
            MarkShape::Cross => {
                let d = 0.85 * size;
                let both = vec![
                    vec![[x - d, y - d], [x + d, y + d]],
                    vec![[x - d, y + d], [x + d, y - d]],
                ];
                vec![lines(both.clone(), Paint::Paper, 0.9 * size), lines(both, paint, 0.4 * size)]
            }
            MarkShape::Up => filled(&[(0.0, -1.1), (1.1, 0.9), (-1.1, 0.9)]),
            MarkShape::Down => filled(&[(0.0, 1.1), (1.1, -0.9), (-1.1, -0.9)]),
            MarkShape::Bar => filled(&[(-1.2, -0.4), (1.2, -0.4), (1.2, 0.4), (-1.2, 0.4)]),
            MarkShape::Diamond => filled(&[(0.0, -1.2), (1.2, 0.0), (0.0, 1.2), (-1.2, 0.0)]),
            MarkShape::Needle => filled(&[(0.0, -1.2), (0.6, 0.0), (0.0, 1.2), (-0.6, 0.0)]),
            MarkShape::Box => filled(&[(-1.2, -1.0), (1.2, -1.0), (1.2, 1.0), (-1.2, 1.0)]),
            MarkShape::Dashes => {
                let dash = |from: f64| vec![[x + from * size, y], [x + (from + 0.8) * size, y]];
                vec![lines([-1.6, -0.4, 0.8].map(dash).to_vec(), paint, 0.35 * size)]
            }
            MarkShape::Line => {
                vec![lines(
                    vec![vec![[x - 1.5 * size, y], [x + 1.5 * size, y]]],
                    paint,
                    0.35 * size,
                )]
            }
        }
    }

    /// A rim of paper around the sign, so that dots do not hide it.
    pub(crate) fn halo(self, [x, y]: Point, size: f64) -> Option<SceneItem> {
        let circle = SceneItem::Shape {
            outline: Outline::Circle([x, y], 1.4 * size),
            fill: Some(Paint::Paper),
            stroke: None,
            opacity: 0.85,
        };
        let is_plain =
            matches!(self, MarkShape::Dot | MarkShape::Line | MarkShape::Dashes | MarkShape::Box);
        (!is_plain).then_some(circle)
    }
}
