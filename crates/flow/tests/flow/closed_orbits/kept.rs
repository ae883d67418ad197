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
