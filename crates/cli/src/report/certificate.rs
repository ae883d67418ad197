//! Certificates of proofs in prime fields, as JSON for docs/certificates/check.py.

use liouville::case::{Case, Expect};
use liouville::graph::{Expr, Graph, Step};
use liouville::number::prime::is_prime;
use liouville::number::{BinaryOperation, UnaryFunction};
use liouville::proof::plain_bounds;
use liouville::verdict::{ClaimReport, Composed, Residuals};
use serde_json::{Map, Value, json};
use sha2::{Digest, Sha256};

use super::sha256;

/// Name and version of the format.
pub const FORMAT: &str = "liouville certificate 1";
/// Numbers of the test: primes, points for each, draws for each.
const PRIMES: usize = 4;
const TEST_POINTS: usize = 2;
const DRAWS: f64 = 64.0;
/// Log₂ of the largest error.
const TARGET: i64 = -100;
/// Log₂ of a lower bound on the number of primes p = 3 mod 4 between 2^60 and 2^61.
const POOL: i32 = 53;
/// Largest integer that is stated as a degree or a height.
const MOST_STATED: f64 = 9e15;

/// Origin of a case: path, text, and the values given to parameters.
pub struct CaseOrigin<'o> {
    /// Path as given.
    pub path: &'o str,
    /// Text of the file.
    pub text: &'o str,
    /// Values given by `--set`.
    pub settings: &'o [String],
}

/// The reason why there is no certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missing {
    /// The residual contains dependent or nested roots, moduli or transcendental functions.
    NotPlain,
    /// The states are not made by a formula, or there are too many listed values.
    NoProgram,
    /// The bounds are too weak, or the residual has no value for some listed values.
    NoBound,
}

/// Makes the certificate of a claim that was proved.
pub fn certificate(
    case: &Case,
    origin: &CaseOrigin<'_>,
    report: &ClaimReport,
    statement: &Residuals,
    seed: u64,
) -> Result<Value, Missing> {
    let mut programs: Vec<Value> = Vec::new();
    let mut bounds: Vec<(f64, f64)> = Vec::new();
    if statement.programs.is_empty() {
        return Err(Missing::NoProgram);
    }
    for composed in &statement.programs {
        let zero = zero(composed).concat();
        if zero.iter().any(|value| composed.graph.is_nowhere_defined(*value)) {
            return Err(Missing::NoBound);
        }
        let bound = plain_bounds(&composed.graph, &zero, seed).ok_or(Missing::NotPlain)?;
        bounds.push(bound);
        programs.push(program(composed));
    }
    let claim = &case.claims[statement.claim];
    let expect = match claim.expect {
        Expect::Holds => "holds",
        Expect::Fails => "fails",
        Expect::Open => "open",
    };
    let statement = json!({
        "case": { "path": origin.path, "sha256": sha256(origin.text), "text": origin.text },
        "settings": origin.settings,
        "claim": {
            "name": claim.name,
            "kind": claim.kind.name(),
            "formula": claim.kind.text(),
            "where": report.place,
            "expect": expect,
            "verdict": report.verdict.word(),
        },
        "programs": programs,
    });
    let evidence = evidence(&statement, &bounds).ok_or(Missing::NoBound)?;
    Ok(json!({ "format": FORMAT, "statement": statement, "evidence": evidence }))
}

/// Values that vanish, by their role.
fn zero(composed: &Composed) -> [Vec<Expr>; 4] {
    [&composed.residual, &composed.quadratures, &composed.level, &composed.level_rates]
        .map(Clone::clone)
}

fn made(composed: &Composed) -> Vec<Expr> {
    let all = composed.parameters.iter().chain(&composed.state);
    all.flat_map(|(_, values)| values.iter().copied()).collect()
}

/// Whether parameters and state are rational functions of the draws.
fn is_made_rationally(composed: &Composed) -> bool {
    let graph = &composed.graph;
    let reached = graph.reached(made(composed));
    let is_rational = |step: Step<'_>| match step {
        Step::Constant(_) | Step::Input(_) => true,
        Step::Unary(function, _) => matches!(function, UnaryFunction::Neg | UnaryFunction::Recip),
        Step::Binary(operation, ..) => operation != BinaryOperation::Pow,
        Step::Power(_, exponent) => exponent.to_integer().is_some(),
    };
    graph.steps().zip(reached).all(|(step, reached)| !reached || is_rational(step))
}

fn program(composed: &Composed) -> Value {
    let graph = &composed.graph;
    let zero = zero(composed);
    let is_shown = is_made_rationally(composed);
    let made = if is_shown { made(composed) } else { Vec::new() };
    let reached = graph.reached([zero.concat(), made].concat());
    let mut places: Vec<usize> = vec![0; graph.len()];
    let mut steps: Vec<Value> = Vec::new();
    for place in (0..graph.len()).filter(|place| reached[*place]) {
        places[place] = steps.len();
        steps.push(step(graph, place, &places));
    }
    let list = |values: &[Expr]| -> Vec<usize> {
        values.iter().map(|value| places[graph.place(*value)]).collect()
    };
    let named = |all: &[(String, Vec<Expr>)]| -> Map<String, Value> {
        let shown = all.iter().filter(|_| is_shown);
        shown.map(|(name, values)| (name.clone(), json!(list(values)))).collect()
    };
    let roles = ["residual", "quadratures", "level", "level rates"];
    let roles = roles.into_iter().zip(&zero).filter(|(_, values)| !values.is_empty());
    let fixed = composed.fixed.iter().map(|(draw, value)| json!([draw, value.to_string()]));
    json!({
        "inputs": graph.inputs(),
        "fixed": fixed.collect::<Vec<Value>>(),
        "parameters": named(&composed.parameters),
        "state": named(&composed.state),
        "steps": steps,
        "zero": roles.map(|(role, values)| (role.to_string(), json!(list(values))))
            .collect::<Map<String, Value>>(),
    })
}

fn step(graph: &Graph, place: usize, places: &[usize]) -> Value {
    match graph.step(place) {
        Step::Constant(value) => {
            let (above, below) = value.parts();
            let text = match below == 1.into() {
                true => above.to_string(),
                false => format!("{above}/{below}"),
            };
            json!(["constant", text])
        }
        Step::Input(input) => json!(["input", input]),
        Step::Unary(UnaryFunction::Neg, a) => json!(["negative", places[a]]),
        Step::Unary(UnaryFunction::Sqrt, a) => json!(["root", places[a]]),
        Step::Unary(_, a) => json!(["reciprocal", places[a]]),
        Step::Binary(BinaryOperation::Add, a, b) => json!(["sum", places[a], places[b]]),
        Step::Binary(BinaryOperation::Sub, a, b) => json!(["difference", places[a], places[b]]),
        Step::Binary(_, a, b) => json!(["product", places[a], places[b]]),
        Step::Power(a, exponent) => {
            json!(["power", places[a], exponent.to_integer().unwrap_or_default()])
        }
    }
}

/// Evidence that the checker derives again; `None` if it would refuse.
fn evidence(statement: &Value, bounds: &[(f64, f64)]) -> Option<Value> {
    let digest = sha256(&canonical(statement));
    let is_small = |(degree, height): &(f64, f64)| *degree < MOST_STATED && *height < MOST_STATED;
    if !bounds.iter().all(is_small) {
        return None;
    }
    // Roots count half.
    let bounds: Vec<(f64, f64)> = bounds.iter().map(|(d, h)| (d.ceil(), h.ceil())).collect();
    let error = |(degree, height): &(f64, f64)| {
        let prime = (height.max(1.0) + 1.0) / 60.0 / 2f64.powi(POOL);
        let points = (DRAWS * degree / 2f64.powi(60)).powi(TEST_POINTS as i32);
        (PRIMES as f64 * (prime + points).log2()).ceil() as i64
    };
    let many = (bounds.len() as f64).log2().ceil() as i64;
    let error = bounds.iter().map(error).max()? + many;
    if error > TARGET {
        return None;
    }
    let whole = |which: fn(&(f64, f64)) -> f64| -> Vec<u64> {
        bounds.iter().map(|bound| which(bound) as u64).collect()
    };
    Some(json!({
        "digest": digest,
        "primes": primes(&digest),
        "points": PRIMES * TEST_POINTS * bounds.len(),
        "degrees": whole(|bound| bound.0),
        "heights": whole(|bound| bound.1),
        "error_log2": error,
    }))
}

/// Primes p = 3 mod 4 between 2^60 and 2^61, from SHA-256 of the digest and a counter.
fn primes(digest: &str) -> Vec<u64> {
    let candidate = |count: u64| {
        let block = Sha256::digest(format!("{digest}:primes:{count}").as_bytes());
        let low = block.iter().fold(0u64, |number, byte| number << 8 | u64::from(*byte));
        1 << 60 | (low & ((1 << 60) - 1)) | 3
    };
    (0..).map(candidate).filter(|number| is_prime(*number)).take(PRIMES).collect()
}

/// JSON without spaces, with sorted keys: the form of which the digest is taken.
pub(super) fn canonical(value: &Value) -> String {
    match value {
        Value::Array(all) => {
            format!("[{}]", all.iter().map(canonical).collect::<Vec<_>>().join(","))
        }
        Value::Object(all) => {
            let mut pairs: Vec<(&String, &Value)> = all.iter().collect();
            pairs.sort_by_key(|(key, _)| *key);
            let pair = |(key, value): (&String, &Value)| {
                format!("{}:{}", Value::from(key.as_str()), canonical(value))
            };
            format!("{{{}}}", pairs.into_iter().map(pair).collect::<Vec<_>>().join(","))
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_does_not_depend_on_the_order_of_keys() {
        let (a, b) = (json!({ "b": [1, "γ\n"], "a": null }), json!({ "a": null, "b": [1, "γ\n"] }));
        let written = "{\"a\":null,\"b\":[1,\"γ\\n\"]}";
        assert_eq!(canonical(&a), written, "sorted, without spaces");
        assert_eq!(canonical(&b), written, "in another order");
    }

    #[test]
    fn primes_follow_from_the_digest() {
        let found = primes("0");
        let is_asked = |p: &u64| is_prime(*p) && p % 4 == 3 && p >> 60 == 1;
        assert!(found.len() == PRIMES && found.iter().all(is_asked), "{found:?}");
        assert_ne!(found, primes("1"), "another digest has others");
    }
}
