//! Parts of certificates about motion: numbers as texts, and complaints that name the part.

use super::hexadecimal::{read, written};
use liouville_flow::Enclosure;
use serde_json::Value;

/// Writes numbers.
pub fn list(numbers: &[f64]) -> Vec<String> {
    numbers.iter().copied().map(written).collect()
}

/// Factor by which the enclosures stated are wider than those of the first proof, and the roundings
/// of the midpoint besides: in other arithmetic they come out somewhat different.
const MARGIN: f64 = 1.0625;
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// Writes an enclosure, somewhat wider, as a ball.
pub fn wider(x: Enclosure) -> [String; 2] {
    [written(x.mid), written(x.rad * MARGIN + x.mid.abs() * ROUNDINGS)]
}

/// Part of a certificate, with its path for complaints.
pub struct CertificatePart<'v> {
    pub value: &'v Value,
    pub path: String,
}

impl<'v> CertificatePart<'v> {
    /// Complaint about this part.
    pub fn complaint<T>(&self, what: &str) -> Result<T, String> {
        let path = match self.path.trim_start_matches('.') {
            "" => "the certificate".to_string(),
            path => format!("`{path}`"),
        };
        Err(format!("{path} {what}"))
    }

    /// Part under a key.
    pub fn at(&self, key: &str) -> Result<CertificatePart<'v>, String> {
        let path = format!("{}.{key}", self.path);
        match self.value.get(key) {
            Some(value) => Ok(CertificatePart { value, path }),
            None => CertificatePart { value: self.value, path }.complaint("is missing"),
        }
    }

    /// Checks that there are no other keys.
    pub fn only(&self, keys: &[&str]) -> Result<(), String> {
        let Some(table) = self.value.as_object() else { return self.complaint("is not a table") };
        match table.keys().find(|key| !keys.contains(&key.as_str())) {
            Some(other) => self.complaint(&format!("has no key `{other}`")),
            None => Ok(()),
        }
    }

    /// Parts of a list.
    pub fn all(&self) -> Result<Vec<CertificatePart<'v>>, String> {
        let Some(all) = self.value.as_array() else { return self.complaint("is not a list") };
        let one =
            |(index, value)| CertificatePart { value, path: format!("{}[{index}]", self.path) };
        Ok(all.iter().enumerate().map(one).collect())
    }

    /// Text of this part.
    pub fn as_text(&self) -> Result<&'v str, String> {
        match self.value.as_str() {
            Some(text) => Ok(text),
            None => self.complaint("is not a text"),
        }
    }

    /// Text under a key.
    pub fn text(&self, key: &str) -> Result<&'v str, String> {
        self.at(key)?.as_text()
    }

    /// Whole number.
    pub fn whole(&self) -> Result<usize, String> {
        match self.value.as_u64().and_then(|n| usize::try_from(n).ok()) {
            Some(number) => Ok(number),
            None => self.complaint("is not a whole number"),
        }
    }

    /// Number in hexadecimal.
    pub fn number(&self) -> Result<f64, String> {
        match read(self.as_text()?) {
            Some(number) => Ok(number),
            None => self.complaint("is not a number in hexadecimal"),
        }
    }

    /// List of numbers in hexadecimal.
    pub fn numbers(&self) -> Result<Vec<f64>, String> {
        self.all()?.iter().map(CertificatePart::number).collect()
    }

    /// Fixed number of numbers in hexadecimal.
    pub fn array<const N: usize>(&self) -> Result<[f64; N], String> {
        match self.numbers()?.try_into() {
            Ok(numbers) => Ok(numbers),
            Err(_) => self.complaint(&format!("has not {N} numbers")),
        }
    }

    /// Fixed number of whole numbers.
    pub fn wholes<const N: usize>(&self) -> Result<[usize; N], String> {
        let all = self.all()?;
        let all = all.iter().map(CertificatePart::whole).collect::<Result<Vec<usize>, _>>()?;
        match all.try_into() {
            Ok(numbers) => Ok(numbers),
            Err(_) => self.complaint(&format!("has not {N} numbers")),
        }
    }

    /// Checks that an enclosure lies in the one stated here.
    pub fn contains(&self, x: Enclosure) -> Result<(), String> {
        let [mid, rad]: [f64; 2] = self.array()?;
        let reach = ((x.mid - mid).abs() + x.rad) * (1.0 + 8.0 * f64::EPSILON);
        match reach <= rad {
            true => Ok(()),
            false => self.complaint("does not contain what the proof encloses"),
        }
    }

    /// Checks that enclosures lie in those of the list here, one by one.
    pub fn contain(&self, all: &[Enclosure]) -> Result<(), String> {
        let stated = self.all()?;
        if stated.len() != all.len() {
            return self.complaint(&format!("has not {} components", all.len()));
        }
        stated.iter().zip(all).try_for_each(|(own, x)| own.contains(*x))
    }
}
