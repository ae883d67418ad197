//! Random levels of two equations that fall apart, with points of them that are known: what is not 0 at one
//! is not proved to be 0, and what is a combination of the equations is not refuted.

use crate::random::draws;
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

pub const NAMES: [&str; 4] = ["x", "y", "z", "w"];
/// Usual number of levels.
const LEVELS: u32 = 30;

/// A sum of monomials with small coefficients.
#[derive(Clone)]
pub struct Polynomial(pub Vec<(i64, [u32; 4])>);

impl Polynomial {
    pub fn value(&self, at: &[i64; 4]) -> i64 {
        let term = |(factor, powers): &(i64, [u32; 4])| {
            at.iter().zip(powers).fold(*factor, |product, (x, power)| product * x.pow(*power))
        };
        self.0.iter().map(term).sum()
    }

    pub fn slope(&self, at: &[i64; 4], along: usize) -> i64 {
        let term = |(factor, powers): &(i64, [u32; 4])| {
            let mut powers = *powers;
            let power = powers[along];
            powers[along] = power.saturating_sub(1);
            (factor * i64::from(power), powers)
        };
        Polynomial(self.0.iter().map(term).collect()).value(at)
    }

    pub fn times(&self, other: &Self) -> Self {
        let product = |(a, p): &(i64, [u32; 4]), (b, q): &(i64, [u32; 4])| {
            (a * b, std::array::from_fn(|k| p[k] + q[k]))
        };
        Self(self.0.iter().flat_map(|a| other.0.iter().map(move |b| product(a, b))).collect())
    }

    pub fn text(&self) -> String {
        let power = |(name, power): (&&str, &u32)| format!("*{name}^{power}");
        let term = |(factor, powers): &(i64, [u32; 4])| {
            format!("({factor}){}", NAMES.iter().zip(powers).map(power).collect::<String>())
        };
        self.0.iter().map(term).collect::<Vec<String>>().join(" + ")
    }
}

/// A reproducible sequence of numbers.
pub struct Draws(pub u64);

impl Draws {
    pub fn below(&mut self, count: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }

    fn factor(&mut self) -> i64 {
        [-2, -1, 1, 1, 2][self.below(5) as usize]
    }

    /// A form of degree 2, or one less a number.
    pub fn polynomial(&mut self) -> Polynomial {
        let mut terms = Vec::new();
        for _ in 0..2 + self.below(3) {
            let mut powers = [0; 4];
            for _ in 0..2 {
                powers[self.below(4) as usize] += 1;
            }
            terms.push((self.factor(), powers));
        }
        if self.below(4) == 0 {
            terms.push((self.factor(), [0; 4]));
        }
        Polynomial(terms)
    }

    /// A linear form.
    pub fn line(&mut self) -> Polynomial {
        let mut terms = Vec::new();
        for _ in 0..1 + self.below(2) {
            let mut powers = [0; 4];
            powers[self.below(4) as usize] = 1;
            terms.push((self.factor(), powers));
        }
        Polynomial(terms)
    }
}

/// Judges s for s' = `rate`, all else at rest, on the level of two equations.
fn verdict(equations: [&str; 2], rate: &str, seed: u64) -> Option<Verdict> {
    let state: String = NAMES.iter().map(|name| format!("{name} = \"-2..2\"\n")).collect();
    let rest: String = NAMES.iter().map(|name| format!("\"{name}'\" = \"0\"\n")).collect();
    let [first, second] = equations;
    let text = format!(
        "title = \"t\"\n[state]\n{state}s = \"-1..1\"\n[field]\n{rest}\"s'\" = \"{rate}\"\n\
         [level]\nequations = [\"{first} = 0\", \"{second} = 0\"]\n\
         [[claim]]\nintegral = \"s\"\nexpect = \"open\"\n"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    match judge(&case, &Options { seed, ..Options::default() }) {
        Ok(report) => Some(report.claims[0].verdict),
        Err(error) => {
            assert!(!error.to_string().contains("are not on it"), "{error}\n{text}");
            None
        }
    }
}

#[test]
fn parts_of_levels_are_on_them_and_none_is_missed() {
    let (mut proved, mut combinations) = (0, 0);
    let levels = draws(LEVELS);
    for index in 0..u64::from(levels) {
        let mut draws = Draws(index + 1);
        let (first, second) = (draws.polynomial(), draws.polynomial());
        let (line, below) = (draws.line(), draws.line());
        // Some equations are products, and some quotients.
        let kind = draws.below(3);
        let (equation, above) = match kind {
            0 => (format!("({})*({})", first.text(), line.text()), first.times(&line)),
            1 => (format!("({})/({})", first.text(), below.text()), first),
            _ => (first.text(), first),
        };
        let equations = [equation.as_str(), &second.text()];
        // A point at which the slopes are independent has points of the level around it.
        let is_regular = |at: &[i64; 4]| {
            let minor = |i: usize, j: usize| {
                above.slope(at, i) * second.slope(at, j) - above.slope(at, j) * second.slope(at, i)
            };
            above.value(at) == 0
                && second.value(at) == 0
                && !(kind == 1 && below.value(at) == 0)
                && (0..4).any(|i| (0..i).any(|j| minor(i, j) != 0))
        };
        let range = || -1..=1;
        let points = range().flat_map(|x| {
            range().flat_map(move |y| range().flat_map(move |z| range().map(move |w| [x, y, z, w])))
        });
        let known: Vec<[i64; 4]> = points.filter(is_regular).collect();
        let rate = draws.line();
        if verdict(equations, &rate.text(), index) == Some(Verdict::Proved) {
            let point = known.iter().find(|at| rate.value(at) != 0);
            assert_eq!(point, None, "({}) is proved to be 0 on {equations:?}", rate.text());
            proved += 1;
        }
        let combined = format!("({equation})*({}) + ({})", line.text(), second.text());
        match verdict(equations, &combined, index) {
            Some(Verdict::Refuted) => panic!("{combined} is refuted on {equations:?}"),
            Some(Verdict::Proved) => combinations += 1,
            _ => {}
        }
    }
    assert!(combinations * 6 > levels, "{proved} and {combinations} of {levels} are proved");
}
