//! Plants: systems made around an invariant, in coordinates drawn at random, that no theorem of a search
//! excludes.
//!
//! Twenty have one of each kind; `LIOUVILLE_PLANTS` sets their number, `LIOUVILLE_FIRST_PLANT` the first of them. Each depends on its
//! number alone.

use std::fmt::Write as _;

use liouville::case::Case;
use liouville::claim::Claim;
use liouville::formula::Formula;
use liouville::verdict::{Options, Verdict};
use liouville_search::{Effort, FoundKind, SearchReport, search};

/// A system with an invariant.
struct Plant {
    text: String,
    /// An integral, with its degrees as a fraction and as a polynomial in the velocities.
    integral: Option<(String, [u32; 2])>,
    /// An invariant line: x on it, as a function of y.
    line: Option<String>,
}

impl Plant {
    fn with_integral(text: String, integral: String, degrees: [u32; 2]) -> Self {
        Self { text, integral: Some((integral, degrees)), line: None }
    }
}

/// Pseudo-random integers.
struct Numbers(u64);

impl Numbers {
    fn of(plant: u64) -> Self {
        let mut numbers = Self(plant.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x5851_f42d);
        (0..8).for_each(|_| _ = numbers.next());
        numbers
    }

    /// Returns the next one of −4..=4.
    fn next(&mut self) -> i64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as i64 % 9 - 4
    }

    fn list<const N: usize>(&mut self) -> [i64; N] {
        std::array::from_fn(|_| self.next())
    }

    /// Draws a regular matrix and its determinant.
    fn coordinates(&mut self) -> ([i64; 4], i64) {
        loop {
            let own @ [a, b, c, d] = self.list();
            if a * d != b * c {
                return (own, a * d - b * c);
            }
        }
    }
}

/// Polynomial in x and y with the coefficients of 1, x, y, x², xy, y², and its two slopes.
fn planar([one, x, y, xx, xy, yy]: [i64; 6]) -> [String; 3] {
    [
        format!("(({one}) + ({x})*x + ({y})*y + ({xx})*x² + ({xy})*x*y + ({yy})*y²)"),
        format!("(({x}) + ({})*x + ({xy})*y)", 2 * xx),
        format!("(({y}) + ({xy})*x + ({})*y)", 2 * yy),
    ]
}

/// Linear form in x, y, z.
fn form([x, y, z]: [i64; 3]) -> String {
    format!("(({x})*x + ({y})*y + ({z})*z)")
}

/// A field or map in x, y and z.
fn system(table: &str, parameters: &str, rates: &[String]) -> String {
    let mut text = format!("title = 'x'\n[parameters]\n{parameters}[state]\n");
    let names = ["x", "y", "z"].iter().zip(rates);
    names.clone().for_each(|(name, _)| text.push_str(&format!("{name} = '0.5..2'\n")));
    let _ = writeln!(text, "[{table}]");
    let prime = if table == "field" { "'" } else { "" };
    names.for_each(|(name, rate)| text.push_str(&format!("\"{name}{prime}\" = '{rate}'\n")));
    text
}

/// The field (F_y, −F_x) B² of a fraction F = A/B.
fn planar_fraction(above: [i64; 6], below: [i64; 6], has_parameter: bool) -> Plant {
    let ([a, ax, ay], [b, bx, by]) = (planar(above), planar(below));
    let (a, ax) = match has_parameter {
        true => (format!("({a} + k*x)"), format!("({ax} + k)")),
        false => (a, ax),
    };
    let rates = [format!("{b}*{ay} − {a}*{by}"), format!("{a}*{bx} − {b}*{ax}")];
    let parameters = if has_parameter { "k = '0.5..2'\n" } else { "" };
    Plant::with_integral(system("field", parameters, &rates), format!("{a}/{b}"), [2; 2])
}

/// The field ∇F × w B² in space of a fraction F = A/B; it keeps a linear form as well.
fn spatial_fraction(numbers: &mut Numbers) -> Plant {
    let [a, b, c, w] = [(); 4].map(|()| numbers.list::<3>());
    let (above, third) = (format!("({} + {})", form(a), numbers.next()), form(c));
    let below = format!("({} + 1)", form(b));
    let slope = |k: usize| {
        format!("({below}*(({})*{third} + ({})*{above}) − {above}*{third}*({}))", a[k], c[k], b[k])
    };
    let rates = [[1, 2], [2, 0], [0, 1]]
        .map(|[i, j]| format!("{}*({}) − {}*({})", slope(i), w[j], slope(j), w[i]));
    Plant::with_integral(system("field", "", &rates), format!("{above}*{third}/{below}"), [2; 2])
}

/// A field for which X = l(x, y) + c has the rate K X, and another form any rate.
fn invariant_line(numbers: &mut Numbers) -> Plant {
    let ([mut a, b, mut c, d], _) = numbers.coordinates();
    if a == 0 {
        (a, c) = (a + b, c + d);
    }
    let determinant = a * d - b * c;
    let one = numbers.next();
    let [k0, k1, k2] = numbers.list();
    let first = format!("(({a})*x + ({b})*y + ({one}))*(({k0}) + ({k1})*x + ({k2})*y)");
    let [second, ..] = planar(numbers.list());
    let rates = [
        format!("(({d})*{first} − ({b})*{second})/({determinant})"),
        format!("(({a})*{second} − ({c})*{first})/({determinant})"),
    ];
    let line = format!("((−({b})*y − ({one}))/({a}))");
    Plant { text: system("field", "", &rates), integral: None, line: Some(line) }
}

/// The map X ↦ X (1 + X Y), Y ↦ Y/(1 + X Y) in other coordinates; it keeps X Y.
fn map(numbers: &mut Numbers) -> Plant {
    let ([a, b, c, d], determinant) = numbers.coordinates();
    let [x, y] = [form([a, b, 0]), form([c, d, 0])].map(|own| own.replace(" + (0)*z", ""));
    let (first, second) = (format!("{x}*(1 + {x}*{y})"), format!("{y}/(1 + {x}*{y})"));
    let images = [
        format!("(({d})*{first} − ({b})*{second})/({determinant})"),
        format!("(({a})*{second} − ({c})*{first})/({determinant})"),
    ];
    Plant::with_integral(system("map", "", &images), format!("{x}*{y}"), [2; 2])
}

/// A particle with a potential that separates in other coordinates, X²/2 + f(X) being an integral.
fn separable(numbers: &mut Numbers) -> Plant {
    let ([a, b, c, d], _) = numbers.coordinates();
    let (x, y) = (format!("(({a})*x + ({b})*y)"), format!("(({c})*x + ({d})*y)"));
    let speeds = [&x, &y].map(|own| own.replace("*x", "*x'").replace("*y", "*y'"));
    let part = |own: &str, [p, q, r, s]: [i64; 4]| {
        format!("(({p})*{own} + ({q})*{own}² + ({r})*{own}³ + ({s})*{own}^4)")
    };
    let (f, g) = (part(&x, numbers.list()), part(&y, numbers.list()));
    let text = format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\"x'\" = '0.5..2'\n\
         \"y'\" = '0.5..2'\n[lagrangian]\nkinetic = \"({}² + {}²)/2\"\npotential = '{f} + {g}'\n",
        speeds[0], speeds[1]
    );
    Plant::with_integral(text, format!("{}²/2 + {f}", speeds[0]), [4, 2])
}

fn plant(number: u64) -> Plant {
    let mut numbers = Numbers::of(number);
    let linear = |[a, b, c]: [i64; 3]| [a, b, c, 0, 0, 0];
    // Kinds whose search takes longer are fewer.
    match number % 20 {
        0..=4 => planar_fraction(numbers.list(), linear(numbers.list()), false),
        5..=8 => planar_fraction(numbers.list(), linear(numbers.list()), true),
        9..=12 => spatial_fraction(&mut numbers),
        13..=16 => map(&mut numbers),
        17 => planar_fraction(numbers.list(), numbers.list(), false),
        18 => invariant_line(&mut numbers),
        _ => separable(&mut numbers),
    }
}

/// Degree at the end of the words on what was examined.
fn last_degree(words: &str) -> Option<u32> {
    words.split([' ', ',']).rev().find_map(|word| word.parse().ok())
}

/// Faults of the theorems about a plant.
fn mistakes(case: &Case, plant: &Plant, report: &SearchReport) -> Vec<String> {
    let mut wrong = Vec::new();
    let is_proved = |claim: Claim| {
        let judged = case.judge(&[claim], &Options::default()).expect("it can be judged");
        judged.claims[0].verdict == Verdict::Proved
    };
    let formula = |text: &str| case.formula(text).expect("a formula");
    for own in &report.excluded {
        let reached = last_degree(&own.ansatz).unwrap_or(u32::MAX);
        let degree = |[fraction, speeds]: &[u32; 2]| match own.ansatz.as_str() {
            ansatz if ansatz.starts_with("fractions") => Some(*fraction),
            ansatz if ansatz.starts_with("polynomials in the velocities of degree") => {
                Some(*speeds)
            }
            _ => None,
        };
        if let Some((integral, degrees)) = &plant.integral
            && degree(degrees).is_some_and(|degree| reached >= degree)
        {
            // Integrals that the theorem names are those found, and the energy.
            let named =
                report.functions(FoundKind::Integral).filter(|f| own.theorem.contains(f.text()));
            let energy = own.theorem.contains("energy").then(|| formula("energy"));
            let all: Vec<Formula> =
                named.cloned().chain(energy).chain([formula(integral)]).collect();
            let is_new = match all.len() {
                1 => !is_proved(Claim::identity(&formula(integral), &formula("0*x"))),
                _ => is_proved(Claim::independent(all)),
            };
            if is_new {
                wrong.push(format!("{integral} is excluded: {}", own.theorem));
            }
        }
        if let Some(line) = &plant.line
            && own.ansatz.starts_with("Darboux polynomials")
            && reached >= 1
        {
            let factors: Vec<String> = (report.found.iter())
                .filter(|found| own.theorem.contains(found.text()))
                .map(|found| format!("({})", found.text().replace('x', line)))
                .collect();
            let product = factors.iter().fold("1".to_string(), |all, one| format!("{all}*{one}"));
            if !is_proved(Claim::identity(&formula(&product), &formula("0*x"))) {
                wrong.push(format!("x = {line} is excluded: {}", own.theorem));
            }
        }
    }
    wrong
}

#[test]
fn planted_invariants_are_never_excluded() {
    let number = |name| std::env::var(name).ok().and_then(|text: String| text.parse().ok());
    let count: u64 = number("LIOUVILLE_PLANTS").unwrap_or(8);
    let first: u64 = number("LIOUVILLE_FIRST_PLANT").unwrap_or(0);
    let (mut searched, mut theorems) = (0, 0);
    for place in first..first + count {
        let plant = plant(place);
        // A field that is 0, or has no energy, is no case.
        let Ok(case) = Case::parse(&plant.text, &[]) else { continue };
        let Ok(report) = search(&case, &Effort::default(), &mut |_| {}) else { continue };
        let wrong = mistakes(&case, &plant, &report);
        assert!(wrong.is_empty(), "plant {place}: {wrong:?}\n{}", plant.text);
        (searched, theorems) = (searched + 1, theorems + report.excluded.len());
        if count > 1000 && place % 1000 == 999 {
            println!("{} plants: {searched} searched, {theorems} theorems", place + 1 - first);
        }
    }
    assert!(searched * 10 > count * 9, "{searched} of {count} plants are cases");
    assert!(theorems > 0, "some theorems are stated");
}
