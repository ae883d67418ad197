//! Names that systems define, in the notation of the papers.

use super::vocabulary::Dependence;
use crate::formula::Type;

/// A quantity computed from the state and the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// `r`: from the mass centre to the point of contact, r = -∇h.
    Contact,
    /// `r'`, `ṙ`: its rate in the body, r' = (∂r/∂γ)γ'.
    ContactRate,
    /// `h`: the support function.
    Support,
    /// `∂r`: the matrix ∂r/∂γ = -Hess h.
    Slope,
    /// `Ĩ`: the inertia tensor at the point of contact, I + m r²E - m r⊗r.
    InertiaAtContact,
    /// `J`: I + m(R² + c²)E - m c⊗c, for a ball of radius R with mass centre displaced by c.
    BallInertia,
    /// `𝒥`: J + 2mR(γ,c)E, which agrees with Ĩ across γ.
    ScriptInertia,
    /// `κ`: 1/(1 + kR).
    Kappa,
    /// `Γ`: E - k ∂r/∂γ.
    Gamma,
    /// `D_T`: det of Γ across γ, (1 + kR₁)(1 + kR₂).
    GammaDeterminant,
    /// `U`: the potential.
    Potential,
    /// `energy`: ½(ω,Ĩω) + U.
    Energy,
    /// `ω'`: the angular acceleration.
    AngularAcceleration,
    /// `χ`: the covector of the divergence of a body that may spin, div v = (χ,ω) - (ln D_T)'.
    DivergenceCovector,
    /// `ω`: the angular velocity, where it is not a state variable.
    AngularVelocity,
    /// `γ'`: the rate of the normal.
    NormalRate,
    /// `λ0`: the multiplier of (ω,γ) = 0.
    Multiplier,
    /// `γ`: the normal, where it is not a state variable.
    Normal,
    /// `F`: the function of the surface F(r) = const.
    SurfaceFunction,
    /// `n`: ∇F of the surface F(r) = const.
    SurfaceGradient,
    /// `∂n`: the matrix ∂²F/∂r² of the surface F(r) = const.
    SurfaceHessian,
    /// `∂U`: ∂U/∂r of a ball on a surface.
    PotentialGradient,
    /// `D`: mR² of a rolling ball.
    RollingMoment,
    /// `μ1`, …: the reaction of a constraint, by its number.
    Reaction(usize),
    /// `x'`: the rate of a state variable, by its number.
    Rate(usize),
    /// `z`: the cosine γ₃/|γ| of the angle to the axis of a body of revolution.
    AxisCosine,
    /// `p`: a profile's support function on the unit sphere, p(z).
    Profile,
    /// `p'`: dp/dz.
    ProfileRate,
    /// `p''`: d²p/dz².
    ProfileSecond,
    /// `f1`: r = (f1 γ₁, f1 γ₂, f2), f1 = z p' - p.
    ProfileF1,
    /// `f2`: -(z p + (1 - z²) p').
    ProfileF2,
    /// `f1'`: z p''.
    ProfileF1Rate,
    /// `f2'`: f1 - (1 - z²) p''.
    ProfileF2Rate,
    /// `g1`: I₁z² + I₃(1 - z²) + m p².
    ProfileG1,
    /// `g1'`: dg1/dz.
    ProfileG1Rate,
    /// `g2`: I₁ + m r².
    ProfileG2,
}

impl Quantity {
    /// Returns the definition of the quantity in a few words.
    pub fn meaning(self) -> &'static str {
        use Quantity::*;
        match self {
            Contact => "from the mass centre to the point of contact, −∇h",
            ContactRate => "rate of r in the body, (∂r/∂γ)γ'",
            Support => "support function",
            Slope => "the matrix ∂r/∂γ = −Hess h",
            InertiaAtContact => "inertia at the point of contact, I + m r²E − m r⊗r",
            BallInertia => "I + m(R² + c²)E − m c⊗c",
            ScriptInertia => "J + 2mR(γ,c)E",
            Kappa => "1/(1 + kR)",
            Gamma => "E − k ∂r/∂γ",
            GammaDeterminant => "determinant of Γ across γ",
            Potential => "potential",
            Energy => "energy",
            AngularAcceleration => "angular acceleration",
            DivergenceCovector => "covector of the divergence, div v = (χ,ω) − (ln D_T)'",
            AngularVelocity => "angular velocity",
            NormalRate => "rate of γ",
            Multiplier => "multiplier of (ω,γ) = 0",
            Normal => "unit normal",
            SurfaceFunction => "function of the surface",
            SurfaceGradient => "gradient of the surface's function",
            SurfaceHessian => "matrix of second derivatives of the surface's function",
            PotentialGradient => "∂U/∂r",
            RollingMoment => "mR²",
            Reaction(_) => "reaction of a constraint",
            Rate(_) => "rate of a state variable",
            AxisCosine => "γ₃/|γ|",
            Profile => "support function on the unit sphere, of z",
            ProfileRate => "dp/dz",
            ProfileSecond => "d²p/dz²",
            ProfileF1 => "z p' − p",
            ProfileF2 => "−(z p + (1 − z²) p')",
            ProfileF1Rate => "z p''",
            ProfileF2Rate => "f1 − (1 − z²) p''",
            ProfileG1 => "I₁z² + I₃(1 − z²) + m p²",
            ProfileG1Rate => "dg1/dz",
            ProfileG2 => "I₁ + m r²",
        }
    }

    /// Whether the quantity is a function of the position alone.
    pub fn is_of_position(self) -> bool {
        use Quantity::*;
        !matches!(
            self,
            ContactRate
                | Energy
                | AngularAcceleration
                | AngularVelocity
                | NormalRate
                | Multiplier
                | Reaction(_)
                | Rate(_)
        )
    }
}

/// Features of a case that decide which quantities exist.
#[derive(Clone, Copy, Debug, Default)]
pub struct Features {
    /// Whether the parameter R, a scalar, is declared.
    pub radius: bool,
    /// Whether the parameter c, a vector, is declared.
    pub displacement: bool,
    /// Whether the base is curved.
    pub curvature: bool,
    /// Whether there is a potential.
    pub potential: bool,
    /// Whether the body is given by its profile.
    pub profile: bool,
}

/// Lists the quantities of a rubber body: name, quantity, type, dependence.
pub fn of_rubber(features: Features) -> Vec<(&'static str, Quantity, Type, Dependence)> {
    let mut all = of_body(features);
    all.push(("λ0", Quantity::Multiplier, Type::Scalar, Dependence::Phase));
    all
}

/// Lists the quantities of a body that may spin.
pub fn of_spinning(features: Features) -> Vec<(&'static str, Quantity, Type, Dependence)> {
    let mut all = of_body(features);
    all.push(("χ", Quantity::DivergenceCovector, Type::VECTOR, Dependence::Phase));
    all
}

/// Lists the quantities of a body of any shape that rolls.
fn of_body(features: Features) -> Vec<(&'static str, Quantity, Type, Dependence)> {
    use Dependence::{Configuration, Parameters, Phase};
    use Quantity::*;
    use Type::Scalar;
    const VECTOR: Type = Type::VECTOR;
    const MATRIX: Type = Type::MATRIX;
    let mut all = vec![
        ("r", Contact, VECTOR, Phase),
        ("r'", ContactRate, VECTOR, Phase),
        ("ṙ", ContactRate, VECTOR, Phase),
        ("h", Support, Scalar, Configuration),
        ("∂r", Slope, MATRIX, Phase),
        ("Ĩ", InertiaAtContact, MATRIX, Phase),
        ("energy", Energy, Scalar, Phase),
        ("ω'", AngularAcceleration, VECTOR, Phase),
        ("γ'", NormalRate, VECTOR, Phase),
    ];
    if features.radius {
        all.push(("J", BallInertia, MATRIX, Parameters));
    }
    if features.radius && features.displacement {
        all.push(("𝒥", ScriptInertia, MATRIX, Configuration));
    }
    if features.potential {
        all.push(("U", Potential, Scalar, Configuration));
    }
    if features.curvature {
        all.push(("Γ", Gamma, MATRIX, Phase));
        all.push(("D_T", GammaDeterminant, Scalar, Phase));
        if features.radius {
            all.push(("κ", Kappa, Scalar, Parameters));
        }
    }
    if features.profile {
        all.extend([
            ("z", AxisCosine, Scalar, Configuration),
            ("p", Profile, Scalar, Phase),
            ("p'", ProfileRate, Scalar, Phase),
            ("f1", ProfileF1, Scalar, Phase),
            ("f2", ProfileF2, Scalar, Phase),
            ("f1'", ProfileF1Rate, Scalar, Phase),
            ("f2'", ProfileF2Rate, Scalar, Phase),
            ("g1", ProfileG1, Scalar, Phase),
            ("g1'", ProfileG1Rate, Scalar, Phase),
            ("g2", ProfileG2, Scalar, Phase),
        ]);
    }
    all
}

/// Lists the quantities of a body with a flat part on a sphere.
pub fn of_flat_base(has_potential: bool) -> Vec<(&'static str, Quantity, Type, Dependence)> {
    use Quantity::*;
    let potential = has_potential.then_some(("U", Potential, Type::Scalar, Dependence::Phase));
    let own = [
        ("r", Contact, Type::VECTOR, Dependence::Phase),
        ("ω", AngularVelocity, Type::VECTOR, Dependence::Phase),
        ("Ĩ", InertiaAtContact, Type::MATRIX, Dependence::Phase),
        ("energy", Energy, Type::Scalar, Dependence::Phase),
    ];
    own.into_iter().chain(potential).collect()
}

/// The form in which a case gives the surface of a ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BallSurface {
    /// A level F(r) = const.
    Level,
    /// A support function.
    Support,
    /// A support function of revolution, by its profile.
    Profile,
}

/// Lists the quantities of a ball on a surface.
pub fn of_ball(surface: BallSurface) -> Vec<(&'static str, Quantity, Type, Dependence)> {
    use Quantity::*;
    let mut all = vec![
        ("ω", AngularVelocity, Type::VECTOR, Dependence::Phase),
        ("D", RollingMoment, Type::Scalar, Dependence::Parameters),
        ("energy", Energy, Type::Scalar, Dependence::Phase),
    ];
    all.extend(match surface {
        BallSurface::Support | BallSurface::Profile => vec![
            ("r", Contact, Type::VECTOR, Dependence::Phase),
            ("r'", ContactRate, Type::VECTOR, Dependence::Phase),
            ("∂r", Slope, Type::MATRIX, Dependence::Phase),
            ("h", Support, Type::Scalar, Dependence::Configuration),
        ],
        BallSurface::Level => vec![
            ("γ", Normal, Type::VECTOR, Dependence::Phase),
            ("γ'", NormalRate, Type::VECTOR, Dependence::Phase),
            ("F", SurfaceFunction, Type::Scalar, Dependence::Configuration),
            ("n", SurfaceGradient, Type::VECTOR, Dependence::Phase),
            ("∂n", SurfaceHessian, Type::MATRIX, Dependence::Phase),
            ("r'", ContactRate, Type::VECTOR, Dependence::Phase),
        ],
    });
    if surface == BallSurface::Profile {
        all.extend([
            ("z", AxisCosine, Type::Scalar, Dependence::Configuration),
            ("p", Profile, Type::Scalar, Dependence::Phase),
            ("p'", ProfileRate, Type::Scalar, Dependence::Phase),
            ("p''", ProfileSecond, Type::Scalar, Dependence::Phase),
        ]);
    }
    all
}

/// Lists the quantities of Hamilton's equations.
pub fn of_hamiltonian() -> Vec<(&'static str, Quantity, Type, Dependence)> {
    vec![("energy", Quantity::Energy, Type::Scalar, Dependence::Phase)]
}

/// Lists the quantities of a Lagrangian system with some constraints.
pub fn of_lagrangian(constraints: usize) -> Vec<(String, Quantity, Type, Dependence)> {
    let mut all = vec![("energy".to_string(), Quantity::Energy, Type::Scalar, Dependence::Phase)];
    let reaction =
        |name: String, index| (name, Quantity::Reaction(index), Type::Scalar, Dependence::Phase);
    if constraints == 1 {
        all.push(reaction("μ".to_string(), 0));
    }
    all.extend((0..constraints).map(|index| reaction(format!("μ{}", index + 1), index)));
    all
}
