//! Tables of parameter values: CSV, a row for each body.

use std::fmt;
use std::iter::repeat;

use liouville::case::{Case, Setting};
use liouville::formula::canonical_name;

use crate::report::bodies::RowMistake;

/// Rows of values below the names of the parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueTable {
    /// Names of the parameters, as they are written.
    names: Vec<String>,
    /// Rows, in order.
    pub rows: Vec<ValueRow>,
}

/// Values of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueRow {
    /// Line on which the row begins, from 1.
    pub line: u64,
    /// Values, as they are written.
    values: Vec<String>,
}

/// Mistake of a table as a whole, for which no row can be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableMistake {
    /// There is no line of names.
    Empty,
    /// There are names, and no row below them.
    NoRows,
    /// A column has no name.
    Unnamed(usize),
    /// Two columns have this name.
    Doubled(String),
    /// A column of this name, of which `--set` gives the value too.
    Given(String),
    /// A column of a name that is no parameter of the case, and the names that are.
    Unknown(String, Vec<String>),
    /// A quoted value that begins on this line has no end.
    Unclosed(u64),
}

impl fmt::Display for TableMistake {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(out, "the table is empty"),
            Self::NoRows => write!(out, "the table has no rows"),
            Self::Unnamed(column) => write!(out, "column {column} has no name"),
            Self::Doubled(name) => write!(out, "there are two columns `{name}`"),
            Self::Given(name) => {
                write!(out, "`{name}` has a column, and --set gives it a value too")
            }
            Self::Unknown(name, _) => write!(out, "there is no parameter `{name}` to set"),
            Self::Unclosed(line) => write!(out, "line {line}: a quoted value has no end"),
        }
    }
}

impl TableMistake {
    /// Remedy.
    pub fn help(&self) -> String {
        let first = "write the names of parameters on the first line, separated by commas, such as";
        match self {
            Self::Empty => format!("{first} m,R, and a row of values for each body below"),
            Self::NoRows => "write a row of values for each body below the names".to_string(),
            Self::Unnamed(_) => format!("{first} m,R"),
            Self::Doubled(_) => "remove one of them".to_string(),
            Self::Given(_) => "remove the column, or --set".to_string(),
            Self::Unknown(name, known) => match &known[..] {
                [] => "this case has no parameters".to_string(),
                _ if name.contains([';', '\t']) => {
                    "separate names and values by commas; a decimal number has a point".to_string()
                }
                known => format!("this case has {}", known.join(", ")),
            },
            Self::Unclosed(_) => "end it with a quote, and double a quote inside".to_string(),
        }
    }
}

impl ValueTable {
    /// Reads a table. Empty lines and lines that begin with `#` do not count.
    pub fn read(text: &str) -> Result<Self, TableMistake> {
        let mut records = records(text.strip_prefix('\u{feff}').unwrap_or(text))?.into_iter();
        let header = records.next().ok_or(TableMistake::Empty)?;
        let names: Vec<String> = header.values.iter().map(|name| name.trim().to_string()).collect();
        for (column, name) in names.iter().enumerate() {
            let own = canonical(name);
            if own.is_empty() {
                return Err(TableMistake::Unnamed(column + 1));
            }
            if names[..column].iter().any(|other| canonical(other) == own) {
                return Err(TableMistake::Doubled(name.clone()));
            }
        }
        let rows: Vec<ValueRow> = records.collect();
        match rows.is_empty() {
            true => Err(TableMistake::NoRows),
            false => Ok(Self { names, rows }),
        }
    }

    /// Checks that all columns are parameters of a case, without the values that `--set` gives.
    pub fn check(&self, case: &Case, given: &[Setting]) -> Result<(), TableMistake> {
        let parameters = &case.model.parameters;
        for name in &self.names {
            let own = canonical(name);
            if given.iter().any(|setting| setting.name == own) {
                return Err(TableMistake::Given(name.clone()));
            }
            if !parameters.iter().any(|parameter| parameter.name == own) {
                let known = parameters.iter().map(|parameter| parameter.name.clone()).collect();
                return Err(TableMistake::Unknown(name.clone(), known));
            }
        }
        Ok(())
    }

    /// Names and values of a row, as they are written; a value that is not there is empty.
    pub fn named(&self, row: &ValueRow) -> Vec<(String, String)> {
        let values = row.values.iter().map(|value| value.trim().to_string());
        self.names.iter().cloned().zip(values.chain(repeat(String::new()))).collect()
    }

    /// Values of a row as settings.
    pub fn settings(&self, row: &ValueRow) -> Result<Vec<Setting>, RowMistake> {
        let (found, expected) = (row.values.len(), self.names.len());
        if found != expected {
            let are = if found == 1 { "value" } else { "values" };
            let message = format!("{found} {are} below {expected} names");
            let help =
                "write one value for each name, and quote a value that has a comma: \"[1,2,3]\"";
            return Err(RowMistake::new(message, help));
        }
        let named = self.named(row);
        if let Some((name, _)) = named.iter().find(|(_, value)| value.is_empty()) {
            let help = "write one; a parameter that stays general has no column";
            return Err(RowMistake::new(format!("`{name}` has no value"), help));
        }
        Ok(named
            .into_iter()
            .map(|(name, value)| Setting { name: canonical(&name), value })
            .collect())
    }
}

/// Name in the form in which cases know it.
fn canonical(name: &str) -> String {
    canonical_name(name).unwrap_or_else(|| name.to_string())
}

/// Records of a CSV text with the lines on which they begin.
fn records(text: &str) -> Result<Vec<ValueRow>, TableMistake> {
    let mut found = Vec::new();
    let (mut rest, mut line) = (text, 1);
    while !rest.is_empty() {
        let end = rest.find('\n').unwrap_or(rest.len());
        let first = rest[..end].trim();
        if first.is_empty() || first.starts_with('#') {
            rest = rest.get(end + 1..).unwrap_or_default();
            line += 1;
            continue;
        }
        let (values, length) = record(rest).ok_or(TableMistake::Unclosed(line))?;
        found.push(ValueRow { line, values });
        line += rest[..length].matches('\n').count() as u64;
        rest = &rest[length..];
    }
    Ok(found)
}

/// Values of the first record of a text, and its length with the end of its line; `None` if a
/// quoted value has no end.
fn record(text: &str) -> Option<(Vec<String>, usize)> {
    let (mut values, mut value) = (Vec::new(), String::new());
    let mut is_quoted = false;
    let mut letters = text.char_indices().peekable();
    while let Some((place, letter)) = letters.next() {
        match (letter, is_quoted) {
            ('"', true) if letters.next_if(|(_, next)| *next == '"').is_some() => value.push('"'),
            ('"', true) => is_quoted = false,
            (_, true) => value.push(letter),
            ('"', false) if value.trim().is_empty() => {
                value.clear();
                is_quoted = true;
            }
            (',', false) => values.push(std::mem::take(&mut value)),
            ('\n', false) => {
                values.push(value);
                return Some((values, place + 1));
            }
            (_, false) => value.push(letter),
        }
    }
    values.push(value);
    (!is_quoted).then_some((values, text.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<(u64, Vec<String>)> {
        let table = ValueTable::read(text).expect("a table");
        let values =
            |row: &ValueRow| table.named(row).into_iter().map(|(_, value)| value).collect();
        table.rows.iter().map(|row| (row.line, values(row))).collect()
    }

    #[test]
    fn tables_are_read_as_spreadsheets_write_them() {
        let found =
            rows("\u{feff}m,I\r\n# a remark\r\n\r\n5/4,\"[2,2,3]\"\r\n 2 , \"[1,\n1,2]\"\n3,4");
        let expected = [(4, ["5/4", "[2,2,3]"]), (5, ["2", "[1,\n1,2]"]), (7, ["3", "4"])];
        let expected = expected.map(|(line, values)| (line, values.map(String::from).to_vec()));
        assert_eq!(found, expected);
        assert_eq!(rows("m\n\"say \"\"x\"\"\"\n")[0].1, ["say \"x\""]);
    }

    #[test]
    fn mistakes_of_whole_tables_are_named() {
        let cases = [
            ("", TableMistake::Empty),
            ("\n# m,R\n\n", TableMistake::Empty),
            ("m,R\n", TableMistake::NoRows),
            ("m,,R\n1,2,3\n", TableMistake::Unnamed(2)),
            ("mu,R,μ\n1,2,3\n", TableMistake::Doubled("μ".to_string())),
            ("m,R\n1,2\n3,\"4\n5,6\n", TableMistake::Unclosed(3)),
        ];
        for (text, mistake) in cases {
            assert_eq!(ValueTable::read(text), Err(mistake), "{text}");
        }
    }

    #[test]
    fn rows_that_do_not_fit_are_mistakes_of_their_own() {
        let table = ValueTable::read("m,R\n1\n1,2,3\n1,\n1,2\n").expect("a table");
        let found: Vec<bool> = table.rows.iter().map(|row| table.settings(row).is_ok()).collect();
        assert_eq!(found, [false, false, false, true]);
    }
}
