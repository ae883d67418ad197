//! Floating-point numbers in hexadecimal, as C and Python write them.

/// Bits of the mantissa after the point, and the smallest exponent.
const DIGITS: u32 = 13;
const LEAST: i32 = -1022;

/// Writes a finite number, such as `0x1.8000000000000p+1` for 3.
pub fn written(x: f64) -> String {
    let bits = x.to_bits();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    let mantissa = bits & ((1 << 52) - 1);
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let (lead, power) = match (exponent, mantissa) {
        (0, 0) => (0, 0),
        (0, _) => (0, LEAST),
        _ => (1, exponent - 1023),
    };
    let digits = DIGITS as usize;
    format!("{sign}0x{lead}.{mantissa:0digits$x}p{power:+}")
}

/// Reads a number in the form in which it is written, and in no other.
pub fn read(text: &str) -> Option<f64> {
    let (sign, rest) = match text.strip_prefix('-') {
        Some(rest) => (1u64, rest),
        None => (0, text),
    };
    let (lead, rest) = rest.strip_prefix("0x")?.split_once('.')?;
    let (digits, power) = rest.split_once('p')?;
    let mantissa = u64::from_str_radix(digits, 16).ok().filter(|m| *m < 1 << 52)?;
    let power: i32 = power.parse().ok()?;
    let exponent = match (lead, power) {
        ("0", _) => 0,
        ("1", LEAST..=1023) => (power + 1023) as u64,
        _ => return None,
    };
    let x = f64::from_bits(sign << 63 | exponent << 52 | mantissa);
    (x.is_finite() && written(x) == text).then_some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_python_writes_them() {
        for (x, text) in [
            (3.0, "0x1.8000000000000p+1"),
            (-0.1, "-0x1.999999999999ap-4"),
            (0.0, "0x0.0000000000000p+0"),
            (f64::MIN_POSITIVE / 4.0, "0x0.4000000000000p-1022"),
            (f64::MAX, "0x1.fffffffffffffp+1023"),
        ] {
            assert_eq!(written(x), text);
            assert_eq!(read(text), Some(x), "{text}");
        }
    }

    #[test]
    fn other_spellings_are_not_read() {
        for text in [
            "",
            "1.5",
            "0x1.8p+1",
            "0x1.8000000000000p1",
            "0X1.8000000000000p+1",
            "nan",
            "inf",
            "0x1.8000000000000p+1024",
            "0x2.8000000000000p+1",
            "0x1.80000000000000p+1",
            " 0x1.8000000000000p+1",
            "+0x1.8000000000000p+1",
            "0x0.0000000000000p+3",
        ] {
            assert_eq!(read(text), None, "{text}");
        }
    }
}
