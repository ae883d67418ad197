//! Library of terms for integrals and densities, in the names of a case.
//!
//! Coefficients of the terms are unknown rational numbers, the same for all values of the
//! parameters; the terms themselves therefore contain parameters.

use liouville::formula::Type;
use liouville::mechanics::{Meaning, Model, System};

/// Texts of formulas.
pub type Texts = Vec<String>;

fn has(model: &Model, name: &str, kind: Type) -> bool {
    let own = |meaning| !matches!(meaning, Meaning::Abbreviation(_));
    model.vocabulary.find(name).is_some_and(|entry| entry.kind == kind && own(entry.meaning))
}

/// Names the scalar parameters in the formula of a potential.
fn potential_parameters(model: &Model) -> Texts {
    use liouville::mechanics::Potential;
    let Some(Potential::Formula(formula)) = model.system.potential() else { return Vec::new() };
    let bodily = ["m", "R", "I", "B", "J", "c", "k", "μ"];
    formula
        .symbols()
        .map(|symbol| model.vocabulary.entry(symbol))
        .filter(|entry| matches!(entry.meaning, Meaning::Parameter(_)))
        .filter(|entry| entry.kind == Type::Scalar && !bodily.contains(&entry.name.as_str()))
        .map(|entry| entry.name.clone())
        .collect()
}

/// Joins factors, omitting `1`.
fn product(factors: &[&str]) -> String {
    let kept: Vec<&str> = factors.iter().copied().filter(|factor| *factor != "1").collect();
    if kept.is_empty() { "1".to_string() } else { kept.join("*") }
}

/// Building blocks offered by a system.
struct Pieces {
    /// Vectors linear in the velocities.
    linear: Texts,
    /// Scalars linear in the velocities.
    forms: Texts,
    /// Vector that is constant in space, if there is one: (a,γ) is a form for each vector a.
    normal: Option<&'static str>,
    /// Functions of the configuration and the parameters.
    weights: Texts,
    /// Terms without velocities that a potential may require.
    free: Texts,
}

/// Terms for potentials that separate in the sphero-conical coordinates of a tensor A: polynomials
/// of degree 2 and 4, and p/γ_k².
fn separable(parameter: &str, a: &str) -> Texts {
    let mut terms = vec![
        format!("{parameter}*(γ,adj({a})*γ)"),
        format!("{parameter}*tr({a})*(γ,{a}*γ)"),
        format!("{parameter}*({a}*γ,{a}*γ)"),
        format!("{parameter}*(γ,{a}*γ)*(γ,adj({a})*γ)"),
    ];
    for k in 1..=3 {
        let entries = [format!("({a})[{k},{k}]"), format!("tr({a})"), format!("(γ,{a}*γ)")];
        terms.extend(entries.iter().map(|entry| format!("{parameter}/γ{k}²*{entry}")));
    }
    terms
}

fn pieces(model: &Model) -> Pieces {
    let matrix = |name: &str| has(model, name, Type::MATRIX);
    let scalar = |name: &str| has(model, name, Type::Scalar);
    let vector = |name: &str| has(model, name, Type::VECTOR);
    let mut pieces = Pieces {
        linear: Vec::new(),
        forms: Vec::new(),
        normal: None,
        weights: vec!["1".to_string()],
        free: Vec::new(),
    };
    match &model.system {
        System::Rubber(_) | System::Spinning(_) => {
            pieces.normal = Some("γ");
            let constant = if matrix("J") { "J" } else { "I" };
            for tensor in ["Ĩ", constant] {
                pieces.linear.push(format!("{tensor}*ω"));
            }
            if matrix("B") {
                pieces.linear.push("B⁻¹*ω".to_string());
            }
            pieces.linear.push("ω".to_string());
            if let Some(rotor) = model.system.gyrostat() {
                pieces.linear.push(rotor.text().to_string());
            }
            pieces.forms.push("ω3".to_string());
            pieces.weights.push("m".to_string());
            if scalar("R") {
                pieces.weights.push("m*R²".to_string());
            }
            if scalar("R") && vector("c") {
                pieces.weights.extend(["m*R*(γ,c)", "m*(c,c)"].map(str::to_string));
            }
            if matrix("J") {
                pieces
                    .weights
                    .extend(["(γ,J*γ)", "(γ,adj(J)*(J⁻¹*γ))", "(γ,J⁻¹*γ)"].map(str::to_string));
            }
            if matrix("B") {
                pieces.weights.push("tr(B)*m".to_string());
            }
            if scalar("μ") {
                pieces.weights.push("μ".to_string());
            }
            pieces.weights.extend(["m*r²", "m*(r,γ)²"].map(str::to_string));
            for parameter in potential_parameters(model) {
                for tensor in [constant, &format!("adj({constant})"), "Ĩ"] {
                    pieces.free.push(format!("{parameter}*(γ,{tensor}*γ)"));
                    pieces.free.push(format!("{parameter}*tr({constant})*(γ,{tensor}*γ)"));
                }
                pieces
                    .free
                    .push(format!("{parameter}*det({constant})*({constant}⁻¹*γ,{constant}⁻¹*γ)"));
                let tensor = if matrix("B") { "B⁻¹" } else { constant };
                pieces.free.extend(separable(&parameter, tensor));
            }
            if model.system.potential().is_some() {
                pieces.free.extend(pieces.weights.iter().map(|weight| product(&["U", weight])));
                pieces.free.push("U*(γ,adj(B⁻¹)*(B*γ))".to_string());
            }
        }
        System::FlatBase(body) => {
            pieces.linear.extend(["Ĩ*ω", "I*ω", "ω"].map(str::to_string));
            if let Some(rotor) = &body.gyrostat {
                pieces.linear.push(rotor.text().to_string());
            }
            pieces.forms.push("(r1*ω1 + r2*ω2)".to_string());
            let weights = ["m", "m*(r1² + r2²)", "m*z²"];
            pieces.weights.extend(weights.map(str::to_string));
        }
        System::Ball(_) => {
            pieces.normal = Some("γ");
            pieces.linear.extend(["(γ × M)", "M"].map(str::to_string));
            if matrix("B") {
                pieces.linear.extend(["B⁻¹*(γ × M)", "B⁻¹*M"].map(str::to_string));
            }
            pieces.forms.push("M3".to_string());
            if matrix("B") {
                for parameter in potential_parameters(model) {
                    let coefficient = format!("(μ + D)*{parameter}");
                    pieces.free.extend([coefficient.clone(), format!("{coefficient}*(r,B⁻¹*r)")]);
                    pieces.free.extend((1..=3).flat_map(|i| {
                        let below = format!("{coefficient}/(B{i}{i}*r{i}²)");
                        [below, format!("{coefficient}*r{i}²/B{i}{i}")]
                    }));
                }
            }
        }
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {
            for variable in &model.state {
                match variable.kind {
                    Type::VECTOR => pieces.linear.push(variable.name.clone()),
                    Type::Scalar => pieces.forms.push(variable.name.clone()),
                    Type::Vector(_) => {
                        let indices = variable.kind.indices();
                        let components =
                            indices.iter().map(|index| format!("{}{index}", variable.name));
                        pieces.forms.extend(components);
                    }
                    Type::Matrix(..) => {}
                }
            }
        }
    }
    pieces
}

/// Lists terms of degree 1 and 2 in the velocities, simple ones first, together with those that a
/// potential adds.
pub fn integrals(model: &Model) -> Texts {
    let pieces = pieces(model);
    let mut forms = pieces.forms.clone();
    if let Some(normal) = pieces.normal {
        forms.extend(pieces.linear.iter().map(|vector| format!("({vector},{normal})")));
    }
    if matches!(
        model.system,
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_)
    ) {
        for vector in &pieces.linear {
            forms.extend((1..=3).map(|k| format!("{vector}[{k}]")));
        }
    }
    let mut squares = Vec::new();
    for (i, a) in pieces.linear.iter().enumerate() {
        squares.extend(pieces.linear[i..].iter().map(|b| format!("({a},{b})")));
    }
    for (i, a) in forms.iter().enumerate() {
        squares.extend(forms[i..].iter().map(|b| match a == b {
            true => format!("{a}²"),
            false => format!("{a}*{b}"),
        }));
    }
    let mut terms = Vec::new();
    for weight in &pieces.weights {
        terms.extend(squares.iter().map(|square| product(&[weight, square])));
        terms.extend(forms.iter().map(|form| product(&[weight, form])));
    }
    for free in &pieces.free {
        terms.push(free.clone());
    }
    terms
}

/// Lists possible denominators of integrals.
pub fn denominators(model: &Model) -> Texts {
    let mut found = vec!["1".to_string()];
    let offers = [("J", "(γ,J⁻¹*γ)"), ("B", "(γ,B*γ)")];
    for (name, text) in offers {
        if has(model, name, Type::MATRIX)
            && (model.system.body().is_some() || matches!(model.system, System::Ball(_)))
        {
            found.push(text.to_string());
        }
    }
    found
}

/// Lists factors whose powers may form a density or an integral, simple ones first.
pub fn factors(model: &Model) -> Texts {
    let matrix = |name: &str| has(model, name, Type::MATRIX);
    let scalar = |name: &str| has(model, name, Type::Scalar);
    let mut factors: Texts = Vec::new();
    match &model.system {
        System::Rubber(_) => {
            if scalar("g1") {
                factors.extend(["g1", "g2"].map(str::to_string));
            }
            if matrix("J") {
                factors.push("(γ,J⁻¹*γ)".to_string());
            }
            if !scalar("g1") {
                // g₁ and g₂ of a body of revolution; with I = μE they are μ + m(r,γ)² and μ + mr².
                factors.push("(I1*γ3² + I3*(γ1² + γ2²) + m*(r,γ)²)".to_string());
                factors.push("(I1 + m*r²)".to_string());
            }
            if matrix("B") {
                factors.extend(["X0", "Y0"].map(str::to_string));
            }
            factors.extend(["det(Ĩ)", "(γ,Ĩ⁻¹*γ)"].map(str::to_string));
            if scalar("D_T") {
                factors.push("D_T".to_string());
            }
            if matrix("𝒥") {
                factors.extend(["det(𝒥)", "(γ,𝒥⁻¹*γ)"].map(str::to_string));
            }
            if matrix("B") {
                factors.push("(γ,B*γ)".to_string());
            }
        }
        System::Spinning(_) => {
            if matrix("J") {
                factors.push("(γ,J⁻¹*γ)".to_string());
                factors.push("(1 − m*R²*(γ,J⁻¹*γ))".to_string());
            }
            // With I₁ = I₂: √Δ and I₁ + mr² of a body of revolution.
            factors.push("(I1 + m*r²)".to_string());
            factors.push("(I1*I3 + m*(r,I*r))".to_string());
            factors.push("det(Ĩ)".to_string());
            if scalar("D_T") {
                factors.push("D_T".to_string());
            }
            if matrix("B") && scalar("μ") {
                factors.push("(μ + m*r²)".to_string());
            }
        }
        System::FlatBase(_) => factors.extend(
            [
                "(I1 + m*(r1² + r2² + z²))",
                "(I1*I2 + m*(I1*r1² + I2*r2²))",
                "det(Ĩ)",
                "exp(k*z*m*(r1² + r2²)/(I1 + m*z²))",
            ]
            .map(str::to_string),
        ),
        System::Ball(_) => {
            factors.push(if scalar("h") { "det(∂r + γ⊗γ)" } else { "|n|" }.to_string());
            if matrix("B") {
                factors.push("(γ,B*γ)".to_string());
            }
        }
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_) => {}
    }
    factors
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
pub fn exponents(model: &Model) -> Texts {
    let mut found = vec!["1".to_string()];
    if has(model, "κ", Type::Scalar) {
        found.push("k*R".to_string());
    } else if model.system.body().is_some_and(|body| body.curvature.is_some())
        && has(model, "g1", Type::Scalar)
        && has(model, "R", Type::Scalar)
    {
        found.push("k*R".to_string());
    }
    found
}

/// Lists factors linear in the velocities, for integrals that are products of powers.
pub fn linear_factors(model: &Model) -> Texts {
    pieces(model).forms
}
