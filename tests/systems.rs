//! The built-in ball on a surface and Lagrangian systems compared with reference values from
//! 100-digit arithmetic of separately written equations of motion.

mod common;

use common::{Reference, case, exact, rational, report, strings, text};
use serde_json::Value;

const OTHERS: &str = include_str!("data/others.json");

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
