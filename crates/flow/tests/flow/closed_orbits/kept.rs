//! Functions that closed orbits are proved to keep, whatever a file calls them.

use super::judged;
use liouville::verdict::Verdict;

#[test]
fn a_file_may_give_the_name_of_the_energy_to_another_function() {
    // A damped oscillator: its energy falls, and the 3 that the file calls `energy` is constant.
    let damped = judged(
        "title = 'x'\n[state]\nx = '-2..2'\n\"x'\" = '-2..2'\n[lagrangian]\nkinetic = \"x'^2/2\"\npotential = 'x²/2'\n\
         forces = { x = \"-x'/10\" }\n[let]\nenergy = '3'\n[[claim]]\nclosed-orbit = 6.29\n\
         state = { x = '1', \"x'\" = '0' }\n",
    );
    assert_ne!(damped.verdict, Verdict::Proved, "{:?}", damped.evidence.theorem);
    // A pendulum with a constant torque, whose own energy is kept with its work alone.
    let torque = |name: &str, integrals: &str, period: &str| {
        judged(&format!(
            "title = 'x'\n[state]\nq = '-3..3'\n\"q'\" = '-3..3'\n[lagrangian]\nkinetic = \"q'^2/2\"\n\
             potential = '-cos(q)'\nforces = {{ q = '1/10' }}\n[let]\n{name} = \"q'^2/2 - cos(q) - q/10\"\n[[claim]]\n\
             closed-orbit = {period}\nstate = {{ q = '1', \"q'\" = '0' }}\n{integrals}"
        ))
        .verdict
    };
    assert_ne!(torque("energy", "", "6.743"), Verdict::Proved, "the period is 6.62897");
    assert_eq!(torque("H", "integrals = ['H']\n", "6.629"), Verdict::Proved);
    assert_eq!(torque("energy", "integrals = ['energy']\n", "6.629"), Verdict::Proved);
}

#[test]
fn constraints_and_equations_of_vectors_are_kept_as_functions() {
    let pendulum = judged(
        "title = 'x'\nsystem = 'nonholonomic'\n[state]\nx = '-2..2'\ny = '-2..2'\n\"x'\" = '-2..2'\n\
         \"y'\" = '-2..2'\n[lagrangian]\nkinetic = \"(x'^2+y'^2)/2\"\npotential = 'y'\nconstraints = ['x^2+y^2 = 1']\n\
         [[claim]]\nclosed-orbit = 6.74300141925\nstate = { x = '0', y = '-1', \"x'\" = '1', \"y'\" = '0' }\n",
    );
    assert_eq!(pendulum.verdict, Verdict::Proved, "{:?}", pendulum.evidence.reason);
    let plane = judged(
        "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = 'vector(2, -1..1)'\n[field]\n\
         \"x'\" = '-y + x*(1 - x² - y²)'\n\"y'\" = 'x + y*(1 - x² - y²)'\n\"z'\" = '-z'\n[level]\n\
         equations = ['z = [0,0]']\n[[claim]]\nclosed-orbit = 6.2831853072\n\
         state = { x = '1', y = '0', z = '[0,0]' }\n",
    );
    assert_eq!(plane.verdict, Verdict::Proved, "{:?}", plane.evidence.reason);
}

#[test]
fn functions_that_jump_along_a_motion_are_not_kept() {
    // z grows for ever, and atan2 falls back by 2π at each turn.
    let turning = |level: &str, integrals: &str| {
        judged(&format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-10..10'\n[let]\nF = 'z - atan2(y,x)/1000'\n[field]\n\
             \"x'\" = 'x*(1-x²-y²) - y'\n\"y'\" = 'y*(1-x²-y²) + x'\n\"z'\" = '1/1000'\n{level}[[claim]]\n\
             closed-orbit = 6.28\nstate = {{ x = '1' }}\n{integrals}"
        ))
    };
    let grows = turning("", "integrals = ['F']\n");
    assert_ne!(grows.verdict, Verdict::Proved, "{:?}", grows.evidence.theorem);
    let grows = turning("[level]\nequations = ['F = 0']\n", "");
    assert_ne!(grows.verdict, Verdict::Proved, "{:?}", grows.evidence.theorem);
    // The function jumps where x = 0, or has a value for x > 3/2 alone.
    let springs = |function: &str| {
        judged(&format!(
            "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\nz = '-1/2..1/2'\n[let]\nH = 'y²/2+(1+z)*x²/2'\n[field]\n\
             \"x'\" = 'y'\n\"y'\" = '-(1+z)*x'\n\"z'\" = '0'\n[[claim]]\nclosed-orbit = 6.28\nstate = {{ x = '1' }}\n\
             integrals = ['H', '{function}']\n"
        ))
        .verdict
    };
    assert_ne!(springs("z + atan2(x, 0)/1000"), Verdict::Proved);
    assert_ne!(springs("z + (√((x - 3/2)²) - (x - 3/2))*x/1000 + 0*√(x - 3/2)"), Verdict::Proved);
    assert_eq!(springs("z"), Verdict::Proved);
}

#[test]
fn the_energy_is_kept_also_where_its_name_means_another_function() {
    let own = judged(
        "title = 'x'\n[state]\nq = '-2..2'\np = '-2..2'\n[let]\nenergy = 'q'\n[hamiltonian]\n\
         function = 'p²/2 + q²/2 + q⁴/4'\npairs = [['q', 'p']]\n[[claim]]\nclosed-orbit = 4.768022\n\
         state = { q = '1', p = '0' }\n",
    );
    assert_eq!(own.verdict, Verdict::Proved, "{:?}", own.evidence.reason);
}
