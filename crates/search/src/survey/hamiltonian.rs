//! Conformally Hamiltonian form of rubber bodies with a density.
//!
//! With N = ρ/ρ₀, ρ₀ = det Ĩ (γ,Ĩ⁻¹γ) D_T, on (M,γ) = 0
//!
//! ```text
//! plane:   M = N(Ĩω − (Ĩω,γ)γ),        H = (γ×M, Ĩ(γ×M))/(2N²ρ₀) + U
//! sphere:  M = N[Γ(γ×Ĩω)]×γ,           H = [(y,Ĩ⁻¹y) − (y,Ĩ⁻¹γ)²/(γ,Ĩ⁻¹γ)]/(2N²) + U,  y = ΓM/det Γ
//! N⁻¹M' = M×∂H/∂M + γ×∂H/∂γ,   N⁻¹γ' = γ×∂H/∂M
//! ```
//!
//! BMB 2013, (2.14)-(2.19), (2.28), for any potential and without a rotor.

use super::definitions::{Definition, define, defined, merged, used_by};
use super::question::{SurveyQuestion, TestedClaim};
use super::shown::Typesetter;
use liouville::case::Case;
use liouville::claim::{Claim, ClaimEntry};
use liouville::formula::Formula;
use liouville::mechanics::System;
use liouville::verdict::{JudgeError, Options};

/// Returns the form with its proof, if the density is known in closed form.
pub fn form(
    case: &Case,
    options: &Options,
    bindings: &[Definition],
    density: &TestedClaim,
) -> Result<Vec<TestedClaim>, JudgeError> {
    let System::Rubber(body) = &case.model.system else { return Ok(Vec::new()) };
    if body.0.gyrostat.is_some() || body.0.moment.is_some() || !case.model.extension.is_empty() {
        return Ok(Vec::new());
    }
    let (mut names, formulas) = merged(bindings, &[density]);
    let mut add = |name: &str, formula: String| names.push(define(name, &formula));
    let volume = if body.0.curvature.is_some() { "*D_T" } else { "" };
    let standard = format!("det(Ĩ)*(γ,Ĩ⁻¹*γ){volume}");
    let multiplier = match formulas[0] == standard {
        true => "1".to_string(),
        false => format!("({})/({standard})", formulas[0]),
    };
    add("N", multiplier);
    let energy = match body.0.curvature {
        None => {
            // The last term vanishes on the level; with it M and γ are coordinates off the level
            // too.
            add("M", "N*(Ĩ*ω − (Ĩ*ω,γ)*γ) + (ω,γ)*γ".to_string());
            "((γ × M),Ĩ*(γ × M))/(2*N²*det(Ĩ)*(γ,Ĩ⁻¹*γ))"
        }
        Some(_) => {
            add("M", "N*(Γ*(γ × Ĩ*ω) × γ) + (ω,γ)*γ".to_string());
            add("y", "(1/det(Γ))*(Γ*M)".to_string());
            "((y,Ĩ⁻¹*y) − (y,Ĩ⁻¹*γ)²/(γ,Ĩ⁻¹*γ))/(2*N²)"
        }
    };
    let potential = if body.0.potential.is_some() { " + U" } else { "" };
    let claims = vec![
        Claim::hamiltonian(ClaimEntry::Text(format!("{energy}{potential}")))
            .with("multiplier", "N")
            .named("H"),
        Claim::density_in_variables("1/N").named("ρ"),
    ];
    let asked = defined(case, &names)
        .and_then(|named| in_momenta(&named))
        .and_then(|bracketed| bracketed.with_claims(&claims).ok());
    let mut question = SurveyQuestion::plain("conformally Hamiltonian form", &names, claims);
    question.source = match volume {
        "" => "BMB 2013, (2.14)-(2.19)".to_string(),
        _ => "BMB 2013, (2.28)".to_string(),
    };
    let mut found = match &asked {
        Some(asked) => match question.tested(asked, options) {
            // Variables that contain an ∫ of the density are not differentiated.
            Err(JudgeError::Quadrature(_)) => Vec::new(),
            tested => tested?,
        },
        None => Vec::new(),
    };
    for tested in &mut found {
        // H is written in the new variables, so its text is not among the names of the case.
        let text = match tested.claim.kind {
            "hamiltonian" => format!("{energy}{potential}"),
            _ => "1/N".to_string(),
        };
        // The measure follows H in the report, in the same names.
        tested.definitions = match tested.claim.kind {
            "hamiltonian" => used_by(&[&text, "N", "M"], &names),
            _ => Vec::new(),
        };
        if let Some(asked) = &asked {
            let paper = Typesetter(&asked.model.vocabulary);
            tested.shown.definitions = paper.definitions(&tested.definitions);
            tested.shown.statement = asked.model.variables.as_ref().and_then(|variables| {
                Typesetter(&variables.model.vocabulary)
                    .definition(&define(&tested.claim.name, &text))
            });
        }
        tested.claim.formula = Some(text);
    }
    Ok(found)
}

/// Returns the case in the variables M and γ with the bracket of e(3), M as the case defines it.
fn in_momenta(named: &Case) -> Option<Case> {
    let variable = |name: &str| Some((name.to_string(), named.formula(name).ok()?));
    let changed = named.with_variables(&[variable("M")?, variable("γ")?]).ok()?;
    let names = &changed.model.variables.as_ref()?.model.vocabulary;
    let hat = |name: &str| Formula::call("hat", &[&Formula::name(name, names).ok()?]).ok();
    changed.with_bracket(&[((0, 0), hat("M")?), ((0, 1), hat("γ")?)]).ok()
}
