//! Tables of numbers as files: CSV, NumPy's format, JSON.

use std::borrow::Cow;

use serde_json::{Value, json};

use super::orbit::written;
use liouville::number::double_double::DoubleDouble;
use liouville_flow::Precision;

/// Rows of numbers with the titles of their columns.
pub struct DataTable<'r> {
    /// Titles of the columns.
    pub columns: Vec<String>,
    /// Number of columns at the beginning that hold whole numbers.
    pub whole: usize,
    /// Rows, each with a number for each column.
    pub rows: Vec<Cow<'r, [DoubleDouble]>>,
    /// Precision of the numbers.
    pub precision: Precision,
}

impl DataTable<'_> {
    /// Renders the rows with commas, below a line of titles; in double-double with all digits. What
    /// is undefined is NaN.
    pub fn csv(&self) -> String {
        let titles: Vec<String> = self.columns.iter().map(|title| quoted(title)).collect();
        let mut out = titles.join(",") + "\n";
        for row in &self.rows {
            let cell = |(place, x): (usize, &DoubleDouble)| match place < self.whole {
                true => format!("{:.0}", x.hi),
                false => written(*x, self.precision),
            };
            let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
            out.push_str(&cells.join(","));
            out.push('\n');
        }
        out
    }

    /// Renders the rows as a NumPy array of f64, of the shape (rows, columns).
    pub fn npy(&self) -> Vec<u8> {
        let shape = format!("({}, {})", self.rows.len(), self.columns.len());
        let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}");
        // Magic, version and length take ten bytes; the data begin at a multiple of 64.
        while !(10 + header.len() + 1).is_multiple_of(64) {
            header.push(' ');
        }
        header.push('\n');
        let mut out = b"\x93NUMPY\x01\x00".to_vec();
        out.extend((header.len() as u16).to_le_bytes());
        out.extend(header.as_bytes());
        out.extend(self.rows.iter().flat_map(|row| row.iter()).flat_map(|x| x.hi.to_le_bytes()));
        out
    }

    /// Renders columns and rows as JSON: numbers, in double-double decimal strings. What is
    /// undefined is null.
    pub fn json(&self) -> String {
        let cell = |(place, x): (usize, &DoubleDouble)| -> Value {
            match self.precision {
                _ if place < self.whole => json!(x.hi as i64),
                _ if !x.hi.is_finite() => Value::Null,
                Precision::Float => json!(x.hi),
                Precision::Pair => json!(written(*x, self.precision)),
            }
        };
        // Row by row: as values the numbers would take many times the memory of the text.
        let mut out = format!("{{\"columns\":{},\"rows\":[", json!(self.columns));
        for (place, row) in self.rows.iter().enumerate() {
            let cells: Value = row.iter().enumerate().map(cell).collect();
            out.push_str(if place > 0 { "," } else { "" });
            out.push_str(&cells.to_string());
        }
        out + "]}\n"
    }
}

/// A text as a field of CSV.
pub fn quoted(title: &str) -> String {
    match title.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", title.replace('"', "\"\"")),
        false => title.to_string(),
    }
}

/// Lines about columns that have no value at some crossings.
pub(super) fn missing<'r>(
    titles: &[String],
    rows: impl Iterator<Item = &'r Vec<f64>> + Clone,
) -> String {
    let count = rows.clone().count();
    let lacks = |place: usize| {
        rows.clone().filter(|row| !row.get(place).is_some_and(|x| x.is_finite())).count()
    };
    let line = |(place, title): (usize, &String)| match lacks(place) {
        0 => String::new(),
        all if all == count => format!("`{title}` has no value at any crossing\n"),
        some => format!("`{title}` has no value at {some} of {count} crossings\n"),
    };
    titles.iter().enumerate().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn data() -> DataTable<'static> {
        let row = |row: [f64; 3]| row.map(DoubleDouble::from_f64).to_vec().into();
        DataTable {
            columns: ["start", "t", "(a,b)"].map(str::to_string).to_vec(),
            whole: 1,
            rows: vec![row([0.0, 0.5, f64::NAN]), row([1.0, 1e-7, -2.0])],
            precision: Precision::Float,
        }
    }

    #[test]
    fn titles_with_commas_are_quoted() {
        assert_eq!(data().csv(), "start,t,\"(a,b)\"\n0,0.5,NaN\n1,1e-7,-2.0\n");
    }

    #[test]
    fn arrays_have_the_header_that_numpy_reads() {
        let bytes = data().npy();
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((10 + length) % 64, 0, "aligned");
        let header = std::str::from_utf8(&bytes[10..10 + length]).expect("ASCII");
        assert!(header.contains("'shape': (2, 3)") && header.ends_with('\n'), "{header}");
        let numbers: Vec<f64> = bytes[10 + length..]
            .chunks(8)
            .map(|x| f64::from_le_bytes(x.try_into().expect("eight bytes")))
            .collect();
        assert_eq!((numbers.len(), numbers[4]), (6, 1e-7), "row by row");
    }

    #[test]
    fn undefined_values_are_null() {
        let parsed: Value = serde_json::from_str(&data().json()).expect("JSON");
        assert!(parsed["rows"][0][2].is_null());
        assert_eq!(parsed["rows"][1][0], 1);
        assert_eq!(data().json(), parsed.to_string() + "\n", "as one value");
    }
}
