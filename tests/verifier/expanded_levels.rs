//! Random levels that are products of factors, written out: what holds where one factor is 0, and not at a known
//! point where another one is, is never told to hold; what holds where each is 0 is not refuted.

use super::level_parts::{Draws, NAMES, Polynomial};
use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Number of levels.
const LEVELS: u64 = 100;

/// Judges identities on the level of one equation.
fn verdicts(equation: &str, claims: &[String], seed: u64) -> Option<Vec<Verdict>> {
    let state: String = NAMES.iter().map(|name| format!("{name} = \"-2..2\"\n")).collect();
    let rest: String = NAMES.iter().map(|name| format!("\"{name}'\" = \"0\"\n")).collect();
    let claims: String = claims
        .iter()
        .map(|claim| format!("[[claim]]\nidentity = \"{claim} = 0\"\nexpect = \"open\"\n"))
        .collect();
    let text = format!(
        "title = \"t\"\n[state]\n{state}[field]\n{rest}[level]\nequations = [\"{equation} = 0\"]\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    match judge(&case, &Options { seed, ..Options::default() }) {
        Ok(report) => Some(report.claims.iter().map(|claim| claim.verdict).collect()),
        Err(error) => {
            assert!(!error.to_string().contains("are not on it"), "{error}\n{text}");
            None
        }
    }
}

#[test]
fn levels_of_products_that_are_written_out_have_all_of_their_parts() {
    let (mut proved, mut refuted) = (0, 0);
    for index in 0..LEVELS {
        let mut draws = Draws(1000 + index);
        let count = 2 + draws.below(2);
        let factors: Vec<Polynomial> = (0..count)
            .map(|_| if draws.below(2) == 0 { draws.line() } else { draws.polynomial() })
            .collect();
        let one = draws.line();
        let product = factors[1..].iter().fold(factors[0].clone(), |all, own| all.times(own));
        let claims: Vec<String> = factors
            .iter()
            .map(Polynomial::text)
            .chain([product.times(&one).text(), product.text()])
            .collect();
        let Some(found) = verdicts(&product.text(), &claims, index) else { continue };
        let range = || -1..=1;
        let points = range().flat_map(|x| {
            range().flat_map(move |y| range().flat_map(move |z| range().map(move |w| [x, y, z, w])))
        });
        let points: Vec<[i64; 4]> = points.collect();
        for (which, verdict) in found.iter().take(factors.len()).enumerate() {
            // Around a zero of another factor with a slope there are more.
            let is_witness = |at: &&[i64; 4]| {
                let others = factors.iter().enumerate().filter(|(k, _)| *k != which);
                let is_zero =
                    |own: &Polynomial| own.value(at) == 0 && (0..4).any(|k| own.slope(at, k) != 0);
                factors[which].value(at) != 0 && others.into_iter().any(|(_, own)| is_zero(own))
            };
            if let Some(at) = points.iter().find(is_witness) {
                assert!(
                    !matches!(verdict, Verdict::Proved | Verdict::Confirmed),
                    "({}) is told to be 0 where ({}) is, and is not at {at:?}: {verdict:?}",
                    factors[which].text(),
                    product.text()
                );
                refuted += usize::from(*verdict == Verdict::Refuted);
            }
        }
        for (claim, verdict) in claims.iter().zip(&found).skip(factors.len()) {
            assert!(*verdict != Verdict::Refuted, "{claim} is refuted on {}", product.text());
            proved += usize::from(*verdict == Verdict::Proved);
        }
    }
    assert!(proved > 150 && refuted > 150, "{proved} proved and {refuted} refuted");
}

#[test]
fn sums_of_squares_are_0_where_each_square_is_and_differences_are_not() {
    let mut proved = 0;
    for index in 0..LEVELS / 2 {
        let mut draws = Draws(5000 + index);
        let (one, two, other) = (draws.line(), draws.line(), draws.line());
        let squares = |factor: i64| {
            let second = two.times(&two);
            let scaled = second.times(&Polynomial(vec![(factor, [0; 4])]));
            Polynomial([one.times(&one).0, scaled.0].concat())
        };
        let claims = [&one, &two, &other].map(Polynomial::text);
        let points: Vec<[i64; 4]> = (0..81)
            .map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1, k / 27 - 1])
            .filter(|at| one.value(at) == 0 && two.value(at) == 0)
            .collect();
        let sum = squares(2);
        if let Some(found) = verdicts(&sum.text(), &claims, index) {
            for own in &found[..2] {
                assert!(*own != Verdict::Refuted, "a square is not 0 on {}", sum.text());
                proved += usize::from(*own == Verdict::Proved);
            }
            let is_zero = points.iter().all(|at| other.value(at) == 0);
            let holds = matches!(found[2], Verdict::Proved | Verdict::Confirmed);
            assert!(is_zero || !holds, "{} is told to be 0 on {}", claims[2], sum.text());
        }
        // x² = 2y² has the zeros x = ±√2 y, unless x and y are multiples of each other.
        let minor = |i: usize, j: usize| {
            one.slope(&[0; 4], i) * two.slope(&[0; 4], j)
                - one.slope(&[0; 4], j) * two.slope(&[0; 4], i)
        };
        let are_independent = (0..4).any(|i| (0..i).any(|j| minor(i, j) != 0));
        let difference = squares(-2);
        if let (true, Some(found)) = (are_independent, verdicts(&difference.text(), &claims, index))
        {
            let holds = |own: &Verdict| matches!(own, Verdict::Proved | Verdict::Confirmed);
            assert!(!found[..2].iter().any(holds), "{claims:?} on {}", difference.text());
        }
    }
    assert!(proved > 60, "{proved} are proved");
}
