//! Figure of one or several plots, with its words, laid out in millimetres.

use crate::layout::Layout;
use crate::palette::Paint;
use crate::plot::{LegendEntry, Plot};
use crate::scene::{Anchor, Scene, SceneItem};
use crate::text::{Text, plain};

/// Figure with its words.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Title above the plots; none if it is empty.
    pub title: String,
    /// Lines below the plots.
    pub caption: Vec<Text>,
    /// Plots row by row.
    pub plots: Vec<Plot>,
    /// Number of plots side by side.
    pub columns: usize,
    /// Size of the figure and of its dots.
    pub size: Size,
}

/// Size of a figure and of its dots.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Width in millimetres.
    pub width: f64,
    /// Height in millimetres; by the proportions of the plots if it is not given.
    pub height: Option<f64>,
    /// Diameter of dots in millimetres.
    pub dot: f64,
    /// Opacity of dots and lines, from 0 to 1.
    pub opacity: f64,
}

impl Figure {
    /// Lays the figure out.
    pub fn scene(&self) -> Scene {
        let layout = Layout::of(self);
        let mut scene = Scene {
            title: self.title.clone(),
            width: self.size.width,
            height: layout.height,
            items: Vec::new(),
        };
        let mut baseline = layout.rim + layout.heading * 0.9;
        for line in &layout.title {
            scene.items.push(words(
                [self.size.width / 2.0, baseline],
                line,
                layout.heading,
                Anchor::Middle,
            ));
            baseline += 1.3 * layout.heading;
        }
        for (place, plot) in self.plots.iter().enumerate() {
            layout.draw(&mut scene.items, self, plot, place);
        }
        if let Some(bar) = &layout.common_bar {
            layout.draw_bar(&mut scene.items, bar, layout.bar_frame());
        }
        let mut top = layout.legend_top;
        for line in &layout.legend {
            for (left, entry) in line {
                let middle = top + 0.65 * layout.type_size;
                let at = [left + 0.7 * layout.type_size, middle];
                scene.items.extend(entry.mark.items(at, 0.42 * layout.type_size, entry.paint));
                let at = [left + 1.7 * layout.type_size, middle + 0.36 * layout.type_size];
                scene.items.push(words(at, &entry.text, layout.type_size, Anchor::Start));
            }
            top += 1.5 * layout.type_size;
        }
        let mut baseline = layout.caption_top + 0.9 * layout.small;
        for line in &layout.caption {
            scene.items.push(words([layout.rim, baseline], line, layout.small, Anchor::Start));
            baseline += 1.35 * layout.small;
        }
        scene
    }

    /// Entries of all plots, each once.
    pub(crate) fn entries(&self) -> Vec<LegendEntry> {
        let mut found: Vec<LegendEntry> = Vec::new();
        for entry in self.plots.iter().flat_map(|plot| &plot.legend) {
            if !found.contains(entry) {
                found.push(entry.clone());
            }
        }
        found
    }

    /// Letter of a plot, where there are several.
    pub(crate) fn letter(&self, place: usize) -> Option<Text> {
        let letter = char::from(b'a' + u8::try_from(place % 26).unwrap_or(0));
        (self.plots.len() > 1).then(|| plain(&format!("({letter})")))
    }
}

/// Upright words in ink.
pub(crate) fn words(at: [f64; 2], text: &Text, size: f64, anchor: Anchor) -> SceneItem {
    SceneItem::Words { at, text: text.clone(), size, anchor, turned: false, paint: Paint::Ink }
}
