//! Derivatives of functions and of the field by automatic differentiation: gradients, Lie
//! derivatives, divergences, and the contribution of a level set to a divergence.

use std::cell::OnceCell;

use num_dual::Dual;

use super::elimination::transversals;
use super::level_equation::LevelFunction;
use super::model::Model;
use super::phase::Phase;
use super::variables::VariablesJet;
use crate::formula::Formula;
use crate::scalar::Scalar;

/// Dimension of phase space from which derivatives are taken by sweeps of the recording.
///
/// A lift along each coordinate repeats the whole computation, which for a few coordinates costs
/// nothing worth mention, and for n of them n times what it should.
pub(super) const MANY: usize = 20;

/// A point of phase space with its lifts to dual numbers, made once for all derivatives.
pub struct DualPoint<'m, T> {
    /// The point itself.
    pub phase: Phase<'m, T>,
    along_field: OnceCell<Phase<'m, Dual<T>>>,
    along_axes: OnceCell<Vec<Phase<'m, Dual<T>>>>,
    divergence: OnceCell<T>,
    level_gradients: OnceCell<Vec<Vec<T>>>,
    energy_gradient: OnceCell<Option<Vec<T>>>,
    pub(super) image: VariablesJet<'m, T>,
}

impl<'m, T: Scalar> DualPoint<'m, T> {
    /// Makes the jet at a point; nothing is computed yet.
    #[inline(never)]
    pub fn new(phase: Phase<'m, T>) -> Self {
        Self {
            phase,
            along_field: OnceCell::new(),
            along_axes: OnceCell::new(),
            divergence: OnceCell::new(),
            level_gradients: OnceCell::new(),
            energy_gradient: OnceCell::new(),
            image: VariablesJet::default(),
        }
    }

    /// Makes the jet at a point with the divergence by the system's closed formula, where there is
    /// one.
    #[inline(never)]
    pub fn short(phase: Phase<'m, T>) -> Self {
        let divergence = phase.model().system.divergence(&phase);
        let jet = Self::new(phase);
        if let Some(divergence) = divergence {
            jet.divergence.get_or_init(|| divergence);
        }
        jet
    }

    /// Returns the point with the field as its derivative part.
    #[inline(never)]
    pub fn along_field(&self) -> &Phase<'m, Dual<T>> {
        self.along_field.get_or_init(|| self.phase.lift(self.phase.field()))
    }

    /// Returns the point with a derivative part along each coordinate in turn.
    #[inline(never)]
    pub fn along_axes(&self) -> &[Phase<'m, Dual<T>>] {
        self.along_axes.get_or_init(|| {
            (0..self.phase.model().dimension()).map(|index| self.phase.lift_along(index)).collect()
        })
    }

    /// Computes L_v f, the derivative of f along the field.
    #[inline(never)]
    pub fn lie_derivative(&self, f: impl FnOnce(&Phase<'m, Dual<T>>) -> Dual<T>) -> T {
        f(self.along_field()).eps
    }

    /// Computes the gradients of values at the point by sweeps of the recording; `None` where lifts
    /// along the coordinates have to do it.
    #[inline(never)]
    fn swept(&self, values: impl FnOnce(&Phase<'m, T>) -> Vec<T>) -> Option<Vec<Vec<T>>> {
        let dimension = self.phase.model().dimension();
        if dimension < MANY {
            return None;
        }
        let rows = T::gradients_of(&values(&self.phase), &self.phase.state())?;
        Some(rows.iter().map(|row| filled(row, dimension)).collect())
    }

    /// Computes the partial derivatives of f with respect to the state's components.
    #[inline(never)]
    pub fn gradient(&self, f: impl Fn(&Phase<'m, Dual<T>>) -> Dual<T>) -> Vec<T> {
        self.along_axes().iter().map(|phase| f(phase).eps).collect()
    }

    /// Computes L_vF, component by component.
    #[inline(never)]
    pub fn rates(&self, formula: &Formula) -> Vec<T> {
        self.along_field().evaluate(formula).components().iter().map(|x| x.eps).collect()
    }

    /// Computes the gradients of the components of F.
    #[inline(never)]
    pub fn gradients(&self, formula: &Formula) -> Vec<Vec<T>> {
        if let Some(rows) = self.swept(|at| at.evaluate(formula).components()) {
            return rows;
        }
        let columns: Vec<Vec<T>> = self
            .along_axes()
            .iter()
            .map(|phase| phase.evaluate(formula).components().iter().map(|x| x.eps).collect())
            .collect();
        let count = formula.value_type().size();
        (0..count).map(|k| columns.iter().map(|column| column[k]).collect()).collect()
    }

    /// Computes the gradient of the logarithm of F, factor by factor.
    #[inline(never)]
    pub fn logarithmic_gradient(&self, formula: &Formula) -> Vec<T> {
        let dimension = self.phase.model().dimension();
        if dimension >= MANY {
            let state = self.phase.state();
            let gradients = |values: &[T]| T::gradients_of(values, &state);
            let found =
                formula.logarithmic_gradient(&mut |symbol| self.phase.value(symbol), &gradients);
            if let Some(row) = found {
                return filled(&row, dimension);
            }
        }
        self.along_axes()
            .iter()
            .map(|moved| formula.logarithmic_derivative(&mut |symbol| moved.value(symbol)))
            .collect()
    }

    /// Computes div v = Σ ∂v_i/∂x_i over all components of the state.
    #[inline(never)]
    pub fn divergence(&self) -> T {
        *self.divergence.get_or_init(|| {
            if self.phase.model().dimension() >= MANY
                && let Some(terms) = T::diagonal_of(self.phase.field(), &self.phase.state())
            {
                return terms.into_iter().sum();
            }
            let along = self.along_axes().iter().enumerate();
            along.map(|(i, phase)| phase.field()[i].eps).sum()
        })
    }

    /// Computes Σ d(L_vF_i)(n_i) over the kept level functions, with dF_i(n_j) = δ_ij.
    ///
    /// On a level set {F_i = c_i} with dx = dF_1∧…∧dF_k∧σ, L_v σ = (div v - this sum) σ. It
    /// vanishes where the F_i are integrals near the level.
    #[inline(never)]
    pub fn level_cofactor(&self, kept: &[bool]) -> T {
        let functions: Vec<&LevelFunction> = kept_functions(self.phase.model(), kept).collect();
        if functions.is_empty() || self.phase.model().system.conserves_level() {
            return T::zero();
        }
        let gradients = self.level_gradients(kept);
        let mut sum = T::zero();
        for (function, transversal) in functions.iter().zip(transversals(&gradients)) {
            let beside = self.phase.lift(&transversal);
            sum += beside.lift(beside.field()).level_function(function).eps.eps;
        }
        sum
    }

    /// Evaluates the kept level functions at another point, and what chooses a half of the whole level.
    #[inline(never)]
    pub fn level_at(&self, there: &Phase<'m, T>, kept: &[bool]) -> Vec<T> {
        let model = there.model();
        let halves = kept.iter().all(|kept| *kept).then_some(&model.orientations);
        let chosen = halves.into_iter().flatten().map(|own| &own.equation.function);
        kept_functions(model, kept).chain(chosen).map(|f| there.level_function(f)).collect()
    }

    /// Computes the gradients of the kept level functions.
    #[inline(never)]
    pub fn level_gradients(&self, kept: &[bool]) -> Vec<Vec<T>> {
        let all = self.level_gradients.get_or_init(|| {
            let level = || self.phase.model().level.iter().map(|equation| &equation.function);
            let swept = self.swept(|at| level().map(|f| at.level_function(f)).collect());
            swept.unwrap_or_else(|| {
                level().map(|f| self.gradient(|at| at.level_function(f))).collect()
            })
        });
        all.iter().zip(kept).filter(|(_, kept)| **kept).map(|(g, _)| g.clone()).collect()
    }

    /// Computes the gradient of the energy, where there is one.
    #[inline(never)]
    pub fn energy_gradient(&self) -> Option<&Vec<T>> {
        let make = || {
            let energy = |at: &Phase<'m, T>| at.model().system.energy(at);
            if let Some(mut rows) = self.swept(|at| energy(at).into_iter().collect()) {
                return rows.pop();
            }
            let slope = |at: &Phase<'m, Dual<T>>| Some(at.model().system.energy(at)?.eps);
            self.along_axes().iter().map(slope).collect()
        };
        self.energy_gradient.get_or_init(make).as_ref()
    }
}

/// Writes a row of derivatives out, with 0 for those that it leaves out.
#[inline(never)]
fn filled<T: Scalar>(row: &[(usize, T)], dimension: usize) -> Vec<T> {
    let mut all = vec![T::zero(); dimension];
    row.iter().for_each(|(place, value)| all[*place] = *value);
    all
}

/// Selects the level functions given by `kept`.
#[inline(never)]
fn kept_functions<'a>(
    model: &'a Model,
    kept: &'a [bool],
) -> impl Iterator<Item = &'a LevelFunction> + use<'a> {
    let level = model.level.iter().zip(kept);
    level.filter(|(_, kept)| **kept).map(|(equation, _)| &equation.function)
}
