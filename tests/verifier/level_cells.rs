//! Random levels whose equation is a square on some cells of signs, or for some listed values: a motion
//! leaves them there, though every rate vanishes on them.

use liouville::case::Case;
use liouville::verdict::{Options, Verdict, judge};

/// Factors of a slope, each with a value that is not 0 where the factor is, and 0 elsewhere; `None` for
/// factors that vanish on no open set.
const FACTORS: [(&str, Option<&str>); 9] = [
    ("(b + |b|)", Some("(|b| − b)")),
    ("(|y| − y)", Some("(|y| + y)")),
    ("(√(b²*y²) + b*y)", Some("(|b*y| − b*y)")),
    ("(|b − y| + b − y)", Some("(|b − y| − b + y)")),
    ("(√((1 + b)²) − 1 − b + 1)", None),
    ("(y + 3*|y|)", None),
    ("(2 + cos(b*y))", None),
    ("(c*(c − 1) + |b| + b)", Some("((2 − c)*(|b| − b))")),
    ("√(1 + y²)", None),
];

/// A case on x = 0 with the slope g there, a field that leaves it where m is not 0, and g m = 0.
fn case(slope: &str, leaves: &str, has_chart: bool) -> String {
    let chart = match has_chart {
        true => {
            "[level.chart]\ninputs = { u = \"-1..1\", v = \"-1..1\" }\nx = \"0*u\"\ny = \"u\"\nz = \"v\"\n"
        }
        false => "",
    };
    format!(
        "title = \"t\"\n[parameters]\nb = \"-1..1\"\nc = \"one of 1, 2\"\n\
         [state]\nx = \"-1/2..1/2\"\ny = \"-1..1\"\nz = \"-1..1\"\n\
         [field]\n\"x'\" = \"{leaves}\"\n\"y'\" = \"0\"\n\"z'\" = \"x\"\n\
         [level]\nequations = [\"x*{slope} + x²*{leaves} = 0\"]\n{chart}\
         [[claim]]\nintegral = \"z\"\nexpect = \"open\"\n"
    )
}

#[test]
fn no_level_that_a_motion_leaves_has_integrals() {
    let (mut proved, mut judged) = (0, 0);
    for first in 0..FACTORS.len() {
        for second in first..FACTORS.len() {
            let own = if first == second { vec![first] } else { vec![first, second] };
            let slope: Vec<&str> = own.iter().map(|index| FACTORS[*index].0).collect();
            // The field is what does not vanish where one of the factors does.
            let leaving = own.iter().find_map(|index| FACTORS[*index].1);
            let has_chart = (first + second) % 2 == 0;
            let text = case(&slope.join("*"), leaving.unwrap_or("0*b"), has_chart);
            let case = Case::parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
            let seed = (first * FACTORS.len() + second) as u64;
            let Ok(report) = judge(&case, &Options { seed, ..Options::default() }) else {
                continue;
            };
            let is_proved = report.claims[0].verdict == Verdict::Proved;
            assert!(!(is_proved && leaving.is_some()), "the motion leaves x = 0 in\n{text}");
            judged += 1;
            proved += usize::from(is_proved);
        }
    }
    assert!(judged > 20 && proved > 3, "{proved} of {judged} levels are seen to be regular");
}
