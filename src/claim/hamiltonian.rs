//! Hamiltonian form in the variables of `[variables]` with the bracket of `[poisson]`.

use super::{Condition, Jets, Need, Reader, Statement, difference, quadrature_defects};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, trace_of_quotient};
use crate::mechanics::{Model, Phase, Variables};
use crate::scalar::Scalar;

/// The claim N⁻¹y' = P ∂H/∂y and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    hamiltonian: Formula,
    multiplier: Option<Formula>,
}

/// The claim P ∂C/∂y = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct Casimir(Formula);

/// The claim Σ_l (P_il ∂_lP_jk + P_jl ∂_lP_ki + P_kl ∂_lP_ij) = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct JacobiIdentity;

/// The claim that the measure ρ dy is invariant: v(ln ρ) + Σ ∂y'_i/∂y_i = 0.
#[derive(Clone, Debug)]
pub struct DensityInVariables(Formula);

/// Returns the variables of the case, or the complaint that there are none.
pub(super) fn variables<'r, R: Reader>(
    from: &'r R,
    key: &'static str,
) -> Result<&'r Variables, R::Error> {
    from.model().variables.as_deref().ok_or_else(|| {
        let message = format!("`{key}` is a claim about new variables, and the case has none");
        from.complaint(key, message, "add [variables], and [poisson] for a bracket")
    })
}

/// Reads a scalar in the new variables.
fn scalar_in<R: Reader>(from: &R, key: &'static str) -> Result<Formula, R::Error> {
    let names = &variables(from, key)?.model.vocabulary;
    from.formula_in(key, Some(Type::Scalar), names)?.ok_or_else(|| from.missing(key))
}

/// Fails if the case has no bracket.
pub(super) fn bracket_is_given<R: Reader>(from: &R, key: &'static str) -> Result<(), R::Error> {
    if variables(from, key)?.has_bracket() {
        return Ok(());
    }
    let message = format!("`{key}` needs a bracket");
    Err(from.complaint(key, message, "add [poisson], e.g. structure = \"e(3)\""))
}

/// Returns the variables of a model; claims about them are refused if there are none.
pub(super) fn of(model: &Model) -> &Variables {
    match &model.variables {
        Some(variables) => variables,
        None => unreachable!("checked when the claim was read"),
    }
}

/// Computes ∂F/∂y.
fn slope<T: Scalar>(there: &Phase<'_, T>, function: &Formula) -> Vec<T> {
    (0..there.model().dimension()).map(|i| there.lift_along(i).scalar(function).eps).collect()
}

/// Computes P u.
pub(super) fn turned<T: Scalar>(tensor: &[Vec<T>], u: &[T]) -> Vec<T> {
    tensor.iter().map(|row| row.iter().zip(u).map(|(p, u)| *p * *u).sum()).collect()
}

/// Computes values that vanish exactly when each ∫ in functions of the new variables, and in the
/// bracket, is a function of its variable.
pub(super) fn defects<'f>(
    jet: &Jet<'_, Expr>,
    functions: impl Iterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let variables = of(jet.phase.model());
    let there = Jet::new(variables.point(&jet.phase));
    let of_one = |formula: &Formula| quadrature_defects(&there, formula, &[]);
    functions.flat_map(of_one).chain(variables.given_blocks().flat_map(of_one)).collect()
}

/// Requires that the new variables vary independently, so that statements about them hold for all
/// their values.
pub(super) fn they_vary(jet: &Jet<'_, Expr>, otherwise: &str, is_essential: bool) -> Condition {
    let images = of(jet.phase.model()).images.iter();
    let rows: Vec<Vec<Expr>> = images.flat_map(|image| jet.gradients(image)).collect();
    let need = Need::Rank { rank: rows.len(), rows };
    Condition { need, otherwise: otherwise.to_string(), is_essential }
}

/// Message on a bracket that is tested where the new variables obey a relation.
pub(super) const ON_A_PART: &str = "the new variables obey a relation, and what is said of their bracket holds \
                         where they do: give as many as vary independently";

impl Statement for Hamiltonian {
    const NAME: &'static str = "hamiltonian";
    const COMPANIONS: &'static [&'static str] = &["multiplier"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        bracket_is_given(from, Self::NAME)?;
        let hamiltonian = scalar_in(from, Self::NAME)?;
        let names = &variables(from, Self::NAME)?.model.vocabulary;
        let multiplier = from.formula_in("multiplier", Some(Type::Scalar), names)?;
        Ok(Self { hamiltonian, multiplier })
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        let there = variables.point(&jet.phase);
        let multiplier = self.multiplier.as_ref().map_or_else(T::one, |n| there.scalar(n));
        let gradient = slope(&there, &self.hamiltonian);
        let tensor = variables.tensor(&there);
        let claimed = turned(&tensor, &gradient).into_iter().map(|x| x * multiplier).collect();
        let mut residual = difference(variables.rates(jet), claimed);
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }

    fn conditions(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        vec![they_vary(jet, "the new variables obey a relation", false)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        defects(jet, [&self.hamiltonian].into_iter().chain(&self.multiplier))
    }
}

impl Casimir {
    fn at<T: Scalar>(&self, variables: &Variables, there: &Phase<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(there);
        let mut residual = turned(&tensor, &slope(there, &self.0));
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }
}

impl Statement for Casimir {
    const NAME: &'static str = "casimir";
    const OF_MAPS: bool = true;
    const AT_IMAGES: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        bracket_is_given(from, Self::NAME)?;
        scalar_in(from, Self::NAME).map(Self)
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        self.at(variables, &variables.point(&jet.phase))
    }

    fn residual_of_values(
        &self,
        variables: &Variables,
        there: &Phase<'_, Expr>,
    ) -> Option<Vec<Expr>> {
        Some(self.at(variables, there))
    }

    fn conditions(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        vec![they_vary(jet, ON_A_PART, true)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        defects(jet, [&self.0].into_iter())
    }
}

impl JacobiIdentity {
    fn at<T: Scalar>(variables: &Variables, there: &Phase<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(there);
        let n = tensor.len();
        // slopes[l] is ∂P/∂y_l.
        let slopes: Vec<Vec<Vec<T>>> = (0..n)
            .map(|l| {
                let moved = variables.tensor(&there.lift_along(l));
                moved.iter().map(|row| row.iter().map(|p| p.eps).collect()).collect()
            })
            .collect();
        let term = |i: usize, j: usize, k: usize| -> T {
            (0..n).map(|l| tensor[i][l] * slopes[l][j][k]).sum()
        };
        let mut residual = variables.symmetric_part(&tensor);
        for i in 0..n {
            for j in i + 1..n {
                residual.extend((j + 1..n).map(|k| term(i, j, k) + term(j, k, i) + term(k, i, j)));
            }
        }
        residual
    }
}

impl Statement for JacobiIdentity {
    const NAME: &'static str = "jacobi-identity";
    const OF_MAPS: bool = true;
    const AT_IMAGES: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        bracket_is_given(from, Self::NAME)?;
        from.word(Self::NAME, "holds").map(|()| Self)
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        Self::at(variables, &variables.point(&jet.phase))
    }

    fn residual_of_values(
        &self,
        variables: &Variables,
        there: &Phase<'_, Expr>,
    ) -> Option<Vec<Expr>> {
        Some(Self::at(variables, there))
    }

    fn conditions(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        vec![they_vary(jet, ON_A_PART, true)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        defects(jet, std::iter::empty())
    }
}

impl Statement for DensityInVariables {
    const NAME: &'static str = "density-in-variables";
    const JETS: Jets = Jets::Twice;
    const UNDEFINED: &'static str = ": the new variables may be dependent there, as N*(Ĩ*ω − (Ĩ*ω,γ)*γ) \
                                     is, to which + (ω,γ)*γ may be added";

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let variables = variables(from, Self::NAME)?;
        let (old, new) = (from.model().dimension(), variables.model.dimension());
        if old != new {
            let message = format!("{new} new variables take the place of {old}");
            let remedy = "a density needs as many new variables as old ones";
            return Err(from.complaint(Self::NAME, message, remedy));
        }
        scalar_in(from, Self::NAME).map(Self)
    }

    /// Computes v(ln ρ∘φ) + tr(dφ⁻¹ d(L_vφ)): the divergence of the motion in the new variables.
    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, kept: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        let moved = jet.phase.lift(jet.phase.field());
        let along = variables.point(&moved);
        let growth = self.0.logarithmic_derivative(&mut |symbol| along.value(symbol));
        let mut columns = Vec::new();
        let mut rates = Vec::new();
        for beside in jet.along_axes() {
            columns.push(variables.image(beside).iter().map(|y| y.eps).collect::<Vec<T>>());
            let further = variables.image(&beside.lift(beside.field()));
            rates.push(further.iter().map(|y| y.eps.eps).collect::<Vec<T>>());
        }
        vec![growth + trace_of_quotient(&columns, &rates) - jet.level_cofactor(kept)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        defects(jet, [&self.0].into_iter())
    }
}
