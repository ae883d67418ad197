//! Brackets of a field with a known Hamiltonian: skew P with v = P ∂H/∂x.
//!
//! The entries of P are sums of c w xᵃ with unknown numbers c, where w is 1, a component of a
//! parameter, or the inverse of one. v = P ∂H is linear in c; constants and low degrees come first, so
//! that the solution that is told is made of them where it can be. Jacobi's identity is quadratic in
//! c: it is asked of this solution, and of others beside it, by the ladder.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{Signed, Zero};

use super::super::ask::{holds, judged, quoted};
use super::super::linear::Functions;
use super::super::series::exponents;
use super::super::terms::{self, Term, integers, read, recorded};
use super::super::{Effort, Excluded, Found, Report, SearchError};
use super::components;
use super::monomials::power_product;
use crate::case::Case;
use crate::formula::Type;
use crate::graph::Expr;
use crate::number::rational::Rational;
use crate::scalar::Scalar;
use crate::verdict::Verdict;

/// The highest degree of the entries of a bracket.
const DEGREE: u32 = 2;
/// State components beyond which brackets have too many entries.
const DIMENSION: usize = 8;
/// Unknowns beyond which the degree is lowered.
const UNKNOWNS: usize = 1500;
/// Solutions of P ∂H = 0 that are added, once with each sign, where Jacobi's identity fails.
const BESIDE: usize = 12;

/// The Hamiltonians for which brackets are looked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hamiltonians {
    /// Every integral that is found, or claimed.
    Known,
    /// This formula.
    Given(String),
}

/// Looks for a bracket for each Hamiltonian.
pub fn brackets(
    case: &Case,
    wanted: &Hamiltonians,
    effort: &Effort,
    report: &mut Report,
    progress: &mut dyn FnMut(&str),
) -> Result<(), SearchError> {
    let model = &case.model;
    let is_matrix = model.state.iter().any(|variable| variable.kind == Type::Matrix);
    if !model.level.is_empty()
        || !model.extension.is_empty()
        || model.dimension() > DIMENSION
        || is_matrix
    {
        report.remark(format!(
            "no bracket is looked for: it takes at most {DIMENSION} variables, none a matrix, and no level set"
        ));
        return Ok(());
    }
    let known: Vec<String> = {
        let claimed = report.claimed.iter().map(|one| one.formula.as_str());
        report.formulas("integral").chain(claimed).map(str::to_string).collect()
    };
    let names = match wanted {
        Hamiltonians::Known => known.clone(),
        Hamiltonians::Given(text) => vec![text.clone()],
    };
    if names.is_empty() {
        report.remark(
            "no bracket is looked for: no integral is known; give a Hamiltonian with --poisson=H"
                .to_string(),
        );
    }
    let weights = weights(case, effort)?;
    for name in names {
        effort.halt.check()?;
        progress(&format!("brackets with the Hamiltonian {name}"));
        let Some(hamiltonian) = read(vec![name.clone()], &model.vocabulary).pop() else {
            return Err(SearchError::NoTerm(name));
        };
        let family = Family::new(case, effort, hamiltonian, weights.clone());
        // What the claims about a bracket cannot read, such as `energy`, is no Hamiltonian here.
        if family.with_bracket(&[]).and_then(|asked| family.reads(&asked)).is_err() {
            report.remark(format!(
                "no bracket is looked for with the Hamiltonian {name}: write it in the state and the parameters alone"
            ));
            continue;
        }
        family.search(&known, report)?;
    }
    Ok(())
}

/// 1, the components of the parameters, and their inverses, less those that depend on others.
fn weights(case: &Case, effort: &Effort) -> Result<Vec<Term>, SearchError> {
    let own: Vec<String> = components(case).into_iter().map(|term| term.text).collect();
    let inverse = own.iter().map(|text| format!("1/{text}"));
    let texts = ["1".to_string()].into_iter().chain(own.iter().cloned()).chain(inverse);
    let all = read(texts.collect(), &case.model.vocabulary);
    let (graph, values) = recorded(case, |jet| {
        all.iter().map(|term| vec![jet.phase.scalar(&term.formula)]).collect::<Vec<_>>()
    })?;
    let mut functions = Functions::new(case, &graph, &values, effort.options.seed)?;
    let defined = functions.defined();
    functions.restrict(&defined);
    let independent = functions.relations()?.independent();
    Ok(independent.into_iter().map(|k| all[defined[k]].clone()).collect())
}

/// An unknown number: that of w xᵃ in P_ij, i < j.
struct Unknown {
    pair: (usize, usize),
    weight: usize,
    exponents: Vec<u32>,
}

/// The brackets for one Hamiltonian.
struct Family<'a> {
    case: &'a Case,
    effort: &'a Effort,
    hamiltonian: Term,
    weights: Vec<Term>,
    /// Names of the state's components.
    names: Vec<String>,
    degree: u32,
    unknowns: Vec<Unknown>,
}

impl<'a> Family<'a> {
    fn new(case: &'a Case, effort: &'a Effort, hamiltonian: Term, weights: Vec<Term>) -> Self {
        let dimension = case.model.dimension();
        let pairs: Vec<(usize, usize)> =
            (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))).collect();
        let unknowns = |degree: u32| -> Vec<Unknown> {
            let mut found = Vec::new();
            for weight in 0..weights.len() {
                for monomial in (0..=degree).flat_map(|total| exponents(dimension, total)) {
                    let one = |pair: &(usize, usize)| Unknown {
                        pair: *pair,
                        weight,
                        exponents: monomial.clone(),
                    };
                    found.extend(pairs.iter().map(one));
                }
            }
            found
        };
        let (mut degree, mut own) = (DEGREE, unknowns(DEGREE));
        while own.len() > UNKNOWNS && degree > 0 {
            degree -= 1;
            own = unknowns(degree);
        }
        let names = (0..dimension).map(|k| case.model.component_name(k)).collect();
        Self { case, effort, hamiltonian, weights, names, degree, unknowns: own }
    }

    fn search(&self, known: &[String], report: &mut Report) -> Result<(), SearchError> {
        let name = &self.hamiltonian.text;
        let (graph, columns) = self.recorded()?;
        let functions = Functions::new(self.case, &graph, &columns, self.effort.options.seed);
        let relations = match functions.and_then(|mut functions| functions.relations()) {
            Err(error @ (SearchError::NoChart | SearchError::NoPoints)) => {
                report.remark(format!("no bracket is looked for with {name}: {error}"));
                return Ok(());
            }
            relations => relations?,
        };
        let (vectors, irrational) = relations.rational();
        // The field is the last column: 1 in the solution, 0 in those of P ∂H = 0.
        let is_solution = |vector: &Vec<Rational>| vector.last().is_some_and(|c| !c.is_zero());
        let (solutions, beside): (Vec<_>, Vec<_>) = vectors.into_iter().partition(is_solution);
        match solutions.first() {
            Some(solution) => self.judge(solution, &beside, known, report),
            None if irrational > 0 => {
                report.remark(format!(
                    "brackets with {name}: their coefficients are no small rational numbers"
                ));
                Ok(())
            }
            None => self.exclude(&beside, report),
        }
    }

    /// The column of each unknown is what it adds to P ∂H; the last is v.
    fn recorded(&self) -> Result<(crate::graph::Graph, Vec<Vec<Expr>>), SearchError> {
        let dimension = self.names.len();
        let zero = || Expr::rational(&Rational::from(0));
        Ok(recorded(self.case, |jet| {
            let state = jet.phase.state().to_vec();
            let slope = |i| jet.phase.lift_along(i).scalar(&self.hamiltonian.formula).eps;
            let slopes: Vec<Expr> = (0..dimension).map(slope).collect();
            let weights: Vec<Expr> =
                self.weights.iter().map(|term| jet.phase.scalar(&term.formula)).collect();
            let column = |unknown: &Unknown| {
                let (i, j) = unknown.pair;
                let powers = state.iter().zip(&unknown.exponents);
                let factors = powers.flat_map(|(x, a)| (0..*a).map(move |_| *x));
                let size = factors.fold(weights[unknown.weight], |product, x| product * x);
                let mut column = vec![zero(); dimension];
                column[i] = size * slopes[j];
                column[j] = -(size * slopes[i]);
                column
            };
            let columns = self.unknowns.iter().map(column);
            columns.chain([jet.phase.field().to_vec()]).collect()
        })?)
    }

    /// Asks for Jacobi's identity, first of the solution, then of it ± solutions of P ∂H = 0.
    fn judge(
        &self,
        solution: &[Rational],
        beside: &[Vec<Rational>],
        known: &[String],
        report: &mut Report,
    ) -> Result<(), SearchError> {
        let model = &self.case.model;
        let name = &self.hamiltonian.text;
        let sum = |a: &Rational, b: &Rational, sign: i64| {
            let ((a, below_a), (b, below_b)) = (a.parts(), b.parts());
            (a * &below_b + b * sign * &below_a, below_a * below_b)
        };
        let shifted = beside.iter().take(BESIDE).flat_map(|other| {
            [1, -1].map(|sign| {
                let pairs = solution.iter().zip(other);
                let parts: Vec<(BigInt, BigInt)> = pairs.map(|(a, b)| sum(a, b, sign)).collect();
                let below = parts.iter().fold(BigInt::from(1), |lcm, (_, own)| lcm.lcm(own));
                parts.iter().map(|(above, own)| above * (&below / own)).collect::<Vec<_>>()
            })
        });
        let mut tried = 0;
        for multiples in [integers(solution)].into_iter().chain(shifted) {
            self.effort.halt.check()?;
            tried += 1;
            let entries = self.entries(&multiples);
            let asked = self.with_bracket(&entries)?;
            let claims = [
                format!("hamiltonian = {}", quoted(name)),
                "jacobi-identity = \"holds\"".to_string(),
            ];
            let reports = judged(&asked, &claims, self.effort)?;
            if !reports.iter().all(holds) {
                continue;
            }
            let mut with = vec![("Hamiltonian", name.clone())];
            for casimir in known.iter().filter(|other| *other != name) {
                if self.is_casimir(&asked, casimir)? {
                    with.push(("Casimir", casimir.clone()));
                }
            }
            // The weaker of the two verdicts.
            let weaker = reports.into_iter().min_by_key(|own| own.verdict == Verdict::Proved);
            if let Some(weaker) = weaker {
                let mut found = Found::new("bracket", &self.shown(&entries), None, weaker, model);
                found.with = with;
                report.found.push(found);
            }
            return Ok(());
        }
        let entries = self.entries(&integers(solution));
        report.remark(format!(
            "v = P ∂H with H = {name} and {}, but this P fails Jacobi's identity, or is not proved; so do {} others of the {}-dimensional family that were tried",
            self.shown(&entries),
            tried - 1,
            beside.len()
        ));
        Ok(())
    }

    /// A theorem, once all that solves P ∂H = 0 modulo the prime is proved to: then the rank of the
    /// unknowns' columns is that modulo the prime, and the rank with v is not below that.
    fn exclude(&self, beside: &[Vec<Rational>], report: &mut Report) -> Result<(), SearchError> {
        let name = &self.hamiltonian.text;
        for vector in beside {
            self.effort.halt.check()?;
            let asked = self.with_bracket(&self.entries(&integers(vector)))?;
            if !self.is_casimir(&asked, name)? {
                report.remark(format!(
                    "no bracket was found with {name}; that there is none is not proved"
                ));
                return Ok(());
            }
        }
        let weights: Vec<&str> = self.weights.iter().map(|term| term.text.as_str()).collect();
        let (degree, weights) = (self.degree, weights.join(", "));
        let coefficients = match weights.as_str() {
            "1" => "numbers as coefficients".to_string(),
            _ => format!(
                "coefficients that are sums, with numbers in front that are the same for all parameters, of {weights}"
            ),
        };
        report.excluded.push(Excluded {
            ansatz: format!(
                "brackets P, polynomials of degree at most {degree} in the state, with the Hamiltonian {name}"
            ),
            dimension: 0,
            known: 0,
            error_log2: None,
            theorem: format!(
                "There is no skew P with v = P ∂H, H = {name}, whose entries are polynomials of degree at most {degree} in the state with {coefficients}."
            ),
        });
        Ok(())
    }

    fn is_casimir(&self, asked: &Case, function: &str) -> Result<bool, SearchError> {
        match judged(asked, &[format!("casimir = {}", quoted(function))], self.effort) {
            // It contains what formulas in the variables of a bracket cannot.
            Err(SearchError::Unreadable(_)) => Ok(false),
            reports => Ok(reports?.iter().any(|own| own.verdict == Verdict::Proved)),
        }
    }

    /// Can the Hamiltonian be read in the variables of a bracket?
    fn reads(&self, asked: &Case) -> Result<(), SearchError> {
        let claim = format!("[[claim]]\ncasimir = {}\n", quoted(&self.hamiltonian.text));
        Ok(asked.ask(&claim).map(|_| ())?)
    }

    /// The entries P_ij, i < j, by rows, as one writes them; the last multiple divides all, unless it is 0.
    fn entries(&self, multiples: &[BigInt]) -> Vec<String> {
        let (field, own) = match multiples.split_last() {
            Some((field, own)) => (field.clone(), own),
            None => (BigInt::ZERO, multiples),
        };
        let below = if field.is_zero() { BigInt::from(-1) } else { field };
        let mut entries = Vec::new();
        let dimension = self.names.len();
        for pair in (0..dimension).flat_map(|i| (i + 1..dimension).map(move |j| (i, j))) {
            let names: Vec<&str> = self.names.iter().map(String::as_str).collect();
            let used = || self.unknowns.iter().zip(own).filter(|(one, _)| one.pair == pair);
            let texts: Vec<String> = used()
                .map(|(one, _)| {
                    let power = power_product(&names, &one.exponents);
                    match (self.weights[one.weight].text.as_str(), power.as_str()) {
                        ("1", _) => power,
                        (weight, "1") => weight.to_string(),
                        (weight, power) => match weight.strip_prefix("1/") {
                            Some(weight) => format!("{power}/{weight}"),
                            None => format!("{weight}*{power}"),
                        },
                    }
                })
                .collect();
            // Σ c P + f v = 0: P is −c/f.
            let common = used().fold(below.clone(), |gcd, (_, a)| gcd.gcd(a));
            let sign = if below.is_negative() { common } else { -common };
            let values: Vec<BigInt> = used().map(|(_, a)| a / &sign).collect();
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let above = terms::written(&values, &texts);
            let divisor = (&below / &sign).abs();
            entries.push(match (above.is_empty(), divisor == 1.into()) {
                (true, _) => "0".to_string(),
                (_, true) => above,
                _ => format!("({above})/{divisor}"),
            });
        }
        entries
    }

    /// `{x,y} = x*y`: the entries that are not 0.
    fn shown(&self, entries: &[String]) -> String {
        let names = &self.names;
        let pairs = (0..names.len()).flat_map(|i| (i + 1..names.len()).map(move |j| (i, j)));
        let nonzero = pairs.zip(entries).filter(|(_, entry)| *entry != "0");
        let one = |((i, j), entry): ((usize, usize), &String)| {
            format!("{{{},{}}} = {entry}", names[i], names[j])
        };
        nonzero.map(one).collect::<Vec<_>>().join(", ")
    }

    /// The case with a bracket in its own state; without entries, one that is 0.
    fn with_bracket(&self, entries: &[String]) -> Result<Case, SearchError> {
        let state = &self.case.model.state;
        let count = self.names.len();
        let entry = |i: usize, j: usize| -> String {
            let (low, high) = (i.min(j), i.max(j));
            // Rows above stand before: row k has count − 1 − k entries.
            let place =
                (0..low).map(|k| count - 1 - k).sum::<usize>() + high.saturating_sub(low + 1);
            let text = entries.get(place).map_or("0", String::as_str);
            match i < j {
                true => text.to_string(),
                false => format!("−({text})"),
            }
        };
        let list = |row: Vec<String>| format!("[{}]", row.join(", "));
        let mut text = "[variables]\n".to_string();
        for variable in state {
            text += &format!("{} = {}\n", quoted(&variable.name), quoted(&variable.name));
        }
        text += "[poisson]\n";
        let starts = state.iter().scan(0, |start, variable| {
            let own = *start;
            *start += variable.len();
            Some((variable, own))
        });
        let starts: Vec<_> = starts.collect();
        for (index, (a, i)) in starts.iter().enumerate() {
            for (b, j) in &starts[index..] {
                let block = match (a.kind, b.kind) {
                    (Type::Scalar, Type::Scalar) if i == j => continue,
                    (Type::Scalar, Type::Scalar) => entry(*i, *j),
                    (Type::Scalar, _) => list((0..3).map(|k| entry(*i, j + k)).collect()),
                    (_, Type::Scalar) => list((0..3).map(|k| entry(i + k, *j)).collect()),
                    // hat(u) has −u₃, u₂, −u₁ above its diagonal.
                    _ if i == j => {
                        let axis = vec![entry(i + 2, i + 1), entry(*i, i + 2), entry(i + 1, *i)];
                        format!("hat({})", list(axis))
                    }
                    _ => {
                        let row = |k: usize| list((0..3).map(|l| entry(i + k, j + l)).collect());
                        let (first, second, third) = (row(0), row(1), row(2));
                        format!("[1,0,0] ⊗ {first} + [0,1,0] ⊗ {second} + [0,0,1] ⊗ {third}")
                    }
                };
                let key = format!("{},{}", a.name, b.name);
                text += &format!("{} = {}\n", quoted(&key), quoted(&block));
            }
        }
        Ok(self.case.ask(&text)?)
    }
}
