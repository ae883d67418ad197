//! Pictures of Poincaré sections: points in the rectangle of l and L/G, as SVG or PNG.
//!
//! The rectangle is the sphere in Lambert's cylindrical projection: equal areas are equal.

mod glyphs;
mod map;
mod palette;
mod png;
mod scale;
mod svg;

pub use map::{Map, Swatch};
pub use palette::Paper;
pub use png::png;
pub use scale::Scale;
pub use svg::{inline_svg, svg};

/// A point of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// l in [0, 2π).
    pub l: f64,
    /// L/G in [-1, 1].
    pub z: f64,
}

/// The colour of a layer.
#[derive(Clone, Copy, Debug)]
pub enum Tint {
    /// A place on the scale of colours, from 0 to 1.
    Shade(f64),
    /// Grey, behind others.
    Faint,
}

/// Dots of one colour.
#[derive(Clone, Debug)]
pub struct Layer {
    /// The colour.
    pub tint: Tint,
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

/// The frame around what is drawn, in pixels, and its axes.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
    total: (f64, f64),
    across: Scale,
    up: Scale,
}

/// Margins in pixels.
const LEFT: f64 = 40.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 12.0;
const BELOW: f64 = 30.0;
/// Height over width: the area of a sphere is 2π by 2, drawn somewhat higher to be read.
const ASPECT: f64 = 0.62;

impl Frame {
    /// A frame in a picture of this width, with room for more below it.
    fn new(width: u32, across: Scale, up: Scale, below: f64) -> Self {
        let left = LEFT.max(8.0 + 7.0 * up.widest() as f64);
        let inner = f64::from(width) - left - RIGHT;
        let height = (inner * ASPECT).round();
        let total = (f64::from(width), height + TOP + BELOW + below);
        Frame { left, top: TOP, width: inner, height, total, across, up }
    }

    fn x(&self, value: f64) -> f64 {
        self.left + self.across.share(value) * self.width
    }

    fn y(&self, value: f64) -> f64 {
        self.top + (1.0 - self.up.share(value)) * self.height
    }
}

impl Picture {
    fn frame(&self) -> Frame {
        Frame::new(self.width, Scale::longitude(), Scale::height(), 0.0)
    }
}
