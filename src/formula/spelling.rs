//! Corrections of misspelled names.

/// Length of a name above which no correction is sought; the cost grows with its square.
const LONGEST: usize = 40;

/// Known name nearest to `name` by edit distance; `None` when nothing is near.
///
/// Near means one edit for up to five letters, two beyond, and for one or two letters only the
/// other case, since any two letters are one edit apart. Primes are no letters.
pub fn nearest<'a>(name: &str, among: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() > LONGEST {
        return None;
    }
    let allowed = match name.trim_end_matches('\'').chars().count() {
        0..=2 => 0,
        3..=5 => 1,
        _ => 2,
    };
    among
        .filter(|known| *known != name)
        .filter_map(|known| {
            let other: Vec<char> = known.chars().collect();
            let near_in_length = letters.len().abs_diff(other.len()) <= allowed;
            let distance = if known.to_lowercase() == name.to_lowercase() {
                0
            } else if allowed == 0 && differ_by_number(known, name) {
                return Some((1, known));
            } else if near_in_length && other.len() > 1 {
                edit_distance(&letters, &other)
            } else {
                return None;
            };
            (distance <= allowed).then_some((distance, known))
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, known)| known)
}

/// Whether two names are a letter with different numbers, as g1 and g2.
fn differ_by_number(one: &str, other: &str) -> bool {
    let letter = |name: &str| name.trim_end_matches(|c: char| c.is_ascii_digit()).to_string();
    let numbered = |name: &str| name.ends_with(|c: char| c.is_ascii_digit());
    numbered(one) && numbered(other) && letter(one) == letter(other)
}

/// Splits a name into the fewest known pieces (`mR` → `m`, `R`), if there are two or more.
pub(super) fn split(name: &str, known: impl Fn(&str) -> bool) -> Option<Vec<&str>> {
    let cuts: Vec<usize> = name.char_indices().map(|(at, _)| at).chain([name.len()]).collect();
    if cuts.len() > LONGEST {
        return None;
    }
    // best[j]: number of pieces of the text before cut j, and the start of the last one
    let mut best: Vec<Option<(usize, usize)>> = vec![Some((0, 0))];
    for j in 1..cuts.len() {
        let options = (0..j).filter_map(|i| {
            let (pieces, _) = best[i]?;
            known(&name[cuts[i]..cuts[j]]).then_some((pieces + 1, i))
        });
        best.push(options.min());
    }
    let mut pieces = Vec::new();
    let mut end = cuts.len() - 1;
    while end > 0 {
        let (_, start) = best[end]?;
        pieces.push(&name[cuts[start]..cuts[end]]);
        end = start;
    }
    pieces.reverse();
    (pieces.len() > 1).then_some(pieces)
}

/// Edit distance of two texts: insertions, deletions, replacements and swaps of neighbours.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replaced = above[j] + usize::from(a[i] != b[j]);
            let mut cost = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                cost = cost.min(before[j - 1] + 1);
            }
            row.push(cost);
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    const KNOWN: [&str; 5] = ["gamma", "ω", "Ĩ", "rdot", "m"];

    #[test]
    fn near_names_are_found() {
        let find = |name| nearest(name, KNOWN.into_iter());
        assert_eq!(find("gama"), Some("gamma"), "one letter missing");
        assert_eq!(find("rdto"), Some("rdot"), "two letters swapped");
        assert_eq!(find("M"), Some("m"), "the other case");
        assert_eq!(find("x"), None, "any two letters are one edit apart");
        assert_eq!(find("energy"), None, "nothing near");
        assert_eq!(find(&"a".repeat(100_000)), None, "too long to be a misspelling");
    }

    #[test]
    fn joined_names_come_apart() {
        let known = |name: &str| ["m", "R", "mu", "u"].contains(&name);
        assert_eq!(split("mR", known), Some(vec!["m", "R"]), "two names");
        assert_eq!(split("muR", known), Some(vec!["mu", "R"]), "the fewest pieces");
        assert_eq!(split("m", known), None, "one name is not joined");
        assert_eq!(split("mx", known), None, "x is unknown");
    }
}
