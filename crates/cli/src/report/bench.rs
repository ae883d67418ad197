//! Report of `bench`: times and errors, as JSON or as a table for each claim.

use comfy_table::{Cell, CellAlignment, Color, Table, presets};
use serde::Serialize;

use super::FileFailure;
use super::terminal::Style;
use liouville::graph::vector_features;
use liouville::verdict::TAPE_LANES;
use liouville_lab::bench::{
    BenchOptions, ClaimMeasurements, DifferentiationMethod, MethodMeasurements, NATIVE, StateValue,
};

/// Results of a benchmark run.
#[derive(Debug)]
pub struct BenchRun {
    /// Options of the measurements.
    pub options: BenchOptions,
    /// Claims measured, in the order of the items.
    pub measured: Vec<ClaimMeasurements>,
    /// Items that could not be measured.
    pub errors: Vec<(String, FileFailure)>,
}

impl BenchRun {
    /// A run without measurements.
    pub fn new(options: BenchOptions) -> Self {
        Self { options, measured: Vec::new(), errors: Vec::new() }
    }
}

#[derive(Serialize)]
struct BenchJson<'a> {
    seed: u64,
    states: u64,
    rounds: usize,
    machine: MachineFacts,
    items: Vec<ItemEntry<'a>>,
    rows: Vec<RowEntry<'a>>,
    skipped: Vec<SkippedEntry<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    values: Vec<ValueEntry<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    errors: Vec<ErrorEntry<'a>>,
}

/// Machine properties on which the times depend.
#[derive(Serialize)]
struct MachineFacts {
    architecture: &'static str,
    os: &'static str,
    features: &'static [&'static str],
    lanes: usize,
    threads: usize,
}

#[derive(Serialize)]
struct ItemEntry<'a> {
    name: &'a str,
    claim: &'a str,
    kind: &'a str,
    ns_per_state: Option<f64>,
    /// Time of the quickest engine.
    engine_ns_per_state: Option<f64>,
    floor_ns_per_state: Option<f64>,
    /// Time of num-dual by hand, where there is such code.
    num_dual_ns_per_state: Option<f64>,
    /// The same of code compiled for the processor at hand.
    num_dual_native_ns_per_state: Option<f64>,
    /// Time of the quickest engine divided by that of num-dual by hand.
    ratio_to_num_dual: Option<f64>,
    ratio_to_num_dual_native: Option<f64>,
    operations: Option<usize>,
    merged_operations: Option<usize>,
    max_error: Option<f64>,
}

#[derive(Serialize)]
struct RowEntry<'a> {
    item: &'a str,
    claim: &'a str,
    #[serde(flatten)]
    row: &'a MethodMeasurements,
}

#[derive(Serialize)]
struct SkippedEntry<'a> {
    item: &'a str,
    claim: &'a str,
    method: DifferentiationMethod,
    reason: &'a str,
}

#[derive(Serialize)]
struct ValueEntry<'a> {
    item: &'a str,
    claim: &'a str,
    #[serde(flatten)]
    value: &'a StateValue,
}

#[derive(Serialize)]
struct ErrorEntry<'a> {
    path: &'a str,
    #[serde(flatten)]
    failure: &'a FileFailure,
}

/// Renders the run as pretty-printed JSON.
pub fn json(run: &BenchRun) -> Result<String, serde_json::Error> {
    let all = || run.measured.iter();
    let rows = all().flat_map(|measured| {
        let (item, claim) = (measured.item.as_str(), measured.claim.as_str());
        measured.rows.iter().map(move |row| RowEntry { item, claim, row })
    });
    let skipped =
        all().flat_map(|measured| {
            let (item, claim) = (measured.item.as_str(), measured.claim.as_str());
            let entry = move |(method, reason): &(DifferentiationMethod, &'static str)| {
                SkippedEntry { item, claim, method: *method, reason }
            };
            measured.skipped.iter().map(entry)
        });
    let values = all().flat_map(|measured| {
        let (item, claim) = (measured.item.as_str(), measured.claim.as_str());
        measured.values.iter().map(move |value| ValueEntry { item, claim, value })
    });
    let error = |(path, failure)| ErrorEntry { path, failure };
    serde_json::to_string_pretty(&BenchJson {
        seed: run.options.seed,
        states: run.options.blocks * TAPE_LANES as u64,
        rounds: run.options.rounds,
        machine: MachineFacts {
            architecture: std::env::consts::ARCH,
            os: std::env::consts::OS,
            features: vector_features(),
            lanes: TAPE_LANES,
            threads: 1,
        },
        items: all().map(item).collect(),
        rows: rows.collect(),
        skipped: skipped.collect(),
        values: values.collect(),
        errors: run.errors.iter().map(|(path, failure)| error((path, failure))).collect(),
    })
}

fn item(measured: &ClaimMeasurements) -> ItemEntry<'_> {
    let tape = measured.row(DifferentiationMethod::Tape, "f64");
    let merged = measured.row(DifferentiationMethod::MergedTape, "f64");
    let time = |method| measured.row(method, "f64").map(|row| row.ns_per_state);
    ItemEntry {
        name: &measured.item,
        claim: &measured.claim,
        kind: measured.kind,
        ns_per_state: tape.map(|row| row.ns_per_state),
        engine_ns_per_state: measured.quickest().map(|row| row.ns_per_state),
        floor_ns_per_state: time(DifferentiationMethod::Floor),
        num_dual_ns_per_state: time(DifferentiationMethod::NumDualByHand),
        num_dual_native_ns_per_state: measured
            .row(DifferentiationMethod::NumDualByHand, NATIVE)
            .map(|row| row.ns_per_state),
        ratio_to_num_dual: measured.ratio_to_num_dual("f64"),
        ratio_to_num_dual_native: measured.ratio_to_num_dual(NATIVE),
        operations: tape.and_then(|row| row.operations),
        merged_operations: merged.and_then(|row| row.operations),
        max_error: tape.and_then(|row| row.max_error),
    }
}

/// Renders a table for each claim.
pub fn text(run: &BenchRun, style: Style) -> String {
    let mut out = String::new();
    for measured in &run.measured {
        out.push_str(&format!("{}  {} ({})\n", measured.item, measured.claim, measured.kind));
        out.push_str(&table(measured, style));
        out.push('\n');
        let ratios = [("f64", ""), (NATIVE, ", built natively")];
        for (domain, built) in ratios {
            if let Some(ratio) = measured.ratio_to_num_dual(domain) {
                out.push_str(&format!(
                    "   quickest engine / num-dual by hand{built}: {ratio:.4}\n"
                ));
            }
        }
        for (method, reason) in &measured.skipped {
            out.push_str(&format!("   {} skipped: {reason}\n", method.name()));
        }
        out.push('\n');
    }
    if run.measured.is_empty() {
        return out;
    }
    let features = match vector_features() {
        [] => "baseline".to_string(),
        features => features.join(" "),
    };
    out.push_str(&format!(
        "errors: |computed − reference| / scale at {} states, seed {}; times: medians of {} \
         interleaved rounds, one thread, {} {features}\n",
        run.options.blocks * TAPE_LANES as u64,
        run.options.seed,
        run.options.rounds,
        std::env::consts::ARCH,
    ));
    out
}

const HEADER: [&str; 10] = [
    "  ",
    "method",
    "domain",
    "ns/state",
    "×",
    "operations",
    "set-up µs",
    "largest error",
    "median error",
    "largest bound",
];

fn table(measured: &ClaimMeasurements, style: Style) -> String {
    let mut table = Table::new();
    table.load_style(presets::NOTHING).set_width(style.width);
    if style.colour {
        table.enforce_styling();
    } else {
        table.force_no_tty();
    }
    let shade = |cell: Cell| if style.colour { cell.fg(Color::DarkGrey) } else { cell };
    table.set_header(HEADER.map(|title| shade(Cell::new(title))));
    let unit = measured.row(DifferentiationMethod::Tape, "f64").map(|row| row.ns_per_state);
    for row in &measured.rows {
        let ratio = unit.map(|unit| digits(row.ns_per_state / unit)).unwrap_or_default();
        let number = |value: Option<f64>| value.map_or(String::new(), |x| format!("{x:.1e}"));
        table.add_row(vec![
            String::new(),
            row.method.name().to_string(),
            row.domain.to_string(),
            digits(row.ns_per_state),
            ratio,
            row.operations.map_or(String::new(), |count| count.to_string()),
            format!("{:.0}", row.setup_us),
            number(row.max_error),
            number(row.median_error),
            number(row.max_bound),
        ]);
    }
    for column in table.column_iter_mut().skip(3) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt()
}

/// Formats a number to three digits, without an exponent.
fn digits(value: f64) -> String {
    match value {
        _ if value >= 100.0 => format!("{value:.0}"),
        _ if value >= 10.0 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}
