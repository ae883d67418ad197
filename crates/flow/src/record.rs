//! Numbers in records of motions, read back with the same bits.
//!
//! JSON has no numbers that are infinite or undefined: those are words.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::ser::{Serialize, Serializer};

/// A number of a record.
pub struct Number(f64);

impl Serialize for Number {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self.0.is_finite() {
            true => to.serialize_f64(self.0),
            false => to.collect_str(&self.0),
        }
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(Reader).map(Number)
    }
}

struct Reader;

impl Visitor<'_> for Reader {
    type Value = f64;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a number")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        text.parse().map_err(|_| E::custom(format!("`{text}` is not a number")))
    }
}

/// Values made of numbers.
pub trait Numbers: Sized {
    /// Form in a record.
    type Written: Serialize + for<'de> Deserialize<'de>;

    /// Form of the value in a record.
    fn written(&self) -> Self::Written;

    /// Value of a form.
    fn read(written: Self::Written) -> Self;
}

impl Numbers for f64 {
    type Written = Number;

    fn written(&self) -> Number {
        Number(*self)
    }

    fn read(written: Number) -> Self {
        written.0
    }
}

impl Numbers for Option<f64> {
    type Written = Option<Number>;

    fn written(&self) -> Option<Number> {
        self.map(Number)
    }

    fn read(written: Option<Number>) -> Self {
        written.map(|number| number.0)
    }
}

impl Numbers for [f64; 2] {
    type Written = [Number; 2];

    fn written(&self) -> [Number; 2] {
        self.map(Number)
    }

    fn read(written: [Number; 2]) -> Self {
        written.map(|number| number.0)
    }
}

impl Numbers for Vec<f64> {
    type Written = Vec<Number>;

    fn written(&self) -> Vec<Number> {
        self.iter().copied().map(Number).collect()
    }

    fn read(written: Vec<Number>) -> Self {
        written.into_iter().map(|number| number.0).collect()
    }
}

/// Writes numbers to a record.
pub fn serialize<T: Numbers, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
    value.written().serialize(to)
}

/// Reads numbers of a record.
pub fn deserialize<'de, T: Numbers, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
    T::Written::deserialize(from).map(T::read)
}
