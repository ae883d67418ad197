//! Library of terms for integrals and densities, in the names of a case.
//!
//! Coefficients of the terms are unknown rational numbers, the same for all values of the
//! parameters; the terms themselves therefore contain parameters. A term that uses a name the case
//! does not have, or has with another type, is not offered.

use super::tensors;
use super::terms::{one, product};
use liouville::formula::{Formula, FormulaResult, Type};
use liouville::mechanics::{Meaning, Model, System};

/// Largest number of linear forms whose products are offered.
const SQUARED: usize = 48;

fn model_name(model: &Model, name: &str) -> Option<Formula> {
    Formula::name(name, &model.vocabulary).ok()
}

fn has(model: &Model, name: &str, kind: Type) -> bool {
    let own = |meaning| !matches!(meaning, Meaning::Abbreviation(_));
    model.vocabulary.find(name).is_some_and(|entry| entry.kind == kind && own(entry.meaning))
}

/// Reads formulas of the library that the case has names for.
fn known(model: &Model, texts: &[&str]) -> Vec<Formula> {
    texts.iter().filter_map(|text| Formula::parse(text, &model.vocabulary).ok()).collect()
}

/// Reads scalars of the library that the case has names for.
fn scalars(model: &Model, texts: &[&str]) -> Vec<Formula> {
    kept(known(model, texts).into_iter().map(Ok))
}

/// Keeps the formulas that can be made, and are scalars.
fn kept(made: impl IntoIterator<Item = FormulaResult>) -> Vec<Formula> {
    let scalar = |formula: &Formula| formula.value_type() == Type::Scalar;
    made.into_iter().flatten().filter(scalar).collect()
}

/// Scalar parameters in the formula of a potential.
fn potential_parameters(model: &Model) -> Vec<Formula> {
    let Some(formula) = model.system.potential_formula() else { return Vec::new() };
    // On a plane k is a name like any other.
    let curvature = if model.system.is_curved() { "k" } else { "" };
    let bodily = ["m", "R", "I", "B", "J", "c", "μ", curvature];
    let names = formula
        .symbols()
        .map(|symbol| model.vocabulary.entry(symbol))
        .filter(|entry| matches!(entry.meaning, Meaning::Parameter(_)))
        .filter(|entry| entry.kind == Type::Scalar && !bodily.contains(&entry.name.as_str()))
        .map(|entry| entry.name.as_str());
    known(model, &names.collect::<Vec<_>>())
}

/// Building blocks offered by a system.
struct Pieces {
    /// Vectors linear in the velocities.
    linear: Vec<Formula>,
    /// Scalars linear in the velocities.
    forms: Vec<Formula>,
    /// Vector that is constant in space, if there is one: (a,γ) is a form for each vector a.
    normal: Option<Formula>,
    /// Functions of the configuration and the parameters.
    weights: Vec<Formula>,
    /// Terms without velocities that a potential may require.
    free: Vec<Formula>,
}

/// Terms for potentials that separate in the sphero-conical coordinates of a tensor A: polynomials
/// of degree 2 and 4, and p/γ_k².
fn separable(model: &Model, parameter: &Formula, a: &Formula) -> Option<Vec<Formula>> {
    let [normal, components @ ..] = ["γ", "γ1", "γ2", "γ3"].map(|name| model_name(model, name));
    let normal = normal?;
    let turned = (a * &normal).ok()?;
    let square = normal.dot(&turned).ok()?;
    let adjugate = Formula::call("adj", &[a]).ok()?;
    let dual = normal.dot(&(&adjugate * &normal).ok()?).ok()?;
    let trace = Formula::call("tr", &[a]).ok()?;
    let mut terms = vec![
        parameter * &dual,
        parameter * &trace * &square,
        turned.dot(&turned).and_then(|squared| parameter * &squared),
        parameter * &square * &dual,
    ];
    for (k, component) in components.into_iter().enumerate() {
        let below = component?.raised(2).ok()?;
        let entry = a.bracketed().component(&[k + 1, k + 1]).ok()?;
        terms.extend([&entry, &trace, &square].map(|factor| parameter / &below * factor));
    }
    Some(kept(terms))
}

/// Terms of a rubber body for each parameter of its potential.
fn potential_terms(model: &Model, pieces: &mut Pieces, constant: &str) {
    let Some((tensor, normal)) = model_name(model, constant).zip(model_name(model, "γ")) else {
        return;
    };
    for parameter in potential_parameters(model) {
        let trace = Formula::call("tr", &[&tensor]);
        let adjugate = Formula::call("adj", &[&tensor]);
        let moving = model_name(model, "Ĩ");
        for own in [Some(tensor.clone()), adjugate.ok(), moving].into_iter().flatten() {
            let square = (&own * &normal).and_then(|turned| normal.dot(&turned));
            let Ok(square) = square else { continue };
            let traced = trace.clone().and_then(|trace| &parameter * &trace * &square);
            pieces.free.extend(kept([&parameter * &square, traced]));
        }
        let turned = tensor.raised(-1).and_then(|inverse| &inverse * &normal);
        let scaled = Formula::call("det", &[&tensor]).and_then(|volume| &parameter * &volume);
        if let (Ok(turned), Ok(scaled)) = (turned, scaled) {
            pieces.free.extend(kept([turned.dot(&turned).and_then(|square| &scaled * &square)]));
        }
        let own = match has(model, "B", Type::MATRIX) {
            true => known(model, &["B⁻¹"]).pop(),
            false => Some(tensor.clone()),
        };
        let terms = own.and_then(|own| separable(model, &parameter, &own));
        pieces.free.extend(terms.unwrap_or_default());
    }
}

/// Terms of a ball on a surface for each parameter of its potential.
fn surface_terms(model: &Model, pieces: &mut Pieces) {
    let Some(sum) = known(model, &["(μ + D)"]).pop() else { return };
    let square = known(model, &["(r,B⁻¹*r)"]).pop();
    for parameter in potential_parameters(model) {
        let Ok(coefficient) = &sum * &parameter else { continue };
        pieces.free.push(coefficient.clone());
        pieces.free.extend(kept(square.iter().map(|square| &coefficient * square)));
        for (entry, component) in [("B11", "r1"), ("B22", "r2"), ("B33", "r3")] {
            let own = model_name(model, entry).zip(model_name(model, component));
            let Some((entry, component)) = own else { continue };
            let Ok(component) = component.raised(2) else { continue };
            let below = (&entry * &component).and_then(|below| &coefficient / &below);
            pieces.free.extend(kept([below, &coefficient * &component / &entry]));
        }
    }
}

fn pieces(model: &Model) -> Pieces {
    let matrix = |name: &str| has(model, name, Type::MATRIX);
    let scalar = |name: &str| has(model, name, Type::Scalar);
    let vector = |name: &str| has(model, name, Type::VECTOR);
    let mut pieces = Pieces {
        linear: Vec::new(),
        forms: Vec::new(),
        normal: None,
        weights: vec![one()],
        free: Vec::new(),
    };
    match &model.system {
        System::Rubber(_) | System::Spinning(_) => {
            pieces.normal = model_name(model, "γ");
            let constant = if matrix("J") { "J" } else { "I" };
            let turned = if constant == "J" { "J*ω" } else { "I*ω" };
            pieces.linear.extend(known(model, &["Ĩ*ω", turned]));
            if matrix("B") {
                pieces.linear.extend(known(model, &["B⁻¹*ω"]));
            }
            pieces.linear.extend(known(model, &["ω"]));
            pieces.linear.extend(model.system.gyrostat().cloned());
            pieces.forms.extend(known(model, &["ω3"]));
            // Jellett's integral of a ball with its centre of mass on its axis.
            if matches!(model.system, System::Spinning(_)) {
                pieces.forms.extend(scalars(model, &["(I*ω,r)"]));
            }
            let mut weights = vec!["m"];
            if scalar("R") {
                weights.push("m*R²");
            }
            if scalar("R") && vector("c") {
                weights.extend(["m*R*(γ,c)", "m*(c,c)"]);
            }
            if matrix("J") {
                weights.extend(["(γ,J*γ)", "(γ,adj(J)*(J⁻¹*γ))", "(γ,J⁻¹*γ)"]);
            }
            if matrix("B") {
                weights.push("tr(B)*m");
            }
            if scalar("μ") {
                weights.push("μ");
            }
            weights.extend(["m*r²", "m*(r,γ)²"]);
            pieces.weights.extend(scalars(model, &weights));
            potential_terms(model, &mut pieces, constant);
            let has_potential = model.system.has_potential();
            if let (true, Some(potential)) = (has_potential, model_name(model, "U")) {
                let weighted = pieces.weights.iter().map(|weight| product(&potential, weight));
                pieces.free.extend(kept(weighted.collect::<Vec<_>>()));
                pieces.free.extend(scalars(model, &["U*(γ,adj(B⁻¹)*(B*γ))"]));
            }
        }
        System::FlatBase(body) => {
            pieces.linear.extend(known(model, &["Ĩ*ω", "I*ω", "ω"]));
            pieces.linear.extend(body.gyrostat.clone());
            pieces.forms.extend(scalars(model, &["(r1*ω1 + r2*ω2)"]));
            pieces.weights.extend(scalars(model, &["m", "m*(r1² + r2²)", "m*z²"]));
        }
        System::Ball(_) => {
            pieces.normal = model_name(model, "γ");
            pieces.linear.extend(known(model, &["(γ × M)", "M"]));
            if matrix("B") {
                pieces.linear.extend(known(model, &["B⁻¹*(γ × M)", "B⁻¹*M"]));
            }
            pieces.forms.extend(scalars(model, &["M3"]));
            if matrix("B") {
                surface_terms(model, &mut pieces);
            }
        }
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
            for variable in &model.state {
                let Some(own) = model_name(model, &variable.name) else { continue };
                match variable.kind {
                    Type::VECTOR => pieces.linear.push(own),
                    Type::Scalar => pieces.forms.push(own),
                    Type::Vector(length) => {
                        let all = (1..=length).map(|k| own.element(k, &model.vocabulary));
                        pieces.forms.extend(kept(all));
                    }
                    Type::Matrix(..) => {
                        let places = variable.kind.places();
                        pieces.forms.extend(kept(places.iter().map(|at| own.component(at))));
                    }
                }
            }
        }
    }
    pieces
}

/// Lists scalars linear in the velocities, or in the state.
fn linear_forms(model: &Model, pieces: &Pieces) -> Vec<Formula> {
    let mut forms = pieces.forms.clone();
    if let Some(normal) = &pieces.normal {
        forms.extend(kept(pieces.linear.iter().map(|vector| vector.dot(normal))));
    }
    if matches!(
        model.system,
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_)
    ) {
        for vector in &pieces.linear {
            forms.extend(kept((1..=3).map(|k| vector.element(k, &model.vocabulary))));
        }
    }
    forms
}

/// Number of linear forms, if there are so many that their products are not offered.
pub fn without_squares(model: &Model) -> Option<usize> {
    Some(linear_forms(model, &pieces(model)).len()).filter(|count| *count > SQUARED)
}

/// Lists terms of degree 1 and 2 in the velocities, simple ones first, such as (Iω,ω) before ω₁², with those of a potential.
pub fn integrals(model: &Model) -> Vec<Formula> {
    let pieces = pieces(model);
    let forms = linear_forms(model, &pieces);
    let mut squares = Vec::new();
    for (i, a) in pieces.linear.iter().enumerate() {
        squares.extend(kept(pieces.linear[i..].iter().map(|b| a.dot(b))));
    }
    let (of_tensors, of_degree_four) = tensors::products(model);
    squares.extend(of_tensors);
    let of_squares = if forms.len() > SQUARED { &[] } else { &forms[..] };
    for (i, a) in of_squares.iter().enumerate() {
        let own = forms[i..].iter().map(|b| if a.text() == b.text() { a.raised(2) } else { a * b });
        squares.extend(kept(own));
    }
    squares.extend(of_degree_four);
    let mut terms = Vec::new();
    for weight in &pieces.weights {
        terms.extend(kept(squares.iter().map(|square| product(weight, square))));
        terms.extend(kept(forms.iter().map(|form| product(weight, form))));
    }
    terms.extend(pieces.free);
    terms
}

/// Lists possible denominators of integrals.
pub fn denominators(model: &Model) -> Vec<Formula> {
    let mut found = vec![one()];
    let offers = [("J", "(γ,J⁻¹*γ)"), ("B", "(γ,B*γ)")];
    for (name, text) in offers {
        if has(model, name, Type::MATRIX)
            && (model.system.body().is_some() || matches!(model.system, System::Ball(_)))
        {
            found.extend(scalars(model, &[text]));
        }
    }
    found
}

/// Lists factors whose powers may form a density or an integral, simple ones first.
pub fn factors(model: &Model) -> Vec<Formula> {
    let matrix = |name: &str| has(model, name, Type::MATRIX);
    let scalar = |name: &str| has(model, name, Type::Scalar);
    let mut factors: Vec<&str> = Vec::new();
    match &model.system {
        System::Rubber(_) => {
            if scalar("g1") {
                factors.extend(["g1", "g2"]);
            }
            if matrix("J") {
                factors.push("(γ,J⁻¹*γ)");
            }
            if !scalar("g1") {
                // g₁ and g₂ of a body of revolution; with I = μE they are μ + m(r,γ)² and μ + mr².
                factors.push("(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)");
                factors.push("(I1 + m*r²)");
            }
            if matrix("B") {
                factors.extend(["X0", "Y0"]);
            }
            factors.extend(["det(Ĩ)", "(γ,Ĩ⁻¹*γ)"]);
            if scalar("D_T") {
                factors.push("D_T");
            }
            if matrix("𝒥") {
                factors.extend(["det(𝒥)", "(γ,𝒥⁻¹*γ)"]);
            }
            if matrix("B") {
                factors.push("(γ,B*γ)");
            }
        }
        System::Spinning(_) => {
            if matrix("J") {
                factors.push("(γ,J⁻¹*γ)");
                factors.push("(1 − m*R²*(γ,J⁻¹*γ))");
            }
            // With I₁ = I₂: √Δ and I₁ + mr² of a body of revolution.
            factors.extend(["(I1 + m*r²)", "(I1*I3 + m*(r,I*r))", "det(Ĩ)"]);
            if scalar("D_T") {
                factors.push("D_T");
            }
            if matrix("B") && scalar("μ") {
                factors.push("(μ + m*r²)");
            }
        }
        System::FlatBase(_) => factors.extend([
            "(I1 + m*(r1² + r2² + z²))",
            "(I1*I2 + m*(I1*r1² + I2*r2²))",
            "det(Ĩ)",
            "exp(k*z*m*(r1² + r2²)/(I1 + m*z²))",
        ]),
        System::Ball(_) => {
            factors.push(if scalar("h") { "det(∂r + γ⊗γ)" } else { "|n|" });
            if matrix("B") {
                factors.push("(γ,B*γ)");
            }
        }
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
            return tensors::factors(model);
        }
    }
    scalars(model, &factors)
}

/// Lists the abbreviations that the terms use, in order.
///
/// X₀ and Y₀ are the factors of det Ĩ (γ,Ĩ⁻¹γ) (r,γ)² for an ellipsoid on (3.8): X and Y of §3.3
/// with β and α of (3.9) expressed by I₁, I₂ and B, and multiplied by powers of I₁ − I₂ so that
/// I₁ = I₂ is not an exception: for I = μE they are the factors of (3.7).
pub fn abbreviations(model: &Model) -> Vec<(&'static str, &'static str)> {
    if !matches!(model.system, System::Rubber(_)) || !has(model, "B", Type::MATRIX) {
        return Vec::new();
    }
    vec![
        ("d0", "I1 − I2"),
        ("β0", "m*B[3,3]*(B[2,2] − B[1,1]) − I1*B[1,1] + I2*B[2,2]"),
        ("α0", "I1*β0 + d0*(I1*B[1,1] − m*B[2,2]*B[3,3])"),
        ("Δ0", "α0 + m*d0*tr(adj(B))"),
        ("X0", "(m*β0² + m*β0*d0*tr(B) + d0*Δ0)*(r,γ)² + α0*β0 − m*d0²*det(B)"),
        ("Y0", "(r,γ)²*(Δ0 + m*β0*r²) − m*d0*det(B)"),
    ]
}

/// Lists the numbers of which exponents may be multiples.
pub fn exponents(model: &Model) -> Vec<Formula> {
    let mut found = vec!["1"];
    let is_curved = model.system.is_curved();
    let profile = is_curved && has(model, "g1", Type::Scalar) && has(model, "R", Type::Scalar);
    if has(model, "κ", Type::Scalar) || profile {
        found.push("k*R");
    }
    scalars(model, &found)
}

/// Lists factors linear in the velocities, for integrals that are products of powers.
pub fn linear_factors(model: &Model) -> Vec<Formula> {
    pieces(model).forms
}
