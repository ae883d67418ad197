//! Equations, of which those between vectors or matrices are one for each entry.

use super::error::{Mistake, Problem};
use super::formulas::formula;
use super::section::{CaseTable, SpannedStr};
use crate::formula::{Formula, FormulaError, Scope, Symbol, SymbolOrigin, Type, Value, excerpt};
use crate::graph::{Expr, record};
use crate::mechanics::{
    Dependence, ENTRY, LevelEquation, LevelFunction, RootEquation, Vocabulary, VocabularyEntry,
    components,
};
use crate::proof::{Group, Prover};

/// Reads `equations = ["(γ,γ) = 1", …]`; `None` if one is wrong.
pub fn level_equations(
    section: &CaseTable<'_>,
    vocabulary: &Vocabulary,
) -> Option<Vec<LevelEquation>> {
    let read = equations_in(section, "equations", vocabulary, Dependence::Phase)?.into_iter();
    let equation = |(text, function): (String, Formula)| {
        let sides = both_sides(&text, vocabulary);
        level_equation(text, function, sides)
    };
    Some(read.map(equation).collect())
}

/// Reads the two sides of an equation, each as a formula.
pub fn both_sides(text: &str, vocabulary: &Vocabulary) -> Option<(Formula, Formula)> {
    let (left, right, _) = sides(text)?;
    let read = |side| Formula::parse(side, vocabulary).ok();
    Some((read(left)?, read(right)?))
}

/// Builds an equation of the level from its sides, of which one may be a root.
pub fn level_equation(
    text: String,
    function: Formula,
    sides: Option<(Formula, Formula)>,
) -> LevelEquation {
    let root = sides.and_then(|(left, right)| {
        let ((radicand, is_modulus), other_side) = match (left.radicand(), right.radicand()) {
            (Some(root), _) => (root, right),
            (None, Some(root)) => (root, left),
            (None, None) => return None,
        };
        Some(RootEquation { radicand, is_modulus, other_side })
    });
    LevelEquation { text, function: LevelFunction::Formula(function), root, lacks_entries: false }
}

/// Reads a list of equations as texts and differences of both sides, which may depend on no more
/// than `reach`; `None` if one is wrong.
pub fn equations_in(
    section: &CaseTable<'_>,
    key: &'static str,
    vocabulary: &Vocabulary,
    reach: Dependence,
) -> Option<Vec<(String, Formula)>> {
    let texts = section.keep(section.texts(key))?;
    let read: Vec<Option<Vec<(String, Formula)>>> =
        texts.iter().map(|text| section.keep(equation(text, key, vocabulary, reach))).collect();
    Some(read.into_iter().collect::<Option<Vec<_>>>()?.concat())
}

/// Returns the equations of a rotation matrix, as of one that is named by its entries: QᵀQ = E and det Q = 1.
pub fn of_rotation(name: &str, vocabulary: &Vocabulary) -> Result<Vec<(String, Formula)>, Mistake> {
    let wrong = |error| Mistake::new(None, Problem::Formula(error));
    let product = format!("{name}ᵀ*{name} − [[1, 0, 0], [0, 1, 0], [0, 0, 1]]");
    let product = Formula::parse(&product, vocabulary).map_err(wrong)?;
    let half = Formula::parse(&format!("det({name}) − 1"), vocabulary).map_err(wrong)?;
    let mut all = entries(&format!("{name}ᵀ*{name} = E"), product, vocabulary).map_err(wrong)?;
    all.push((format!("det({name}) = 1"), half));
    Ok(all)
}

/// Writes the rate of an equation: `(q,q)' = 0` for `(q,q) = l²`.
pub fn rate_text(text: &str, vocabulary: &Vocabulary) -> String {
    let (equation, entry) = match text.split_once(ENTRY) {
        Some((equation, entry)) => (equation, format!("{ENTRY}{entry}")),
        None => (text, String::new()),
    };
    let rate = |side: &Formula| match vocabulary.reach(side) {
        Some(entry) if entry.reach > Dependence::Parameters => match side.text().trim() {
            side if is_whole(side) => format!("{side}'"),
            side => format!("({side})'"),
        },
        _ => "0".to_string(),
    };
    match both_sides(equation, vocabulary) {
        Some((left, right)) => format!("{} = {}{entry}", rate(&left), rate(&right)),
        None => format!("rate of {text}"),
    }
}

/// Whether a text is a name, or stands in brackets.
fn is_whole(text: &str) -> bool {
    let mut depth = 0;
    let closes = |letter: char| {
        depth += match letter {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        depth == 0
    };
    let first = text.chars().map(closes).position(|closes| closes);
    text.chars().all(char::is_alphanumeric)
        || (text.starts_with('(') && first == Some(text.chars().count() - 1))
}

/// Counts the equations that each text stands for; `None` for one that cannot be read.
pub fn numbers(texts: &[SpannedStr], vocabulary: &Vocabulary) -> Vec<Option<usize>> {
    let own = |text: &SpannedStr| {
        let (left, right) = both_sides(&text.value, vocabulary)?;
        let is_zero = right.constant().is_some_and(|value| value.is_zero());
        let function = if is_zero { left } else { (left.bracketed() - right.bracketed()).ok()? };
        Some(entries("", function, vocabulary).ok()?.len())
    };
    texts.iter().map(own).collect()
}

/// Both sides of an equation, with the place where the right one begins.
pub fn sides(text: &str) -> Option<(&str, &str, usize)> {
    let mut depth = 0;
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            // inside brackets it is a condition on indices
            '=' if depth == 0 => return Some((&text[..place], &text[place + 1..], place + 1)),
            _ => {}
        }
    }
    None
}

fn equation(
    text: &SpannedStr,
    key: &str,
    vocabulary: &Vocabulary,
    reach: Dependence,
) -> Result<Vec<(String, Formula)>, Mistake> {
    let Some((left, right, second)) = sides(&text.value) else {
        let message = format!("each of `{key}` has two sides");
        let remedy = match key {
            "constraints" => format!("write \"{} = 0\"", excerpt(text.value.trim())),
            _ => format!("write \"{} = 1\", or another value", excerpt(text.value.trim())),
        };
        return Err(Mistake::at(text.span.clone(), Problem::Other { message, remedy }));
    };
    for (side, start) in [(left, 0), (right, second)] {
        Formula::parse(side, vocabulary).map_err(|error| {
            let inner = error.span();
            let place = text.locate(start + inner.start..start + inner.end);
            Mistake::at(place, Problem::Formula(error))
        })?;
    }
    let difference = match right.trim() {
        "0" => left.trim().to_string(),
        _ => format!("({left}) − ({right})"),
    };
    let difference = SpannedStr::made(difference, text.span.clone());
    let function = formula(&difference, vocabulary, "each side", None, reach)?;
    entries(text.value.trim(), function, vocabulary)
        .map_err(|error| Mistake::at(text.span.clone(), Problem::Formula(error)))
}

/// Largest number of entries among which repetitions are sought, of which there are n² pairs.
const MOST_COMPARED: usize = 96;

/// Splits an equation into those of its entries, each with its text.
///
/// Entries that hold by themselves are left out, and those that say what one before says: six of the
/// nine of `QᵀQ = E` remain. An equation that holds by itself stays, to be refused as any other.
pub fn entries(
    text: &str,
    function: Formula,
    vocabulary: &Vocabulary,
) -> Result<Vec<(String, Formula)>, FormulaError> {
    if function.value_type() == Type::Scalar {
        return Ok(vec![(text.to_string(), function)]);
    }
    let bracketed = function.bracketed();
    let places = function.value_type().places();
    let all: Vec<Formula> =
        places.iter().map(|place| bracketed.component(place)).collect::<Result<_, _>>()?;
    let kept = independent(&function, vocabulary).unwrap_or_else(|| (0..all.len()).collect());
    let word = |place: &[usize]| {
        let indices: Vec<String> = place.iter().map(usize::to_string).collect();
        format!("{text}{ENTRY}{}", indices.join(","))
    };
    Ok(kept.into_iter().map(|k| (word(&places[k]), all[k].clone())).collect())
}

/// Lists the components that are not 0, and neither equal nor opposite to one before, as functions of
/// independent names; `None` if nothing is proved.
fn independent(function: &Formula, vocabulary: &Vocabulary) -> Option<Vec<usize>> {
    let count = components(function.value_type());
    fresh(count, vocabulary, &|inputs| valued(function, vocabulary, inputs).components())
}

/// Lists the scalars that are not 0, and neither equal nor opposite to one before, in the same way.
pub fn fresh_scalars(functions: &[Formula], vocabulary: &Vocabulary) -> Option<Vec<usize>> {
    fresh(functions.len(), vocabulary, &|inputs| {
        functions.iter().flat_map(|own| valued(own, vocabulary, inputs).components()).collect()
    })
}

fn fresh(
    count: usize,
    vocabulary: &Vocabulary,
    values: &dyn Fn(&[Expr]) -> Vec<Expr>,
) -> Option<Vec<usize>> {
    if count > MOST_COMPARED {
        return None;
    }
    let pairs: Vec<(usize, usize)> = (0..count).flat_map(|i| (0..i).map(move |j| (i, j))).collect();
    let size = |(_, entry): (Symbol, &VocabularyEntry)| components(entry.kind);
    let inputs = vocabulary.iter().map(size).sum();
    let (graph, groups) = record(inputs, |inputs| {
        let entries = values(inputs);
        let both = |(i, j): &(usize, usize)| [entries[*i] - entries[*j], entries[*i] + entries[*j]];
        entries.iter().copied().chain(pairs.iter().flat_map(both)).collect::<Vec<Expr>>()
    })
    .ok()?;
    let groups: Vec<Group> = groups.into_iter().map(|value| Group::of(vec![value])).collect();
    let prover = Prover { sources: &[], extents: &[], seed: 1 };
    let outcomes = prover.prove(&graph, &groups).ok()?;
    let is_zero = |k: usize| outcomes[k].is_zero();
    let repeats = |k: usize| {
        let own = pairs.iter().enumerate().filter(|(_, (i, _))| *i == k);
        own.into_iter().any(|(p, _)| is_zero(count + 2 * p) || is_zero(count + 2 * p + 1))
    };
    let kept: Vec<usize> = (0..count).filter(|k| !is_zero(*k) && !repeats(*k)).collect();
    (!kept.is_empty()).then_some(kept)
}

/// Evaluates a formula with an input for each component of each name but abbreviations.
fn valued(formula: &Formula, vocabulary: &Vocabulary, inputs: &[Expr]) -> Value<Expr> {
    formula.evaluate_literally(&mut |symbol| {
        let entry = vocabulary.entry(symbol);
        if let SymbolOrigin::Defined(definition) = vocabulary.origin(symbol) {
            return valued(definition, vocabulary, inputs);
        }
        let before = vocabulary.iter().take_while(|(other, _)| *other != symbol);
        let first: usize = before.map(|(_, entry)| components(entry.kind)).sum();
        Value::from_components(entry.kind, &inputs[first..first + components(entry.kind)])
    })
}
