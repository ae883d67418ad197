//! Random numbers, tensors and functions for property tests, as text for case files.
//!
//! All numbers are fractions with a prime denominator: generic, short and exact.

#![allow(dead_code, reason = "each test binary uses a part of this")]

use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

/// Number of draws: `LIOUVILLE_DRAWS` times as many as usual.
pub fn draws(usual: u32) -> u32 {
    let times = std::env::var("LIOUVILLE_DRAWS").ok();
    usual * times.map_or(1, |text| text.parse().expect("LIOUVILLE_DRAWS is a number"))
}

/// Returns the settings for `cases` random bodies, the same in every run.
pub fn config(cases: u32) -> Config {
    Config {
        cases: draws(cases),
        rng_seed: RngSeed::Fixed(2013),
        failure_persistence: None,
        max_shrink_iters: 32,
        ..Config::default()
    }
}

/// Draws a fraction between `low` and `high` hundredths.
pub fn number(low: i32, high: i32) -> impl Strategy<Value = String> {
    (low..high).prop_map(|n| format!("{}/10007", n * 100 + 1))
}

/// Draws `count` such fractions.
pub fn numbers(low: i32, high: i32, count: usize) -> impl Strategy<Value = Vec<String>> {
    prop::collection::vec(number(low, high), count)
}

/// Draws a TOML list of three fractions.
pub fn vector(low: i32, high: i32) -> impl Strategy<Value = String> {
    numbers(low, high, 3).prop_map(|x| list(&x))
}

/// Draws a positive symmetric matrix in general position, as TOML rows.
pub fn inertia() -> impl Strategy<Value = String> {
    (numbers(200, 300, 3), numbers(-40, 40, 3)).prop_map(|(d, o)| {
        let row = |a: &str, b: &str, c: &str| list(&[a, b, c]);
        let rows = [row(&d[0], &o[0], &o[1]), row(&o[0], &d[1], &o[2]), row(&o[1], &o[2], &d[2])];
        format!("[{}]", rows.join(", "))
    })
}

/// Draws a smooth convex support function in general position, homogeneous of degree 1.
pub fn support() -> impl Strategy<Value = String> {
    numbers(-20, 20, 7).prop_map(|a| {
        let [b, c, d, e, f, g, h] = [0, 1, 2, 3, 4, 5, 6].map(|k| format!("({})", a[k]));
        format!(
            "√(4*γ1² + 5*γ2² + 6*γ3²) + {b}*γ1 + {c}*γ2 + {d}*γ3 \
             + ({e}*γ1*γ2*γ3 + {f}*γ1³ + {g}*γ2²*γ3)/|γ|² + {h}*γ1*γ2/|γ|"
        )
    })
}

/// Draws a polynomial of degree 3 in one variable, near 2.
pub fn profile() -> impl Strategy<Value = String> {
    numbers(-20, 20, 3).prop_map(|a| format!("2 + ({})*z + ({})*z² + ({})*z³", a[0], a[1], a[2]))
}

/// Draws a polynomial potential in general position.
pub fn potential() -> impl Strategy<Value = String> {
    numbers(-200, 200, 4).prop_map(|a| {
        format!("({})*γ1 + ({})*γ2*γ3 + ({})*γ1*γ2² + ({})*γ3³", a[0], a[1], a[2], a[3])
    })
}

fn list(items: &[impl AsRef<str>]) -> String {
    let quoted: Vec<String> = items.iter().map(|x| format!("\"{}\"", x.as_ref())).collect();
    format!("[{}]", quoted.join(", "))
}
