//! Levels that fall apart by the form of their equations, against the points that are known to be on them.

use liouville::verdict::Verdict;

use crate::doubts::judged;

/// Coefficients of x, y, z and a constant term.
type Linear = [i64; 4];

fn text(form: &Linear) -> String {
    format!("({}*x + {}*y + {}*z + {})", form[0], form[1], form[2], form[3]).replace("+ -", "- ")
}

fn combined(a: i64, one: &Linear, b: i64, other: &Linear) -> Linear {
    std::array::from_fn(|k| a * one[k] + b * other[k])
}

/// An equation, and linear forms of which one vanishes at each of its points.
fn equation(kind: u64, f: &Linear, g: &Linear, r: i64) -> (String, Vec<Linear>) {
    let (a, b) = (text(f), text(g));
    let (less, more) = (combined(1, f, -r, g), combined(1, f, r, g));
    match kind {
        0 => (format!("{a}*{b} = 0"), vec![*f, *g]),
        1 => (format!("{a}^2 = {}*{b}^2", r * r), vec![less, more]),
        2 => (format!("{a}^3 - {}*{b}^3 = 0", r * r * r), vec![less]),
        3 => (format!("|{a}| = {r}*|{b}|"), vec![less, more]),
        4 => (format!("{a}*(1 + {b}^2) = 0"), vec![*f]),
        _ => (format!("{a}^4 = {}*{b}^4", r.pow(4)), vec![less, more]),
    }
}

/// Whether two forms have the same zeros.
fn are_parallel(one: &Linear, other: &Linear) -> bool {
    (0..4).all(|i| (0..4).all(|j| one[i] * other[j] == one[j] * other[i]))
}

#[test]
fn a_claim_holds_if_it_does_on_all_branches() {
    let (mut proved, mut refuted) = (0, 0);
    for seed in 0..60u64 {
        let mut word = seed;
        let mut below = |n: u64| {
            word = word
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (word >> 33) % n
        };
        // All planes meet the box, as they contain points near 0.
        let mut form = || -> Linear {
            let mut own: Linear = std::array::from_fn(|_| below(5) as i64 - 2);
            own[3] = 0;
            if own == [0; 4] { [1, 0, 0, 0] } else { own }
        };
        let (f, g, other) = (form(), form(), form());
        let (level, branches) = equation(seed % 6, &f, &g, 1 + (seed % 3) as i64);
        let branches: Vec<Linear> = branches.into_iter().filter(|own| *own != [0; 4]).collect();
        if are_parallel(&f, &g) || branches.is_empty() {
            continue;
        }
        let claims: [Vec<Linear>; 3] = [branches.clone(), branches[..1].to_vec(), vec![other]];
        let mut case = format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'\n[field]\n\"x'\" = '0'\n\
             \"y'\" = '0'\n\"z'\" = '0'\n[level]\nequations = ['{level}']\n"
        );
        for claim in &claims {
            let product: Vec<String> = claim.iter().map(text).collect();
            let product = product.join("*");
            case.push_str(&format!("[[claim]]\nidentity = '{product} = 0'\nexpect = 'open'\n"));
        }
        let report = judged(&case).unwrap_or_else(|error| panic!("{error}\n{case}"));
        for (claim, found) in claims.iter().zip(&report.claims) {
            let holds = branches.iter().all(|own| claim.iter().any(|one| are_parallel(own, one)));
            match found.verdict {
                Verdict::Proved => assert!(holds, "{case}"),
                Verdict::Refuted => assert!(!holds, "{case}"),
                _ => {}
            }
            proved += usize::from(found.verdict == Verdict::Proved);
            refuted += usize::from(found.verdict == Verdict::Refuted);
        }
    }
    assert!(proved > 50 && refuted > 40, "{proved} proved, {refuted} refuted");
}

#[test]
fn what_has_no_value_at_zeros_of_a_factor_is_no_product() {
    let level = |equation: &str| {
        format!(
            "title = 'x'\n[state]\nx = '-1..1'\ny = '-1..1'\n[field]\n\"x'\" = '0'\n\"y'\" = '0'\n[level]\n\
             equations = ['{equation}']\n[[claim]]\nidentity = 'y = 1/2'\nexpect = 'open'\n"
        )
    };
    // x = 0 is no point of these levels, and y = 1/2 the only part.
    for equation in ["(1/x)*x*(y - 1/2) = 0", "x*(y - 1/2)/x = 0", "x^(-1)*(y - 1/2)*x = 0"] {
        let report = judged(&level(equation));
        let is_refuted = |verdict: &Verdict| *verdict == Verdict::Refuted;
        assert!(!report.is_ok_and(|report| is_refuted(&report.claims[0].verdict)), "{equation}");
    }
    // Here x = 0 is a part.
    for equation in ["x*(y - 1/2) = 0", "x^3*(y - 1/2)^3 = 0", "|x*(y - 1/2)| = 0"] {
        let report = judged(&level(equation)).expect("judged");
        assert_eq!(report.claims[0].verdict, Verdict::Refuted, "{equation}");
    }
}
