//! Tests of the whole language, over one small scope.

mod compose;
mod errors;
mod forms;
mod language;
mod layout;
mod logarithm;
mod partial;
mod random;
mod weights;

use nalgebra::{Matrix3, Vector3};

use super::{Formula, FormulaError, Scope, Symbol, Type, Value};

/// Names used in the tests.
const NAMES: [(&str, Type); 18] = [
    ("m", Type::Scalar),
    ("R", Type::Scalar),
    ("k", Type::Scalar),
    ("x", Type::Scalar),
    ("y", Type::Scalar),
    ("g1", Type::Scalar),
    ("γ", Type::VECTOR),
    ("ω", Type::VECTOR),
    ("c", Type::VECTOR),
    ("r'", Type::VECTOR),
    ("I", Type::MATRIX),
    ("Ĩ", Type::MATRIX),
    ("B", Type::MATRIX),
    ("u", Type::Vector(4)),
    ("v", Type::Vector(4)),
    ("A", Type::Matrix(4, 4)),
    ("P", Type::Matrix(2, 4)),
    ("n", Type::Scalar),
];

struct Names;

impl Scope for Names {
    fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
        let place = NAMES.iter().position(|(known, _)| *known == name)?;
        Some((Symbol(place as u32), NAMES[place].1))
    }

    fn names(&self) -> Vec<String> {
        NAMES.iter().map(|(name, _)| name.to_string()).collect()
    }

    fn whole_number(&self, name: &str) -> Option<i64> {
        (name == "n").then_some(4)
    }
}

fn symbol(name: &str) -> Symbol {
    Names.lookup(name).expect("a name of the tests").0
}

/// Positive values, all different.
fn value_of(Symbol(number): Symbol) -> Value<f64> {
    let place = number as usize;
    let entry = |i: usize| 0.5 + 0.37 * ((7 * place + 3 * i + i * i * place) % 11) as f64;
    match NAMES[place].1 {
        Type::Scalar if NAMES[place].0 == "n" => Value::Scalar(4.0),
        Type::Scalar => Value::Scalar(entry(0) + 0.25 * place as f64),
        Type::VECTOR => Value::Vector(Vector3::from_fn(|i, _| entry(i))),
        Type::MATRIX => Value::Matrix(Matrix3::from_fn(|i, j| {
            entry(i + 2 * j) + if i == j { 6.0 } else { 0.0 }
        })),
        other => {
            let components: Vec<f64> = (0..other.size()).map(entry).collect();
            Value::from_components(other, &components)
        }
    }
}

fn scalar_of(name: &str) -> f64 {
    value_of(symbol(name)).scalar().expect("a scalar")
}

fn vector_of(name: &str) -> Vector3<f64> {
    value_of(symbol(name)).vector().expect("a vector")
}

fn matrix_of(name: &str) -> Matrix3<f64> {
    value_of(symbol(name)).matrix().expect("a matrix")
}

fn read(text: &str) -> Formula {
    Formula::parse(text, &Names).unwrap_or_else(|error| panic!("`{text}`: {error}"))
}

fn refuse(text: &str) -> FormulaError {
    match Formula::parse(text, &Names) {
        Ok(formula) => panic!("`{text}` reads as a {}", formula.value_type()),
        Err(error) => error,
    }
}

fn evaluate(text: &str) -> Value<f64> {
    read(text).evaluate(&mut value_of)
}

/// Whether two values agree up to rounding.
fn close(a: &Value<f64>, b: &Value<f64>) -> bool {
    let (a, b) = (a.components(), b.components());
    let size = b.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= 1e-9 * size)
}

/// Runs a test of formulas that nest: frames that are not optimised are too large for the stack of a test.
fn on_a_large_stack(test: impl FnOnce() + Send + 'static) {
    let thread = std::thread::Builder::new().stack_size(16 << 20).spawn(test).expect("a thread");
    if let Err(panic) = thread.join() {
        std::panic::resume_unwind(panic);
    }
}
