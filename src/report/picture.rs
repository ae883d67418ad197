//! Pictures of Poincaré sections: points in the rectangle of l and L/G, as SVG or PNG.
//!
//! The rectangle is the sphere in Lambert's cylindrical projection: equal areas are equal.

mod glyphs;
mod palette;
mod png;
mod svg;

use std::f64::consts::PI;

pub use png::png;
pub use svg::svg;

/// A point of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// l in [0, 2π).
    pub l: f64,
    /// L/G in [-1, 1].
    pub z: f64,
}

/// Dots of one colour.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Its place on the scale of colours, from 0 to 1.
    pub shade: f64,
    /// The dots.
    pub dots: Vec<Dot>,
}

/// A picture of a section.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What it shows.
    pub title: String,
    /// The dots, later layers over earlier ones.
    pub layers: Vec<Layer>,
    /// Further dots over all of them, such as images of fixed lines of a reversor.
    pub overlay: Vec<Dot>,
    /// Points to be marked, such as fixed points.
    pub marks: Vec<Dot>,
    /// The width in pixels.
    pub width: u32,
}

/// The frame around the dots, in pixels.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    total: (f64, f64),
}

/// Margins in pixels.
const LEFT: f64 = 40.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 12.0;
const BELOW: f64 = 30.0;
/// Height over width: the area of a sphere is 2π by 2, drawn somewhat higher to be read.
const ASPECT: f64 = 0.62;

/// Where ticks stand and what they are called.
const TICKS_L: [(f64, &str); 5] =
    [(0.0, "0"), (0.5 * PI, "π/2"), (PI, "π"), (1.5 * PI, "3π/2"), (2.0 * PI, "2π")];
const TICKS_Z: [(f64, &str); 5] =
    [(-1.0, "-1"), (-0.5, "-0.5"), (0.0, "0"), (0.5, "0.5"), (1.0, "1")];

impl Picture {
    fn frame(&self) -> Frame {
        let width = f64::from(self.width) - LEFT - RIGHT;
        let height = (width * ASPECT).round();
        let total = (f64::from(self.width), height + TOP + BELOW);
        Frame { left: LEFT, top: TOP, width, height, total }
    }
}

impl Frame {
    fn x(&self, l: f64) -> f64 {
        self.left + l / (2.0 * PI) * self.width
    }

    fn y(&self, z: f64) -> f64 {
        self.top + (1.0 - z) / 2.0 * self.height
    }
}
