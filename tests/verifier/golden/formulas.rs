//! The formulas of the reference data in the language of case files.

/// The support function of `sph_generic` and `generic_generic`.
pub const BLOB_ON_PLANE: &str = "2*|γ| + γ1*γ2*γ3/(9*|γ|²) + γ1*γ2²/(7*|γ|²) + γ3⁴/(5*|γ|³) \
                             + γ1/3 − γ2/4 + 2*γ3/7";
/// The support function of `blob`.
pub const BLOB_ON_SPHERE: &str =
    "√(4*γ1² + 9/2*γ2² + 5*γ3²) + (c,γ) + (γ1*γ2*γ3/7 − γ1²*γ3/9)/|γ|²";

/// Returns the reference's formula in the language of case files, with the named quantities of
/// [`lets`].
pub fn formula(case: &str, name: &str) -> &'static str {
    match (case, name) {
        (_, "F0") => "(γ,γ)",
        (_, "F1") => "(ω,γ)",
        (_, "E") => "energy",
        ("ball-bal-1", "rho") => "(γ,J⁻¹*γ)^((1+k*R)/2)",
        ("ball-bal-1", "rho_wrong_sign") => "(γ,J⁻¹*γ)^((1-k*R)/2)",
        ("ball-bal-1", "rho_plane") => "√(γ,J⁻¹*γ)",
        ("ball-bal-1", "rho_2kappa") => "(γ,J⁻¹*γ)^(2*κ)",
        ("ball-bal-1", "one") => "1",
        ("ball-bal-1", "F_plane") => "|J*ω × γ|²",
        ("ball-bal-1", "F_kappa") => "((J*ω,J*ω) + det(J)*(ω,J*ω)*(J⁻¹*γ,J⁻¹*γ))/(γ,J⁻¹*γ)",
        ("ball-bal-1", "F_kappa_minus") => "((J*ω,J*ω) − det(J)*(ω,J*ω)*(J⁻¹*γ,J⁻¹*γ))/(γ,J⁻¹*γ)",
        ("ball-offset-1", "rho") => "G1^((1+k*R)/2)*G2",
        ("ball-offset-1", "rho_wrong") => "G1^((1-k*R)/2)*G2",
        ("ball-offset-1", "rho_plane") => "√G1*G2",
        ("ball-offset-1", "F2") => "G1^((1+k*R)/2)*ω3",
        ("ball-offset-1", "F2_wrong") => "G1^((1-k*R)/2)*ω3",
        ("ell-special-1", "P_ell") => "det(Ĩ)/(μ + m*r²)*det(Γ)",
        ("ell-special-1", "P_ell_br2") => "det(Ĩ)/((μ + m*r²)*det(Γ))*X²",
        ("ell-special-1", "P_noGamma") => "det(Ĩ)/(μ + m*r²)",
        ("ell-special-1", "P_1/det") => "det(Ĩ)/((μ + m*r²)*det(Γ))",
        ("ell-special-1", "P_det_br2") => "det(Ĩ)/(μ + m*r²)*det(Γ)*X²",
        ("ell-special-1", "F_plane") => "(ω,B⁻¹*Ĩ*ω)",
        ("blob", "rho0") => "det(Ĩ)*(γ,Ĩ⁻¹*γ)*D_T",
        ("flat-sym-1", "rho") => "(I1 + m*(r1² + r2² + z²))*exp(−ε)",
        ("flat-sym-1", "rho_plus") => "(I1 + m*(r1² + r2² + z²))*exp(ε)",
        ("flat-sym-1", "F2") => "(r1*ω1 + r2*ω2)*exp(−ε)",
        ("flat-sym-1", "F2_plus") => "(r1*ω1 + r2*ω2)*exp(ε)",
        _ => panic!("no formula for candidate {name} of {case}"),
    }
}

/// Returns the abbreviations of sections 4.1, 4.2 and 4.5.
pub fn lets(case: &str) -> &'static str {
    match case {
        "ball-offset-1" => {
            "[let]\nG1 = \"I1*γ3² + I3*(1 − γ3²) + m*(R + c3*γ3)²\"\n\
             G2 = \"I1 + m*(R² + 2*R*c3*γ3 + c3²)\"\n"
        }
        "ell-special-1" => "[let]\nX = \"1 + k*(k*det(B) − (r,γ)^3*(trace(B) − r²))/(r,γ)^4\"\n",
        "flat-sym-1" => "[let]\n\"ε\" = \"k*z*m*(r1² + r2²)/(2*(I1 + m*z²))\"\n",
        _ => "",
    }
}
