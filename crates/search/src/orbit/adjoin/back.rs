//! Formulas of the extended case in the names of the case itself.
//!
//! Terms are rewritten as a person writes them: u² − 2*k/√(x² + y²) for u² − 2*k*w, w = 1/r.

use liouville::formula::exponent_text;
use liouville::order::StableOrder;
use num_integer::Integer;

use super::parsed::{
    base_and_power, closes, factors, inside, is_bracketed, is_modulus, is_name, joined, terms,
    unbracketed,
};
use super::polynomial::RingPolynomial;
use super::ring::{AdjoinedRing, Atom, Of};
use super::write::{RingNames, written};

/// A function by its name in the extended case.
#[derive(Clone, Debug)]
struct AdjoinedFunction {
    name: String,
    text: String,
    /// Base and order of an inverse b^(−1/n).
    inverse: Option<(String, u32)>,
    /// Base and order of a root b^(1/n).
    root: Option<(String, u32)>,
}

/// The names of all functions.
#[derive(Clone, Debug)]
pub struct Back {
    entries: Vec<AdjoinedFunction>,
}

impl Back {
    /// Takes the functions of a ring.
    pub fn of(ring: &AdjoinedRing, names: &RingNames) -> Self {
        let entry = |(place, atom): (usize, &Atom)| {
            let modulus = |base: &RingPolynomial| {
                Some(format!("|{}|", written(&base.square_root()?, &names.original)))
            };
            // A root of a square is a modulus, and a base itself.
            let own = |base: &RingPolynomial, order: u32| match order {
                2 => modulus(base)
                    .map_or_else(|| (written(base, &names.original), 2), |own| (own, 1)),
                _ => (written(base, &names.original), order),
            };
            let inverse = match atom {
                Atom::Inverse(base, order) => Some(own(base, *order)),
                _ => None,
            };
            let root = match atom {
                Atom::Root(base, order) => Some(own(base, *order)),
                _ => None,
            };
            AdjoinedFunction {
                name: names.extended[place].clone(),
                text: names.original[place].clone(),
                inverse,
                root,
            }
        };
        let is_other = |place: usize, atom: &Atom| match atom {
            Atom::Constant(Of::Inverse(_) | Of::Root(_)) => false,
            _ => names.extended[place] != names.original[place],
        };
        let all = ring.atoms.iter().enumerate().filter(|(place, atom)| is_other(*place, atom));
        Self { entries: all.map(entry).collect() }
    }

    /// Rewrites a formula.
    pub fn rewritten(&self, text: &str) -> String {
        joined(self.rewritten_terms(text))
    }

    /// Rewrites an integral, up to a factor: most terms positive, and these first; F in place of 1/F.
    pub fn integral(&self, text: &str) -> String {
        let mut all = self.rewritten_terms(text);
        if let [(_, only)] = all.as_slice()
            && let Some(below) = only.strip_prefix("1/")
        {
            return unbracketed(below).to_string();
        }
        let negative = all.iter().filter(|(is_negative, _)| *is_negative).count();
        if 2 * negative > all.len() {
            all.iter_mut().for_each(|(is_negative, _)| *is_negative = !*is_negative);
        }
        all.order_by_key(|(is_negative, _)| *is_negative);
        joined(all)
    }

    /// Terms with their signs.
    fn rewritten_terms(&self, text: &str) -> Vec<(bool, String)> {
        let all = terms(text);
        if let [(is_negative, only)] = all.as_slice()
            && let [(false, above), (true, below)] = factors(only)[..]
            && let Some(above) = inside(above)
            && let below = inside(below).unwrap_or(below)
            && terms(below).len() == 1
        {
            // A fraction whose denominator is a product is divided term by term.
            let divided = |(sign, term): (bool, &str)| {
                (sign != *is_negative, self.term(&[(false, term), (true, below)]))
            };
            return terms(above).into_iter().map(divided).collect();
        }
        opened(all.into_iter().map(|(sign, term)| (sign, self.term(&[(false, term)]))).collect())
    }

    /// Rewrites a product of products, some of which divide.
    fn term(&self, parts: &[(bool, &str)]) -> String {
        let mut powers: Vec<(String, i64, i64)> = Vec::new();
        let mut add = |base: String, above: i64, below: i64| match powers
            .iter_mut()
            .find(|(own, ..)| *own == base)
        {
            Some((_, own, order)) => {
                (*own, *order) = (*own * below + above * *order, *order * below)
            }
            None => powers.push((base, above, below)),
        };
        let mut open: Vec<(bool, &str)> = parts.iter().rev().copied().collect();
        while let Some((is_below, part)) = open.pop() {
            // Products in brackets are opened.
            let all = factors(part);
            if all.len() > 1 {
                let own = all.into_iter().map(|(divides, own)| (divides != is_below, own));
                open.extend(own.rev());
                continue;
            }
            if let Some(inner) = inside(part)
                && let [(false, only)] = terms(inner)[..]
            {
                open.push((is_below, only));
                continue;
            }
            for (divides, factor) in all {
                let sign = if divides == is_below { 1 } else { -1 };
                let (base, power) = base_and_power(factor);
                let own = self.entries.iter().find(|entry| entry.name == base);
                match own.map(|entry| (entry, entry.inverse.as_ref())) {
                    Some((_, Some((base, order)))) => {
                        add(base.clone(), -sign * power, i64::from(*order));
                    }
                    Some((entry, None)) => match &entry.root {
                        Some((base, order)) => add(base.clone(), sign * power, i64::from(*order)),
                        None => add(entry.text.clone(), sign * power, 1),
                    },
                    None => add(self.inside(base), sign * power, 1),
                }
            }
        }
        let raised = |sign: i64| {
            let own = powers.iter().filter(move |(_, above, _)| above.signum() == sign);
            own.map(|(base, above, below)| raised(base, above.unsigned_abs(), below.unsigned_abs()))
        };
        let mut above: Vec<String> = raised(1).filter(|own| own != "1").collect();
        if above.is_empty() {
            above.push("1".to_string());
        }
        let (above, below) = (above.join("*"), raised(-1).collect::<Vec<_>>());
        self.replaced(&match below.as_slice() {
            [] => above,
            [only] => format!("{above}/{only}"),
            several => format!("{above}/({})", several.join("*")),
        })
    }

    /// Rewrites what stands in the brackets of a factor.
    fn inside(&self, factor: &str) -> String {
        if let Some(body) = factor.strip_prefix('|').and_then(|own| own.strip_suffix('|'))
            && closes(factor)
        {
            return format!("|{}|", self.rewritten(body));
        }
        let is_letter = |c: char| c.is_alphanumeric() || c == '_' || c == '√';
        let start = factor.find('(').filter(|start| factor[..*start].chars().all(is_letter));
        match (start, factor.strip_suffix(')')) {
            (Some(start), Some(body)) if closes(&factor[start..]) => {
                format!("{}({})", &factor[..start], self.rewritten(&body[start + 1..]))
            }
            _ => factor.to_string(),
        }
    }

    /// Replaces the names that are left.
    fn replaced(&self, text: &str) -> String {
        with_words(text, &|word| {
            let entry = self.entries.iter().find(|entry| entry.name == word);
            entry.map(|entry| entry.text.clone())
        })
    }
}

/// Text of a product with one power of each factor: r²*w for r*(r*w).
pub fn merged(text: &str) -> String {
    Back { entries: Vec::new() }.rewritten(text)
}

/// Replaces the words of a text for which there is another.
pub(super) fn with_words(text: &str, other: &dyn Fn(&str) -> Option<String>) -> String {
    let mut made = String::new();
    let mut word = String::new();
    for letter in text.chars().chain([' ']) {
        if letter.is_alphanumeric() && !"²³".contains(letter) {
            word.push(letter);
            continue;
        }
        made.push_str(&other(&word).unwrap_or_else(|| word.clone()));
        word.clear();
        made.push(letter);
    }
    made.truncate(made.len() - 1);
    made
}

/// Terms without those that are sums in brackets, whose own terms take their places, and without pairs
/// that cancel: w/y + w*t for y + w/y + (w*t − y). A sum of which nothing would be left stays as it is.
fn opened(all: Vec<(bool, String)>) -> Vec<(bool, String)> {
    if all.iter().all(|(_, term)| inside(term).is_none()) {
        return all;
    }
    let mut left: Vec<(bool, String)> = Vec::new();
    for (sign, term) in &all {
        let own = inside(term).unwrap_or(term);
        for (inner, part) in terms(own).into_iter().filter(|(_, part)| !part.is_empty()) {
            let is_negative = inner != *sign;
            match left.iter().position(|(other, text)| *other != is_negative && text == part) {
                Some(place) => {
                    left.remove(place);
                }
                None => left.push((is_negative, part.to_string())),
            }
        }
    }
    if left.is_empty() { all } else { left }
}

/// Text of an integral with other signs: F for −F if more terms are negative, and the positive terms
/// first; `None` if it begins with a positive term, and most terms are.
pub fn with_signs(text: &str) -> Option<String> {
    let mut all: Vec<(bool, String)> =
        terms(text).into_iter().map(|(sign, term)| (sign, term.to_string())).collect();
    let negative = all.iter().filter(|(is_negative, _)| *is_negative).count();
    let is_turned = 2 * negative > all.len();
    if !is_turned && !all.first()?.0 {
        return None;
    }
    all.iter_mut().for_each(|(is_negative, _)| *is_negative ^= is_turned);
    all.order_by_key(|(is_negative, _)| *is_negative);
    Some(joined(all))
}

/// b^(power/order).
fn raised(base: &str, power: u64, order: u64) -> String {
    let common = power.gcd(&order).max(1);
    let (power, order) = (power / common, order / common);
    let is_number = base.chars().all(|letter| letter.is_ascii_digit());
    let is_tight = is_name(base) || is_bracketed(base) || is_modulus(base);
    let bracketed = match is_tight && !(is_number && power > 1) {
        true => base.to_string(),
        false => format!("({base})"),
    };
    match (power, order) {
        (1, 1) if is_number || is_tight => base.to_string(),
        (1, 1) => bracketed,
        (power, 1) => format!("{bracketed}{}", exponent_text(power as i64)),
        (1, 2) => format!("√({})", unbracketed(base)),
        (power, order) => format!("({})^({power}/{order})", unbracketed(base)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_written_as_a_person_writes_them() {
        let entry = |name: &str, text: &str, inverse: Option<(&str, u32)>| AdjoinedFunction {
            name: name.to_string(),
            text: text.to_string(),
            inverse: inverse.map(|(base, order)| (base.to_string(), order)),
            root: None,
        };
        let back = Back {
            entries: vec![
                entry("aux4", "exp(q1 − q2)", None),
                entry("aux5", "(1/√(x² + y²))", Some(("x² + y²", 2))),
                entry("aux6", "(1/x)", Some(("x", 1))),
            ],
        };
        let pairs = [
            ("u² − 2*k*aux5", "u² − 2*k/√(x² + y²)"),
            ("−aux6² + 2*aux4", "−1/x² + 2*exp(q1 − q2)"),
            ("x*aux5³ + aux5²", "x/(x² + y²)^(3/2) + 1/(x² + y²)"),
            ("(u*aux5 − 1)/(aux4² + 1)", "(u/√(x² + y²) − 1)/(exp(q1 − q2)² + 1)"),
            ("y*ln(|x*aux6 − aux4*aux6|)", "y*ln(|1 − exp(q1 − q2)/x|)"),
            ("|x|*aux6 + |y − |x|*aux4|", "|x|/x + |y − |x|*exp(q1 − q2)|"),
            ("ln(|aux4|) − x^(-2)", "ln(|exp(q1 − q2)|) − x^(-2)"),
            ("aux41 + aux5^4", "aux41 + 1/(x² + y²)²"),
            ("(2*aux6 − x³*u²)/(x^5)", "2/x⁶ − u²/x²"),
            ("(2*u + 3)/(aux6)", "2*u*x + 3*x"),
            ("−2*x", "−2*x"),
            ("u/(x*y²)", "u/(x*y²)"),
            ("r*(r*w)/(s*w)", "r²/s"),
        ];
        for (text, wanted) in pairs {
            assert_eq!(back.rewritten(text), wanted);
        }
        assert_eq!(back.integral("−2*k*aux5 + u²"), "u² − 2*k/√(x² + y²)");
        assert_eq!(back.integral("(aux6)/(x*u)"), "x²*u");

        let back = Back { entries: vec![entry("aux1", "(w*t − y)", None)] };
        assert_eq!(back.rewritten("y + w/y + aux1"), "w/y + w*t");
        assert_eq!(back.rewritten("−y − aux1"), "−w*t");
        assert_eq!(back.rewritten("y − 2*aux1"), "y − 2*(w*t − y)");
        assert_eq!(back.rewritten("aux1 + y*w*t − aux1"), "y*w*t");
    }

    #[test]
    fn most_terms_are_positive_and_these_come_first() {
        assert_eq!(with_signs("−x*q + y*p").as_deref(), Some("y*p − x*q"));
        assert_eq!(with_signs("−x − y + b*ln(−x)").as_deref(), Some("x + y − b*ln(−x)"));
        assert_eq!(with_signs("x² − y − z").as_deref(), Some("y + z − x²"));
        assert_eq!(with_signs("x² − y*(−a + b) + z"), None);
        assert_eq!(with_signs("(−a + b)*x"), None);
    }
}
