//! Columns of data along a motion: its time, and formulas at its states.

use crate::error::FlowError;
use crate::motion::lexicon::{FormulaMistake, Lexicon, listed};
use crate::motion::recorded::point;
use liouville::case::Case;
use liouville::formula::{Formula, Type};
use liouville::graph::{Evaluator, Tape, record};
use liouville::mechanics::{Model, Phase, TIME};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Name of the number of iterates of a map.
const ITERATE: &str = "n";

/// Columns requested: scalars are one column, vectors and matrices one for each component.
pub struct Columns {
    lexicon: Lexicon,
    titles: Vec<String>,
    sources: Vec<ColumnSource>,
}

#[derive(Clone, Debug)]
enum ColumnSource {
    Time,
    Formula(Formula),
}

impl Columns {
    /// Reads a list of columns such as `t, ω, |γ|²`.
    pub fn read(lexicon: Lexicon, text: &str) -> Result<Self, FormulaMistake> {
        let (mut titles, mut sources) = (Vec::new(), Vec::new());
        for (place, part) in listed(text) {
            if part.is_empty() {
                let message = "a column is empty".to_string();
                return Err(FormulaMistake::new(message, place, "write a formula between commas"));
            }
            let clock = clock(&lexicon);
            if part == clock && !lexicon.knows(clock) {
                titles.push(clock.to_string());
                sources.push(ColumnSource::Time);
                continue;
            }
            let formula = lexicon.formula(part, place.start)?;
            titles.extend(titled(part, &formula));
            sources.push(ColumnSource::Formula(formula));
        }
        Ok(Self { lexicon, titles, sources })
    }

    /// The same columns for a case that differs in values of parameters alone.
    pub(crate) fn of(&self, case: &Case) -> Self {
        let (titles, sources) = (self.titles.clone(), self.sources.clone());
        Self { lexicon: Lexicon::new(case), titles, sources }
    }

    /// Time, or the number of iterates, and all components of the state.
    pub fn whole_state(lexicon: Lexicon) -> Result<Self, FormulaMistake> {
        let names = lexicon.model().state.iter().map(|variable| variable.name.as_str());
        let clock = clock(&lexicon);
        let time = (!lexicon.knows(clock)).then_some(clock);
        let text = time.into_iter().chain(names).collect::<Vec<_>>().join(", ");
        Self::read(lexicon, &text)
    }

    /// Titles, one for each column.
    pub fn titles(&self) -> &[String] {
        &self.titles
    }

    /// Whether some column varies along motions.
    pub fn varies(&self) -> bool {
        self.sources.iter().any(|source| match source {
            ColumnSource::Time => true,
            ColumnSource::Formula(formula) => self.lexicon.varies(formula),
        })
    }

    pub(crate) fn model(&self) -> &Model {
        self.lexicon.model()
    }

    /// Values of the formulas at a point, none where something written in one has none; the time is
    /// left out.
    pub(crate) fn values<T: Scalar>(&self, phase: &Phase<'_, T>) -> Vec<T> {
        let value = |source: &ColumnSource| match source {
            ColumnSource::Time => Vec::new(),
            ColumnSource::Formula(formula) => phase.evaluate_literally(formula).components(),
        };
        self.sources.iter().flat_map(value).collect()
    }

    /// Records the columns with these values of the free parameters.
    pub(crate) fn recorded(&self, parameters: &[Rational]) -> Result<Gauge, FlowError> {
        let model = self.lexicon.model();
        let (graph, values) =
            record(model.dimension(), |state| self.values(&point(model, parameters, state)))?;
        let count = |source: &ColumnSource| match source {
            ColumnSource::Time => None,
            ColumnSource::Formula(formula) => Some(formula.value_type().size()),
        };
        let counts = self.sources.iter().map(count).collect();
        Ok(Gauge { counts, tape: Tape::new(&graph, &values) })
    }
}

/// Name of the time, or of the number of iterates of a map.
fn clock(lexicon: &Lexicon) -> &'static str {
    if lexicon.model().system.is_map() { ITERATE } else { TIME }
}

/// Titles of the columns of a formula.
fn titled(text: &str, formula: &Formula) -> Vec<String> {
    let kind = formula.value_type();
    let is_name =
        text.chars().all(|letter| letter.is_alphanumeric() || matches!(letter, '_' | '\''));
    let title = |place: usize| match (kind, is_name) {
        (Type::Scalar, _) => text.to_string(),
        (_, true) => kind.component(text, place),
        (Type::Vector(_), false) => format!("({text})[{}]", place + 1),
        (Type::Matrix(..), false) => kind.component(&format!("({text})"), place),
    };
    (0..kind.size()).map(title).collect()
}

/// Columns as a tape.
pub(crate) struct Gauge {
    tape: Tape,
    /// Number of values of each source; `None` for the time.
    counts: Vec<Option<usize>>,
}

impl Gauge {
    /// Returns a function from times and states to rows.
    pub fn rows(&self) -> impl FnMut(DoubleDouble, &[DoubleDouble]) -> Vec<DoubleDouble> {
        let mut evaluator = Evaluator::new(&self.tape, DoubleDoubles);
        move |time, state| {
            evaluator.run(state);
            let mut values = evaluator.outputs().copied();
            let mut row = Vec::with_capacity(self.counts.len());
            for count in &self.counts {
                match count {
                    None => row.push(time),
                    Some(count) => row.extend(values.by_ref().take(*count)),
                }
            }
            row
        }
    }
}
