//! Rates of components: `"x[i]'" = "x[i]*(x[i+1] − x[i−1])"` is a family of rates, one for each i.

use std::ops::Range;

use super::error::{Mistake, Problem};
use super::formulas::inside;
use super::section::SpannedStr;
use crate::formula::{Formula, Type, canonical_name};
use crate::mechanics::{Dependence, Variable, Vocabulary};

/// Key of `[field]`: the variable and the components whose rates it gives.
pub struct Key {
    /// Name of the variable, without its prime.
    pub name: String,
    indices: Vec<KeyIndex>,
}

/// Index of a key.
#[derive(Clone)]
enum KeyIndex {
    /// A single component, counted from 0.
    One(usize),
    /// A range of components, under a name.
    Each(String, Range<usize>),
}

/// Rate of some components.
struct ComponentRate {
    key: Range<usize>,
    text: SpannedStr,
    indices: Vec<KeyIndex>,
}

/// Rates of one variable, as they are given.
#[derive(Default)]
pub struct Rates {
    whole: Option<(Range<usize>, SpannedStr)>,
    pieces: Vec<ComponentRate>,
}

/// Reason why a key cannot be read.
pub enum Unreadable {
    /// The key does not name a variable.
    Unknown(String),
    /// The indices of the key are wrong.
    Message(String, &'static str),
}

fn wrong(message: String, remedy: &'static str) -> Unreadable {
    Unreadable::Message(message, remedy)
}

const FORM: &str =
    "write \"x[i]'\" for all components, \"x[1]'\" for one, or \"x[i]', i = 2..n−1\"";

impl Key {
    /// Reads `x'`, `x[1]'`, `x[i]'`, `q[i,j]'` or `x[i]', i = 2..n-1`.
    pub fn read(
        text: &str,
        variables: &[Variable],
        names: &Vocabulary,
    ) -> Result<(usize, Self), Unreadable> {
        let (head, ranges) = match text.split_once(']') {
            Some((head, rest)) => (head, rest),
            None => (text, ""),
        };
        let (base, inside) = match head.split_once('[') {
            Some((base, inside)) => (base, Some(inside)),
            None => (head, None),
        };
        let canonical = canonical_name(base.trim()).unwrap_or_else(|| base.to_string());
        let find = |name: &str| variables.iter().position(|variable| variable.name == name);
        // x' may be the velocity of x: then its rate is x''.
        let plain = canonical.strip_suffix('\'').unwrap_or(&canonical);
        let ranges = ranges.trim_start();
        let primed = ranges.strip_prefix(['\'', '′', '’']);
        let name = if primed.is_some() { canonical.as_str() } else { plain };
        let index = find(name).ok_or_else(|| Unreadable::Unknown(name.to_string()))?;
        let Some(inside) = inside else {
            return Ok((index, Self { name: name.to_string(), indices: Vec::new() }));
        };
        let ranges = ranges_of(primed.unwrap_or(ranges).trim_start(), names)?;
        let sizes = match variables[index].kind {
            Type::Scalar => {
                let remedy = match inside.contains('n') {
                    true => {
                        "write x = \"…\" in [map] for the image of x, or \"x'\" = \"…\" in [field] for its rate"
                    }
                    false => FORM,
                };
                return Err(wrong(format!("`{name}` has no components"), remedy));
            }
            Type::Vector(length) => vec![length],
            Type::Matrix(rows, columns) => vec![rows, columns],
        };
        let written: Vec<&str> = inside.split(',').map(str::trim).collect();
        if written.len() > sizes.len() {
            return Err(wrong(format!("`{name}` has fewer indices than that"), FORM));
        }
        let indices = written.iter().zip(sizes).map(|(text, size)| {
            let bound = |low: i64, high: i64| {
                // a range may be empty, as 2..n−1 for n = 2
                let within = 1 <= low && low <= high + 1 && high <= size as i64;
                within.then(|| (low - 1) as usize..high as usize).ok_or_else(|| {
                    let message = format!("the indices of `{name}` go from 1 to {size} there");
                    wrong(message, FORM)
                })
            };
            match (Formula::whole_number(text, names), canonical_name(text)) {
                (Ok(number), _) => Ok(KeyIndex::One(bound(number, number)?.start)),
                (Err(_), Some(index)) => {
                    let own = ranges.iter().find(|(known, _, _)| *known == index);
                    let range = own.map_or(Ok(0..size), |(_, low, high)| bound(*low, *high))?;
                    Ok(KeyIndex::Each(index, range))
                }
                _ => Err(wrong(format!("`{text}` is not an index"), FORM)),
            }
        });
        let indices = indices.collect::<Result<Vec<KeyIndex>, Unreadable>>()?;
        Ok((index, Self { name: name.to_string(), indices }))
    }
}

/// Reads the ranges of indices, `, i = 2..n-1, j = 1..2`.
fn ranges_of(text: &str, names: &Vocabulary) -> Result<Vec<(String, i64, i64)>, Unreadable> {
    let Some(list) = text.strip_prefix(',') else {
        return match text.is_empty() {
            true => Ok(Vec::new()),
            false => Err(wrong(format!("`{text}` has no meaning after the name"), FORM)),
        };
    };
    let range = |part: &str| {
        let (name, range) = part.split_once('=')?;
        let (low, high) = range.split_once("..")?;
        let end = |text: &str| Formula::whole_number(text, names).ok();
        Some((canonical_name(name.trim())?, end(low)?, end(high)?))
    };
    let read = |part: &str| {
        range(part)
            .ok_or_else(|| wrong(format!("`{}` is not a range of indices", part.trim()), FORM))
    };
    list.split(',').map(read).collect()
}

impl Rates {
    /// Adds the rate given by one key; `false` if it was given before.
    pub fn add(&mut self, key: Key, place: Range<usize>, text: SpannedStr) -> bool {
        if key.indices.is_empty() {
            let is_new = self.whole.is_none() && self.pieces.is_empty();
            self.whole.get_or_insert((place, text));
            return is_new;
        }
        self.pieces.push(ComponentRate { key: place, text, indices: key.indices });
        self.whole.is_none()
    }

    /// Whether no rate is given.
    pub fn is_empty(&self) -> bool {
        self.whole.is_none() && self.pieces.is_empty()
    }

    /// Place of the first key.
    pub fn place(&self) -> Option<Range<usize>> {
        let whole = self.whole.iter().map(|(place, _)| place.clone());
        whole.chain(self.pieces.iter().map(|piece| piece.key.clone())).next()
    }

    /// Formulas whose components, concatenated, are the rate of the variable.
    pub fn formulas(
        &self,
        variable: &Variable,
        names: &Vocabulary,
        reach: Dependence,
    ) -> Result<Vec<Formula>, Mistake> {
        let what = format!("the rate of {}", variable.name);
        if let Some((_, text)) = &self.whole {
            return Ok(vec![inside(text, ("", ""), names, &what, Some(variable.kind), reach)?]);
        }
        if let [piece] = &self.pieces[..]
            && let Some((before, after)) = piece.whole_of(variable.kind)
        {
            let ends = (before.as_str(), after);
            let read = inside(&piece.text, ends, names, &what, Some(variable.kind), reach);
            let read = read.map_err(|mistake| at_the_ends(mistake, variable));
            return Ok(vec![read?]);
        }
        self.by_components(variable, names, &what, reach)
    }

    /// One formula for each component, or row.
    fn by_components(
        &self,
        variable: &Variable,
        names: &Vocabulary,
        what: &str,
        reach: Dependence,
    ) -> Result<Vec<Formula>, Mistake> {
        let count = self.pieces.first().map_or(1, |piece| piece.indices.len());
        if let Some(other) = self.pieces.iter().find(|piece| piece.indices.len() != count) {
            let message = format!("`{}` is given by rows and by entries", variable.name);
            let remedy = "give all its rates by rows, or all by entries".to_string();
            return Err(Mistake::at(other.key.clone(), Problem::Other { message, remedy }));
        }
        let (kind, cells) = match (variable.kind, count) {
            (Type::Matrix(rows, columns), 1) => (Type::Vector(columns), vec![rows]),
            (Type::Matrix(rows, columns), _) => (Type::Scalar, vec![rows, columns]),
            (other, _) => (Type::Scalar, vec![other.size()]),
        };
        let width = cells.get(1).copied().unwrap_or(1);
        let place = |cell: usize| match cells.len() {
            1 => vec![cell],
            _ => vec![cell / width, cell % width],
        };
        let mut formulas = Vec::new();
        for cell in 0..cells.iter().product() {
            let place = place(cell);
            let piece = self.piece_of(variable, &place)?;
            let (before, after) = piece.at(&place);
            let ends = (before.as_str(), after.as_str());
            let read = inside(&piece.text, ends, names, what, Some(kind), reach);
            formulas.push(read.map_err(|mistake| at_the_ends(mistake, variable))?);
        }
        Ok(formulas)
    }

    /// Piece that gives the rate of a component: the piece for it alone, or else its family.
    fn piece_of(&self, variable: &Variable, place: &[usize]) -> Result<&ComponentRate, Mistake> {
        let mut best: Option<&ComponentRate> = None;
        for piece in self.pieces.iter().filter(|piece| piece.holds(place)) {
            match best {
                Some(known) if known.free() == piece.free() => {
                    let component = component(variable, place);
                    let reason = format!("the rate of `{component}` is given twice");
                    let problem = Problem::BadName { name: component, reason };
                    return Err(Mistake::at(piece.key.clone(), problem));
                }
                Some(known) if known.free() < piece.free() => {}
                _ => best = Some(piece),
            }
        }
        best.ok_or_else(|| {
            let component = component(variable, place);
            let message = format!("[field] has no rate for `{component}`");
            let remedy = format!("add \"{component}'\" = \"…\"");
            let key = self.pieces.first().map_or(0..0, |piece| piece.key.clone());
            Mistake::at(key, Problem::Other { message, remedy })
        })
    }
}

/// Explains the mistake of a family that reaches beyond the ends of a chain.
fn at_the_ends(mistake: Mistake, variable: &Variable) -> Mistake {
    match &mistake.problem {
        Problem::Formula(error) if error.is_out_of_range() => {
            let (name, count) = (
                &variable.name,
                match variable.kind {
                    Type::Matrix(rows, _) => rows,
                    other => other.size(),
                },
            );
            let remedy = format!(
                "give \"{name}[1]'\" and \"{name}[{count}]'\" by themselves, or count around: \
                 {name}[i+1 mod {count}]"
            );
            let message = error.message().to_string();
            Mistake::new(mistake.span, Problem::Other { message, remedy })
        }
        _ => mistake,
    }
}

fn component(variable: &Variable, place: &[usize]) -> String {
    let indices: Vec<String> = place.iter().map(|index| (index + 1).to_string()).collect();
    format!("{}[{}]", variable.name, indices.join(","))
}

impl ComponentRate {
    /// Number of indices that have a name.
    fn free(&self) -> usize {
        self.indices.iter().filter(|index| matches!(index, KeyIndex::Each(..))).count()
    }

    fn holds(&self, place: &[usize]) -> bool {
        self.indices.iter().zip(place).all(|(index, at)| match index {
            KeyIndex::One(only) => only == at,
            KeyIndex::Each(_, range) => range.contains(at),
        })
    }

    /// Text around the formula of a family that covers a whole variable, to make one formula of it.
    fn whole_of(&self, kind: Type) -> Option<(String, &'static str)> {
        let covers = |index: &KeyIndex, size: usize| match index {
            KeyIndex::Each(name, range) if *range == (0..size) => {
                Some(format!("{name}, 1..{size}, "))
            }
            _ => None,
        };
        let (form, sizes) = match kind {
            Type::Scalar => return None,
            Type::Vector(length) => ("vector", vec![length]),
            Type::Matrix(rows, columns) => ("matrix", vec![rows, columns]),
        };
        let heads = self.indices.iter().zip(sizes).map(|(index, size)| covers(index, size));
        let heads = heads.collect::<Option<Vec<String>>>()?;
        Some((format!("{form}({}", heads.concat()), ")"))
    }

    /// Text around the formula of one component, a sum of one term.
    fn at(&self, place: &[usize]) -> (String, String) {
        let pairs = self.indices.iter().zip(place);
        let heads: Vec<String> = pairs
            .filter_map(|(index, at)| match index {
                KeyIndex::One(_) => None,
                KeyIndex::Each(name, _) => Some(format!("sum({name}, {0}..{0}, ", at + 1)),
            })
            .collect();
        (heads.concat(), ")".repeat(heads.len()))
    }
}
