//! The built-in ball on a surface and Lagrangian systems compared with reference values from
//! 100-digit arithmetic of separately written equations of motion.

use crate::common::{Reference, case, exact, rational, report, strings, text};
use serde_json::Value;

const OTHERS: &str = include_str!("../data/others.json");

const BALL: &str =
    "system = \"ball-on-surface\"\n[parameters]\nm = \"7/5\"\nR = \"3/4\"\nmu = \"4/9\"\n";
const TOP: &str = "[parameters]\nI = [[\"5/2\", \"2/5\", \"-3/7\"], [\"2/5\", \"17/8\", \"1/2\"], [\"-3/7\", \"1/2\", 3]]\n";

/// A built-in system with the names of its state in the reference; a number stands for itself.
struct Pair {
    key: &'static str,
    text: String,
    /// Components of the built-in state, in order.
    state: &'static [&'static str],
}

fn pairs() -> Vec<Pair> {
    let by_normal = &["M.0", "M.1", "M.2", "gamma.0", "gamma.1", "gamma.2"];
    vec![
        Pair {
            key: "ball_general_surface",
            text: format!(
                "{BALL}[body]\nsurface = \"r[1]^4 + 2/3*r[2]^4 + 3/2*r[3]^4 + r[1]*r[2] + r[3]/5\"\n\
                 potential = \"5/14*r[1]^2 + 11/8*r[3] + r[1]*r[2]*r[3]\"\n"
            ),
            state: &["M.0", "M.1", "M.2", "r.0", "r.1", "r.2"],
        },
        Pair {
            key: "ball_quadric",
            text: format!("{BALL}B = [2, 3, 5]\n[body]\nsupport = \"√(γ,B*γ)\"\n"),
            state: by_normal,
        },
        Pair {
            key: "ball_revolution_paraboloid",
            text: format!(
                "{BALL}[body]\nsupport = \"−5/6*(γ1² + γ2²)/γ3\"\npotential = \"4/5*r3\"\n"
            ),
            state: by_normal,
        },
        Pair {
            key: "ball_rotating_sphere",
            text: format!(
                "{BALL}[body]\nsupport = \"7/3*|γ|\"\npotential = \"4/5*r3\"\nrotation = \"6/5\"\n"
            ),
            state: by_normal,
        },
        Pair {
            key: "vakonomic_suslov",
            text: format!(
                "system = \"vakonomic\"\n{TOP}[state]\nω = \"vector(-2..2)\"\nλ = \"-2..2\"\n\
                 [lagrangian]\nkinetic = \"(ω,I*ω)/2\"\nquasi-velocities = [\"ω\"]\n\
                 algebra = \"so(3)\"\nmultipliers = [\"λ\"]\nconstraints = [\"ω3 = 0\"]\n"
            ),
            state: &["w1", "w2", "0", "l"],
        },
        Pair {
            key: "nonholonomic_suslov",
            text: format!(
                "system = \"nonholonomic\"\n{TOP}[state]\nω = \"vector(-2..2)\"\n\
                 [lagrangian]\nkinetic = \"(ω,I*ω)/2\"\nquasi-velocities = [\"ω\"]\n\
                 algebra = \"so(3)\"\nconstraints = [\"ω3 = 0\"]\n"
            ),
            state: &["w1", "w2", "0"],
        },
        // The commutators of the frame along and across the blade are computed.
        Pair {
            key: "skate_vakonomic",
            text: "system = \"vakonomic\"\n[parameters]\nJ = \"3/5\"\ng = \"7/4\"\n\
                   [state]\nx = \"-2..2\"\ny = \"-2..2\"\nφ = \"-3..3\"\nu = \"-2..2\"\nv = \"-2..2\"\n\
                   ω = \"-2..2\"\nλ = \"-2..2\"\n\
                   [field]\nx = \"u*cos(φ) − v*sin(φ)\"\ny = \"u*sin(φ) + v*cos(φ)\"\nφ = \"ω\"\n\
                   [lagrangian]\nkinetic = \"(u² + v² + J*ω²)/2\"\npotential = \"−g*x\"\n\
                   quasi-velocities = [\"u\", \"v\", \"ω\"]\nmultipliers = [\"λ\"]\n\
                   constraints = [\"−v = 0\"]\n"
                .to_string(),
            state: &["x", "y", "ph", "u", "0", "Om", "lam"],
        },
        Pair {
            key: "suslov_onesided_contact",
            text: "system = \"nonholonomic\"\n[parameters]\nJ = \"diag(2,3,4)\"\n\
                   [state]\nω = \"vector(-2..2)\"\n\
                   [lagrangian]\nkinetic = \"(ω,J*ω)/2\"\nquasi-velocities = [\"ω\"]\n\
                   algebra = \"so(3)\"\nconstraints = [\"2/7*ω1 + 3/7*ω2 + 6/7*ω3 = 0\"]\n"
                .to_string(),
            state: &["w.0", "w.1", "w.2"],
        },
    ]
}

/// Returns the entry of a reference state for a name such as `M.1` or `w1`.
fn entry<'v>(object: &'v Value, name: &str) -> &'v str {
    match name.split_once('.') {
        Some((vector, index)) => {
            let index: usize = index.parse().expect("an index");
            strings(&object[vector])[index]
        }
        None if name == "0" => "0",
        None => text(&object[name]),
    }
}

#[test]
fn built_in_systems_agree_with_the_reference() {
    let data: Value = serde_json::from_str(OTHERS).expect("JSON");
    let systems = data["systems"].as_array().expect("systems");
    let mut compared = 0;
    for pair in pairs() {
        // Keys that are not ASCII are quoted in TOML.
        let quoted: Vec<String> = pair
            .text
            .lines()
            .map(|line| match line.split_once(" = ") {
                Some((key, value)) if !key.is_ascii() => format!("\"{key}\" = {value}"),
                _ => line.to_string(),
            })
            .collect();
        let case = case(&format!("title = \"{}\"\n{}", pair.key, quoted.join("\n")));
        let system = systems.iter().find(|system| system["key"] == pair.key).expect("a system");
        let names = strings(&system["variables"]);
        for (i, state) in system["states"].as_array().expect("states").iter().enumerate() {
            let point: Vec<_> = pair
                .state
                .iter()
                .map(|name| rational(&exact(entry(&state["exact"], name))))
                .collect();
            let found = report(&case, &point);
            let rates = strings(&state["v"]);
            for (k, name) in pair.state.iter().enumerate() {
                let plain: String = match name.split_once('.') {
                    Some((vector, index)) => {
                        format!("{vector}{}", index.parse::<usize>().expect("an index") + 1)
                    }
                    None => name.to_string(),
                };
                let place = names.iter().position(|known| **known == plain);
                let rate = place.map_or("0", |place| rates[place]);
                let what = format!("{} at {i}: the rate of {plain}", pair.key);
                Reference::read(rate).assert_in(found.field[k], &what);
                compared += 1;
            }
        }
    }
    assert!(compared > 100, "{compared} rates were compared");
}

#[test]
fn parts_that_a_case_does_not_have_are_not_recorded() {
    use liouville::mechanics::EquationPart;
    use liouville::verdict::{EquationsSize, equations_size};
    let size = |system: &str, parameters: &str, body: &str| -> EquationsSize {
        let text = format!(
            "title = 'x'\nsystem = '{system}'\n[parameters]\nm = '1..2'\n{parameters}\n[body]\n{body}"
        );
        equations_size(&case(&text)).expect("it records")
    };
    let share = |size: &EquationsSize, part: EquationPart| {
        let found = size.parts.iter().find(|(own, _)| *own == part).expect("a possible part");
        found.1
    };
    let parameters =
        "R = '1..2'\nI = 'inertia(1..2)'\nS = 'vector(-1..1)'\na_g = '1..2'\nk = '-0.2..0.2'";
    let ball = "shape = 'ball'\n";
    for (plane, sphere) in [("rubber-plane", "rubber-sphere"), ("rolling-plane", "rolling-sphere")]
    {
        let bare = size(plane, parameters, ball);
        assert!(bare.parts.iter().all(|(_, share)| share.is_none()), "{bare:?}");
        let moment = "moment = '[γ2, γ3, 0]'";
        for (part, with) in [
            (EquationPart::Rotor, size(plane, parameters, &format!("{ball}gyrostat = 'S'"))),
            (
                EquationPart::Potential,
                size(plane, parameters, &format!("{ball}potential = 'a_g*γ1*γ2'")),
            ),
            (EquationPart::Moment, size(plane, parameters, &format!("{ball}{moment}"))),
            (EquationPart::Curvature, size(sphere, parameters, ball)),
        ] {
            let own = share(&with, part).expect("the part is there");
            assert!(own > 0, "{part:?}");
            assert_eq!(
                with.operations - own,
                bare.operations,
                "{part:?}: the rest is the bare body"
            );
        }
        let zero = size(plane, parameters, &format!("{ball}gyrostat = '0*S'\npotential = '0'"));
        assert_eq!(zero.operations, bare.operations, "parts that are 0 cost nothing");
        assert_eq!(share(&zero, EquationPart::Rotor), Some(0));
    }
    let parameters = "R = '0.2..0.3'\nmu = '1..2'\nturn = '1..2'";
    let surface = "surface = 'arbitrary'\n";
    let bare = size("ball-on-surface", parameters, surface);
    let forces = format!("{surface}potential = 'arbitrary'\nrotation = 'turn'\nframe = 'rotating'");
    let loaded = size("ball-on-surface", parameters, &forces);
    let shares = [EquationPart::Potential, EquationPart::Rotation].map(|part| share(&loaded, part));
    assert!(shares.iter().all(|share| share.is_some_and(|n| n > 0)), "{loaded:?}");
    assert!(loaded.operations > bare.operations);
}

#[test]
fn an_arbitrary_surface_takes_every_jet() {
    let claims = "[[claim]]\nname = 'F'\nintegral = 'F'\n[[claim]]\nname = 'measure'\ndensity = '|n|'\n\
                  [[claim]]\nname = 'sum'\nidentity = 'F = F + n[1]'\nexpect = 'fails'\n";
    let text = |more: &str| {
        format!(
            "title = 'x'\nsystem = 'ball-on-surface'\n[parameters]\nm = 1\nR = '0.2..0.3'\nmu = '1..2'\n\
             [body]\nsurface = 'arbitrary'\npotential = 'arbitrary'\n{claims}{more}"
        )
    };
    let count = |text: &str, prefix: &str| {
        let model = case(text).model;
        model.parameters.iter().filter(|own| own.name.starts_with(prefix)).count()
    };
    // (n + 1)(n + 2)(n + 3)/6 monomials up to degree n.
    assert_eq!(["F[", "U["].map(|prefix| count(&text(""), prefix)), [20, 10], "degrees 3 and 2");
    let two = "[[claim]]\nname = 'reversal'\nreversor = { M = '−M' }\n";
    assert_eq!(["F[", "U["].map(|prefix| count(&text(two), prefix)), [84, 35], "degrees 6 and 4");
    let options = liouville::verdict::Options::default();
    for claim in liouville::verdict::judge(&case(&text("")), &options).expect("verdicts").claims {
        assert!(claim.agrees, "{}: {:?}", claim.name, claim.verdict);
    }
}
