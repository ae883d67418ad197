//! Cofactors of random invariant relations, in space and on levels, against motions from zeros of F.

use crate::stream::Stream;
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

const NAMES: [&str; 3] = ["x", "y", "z"];
const RANGE: f64 = 2.0;

/// Terms of a polynomial: coefficients and powers of x, y, z.
type Terms = &'static [(i64, [u32; 3])];

/// Functions that vanish on curves and surfaces, some tangent to a level.
const FACTORS: &[Terms] = &[
    &[(1, [1, 0, 0])],
    &[(1, [0, 1, 0])],
    &[(1, [0, 0, 1])],
    &[(1, [1, 0, 0]), (-1, [0, 0, 0])],
    &[(1, [0, 1, 0]), (1, [0, 0, 0])],
    &[(1, [1, 0, 0]), (1, [0, 1, 0])],
    &[(1, [1, 0, 0]), (-2, [0, 0, 1])],
    &[(3, [1, 0, 0]), (4, [0, 1, 0]), (-5, [0, 0, 0])],
    &[(1, [1, 1, 0]), (-1, [0, 0, 1])],
    &[(1, [2, 0, 0]), (-1, [0, 0, 1])],
    &[(1, [2, 0, 0]), (1, [0, 0, 2]), (-1, [0, 0, 0])],
    &[(1, [2, 0, 0]), (1, [0, 2, 0])],
    &[(1, [1, 0, 1]), (1, [0, 2, 0])],
    &[(1, [2, 0, 0]), (1, [0, 2, 0]), (1, [0, 0, 0])],
];

/// Left-hand sides of levels E = 0: some have charts, which miss states, others have none.
const LEVELS: &[Terms] = &[
    &[(1, [2, 0, 0]), (1, [0, 2, 0]), (-1, [0, 0, 0])],
    &[(1, [2, 0, 0]), (1, [0, 2, 0]), (1, [0, 0, 2]), (-1, [0, 0, 0])],
    &[(1, [1, 1, 0]), (-1, [0, 0, 1])],
    &[(1, [1, 0, 1]), (-1, [0, 1, 0])],
    &[(1, [1, 1, 0]), (-1, [0, 0, 2])],
    &[(1, [4, 0, 0]), (1, [0, 4, 0]), (1, [0, 0, 4]), (-1, [0, 0, 0])],
    &[(1, [3, 0, 0]), (1, [0, 1, 3]), (1, [1, 1, 0]), (-1, [0, 0, 0])],
];

/// A polynomial with whole coefficients.
#[derive(Clone, Debug, Default)]
struct Polynomial(Vec<(i64, [u32; 3])>);

impl Polynomial {
    fn drawn(stream: &mut Stream, list: &[Terms]) -> Self {
        Self(stream.pick::<Terms>(list).to_vec())
    }

    fn constant(value: i64) -> Self {
        Self(vec![(value, [0; 3])])
    }

    fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0.clone();
        for &(factor, powers) in &other.0 {
            match sum.iter_mut().find(|term| term.1 == powers) {
                Some(term) => term.0 += factor,
                None => sum.push((factor, powers)),
            }
        }
        sum.retain(|term| term.0 != 0);
        Self(sum)
    }

    fn times(&self, other: &Self) -> Self {
        let term = |&(factor, powers): &(i64, [u32; 3])| {
            let one = |term: &(i64, [u32; 3])| {
                (factor * term.0, std::array::from_fn(|axis| powers[axis] + term.1[axis]))
            };
            Self(other.0.iter().map(one).collect())
        };
        self.0.iter().map(term).fold(Self::default(), |sum, term| sum.plus(&term))
    }

    fn gradient(&self) -> [Self; 3] {
        std::array::from_fn(|axis| {
            let lower = |&(factor, mut powers): &(i64, [u32; 3])| {
                let power = powers[axis];
                powers[axis] = power.checked_sub(1)?;
                Some((factor * i64::from(power), powers))
            };
            Self(self.0.iter().filter_map(lower).collect())
        })
    }

    fn at(&self, point: &[f64; 3]) -> f64 {
        let power = |powers: &[u32; 3]| -> f64 {
            (0..3).map(|axis| point[axis].powi(powers[axis] as i32)).product()
        };
        self.0.iter().map(|(factor, powers)| *factor as f64 * power(powers)).sum()
    }

    fn text(&self) -> String {
        let one = |(factor, powers): &(i64, [u32; 3])| {
            let power = |axis: usize| format!("*{}^{}", NAMES[axis], powers[axis]);
            format!("({factor})") + &(0..3).map(power).collect::<String>()
        };
        let terms: Vec<String> = self.0.iter().map(one).collect();
        if terms.is_empty() { "(0*x)".to_owned() } else { format!("({})", terms.join(" + ")) }
    }
}

fn dot(a: &[Polynomial; 3], b: &[Polynomial; 3]) -> Polynomial {
    (0..3)
        .map(|axis| a[axis].times(&b[axis]))
        .fold(Polynomial::default(), |sum, term| sum.plus(&term))
}

fn cross(a: &[Polynomial; 3], b: &[Polynomial; 3]) -> [Polynomial; 3] {
    std::array::from_fn(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        a[i].times(&b[j]).plus(&Polynomial::constant(-1).times(&a[j]).times(&b[i]))
    })
}

/// A field v = numerators/pole with L_vF = HS/pole, for a part H of F or another function.
struct Scene {
    level: Option<Polynomial>,
    function: Polynomial,
    numerators: [Polynomial; 3],
    pole: Polynomial,
    text: String,
}

impl Scene {
    fn draw(stream: &mut Stream) -> Self {
        let factor = |stream: &mut Stream| Polynomial::drawn(stream, FACTORS);
        let level = (!stream.once_in(3)).then(|| Polynomial::drawn(stream, LEVELS));
        let first = factor(stream);
        let second = if stream.once_in(2) { factor(stream) } else { Polynomial::constant(1) };
        let function = first.times(&second);
        let other = factor(stream);
        // H, and the quotient HS/F as S over what is left of F, or as written.
        let one = Polynomial::constant(1);
        let (part, above, below) = match stream.below(4) {
            0 => (other.clone(), other, function.clone()),
            1 => (first, one, second),
            _ => (function.clone(), one.clone(), one),
        };
        let pole = if stream.once_in(3) { factor(stream) } else { Polynomial::constant(1) };
        let along: [Polynomial; 3] = std::array::from_fn(|_| {
            let constant = Polynomial::constant(stream.below(5) as i64 - 2);
            if stream.once_in(2) { constant } else { constant.plus(&factor(stream)) }
        });
        let across = std::array::from_fn(|_| Polynomial::constant(stream.below(3) as i64 - 1));
        let (slopes, gradient) = (level.as_ref().map(Polynomial::gradient), function.gradient());
        let parts: [Polynomial; 3] = std::array::from_fn(|axis| part.times(&along[axis]));
        let (numerators, rate) = match &slopes {
            None => {
                let turning = cross(&gradient, &across);
                let whole = std::array::from_fn(|axis| parts[axis].plus(&turning[axis]));
                (whole, dot(&gradient, &along))
            }
            Some(slopes) => {
                let turning = across[0].clone();
                let sum = |axis: usize| parts[axis].plus(&turning.times(&gradient[axis]));
                (cross(slopes, &std::array::from_fn(sum)), dot(&gradient, &cross(slopes, &along)))
            }
        };
        let (above, below) = match stream.once_in(4) {
            true => (&part, &function),
            false => (&above, &below),
        };
        let cofactor =
            format!("{}*{}/({}*{})", above.text(), rate.text(), below.text(), pole.text());
        let cofactor = match stream.below(4) {
            0 => {
                let factor = factor(stream).text();
                format!("{cofactor}*{factor}/{factor}")
            }
            _ => cofactor,
        };
        let mut text = "title = 'x'\ncheck-weights = false\n[state]\n".to_owned();
        for name in NAMES {
            text += &format!("{name} = '-{RANGE}..{RANGE}'\n");
        }
        if let Some(level) = &level {
            text += &format!("[level]\nequations = ['{} = 0']\n", level.text());
        }
        text += "[field]\n";
        for (name, numerator) in NAMES.iter().zip(&numerators) {
            text += &format!("\"{name}'\" = '{}/{}'\n", numerator.text(), pole.text());
        }
        text += &format!(
            "[[claim]]\ninvariant-relation = '{}'\ncofactor = '{cofactor}'\nexpect = 'open'\n",
            function.text()
        );
        Self { level, function, numerators, pole, text }
    }

    /// Returns a common zero of F and E, if one is found from a random point.
    fn zero(&self, stream: &mut Stream) -> Option<[f64; 3]> {
        let equations: Vec<&Polynomial> =
            [Some(&self.function), self.level.as_ref()].into_iter().flatten().collect();
        let gradients: Vec<[Polynomial; 3]> =
            equations.iter().map(|equation| equation.gradient()).collect();
        let mut point: [f64; 3] = std::array::from_fn(|_| (2.0 * stream.unit() - 1.0) * RANGE);
        for _ in 0..60 {
            for (equation, gradient) in equations.iter().zip(&gradients) {
                let slope: [f64; 3] = std::array::from_fn(|axis| gradient[axis].at(&point));
                let square: f64 = slope.iter().map(|slope| slope * slope).sum();
                let share = equation.at(&point) / square;
                if !share.is_finite() {
                    break;
                }
                point.iter_mut().zip(slope).for_each(|(value, slope)| *value -= share * slope);
            }
        }
        let is_zero = equations.iter().all(|equation| equation.at(&point).abs() < 1e-13);
        let is_inside = point.iter().all(|value| value.abs() <= RANGE);
        (is_zero && is_inside && self.pole.at(&point).abs() > 0.1).then_some(point)
    }

    fn velocity(&self, point: &[f64; 3]) -> [f64; 3] {
        let pole = self.pole.at(point);
        std::array::from_fn(|axis| self.numerators[axis].at(point) / pole)
    }

    /// Returns F after a time, by a step of Runge and Kutta.
    fn later(&self, start: &[f64; 3], time: f64) -> f64 {
        let ahead = |rate: &[f64; 3], time: f64| {
            std::array::from_fn(|axis| start[axis] + time * rate[axis])
        };
        let first = self.velocity(start);
        let second = self.velocity(&ahead(&first, time / 2.0));
        let third = self.velocity(&ahead(&second, time / 2.0));
        let fourth = self.velocity(&ahead(&third, time));
        let mean: [f64; 3] = std::array::from_fn(|axis| {
            (first[axis] + 2.0 * (second[axis] + third[axis]) + fourth[axis]) / 6.0
        });
        self.function.at(&ahead(&mean, time)).abs()
    }

    /// Returns a zero of F from which the motion leaves F = 0.
    fn exit(&self, stream: &mut Stream) -> Option<[f64; 3]> {
        let leaves = |point: &[f64; 3]| {
            let speed =
                self.velocity(point).iter().fold(1.0, |most: f64, rate| most.max(rate.abs()));
            let time = 0.01 / speed;
            // F grows as a low power of the time, and the error of a step as the fifth.
            let (half, whole) = (self.later(point, time / 2.0), self.later(point, time));
            whole > 1e-7 && half > whole / 12.0
        };
        (0..40).filter_map(|_| self.zero(stream)).find(leaves)
    }
}

#[test]
fn no_proved_relation_is_left_by_a_motion() {
    let (mut proved, mut left) = (0, 0);
    let draws = u64::from(crate::random::draws(150));
    for draw in 0..draws {
        let stream = &mut Stream::new(41, draw);
        let scene = Scene::draw(stream);
        let case =
            Case::parse(&scene.text, &[]).unwrap_or_else(|error| panic!("{error}\n{}", scene.text));
        let Ok(report) = judge(&case, &Options::default()) else { continue };
        let claim = &report.claims[0];
        let exit = scene.exit(stream);
        left += u64::from(exit.is_some());
        if claim.verdict == Verdict::Proved {
            proved += 1;
            assert!(exit.is_none(), "draw {draw}: F = 0 is left from {exit:?}\n{}", scene.text);
        }
        if claim.verdict == Verdict::Refuted {
            panic!("draw {draw}: L_vF = κF holds by construction\n{}", scene.text);
        }
    }
    eprintln!("{proved} proved, {left} left");
    assert!(4 * proved > draws && 10 * left > draws, "{proved} proved, {left} left, of {draws}");
}

#[test]
fn a_cofactor_may_divide_by_what_the_field_divides_by() {
    let verdict = |field: &str, factor: &str| {
        let text = format!(
            "title = 'x'\n[state]\nx = '-2..2'\nz = '-2..2'\n[field]\n\"x'\" = '{field}'\n\"z'\" = 'z²'\n[[claim]]\n\
             invariant-relation = 'x'\ncofactor = '{factor}'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("a report").claims[0].verdict
    };
    for below in ["sin(z)", "cos(z)", "√z", "(exp(z) - 1)", "ln(z²)"] {
        let factor = format!("1/{below}");
        assert_eq!(verdict(&format!("x/{below}"), &factor), Verdict::Proved, "{below}");
    }
    assert_ne!(verdict("1", "1/x"), Verdict::Proved, "the motion leaves x = 0");
    assert_ne!(verdict("sin(z)*x/sin(z) + 0/z + 1 - 1*x", "1/x - 1 + 1"), Verdict::Proved);
}

#[test]
fn a_cofactor_without_a_value_at_the_zeros_says_nothing_of_them() {
    let judged = |cofactor: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '-2..2'\n[field]\n\
             x = 'x*(x^2 - 1) + |x^2 - 1| - (x^2 - 1)'\n[[claim]]\ninvariant-relation = 'x'\n\
             cofactor = '{cofactor}'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("judged").claims[0].verdict
    };
    // At x = 0 the field is 2.
    for cofactor in ["√(x^2 - 1)*√(x^2 - 1)", "x^2 - 1 + 0*√(x^2 - 1)"] {
        assert_eq!(judged(cofactor), Verdict::Undecided, "{cofactor}");
    }
    assert_eq!(judged("x^2 - 1"), Verdict::Refuted);
    let text = "title = 't'\n[state]\nx = '-2..2'\n[field]\nx = 'x*√(x^2 + 1)'\n[[claim]]\n\
                invariant-relation = 'x'\ncofactor = '√(2*x^2 + 1 - x^2)'\n";
    let case = Case::parse(text, &[]).expect("a case");
    let found = judge(&case, &Options::default()).expect("judged").claims[0].verdict;
    assert_eq!(found, Verdict::Proved, "the radicand is 1 where x = 0");
}

#[test]
fn a_vector_has_a_matrix_as_cofactor() {
    let judged = |rates: [&str; 3], function: &str, cofactor: &str| {
        let rate = |(name, rate): (&&str, &str)| format!("\"{name}'\" = '{rate}'\n");
        let field: String = NAMES.iter().zip(rates).map(rate).collect();
        let text = format!(
            "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\n[field]\n{field}\
             [[claim]]\ninvariant-relation = '{function}'\ncofactor = '{cofactor}'\nexpect = 'open'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        judge(&case, &Options::default()).expect("judged").claims[0].verdict
    };
    let turned = ["y*z", "3*x - y", "z^2"];
    assert_eq!(judged(turned, "[x, y]", "[[0, z], [3, -1]]"), Verdict::Proved);
    assert_eq!(judged(turned, "[x, y]", "[[0, 3], [z, -1]]"), Verdict::Refuted);
    assert_eq!(judged(["y/z", "x/z", "1"], "[x, y]", "[[0, 1/z], [1/z, 0]]"), Verdict::Proved);
    // x' = 1 leaves x = y = 0, and so does y' = x/y along x = y.
    assert_eq!(judged(["1", "0", "0"], "[x, y]", "[[1/x, 0], [0, 0]]"), Verdict::Undecided);
    assert_eq!(
        judged(["x/y + y/x", "0", "0"], "[x, y]", "[[1/y, 1/x], [0, 0]]"),
        Verdict::Undecided
    );
    // The motion x = 0 passes y = 0, where the field divides by it.
    for (function, cofactor) in [
        ("[x, y]", "[[x/y, 0], [0, 1/y]]"),
        ("[y, y]", "[[1/y, 0], [1/y, 0]]"),
        ("y", "1/y"),
        ("2*y", "1/y"),
    ] {
        let text = format!(
            "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-2..2'\nw = '-2..2'\n[level]\nequations = ['z²+w²=1']\n\
             [field]\nx = 'x²/y'\ny = '1'\nz = 'w'\nw = '-z'\n[[claim]]\ninvariant-relation = '{function}'\n\
             cofactor = '{cofactor}'\nexpect = 'open'\n"
        );
        let case = Case::parse(&text, &[]).expect("a case");
        let found = judge(&case, &Options::default()).expect("judged").claims[0].verdict;
        assert_eq!(found, Verdict::Undecided, "{function}");
    }
    let text = "title = 't'\n[state]\nx = '-2..2'\ny = '-2..2'\n[field]\nx = 'y'\ny = 'x'\n[[claim]]\n\
                invariant-relation = '[x, y]'\ncofactor = '1'\n";
    let error = Case::parse(text, &[]).expect_err("a vector needs a matrix").to_string();
    assert!(error.contains("the cofactor of a vector"), "{error}");
}
