//! Claims of absence of Darboux polynomials.

use super::{Dice, Polynomial, Verdict, field, only, plants};

pub const THIRD: &str = "[[claim]]\nno-invariant-relation = { degree = 3 }\n";

fn relation(formula: &str, cofactor: &str) -> String {
    format!("[[claim]]\ninvariant-relation = '{formula}'\ncofactor = '{cofactor}'\n")
}

/// The field f w + c × ∇f, of which f is a Darboux polynomial with cofactor (w, ∇f).
fn planted(f: &Polynomial, dice: &mut Dice) -> ([String; 3], String) {
    let slopes = f.gradient();
    let [a, b] = [(); 2].map(|()| [0, 1, 2].map(|_| Polynomial::random(dice, 1).text()));
    let across = super::cross(&a, &slopes);
    let along = |k: usize| format!("({})*({}) + {}", f.text(), b[k], across[k]);
    let cofactor: Vec<String> = (0..3).map(|k| format!("({})*({})", b[k], slopes[k])).collect();
    ([0, 1, 2].map(along), cofactor.join(" + "))
}

#[test]
fn planted_relations_are_never_excluded() {
    let mut dice = Dice(7);
    let (mut refuted, mut proved, mut others) = (0, 0, 0);
    let all = plants(3);
    for plant in 0..all {
        let degree = 1 + (plant % 2) as u32;
        let f = Polynomial::random(&mut dice, degree).plus(&Polynomial(vec![(1, [0, 0, 0])]));
        let (rates, cofactor) = planted(&f, &mut dice);
        let claim = format!("[[claim]]\nno-invariant-relation = {{ degree = {degree} }}\n");
        let report = only(&field(rates.clone(), &claim));
        let what = format!("plant {plant}: {}", f.text());
        assert_ne!(report.verdict, Verdict::Proved, "{what}\n{:?}", report.evidence);
        refuted += usize::from(report.verdict == Verdict::Refuted);
        // There may be others by chance.
        let report = only(&field(rates, &(relation(&f.text(), &cofactor) + &claim)));
        let reason = report.evidence.reason.unwrap_or_default();
        match report.verdict {
            Verdict::Proved => proved += 1,
            Verdict::Refuted => others += 1,
            _ => assert!(reason.contains("related along each orbit"), "{what}: {reason}"),
        }
    }
    assert!(refuted * 4 >= all * 3, "{refuted} of {all} claims are refuted");
    assert!(
        proved * 5 >= all * 3,
        "{proved} of {all} claims with the relation are proved, {others} refuted"
    );
}

#[test]
fn lorenz_has_a_relation_for_special_parameters_alone() {
    let lorenz = |beta: &str| {
        format!(
            "title = 't'\n[parameters]\n\"σ\" = '1..20'\n\"ρ\" = '1..40'\n\"β\" = '{beta}'\n[state]\nx = '-9..9'\n\
             y = '-9..9'\nz = '-9..9'\n[field]\n\"x'\" = 'σ*(y - x)'\n\"y'\" = 'x*(ρ - z) - y'\n\
             \"z'\" = 'x*y - β*z'\n{THIRD}"
        )
    };
    let found = only(&lorenz("1..5"));
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    let theorem = found.evidence.theorem.unwrap_or_default();
    assert!(theorem.contains("proper algebraic set"), "{theorem}");
    assert!(theorem.contains("no Darboux polynomial of degree at most 3 in x, y, z"), "{theorem}");
    let found = only(&lorenz("2*σ"));
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    let exhibit = found.evidence.exhibit.unwrap_or_default();
    assert!(exhibit.contains("x"), "{exhibit}");
}

#[test]
fn known_relations_are_told_from_others() {
    let species = |claims: &str| {
        field(
            ["x*(3 - x - 2*y + z)", "y*(-1 + 2*x - y + 3*z)", "z*(2 - x + y - 5*z)"]
                .map(String::from),
            &(claims.to_string() + THIRD),
        )
    };
    let two = relation("x", "3 - x - 2*y + z") + &relation("y", "-1 + 2*x - y + 3*z");
    let found = only(&species(&two));
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    assert!(found.evidence.exhibit.is_some_and(|own| own.ends_with(": z")));
    let three = two + &relation("z", "2 - x + y - 5*z");
    let found = only(&species(&three));
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    let theorem = found.evidence.theorem.unwrap_or_default();
    assert!(theorem.contains("is a constant times a product of factors of x, y, z"), "{theorem}");
}

#[test]
fn an_integral_has_its_levels_as_relations() {
    let rates = ["y*z", "-2*x*z", "x*y"].map(String::from);
    let found = only(&field(rates, THIRD));
    assert_eq!(found.verdict, Verdict::Refuted, "{:?}", found.evidence);
    assert!(found.evidence.exhibit.is_some_and(|own| own.contains("each level")));
}

#[test]
fn what_is_no_polynomial_is_left_open() {
    let cases = [
        (["y/z*z", "-x + y^2", "x*y + 1"], "not a polynomial"),
        (["y", "-sin(x)", "z"], "not a polynomial"),
        (["√(1 + y^2)", "-x", "z"], "not a polynomial"),
    ];
    for (rates, reason) in cases {
        let found = only(&field(rates.map(String::from), THIRD));
        assert_eq!(found.verdict, Verdict::Undecided, "{rates:?}: {:?}", found.evidence);
        let told = found.evidence.reason.unwrap_or_default();
        assert!(told.contains(reason), "{rates:?}: {told}");
    }
}
