//! Work–precision diagram: error to the right, time upwards, both logarithmic; a sign for each method,
//! a colour for each domain.
//!
//! The layout depends on the rows alone. Up to six claims have a plot each, with a label at every
//! point that has room for one; more are drawn together.

use liouville_draw::{
    Axis, CATEGORIES, Figure, LegendEntry, MarkShape, MarkedPoint, Paint, Plot, Size, plain,
    power_of_ten, svg as drawn,
};
use liouville_lab::bench::{ClaimMeasurements, DifferentiationMethod, MethodMeasurements};

/// Number of claims above which all share one plot.
const MOST_PLOTS: usize = 6;
/// Decade at which smaller errors are drawn: exact results have no place on a logarithmic axis.
const LEAST_ERROR: f64 = -90.0;

/// Draws the diagram of some claims.
pub fn svg(measured: &[ClaimMeasurements]) -> String {
    // A residual that is nowhere defined has no error, and no place in the diagram.
    let shown = |m: &&MethodMeasurements| m.max_error.is_some();
    let are_apart = measured.len() <= MOST_PLOTS;
    let plots: Vec<(String, Vec<&MethodMeasurements>)> = if are_apart {
        let title = |m: &ClaimMeasurements| match m.item == m.claim {
            true => m.item.clone(),
            false => format!("{}: {}", m.item, m.claim),
        };
        measured.iter().map(|m| (title(m), m.rows.iter().filter(shown).collect())).collect()
    } else {
        let rows = measured.iter().flat_map(|m| &m.rows).filter(shown).collect();
        vec![(format!("{} claims", measured.len()), rows)]
    };
    let domains = domains(measured);
    let axes = axes(plots.iter().flat_map(|(_, rows)| rows.iter().copied()));
    let mut plots: Vec<Plot> =
        plots.iter().map(|(title, rows)| plot(title, rows, &axes, &domains, are_apart)).collect();
    if let Some(first) = plots.first_mut() {
        first.legend = legend(&methods(measured), &domains);
    }
    let size = Size { width: 200.0, height: None, dot: 0.2, opacity: 1.0 };
    let title = "Run time against error".to_string();
    let figure = Figure { title, caption: Vec::new(), plots, columns: 1, size };
    drawn(&figure.scene())
}

fn domains(measured: &[ClaimMeasurements]) -> Vec<&'static str> {
    let mut domains = Vec::new();
    for row in measured.iter().flat_map(|m| &m.rows) {
        if !domains.contains(&row.domain) {
            domains.push(row.domain);
        }
    }
    domains
}

fn methods(measured: &[ClaimMeasurements]) -> Vec<DifferentiationMethod> {
    let used = |method: &DifferentiationMethod| {
        measured.iter().any(|m| m.rows.iter().any(|r| r.method == *method))
    };
    DifferentiationMethod::ALL
        .into_iter()
        .filter(|method| *method != DifferentiationMethod::Floor && used(method))
        .collect()
}

fn legend(methods: &[DifferentiationMethod], domains: &[&'static str]) -> Vec<LegendEntry> {
    let method = |method: &DifferentiationMethod| LegendEntry {
        mark: mark(*method),
        paint: Paint::Soft,
        text: plain(method.name()),
    };
    let domain = |(place, name): (usize, &&str)| LegendEntry {
        mark: MarkShape::Box,
        paint: CATEGORIES[place % CATEGORIES.len()],
        text: plain(name),
    };
    methods.iter().map(method).chain(domains.iter().enumerate().map(domain)).collect()
}

fn plot(
    title: &str,
    rows: &[&MethodMeasurements],
    [across, up]: &[Axis; 2],
    domains: &[&'static str],
    are_labelled: bool,
) -> Plot {
    let mut plot = Plot::new(across.clone(), up.clone());
    plot.title = Some(plain(title));
    (plot.aspect, plot.grid) = (0.42, true);
    let sign = |row: &&MethodMeasurements| {
        let place = domains.iter().position(|domain| *domain == row.domain).unwrap_or(0);
        let label = match row.method {
            DifferentiationMethod::Tape | DifferentiationMethod::MergedTape => {
                format!("{}, {}", row.method.name(), row.domain)
            }
            // The others run in one domain each.
            method => method.name().to_string(),
        };
        let error = row.max_error.filter(|error| *error > 0.0).map_or(f64::NEG_INFINITY, decade);
        MarkedPoint {
            // What is exact stands at the left border.
            at: [error.max(across.from()), row.ns_per_state.max(1e-1).log10()],
            mark: mark(row.method),
            paint: CATEGORIES[place % CATEGORIES.len()],
            label: are_labelled.then_some(label),
            has_rim: false,
        }
    };
    plot.marks = rows.iter().map(sign).collect();
    plot
}

/// Axes to whole decades, with room for labels next to the outermost points.
fn axes<'r>(rows: impl Iterator<Item = &'r MethodMeasurements>) -> [Axis; 2] {
    let (mut errors, mut times) = ((-16.0f64, -10.0f64), (1.0f64, 2.0f64));
    for row in rows {
        let error = decade(row.max_error.filter(|error| *error > 0.0).unwrap_or(1e-16));
        errors = (errors.0.min(error.floor()), errors.1.max(error.ceil()));
        let time = row.ns_per_state.max(1e-1).log10();
        times = (times.0.min((time - 0.1).floor()), times.1.max((time + 0.1).ceil()));
    }
    let room = (0.21 * (errors.1 - errors.0)).ceil().max(3.0);
    let ends = [errors.0 - 3.0, errors.1 + room];
    let every = ((ends[1] - ends[0]) / 16.0).ceil().max(1.0) as i64;
    // Beyond 1 there is room for labels only.
    let decades = (ends[0] as i64..=ends[1].min(0.0) as i64).filter(|e| e % every == 0);
    let decades = decades.map(|e| (e as f64, power_of_ten(e))).collect();
    let units = (times.0 as i64..=times.1 as i64).map(|e| (e as f64, time(e))).collect();
    [
        Axis::with_ticks(plain("largest error / scale"), ends, decades),
        Axis::with_ticks(plain("time a state"), [times.0, times.1], units),
    ]
}

fn decade(error: f64) -> f64 {
    error.log10().max(LEAST_ERROR)
}

/// Formats a power of ten nanoseconds: 10 ns, 1 µs.
fn time(exponent: i64) -> String {
    let (unit, least) = match exponent {
        ..3 => ("ns", 0),
        3..6 => ("µs", 3),
        6..9 => ("ms", 6),
        _ => ("s", 9),
    };
    let number = 10f64.powi((exponent - least) as i32);
    format!("{number} {unit}")
}

fn mark(method: DifferentiationMethod) -> MarkShape {
    match method {
        DifferentiationMethod::Tape | DifferentiationMethod::Floor => MarkShape::Disc,
        DifferentiationMethod::MergedTape => MarkShape::Bar,
        DifferentiationMethod::NumDualByHand => MarkShape::Diamond,
        DifferentiationMethod::NumDualClosedForm => MarkShape::Needle,
        DifferentiationMethod::ComplexStep => MarkShape::Up,
        DifferentiationMethod::CentralDifference => MarkShape::Down,
    }
}
