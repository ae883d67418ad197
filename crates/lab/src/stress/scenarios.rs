//! Scenarios, each over a case of the catalogue.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::{StressError, read};
use liouville::case::{Case, Setting};

/// Parameters with their values, from x and random numbers in 0..1.
type Setter = fn(&str, &mut dyn FnMut() -> f64) -> Vec<(&'static str, String)>;

/// Part of a case that x enters.
#[derive(Clone, Copy)]
pub enum SweptPart {
    /// x enters the parameters.
    Parameters(Setter),
    /// x enters a formula, at the mark `{x}` of the text.
    Formula,
    /// x enters the chart's draws of the state, by factors of u, v and ω.
    State(fn(f64) -> [f64; 3]),
}

/// A family of cases with one quantity x = 10^exponent that tends to an extreme.
#[derive(Clone, Copy)]
pub struct Scenario {
    /// Name of the scenario.
    pub name: &'static str,
    /// Text of the case.
    pub text: &'static str,
    /// First exponent.
    pub from: i32,
    /// Last exponent.
    pub to: i32,
    /// Part of the case that x enters.
    pub sweep: SweptPart,
}

macro_rules! catalogue {
    ($name:literal) => {
        include_str!(concat!("../../../../cases/", $name, ".toml"))
    };
}

/// A random decimal between two numbers.
fn within(random: &mut dyn FnMut() -> f64, low: f64, high: f64) -> String {
    format!("{:.3}", low + (high - low) * random())
}

fn moments(random: &mut dyn FnMut() -> f64) -> String {
    let [p, q, r] = [0; 3].map(|_| 0.5 + 2.0 * random());
    format!("[{:.3}, {:.3}, {:.3}]", q + r, p + r + 0.01, p + q + 0.02)
}

const NEAR_F2: &str = "
title  = \"F2 with a coefficient that is off by x\"
system = \"rubber-plane\"
[parameters]
m = \"0.5..2\"
R = \"1..3\"
c = \"vector(-0.5..0.5)\"
I = \"inertia(0.5..5)\"
[body]
shape = \"ball\"
[[claim]]
name     = \"F2\"
integral = \"|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)\"
[[claim]]
name     = \"first coefficient\"
integral = \"(1 + {x})*|Ĩ*ω × γ|² − 2*m*R*(γ,c)*(Ĩ*ω,ω)\"
expect   = \"fails\"
[[claim]]
name     = \"second coefficient\"
integral = \"|Ĩ*ω × γ|² − 2*(1 + {x})*m*R*(γ,c)*(Ĩ*ω,ω)\"
expect   = \"fails\"
[[claim]]
name     = \"energy\"
integral = \"(ω,Ĩ*ω)\"
[[claim]]
name     = \"energy with a term\"
integral = \"(ω,Ĩ*ω) + {x}*ω1²\"
expect   = \"fails\"
";

/// All scenarios.
pub const SCENARIOS: [Scenario; 19] = [
    Scenario {
        name: "mass, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -8,
        to: 8,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("m", x.to_string()), ("R", within(random, 1.0, 3.0)), ("I", moments(random))]
        }),
    },
    Scenario {
        name: "c → 0, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -24,
        to: 0,
        sweep: SweptPart::Parameters(|x, random| {
            let exponent = x.trim_start_matches("1e");
            let [a, b, c] = [0; 3].map(|_| within(random, 0.1, 0.5));
            vec![("c", format!("[{a}e{exponent}, -{b}e{exponent}, {c}e{exponent}]"))]
        }),
    },
    Scenario {
        name: "|c| → R, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -15,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            let unit = |n: i32| format!("{n}/13*(1 - {x})");
            let c = format!("[{}, {}, {}]", unit(3), unit(4), unit(12));
            vec![("R", "1".to_string()), ("c", c), ("m", within(random, 0.5, 2.0))]
        }),
    },
    Scenario {
        name: "equal moments, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -18,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            let a = within(random, 1.0, 3.0);
            let moments = format!("[{a}, {a}*(1 + {x}), {a}*(1 - {x})]");
            vec![("I", moments), ("m", within(random, 0.5, 2.0))]
        }),
    },
    Scenario {
        name: "planar inertia, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -15,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            let a = within(random, 1.0, 2.0);
            vec![("I", format!("[{a}, 1.5, ({a} + 1.5)*(1 - {x})]"))]
        }),
    },
    Scenario {
        name: "one axis, ellipsoid with a measure",
        text: catalogue!("plane/ellipsoid-mb-mu"),
        from: -8,
        to: 8,
        sweep: SweptPart::Parameters(|x, random| {
            let b = within(random, 1.5, 3.0);
            vec![("B", format!("diag(vec({x}, {b}, 2))")), ("μ", within(random, 0.5, 3.0))]
        }),
    },
    Scenario {
        name: "mass, ellipsoid with a measure",
        text: catalogue!("plane/ellipsoid-mb-mu"),
        from: -8,
        to: 8,
        sweep: SweptPart::Parameters(|x, random| {
            // Some wrong readings are right for m = 1.
            vec![("m", format!("3*{x}")), ("μ", within(random, 0.5, 3.0))]
        }),
    },
    Scenario {
        name: "off (3.8) by x, ellipsoid",
        text: catalogue!("plane/ellipsoid-near-measure"),
        from: -30,
        to: -2,
        sweep: SweptPart::Parameters(|x, _| vec![("I", format!("[1 + {x}, 1.5, 2]"))]),
    },
    Scenario {
        name: "formulas off by x",
        text: NEAR_F2,
        from: -30,
        to: -2,
        sweep: SweptPart::Formula,
    },
    Scenario {
        name: "kR → −1, balanced ball on a sphere",
        text: catalogue!("sphere/balanced-ball"),
        from: -15,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("R", "1".into()), ("k", format!("-1 + {x}")), ("m", within(random, 0.5, 2.0))]
        }),
    },
    Scenario {
        name: "kR → 1, balanced ball on a sphere",
        text: catalogue!("sphere/balanced-ball"),
        from: -15,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("R", "1".into()), ("k", format!("1 + {x}")), ("m", within(random, 0.5, 2.0))]
        }),
    },
    Scenario {
        name: "k → 0, unbalanced ball on a sphere",
        text: catalogue!("sphere/unbalanced-ball"),
        from: -20,
        to: -1,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("k", x.to_string()), ("m", within(random, 0.5, 2.0))]
        }),
    },
    Scenario {
        name: "k large, ellipsoid on a sphere",
        text: catalogue!("sphere/ellipsoid"),
        from: 0,
        to: 8,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("k", x.to_string()), ("μ", within(random, 3.0, 6.0))]
        }),
    },
    Scenario {
        name: "moment of inertia, disk on a sphere",
        text: catalogue!("sphere/disk"),
        from: -8,
        to: 8,
        sweep: SweptPart::Parameters(|x, random| {
            vec![("μ", x.to_string()), ("k", within(random, 0.1, 0.5))]
        }),
    },
    Scenario {
        name: "γ to a pole, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -15,
        to: 0,
        sweep: SweptPart::State(|x| [x, x, 1.0]),
    },
    Scenario {
        name: "γ to a pole, disk (its edge)",
        text: catalogue!("plane/disk"),
        from: -15,
        to: 0,
        sweep: SweptPart::State(|x| [x, x, 1.0]),
    },
    Scenario {
        name: "γ to a coordinate plane, ellipsoid",
        text: catalogue!("plane/ellipsoid-generic"),
        from: -15,
        to: 0,
        sweep: SweptPart::State(|x| [x, 1.0, 1.0]),
    },
    Scenario {
        name: "|ω|, unbalanced ball",
        text: catalogue!("plane/unbalanced-ball"),
        from: -8,
        to: 8,
        sweep: SweptPart::State(|x| [1.0, 1.0, x]),
    },
    Scenario {
        name: "|ω|, ellipsoid on a sphere",
        text: catalogue!("sphere/ellipsoid"),
        from: -8,
        to: 8,
        sweep: SweptPart::State(|x| [1.0, 1.0, x]),
    },
];

impl Scenario {
    /// Builds the case at x = 10^exponent; the other numbers come from `seed`.
    pub fn case(&self, exponent: i32, seed: u64) -> Result<Case, StressError> {
        let x = format!("1e{exponent}");
        match self.sweep {
            SweptPart::Parameters(make) => {
                let mut stream = ChaCha8Rng::seed_from_u64(seed);
                let mut random = || (stream.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
                let settings: Vec<Setting> = make(&x, &mut random)
                    .into_iter()
                    .map(|(name, value)| Setting { name: name.to_string(), value })
                    .collect();
                read(self.text, &settings)
            }
            SweptPart::Formula => read(&self.text.replace("{x}", &x), &[]),
            SweptPart::State(_) => read(self.text, &[]),
        }
    }

    /// Whether x changes the case, rather than its states.
    pub fn changes_case(&self) -> bool {
        !matches!(self.sweep, SweptPart::State(_))
    }
}
