//! Functions in involution in the bracket of the motion, and Liouville's theorem with them.
//!
//! ```text
//! {F_i,F_j} = (u_i, P u_j) = 0,   u_i = ∂F_i/∂y
//! ```
//!
//! P is the bracket of `[hamiltonian]` or of `[poisson]`, or that of the momenta of a Lagrangian. With
//! `theorem = "Liouville"` the claim is also that the hypotheses of Liouville's theorem hold:
//! docs/soundness.md, "Liouville's theorem".

use super::boxes::Boxes;
use super::jacobi_identity::jacobi_defects;
use super::of_bracket::{
    CHOICE, bracket_of, images_as_written, tensor_slopes, they_vary, turned, written,
};
use super::statement::Objection;
use super::{Condition, Jets, Need, Reader, Statement, ValueShape, clock};
use crate::formula::{Formula, Layout};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::dot;
use crate::mechanics::{Model, MotionBracket, System, size_of_variables};
use crate::number::rational::Rational;
use crate::scalar::Scalar;

/// Key of the theorem whose hypotheses are claimed.
const THEOREM: &str = "theorem";
/// Its only value.
const LIOUVILLE: &str = "Liouville";
/// Key of a place other than the level.
const PLACE: &str = "where";
/// Largest number of components of the functions.
const MOST_FUNCTIONS: usize = 24;

/// The claim {F_i,F_j} = 0 for all pairs, and that Liouville's theorem applies if it is named.
#[derive(Clone, Debug)]
pub struct Involution {
    functions: Vec<Formula>,
    bracket: MotionBracket,
    /// Whether the motion is Hamiltonian in the bracket by its definition.
    is_own: bool,
    is_complete: bool,
}

impl Involution {
    /// Returns the functions, in the names of the bracket's variables.
    pub fn functions(&self) -> &[Formula] {
        &self.functions
    }
}

impl Statement for Involution {
    const NAME: &'static str = "involution";
    const COMPANIONS: &'static [&'static str] = &[THEOREM, CHOICE];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::List)];
    const WIDENS: bool = false;
    const JETS: Jets = Jets::Twice;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let functions = from.list(Self::NAME)?.ok_or_else(|| from.missing(Self::NAME))?;
        let count = components(&functions);
        if !(2..=MOST_FUNCTIONS).contains(&count) && from.text(THEOREM)?.is_none() || count == 0 {
            let message = match count {
                0 => "no functions are listed".to_string(),
                1 => "one function is in involution with itself".to_string(),
                _ => format!("{count} functions are too many"),
            };
            let remedy = format!("list between 2 and {MOST_FUNCTIONS} functions");
            return Err(from.complaint(Self::NAME, message, &remedy));
        }
        let (bracket, is_own) = bracket(from)?;
        let is_complete = match from.text(THEOREM)? {
            None => false,
            Some(name) if name.trim() == LIOUVILLE => true,
            Some(name) => {
                let message = format!("`{name}` is not a theorem that can be claimed");
                return Err(from.complaint(THEOREM, message, "write theorem = \"Liouville\""));
            }
        };
        // On fewer equations of the level there are more dimensions; without enough functions the ranks fail.
        let is_whole = from.text(PLACE)?.is_none() || from.model().level.is_empty();
        if is_complete && is_whole {
            check_number(from, count)?;
        }
        Ok(Self { functions, bracket, is_own, is_complete })
    }

    fn text(&self) -> Option<String> {
        let all: Vec<&str> = self.functions.iter().map(|own| own.text().trim()).collect();
        Some(all.join(", "))
    }

    fn layout(&self, boxes: Boxes<'_>) -> Option<Layout> {
        // In the names of other variables, a formula is not one of the case.
        matches!(self.bracket, MotionBracket::OfMomenta).then(|| boxes.listed(&self.functions))
    }

    fn formulas(&self) -> Vec<&Formula> {
        self.functions.iter().collect()
    }

    fn written_elsewhere(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        let (MotionBracket::OfVariables(index), Some(variables)) =
            (self.bracket, jet.phase.model().variables.as_deref())
        else {
            return Vec::new();
        };
        let there = &jet.in_variables(variables).phase;
        let mut values = images_as_written(variables, &jet.phase);
        values.extend(written(variables, &[index], std::iter::empty(), there));
        values
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let tensor = self.bracket.tensor(jet);
        let covectors = self.covectors(jet);
        let flows: Vec<Vec<T>> = covectors.iter().map(|own| turned(&tensor, own)).collect();
        let mut residual = Vec::new();
        for (i, own) in covectors.iter().enumerate() {
            residual.extend(flows[i + 1..].iter().map(|flow| dot(own, flow)));
        }
        residual.extend(symmetric_part(&tensor));
        if self.is_complete {
            residual.extend(self.functions.iter().flat_map(|own| jet.rates(own)));
            residual.extend(self.defects_of_bracket(jet));
            // The functions of the level are Casimir functions.
            let level = self.bracket.covectors(jet, jet.level_gradients(kept));
            residual.extend(level.iter().flat_map(|own| turned(&tensor, own)));
            if !self.is_own {
                residual.extend(self.commutators(jet));
            }
        }
        residual
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, kept: &[bool]) -> Vec<Condition> {
        let mut conditions = Vec::new();
        let dimension = jet.phase.model().dimension();
        let tensor = self.bracket.tensor(jet);
        if let MotionBracket::OfVariables(_) = self.bracket {
            conditions.push(they_vary(jet, "the new variables obey a relation", true));
            conditions.push(Condition::nonzero(tensor.concat(), "the bracket is 0"));
        }
        if self.is_complete {
            let mut rows = jet.level_gradients(kept);
            rows.extend(self.functions.iter().flat_map(|own| jet.gradients(own)));
            let count = rows.len();
            let otherwise = "the functions are dependent".to_string();
            let need = Need::Rank { rows, rank: count, fixed: 0 };
            conditions.push(Condition { need, otherwise, is_essential: true });
            let others = dimension.saturating_sub(count);
            let need = match self.bracket {
                MotionBracket::OfVariables(_) => {
                    let rows = self.covectors(jet).iter().map(|own| turned(&tensor, own)).collect();
                    Need::Rank { rows, rank: others, fixed: 0 }
                }
                // No combination of independent functions has the field 0.
                MotionBracket::OfMomenta => Need::NotZero {
                    value: Expr::rational(&Rational::from(i64::from(others <= count))),
                },
            };
            let otherwise = "the fields of the functions do not span the joint levels".to_string();
            conditions.push(Condition { need, otherwise, is_essential: true });
        }
        conditions
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        let has_clock = self.is_complete && clock(model).is_some();
        has_clock.then(|| Objection {
            message: "the theorem of Liouville needs equations without `t`".to_string(),
            remedy: "leave out theorem = \"Liouville\": the functions may still be in involution",
        })
    }

    fn remark(&self, model: &Model, kept: &[bool]) -> Option<String> {
        let imposed = kept.iter().filter(|kept| **kept).count();
        let count = components(&self.functions) + imposed;
        let tori = model.dimension().checked_sub(count).filter(|_| self.is_complete)?;
        Some(format!(
            "Liouville's theorem: a compact connected joint level on which the functions are independent, \
             their fields span it, and these and the equations of motion are smooth, is a torus of \
             dimension {tori}, and the motion on it is quasi-periodic"
        ))
    }
}

impl Involution {
    fn covectors<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<Vec<T>> {
        let gradients = self.functions.iter().flat_map(|own| jet.gradients(own)).collect();
        self.bracket.covectors(jet, gradients)
    }

    /// Computes what Jacobi's identity says is 0; that of canonical variables holds.
    fn defects_of_bracket<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<T> {
        match (self.bracket, jet.phase.model().variables.as_deref()) {
            (MotionBracket::OfVariables(index), Some(variables)) => {
                let there = jet.in_variables(variables);
                let tensor = variables.tensor(index, &there.phase);
                jacobi_defects(&tensor, &tensor_slopes(variables, index, there))
            }
            _ => Vec::new(),
        }
    }

    /// Computes [v,X] for the fields X of the functions: a field v need not be one of Hamilton.
    fn commutators<T: Scalar>(&self, jet: &DualPoint<'_, T>) -> Vec<T> {
        let moved = DualPoint::new(jet.phase.lift(jet.phase.field()));
        let tensor = self.bracket.tensor(&moved);
        let flows = self.covectors(&moved).iter().map(|own| turned(&tensor, own)).collect();
        let mut residual = Vec::new();
        for flow in self.bracket.vectors(&moved, flows) {
            let (field, rate): (Vec<T>, Vec<T>) = flow.iter().map(|x| (x.re, x.eps)).unzip();
            let beside = jet.phase.lift(&field);
            residual.extend(beside.field().iter().zip(rate).map(|(along, rate)| along.eps - rate));
        }
        residual
    }
}

/// Number of components of some functions.
fn components(functions: &[Formula]) -> usize {
    functions.iter().map(|own| own.value_type().size()).sum()
}

/// Returns the bracket that is chosen, or that of the motion, and whether the motion is Hamiltonian in it
/// by its definition.
fn bracket<R: Reader>(from: &R) -> Result<(MotionBracket, bool), R::Error> {
    let model = from.model();
    let is_named = from.text(CHOICE)?.is_some();
    if let System::Lagrangian(own) = &model.system
        && !is_named
        && own.has_canonical_momenta()
        && model.level.is_empty()
    {
        return Ok((MotionBracket::OfMomenta, true));
    }
    if matches!(model.system, System::Lagrangian(_)) && !is_named && model.variables.is_none() {
        let message = "the momenta of this Lagrangian have no bracket of their own".to_string();
        let remedy = "they have one without constraints, forces, quasi-velocities, [level] and `t`; \
                      otherwise give [variables] and [poisson]";
        return Err(from.complaint(Involution::NAME, message, remedy));
    }
    let variables = model.variables.as_deref();
    let brackets = || variables.into_iter().flat_map(|own| &own.brackets);
    let own = match model.system {
        System::Hamiltonian(_) => brackets().position(|one| one.name == OF_HAMILTONIAN),
        _ => None,
    };
    let index = match own {
        Some(own) if !is_named => own,
        _ => bracket_of(from, Involution::NAME)?,
    };
    let size = variables.map_or(0, size_of_variables);
    if size != model.dimension() {
        let message = format!(
            "there are {size} components of new variables, and {} of the state",
            model.dimension()
        );
        let remedy =
            "give [variables] that determine the state, or claim a `bracket` of functions of them";
        return Err(from.complaint(Involution::NAME, message, remedy));
    }
    Ok((MotionBracket::OfVariables(index), own == Some(index)))
}

/// Name of the bracket of `[hamiltonian]`.
const OF_HAMILTONIAN: &str = "hamiltonian";

/// Checks that so many functions can be a complete set.
fn check_number<R: Reader>(from: &R, count: usize) -> Result<(), R::Error> {
    let model = from.model();
    let dimension = model.dimension().saturating_sub(model.level.len());
    // On a level of dimension n, k functions have joint levels of dimension n − k, which their k fields
    // span.
    let (least, most) = (dimension.div_ceil(2), dimension.saturating_sub(1));
    if (least..=most).contains(&count) {
        return Ok(());
    }
    let message = format!(
        "Liouville's theorem cannot hold with {count} function{} on a space of dimension {dimension}",
        if count == 1 { "" } else { "s" }
    );
    let remedy = format!(
        "list {least} functions, and one more for each two Casimir functions that [level] does not fix"
    );
    Err(from.complaint(Involution::NAME, message, &remedy))
}

/// Computes P + Pᵀ.
fn symmetric_part<T: Scalar>(matrix: &[Vec<T>]) -> Vec<T> {
    let pairs = (0..matrix.len()).flat_map(|i| (i..matrix.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| matrix[i][j] + matrix[j][i]).collect()
}
