//! Fixed points on the level, of a flow or a map, with the spectrum of the linear part.

use num_dual::Dual;

use super::boxes::{Boxes, multiple_text};
use super::clock::never_rests;
use super::components::Components;
use super::elsewhere::{inside, level_at, system_at_point};
use super::point::read_point;
use super::statement::Objection;
use super::{ComplexFormula, Reader, Statement, ValueShape, difference};
use crate::formula::{Formula, Layout, Type};
use crate::graph::{Evaluator, Expr, Tape, record};
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::characteristic_polynomial;
use crate::mechanics::{Model, Phase};
use crate::number::arb::{Approximation, ArbBall};
use crate::scalar::Scalar;

/// The claim that the field vanishes at a point, and that its linear part there has given
/// eigenvalues, the others being 0, or a given characteristic polynomial.
#[derive(Clone, Debug)]
pub struct FixedPoint {
    point: Components,
    spectrum: Option<Vec<ComplexFormula>>,
    /// Coefficients of λ^(n-1), …, 1.
    polynomial: Option<Vec<Formula>>,
}

impl Statement for FixedPoint {
    const NAME: &'static str = "fixed-point";
    const COMPANIONS: &'static [&'static str] = &["spectrum", "characteristic-polynomial"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[
        (Self::NAME, ValueShape::Table),
        ("spectrum", ValueShape::List),
        ("characteristic-polynomial", ValueShape::List),
    ];
    const WIDENS: bool = false;
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let model = from.model();
        let point = read_point(from, Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let spectrum = from.complex_list("spectrum")?;
        let count = |(_, imaginary): &ComplexFormula| if imaginary.is_some() { 2 } else { 1 };
        let eigenvalues: usize = spectrum.iter().flatten().map(count).sum();
        // Where time is a variable nothing rests, which is the mistake to tell.
        let never_rests = |model: &Model| never_rests(model, Self::NAME).is_some();
        let has_rests = !from.complete_model().is_some_and(never_rests);
        if eigenvalues > model.dimension() && has_rests {
            let message = format!("{eigenvalues} eigenvalues are too many");
            let remedy = "list the nonzero eigenvalues, each with its multiplicity";
            return Err(from.complaint("spectrum", message, remedy));
        }
        let parts = spectrum.iter().flatten().flat_map(|(a, b)| [a].into_iter().chain(b));
        if parts.into_iter().any(|formula| model.has_antiderivative(formula)) {
            let message = "an eigenvalue cannot contain ∫, whose constant is open".to_string();
            return Err(from.complaint("spectrum", message, "write the antiderivative out"));
        }
        Ok(Self { point, spectrum, polynomial: read_polynomial(from, has_rests)? })
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        if self.polynomial.is_some() {
            return None;
        }
        let value = |(real, imaginary): &ComplexFormula| match imaginary {
            None => boxes.formula(real),
            Some(imaginary) => {
                let i = Layout::name("i", Type::Scalar);
                let mut row = match real.text().trim() {
                    "0" => Vec::new(),
                    _ => vec![boxes.formula(real)],
                };
                row.push(Layout::Sign("±"));
                match imaginary.text().trim() {
                    "1" => row.push(i),
                    _ => row.extend([boxes.product(imaginary), Layout::Space, i]),
                }
                Layout::Row(row)
            }
        };
        let spectrum = self.spectrum.as_ref().map(|own| {
            Layout::equation(Layout::name("λ", Type::Scalar), Layout::listed(own.iter().map(value)))
        });
        Some(Layout::listed([boxes.point(&self.point)].into_iter().chain(spectrum)))
    }

    fn particulars(&self) -> Option<String> {
        let place = match self.point.text.is_empty() {
            true => "at 0".to_string(),
            false => format!("at {}", self.point.text),
        };
        let value = |(real, imaginary): &ComplexFormula| match imaginary {
            None => real.text().trim().to_string(),
            Some(imaginary) => {
                let real = match real.text().trim() {
                    "0" => String::new(),
                    real => format!("{real} "),
                };
                format!("{real}± {}", multiple_text(imaginary, "i"))
            }
        };
        let spectrum = self.spectrum.as_ref().map(|own| {
            format!("spectrum {}", own.iter().map(value).collect::<Vec<_>>().join(", "))
        });
        let polynomial = self.polynomial.as_ref().map(|own| {
            let all: Vec<&str> = own.iter().map(|one| one.text().trim()).collect();
            format!("characteristic polynomial with the coefficients {}", all.join(", "))
        });
        let parts = [Some(place), spectrum, polynomial];
        Some(parts.into_iter().flatten().collect::<Vec<_>>().join("; "))
    }

    fn remark_on_refutation(&self, model: &Model) -> Option<String> {
        if self.spectrum.is_none() && self.polynomial.is_none() {
            return None;
        }
        let across = (!model.level.is_empty()).then(|| {
            "the linear part is that in all of phase space: its eigenvalues across the level belong \
             to the spectrum, as a does for z' = a*z on z = 0"
                .to_string()
        });
        let parts: Vec<String> = self.half_at_fault(model).into_iter().chain(across).collect();
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        never_rests(model, Self::NAME)
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let mut values = self.point.written(&jet.phase);
        let at = jet.phase.with(&[], &self.point.at(&jet.phase));
        let eigenvalues = self.spectrum.iter().flatten();
        let parts = eigenvalues.flat_map(|(real, imaginary)| [real].into_iter().chain(imaginary));
        values.extend(at.literal_values(parts.chain(self.polynomial.iter().flatten())));
        values
    }

    fn presence(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Expr> {
        let at = jet.phase.with(&[], &self.point.at(&jet.phase));
        let written = system_at_point(&at);
        let mut values = match self.spectrum.is_some() || self.polynomial.is_some() {
            true => inside(written),
            false => written,
        };
        values.extend(level_at(&at, kept));
        values
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let (state, at) = self.resting(jet);
        let mut residual = resting_values(&at, &state);
        residual.extend(jet.level_at(&at, kept));
        if self.spectrum.is_none() && self.polynomial.is_none() {
            return residual;
        }
        let found = linear_part(&at, state.len());
        if let Some(spectrum) = &self.spectrum {
            let value = |(real, imaginary): &ComplexFormula| {
                (at.scalar(real), imaginary.as_ref().map(|part| at.scalar(part)))
            };
            let eigenvalues: Vec<(T, Option<T>)> = spectrum.iter().map(value).collect();
            let claimed = coefficients(&eigenvalues, state.len());
            residual.extend(difference(found.clone(), claimed));
        }
        if let Some(polynomial) = &self.polynomial {
            let claimed = polynomial.iter().map(|formula| at.scalar(formula)).collect();
            residual.extend(difference(found, claimed));
        }
        residual
    }
}

impl FixedPoint {
    /// Says whether the point or the spectrum is wrong, where all parameters have values.
    fn half_at_fault(&self, model: &Model) -> Option<String> {
        if model.free_components() > 0 {
            return None;
        }
        let mut count = 0;
        let (graph, values) = record(model.dimension(), |inputs| {
            let jet = DualPoint::new(Phase::new(model, &[], inputs));
            let (state, at) = self.resting(&jet);
            let mut values = resting_values(&at, &state);
            values.extend(jet.level_at(&at, &vec![true; model.level.len()]));
            count = values.len();
            values.extend(linear_part(&at, state.len()));
            values
        })
        .ok()?;
        let tape = Tape::new(&graph, &values);
        let mut evaluator = Evaluator::new(&tape, ArbBall::new(BITS));
        evaluator.run(&vec![None; model.dimension()]);
        let found: Option<Vec<(f64, f64)>> =
            evaluator.outputs().map(|x| x.as_ref().map(Approximation::enclosure)).collect();
        let found = found?;
        let (resting, polynomial) = found.split_at(count);
        if resting.iter().any(|(value, error)| value.abs() > *error) {
            let values: Vec<String> = resting.iter().map(|(value, _)| short(*value)).collect();
            return Some(format!("this is not a fixed point: {} there, not 0", values.join(", ")));
        }
        if resting.iter().any(|(_, error)| *error > RESOLVED) {
            return None;
        }
        Some(format!(
            "the point is a fixed point to 30 digits, and the spectrum does not fit: the characteristic \
             polynomial there is {}",
            written(polynomial)
        ))
    }

    /// The claimed point, and the system there.
    fn resting<'m, T: Scalar>(&self, jet: &DualPoint<'m, T>) -> (Vec<T>, Phase<'m, T>) {
        let state = self.point.at(&jet.phase);
        let at = jet.phase.with(&[], &state);
        (state, at)
    }
}

/// Precision at which the two halves of a claim are told apart, in bits.
const BITS: u32 = 160;
/// Largest error of values that are taken for 0.
const RESOLVED: f64 = 1e-30;

/// Values that are 0 at a fixed point.
fn resting_values<T: Scalar>(at: &Phase<'_, T>, state: &[T]) -> Vec<T> {
    match at.model().system.is_map() {
        true => difference(at.field().to_vec(), state.to_vec()),
        false => at.field().to_vec(),
    }
}

/// Coefficients of the characteristic polynomial of the linear part, highest first.
fn linear_part<T: Scalar>(at: &Phase<'_, T>, dimension: usize) -> Vec<T> {
    let columns: Vec<Vec<T>> = (0..dimension)
        .map(|j| at.lift_along(j).field().iter().map(|x: &Dual<T>| x.eps).collect())
        .collect();
    characteristic_polynomial(&columns)
}

/// A number with six digits.
fn short(value: f64) -> String {
    let digits = format!("{value:.5e}");
    digits.parse::<f64>().map_or(digits, |rounded| rounded.to_string())
}

/// Writes λⁿ + Σ aₖ λᵏ.
fn written(coefficients: &[(f64, f64)]) -> String {
    let power = |k: usize| match k {
        0 => String::new(),
        1 => "λ".to_string(),
        _ => format!("λ^{k}"),
    };
    let count = coefficients.len();
    let mut text = power(count);
    for (place, (value, error)) in coefficients.iter().enumerate() {
        if value.abs() <= *error {
            continue;
        }
        let sign = if *value < 0.0 { "−" } else { "+" };
        let (number, of) = (short(value.abs()), power(count - 1 - place));
        let times = if of.is_empty() { "" } else { "*" };
        text.push_str(&format!(" {sign} {number}{times}{of}"));
    }
    text
}

/// Reads the coefficients of a characteristic polynomial, if they are given; `is_counted`: there has to
/// be one for each dimension.
fn read_polynomial<R: Reader>(
    from: &R,
    is_counted: bool,
) -> Result<Option<Vec<Formula>>, R::Error> {
    let key = "characteristic-polynomial";
    let model = from.model();
    let Some(polynomial) = from.list(key)? else { return Ok(None) };
    let dimension = model.dimension();
    if polynomial.len() != dimension && is_counted {
        let message = format!(
            "{} coefficients are given, but λ^{dimension} + … needs {dimension}",
            polynomial.len()
        );
        let remedy = "list the coefficients of all lower powers, highest first, zeros included";
        return Err(from.complaint(key, message, remedy));
    }
    if let Some(other) = polynomial.iter().find(|formula| formula.value_type() != Type::Scalar) {
        let message = format!("a coefficient is a {}", other.value_type());
        return Err(from.complaint(key, message, "give scalars"));
    }
    if polynomial.iter().any(|formula| model.has_antiderivative(formula)) {
        let message = "a coefficient cannot contain ∫, whose constant is open".to_string();
        return Err(from.complaint(key, message, "write the antiderivative out"));
    }
    Ok(Some(polynomial))
}

/// Computes the coefficients of λ^(n-1), …, 1 in Π(λ - λ_i) Π((λ - a_i)² + b_i²) λ^(n-k).
fn coefficients<T: Scalar>(eigenvalues: &[(T, Option<T>)], dimension: usize) -> Vec<T> {
    let mut polynomial = vec![T::zero(); dimension + 1];
    polynomial[0] = T::one();
    for (real, imaginary) in eigenvalues {
        // times λ² - sλ + p, or λ - s
        let (sum, product) = match imaginary {
            None => (*real, T::zero()),
            Some(part) => (*real + *real, *real * *real + *part * *part),
        };
        for k in (1..=dimension).rev() {
            let above = polynomial[k - 1];
            polynomial[k] -= above * sum;
            if imaginary.is_some() && k > 1 {
                let higher = polynomial[k - 2];
                polynomial[k] += higher * product;
            }
        }
    }
    polynomial.split_off(1)
}

#[cfg(test)]
mod tests {
    use crate::case::Case;
    use crate::verdict::{Options, Verdict};

    #[test]
    fn a_wrong_spectrum_is_told_from_a_wrong_point() {
        let lorenz = |x: &str, spectrum: &str| {
            let text = format!(
                "title = 'x'\n[parameters]\nb = '8/3'\n[state]\nx = '-9..9'\ny = '-9..9'\nz = '0..40'\n\
                 [field]\nx = '10*(y − x)'\ny = '28*x − y − x*z'\nz = 'x*y − b*z'\n[[claim]]\n\
                 fixed-point = {{ x = '{x}', y = 'sqrt(27*b)', z = '27' }}\nspectrum = [{spectrum}]\n"
            );
            let case = Case::parse(&text, &[]).expect("a case");
            let mut report = crate::verdict::judge(&case, &Options::default()).expect("judged");
            let own = report.claims.remove(0);
            assert_eq!(own.verdict, Verdict::Refuted, "{own:?}");
            own.evidence.remark.unwrap_or_default()
        };
        let rounded = "'-13.85', '0.094 ± 10.19*i'";
        let of_spectrum = lorenz("sqrt(27*b)", rounded);
        // λ³ + (σ + b + 1) λ² + b (r + σ) λ + 2 b σ (r − 1)
        let polynomial = "λ^3 + 13.6667*λ^2 + 101.333*λ + 1440";
        assert!(of_spectrum.contains("is a fixed point to 30 digits"), "{of_spectrum}");
        assert!(of_spectrum.ends_with(polynomial), "{of_spectrum}");
        assert!(lorenz("8.48", rounded).contains("is not a fixed point"), "the point is rounded");
    }
}
