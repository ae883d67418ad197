//! TOML tables with the places of their entries, so that every mistake can point to one.

use std::cell::RefCell;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::error::{Mistake, Problem};
use super::mistakes::Mistakes;
use super::synonyms::meant;
use crate::formula::{excerpt, nearest};
use crate::order::StableOrder;

/// A string of the file with its place.
#[derive(Clone, Debug)]
pub struct SpannedStr {
    /// Content of the string.
    pub value: String,
    /// Byte range of the value, quotes included.
    pub span: Range<usize>,
    /// Start of the content, if it stands in the file without escapes.
    content: Option<usize>,
}

impl SpannedStr {
    fn new(value: &str, span: Range<usize>, source: &str) -> Self {
        let raw = source.get(span.clone()).unwrap_or_default();
        let content = raw.find(value).map(|offset| span.start + offset);
        Self { value: value.to_string(), span, content }
    }

    /// A string that does not stand in the file, to be reported at `span`.
    pub fn made(value: String, span: Range<usize>) -> Self {
        Self { value, span, content: None }
    }

    /// Place in the file of a range of the content; the whole value where it is written with
    /// escapes.
    pub fn locate(&self, inner: Range<usize>) -> Range<usize> {
        match self.content {
            Some(start) => start + inner.start..start + inner.end,
            None => self.span.clone(),
        }
    }
}

/// A table whose keys are ticked off as they are read.
pub struct CaseTable<'a> {
    name: String,
    table: &'a DeTable<'a>,
    source: &'a str,
    mistakes: &'a Mistakes,
    /// Place of the table.
    pub span: Range<usize>,
    asked: RefCell<Vec<&'static str>>,
}

impl<'a> CaseTable<'a> {
    /// A table under the name that messages give it.
    pub fn new(
        name: &str,
        table: &'a DeTable<'a>,
        span: Range<usize>,
        source: &'a str,
        mistakes: &'a Mistakes,
    ) -> Self {
        Self { name: name.to_string(), table, source, mistakes, span, asked: RefCell::default() }
    }

    /// Collection in which the mistakes of the file are noted.
    pub fn mistakes(&self) -> &'a Mistakes {
        self.mistakes
    }

    /// Returns the value read, or `None` after noting the mistake.
    pub fn keep<T>(&self, result: Result<T, Mistake>) -> Option<T> {
        self.mistakes.keep(result)
    }

    /// Stand-in for a table that the file leaves out, where all its keys have defaults.
    pub fn empty<'b>(&self, name: &str, nothing: &'b DeTable<'b>) -> CaseTable<'b>
    where
        'a: 'b,
    {
        CaseTable::new(name, nothing, 0..0, self.source, self.mistakes)
    }

    /// Value of a key.
    pub fn value(&self, key: &'static str) -> Option<&'a Spanned<DeValue<'a>>> {
        let mut asked = self.asked.borrow_mut();
        if !asked.contains(&key) {
            asked.push(key);
        }
        self.table.get(key)
    }

    /// Whether this key is present; does not tick it off.
    pub fn has(&self, key: &str) -> bool {
        self.table.contains_key(key)
    }

    /// String of a key.
    pub fn text(&self, key: &'static str) -> Result<Option<SpannedStr>, Mistake> {
        self.value(key).map(|value| self.as_text(key, value)).transpose()
    }

    /// String of a required key.
    pub fn required(&self, key: &'static str, remedy: &str) -> Result<SpannedStr, Mistake> {
        self.text(key)?.ok_or_else(|| self.missing(key, remedy))
    }

    /// The mistake of a missing key.
    pub fn missing(&self, key: &'static str, remedy: &str) -> Mistake {
        let (section, remedy) = (self.name.clone(), remedy.to_string());
        self.complaint(Problem::MissingKey { key, section, remedy })
    }

    /// Whether the table has this name.
    pub fn is(&self, name: &str) -> bool {
        self.name.trim_matches(['[', ']']) == name
    }

    /// A mistake of the table as a whole.
    pub fn complaint(&self, problem: Problem) -> Mistake {
        Mistake::new((!self.span.is_empty()).then(|| self.span.clone()), problem)
    }

    /// The mistake of a table that lacks one of several alternative keys.
    pub fn incomplete(&self, message: String, remedy: &str) -> Mistake {
        let (section, remedy) = (self.name.clone(), remedy.to_string());
        self.complaint(Problem::Incomplete { section, message, remedy })
    }

    /// Reads a formula: a string, or a number.
    pub fn as_text(&self, key: &str, value: &Spanned<DeValue<'_>>) -> Result<SpannedStr, Mistake> {
        let number = |text: String| Ok(SpannedStr::made(text, value.span()));
        match value.get_ref() {
            DeValue::String(text) => match text.chars().find(|c| is_control(*c)) {
                None => Ok(SpannedStr::new(text, value.span(), self.source)),
                Some(found) => {
                    let message =
                        format!("`{key}` contains the control character U+{:04X}", found as u32);
                    let remedy = match found {
                        '\u{c}' | '\u{8}' | '\t' => {
                            "write formulas in plain text, such as x/(1 + y): LaTeX is not read"
                        }
                        _ => "write text without control characters",
                    };
                    let remedy = remedy.to_string();
                    Err(Mistake::at(value.span(), Problem::Other { message, remedy }))
                }
            },
            DeValue::Integer(number_text) if number_text.radix() == 10 => {
                number(number_text.to_string())
            }
            DeValue::Float(float) => number(float.to_string()),
            _ => Err(self.wrong_type(key, "a string", value.span())),
        }
    }

    /// The mistake of a value of the wrong type.
    pub fn wrong_type(&self, key: &str, expected: &str, span: Range<usize>) -> Mistake {
        let remedy = self.remedy(key, expected, &span);
        let (key, expected) = (key.to_string(), expected.to_string());
        Mistake::at(span, Problem::WrongType { key, expected, remedy })
    }

    /// Suggested correction of a value of the wrong type.
    fn remedy(&self, key: &str, expected: &str, span: &Range<usize>) -> String {
        let raw = excerpt(self.source.get(span.clone()).unwrap_or_default());
        // A prime is no quote.
        let quote = if raw.contains('"') { '"' } else { '\'' };
        let plain = raw.replace(quote, "");
        match expected {
            _ if expected.starts_with("an array of tables") => {
                format!("write [[{key}]] above its entries")
            }
            "a table" => table_of(key),
            "a string" if key == "expect" => "write \"holds\", \"fails\" or \"open\"".to_string(),
            "a string" if raw.starts_with('[') && plain.len() < raw.len() => format!(
                "write {key} = \"{plain}\" for a vector, or a [[claim]] with one string for each"
            ),
            "a string" if !plain.contains('\n') => format!("write {key} = \"{plain}\""),
            "a string" => format!("write {key} = \"…\""),
            "true or false" => format!("write {key} = true or {key} = false, without quotes"),
            _ => format!("write {key} = 2, or another whole number, without quotes"),
        }
    }

    /// First place of a text in the file, letter by letter.
    pub fn find(&self, text: &str) -> Option<usize> {
        self.source.find(text)
    }

    /// Reads a whole number.
    pub fn integer(&self, key: &'static str) -> Result<Option<u32>, Mistake> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match value.get_ref() {
            DeValue::Integer(number) => number.to_string().parse().map(Some).ok(),
            _ => None,
        }
        .ok_or_else(|| self.wrong_type(key, "a whole number", value.span()))
    }

    /// Reads a whole number that is not larger than `most`.
    pub fn count(&self, key: &'static str, most: u32) -> Result<Option<usize>, Mistake> {
        match self.integer(key)? {
            Some(found) if found > most => {
                let expected = format!("a whole number up to {most}");
                let span = self.value(key).map_or(self.span.clone(), Spanned::span);
                Err(self.wrong_type(key, &expected, span))
            }
            found => Ok(found.map(|found| found as usize)),
        }
    }

    /// Reads a truth value.
    pub fn boolean(&self, key: &'static str) -> Result<Option<bool>, Mistake> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match value.get_ref() {
            DeValue::Boolean(flag) => Ok(Some(*flag)),
            _ => Err(self.wrong_type(key, "true or false", value.span())),
        }
    }

    /// Reads a table inside this one.
    pub fn section(&self, key: &'static str) -> Result<Option<CaseTable<'a>>, Mistake> {
        let Some(value) = self.value(key) else { return Ok(None) };
        match value.get_ref() {
            DeValue::Table(table) => {
                let name = match self.name.strip_prefix('[').and_then(|n| n.strip_suffix(']')) {
                    Some(outer) => format!("[{outer}.{key}]"),
                    None => format!("[{key}]"),
                };
                Ok(Some(CaseTable::new(&name, table, value.span(), self.source, self.mistakes)))
            }
            _ => Err(self.wrong_type(key, "a table", value.span())),
        }
    }

    /// Table of an entry of this one, if it is a table.
    pub fn inner(&self, key: &str, value: &'a Spanned<DeValue<'a>>) -> Option<CaseTable<'a>> {
        let DeValue::Table(table) = value.get_ref() else { return None };
        let outer = self.name.trim_matches(['[', ']']);
        let name = format!("[{outer}.{key}]");
        Some(CaseTable::new(&name, table, value.span(), self.source, self.mistakes))
    }

    /// Reads a table inside this one; `None` where it is absent, or is not a table.
    pub fn table(&self, key: &'static str) -> Option<CaseTable<'a>> {
        self.keep(self.section(key)).flatten()
    }

    /// Reads the tables of an array of tables; notes a mistake for any other entry.
    pub fn tables(&self, key: &'static str) -> Vec<CaseTable<'a>> {
        let Some(value) = self.value(key) else { return Vec::new() };
        let name = format!("[[{key}]]");
        let wrong = |span| self.wrong_type(key, &format!("an array of tables: {name}"), span);
        let DeValue::Array(array) = value.get_ref() else {
            self.mistakes.add(wrong(value.span()));
            return Vec::new();
        };
        let table = |item: &'a Spanned<DeValue<'a>>| match item.get_ref() {
            DeValue::Table(table) => {
                Ok(CaseTable::new(&name, table, item.span(), self.source, self.mistakes))
            }
            _ => Err(wrong(item.span())),
        };
        array.iter().filter_map(|item| self.keep(table(item))).collect()
    }

    /// Reads the strings of an array, or a single string.
    pub fn texts(&self, key: &'static str) -> Result<Vec<SpannedStr>, Mistake> {
        match self.value(key) {
            None => Ok(Vec::new()),
            Some(value) => match value.get_ref() {
                DeValue::Array(items) => items.iter().map(|item| self.as_text(key, item)).collect(),
                _ => Ok(vec![self.as_text(key, value)?]),
            },
        }
    }

    /// All entries in the order of the file, for tables with user-defined keys.
    pub fn entries(
        &self,
    ) -> Vec<(&'a Spanned<std::borrow::Cow<'a, str>>, &'a Spanned<DeValue<'a>>)> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.order_by_key(|(key, _)| key.span().start);
        entries
    }

    /// Notes a mistake for each key that was not read.
    pub fn finish(&self) -> bool {
        self.allow(&self.asked.borrow())
    }

    /// Keys of the file that were not asked for.
    pub fn unread(&self) -> Vec<String> {
        let asked = self.asked.borrow();
        let keys = self.entries().into_iter().map(|(key, _)| key.get_ref().to_string());
        keys.filter(|key| !asked.contains(&key.as_str())).collect()
    }

    /// Notes a mistake for each key that is not known: a misspelt key is the likeliest reason for
    /// another that is missing. Returns `false` if there are such keys.
    pub fn allow(&self, known: &[&'static str]) -> bool {
        let mut all = true;
        for (key, _) in self.entries() {
            let name = key.get_ref().as_ref();
            if known.contains(&name) {
                continue;
            }
            all = false;
            let nearest = nearest(name, known.iter().copied());
            self.mistakes.add(Mistake::at(
                key.span(),
                Problem::UnknownKey {
                    key: excerpt(name),
                    section: self.name.clone(),
                    nearest: nearest.or_else(|| meant(name, known)),
                    known: known.into(),
                },
            ));
        }
        all
    }
}

/// Whether the character controls a terminal, or changes the direction of text.
fn is_control(c: char) -> bool {
    let is_space = matches!(c, '\n' | '\t' | '\r');
    (c.is_control() && !is_space) || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Numbers of an array of numbers, as they are written.
pub fn numbers(array: &DeArray<'_>) -> Option<Vec<String>> {
    array
        .iter()
        .map(|item| match item.get_ref() {
            DeValue::Integer(number) => Some(number.to_string()),
            DeValue::Float(number) => Some(number.to_string()),
            DeValue::String(text) => Some(text.to_string()),
            _ => None,
        })
        .collect()
}

/// Way to write a table with this key.
fn table_of(key: &str) -> String {
    let lines = match key {
        "state" => "x = \"-2..2\" for each variable",
        "parameters" => "m = \"0.5..2\" for each parameter",
        "field" => "\"x'\" = \"…\" for each variable of [state]",
        "map" => "x = \"…\" for each variable of [state]",
        "let" => "name = \"formula\" for each abbreviation",
        "level" => "equations = [\"x² + y² = 1\"]",
        "hamiltonian" => "function = \"…\" and pairs = [[\"q\", \"p\"]]",
        "lagrangian" => "kinetic = \"…\" and potential = \"…\"",
        "lax" => return "write lax = { L = \"…\", A = \"…\" } for L' = L*A − A*L".to_string(),
        _ => return format!("write {key} = {{ x = \"…\" }}"),
    };
    format!("write a line [{key}], and below it {lines}")
}
