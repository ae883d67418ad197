//! Searches of maps: integrals written out, and theorems that exclude no planted one.

use std::path::Path;

use liouville::case::Case;
use liouville_search::{
    Ansatz, ConditionTarget, Effort, FoundKind, Hamiltonians, Remark, SearchReport, search,
};

use super::{excluded, searched};

/// A map in as many of x, y, z as there are images.
pub fn map(parameters: &str, images: &[&str]) -> String {
    let names = ["x", "y", "z"];
    let each = |line: &dyn Fn(&str, &str) -> String| -> String {
        names.iter().zip(images).map(|(name, image)| line(name, image)).collect()
    };
    let state = each(&|name, _| format!("{name} = '0.5..2'\n"));
    let images = each(&|name, image| format!("{name} = '{image}'\n"));
    format!("title = 'x'\n[parameters]\n{parameters}\n[state]\n{state}[map]\n{images}")
}

#[test]
fn integrals_of_known_maps_are_written_out() {
    let cases = [
        ("Lyness", map("a = '0.5..2'", &["y", "(a + y)/x"]), 1),
        ("Lyness, of third order", map("a = '0.5..2'", &["y", "z", "(a + y + z)/x"]), 2),
        ("McMillan", map("a = '0.5..2'", &["y", "-x + 2*a*y/(1 + y²)"]), 1),
        ("a rotation by 3-4-5", map("", &["3/5*x - 4/5*y", "4/5*x + 3/5*y"]), 1),
        ("a shear", map("", &["x + y", "y"]), 1),
    ];
    for (name, text, count) in cases {
        let report = searched(&text, &Effort::default());
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            count,
            "{name}: {:?}",
            report.found
        );
    }
}

#[test]
fn integrals_over_a_density_are_short_and_found_in_other_coordinates() {
    let own = map("", &["y", "z", "(1 + y + z)/x"]);
    let other = map("", &["y + 2*x", "z − 2*(y + 2*x)", "(1 + y + 2*x + z)/x"]);
    for (text, below) in [(own, "/(x*y*z)"), (other, "/(x*z*(2*x + y))")] {
        let report = searched(&text, &Effort::default());
        let short = report.formulas(FoundKind::Integral).filter(|own| own.ends_with(below));
        assert_eq!(short.count(), 2, "of order 8: {:?}", report.found);
    }
}

#[test]
fn a_chaotic_map_has_no_rational_integral() {
    let henon =
        searched(&map("a = '0.5..2'\nb = '0.5..2'", &["y", "1 - a*y² + b*x"]), &Effort::default());
    assert_eq!(excluded(&henon), Some(8), "{:?}", henon.excluded);
    assert_eq!(henon.formulas(FoundKind::Integral).count(), 0);
}

#[test]
fn maps_onto_a_curve_exclude_nothing() {
    // All images are on the x-axis, on which x² takes its place.
    let flat = searched(&map("", &["x²", "0*x"]), &Effort::default());
    assert_eq!(excluded(&flat), None, "{:?}", flat.excluded);
}

#[test]
fn the_orbits_of_maps_onto_a_curve_or_a_point_are_not_counted() {
    for images in [&["x + y", "2*(x + y)"][..], &["3", "2"], &["x + y", "x*y", "x*y + 1"]] {
        let report = searched(&map("", images), &Effort::default());
        assert!(report.orbits.is_empty(), "{images:?}: {:?}", report.orbits);
        let says = |own: &Remark| own.contains("the images of the map do not fill the space");
        assert!(report.remarks.iter().any(says), "{images:?}: {:?}", report.remarks);
    }
    let shear = searched(&map("", &["x + y", "y"]), &Effort::default());
    assert_eq!(shear.orbits.last().map(|own| own.integrals), Some(1), "{:?}", shear.orbits);
}

#[test]
fn planted_integrals_of_maps_are_not_excluded() {
    for (own, kept) in [("y", 1), ("y + k*x²", 2), ("x*y", 2)] {
        let images = match own {
            "y" => ["x + y²/(1 + y²)", "y"],
            // With w = y + k x² kept and x ↦ x + w.
            "y + k*x²" => ["x + y + k*x²", "y + k*x² - k*(x + y + k*x²)²"],
            // With w = x y kept and x ↦ x (1 + w).
            _ => ["x*(1 + x*y)", "y/(1 + x*y)"],
        };
        let report = searched(&map("k = '0.5..2'", &images), &Effort::default());
        let degree = excluded(&report).unwrap_or(0);
        assert!(degree < kept, "{own} is an integral of degree {kept}: {:?}", report.excluded);
        assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{own}: {:?}", report.found);
    }
}

#[test]
fn options_for_fields_are_noted() {
    let asked = Effort {
        conditions: Some(ConditionTarget::Existence),
        poisson: Some(Hamiltonians::Known),
        ansatz: Ansatz { wanted: true, ..Ansatz::default() },
        ..Effort::default()
    };
    let shear = map("", &["x + y", "y"]);
    let remarks = searched(&shear, &asked).remarks;
    for option in ["--conditions", "--poisson", "--ansatz"] {
        assert!(remarks.iter().any(|own| own.starts_with(option)), "{option}: {remarks:?}");
    }
    assert!(searched(&shear, &Effort::default()).remarks.is_empty(), "nothing was asked");
}

/// Formulas of the densities that are found.
fn densities(report: &SearchReport) -> Vec<&str> {
    report.formulas(FoundKind::Density).collect()
}

#[test]
fn densities_of_the_maps_of_the_catalogue_are_found() {
    let known = [
        ("kahan-lotka-volterra", true),
        ("kahan-nahm", true),
        ("kahan-cubic", true),
        ("kahan-euler", true),
        ("lyness", true),
        ("mcmillan", true),
        ("henon-areas", true),
    ];
    for (name, is_written) in known {
        let path = format!("{}/../../cases/classical/maps/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let case = Case::read(Path::new(&path), &[]).1.expect("a case of the catalogue");
        let effort = Effort { blind: true, ..Effort::default() };
        let report = search(&case, &effort, &mut |_| {}).expect("it can be searched");
        assert_eq!(densities(&report).len(), usize::from(is_written), "{name}: {:?}", report.found);
        let is_noted = report.remarks.iter().any(|own| own.contains("a density of degree"));
        assert_eq!(is_noted, !is_written, "{name}: {:?}", report.remarks);
    }
}

#[test]
fn planted_densities_are_found_in_other_coordinates() {
    // Kahan's map of x' = x(1 − y), y' = y(x − 1) in x = u + 2 v, y = 3 u − v.
    let (x, y) = ("(x + 2*y)", "(3*x - y)");
    let below = format!("(1 - h²/4 + h*(1 + h/2)*{y}/2 - h*(1 - h/2)*{x}/2)");
    let first = format!("{x}*((1 + h/2)*(1 + h/2 - h*{x}/2) - h/2*(1 - h/2)*{y})/{below}");
    let second = format!("{y}*((1 - h/2)*(1 - h/2 + h*{y}/2) + h/2*(1 + h/2)*{x})/{below}");
    let images = [format!("({first} + 2*{second})/7"), format!("(3*{first} - {second})/7")];
    let report = searched(&map("h = '0.1..0.5'", &[&images[0], &images[1]]), &Effort::default());
    assert_eq!(densities(&report), ["1/((x + 2*y)*(y − 3*x))"], "{:?}", report.remarks);
    // X = x, Y = y (1 + x²)/k with a map of X, Y that keeps areas, and its inverse factor.
    let forward = "(y*(1 + x²)/k)";
    let images = [forward.to_string(), format!("k*(-x + {forward}²)/(1 + {forward}²)")];
    let report = searched(&map("k = '0.5..2'", &[&images[0], &images[1]]), &Effort::default());
    assert_eq!(densities(&report), ["1 + x²"]);
    let forward = "(y*k/(1 + x²))";
    let images = [forward.to_string(), format!("(-x + {forward}²)*(1 + {forward}²)/k")];
    let report = searched(&map("k = '0.5..2'", &[&images[0], &images[1]]), &Effort::default());
    assert_eq!(densities(&report), ["1/(1 + x²)"]);
    // A reflection keeps the density with the other sign.
    let report = searched(&map("", &["y", "x"]), &Effort::default());
    assert_eq!(densities(&report), ["1"]);
    let report = searched(&map("b = '0.5..0.9'", &["y", "1 - y² + b*x"]), &Effort::default());
    assert_eq!(densities(&report), [""; 0], "it is dissipative");
}

#[test]
fn the_order_of_a_map_is_told_with_sums_over_its_orbits() {
    let cases = [
        ("the identity", map("", &["x", "y"]), Some("the map is the identity, proved"), 2),
        ("an inversion", map("a = '0.5..2'", &["a/x", "y"]), Some("Φ^2 = id, proved"), 2),
        ("a cycle", map("", &["y", "z", "x"]), Some("Φ^3 = id, proved"), 3),
        ("Lyness with a = 1", map("", &["y", "(1 + y)/x"]), Some("Φ^5 = id, proved"), 2),
        ("a rotation by a quarter", map("", &["-y", "x"]), Some("Φ^4 = id, proved"), 2),
        ("Lyness", map("a = '0.5..2'", &["y", "(a + y)/x"]), None, 1),
        ("a shear", map("", &["x + y", "y"]), None, 1),
        ("signs", map("k = 'one of 1, -1'", &["k*x", "k*y"]), Some("Φ^2 = id, proved"), 2),
        ("roots", map("k = 'one of 1, 0'", &["-y", "x + k*y"]), Some("Φ^12 = id, proved"), 0),
        ("a list with a shear", map("k = 'one of 0, 1'", &["x + k*y", "y"]), None, 1),
    ];
    for (name, text, order, count) in cases {
        let report = searched(&text, &Effort::default());
        let own = report.remarks.iter().find(|own| own.starts_with("the map "));
        match (own, order) {
            (Some(own), Some(order)) => assert!(own.contains(order), "{name}: {own}"),
            (own, order) => assert_eq!(own.map(|own| &**own), order, "{name}"),
        }
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            count,
            "{name}: {:?}",
            report.found
        );
    }
    let level = "title = 'x'\nsystem = 'map'\n[state]\nx = '0.5..2'\ny = '0.5..2'\nz = '0.5..2'\n[level]\n\
                 equations = ['x*y*z = 1']\n[map]\nx = 'y'\ny = 'z'\nz = 'x'\n";
    let report = searched(level, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 2, "{:?}", report.found);
}

#[test]
fn coordinates_that_a_map_keeps_are_integrals() {
    let maps = [
        (["x + sin(y)", "y"], vec!["1"]),
        (["x*exp(y)", "y"], vec!["1/x"]),
        (["√(x² + 1)", "y"], vec!["x"]),
        (["x + sin(y)", "-y"], vec!["1"]),
    ];
    for (images, densities) in maps {
        let report = searched(&map("", &images), &Effort::default());
        let kept: Vec<&str> = report.formulas(FoundKind::Integral).collect();
        // An even function is kept by −y.
        let own = if images[1] == "y" { "y" } else { "cos(y)" };
        assert_eq!(kept, [own], "{images:?}");
        assert_eq!(
            report.formulas(FoundKind::Density).collect::<Vec<_>>(),
            densities,
            "{images:?}"
        );
    }
}

#[test]
fn maps_by_monomials_have_integrals_with_logarithms() {
    let maps = [
        ("", vec!["x²", "y²"], 1),
        ("", vec!["x²*y", "x*y"], 1),
        ("", vec!["x²", "y³"], 1),
        ("", vec!["x²", "1/y²"], 1),
        ("", vec!["1/(x²*y)", "1/(x*y)"], 1),
        ("c = '0.5..2'", vec!["c*x²", "y²"], 1),
        ("c = '0.5..2'", vec!["c*x²", "y³/c"], 1),
        ("a = '2..3'", vec!["x^a", "y^a"], 1),
        ("", vec!["√x", "√y"], 1),
        ("", vec!["y*z", "z*x", "x*y"], 2),
    ];
    for (parameters, images, count) in maps {
        let report = searched(&map(parameters, &images), &Effort::default());
        assert_eq!(
            report.formulas(FoundKind::Integral).count(),
            count,
            "{images:?}: {:?}",
            report.found
        );
    }
    let square = searched(&map("", &["x²", "y²"]), &Effort::default());
    let own: Vec<&str> = square.formulas(FoundKind::Integral).collect();
    assert!(own == ["ln(y)/ln(x)"] || own == ["ln(x)/ln(y)"], "{own:?}");
    // Sums are no monomials.
    let other = searched(&map("", &["x² + 1", "y²"]), &Effort::default());
    assert_eq!(other.formulas(FoundKind::Integral).count(), 0, "{:?}", other.found);
}

#[test]
fn logarithms_are_those_of_moduli_where_signs_are_open() {
    let text = "title = 'x'\n[state]\nx = '-2..2'\ny = '-2..2'\n[map]\nx = 'x³*y'\ny = 'y³'\n";
    let report = searched(text, &Effort::default());
    assert!(
        report.formulas(FoundKind::Integral).all(|own| own.contains("|x|")),
        "{:?}",
        report.found
    );
    let text = text.replace("x³*y", "x³");
    let report = searched(&text, &Effort::default());
    assert_eq!(report.formulas(FoundKind::Integral).count(), 1, "{:?}", report.found);
}

#[test]
fn densities_of_maps_may_be_fractions() {
    // X = x, Y = y (1 + x²)/x with a map of X, Y that keeps areas.
    let forward = "(y*(1 + x²)/x)";
    let images = [forward.to_string(), format!("(-x + {forward}²)*{forward}/(1 + {forward}²)")];
    let report = searched(&map("", &[&images[0], &images[1]]), &Effort::default());
    assert_eq!(densities(&report).len(), 1, "{:?} {:?}", report.found, report.remarks);
    assert!(densities(&report)[0].contains('/'), "{:?}", densities(&report));
    let forward = "(y*(k + x)/(1 + x))";
    let images =
        [forward.to_string(), format!("(-x + {forward}²)*(1 + {forward})/(k + {forward})")];
    let report = searched(&map("k = '2..3'", &[&images[0], &images[1]]), &Effort::default());
    assert_eq!(densities(&report).len(), 1, "{:?} {:?}", report.found, report.remarks);
}

#[test]
fn densities_of_maps_with_functions_are_found() {
    for (parameters, images, density) in [
        ("", ["x*exp(y)", "y"], "1/x"),
        ("", ["√(x² + y²)", "y"], "x"),
        ("", ["x + sin(y)", "y"], "1"),
        ("a = '1..2'", ["x*exp(a*y)*y", "y/2"], ""),
        ("", ["x^3", "y/3"], ""),
        // x y and x + y are kept up to factors: dx dy/(x y) is.
        ("", ["x*exp(x*y)", "y*exp(-x*y)"], "1"),
        ("", ["x*y*exp(-x)", "1/x"], "1/(x*y)"),
    ] {
        let report = searched(&map(parameters, &images), &Effort::default());
        let found = densities(&report);
        match density {
            "" => assert!(found.len() <= 1, "{images:?}: {found:?}"),
            density => assert_eq!(found, [density], "{images:?}: {:?}", report.remarks),
        }
    }
    // It takes two states to one, so the equation alone says nothing of a measure.
    let text = map("", &["√(x² + y²)", "y"]).replace("x = '0.5..2'", "x = '-2..2'");
    let report = searched(&text, &Effort::default());
    assert_eq!(densities(&report), [""; 0], "{text}");
    let is_noted = |own: &Remark| own.contains("the density x: Φ takes");
    assert!(report.remarks.iter().any(is_noted), "{:?}", report.remarks);
}

#[test]
fn integrals_of_maps_with_functions_are_found() {
    let integrals = |images: &[&str]| {
        let report = searched(&map("", images), &Effort::default());
        report.formulas(FoundKind::Integral).map(ToString::to_string).collect::<Vec<_>>()
    };
    assert_eq!(integrals(&["x*exp(x*y)", "y*exp(-x*y)"]), ["x*y"]);
    assert_eq!(integrals(&["x + ln(y)", "y"]), ["y"]);
    // ln x − y changes by 0.
    let found = integrals(&["x*exp(sin(x))", "y + sin(x)"]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("ln(x)"), "{found:?}");
    assert_eq!(integrals(&["x*exp(y)", "y + x"]), [""; 0]);
}
