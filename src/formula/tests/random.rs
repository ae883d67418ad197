//! Tests of random formulas against their meaning, and of random texts against panics.

use proptest::prelude::*;

use super::*;

/// Formula of known meaning: its text, its binding strength, its value.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub(super) text: String,
    level: u8,
    value: Value<f64>,
}

const SUM: u8 = 1;
const VECTOR_PRODUCT: u8 = 2;
const PRODUCT: u8 = 3;
const PREFIX: u8 = 4;
const POWER: u8 = 5;
const POSTFIX: u8 = 6;

impl Sample {
    fn new(text: String, level: u8, value: Value<f64>) -> Self {
        Self { text, level, value }
    }

    /// Returns the text, bracketed if it binds less tightly than its place requires.
    fn at(&self, level: u8) -> String {
        if self.level < level { format!("({})", self.text) } else { self.text.clone() }
    }

    fn scalar(&self) -> f64 {
        self.value.scalar().expect("a scalar")
    }

    fn vector(&self) -> Vector3<f64> {
        self.value.vector().expect("a vector")
    }

    fn matrix(&self) -> Matrix3<f64> {
        self.value.matrix().expect("a matrix")
    }
}

fn name(ty: Type) -> impl Strategy<Value = Sample> {
    let names: Vec<&str> =
        NAMES.iter().filter(|(_, its)| *its == ty).map(|(name, _)| *name).collect();
    prop::sample::select(names)
        .prop_map(|name| Sample::new(name.into(), POSTFIX, value_of(symbol(name))))
}

fn number() -> impl Strategy<Value = Sample> {
    (1..400u32).prop_map(|n| {
        let text =
            if n % 4 == 0 { (n / 4).to_string() } else { format!("{:?}", f64::from(n) / 4.0) };
        Sample::new(text, POSTFIX, Value::Scalar(f64::from(n) / 4.0))
    })
}

/// Sum or difference of two samples of one type.
fn sum(a: &Sample, b: &Sample, minus: bool) -> Sample {
    let sign = if minus { '−' } else { '+' };
    let (left, right) = (a.value.components(), b.value.components());
    let entry = |(a, b): (&f64, &f64)| if minus { a - b } else { a + b };
    let sum: Vec<f64> = left.iter().zip(&right).map(entry).collect();
    let text = format!("{} {sign} {}", a.at(SUM), b.at(VECTOR_PRODUCT));
    Sample::new(text, SUM, Value::from_components(a.value.value_type(), &sum))
}

fn negative(a: &Sample) -> Sample {
    Sample::new(format!("-{}", a.at(PREFIX)), PREFIX, a.value.map(|x| -x))
}

fn scaled(a: &Sample, s: &Sample) -> Sample {
    let factor = s.scalar();
    let text = format!("{}*{}", s.at(PRODUCT), a.at(PREFIX));
    Sample::new(text, PRODUCT, a.value.map(|x| factor * x))
}

fn product(a: &Sample, b: &Sample, value: Value<f64>) -> Sample {
    Sample::new(format!("{} * {}", a.at(PRODUCT), b.at(PREFIX)), PRODUCT, value)
}

fn scalar_step(kind: u8, s: &Sample, t: &Sample, v: &Sample, w: &Sample, m: &Sample) -> Sample {
    let (x, y) = (s.scalar(), t.scalar());
    let scalar = |text: String, level: u8, x: f64| Sample::new(text, level, Value::Scalar(x));
    match kind {
        0 => sum(s, t, false),
        1 => sum(s, t, true),
        2 => negative(s),
        3 => product(s, t, Value::Scalar(x * y)),
        // a divisor away from zero
        4 => scalar(
            format!("{}/(1 + {}²)", s.at(PRODUCT), t.at(POSTFIX)),
            PRODUCT,
            x / (1.0 + y * y),
        ),
        5 => scalar(format!("{}^2", s.at(POSTFIX)), POWER, x * x),
        6 => scalar(format!("{}³", s.at(POSTFIX)), POWER, x.powi(3)),
        7 => scalar(format!("√|{}|", s.text), PREFIX, x.abs().sqrt()),
        8 => scalar(format!("sin({})", s.text), POSTFIX, x.sin()),
        9 => scalar(format!("({},{})", v.text, w.text), POSTFIX, v.vector().dot(&w.vector())),
        10 => scalar(format!("|{}|²", v.text), POWER, v.vector().norm_squared()),
        11 => scalar(format!("{}[2]", v.at(POSTFIX)), POSTFIX, v.vector()[1]),
        12 => scalar(format!("{}[3,1]", m.at(POSTFIX)), POSTFIX, m.matrix()[(2, 0)]),
        _ => scalar(format!("tr({})", m.text), POSTFIX, m.matrix().trace()),
    }
}

fn vector_step(kind: u8, s: &Sample, v: &Sample, w: &Sample, m: &Sample) -> Sample {
    let (a, b) = (v.vector(), w.vector());
    match kind {
        0 => sum(v, w, false),
        1 => sum(v, w, true),
        2 => negative(v),
        3 => scaled(v, s),
        4 => product(m, v, Value::Vector(m.matrix() * a)),
        5 => {
            let text = format!("{} × {}", v.at(PRODUCT), w.at(PRODUCT));
            Sample::new(text, VECTOR_PRODUCT, Value::Vector(a.cross(&b)))
        }
        _ => {
            let text = format!("[{}, {}[1], 2]", s.text, v.at(POSTFIX));
            Sample::new(text, POSTFIX, Value::Vector(Vector3::new(s.scalar(), a[0], 2.0)))
        }
    }
}

fn matrix_step(kind: u8, s: &Sample, v: &Sample, w: &Sample, m: &Sample, n: &Sample) -> Sample {
    match kind {
        0 => sum(m, n, true),
        1 => negative(m),
        2 => scaled(m, s),
        3 => product(m, n, Value::Matrix(m.matrix() * n.matrix())),
        4 => {
            let text = format!("{} ⊗ {}", v.at(PRODUCT), w.at(PRODUCT));
            let value = v.vector() * w.vector().transpose();
            Sample::new(text, VECTOR_PRODUCT, Value::Matrix(value))
        }
        5 => {
            let value = m.matrix().transpose();
            Sample::new(format!("{}ᵀ", m.at(POSTFIX)), POSTFIX, Value::Matrix(value))
        }
        _ => {
            let value = Matrix3::from_rows(&[
                v.vector().transpose(),
                w.vector().transpose(),
                v.vector().transpose(),
            ]);
            let text = format!("mat({}, {}, {})", v.text, w.text, v.text);
            Sample::new(text, POSTFIX, Value::Matrix(value))
        }
    }
}

/// Grows a pool of samples by random steps; every later sample may contain earlier ones.
pub(super) fn grown() -> impl Strategy<Value = Sample> {
    let leaves = (
        prop::collection::vec(prop_oneof![name(Type::Scalar), number()], 2..4),
        prop::collection::vec(name(Type::VECTOR), 2..4),
        prop::collection::vec(name(Type::MATRIX), 2..4),
    );
    let steps = prop::collection::vec((0..3u8, 0..14u8, any::<[prop::sample::Index; 6]>()), 1..16);
    (leaves, steps).prop_map(|((mut scalars, mut vectors, mut matrices), steps)| {
        let mut last = scalars[0].clone();
        for (ty, kind, pick) in steps {
            let [s, t] = [0, 1].map(|i| pick[i].get(&scalars).clone());
            let [v, w] = [2, 3].map(|i| pick[i].get(&vectors).clone());
            let [m, n] = [4, 5].map(|i| pick[i].get(&matrices).clone());
            let (pool, sample) = match ty {
                0 => (&mut scalars, scalar_step(kind, &s, &t, &v, &w, &m)),
                1 => (&mut vectors, vector_step(kind % 7, &s, &v, &w, &m)),
                _ => (&mut matrices, matrix_step(kind % 7, &s, &v, &w, &m, &n)),
            };
            let small = sample.value.components().iter().all(|x| x.abs() < 1e6);
            if small && sample.text.len() < 2000 {
                pool.push(sample.clone());
                last = sample;
            }
        }
        last
    })
}

/// Texts over the alphabet of the language, most of them errors.
fn formula_like() -> impl Strategy<Value = String> {
    let pieces = [
        "m",
        "R",
        "γ",
        "γ3",
        "I12",
        "Ĩ",
        "r'",
        "x",
        "2",
        "0.5",
        "1e3",
        "(",
        ")",
        "[",
        "]",
        "|",
        ",",
        "+",
        "−",
        "-",
        "*",
        "/",
        "^",
        "×",
        "⊗",
        "√",
        "ᵀ",
        "²",
        "⁻¹",
        "∫",
        "det",
        "solve",
        "mat",
        "diag",
        "E",
        " ",
        "0",
        "'",
        "_",
        "\u{303}",
        "₃",
        ".",
        "⁻",
        "u",
        "A",
        "P",
        "n",
        "i",
        "sum(i, 1..n, ",
        "vector(i, 1..3, ",
        "matrix(i, 1..2, i, 1..n, ",
        "product(",
        "if(",
        "zero(",
        "..",
        "≠",
        "<",
        "mod",
        "[i]",
        "[i,",
        "max(",
        "atan2(",
        "π",
        "e",
    ];
    let piece = prop::sample::select(pieces.to_vec());
    prop::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

fn check_total(text: &str) {
    match Formula::parse(text, &Names) {
        Ok(formula) => {
            formula.evaluate(&mut value_of);
            let constant = |re: f64| num_dual::Dual::from(re);
            formula.logarithmic_derivative::<f64>(&mut |symbol| value_of(symbol).map(constant));
            // an error of unequal weights is a valid answer
            let _ = formula.check_weights(&mut crate::formula::WeightSystem::new("time"));
        }
        Err(error) => assert!(text.get(error.span()).is_some(), "{error} points into `{text}`"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn formulas_mean_what_they_say(sample in grown()) {
        let formula = Formula::parse(&sample.text, &Names);
        let formula = formula.map_err(|error| TestCaseError::fail(format!("{sample:?}: {error}")))?;
        let value = formula.evaluate(&mut value_of);
        let rounding = sample.value.map(|x| x * (1.0 + 1e-9));
        prop_assert!(close(&value, &sample.value) || close(&value, &rounding), "{value:?}");
    }

    #[test]
    fn any_text_is_answered(text in ".*") {
        check_total(&text);
    }

    #[test]
    fn any_text_like_a_formula_is_answered(text in formula_like()) {
        check_total(&text);
    }
}
