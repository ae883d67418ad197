//! Places of plots, words and legends in a figure.

mod frame;

use crate::axis::Axis;
use crate::figure::Figure;
use crate::plot::{Bar, LegendEntry, Plot};
use crate::text::{Text, plain};

/// Type size of a figure of usual width, in millimetres: 8 points.
const TYPE: f64 = 2.82;
/// Width of a figure from which on the type has its full size.
const USUAL: f64 = 110.0;

/// Places of all parts of a figure.
pub(crate) struct Layout {
    pub type_size: f64,
    pub heading: f64,
    pub small: f64,
    /// Distance of all parts to the edge.
    pub rim: f64,
    pub title: Vec<Text>,
    pub legend: Vec<Vec<(f64, LegendEntry)>>,
    pub legend_top: f64,
    pub caption: Vec<Text>,
    pub caption_top: f64,
    pub height: f64,
    /// Bar on the right of all plots.
    pub common_bar: Option<Bar>,
    /// Left, top, width and height of the frame of each plot.
    frames: Vec<[f64; 4]>,
    /// Whether tick labels stand at the outermost plots only.
    shares: [bool; 2],
    columns: usize,
    /// Distance from the frame to the vertical name, by columns.
    lefts: Vec<f64>,
}

impl Layout {
    pub fn of(figure: &Figure) -> Self {
        let width = figure.size.width;
        let type_size = TYPE * (width / USUAL).clamp(0.8, 1.0);
        let (heading, small, rim) = (1.12 * type_size, 0.86 * type_size, 0.5 * type_size);
        let inner = width - 2.0 * rim;
        let title = match figure.title.is_empty() {
            true => Vec::new(),
            false => plain(&figure.title).wrapped(heading, inner),
        };
        let columns = figure.columns.clamp(1, figure.plots.len().max(1));
        let plots: Vec<Vec<&Plot>> =
            figure.plots.chunks(columns).map(|row| row.iter().collect()).collect();
        let shares = shares(&figure.plots);
        let common_bar = common_bar(&figure.plots);
        let mut found = Self {
            type_size,
            heading,
            small,
            rim,
            title,
            legend: Vec::new(),
            legend_top: 0.0,
            caption: figure.caption.iter().flat_map(|line| line.wrapped(small, inner)).collect(),
            caption_top: 0.0,
            height: 0.0,
            common_bar,
            frames: Vec::new(),
            shares,
            columns,
            lefts: Vec::new(),
        };
        found.legend = found.flow(figure.entries(), inner);
        found.place(figure, &plots);
        found
    }

    /// Room for the labels and the name of a vertical axis.
    fn left(&self, axis: &Axis) -> f64 {
        let labels = axis.ticks.iter().map(|(_, word)| plain(word).width(self.type_size));
        labels.fold(0.0, f64::max) + 0.9 * self.type_size + self.name(&axis.name)
    }

    /// Room for the name of an axis.
    fn name(&self, name: &Text) -> f64 {
        if name.is_empty() { 0.0 } else { 1.5 * self.type_size }
    }

    /// Room for a colour bar.
    fn right(&self, bar: Option<&Bar>) -> f64 {
        bar.map_or(0.0, |bar| 2.2 * self.type_size + self.left(&bar.axis))
    }

    /// Room below a frame.
    fn below(&self, axis: &Axis) -> f64 {
        1.75 * self.type_size + self.name(&axis.name)
    }

    fn place(&mut self, figure: &Figure, plots: &[Vec<&Plot>]) {
        let (size, gap) = (self.type_size, 0.9 * self.type_size);
        let column = |k: usize| plots.iter().filter_map(move |row| row.get(k).copied());
        let own_bar = |plot: &Plot| match self.common_bar {
            Some(_) => 0.0,
            None => self.right(plot.bar.as_ref()),
        };
        // Labels at the ends of neighbouring axes keep apart.
        let ends = plots.iter().flatten().map(|plot| end_labels(&plot.across, size));
        let between = gap.max(ends.fold(0.0, f64::max) + 0.6 * size);
        let lefts: Vec<f64> = (0..self.columns)
            .map(|k| match (k > 0, self.shares[1]) {
                (true, true) => between,
                (later, _) => {
                    let room = column(k).map(|plot| self.left(&plot.up)).fold(0.0, f64::max);
                    room + if later { gap } else { 0.0 }
                }
            })
            .collect();
        let rights: Vec<f64> =
            (0..self.columns).map(|k| column(k).map(own_bar).fold(0.0, f64::max)).collect();
        // Labels at the end of an axis reach beyond the frame.
        let overhang = 0.8 * size;
        let taken: f64 = lefts.iter().chain(&rights).sum();
        let bar = self.right(self.common_bar.as_ref());
        let inner = figure.size.width - 2.0 * self.rim - overhang - taken - bar;
        let wide = (inner / self.columns as f64).max(4.0);
        let rows = plots.len();
        let lines =
            |plot: &&Plot| plot.title.as_ref().map_or(0, |title| title.wrapped(size, wide).len());
        let aboves: Vec<f64> = plots
            .iter()
            .map(|row| row.iter().map(lines).max().unwrap_or(0) as f64 * 1.35 * size)
            .collect();
        let belows: Vec<f64> = (0..rows)
            .map(|k| match k + 1 < rows && self.shares[0] {
                true => 1.5 * gap,
                false => {
                    let rooms = plots[k].iter().map(|plot| self.below(&plot.across));
                    rooms.fold(0.0, f64::max) + if k + 1 < rows { 0.6 * gap } else { 0.0 }
                }
            })
            .collect();
        let start = self.rim
            + self.title.len() as f64 * 1.3 * self.heading
            + if self.title.is_empty() { 0.4 * size } else { 0.7 * size };
        let legend = self.legend.len() as f64 * 1.5 * size
            + if self.legend.is_empty() { 0.0 } else { 0.5 * size };
        let caption = self.caption.len() as f64 * 1.35 * self.small
            + if self.caption.is_empty() { 0.0 } else { 0.4 * size };
        let words = start + aboves.iter().chain(&belows).sum::<f64>() + legend + caption + self.rim;
        let tall = |row: &[&Plot]| match figure.size.height {
            Some(height) => ((height - words) / rows as f64).max(4.0),
            None => row.iter().map(|plot| plot.aspect).fold(0.0, f64::max) * wide,
        };
        let mut top = start;
        for (k, row) in plots.iter().enumerate() {
            let (height, mut left) = (tall(row), self.rim);
            top += aboves[k];
            for column in 0..row.len() {
                left += lefts[column];
                self.frames.push([left, top, wide, height]);
                left += wide + rights[column];
            }
            top += height + belows[k];
        }
        self.lefts = lefts;
        self.legend_top = top + if self.legend.is_empty() { 0.0 } else { 0.5 * size };
        self.caption_top = top + legend + 0.2 * size;
        self.height = (top + legend + caption + self.rim).max(figure.size.height.unwrap_or(0.0));
    }

    /// Entries of the legend in lines.
    fn flow(&self, entries: Vec<LegendEntry>, inner: f64) -> Vec<Vec<(f64, LegendEntry)>> {
        let mut lines: Vec<Vec<(f64, LegendEntry)>> = Vec::new();
        let mut left = self.rim;
        for entry in entries {
            let width = 1.7 * self.type_size + entry.text.width(self.type_size);
            if lines.is_empty() || left + width > self.rim + inner {
                lines.push(Vec::new());
                left = self.rim;
            }
            if let Some(line) = lines.last_mut() {
                line.push((left, entry));
            }
            left += width + 1.3 * self.type_size;
        }
        lines
    }
}

/// Half the width of the first and the last label of an axis together.
fn end_labels(axis: &Axis, size: f64) -> f64 {
    let both = [axis.ticks.first(), axis.ticks.last()];
    both.into_iter().flatten().map(|(_, word)| plain(word).width(size) / 2.0).sum()
}

/// Whether all plots have the same horizontal axis, and the same vertical one.
fn shares(plots: &[Plot]) -> [bool; 2] {
    let same =
        |axis: fn(&Plot) -> &Axis| plots.windows(2).all(|pair| axis(&pair[0]) == axis(&pair[1]));
    // Titles stand between the rows, where the labels would be missed.
    let no_titles = plots.iter().all(|plot| plot.title.is_none());
    [same(|plot| &plot.across) && no_titles, same(|plot| &plot.up)]
        .map(|same| same && plots.len() > 1)
}

/// Bar of all plots, if it is the same.
fn common_bar(plots: &[Plot]) -> Option<Bar> {
    let first = plots.first()?.bar.clone()?;
    plots.iter().all(|plot| plot.bar.as_ref() == Some(&first)).then_some(first)
}
