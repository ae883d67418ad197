//! Origin of a report: the version of the program, and a digest of the case.

use std::fmt::{self, Write};

use serde::Serialize;
use serde_json::{Map, Value};
use sha2::{Digest as _, Sha256};

/// Version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// SHA-256 of a text in hexadecimal digits.
pub fn sha256(text: &str) -> String {
    let mut digits = String::new();
    for byte in Sha256::digest(text.as_bytes()) {
        // a `String` takes all that is written to it
        _ = write!(digits, "{byte:02x}");
    }
    digits
}

/// SHA-256 of the text of a case, in hexadecimal digits.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct CaseDigest(String);

impl CaseDigest {
    /// Digest of a text.
    pub fn of(text: &str) -> Self {
        Self(format!("sha256:{}", sha256(text)))
    }

    /// One line with the version and the digest.
    pub fn line(&self) -> String {
        format!("liouville {VERSION}, case {self}")
    }

    /// Puts version and digest at the head of a JSON object.
    pub fn sign(&self, json: &str) -> Result<String, serde_json::Error> {
        let object: Map<String, Value> = serde_json::from_str(json)?;
        let mut signed = Map::new();
        signed.insert("version".to_string(), VERSION.into());
        signed.insert("digest".to_string(), self.0.clone().into());
        signed.extend(object);
        serde_json::to_string_pretty(&signed)
    }
}

impl fmt::Display for CaseDigest {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digests_are_those_of_sha256sum() {
        let empty = "sha256:e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(CaseDigest::of("").to_string(), empty);
        let signed = CaseDigest::of("").sign("{\"title\": \"x\"}").expect("an object");
        let order: Vec<usize> =
            ["version", "digest", "title"].iter().filter_map(|key| signed.find(key)).collect();
        assert!(order.len() == 3 && order.is_sorted(), "{signed}");
    }
}
