//! Notation of a bracket: its entries as formulas, and as part of the case in which it is judged.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use super::super::SearchError;
use super::super::ask::quoted;
use super::super::terms;
use super::monomials::power_product;
use super::poisson::Family;
use liouville::case::Case;
use liouville::formula::Type;

impl Family<'_> {
    /// Writes the entries P_ij, i < j, by rows; the last multiple divides all, unless it is 0.
    pub(super) fn entries(&self, multiples: &[BigInt]) -> Vec<String> {
        let (field, own) = match multiples.split_last() {
            Some((field, own)) => (field.clone(), own),
            None => (BigInt::ZERO, multiples),
        };
        let below = if field.is_zero() { BigInt::from(-1) } else { field };
        let mut entries = Vec::new();
        let dimension = self.names.len();
        for pair in (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))) {
            let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
            let used = || self.unknowns.iter().zip(own).filter(|(one, _)| one.pair == pair);
            let texts: Vec<String> = used()
                .map(|(one, _)| {
                    let power = power_product(&names, &one.exponents);
                    match (self.weights[one.weight].text.as_str(), power.as_str()) {
                        ("1", _) => power,
                        (weight, "1") => weight.to_string(),
                        (weight, power) => match weight.strip_prefix("1/") {
                            Some(weight) => format!("{power}/{weight}"),
                            None => format!("{weight}*{power}"),
                        },
                    }
                })
                .collect();
            // Σ c P + f v = 0: P is −c/f.
            let common = used().fold(below.clone(), |gcd, (_, a)| gcd.gcd(a));
            let sign = if below.is_negative() { common } else { -common };
            let values: Vec<BigInt> = used().map(|(_, a)| a / &sign).collect();
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let above = terms::written(&values, &texts);
            let divisor = (&below / &sign).abs();
            entries.push(match (above.is_empty(), divisor == 1.into()) {
                (true, _) => "0".to_string(),
                (_, true) => above,
                _ => format!("({above})/{divisor}"),
            });
        }
        entries
    }

    /// Writes the nonzero entries, such as `{x,y} = x*y`.
    pub(super) fn shown(&self, entries: &[String]) -> String {
        let names = &self.names;
        let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
        let nonzero = pairs.zip(entries).filter(|(_, entry)| *entry != "0");
        let one = |((i, j), entry): ((usize, usize), &String)| {
            format!("{{{},{}}} = {entry}", names[i], names[j])
        };
        nonzero.map(one).collect::<Vec<_>>().join(", ")
    }

    /// Adds a bracket in the state variables to the case; without entries, the bracket 0.
    pub(super) fn with_bracket(&self, entries: &[String]) -> Result<Case, SearchError> {
        let state = &self.case.model.state;
        let count = self.names.len();
        let entry = |i: usize, j: usize| -> String {
            let (low, high) = (i.min(j), i.max(j));
            // Earlier rows come first: row k has count − 1 − k entries.
            let place =
                (0..low).map(|k| count - 1 - k).sum::<usize>() + high.saturating_sub(low + 1);
            let text = entries.get(place).map_or("0", String::as_str);
            match i.cmp(&j) {
                Ordering::Less => text.to_string(),
                Ordering::Equal => "0".to_string(),
                Ordering::Greater => format!("−({text})"),
            }
        };
        let list = |row: Vec<String>| format!("[{}]", row.join(", "));
        let mut text = "[variables]\n".to_string();
        for variable in state {
            text += &format!("{} = {}\n", quoted(&variable.name), quoted(&variable.name));
        }
        text += "[poisson]\n";
        let starts = state.iter().scan(0, |start, variable| {
            let own = *start;
            *start += variable.len();
            Some((variable, own))
        });
        let starts: Vec<_> = starts.collect();
        for (index, (a, i)) in starts.iter().enumerate() {
            for (b, j) in &starts[index..] {
                let block = match (a.kind, b.kind) {
                    (Type::Scalar, Type::Scalar) if i == j => continue,
                    (Type::Scalar, Type::Scalar) => entry(*i, *j),
                    (Type::Scalar, across) => {
                        list((0..across.size()).map(|k| entry(*i, j + k)).collect())
                    }
                    (down, Type::Scalar) => {
                        list((0..down.size()).map(|k| entry(i + k, *j)).collect())
                    }
                    // hat(u) has −u₃, u₂, −u₁ above its diagonal.
                    (Type::VECTOR, _) if i == j => {
                        let axis = vec![entry(i + 2, i + 1), entry(*i, i + 2), entry(i + 1, *i)];
                        format!("hat({})", list(axis))
                    }
                    (down, across) => {
                        let row = |k: usize| {
                            list((0..across.size()).map(|l| entry(i + k, j + l)).collect())
                        };
                        list((0..down.size()).map(row).collect())
                    }
                };
                let key = format!("{},{}", a.name, b.name);
                text += &format!("{} = {}\n", quoted(&key), quoted(&block));
            }
        }
        Ok(self.case.ask(&text)?)
    }
}
