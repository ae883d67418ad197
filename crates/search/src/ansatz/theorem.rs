//! What an ansatz shows, in words.

/// The outcome for a null vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Proved and reported.
    Told,
    /// Proved, but not shown to be independent of the known integrals.
    Dependent,
    /// Not written, or not proved; a remark gives the reason.
    Open,
}

/// Writes the statement that bounds the integrals of an ansatz, given the outcomes for the null vectors that
/// are no products of known integrals; constants are among these products or not.
pub fn theorem(what: &str, has_constants: bool, dimension: usize, found: &[Outcome]) -> String {
    if dimension == 0 {
        return format!("no integrals are {what}, constants aside.");
    }
    let constants = if has_constants { "constants and " } else { "" };
    let spanned = match dimension - found.len() {
        0 => "nothing of it".to_string(),
        all if all == dimension => "all of it".to_string(),
        part => format!("a subspace of dimension {part}"),
    };
    let mut parts = vec![format!(
        "the integrals that are {what} form a space of dimension at most {dimension}; {constants}\
         products of known integrals span {spanned}"
    )];
    for (outcome, one, several) in [
        (Outcome::Told, "is listed here", "are listed here"),
        (
            Outcome::Dependent,
            "is not shown to be independent of these",
            "are not shown to be independent of these",
        ),
        (Outcome::Open, "is not known", "are not known"),
    ] {
        match found.iter().filter(|own| **own == outcome).count() {
            0 => {}
            1 => parts.push(format!("1 further integral {one}")),
            count => parts.push(format!("{count} further integrals {several}")),
        }
    }
    format!("{}.", parts.join("; "))
}

/// Writes that at most so many independent ones allow something; `aside` follows the noun.
pub fn at_most(dimension: usize, one: &str, several: &str, aside: &str) -> String {
    match dimension {
        0 => format!("no {one}{aside} allows"),
        1 => format!("at most 1 independent {one}{aside} allows"),
        _ => format!("at most {dimension} independent {several}{aside} allow"),
    }
}

/// Pronoun for so many of them.
pub fn referred(dimension: usize) -> &'static str {
    if dimension > 1 { "them" } else { "it" }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_agree_with_their_words() {
        let says = |has_constants, dimension, found: &[Outcome], end: &str| {
            let own = theorem("quartics", has_constants, dimension, found);
            assert!(own.ends_with(end), "{own}");
        };
        says(true, 0, &[], "no integrals are quartics, constants aside.");
        says(
            true,
            2,
            &[],
            "dimension at most 2; constants and products of known integrals span all of it.",
        );
        says(false, 1, &[Outcome::Told], "span nothing of it; 1 further integral is listed here.");
        let open = [Outcome::Open, Outcome::Open, Outcome::Dependent];
        says(
            true,
            4,
            &open,
            "a subspace of dimension 1; 1 further integral is not shown to be independent of these; 2 \
             further integrals are not known.",
        );
        let forces = |dimension| at_most(dimension, "force", "forces", " of this form");
        assert_eq!(forces(0), "no force of this form allows");
        assert_eq!(forces(1), "at most 1 independent force of this form allows");
        assert_eq!(forces(2), "at most 2 independent forces of this form allow");
    }
}
