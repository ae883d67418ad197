//! Bodies for the comparison, each given twice: as a case text, and by independent formulas.

use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual, DualNum};

use crate::common::drawn::Drawn;

/// The surface of a body, with r(γ) and ∂r/∂γ by formulas of this file.
#[derive(Clone, Copy, Debug)]
pub enum Surface {
    /// A ball, r = -Rγ - c.
    Ball,
    /// An ellipsoid, r = -Bγ/√(γ,Bγ) - c.
    Ellipsoid,
    /// A body with r = -∇h, h = [`bump`], differentiated by num-dual.
    Bump,
}

/// The load on the body besides the constraints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Load {
    Nothing,
    /// Weight, on the plane: a force at the mass centre.
    Weight,
    /// A potential U(γ) = 3/10 γ₁²γ₂ - γ₃³/2 + (e,γ).
    Potential,
}

/// A body to compare.
pub struct Body {
    pub name: &'static str,
    pub curved: bool,
    pub parameters: &'static [&'static str],
    pub shape: &'static str,
    pub surface: Surface,
    pub load: Load,
}

const C: &str = "c = \"vector(-0.5..0.5)\"";
const B: &str = "B = \"diag(1..4)\"";
const S: &str = "S = \"vector(-2..2)\"";
const E: &str = "e = \"vector(-1..1)\"";
const R: &str = "R = \"1..3\"";
const GRAVITY: &str = "a_g = \"1..10\"";
const BALL: &str = "shape = \"ball\"";
const ELLIPSOID: &str = "shape = \"ellipsoid\"";
const BUMP: &str = "support = \"3*|γ| + γ1*γ2*γ3/(5*|γ|²) + γ1³/(7*|γ|²) + γ2/4 − γ3/3\"";
const OUTSIDE: &str = "k = \"0.2..0.9\"";
const CAVITY: &str = "k = \"-0.2..-0.1\"";

const fn body(
    name: &'static str,
    curved: bool,
    parameters: &'static [&'static str],
    (shape, surface): (&'static str, Surface),
    load: Load,
) -> Body {
    Body { name, curved, parameters, shape, surface, load }
}

const PAPER_BALL: (&str, Surface) = ("contact = \"−R*γ − c\"", Surface::Ball);
/// An ellipsoid with another extension off |γ| = 1, for which Γ is not symmetric.
const SKEW: (&str, Surface) =
    ("contact = \"−B*γ*(1 + (γ,γ))/(2*√(γ,B*γ)) − c\"", Surface::Ellipsoid);
const A_BALL: (&str, Surface) = (BALL, Surface::Ball);
const AN_ELLIPSOID: (&str, Surface) = (ELLIPSOID, Surface::Ellipsoid);
const A_BUMP: (&str, Surface) = (BUMP, Surface::Bump);

/// Every kind of built-in rubber field.
pub const BODIES: [Body; 17] = [
    body("ball", false, &[R, C], A_BALL, Load::Nothing),
    body("ball by its contact", false, &[R, C], PAPER_BALL, Load::Nothing),
    body("ball with weight", false, &[R, C, GRAVITY], A_BALL, Load::Weight),
    body("ellipsoid", false, &[B, C], AN_ELLIPSOID, Load::Nothing),
    body("ellipsoid with rotor and weight", false, &[B, C, S, GRAVITY], AN_ELLIPSOID, Load::Weight),
    body("bump with rotor", false, &[S], A_BUMP, Load::Nothing),
    body("bump in a potential", false, &[E], A_BUMP, Load::Potential),
    body("ball on a ball", true, &[R, C, OUTSIDE], A_BALL, Load::Nothing),
    body(
        "ball on a ball by its contact",
        true,
        &[R, C, S, E, OUTSIDE],
        PAPER_BALL,
        Load::Potential,
    ),
    body("ball in a cavity", true, &[R, C, CAVITY], A_BALL, Load::Nothing),
    body("ball enclosing a ball", true, &["R = \"-4..-3\"", C, OUTSIDE], A_BALL, Load::Nothing),
    body("ellipsoid on a ball", true, &[B, C, OUTSIDE], AN_ELLIPSOID, Load::Nothing),
    body("ellipsoid in a cavity", true, &[B, C, S, CAVITY], AN_ELLIPSOID, Load::Nothing),
    body("ellipsoid in a potential", true, &[B, C, E, OUTSIDE], AN_ELLIPSOID, Load::Potential),
    body("ellipsoid with a skew Γ", true, &[B, C, E, OUTSIDE], SKEW, Load::Potential),
    body("bump on a ball", true, &[OUTSIDE], A_BUMP, Load::Nothing),
    body("bump with everything", true, &[S, E, CAVITY], A_BUMP, Load::Potential),
];

impl Body {
    /// Writes the case of the body, free to spin or not: no claims, only equations.
    pub fn case_text(&self, spins: bool) -> String {
        let way = if spins { "rolling" } else { "rubber" };
        let system = format!("{way}-{}", if self.curved { "sphere" } else { "plane" });
        let mut text = format!("title = \"{}\"\nsystem = \"{system}\"\n", self.name);
        text.push_str(
            "check-weights = false\n[parameters]\nm = \"0.5..2\"\nI = \"full(0.5..5)\"\n",
        );
        text.push_str(&self.parameters.join("\n"));
        text.push_str(&format!("\n[body]\n{}\n", self.shape));
        if self.parameters.contains(&S) {
            text.push_str("gyrostat = \"S\"\n");
        }
        text + match self.load {
            Load::Nothing => "",
            Load::Weight => "potential = \"m*a_g*h\"\n",
            Load::Potential => "potential = \"3/10*γ1²*γ2 − γ3³/2 + (e,γ)\"\n",
        }
    }

    /// Computes r and ∂r/∂γ on |γ| = 1; only the action of ∂r/∂γ across γ is meaningful.
    pub fn contact(&self, at: &Drawn) -> (Vector3<f64>, Matrix3<f64>) {
        let (gamma, c) = (at.vector("γ"), at.vector_or_zero("c"));
        match self.surface {
            Surface::Ball => {
                let radius = at.scalar("R");
                (-gamma * radius - c, -Matrix3::identity() * radius)
            }
            Surface::Ellipsoid => {
                let b = at.matrix("B");
                let (along, h) = (b * gamma, gamma.dot(&(b * gamma)).sqrt());
                (-along / h - c, along * along.transpose() / h.powi(3) - b / h)
            }
            Surface::Bump => {
                let second = |i: usize, j: usize| {
                    let seeded = std::array::from_fn(|k| {
                        let inner = Dual::new(gamma[k], f64::from(u8::from(k == i)));
                        Dual::new(inner, Dual::new(f64::from(u8::from(k == j)), 0.0))
                    });
                    bump(seeded)
                };
                let r = Vector3::from_fn(|i, _| -second(i, i).re.eps);
                (r, Matrix3::from_fn(|i, j| -second(i, j).eps.eps))
            }
        }
    }

    /// Computes ∂U/∂γ.
    pub fn slope(&self, at: &Drawn) -> Vector3<f64> {
        assert_eq!(self.load, Load::Potential, "the others have none");
        let g = at.vector("γ");
        let cubic = Vector3::new(0.6 * g.x * g.y, 0.3 * g.x * g.x, -1.5 * g.z * g.z);
        cubic + at.vector("e")
    }
}

/// Evaluates the support function of [`BUMP`].
fn bump<T: DualNum<Primitive = f64> + Copy>([x, y, z]: [T; 3]) -> T {
    let square = x * x + y * y + z * z;
    let cubic = x * y * z / (square * T::from(5.0)) + x * x * x / (square * T::from(7.0));
    square.sqrt() * T::from(3.0) + cubic + y / T::from(4.0) - z / T::from(3.0)
}
