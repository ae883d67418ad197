//! Levels with a part on which the slope is 0: what fails on another part is refuted, and what is not known on
//! the flat one is not proved.

use super::level_parts::Draws;
use liouville::case::Case;
use liouville::verdict::{ClaimReport, Options, Verdict, judge};

/// A line a x + b y + c = 0.
#[derive(Clone, Copy, Debug)]
struct Line([i64; 3]);

impl Line {
    fn drawn(draws: &mut Draws) -> Self {
        let number = |draws: &mut Draws| draws.below(5) as i64 - 2;
        loop {
            let own = [number(draws), number(draws), number(draws)];
            if own[0] != 0 && own[1] != 0 {
                return Self(own);
            }
        }
    }

    fn text(self) -> String {
        let [a, b, c] = self.0;
        format!("(({a})*x + ({b})*y + ({c}))")
    }

    /// Whether two lines are the same or parallel.
    fn is_along(self, other: Self) -> bool {
        self.0[0] * other.0[1] == self.0[1] * other.0[0]
    }

    /// Whether the line meets the middle of the ranges.
    fn is_near(self) -> bool {
        let [a, b, c] = self.0;
        c.abs() <= a.abs() + b.abs()
    }
}

fn judged(level: &str, field: [&str; 2], claims: &[String]) -> Vec<ClaimReport> {
    let claims: String =
        claims.iter().map(|own| format!("[[claim]]\n{own}\nexpect = \"open\"\n")).collect();
    let [x, y] = field;
    let text = format!(
        "title = \"t\"\n[state]\nx = \"-2..2\"\ny = \"-2..2\"\n[field]\n\"x'\" = \"{x}\"\n\"y'\" = \"{y}\"\n\
         [level]\nequations = [\"{level} = 0\"]\n{claims}"
    );
    let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    judge(&case, &Options::default()).unwrap_or_else(|error| panic!("{error}\n{text}")).claims
}

#[test]
fn what_fails_on_a_regular_part_is_refuted() {
    let (mut refuted, mut open) = (0, 0);
    for index in 0..20 {
        let mut draws = Draws(700 + index);
        let (flat, regular) = (Line::drawn(&mut draws), Line::drawn(&mut draws));
        let other = Line::drawn(&mut draws);
        if flat.is_along(regular) || other.is_along(regular) || !regular.is_near() {
            continue;
        }
        // Along the lines p q = 0, and more slowly where they meet.
        let (p, q) = (flat.text(), regular.text());
        let ([a, b, _], [c, d, _]) = (flat.0, regular.0);
        let field = [format!("({b})*{q} + ({d})*{p}"), format!("−(({a})*{q} + ({c})*{p})")];
        // Both p and e^p − 1 are 0 where p is, and their product has no slope there.
        let level = format!("({p}*(exp({p}) − 1))*{q} + 0*x");
        let twice = format!("{p}*(exp({p}) − 1)");
        let written = format!("{twice}*({c})*x + {twice}*({d})*y + {twice}*({})", regular.0[2]);
        for level in [&level, &written] {
            let claims = [
                format!("integral = \"{}\"", other.text()),
                format!("integral = \"{q}^2\""),
                format!("integral = \"{p}*{q}\""),
            ];
            let found = judged(level, [&field[0], &field[1]], &claims);
            assert_eq!(found[0].verdict, Verdict::Refuted, "{level}: {:?}", found[0]);
            let reason = found[0].evidence.reason.clone().unwrap_or_default();
            assert!(!flat.is_near() || reason.contains("slopes"), "{level}: {:?}", found[0]);
            refuted += 1;
            // Both are 0 where q is, and nothing is known of motions where p is.
            for own in &found[1..] {
                assert!(own.verdict != Verdict::Refuted, "{level}: {own:?}");
                open += usize::from(own.verdict == Verdict::Undecided);
            }
        }
    }
    assert!(refuted > 15 && open > 10, "{refuted} refuted and {open} undecided");
}

#[test]
fn the_flat_part_is_named_and_decides_nothing() {
    let level = "(exp(x) − 2)*y*sin(y)";
    let field = ["(exp(x) − 2)*y", "1 + (exp(x) − 2)*x"];
    let claims =
        ["integral = \"y\"", "integral = \"x\"", "density = \"1 + y^2\""].map(str::to_string);
    let found = judged(level, field, &claims);
    assert_eq!(found[0].verdict, Verdict::Refuted, "y' = 1 on e^x = 2: {:?}", found[0]);
    assert_eq!(found[1].verdict, Verdict::Undecided, "x' = 0 on e^x = 2: {:?}", found[1]);
    assert_eq!(found[2].verdict, Verdict::Refuted, "{:?}", found[2]);
    let reason = found[1].evidence.reason.clone().unwrap_or_default();
    assert!(reason.contains("as near x = ") && reason.contains("y = 0"), "{reason}");
}
