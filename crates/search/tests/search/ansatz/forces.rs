//! Potentials and forces that integrals survive, of systems of the user's own and of a flat base.

use liouville::case::{Case, Expect, Setting};
use liouville::claim::Claim;
use liouville::verdict::{Options, Verdict, judge};
use liouville_search::{Remark, SearchReport, search};

use super::{case, effort, told};

fn forced(text: &str) -> SearchReport {
    let mut wanted = effort(2);
    wanted.ansatz.potentials = true;
    search(&case(text), &wanted, &mut |_| {}).expect("it can be searched")
}

/// Dimension of the space of potentials or forces by the theorem on an integral, and how many are told.
fn counted(report: &SearchReport, integral: &str) -> Option<(usize, usize)> {
    let is_own = |theorem: &str| theorem.contains(&format!("allow an integral {integral} + G("));
    let own = report.excluded.iter().find(|own| is_own(&own.theorem));
    own.map(|own| (own.dimension, own.known))
}

/// A particle with a kinetic energy, a potential and an integral.
fn particle(kinetic: &str, potential: &str, integral: &str) -> String {
    format!(
        "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nm = '0.5..2'\n[state]\nx = '0.5..2'\n\
         y = '0.5..2'\n\"x'\" = '-1..1'\n\"y'\" = '-1..1'\n[lagrangian]\nkinetic = \"{kinetic}\"\n\
         potential = '{potential}'\n[[claim]]\nname = 'F'\nintegral = \"{integral}\"\n"
    )
}

#[test]
fn potentials_of_a_lagrangian_are_found() {
    let area = forced(&particle("m*(x'² + y'²)/2", "0*x", "x*y' − y*x'"));
    let central = ("x*y' − y*x'", "f1(x² + y²) for any function f1");
    assert!(told(&area).contains(&central), "{:?}", told(&area));
    assert_eq!(counted(&area, "x*y' − y*x'"), Some((6, 6)), "r², r⁴, …: {:?}", area.excluded);
    // What separates stays separate, with any function; the own potential is kept.
    let apart = forced(&particle("(x'² + y'²)/2", "x²*x² + y²/2", "x'²/2 + x^4"));
    let found = told(&apart);
    assert!(!found.is_empty(), "{:?}", apart.remarks);
    for (integral, potential) in found {
        assert_eq!(potential, "f1(x) + f2(y) for any functions f1, f2");
        assert_ne!(integral.contains("f1(x)"), integral.contains("f2(y)"), "{integral}");
    }
}

#[test]
fn squares_of_momenta_survive_what_separates() {
    let free = forced(&particle("(x'² + y'²)/2", "0*x", "x'"));
    let found = told(&free);
    let separate = ("x'² + 2*f2(x)", "f1(y) + f2(x) for any functions f1, f2");
    assert!(found.contains(&separate), "{found:?}");
    assert!(found.contains(&("x'", "f1(y) for any function f1")), "{found:?}");
    let area = forced(&particle("(x'² + y'²)/2", "0*x", "x*y' − y*x'"));
    let polar = |(integral, potential): &(&str, &str)| {
        integral.starts_with("(x*y' − y*x')² +") && potential.contains("ε1*(1/x²)")
    };
    assert!(told(&area).iter().any(polar), "1/x² is (1 + tan²φ)/r²: {:?}", told(&area));
}

#[test]
fn potentials_of_hamiltons_equations_are_found() {
    let plane = |function: &str, claims: &str| {
        format!(
            "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\np = '-1..1'\nq = '-1..1'\n[hamiltonian]\n\
             function = '{function}'\npairs = [['x','p'],['y','q']]\n{claims}"
        )
    };
    let kepler = forced(&plane("(p² + q²)/2 - 1/√(x² + y²)", ""));
    let found = told(&kepler);
    assert!(found.contains(&("x*q − y*p", "f1(x² + y²) for any function f1")), "{found:?}");
    // Laplace's vector survives what separates in parabolas: 2y, 1/x², x² + 4y², …
    let laplace = "y/√(x² + y²) + x*p*q − y*p²";
    assert_eq!(counted(&kepler, laplace), Some((5, 5)), "{:?}", kepler.excluded);
    let (_, potential) =
        found.iter().find(|(integral, _)| integral.starts_with(laplace)).expect("it");
    for part in ["(2*y)", "(1/x²)", "(x² + 4*y²)"] {
        assert!(potential.contains(part), "{part}: {potential}");
    }
    // Γ commutes with itself, M does not: potentials are functions of γ.
    let top = |bracket: &str, level: &str| {
        format!(
            "title = 'x'\n[parameters]\nA = '0.5..2'\nC = '0.5..2'\n[state]\nM = 'vector(-2..2)'\n\
             \"γ\" = 'vector(-1..1)'\n{level}[hamiltonian]\nfunction = '(M1² + M2²)/(2*A) + M3²/(2*C)'\n\
             bracket = {{ structure = '{bracket}' }}\n"
        )
    };
    let sphere = "[level]\nequations = ['(γ,γ) = 1']\n";
    let lagrange = forced(&top("e(3)", sphere));
    let found = told(&lagrange);
    assert!(found.contains(&("M3", "f1(γ3) for any function f1")), "{found:?}");
    assert!(found.contains(&("(M,γ)", "f1(γ1, γ2, γ3) for any function f1")), "{found:?}");
    // On a level of other functions potentials that are equal there act in different ways.
    let plain = "title = 'x'\n[state]\nx = '0.5..2'\np = '-1..1'\n[level]\nequations = ['x = 1']\n\
                 [hamiltonian]\nfunction = '0*p + x²'\npairs = [['x','p']]\n";
    let report = forced(plain);
    let says = |own: &Remark| own.contains("are no Casimir functions");
    assert!(report.remarks.iter().any(says), "{:?}", report.remarks);
}

#[test]
fn forces_of_a_field_are_found() {
    let field = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nu = '-1..1'\nv = '-1..1'\n[field]\n\
                 \"x'\" = 'u'\n\"y'\" = 'v'\n\"u'\" = '-x'\n\"v'\" = '-y'\n";
    let report = forced(field);
    let central =
        "f1(x, y)*(x) in the rate of u, f1(x, y)*(y) in the rate of v for any function f1";
    assert!(told(&report).contains(&("x*v − y*u", central)), "{:?}", told(&report));
    // The energy along x survives any force along y, and forces along x that depend on x.
    let along = told(&report).into_iter().find(|(own, _)| own.starts_with("x² + u²")).expect("it");
    assert!(along.1.contains("f1(x, y) in the rate of v"), "{along:?}");
    assert!(along.0.contains("2/x") && along.1.contains("(1/x²)"), "{along:?}");
    let vectors = field_of_vectors();
    assert!(!told(&vectors).is_empty(), "{:?}", vectors.remarks);
    let lorenz = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\n[field]\n\
                  \"x'\" = '10*(y - x)'\n\"y'\" = 'x*(28 - z) - y'\n\"z'\" = 'x*y - z'\n";
    let says = |own: &Remark| own.contains("linear in the others, as x' = u has");
    assert!(forced(lorenz).remarks.iter().any(says), "it is no equation of motion");
}

/// Particle in space, by vectors.
fn field_of_vectors() -> SearchReport {
    forced(
        "title = 'x'\n[state]\nr = 'vector(0.5..2)'\nw = 'vector(-1..1)'\n[field]\n\"r'\" = 'w'\n\
         \"w'\" = '[0, 0, -r3]'\n",
    )
}

#[test]
fn a_flat_base_takes_a_potential() {
    let base = |body: &str| {
        format!(
            "title = 'x'\nsystem = 'flat-base'\n[parameters]\nm = '0.5..2'\nk = '0.2..2'\na = '0.5..2'\n\
             I = 'inertia(0.5..5)'\n[body]\nheight = '0'\n{body}"
        )
    };
    let report = forced(&base(""));
    let integral = "(Ĩ*ω,Ĩ*ω) − m*(r1² + r2²)*(Ĩ*ω,ω)";
    assert_eq!(counted(&report, integral), Some((4, 4)), "{:?}", report.excluded);
    // The energy is an integral, and so is what was found, of the body with this potential.
    let case = case(&base("potential = 'a*(r1² + r2²)'\n"));
    let formulas =
        ["energy", "(Ĩ*ω,Ĩ*ω) − m*(r1² + r2²)*(Ĩ*ω,ω) + 2*a*(I2*r1² + I1*r2²)", integral];
    let formulas = formulas.map(|text| case.formula(text).expect("a formula"));
    let verdicts = formulas.map(|formula| {
        let report = case.judge(&[Claim::integral(&formula)], &Options::default());
        report.expect("it can be judged").claims[0].verdict
    });
    assert_eq!(verdicts[..2], [Verdict::Proved; 2]);
    assert_eq!(verdicts[2], Verdict::Refuted, "without the term of the potential");
    let wrong = Case::parse(&base("potential = 'a*ω1'\n"), &[] as &[Setting]);
    let message = wrong.expect_err("a potential depends on the place").to_string();
    assert!(message.contains("may depend on r1, r2 and parameters only, not on `ω1`"), "{message}");
}

#[test]
fn families_need_a_constant_ratio() {
    // Of x² + u² the term of U = x is −2x, that of U = y none: f(x, y) would be wrong.
    let text = "title = 'x'\n[state]\nx = '0.5..2'\ny = '0.5..2'\np = '-1..1'\nq = '-1..1'\n[hamiltonian]\n\
                function = '(p² + q²)/2'\npairs = [['x','p'],['y','q']]\n\
                [[claim]]\nname = 'F'\nintegral = 'p²/2'\n[[claim]]\nname = 'G'\nintegral = '(x*q − y*p)²'\n";
    let report = forced(text);
    for (integral, potential) in told(&report) {
        assert!(!potential.contains("f1(x, y)"), "{integral} with {potential}");
    }
}

#[test]
fn the_case_of_a_flat_base_with_potentials_holds() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases/open/flat-base-potentials.toml");
    let case = Case::read(std::path::Path::new(path), &[]).1.expect("a case");
    let report = judge(&case, &Options::default()).expect("it can be judged");
    for (claim, own) in case.claims.iter().zip(&report.claims) {
        let holds = claim.expect == Expect::Holds;
        let wanted = if holds { Verdict::Proved } else { Verdict::Refuted };
        assert_eq!(own.verdict, wanted, "{}", claim.name);
    }
}
