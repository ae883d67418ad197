//! Integrals with sines, cosines and exponentials of cyclic coordinates.

use super::{Effort, SearchReport, searched};
use liouville_search::FoundKind;

/// A Hamiltonian system in r, p and the cyclic s with its momentum q.
fn cyclic(function: &str) -> SearchReport {
    let text = format!(
        "title = 'x'\n[parameters]\na = '0.5..0.9'\n[state]\nr = '0.5..1'\ns = '-1..1'\np = '-1..1'\nq = '1..2'\n\
         [hamiltonian]\nfunction = '{function}'\npairs = [['r', 'p'], ['s', 'q']]\n"
    );
    searched(&text, &Effort::default())
}

#[test]
fn integrals_with_functions_of_cyclic_coordinates_are_found() {
    let cases = [
        // Laplace's vector, the tensor of an oscillator, a cone.
        ("p²/2 + q²/(2*r²) - a/r", "sin(s)"),
        ("p²/2 + q²/(2*r²) + r²/2", "cos(2*s)"),
        ("p²/2 + q²/(2*a²*r²)", "cos(a*s)"),
        // Boosts of the hyperbolic plane, and of an accelerated frame.
        ("p²/2 + q²/(2*cosh(r)²)", "exp(s)"),
        ("p²/2 - q²/(2*(1 + a*r)²)", "exp(a*s)"),
    ];
    for (function, wanted) in cases {
        let found = cyclic(function);
        let own: Vec<&str> = found.formulas(FoundKind::Integral).collect();
        assert!(own.len() == 2 && own[1].contains(wanted), "{function}: {own:?}");
    }
}

#[test]
fn fields_have_them_too_and_other_forces_have_none() {
    let polar = "title = 'x'\n[state]\nr = '1..2'\ns = '-1..1'\nu = '-1..1'\nw = '1..2'\n[field]\n\
                 \"r'\" = 'u'\n\"s'\" = 'w'\n\"u'\" = 'r*w² - 1/r²'\n\"w'\" = '-2*u*w/r'\n";
    let found = searched(polar, &Effort::default());
    let own: Vec<&str> = found.formulas(FoundKind::Integral).collect();
    assert_eq!(own[0], "r²*w");
    assert!(own.iter().any(|own| own.contains("sin(s)")), "{own:?}");
    let found = cyclic("p²/2 + q²/(2*r²) + r³/3");
    assert_eq!(found.formulas(FoundKind::Integral).collect::<Vec<_>>(), ["q"]);
}
