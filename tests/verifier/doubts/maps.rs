//! Densities of maps that are proved to be one-to-one, and of maps that are not.

use super::claims;
use liouville::claim::PlaceName;
use liouville::verdict::Verdict;

/// The remark on the density 1 of a map, which is proved.
fn remark(rest: &str) -> String {
    let report = claims(&format!("title = 't'\n{rest}\n[[claim]]\ndensity = '1'\n")).remove(0);
    assert_eq!(report.verdict, Verdict::Proved, "{rest}: {:?}", report.evidence);
    report.evidence.remark.unwrap_or_default()
}

/// The remark on the density 1 of a map of x and y with parameters a and b.
fn of_plane(x: &str, y: &str, more: &str) -> String {
    remark(&format!(
        "[parameters]\na = '0.5..2'\nb = 'one of 1, 2'\n[state]\nx = '-2..2'\ny = '-2..2'\n\
         [map]\nx = '{x} + 0*a*b'\ny = '{y}'\n{more}"
    ))
}

#[test]
fn a_map_whose_image_determines_the_state_needs_no_remark() {
    for [x, y] in [
        ["x + y + a*sin(x)", "y + a*sin(x)"],
        ["1 − a*|x| + y", "−x"],
        ["y", "b − x + √(1 + y²)"],
        ["x + a*b*y³", "y"],
        ["y", "−x + 2*a*y/(1 + y²)"],
        ["x*exp(a*y)", "−exp(−a*y)/a"],
    ] {
        assert_eq!(of_plane(x, y, ""), "", "{x}, {y}");
    }
}

#[test]
fn a_map_that_is_not_known_to_be_one_to_one_gets_a_remark() {
    let of_line =
        |range: &str, map: &str| remark(&format!("[state]\nx = '{range}'\n[map]\nx = '{map}'"));
    // A second state with the same image is found for few states only.
    assert!(of_line("0..1000", "|x − 1|").contains("not proved"));
    assert_eq!(of_line("1..1000", "x − 1"), "");
    assert_eq!(of_line("0..1000", "−x"), "");
    // One image of (x, y) and (−x, y), for a few x < 0.
    let folded = "[state]\nx = '-0.001..2'\ny = '-2..2'\n[map]\nx = '|x|'\ny = 'y + x²'";
    assert!(remark(folded).contains("not proved"));
}

#[test]
fn a_map_of_one_variable_is_one_to_one_where_it_is_monotone() {
    let own = |range: &str, map: &str, density: &str| {
        let text = format!(
            "title = 't'\n[state]\nx = '{range}'\n[map]\nx = '{map}'\n\
             [[claim]]\ndensity = '{density}'\nexpect = 'open'\n"
        );
        let report = claims(&text).remove(0);
        (report.verdict, report.evidence.remark.unwrap_or_default())
    };
    // ln|ln x| is moved by ln 2.
    assert_eq!(own("0.5..2", "x²", "1/(x*|ln(x)|)"), (Verdict::Proved, String::new()));
    // tan, written as sin/cos, is monotone on no range with a pole.
    let (verdict, remark) = own("0..3", "arctan(tan(x))", "1");
    assert!(verdict != Verdict::Proved || remark.contains("not proved"), "{verdict:?}: {remark}");
    assert_eq!(own("0..1", "arctan(tan(x))", "1"), (Verdict::Proved, String::new()));
}

#[test]
fn a_map_of_a_level_is_one_to_one_on_the_level() {
    let sphere = "[level]\nequations = ['x² + y² + z² = 1']";
    let state = "[state]\nx = '-1..1'\ny = '-1..1'\nz = '-1..1'";
    let turned = "[map]\nx = 'x*cos(z) − y*sin(z)'\ny = 'x*sin(z) + y*cos(z)'\nz = 'z'";
    assert_eq!(remark(&format!("{state}\n{turned}\n{sphere}")), "");
    // x² is determined by the image, and x is not.
    let folded = "[map]\nx = 'x'\ny = 'y + |x| − x'\nz = 'z'";
    let plane = "[level]\nequations = ['z = x²']";
    let text = format!("{}\n{folded}\n{plane}", state.replace("'-1..1'\ny", "'-0.001..1'\ny"));
    assert_eq!(remark(&text), "", "x is its own image");
}

#[test]
fn a_map_that_is_one_to_one_on_a_level_alone_is_proved_there() {
    // For z < 0 it is |x|.
    let text = "title = 't'\n[state]\nx = '-2..2'\nz = '-1..3'\n[level]\nequations = ['z = 2']\n[map]\n\
                x = '(x + |x|)/2 + z/|z|*(x − |x|)/2'\nz = 'z'\n[[claim]]\ndensity = '1'\n";
    let report = claims(text).remove(0);
    assert_eq!((report.verdict, report.evidence.holds), (Verdict::Proved, vec![PlaceName::Level]));
}

#[test]
fn a_second_state_near_a_pole_is_found() {
    for [range, map] in
        [["-2..2", "x − 1/10^4/x"], ["-2..2", "x − 1/10^18/x"], ["1e6..2e6", "x − 1/x"]]
    {
        let text = format!(
            "title = 't'\n[state]\nx = '{range}'\n[map]\nx = '{map}'\n[[claim]]\ndensity = '1'\n\
             expect = 'open'\n"
        );
        let report = claims(&text).remove(0);
        assert_eq!(report.verdict, Verdict::Undecided, "{map} on {range}");
    }
}

/// The verdict on the density 1 of a map of x and p, and the remark.
fn of_phase(range: &str, x: &str, p: &str) -> (Verdict, String) {
    let text = format!(
        "title = 't'\n[state]\nx = '{range}'\np = '-2..2'\n[map]\nx = '{x}'\np = '{p}'\n\
         [[claim]]\ndensity = '1'\nexpect = 'open'\n"
    );
    let report = claims(&text).remove(0);
    (report.verdict, report.evidence.remark.unwrap_or_default())
}

#[test]
fn variables_are_found_one_after_another_by_monotony() {
    let proved = (Verdict::Proved, String::new());
    for [range, x, p] in [
        ["-2..2", "x³", "p/(3*x²)"],
        ["0.5..2", "x²", "p/(2*x)"],
        ["-1..2", "(exp(x) − exp(−x))/2", "2*p/(exp(x) + exp(−x))"],
        ["-1..1", "tan(x)", "p*cos(x)²"],
        ["-20..20", "x − sin(x)/2", "p/(1 − cos(x)/2)"],
        ["-20..20", "x − sin(x)", "x + p/(1 − cos(x))"],
    ] {
        assert_eq!(of_phase(range, x, p), proved, "{x}, {p} on {range}");
    }
    for [range, x, p] in [
        ["-2..2", "x²", "p/(2*x)"],
        ["0..3", "tan(x)", "p*cos(x)²"],
        ["-2..2", "|x|*x − x/1000", "p/(2*|x| − 1/1000)"],
        ["-2..2", "x", "|p|"],
    ] {
        let (verdict, remark) = of_phase(range, x, p);
        let is_open = verdict == Verdict::Undecided || remark.contains("not proved");
        assert!(is_open, "{x}, {p} on {range}: {verdict:?}, {remark}");
    }
}

#[test]
fn a_density_is_refuted_if_the_map_is_proved_to_be_one_to_one() {
    for (range, x) in [("-2..2", "2*x"), ("-2..2", "x³"), ("0.5..2", "exp(x)"), ("1..2", "x + x³")]
    {
        let (verdict, remark) = of_phase(range, x, "p");
        assert_eq!((verdict, &remark[..]), (Verdict::Refuted, ""), "{x} on {range}");
    }
    // Images of a few x near −7003 are those of others.
    let tooth = "2*x + 15*10^6*(|x + 7003 + 1/1000| − 2*|x + 7003| + |x + 7003 − 1/1000|)";
    assert_eq!(of_phase("1..2", tooth, "p").0, Verdict::Undecided);
}

#[test]
fn a_claim_says_nothing_where_its_formula_has_no_value_at_the_image() {
    for (image, function) in [("0*x", "x*exp(1/x)"), ("x − x", "x*log(x)³"), ("0", "x*sin(1/x)")]
    {
        let text = format!(
            "title = 't'\n[state]\nx = '0.5..2'\ny = '-2..2'\n[map]\nx = '{image}'\n\
             y = 'y + {function}'\n[[claim]]\nintegral = 'y + {function}'\nexpect = 'open'\n\
             [[claim]]\nfixed-point = {{}}\nexpect = 'open'\n"
        );
        for report in claims(&text) {
            assert_eq!(report.verdict, Verdict::Undecided, "{function}: {:?}", report.evidence);
        }
    }
}

#[test]
fn a_map_with_a_reversor_is_one_to_one_where_its_equation_has_values() {
    let density = |state: &str, map: &str, reversor: &str| {
        let claimed = format!("[[claim]]\nreversor = {{ {reversor} }}\n[[claim]]\ndensity = '1'\n");
        let text = format!("title = 't'\n[state]\n{state}[map]\n{map}{claimed}");
        let reports = claims(&text);
        (reports[1].verdict, reports[1].evidence.remark.clone().unwrap_or_default())
    };
    let verlet = "q = 'q + 1/20*(p − q/40/(q^2 + 1)^(3/2))'\n\
                  p = 'p − q/40/(q^2 + 1)^(3/2) − (q + 1/20*(p − q/40/(q^2 + 1)^(3/2)))/40/\
                  ((q + 1/20*(p − q/40/(q^2 + 1)^(3/2)))^2 + 1)^(3/2)'\n";
    let state = "q = '0.5..2'\np = '-1..1'\n";
    assert_eq!(density(state, verlet, "p = '−p'"), (Verdict::Proved, String::new()));
    // On 2..3 the map is two to one, and the equation of the reversor has no value there.
    let sign = "sign(3/2 − x)";
    let folded =
        format!("x = '(1 + {sign})/2*(1 − x) + (1 − {sign})/2*(−1 − |x − 5/2|) + 0*√x'\ny = 'y'\n");
    let (verdict, remark) = density("x = '0.1..3'\ny = '-1..1'\n", &folded, "y = '−y'");
    assert!(verdict != Verdict::Proved || remark.contains("not proved"), "{verdict:?}: {remark}");
}
