//! Forms of a value of `[parameters]` or `[state]`: a number, a list, a range with a shape, a
//! formula.

use std::cmp::Ordering;

use toml::Spanned;
use toml::de::DeValue;

use super::ends::{RangeEnd, end};
use super::foreign;
use super::section::numbers;
use crate::formula::{Formula, FormulaError, MAX_COMPONENTS, Scope, Type};
use crate::mechanics::{Draw, Range, SamplerSpec};
use crate::number::rational::{Rational, RationalError};

/// Value of `[parameters]` or `[state]`.
pub enum GivenValue {
    /// Fixed components.
    Fixed(Type, Vec<Rational>),
    /// Numbers of a vector, or of the diagonal of a matrix, depending on the use.
    List(Vec<Rational>),
    /// Components drawn anew for every state.
    Drawn(SamplerSpec),
    /// Any other text, to be read as a formula.
    Formula(String),
}

/// Remedy for a value of a list that is not a rational number.
const LISTED: &str = "a list has rational numbers alone: list a factor of another name, as n = \"one of 1, 2\", and \
    write the parameter by it, as \"n*pi/2\" or \"(-1)^n*sqrt(2)\"";

/// Reason why a value cannot be read.
pub enum Refusal {
    /// The value has none of the possible forms.
    Message(String),
    /// The value is written in another form: a message and a remedy.
    Form(String, String),
    /// A size in the value cannot be read; it begins at this byte of the text.
    Size(FormulaError, usize),
    /// The ends of a range are this one number.
    OneValue(Rational),
}

impl Refusal {
    /// Message about a range that contains no number between its ends.
    pub fn empty_range(low: &Rational, high: &Rational) -> String {
        format!("the range {low}..{high} is empty")
    }
}

impl From<String> for Refusal {
    fn from(message: String) -> Self {
        Refusal::Message(message)
    }
}

/// Converts a list to a vector, or to a diagonal matrix.
pub fn list(values: Vec<Rational>, is_diagonal: bool) -> (Type, Vec<Rational>) {
    let count = values.len();
    match is_diagonal {
        false => (Type::Vector(count), values),
        true => (Type::Matrix(count, count), diagonal(values)),
    }
}

/// Reads a value; sizes are whole numbers in the names of `scope`.
pub fn given(value: &Spanned<DeValue<'_>>, scope: &dyn Scope) -> Result<GivenValue, Refusal> {
    match value.get_ref() {
        DeValue::Integer(number) => fixed_scalar(&number.to_string()),
        DeValue::Float(number) => fixed_scalar(&number.to_string()),
        DeValue::Array(array) => {
            if let Some(entries) = numbers(array) {
                let values = read_all(&entries)?;
                if values.is_empty() {
                    return Err("an empty list has no components".to_string())?;
                }
                sized(Type::Vector(values.len()))?;
                return Ok(GivenValue::List(values));
            }
            let rows: Option<Vec<Vec<String>>> = array
                .iter()
                .map(|row| match row.get_ref() {
                    DeValue::Array(row) => numbers(row),
                    _ => None,
                })
                .collect();
            let width = rows.iter().flatten().map(Vec::len).next().unwrap_or(0);
            match rows.filter(|rows| width > 0 && rows.iter().all(|row| row.len() == width)) {
                Some(rows) => {
                    let kind = sized(Type::Matrix(rows.len(), width))?;
                    Ok(GivenValue::Fixed(kind, read_all(&rows.concat())?))
                }
                None => Err("a matrix is a list of rows of equal length".to_string())?,
            }
        }
        DeValue::String(text) => described(text, scope),
        _ => Err("a parameter is a number, a list, a range or a formula".to_string())?,
    }
}

fn sized(kind: Type) -> Result<Type, Refusal> {
    match kind.size() <= MAX_COMPONENTS {
        true => Ok(kind),
        false => Err(format!(
            "a {} is too large: there are at most {MAX_COMPONENTS} components",
            kind.in_full()
        ))?,
    }
}

fn fixed_scalar(text: &str) -> Result<GivenValue, Refusal> {
    Ok(GivenValue::Fixed(Type::Scalar, read_all(&[text.to_string()])?))
}

fn read_all(texts: &[String]) -> Result<Vec<Rational>, String> {
    texts
        .iter()
        .map(|text| text.parse().map_err(|error: RationalError| error.to_string()))
        .collect()
}

fn diagonal(values: Vec<Rational>) -> Vec<Rational> {
    let count = values.len();
    let mut entries = vec![Rational::from(0); count * count];
    for (k, value) in values.into_iter().enumerate() {
        entries[(count + 1) * k] = value;
    }
    entries
}

/// Reads a string: a number, a range with its shape, a list of alternatives, or a formula.
pub fn described(text: &str, scope: &dyn Scope) -> Result<GivenValue, Refusal> {
    let start = text.len() - text.trim_start().len();
    let text = text.trim();
    if let Ok(number) = text.parse::<Rational>() {
        return Ok(GivenValue::Fixed(Type::Scalar, vec![number]));
    }
    if text == "rotation" {
        return Ok(GivenValue::Drawn(SamplerSpec::Rotation));
    }
    if let Some(list) = text.strip_prefix("one of ") {
        let values: Vec<String> = list.split(',').map(|item| item.trim().to_string()).collect();
        let values =
            read_all(&values).map_err(|message| Refusal::Form(message, LISTED.to_string()))?;
        return Ok(GivenValue::Drawn(SamplerSpec::Scalar(Draw::OneOf(values))));
    }
    if let Some((message, remedy)) = foreign::range(text) {
        return Err(Refusal::Form(message, remedy));
    }
    let (shape, inner) = match text.split_once('(') {
        // The bracket of an end, as in `0..2*(1 + pi)`, begins no shape.
        Some((shape, rest)) if text.ends_with(')') && is_shape(shape, rest) => {
            (shape.trim(), &rest[..rest.len() - 1])
        }
        _ => ("", text),
    };
    let parts = arguments(inner);
    // the range stands last; a form with indices has a body there
    let Some((low, high)) = parts.last().and_then(|(_, last)| last.split_once("..")) else {
        return Ok(GivenValue::Formula(text.to_string()));
    };
    let has_bracket = low.contains(['(', '[']) || high.contains(['(', '[']);
    if has_bracket
        && (end(low, RangeEnd::Low, scope).is_none() || end(high, RangeEnd::High, scope).is_none())
    {
        return Ok(GivenValue::Formula(text.to_string()));
    }
    let range = range(low, high, scope)?;
    let inside = start + text.len() - inner.len() - usize::from(inner.len() < text.len());
    let sizes = parts[..parts.len() - 1].iter().map(|(at, size)| {
        let refused = |error| Refusal::Size(error, inside + at);
        Formula::whole_number(size, scope).map_err(refused)
    });
    let sizes = sizes.collect::<Result<Vec<i64>, Refusal>>()?;
    Ok(GivenValue::Drawn(recipe(shape, &sizes, range)?))
}

/// Splits a text at commas outside of brackets; also returns the places where the parts begin.
fn arguments(text: &str) -> Vec<(usize, &str)> {
    let (mut depth, mut start) = (0i32, 0);
    let mut parts = Vec::new();
    for (place, letter) in text.char_indices() {
        match letter {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            ',' if depth == 0 => {
                parts.push((start, &text[start..place]));
                start = place + 1;
            }
            _ => {}
        }
    }
    parts.push((start, &text[start..]));
    parts
}

fn recipe(shape: &str, sizes: &[i64], range: Range) -> Result<SamplerSpec, Refusal> {
    let size = |size: &i64| {
        usize::try_from(*size)
            .ok()
            .filter(|size| *size > 0)
            .ok_or_else(|| format!("a size is positive, this is {size}"))
    };
    let sizes = sizes.iter().map(size).collect::<Result<Vec<usize>, String>>()?;
    let draw = Draw::Within(range.clone());
    let square = |most: usize| match sizes[..] {
        [] => Ok(3),
        [rows] if most == 1 => Ok(rows),
        [rows, columns] if rows == columns => Ok(rows),
        _ => Err(format!("`{shape}` has one size: {shape}(4, a..b)")),
    };
    let recipe = match shape {
        "" if sizes.is_empty() => SamplerSpec::Scalar(draw),
        "vector" => match sizes[..] {
            [] => SamplerSpec::Vector(3, draw),
            [length] => SamplerSpec::Vector(length, draw),
            _ => Err("a vector has one size: vector(4, a..b)".to_string())?,
        },
        "matrix" => match sizes[..] {
            [] => SamplerSpec::Matrix(3, 3, draw),
            [rows, columns] => SamplerSpec::Matrix(rows, columns, draw),
            _ => Err("a matrix has two sizes: matrix(4, 4, a..b)".to_string())?,
        },
        "diag" => SamplerSpec::Diagonal(square(1)?, draw),
        "spherical" => SamplerSpec::Spherical(square(1)?, draw),
        "symmetric" => SamplerSpec::Symmetric(square(1)?, draw),
        "skew" => SamplerSpec::Skew(square(1)?, draw),
        "inertia" if sizes.is_empty() => SamplerSpec::Inertia(range),
        "axisymmetric" if sizes.is_empty() => SamplerSpec::AxisymmetricInertia(range),
        "full" if sizes.is_empty() => SamplerSpec::FullInertia(range),
        "inertia" | "axisymmetric" | "full" => {
            Err(format!("`{shape}` is a tensor of ℝ³ and has no size: {shape}(a..b)"))?
        }
        other => Err(format!("`{other}(a..b)` is not a kind of parameter"))?,
    };
    sized(recipe.kind())?;
    Ok(recipe)
}

/// Whether the bracket that ends a text is that of a shape, not of an end as in `sqrt(2)..sqrt(3)`.
fn is_shape(shape: &str, rest: &str) -> bool {
    let mut depth = 1;
    let inner = &rest[..rest.len() - 1];
    let is_open = inner.chars().all(|letter| {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        depth > 0
    });
    is_open && !shape.contains("..")
}

fn range(low: &str, high: &str, scope: &dyn Scope) -> Result<Range, Refusal> {
    let read = |text: &str, side| {
        let message = || {
            let text = text.trim();
            match text.contains('°') {
                true => {
                    format!("`{text}` is in degrees, and angles are in radians: write pi/2 for 90°")
                }
                false => format!("`{text}` is not a number: write 12, -0.5, 1e-3, 3/7 or 2*pi"),
            }
        };
        // A number with too many digits has a message of its own.
        match text.parse::<Rational>() {
            Err(error @ RationalError::TooLong) => Err(error.to_string()),
            _ => end(text, side, scope).ok_or_else(message),
        }
    };
    let range = Range { low: read(low, RangeEnd::Low)?, high: read(high, RangeEnd::High)? };
    let (width, _) = (&range.high - &range.low).to_f64();
    match range.low.cmp(&range.high) {
        Ordering::Equal => Err(Refusal::OneValue(range.low)),
        Ordering::Greater => {
            let remedy = format!("the lower end comes first: {}..{}", range.high, range.low);
            Err(Refusal::Form(Refusal::empty_range(&range.low, &range.high), remedy))
        }
        Ordering::Less if width.is_normal() => Ok(range),
        Ordering::Less => Err("this range is beyond the range of f64".to_string())?,
    }
}

/// Type and ranges of a state variable, one range for each component.
pub fn state_draws(given: &GivenValue) -> Option<(Type, Vec<Draw>)> {
    match given {
        GivenValue::Drawn(
            recipe @ (SamplerSpec::Scalar(_) | SamplerSpec::Vector(..) | SamplerSpec::Matrix(..)),
        ) => Some((recipe.kind(), recipe.draws())),
        _ => None,
    }
}
