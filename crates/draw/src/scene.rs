//! Scene in millimetres: what all formats draw, from the upper left corner, later items over
//! earlier ones.

use crate::palette::Paint;
use crate::text::Text;

/// Point in millimetres from the upper left corner.
pub type Point = [f64; 2];

/// Picture as a list of items.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Title for readers that do not see the picture.
    pub title: String,
    /// Width in millimetres.
    pub width: f64,
    /// Height in millimetres.
    pub height: f64,
    /// Items from the back to the front.
    pub items: Vec<SceneItem>,
}

/// Item of a scene; lengths are in millimetres, opacities from 0 to 1.
#[derive(Clone, Debug)]
pub enum SceneItem {
    /// Round dots of one colour. Where they overlap, opacities add up.
    Dots {
        /// Centres.
        at: Vec<Point>,
        /// Diameter of a dot.
        diameter: f64,
        /// Colour.
        paint: Paint,
        /// Opacity of a dot.
        opacity: f64,
    },
    /// Lines through points, each with round joins.
    Lines {
        /// Points of each line.
        lines: Vec<Vec<Point>>,
        /// Width of the lines.
        width: f64,
        /// Colour.
        paint: Paint,
        /// Opacity.
        opacity: f64,
    },
    /// Upright rectangles of one colour, with sharp edges.
    Boxes {
        /// Left, top, width and height of each.
        boxes: Vec<[f64; 4]>,
        /// Colour.
        paint: Paint,
    },
    /// Circle or polygon.
    Shape {
        /// Outline of the shape.
        outline: Outline,
        /// Colour of the inside.
        fill: Option<Paint>,
        /// Colour and width of the outline.
        stroke: Option<(Paint, f64)>,
        /// Opacity of the inside.
        opacity: f64,
    },
    /// Words on one line.
    Words {
        /// Position of the anchor, on the base line.
        at: Point,
        /// Words.
        text: Text,
        /// Size of the type.
        size: f64,
        /// Part of the words at the position.
        anchor: Anchor,
        /// Whether the words run upwards.
        turned: bool,
        /// Colour.
        paint: Paint,
    },
    /// Pixels, stretched over a rectangle.
    Image {
        /// Left, top, width and height.
        place: [f64; 4],
        /// Number of columns.
        columns: usize,
        /// Pixels row by row from above; the paper shows where there is none.
        pixels: Vec<Option<Paint>>,
    },
}

/// Outline of a shape.
#[derive(Clone, Debug)]
pub enum Outline {
    /// Circle with its centre and radius.
    Circle(Point, f64),
    /// Closed polygon.
    Polygon(Vec<Point>),
}

/// Part of a line of words that stands at its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Left end.
    Start,
    /// Middle.
    Middle,
    /// Right end.
    End,
}
