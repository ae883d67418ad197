//! Pictures of sections and of motions: points and lines in a rectangle, as SVG or PNG.
//!
//! The rectangle of l and L/G is the sphere in Lambert's cylindrical projection, which preserves
//! areas.

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
    /// Horizontal coordinate, such as l in [0, 2π).
    pub x: f64,
    /// Vertical coordinate, such as L/G in [-1, 1].
    pub y: f64,
}

/// Colour of a layer.
#[derive(Clone, Copy, Debug)]
pub enum Tint {
    /// Position on the colour scale, from 0 to 1.
    Shade(f64),
    /// Grey, behind other layers.
    Faint,
}

/// Dots of one colour.
#[derive(Clone, Debug)]
pub struct Layer {
    /// Colour of the dots.
    pub tint: Tint,
    /// Dots of the layer.
    pub dots: Vec<Dot>,
    /// Whether a line joins the dots, in their order.
    pub joined: bool,
}

/// A picture of dots and lines.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Title of the picture.
    pub title: String,
    /// Horizontal axis.
    pub across: Scale,
    /// Vertical axis.
    pub up: Scale,
    /// Layers of dots, later ones over earlier ones.
    pub layers: Vec<Layer>,
    /// Further dots over all layers, such as images of fixed lines of a reversor.
    pub overlay: Vec<Dot>,
    /// Points to be marked, such as fixed points.
    pub marks: Vec<Dot>,
    /// Width in pixels.
    pub width: u32,
}

/// Frame of the plot, in pixels, with its axes.
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
/// Ratio of height to width: somewhat above that of a sphere, 2π by 2, for legibility.
const ASPECT: f64 = 0.62;

impl Frame {
    /// A frame in a picture of this width, with additional room below it.
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
        Frame::new(self.width, self.across.clone(), self.up.clone(), 0.0)
    }
}
