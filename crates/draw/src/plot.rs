//! One plot: axes with layers of points, lines and cells, marks over them, and their meaning.

use crate::axis::Axis;
use crate::density::CountGrid;
use crate::mark::MarkShape;
use crate::palette::Paint;
use crate::text::Text;

/// Plot with its axes, from the back to the front.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Words above the frame.
    pub title: Option<Text>,
    /// Horizontal axis.
    pub across: Axis,
    /// Vertical axis.
    pub up: Axis,
    /// Ratio of the frame's height to its width.
    pub aspect: f64,
    /// Whether lines run across the frame at the ticks.
    pub grid: bool,
    /// Layers, later ones over earlier ones.
    pub layers: Vec<Layer>,
    /// Marked points, over all layers.
    pub marks: Vec<MarkedPoint>,
    /// Meanings of colours and signs.
    pub legend: Vec<LegendEntry>,
    /// Meaning of a colour scale.
    pub bar: Option<Bar>,
}

/// Layer of a plot, in the coordinates of its axes.
#[derive(Clone, Debug)]
pub enum Layer {
    /// Dots of one colour.
    Dots(Vec<[f64; 2]>, Paint),
    /// Line through points, broken where one is undefined.
    Line(Vec<[f64; 2]>, Paint),
    /// Dashed line through points, broken where one is undefined.
    Dashes(Vec<[f64; 2]>, Paint),
    /// Cells that fill the frame: the number of columns, and colours row by row from above.
    Cells(usize, Vec<Option<Paint>>),
    /// Shaded density of points.
    Density(CountGrid),
}

/// Marked point.
#[derive(Clone, Debug)]
pub struct MarkedPoint {
    /// Position in the coordinates of the axes.
    pub at: [f64; 2],
    /// Shape.
    pub mark: MarkShape,
    /// Colour.
    pub paint: Paint,
    /// Words beside the sign, where there is room.
    pub label: Option<String>,
    /// Whether a rim of paper sets the sign off from dots.
    pub has_rim: bool,
}

/// Entry of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// Sign before the words.
    pub mark: MarkShape,
    /// Colour of the sign.
    pub paint: Paint,
    /// Meaning.
    pub text: Text,
}

/// Colour bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Name, range and ticks.
    pub axis: Axis,
    /// Colours from the low end to the high one.
    pub paints: Vec<Paint>,
}

impl Plot {
    /// Empty plot with the proportions of a section.
    pub fn new(across: Axis, up: Axis) -> Self {
        Self {
            title: None,
            across,
            up,
            aspect: 0.62,
            grid: false,
            layers: Vec::new(),
            marks: Vec::new(),
            legend: Vec::new(),
            bar: None,
        }
    }

    /// The same plot with one scale on both axes, so that angles are right; a range that is too
    /// short for its side becomes longer.
    pub fn with_equal_scales(mut self) -> Self {
        const LOW: f64 = 0.35;
        const HIGH: f64 = 1.0;
        let ratio = self.up.length() / self.across.length();
        if ratio < LOW {
            self.up = self.up.widened(self.up.name.clone(), LOW * self.across.length());
        } else if ratio > HIGH {
            self.across = self.across.widened(self.across.name.clone(), self.up.length() / HIGH);
        }
        self.aspect = self.up.length() / self.across.length();
        self
    }
}
