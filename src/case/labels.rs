//! Labels of a claim: what its publication calls the statement.

use super::Column;

/// Rows of tables 1 and 2 in the order of the paper, from 1.
const PAPER_ROWS: [&str; 7] =
    ["inertia", "surface", "restriction", "measure", "integral", "gyrostat", "generalisation"];

/// Labels of a claim: the parts of its source, such as `(3.19)` and `Theorem 2.2`, and its cell of a
/// table, such as `Table 1, row 4, column 2`.
///
/// Parts of a source are separated by commas or semicolons.
pub fn labels(source: &str, column: Option<&Column>, cell: Option<&str>) -> Vec<String> {
    let parts = source.split([',', ';']).map(str::trim).filter(|part| !part.is_empty());
    let mut found: Vec<String> = parts.map(str::to_string).collect();
    if let (Some(Column { table, column, .. }), Some(cell)) = (column, cell) {
        let row = PAPER_ROWS.iter().position(|row| *row == cell);
        found.extend(row.map(|row| format!("Table {table}, row {}, column {column}", row + 1)));
        found.push(format!("Table {table}, column {column}, {cell}"));
    }
    found
}

/// Whether a label is the wanted one, begins with it as `Table 1, row 4, column 2` with
/// `Table 1, row 4`, or matches it where it contains `*` or `?`.
pub fn is_labelled(label: &str, wanted: &str) -> bool {
    if wanted.contains(['*', '?']) {
        return matches(wanted, label);
    }
    label.strip_prefix(wanted).is_some_and(|rest| rest.is_empty() || rest.starts_with(", "))
}

/// Whether a text matches a pattern, in which `*` stands for any characters and `?` for one.
pub fn matches(pattern: &str, text: &str) -> bool {
    let (pattern, text): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), text.chars().collect());
    // The ends of the text that the pattern so far can match.
    let mut ends = vec![false; text.len() + 1];
    ends[0] = true;
    for wanted in pattern {
        if wanted == '*' {
            let first = ends.iter().position(|end| *end).unwrap_or(ends.len());
            ends.iter_mut().skip(first).for_each(|end| *end = true);
        } else {
            for end in (1..ends.len()).rev() {
                ends[end] = ends[end - 1] && (wanted == '?' || wanted == text[end - 1]);
            }
            ends[0] = false;
        }
    }
    ends.last() == Some(&true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_falls_into_its_labels() {
        let column =
            Column { table: 1, column: 2, words: Vec::new(), caption: None, notes: Vec::new() };
        let found = labels("BMB 2013, (3.8); Theorem 2.2", Some(&column), Some("measure"));
        let expected = [
            "BMB 2013",
            "(3.8)",
            "Theorem 2.2",
            "Table 1, row 4, column 2",
            "Table 1, column 2, measure",
        ];
        assert_eq!(found, expected, "equation, theorem and cell");
        assert_eq!(labels("", Some(&column), None), [""; 0], "a claim without a cell");
    }

    #[test]
    fn a_label_is_wanted_as_a_whole() {
        for (label, wanted) in [
            ("(3.19)", "(3.19)"),
            ("(3.19)", "(3.1?)"),
            ("Kozlov (39)", "*(39)"),
            ("Table 1, row 4, column 2", "Table 1, row 4"),
            ("Table 1, row 4, column 2", "Table 1"),
        ] {
            assert!(is_labelled(label, wanted), "{wanted} is {label}");
        }
        for (label, wanted) in [
            ("(3.19)", "(3.1"),
            ("Theorem 2.21", "Theorem 2.2"),
            ("Table 11, row 4", "Table 1"),
            ("Otstavnov (3.4)", "(3.4)"),
        ] {
            assert!(!is_labelled(label, wanted), "{wanted} is not {label}");
        }
    }

    #[test]
    fn patterns_match_as_in_a_shell() {
        for (pattern, text) in [
            ("F2*", "F2 with I"),
            ("*I", "F2 with I"),
            ("F?", "F2"),
            ("*", ""),
            ("a*b*c", "aXbYbc"),
        ] {
            assert!(matches(pattern, text), "{pattern} {text}");
        }
        for (pattern, text) in
            [("F2*", "aF2"), ("F?", "F"), ("?", ""), ("a*b", "abc"), ("", "a"), ("F?", "F22")]
        {
            assert!(!matches(pattern, text), "{pattern} {text}");
        }
    }
}
