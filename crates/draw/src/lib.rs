//! Figures for papers: a figure of plots becomes one scene in millimetres, and the scene is drawn as
//! SVG, PDF and PNG.
//!
//! The same figure gives the same bytes on every machine: no clock, no fonts of the system.

mod axis;
mod density;
mod figure;
mod font;
mod labels;
mod layout;
mod mark;
mod palette;
mod pdf;
mod plot;
mod raster;
mod scene;
mod svg;
mod text;

pub use axis::{Axis, power_of_ten};
pub use density::CountGrid;
pub use figure::{Figure, Size};
pub use font::width;
pub use mark::MarkShape;
pub use palette::{CATEGORIES, Paint, Paper, gradient};
pub use pdf::pdf;
pub use plot::{Bar, Layer, LegendEntry, MarkedPoint, Plot};
pub use raster::{PngError, png};
pub use scene::{Anchor, Outline, Scene, SceneItem};
pub use svg::{inline_svg, svg};
pub use text::{Text, math, plain};
