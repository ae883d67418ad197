//! Orbits for all values of parameters in boxes.

use liouville::verdict::Verdict;

use super::{assert_same, judged, proved, replayed, van_der_pol};

#[test]
fn orbits_are_proved_for_boxes_of_parameters() {
    let for_all = |half: &str, further: &str| {
        let text = format!(
            "closed-orbit = 6.66\nstate = {{ x = \"2.0086\" }}\n{further}\n\
             parameters = {{ \"μ\" = \"± {half}\" }}"
        );
        van_der_pol("μ*(1 − x²)", &text).replace("[state]", "[parameters]\n\"μ\" = 1\n[state]")
    };
    let found = proved(&for_all("1e-3", "density = \"none\"")).1;
    // The orbits at the ends of the box lie in it.
    for value in ["999/1000", "1", "1001/1000"] {
        let text = for_all("1e-9", "").replace("\"μ\" = 1\n", &format!("\"μ\" = \"{value}\"\n"));
        let (_, own) = proved(&text);
        let holds = |wide: &liouville_flow::Enclosure, x: &liouville_flow::Enclosure| {
            (wide.mid - x.mid).abs() + x.rad <= wide.rad
        };
        assert!(holds(&found.period, &own.period), "μ = {value}: the period");
        assert!(holds(&found.volume, &own.volume), "μ = {value}: ∮ div v dt");
        let states = found.start.iter().zip(&own.start);
        assert!(states.into_iter().all(|(wide, x)| holds(wide, x)), "μ = {value}: the start");
    }
    // T(μ) = 6.66329 + 1.1 (μ - 1): the box is not much wider than what it has to hold.
    assert!(found.period.rad < 0.02, "{:?}", found.period);
    // Replayed, with the parameter among the boxes.
    let (case, found) = proved(&for_all("1e-3", "density = \"none\""));
    let again = replayed(&case, &found.data).expect("proved again");
    assert_same(again.period, found.period, "period for all μ");
    assert_same(again.volume, found.volume, "∮ div v dt for all μ");
    // Data for a narrow box prove nothing of a wider one.
    let narrow = proved(&for_all("1e-6", "")).1;
    assert!(replayed(&case, &narrow.data).is_err(), "boxes that do not hold the orbits");
    let wide = judged(&for_all("1/2", "density = \"none\""));
    let reason = wide.evidence.reason.clone().unwrap_or_default();
    assert_eq!(wide.verdict, Verdict::Undecided, "{:?}", wide.evidence);
    assert!(reason.contains("make their ranges smaller") || reason.contains("no step"), "{reason}");
}

#[test]
fn boxes_without_change_of_volume_exclude_nothing() {
    // A decoy: the orbit exists for all k, and its divergence is 0 on the average.
    let text = "title = \"pendulum\"\nsystem = \"field\"\n[parameters]\nk = 1\n[state]\n\
        x = \"-2..2\"\np = \"-2..2\"\n[field]\n\"x'\" = \"p\"\n\"p'\" = \"−k*sin(x)\"\n\
        [[claim]]\nclosed-orbit = 6.7\nstate = { x = \"1\" }\n\
        integrals = [\"p²/2 − k*cos(x)\"]\nparameters = { k = \"± 1e-5\" }\n";
    let found = judged(text);
    assert_eq!(found.verdict, Verdict::Proved, "{:?}", found.evidence);
    for claim in ["density = \"none\"", "divergence = \"negative\"", "divergence = \"nonzero\""] {
        let found = judged(&format!("{text}{claim}\n"));
        assert_eq!(found.verdict, Verdict::Undecided, "{claim}: {:?}", found.evidence);
    }
    // What is kept for one value only is not kept in a box.
    let one = text.replace("k*cos(x)", "cos(x)");
    let found = judged(&one);
    let reason = found.evidence.reason.clone().unwrap_or_default();
    assert_eq!(found.verdict, Verdict::Undecided, "{:?}", found.evidence);
    assert!(reason.contains("not proved that the motion keeps"), "{reason}");
    let alone = judged(&one.replace("parameters = { k = \"± 1e-5\" }\n", ""));
    assert_eq!(alone.verdict, Verdict::Proved, "for k = 1 it is kept: {:?}", alone.evidence);
}

#[test]
fn a_start_at_the_end_of_a_range_is_told_with_the_range() {
    let forced = |range: &str| {
        judged(&format!(
            "title = 'x'\n[state]\n\"φ\" = '-3..3'\np = '-2..2'\nc = '{range}'\ns = '{range}'\n[field]\n\"φ\" = 'p'\n\
             p = '−(1 − 2*c)*sin(φ) − p/10'\nc = '−2*s'\ns = '2*c'\n[level]\n\
             equations = ['c² + s² = 1']\n[[claim]]\nclosed-orbit = 3.14159265\n\
             state = {{ \"φ\" = '0', p = '0', c = '1', s = '0' }}\n"
        ))
    };
    assert_eq!(forced("-2..2").verdict, Verdict::Proved);
    let found = forced("-1..1");
    let reason = found.evidence.reason.clone().unwrap_or_default();
    assert_eq!(found.verdict, Verdict::Undecided, "{:?}", found.evidence);
    assert!(reason.contains("passes the end of the range of `c` (-1..1)"), "{reason}");
}
