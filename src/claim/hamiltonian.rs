//! Hamiltonian form in the variables of `[variables]` with the bracket of `[poisson]`.

use super::{Condition, Jets, Need, Reader, Statement, difference, quadrature_defects};
use crate::formula::{Formula, Type};
use crate::graph::Expr;
use crate::mechanics::calculus::{Jet, trace_of_quotient};
use crate::mechanics::{Model, Phase, Poisson, Variables};
use crate::scalar::Scalar;

/// The claim N⁻¹y' = P ∂H/∂y and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct Hamiltonian {
    hamiltonian: Formula,
    multiplier: Option<Formula>,
    /// Index of the bracket.
    bracket: usize,
}

/// The claim P ∂C/∂y = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct Casimir {
    function: Formula,
    /// Index of the bracket.
    bracket: usize,
}

/// The claim Σ_l (P_il ∂_lP_jk + P_jl ∂_lP_ki + P_kl ∂_lP_ij) = 0 and P + Pᵀ = 0.
#[derive(Clone, Debug)]
pub struct JacobiIdentity {
    /// Index of the bracket.
    bracket: usize,
}

/// The claim that the measure ρ dy is invariant: v(ln ρ) + Σ ∂y'_i/∂y_i = 0.
#[derive(Clone, Debug)]
pub struct DensityInVariables(Formula);

/// Returns the variables of the case, or the complaint that there are none.
pub(super) fn variables<'r, R: Reader>(
    from: &'r R,
    key: &'static str,
) -> Result<&'r Variables, R::Error> {
    from.model().variables.as_deref().ok_or_else(|| {
        let message =
            format!("`{key}` is a claim about a bracket or new variables, and the case has none");
        let remedy = "add [poisson] for a bracket, [variables] for new variables";
        from.complaint(key, message, remedy)
    })
}

/// Reads a scalar in the new variables.
fn scalar_in<R: Reader>(from: &R, key: &'static str) -> Result<Formula, R::Error> {
    let names = &variables(from, key)?.model.vocabulary;
    from.formula_in(key, Some(Type::Scalar), names)?.ok_or_else(|| from.missing(key))
}

/// Key that chooses one of several brackets.
pub(super) const CHOICE: &str = "poisson";

/// Returns the index of the bracket that a claim is about, or the complaint that there is none.
pub(super) fn bracket_of<R: Reader>(from: &R, key: &'static str) -> Result<usize, R::Error> {
    let brackets = &variables(from, key)?.brackets;
    match (from.text(CHOICE)?, brackets.len()) {
        (_, 0) => {
            let message = format!("`{key}` needs a bracket");
            Err(from.complaint(key, message, "add [poisson], e.g. structure = \"e(3)\""))
        }
        (None, 1) => Ok(0),
        (None, _) => {
            let message = format!("the case has the brackets {}", names(brackets));
            let remedy = format!("choose one: poisson = \"{}\"", brackets[0].name);
            Err(from.complaint(key, message, &remedy))
        }
        (Some(name), _) => named_bracket(from, CHOICE, &name),
    }
}

/// Returns the index of the bracket of this name.
pub(super) fn named_bracket<R: Reader>(
    from: &R,
    key: &'static str,
    name: &str,
) -> Result<usize, R::Error> {
    let brackets = &variables(from, key)?.brackets;
    brackets.iter().position(|bracket| bracket.name == name.trim()).ok_or_else(|| {
        let message = format!("there is no bracket `{name}`");
        from.complaint(key, message, &format!("there is {}", names(brackets)))
    })
}

fn names(brackets: &[Poisson]) -> String {
    let names: Vec<String> = brackets.iter().map(|one| format!("`{}`", one.name)).collect();
    names.join(", ")
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
    brackets: &[usize],
    functions: impl Iterator<Item = &'f Formula>,
) -> Vec<Expr> {
    let variables = of(jet.phase.model());
    let there = Jet::new(variables.point(&jet.phase));
    let of_one = |formula: &Formula| quadrature_defects(&there, formula, &[]);
    let brackets = brackets.iter().map(|bracket| &variables.brackets[*bracket]);
    let blocks = brackets.flat_map(Poisson::given_blocks);
    functions.flat_map(of_one).chain(blocks.flat_map(of_one)).collect()
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
    const COMPANIONS: &'static [&'static str] = &["multiplier", CHOICE];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        let hamiltonian = scalar_in(from, Self::NAME)?;
        let names = &variables(from, Self::NAME)?.model.vocabulary;
        let multiplier = from.formula_in("multiplier", Some(Type::Scalar), names)?;
        Ok(Self { hamiltonian, multiplier, bracket })
    }

    fn residual<T: Scalar>(&self, jet: &Jet<'_, T>, _: &[bool]) -> Vec<T> {
        let variables = of(jet.phase.model());
        let there = variables.point(&jet.phase);
        let multiplier = self.multiplier.as_ref().map_or_else(T::one, |n| there.scalar(n));
        let gradient = slope(&there, &self.hamiltonian);
        let tensor = variables.tensor(self.bracket, &there);
        let claimed = turned(&tensor, &gradient).into_iter().map(|x| x * multiplier).collect();
        let mut residual = difference(variables.rates(jet), claimed);
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }

    fn conditions(&self, jet: &Jet<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        vec![they_vary(jet, "the new variables obey a relation", false)]
    }

    fn quadrature_defects_elsewhere(&self, jet: &Jet<'_, Expr>) -> Vec<Expr> {
        defects(jet, &[self.bracket], [&self.hamiltonian].into_iter().chain(&self.multiplier))
    }
}

impl Casimir {
    fn at<T: Scalar>(&self, variables: &Variables, there: &Phase<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(self.bracket, there);
        let mut residual = turned(&tensor, &slope(there, &self.function));
        residual.extend(variables.symmetric_part(&tensor));
        residual
    }
}

impl Statement for Casimir {
    const NAME: &'static str = "casimir";
    const COMPANIONS: &'static [&'static str] = &[CHOICE];
    const OF_MAPS: bool = true;
    const AT_IMAGES: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        Ok(Self { function: scalar_in(from, Self::NAME)?, bracket })
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
        defects(jet, &[self.bracket], [&self.function].into_iter())
    }
}

/// Computes the derivatives of a tensor: the entry l is ∂P/∂y_l.
pub(super) fn tensor_slopes<T: Scalar>(
    variables: &Variables,
    bracket: usize,
    there: &Phase<'_, T>,
) -> Vec<Vec<Vec<T>>> {
    let along = |l| {
        let moved = variables.tensor(bracket, &there.lift_along(l));
        moved.iter().map(|row| row.iter().map(|p| p.eps).collect()).collect()
    };
    (0..there.model().dimension()).map(along).collect()
}

impl JacobiIdentity {
    fn at<T: Scalar>(&self, variables: &Variables, there: &Phase<'_, T>) -> Vec<T> {
        let tensor = variables.tensor(self.bracket, there);
        let n = tensor.len();
        let slopes = tensor_slopes(variables, self.bracket, there);
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
    const COMPANIONS: &'static [&'static str] = &[CHOICE];
    const OF_MAPS: bool = true;
    const AT_IMAGES: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let bracket = bracket_of(from, Self::NAME)?;
        from.word(Self::NAME, "holds").map(|()| Self { bracket })
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
        defects(jet, &[self.bracket], std::iter::empty())
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
            let remedy = "a density needs equal numbers of new and old variables";
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
        defects(jet, &[], [&self.0].into_iter())
    }
}
