//! Rotors and gyroscopic terms that integrals survive, of systems of the user's own.

use liouville::claim::Claim;
use liouville::verdict::{Options, Verdict};
use liouville_search::{Effort, FoundKind, SearchReport, search};

use super::{case, effort, searched, told};

fn turned(text: &str) -> SearchReport {
    let mut wanted = Effort { by_class: false, by_factors: false, ..effort(2) };
    wanted.ansatz.gyrostats = true;
    search(&case(text), &wanted, &mut |_| {}).expect("it can be searched")
}

/// Number of directions by the theorem on an integral, and how many are told.
fn counted(report: &SearchReport, integral: &str) -> Option<(usize, usize)> {
    let is_own = |theorem: &str| theorem.contains(&format!("an integral {integral} + F₁"));
    let own = report.excluded.iter().find(|own| is_own(&own.theorem));
    own.map(|own| (own.dimension, own.known))
}

fn has_remark(report: &SearchReport, words: &str) -> bool {
    report.remarks.iter().any(|remark| remark.contains(words))
}

fn verdict(text: &str, integral: &str) -> Verdict {
    let case = case(text);
    let formula = case.formula(integral).expect("a formula");
    let report = case.judge(&[Claim::integral(&formula)], &Options::default());
    report.expect("it can be judged").claims[0].verdict
}

/// A particle in the plane with a kinetic energy and other terms.
fn particle(terms: &str, potential: &str, claim: &str) -> String {
    format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nm = '0.5..2'\nb = '0.5..2'\n[state]\n\
         x = '0.5..2'\ny = '0.5..2'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\n\
         kinetic = \"m*(x'² + y'²)/2{terms}\"\npotential = '{potential}'\n[[claim]]\nname = 'F'\n\
         integral = \"{claim}\"\n"
    )
}

#[test]
fn magnetic_terms_of_a_lagrangian_are_found() {
    let area = "x*y' − y*x'";
    let report = turned(&particle("", "x² + y²", area));
    assert_eq!(counted(&report, area), Some((2, 2)), "{:?}", report.excluded);
    let found = told(&report);
    let (integral, term) =
        found.iter().find(|(own, _)| own.starts_with(area)).expect("it survives");
    // The field is 2ms: the sign of r² follows.
    assert!(integral.contains("s1*(−x² − y²)"), "{integral}");
    assert!(term.starts_with("s1*(2*m*y*x')"), "{term}");
    let constant = particle(" + 2*b*m*y*x'", "x² + y²", area);
    assert_eq!(verdict(&constant, "x*y' − y*x' − b*(x² + y²)"), Verdict::Proved);
    assert_eq!(verdict(&constant, "x*y' − y*x' + b*(x² + y²)"), Verdict::Refuted);
    // Gradients change nothing: nothing is said about x', nor about both y*x' and x*y'.
    let theorem = &report.excluded.last().expect("a theorem").theorem;
    assert!(theorem.contains("terms y*x', x*y*x', y²*x', "), "{theorem}");
    // A momentum survives fields that do not depend on its coordinate.
    let free = turned(&particle("", "y²*y²", "x'"));
    assert_eq!(counted(&free, "x'"), Some((3, 3)), "1, y, y²: {:?}", free.excluded);
}

/// Hamilton's equations of a particle in the plane.
fn plane(function: &str, claims: &str) -> String {
    format!(
        "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\np = '-1..1'\nq = '-1..1'\n[hamiltonian]\n\
         function = '{function}'\npairs = [['x','p'],['y','q']]\n{claims}"
    )
}

#[test]
fn magnetic_terms_of_canonical_equations_are_found() {
    let kepler = turned(&plane("(p² + q²)/2 - 1/√(x² + y²)", ""));
    assert_eq!(counted(&kepler, "x*q − y*p"), Some((2, 2)), "{:?}", kepler.excluded);
    assert_eq!(counted(&kepler, "y/√(x² + y²) + x*p*q − y*p²"), Some((0, 0)));
    let found = kepler.found.iter().find(|found| found.with.len() == 2).expect("it survives");
    assert_eq!([found.with[0].name(), found.with[1].name()], ["gyroscopic term", "potential"]);
    // Its potential is needed: y*p is the constant field up to a gradient.
    let own = plane("(p² + q²)/2 - 1/√(x² + y²) + 2*y*p - 2*x²", "");
    assert_eq!(verdict(&own, "x*q - y*p + x² - y²"), Verdict::Proved);
    assert_eq!(verdict(&own, "x*q - y*p - x² + y²"), Verdict::Refuted);
    let henon = turned(&plane("(p² + q² + x² + y²)/2 + x²*y + 2*y³", ""));
    let excluded = henon.excluded.iter().find(|own| own.ansatz.starts_with("gyroscopic"));
    assert_eq!(excluded.map(|own| (own.dimension, own.known)), Some((0, 0)));
    assert!(told(&henon).is_empty(), "{:?}", told(&henon));
    // The energy of one of two systems survives fields in either, with terms up to the third order.
    let apart = turned(
        "title = 'x'\n[state]\na = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\nd = '0.5..2'\np = '-1..1'\n\
         q = '-1..1'\nr = '-1..1'\ns = '-1..1'\n[hamiltonian]\n\
         function = '(p² + q² + r² + s²)/2 + (a² + b²)² + (c² + d²)²'\n\
         pairs = [['a','p'],['b','q'],['c','r'],['d','s']]\n",
    );
    let energy = apart.functions(FoundKind::Integral).find(|own| own.text().starts_with("p²"));
    let energy = energy.expect("the energy of a and b").text().to_string();
    assert_eq!(counted(&apart, &energy), Some((2, 2)), "{:?}", apart.excluded);
    let generic = turned(&plane("(p² + q² + x² + y²)/2 + x²*y - y³/3", ""));
    assert!(has_remark(&generic, "could survive gyroscopic terms"), "{:?}", generic.remarks);
}

/// Hamilton's equations of M and γ.
fn top(function: &str, bracket: &str) -> String {
    format!(
        "title = 'x'\n[parameters]\na = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\n[state]\nM = 'vector(-2..2)'\n\
         \"γ\" = 'vector(-1..1)'\n[hamiltonian]\nfunction = '{function}'\nbracket = {bracket}\n"
    )
}

#[test]
fn rotors_of_tops_are_found() {
    let e3 = "{ structure = 'e(3)' }";
    let lagrange = turned(&top("(M1² + M2²)/(2*a) + M3²/(2*c) + b*γ3", e3));
    assert_eq!(counted(&lagrange, "M3"), Some((1, 1)), "{:?}", lagrange.excluded);
    assert!(told(&lagrange).contains(&("M3", "s1*M3")), "{:?}", told(&lagrange));
    let area = ("(M,γ)", "s1*M1 + s2*M2 + s3*M3");
    assert!(told(&lagrange).contains(&area), "{:?}", told(&lagrange));
    // Clebsch's integral survives no rotor.
    let clebsch = "(a*M1² + b*M2² + c*M3²)/2 - (b*c*γ1² + a*c*γ2² + a*b*γ3²)/2";
    let report = turned(&top(clebsch, e3));
    assert!(told(&report).contains(&area), "{:?}", told(&report));
    let of_clebsch = report.found.iter().find(|found| found.text().contains("γ1²"));
    let integral = of_clebsch.expect("Clebsch's integral").text();
    assert_eq!(counted(&report, integral), Some((0, 0)), "{:?}", report.excluded);
    // Zhukovskii and Volterra: the square of the momentum survives each rotor.
    let euler = "title = 'x'\n[parameters]\na = '0.5..2'\nb = '0.5..2'\nc = '0.5..2'\n[state]\n\
                 M = 'vector(-2..2)'\n[hamiltonian]\nfunction = '(a*M1² + b*M2² + c*M3²)/2'\n\
                 bracket = { structure = 'so(3)' }\n";
    let report = turned(euler);
    assert_eq!(told(&report), [("(M,M)", "s1*M1 + s2*M2 + s3*M3")]);
    assert_eq!(counted(&report, "(M,M)"), Some((3, 3)), "{:?}", report.excluded);
}

#[test]
fn all_variables_of_other_brackets_are_momenta() {
    // so(4): γ does not commute with itself.
    let so4 = "{ \"M,M\" = 'hat(M)', \"M,γ\" = 'hat(γ)', \"γ,γ\" = 'hat(M)' }";
    let report = turned(&top("(a*(M1² + M2²) + b*M3² + c*γ3²)/2", so4));
    let theorem = counted(&report, "M3");
    assert_eq!(theorem, Some((2, 2)), "M₃ and γ₃: {:?} {:?}", report.excluded, told(&report));
    let scalars = "title = 'x'\n[parameters]\na = '0.5..2'\nc = '0.5..2'\n[state]\nu = '-2..2'\n\
                   v = '-2..2'\nw = '-2..2'\n[hamiltonian]\nfunction = '(a*u² + a*v² + c*w²)/2'\n\
                   bracket = { \"u,v\" = 'w', \"v,w\" = 'u', \"w,u\" = 'v' }\n";
    let report = turned(scalars);
    assert_eq!(counted(&report, "w"), Some((1, 1)), "{:?}", report.excluded);
    assert!(told(&report).contains(&("w", "s1*w")), "{:?}", told(&report));
}

/// An isotropic oscillator in space, with terms of the rates of its velocities.
fn oscillator(terms: [&str; 3]) -> String {
    let [u, v, w] = terms;
    format!(
        "title = 'x'\n[parameters]\nk = '0.5..2'\nb = '0.5..2'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\
         z = '0.5..2'\nu = '-1..1'\nv = '-1..1'\nw = '-1..1'\n[field]\n\"x'\" = 'u'\n\"y'\" = 'v'\n\
         \"z'\" = 'w'\n\"u'\" = '-k*x{u}'\n\"v'\" = '-k*y{v}'\n\"w'\" = '-k*z{w}'\n"
    )
}

#[test]
fn gyroscopic_forces_of_a_field_are_found() {
    let report = turned(&oscillator(["", "", ""]));
    let area = "x*v − y*u";
    // Fields across the radius and the axis do no moment about it, whatever their strength is.
    let across = (
        "x*v − y*u",
        "f1*(x*w) in the rate of u, f1*(y*w) in the rate of v, f1*(−x*u − y*v) in the rate of w for any function f1(x, y, z)",
    );
    assert!(told(&report).contains(&across), "{:?}", told(&report));
    let (integral, force) = told(&report)
        .into_iter()
        .find(|(own, force)| own.starts_with(area) && !force.contains("f1"))
        .expect("fields with a term");
    assert!(integral.contains("√(x² + y² + z²)") && force.contains("s1*"), "{integral}: {force}");
    let (dimension, known) = counted(&report, area).expect("a theorem");
    assert!(dimension >= known && known > 8, "{known} of {dimension}");
    // A radial field b r/r³ with the force b v × r/r³: the moment of momentum less b r/r is kept.
    let at = |velocity: &str| format!("+ b*({velocity})/(x² + y² + z²)/√(x² + y² + z²)");
    let [u, v, w] = ["v*z - w*y", "w*x - u*z", "u*y - v*x"].map(at);
    let radial = oscillator([&u, &v, &w]);
    let with = |sign: &str| format!("x*v − y*u {sign} b*z/√(x² + y² + z²)");
    assert_eq!(verdict(&radial, &with("-")), Verdict::Proved);
    assert_eq!(verdict(&radial, &with("+")), Verdict::Refuted);
}

#[test]
fn the_energy_of_a_field_survives_each_force_without_work() {
    let report = turned(
        "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '-1..1'\nv = '-1..1'\n[field]\n\"x'\" = 'u'\n\
         \"y'\" = 'v'\n\"u'\" = '-x - 2*x*y'\n\"v'\" = '-y - x² + y²'\n",
    );
    let any = "f1*v in the rate of u, f1*(−u) in the rate of v for any function f1(x, y)";
    let found = told(&report);
    assert!(matches!(found.as_slice(), [(_, force)] if *force == any), "{found:?}");
    let (dimension, known) = counted(&report, found[0].0).expect("a theorem");
    assert!(dimension == known && known > 20, "{known} of {dimension}");
}

#[test]
fn what_takes_no_gyroscopic_terms_is_told_so() {
    let lorenz = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\n[field]\n\
                  \"x'\" = '10*(y - x)'\n\"y'\" = 'x*(28 - z) - y'\n\"z'\" = 'x*y - z'\n";
    assert!(has_remark(&turned(lorenz), "linear in the others, as x' = u has"));
    let mixed = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '-1..1'\nv = '-1..1'\n[field]\n\
                 \"x'\" = '2*u'\n\"y'\" = 'v'\n\"u'\" = '-x'\n\"v'\" = '-y'\n";
    assert!(has_remark(&turned(mixed), "write the equations with [hamiltonian] or [lagrangian]"));
    let single = "title = 'x'\n[state]\nx = '0.5..2'\nu = '-1..1'\n[field]\n\"x'\" = 'u'\n\"u'\" = '-x'\n\
                  [[claim]]\nname = 'F'\nintegral = 'x² + u²'\n";
    assert!(has_remark(&turned(single), "none of this form acts on the system"));
    let line = "title = 'x'\n[state]\nx = '0.5..2'\np = '-1..1'\n[hamiltonian]\nfunction = 'p²/2 + 0*x'\n\
                pairs = [['x','p']]\n[[claim]]\nname = 'p'\nintegral = 'p'\n";
    let report = turned(line);
    assert!(!report.excluded.iter().any(|own| own.ansatz.starts_with("gyroscopic")));
    // A rotor across the face of a flat base has no effect, and is none of those that are counted.
    let mut wanted = effort(2);
    wanted.ansatz.gyrostats = true;
    let base = searched("flat-base/base-through-centre", &wanted);
    let own = base.excluded.iter().find(|own| own.ansatz.starts_with("rotors"));
    assert_eq!(own.map(|own| (own.dimension, own.known)), Some((0, 0)), "{:?}", base.excluded);
}

/// Pseudo-random integers.
struct Numbers(u64);

impl Numbers {
    /// Returns the next one of −3..=3.
    fn next(&mut self) -> i64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as i64 % 7 - 3
    }

    /// Draws a regular matrix.
    fn matrix(&mut self) -> [i64; 4] {
        loop {
            let own @ [a, b, c, d] = std::array::from_fn(|_| self.next());
            if a * d != b * c {
                return own;
            }
        }
    }
}

/// Plants in random linear coordinates: an area of X = A x is kept by fields that are functions of R², a
/// momentum by those that do not depend on its coordinate, and (n,m) by the rotor n.
#[test]
fn planted_gyroscopic_terms_are_found_and_never_excluded() {
    let mut numbers = Numbers(20);
    for plant in 0..2 {
        let [a, b, c, d] = numbers.matrix();
        let (w, e) = (numbers.next(), a * d - b * c);
        let [big, wide] = [format!("(({a})*x + ({b})*y)"), format!("(({c})*x + ({d})*y)")];
        let [fast, rapid] = [format!("(({a})*x' + ({b})*y')"), format!("(({c})*x' + ({d})*y')")];
        let lagrangian = |potential: &str, claim: &str| {
            format!(
                "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '0.5..2'\ny = '0.5..2'\n\
                 \"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"({fast}² + {rapid}²)/2\"\n\
                 potential = '{potential}'\n[[claim]]\nname = 'F'\nintegral = \"{claim}\"\n"
            )
        };
        let area = turned(&lagrangian(
            &format!("({big}² + {wide}²)² + ({w})*({big}² + {wide}²)"),
            &format!("{big}*{rapid} − {wide}*{fast}"),
        ));
        let gyroscopic = |report: &SearchReport| -> Vec<(usize, usize)> {
            let own = report.excluded.iter().filter(|own| own.ansatz.starts_with("gyroscopic"));
            own.map(|own| (own.dimension, own.known)).collect()
        };
        assert_eq!(gyroscopic(&area), [(2, 2)], "{plant}: {:?}", area.excluded);
        // A square: the terms of second order are needed.
        let blind = lagrangian(
            &format!("{wide}²*{wide}²"),
            &format!("{fast}² + ({w})*{rapid}²/2 + ({w})*{wide}²*{wide}²"),
        );
        let square = turned(&blind);
        let counts = gyroscopic(&square);
        assert!(counts.iter().any(|own| own.0 >= 3), "{plant}: {counts:?} {:?}", square.excluded);
        assert!(counts.iter().all(|own| own.1 <= own.0), "{plant}: {counts:?}");
        assert!(
            told(&square).iter().any(|(_, term)| term.contains("s3*")),
            "{plant}: {:?}",
            told(&square)
        );
        // Canonical equations, with the momenta p = Aᵀ P and a field of the rotor.
        let [up, across] =
            [format!("(({d})*p - ({c})*q)/({e})"), format!("(({a})*q - ({b})*p)/({e})")];
        let canonical = turned(&plane(
            &format!("(({up})² + ({across})²)/2 + ({big}² + {wide}²)²"),
            &format!("[[claim]]\nname = 'F'\nintegral = '{big}*({across}) - {wide}*({up})'\n"),
        ));
        assert_eq!(gyroscopic(&canonical), [(2, 2)], "{plant}: {:?}", canonical.excluded);
        // A bracket {m,m} = hat(B m), H = (m,B m) + (n,m)².
        let [one, two, three] = [numbers.next(), numbers.next(), 2];
        let form = format!("(({one})*u + ({two})*v + ({three})*w)");
        let rows = [[2, a, 1], [a, 3, c], [1, c, -5]];
        let row =
            |k: usize| format!("({})*u + ({})*v + ({})*w", rows[k][0], rows[k][1], rows[k][2]);
        let casimir = format!("(u*({}) + v*({}) + w*({}))", row(0), row(1), row(2));
        let rotor = turned(&format!(
            "title = 'x'\n[state]\nu = '-2..2'\nv = '-2..2'\nw = '-2..2'\n[hamiltonian]\n\
             function = '{casimir} + {form}²'\nbracket = {{ \"u,v\" = '{}', \"v,w\" = '{}', \"w,u\" = '{}' }}\n\
             [[claim]]\nname = 'F'\nintegral = '{form}'\n",
            row(2),
            row(0),
            row(1)
        ));
        assert!(gyroscopic(&rotor).contains(&(1, 1)), "{plant}: {:?}", rotor.excluded);
    }
}

#[test]
fn sines_of_parameters_are_the_reason_where_rates_have_no_values() {
    let foucault = |rate: &str| {
        format!(
            "title = 'x'\n[parameters]\n\"φ\" = '0..1.5'\n\"Ω\" = '0.1..1'\n[state]\nx = '-1..1'\ny = '-1..1'\n\
             u = '-1..1'\nv = '-1..1'\n[field]\nx = 'u'\ny = 'v'\nu = '−x + {rate}*v'\n\
             v = '−y − {rate}*u'\n[[claim]]\nname = 'F'\nintegral = '(u² + v² + x² + y²)/2'\n"
        )
    };
    let report = turned(&foucault("Ω*sin(φ)"));
    assert!(has_remark(&report, "have no values modulo a prime"), "{:?}", report.remarks);
    assert!(!has_remark(&report, "not of the form x' = u"), "{:?}", report.remarks);
    let report = turned(&foucault("Ω"));
    assert!(!has_remark(&report, "no search for gyroscopic terms"), "{:?}", report.remarks);
}
