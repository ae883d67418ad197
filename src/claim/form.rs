//! Differential forms: L_vΩ = cΩ for 1-forms and 2-forms, or Φ*Ω = cΩ for a map.
//!
//! In coordinates (L_vα)_i = v(α_i) + Σ α_k ∂_iv_k, and (L_vΩ)_ij = v(Ω_ij) + Σ Ω_kj ∂_iv_k + Σ Ω_ik ∂_jv_k;
//! on a level they are compared on vectors along it.

use super::components::Components;
use super::{Condition, Objection, Reader, ResidualContext, Statement, ValueShape};
use crate::formula::{Formula, Type, canonical_name};
use crate::graph::Expr;
use crate::mechanics::calculus::DualPoint;
use crate::mechanics::elimination::{dot, transversals};
use crate::mechanics::{Model, Phase};
use crate::scalar::Scalar;

/// The claim that a form is invariant, or conformally invariant with a factor c.
#[derive(Clone, Debug)]
pub struct Form {
    form: FormShape,
    /// Factor c, if one is given.
    factor: Option<Formula>,
    text: String,
}

/// Coefficients of a form.
#[derive(Clone, Debug)]
enum FormShape {
    /// A 1-form Σ α_i dx_i.
    One(Components),
    /// A 2-form ½ Σ Ω_ij dx_i∧dx_j.
    Two(Vec<FormBlock>),
}

/// Coefficients of dx∧dy for two variables; those of dy∧dx have the opposite sign.
#[derive(Clone, Debug)]
struct FormBlock {
    row: usize,
    column: usize,
    entries: Formula,
}

/// A square matrix, by rows.
type Square<T> = Vec<Vec<T>>;

impl FormBlock {
    fn read<R: Reader>(from: &R, name: &str, entries: Formula) -> Result<Self, R::Error> {
        let model = from.model();
        let remedy = "write \"q,p\" = \"E\" for the coefficients of dq∧dp";
        let index = |name: &str| {
            let name = canonical_name(name.trim()).unwrap_or_else(|| name.trim().to_string());
            let found = model.state.iter().position(|variable| variable.name == name);
            found.ok_or_else(|| from.not_a_variable(Form::NAME, &name, remedy.to_string()))
        };
        let Some((first, second)) = name.split_once(',') else {
            let message = format!("`{name}` is not a pair of state variables");
            return Err(from.complaint(Form::NAME, message, remedy));
        };
        let (row, column) = (index(first)?, index(second)?);
        let kind = match (model.state[row].kind, model.state[column].kind) {
            (Type::Vector(rows), Type::Vector(columns)) => Type::Matrix(rows, columns),
            (Type::Scalar, other) | (other, Type::Scalar) if !matches!(other, Type::Matrix(..)) => {
                other
            }
            _ => {
                let message = "a form cannot be given by matrices of variables".to_string();
                return Err(from.complaint(Form::NAME, message, "take the columns as variables"));
            }
        };
        if entries.value_type() != kind {
            return Err(from.unlike(Form::NAME, kind, entries.value_type()));
        }
        Ok(Self { row, column, entries })
    }
}

/// Returns the index of the first component of a state variable.
fn start(model: &Model, variable: usize) -> usize {
    model.state[..variable].iter().map(|before| before.len()).sum()
}

/// Evaluates Ω, and its symmetric part, which has to vanish.
fn matrix<T: Scalar>(blocks: &[FormBlock], at: &Phase<'_, T>) -> (Square<T>, Vec<T>) {
    let model = at.model();
    let mut whole = vec![vec![T::zero(); model.dimension()]; model.dimension()];
    let mut symmetric = Vec::new();
    for block in blocks {
        let (first_row, first_column) = (start(model, block.row), start(model, block.column));
        let columns = model.state[block.column].len();
        let entries = at.evaluate(&block.entries).components();
        for (place, entry) in entries.iter().enumerate() {
            let (i, j) = (place / columns, place % columns);
            whole[first_row + i][first_column + j] = *entry;
            if block.row == block.column {
                symmetric.push(*entry + entries[j * columns + i]);
            } else {
                whole[first_column + j][first_row + i] = -*entry;
            }
        }
    }
    (whole, symmetric)
}

/// Computes AᵀB, entry by entry.
fn product<T: Scalar>(a: &[Vec<T>], b: &[Vec<T>]) -> Square<T> {
    let n = a.len();
    let entry = |i: usize, j: usize| -> T { (0..n).map(|k| a[k][i] * b[k][j]).sum() };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

fn transposed<T: Scalar>(a: &[Vec<T>]) -> Square<T> {
    (0..a.len()).map(|i| a.iter().map(|row| row[i]).collect()).collect()
}

impl Form {
    /// Returns c; by default the form is invariant: c = 0 for a field, 1 for a map.
    fn factor<T: Scalar>(&self, phase: &Phase<'_, T>) -> T {
        match &self.factor {
            Some(factor) => phase.scalar(factor),
            None if phase.model().system.is_map() => T::one(),
            None => T::zero(),
        }
    }

    fn coefficients(&self, jet: &DualPoint<'_, Expr>) -> Vec<Expr> {
        match &self.form {
            FormShape::One(form) => form.at(&jet.phase),
            FormShape::Two(blocks) => matrix(blocks, &jet.phase).0.concat(),
        }
    }

    /// Computes L_vα - cα, or Φ*α - cα.
    fn of_one<T: Scalar>(&self, form: &Components, jet: &DualPoint<'_, T>) -> Vec<T> {
        let factor = self.factor(&jet.phase);
        let here = form.at(&jet.phase);
        let columns = jet.derivative();
        let carried =
            |form: &[T]| columns.iter().map(|column| dot(form, column)).collect::<Vec<T>>();
        let moved: Vec<T> = match jet.phase.model().system.is_map() {
            true => carried(&form.at(&jet.image())),
            false => {
                let rates = form.at(jet.along_field()).into_iter().map(|x| x.eps);
                rates.zip(carried(&here)).map(|(rate, carried)| rate + carried).collect()
            }
        };
        moved.into_iter().zip(here).map(|(moved, here)| moved - factor * here).collect()
    }

    /// Computes L_vΩ - cΩ, or Φ*Ω - cΩ, and the symmetric part of Ω.
    fn of_two<T: Scalar>(
        &self,
        blocks: &[FormBlock],
        jet: &DualPoint<'_, T>,
    ) -> (Square<T>, Vec<T>) {
        let factor = self.factor(&jet.phase);
        let (here, symmetric) = matrix(blocks, &jet.phase);
        // rows k, columns i: ∂_iv_k
        let derivative = transposed(&jet.derivative());
        let moved = match jet.phase.model().system.is_map() {
            true => {
                let (there, _) = matrix(blocks, &jet.image());
                product(&derivative, &product(&transposed(&there), &derivative))
            }
            false => {
                let (moved, _) = matrix(blocks, jet.along_field());
                let first = product(&derivative, &here);
                let second = product(&transposed(&here), &derivative);
                let sum = |i: usize, j: usize| moved[i][j].eps + first[i][j] + second[i][j];
                let places = 0..here.len();
                places.clone().map(|i| places.clone().map(|j| sum(i, j)).collect()).collect()
            }
        };
        let less = |moved: Vec<T>, here: &Vec<T>| {
            moved.into_iter().zip(here).map(|(moved, here)| moved - factor * *here).collect()
        };
        (moved.into_iter().zip(&here).map(|(moved, here)| less(moved, here)).collect(), symmetric)
    }
}

/// Restricts a form to the level: α_i - Σ dF_i α(n).
fn along_level<T: Scalar>(form: &mut [T], gradients: &[Vec<T>], across: &[Vec<T>]) {
    let parts: Vec<T> = across.iter().map(|n| dot(form, n)).collect();
    for (part, gradient) in parts.iter().zip(gradients) {
        form.iter_mut().zip(gradient).for_each(|(entry, slope)| *entry -= *part * *slope);
    }
}

impl Statement for Form {
    const NAME: &'static str = "form";
    const COMPANIONS: &'static [&'static str] = &["factor"];
    const SHAPES: &'static [(&'static str, ValueShape)] = &[(Self::NAME, ValueShape::Table)];
    const OF_MAPS: bool = true;

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let given = from.table(Self::NAME)?;
        let factor = from.formula("factor", Some(Type::Scalar))?;
        let pairs = given.iter().filter(|(name, _)| name.contains(',')).count();
        if given.is_empty() || (pairs > 0 && pairs < given.len()) {
            let message = match pairs {
                0 => "the form has no coefficient",
                _ => "a form has coefficients of variables, or of pairs of them, and not of both",
            };
            let remedy = "write { x = \"…\" } for … dx, { \"x,y\" = \"…\" } for … dx∧dy";
            return Err(from.complaint(Self::NAME, message.to_string(), remedy));
        }
        let text = |(name, formula): &(String, Formula)| {
            let differential = match name.split_once(',') {
                Some((a, b)) => format!("d{}∧d{}", a.trim(), b.trim()),
                None => format!("d{name}"),
            };
            format!("({}) {differential}", formula.text().trim())
        };
        let text = given.iter().map(text).collect::<Vec<_>>().join(" + ");
        if pairs == 0 {
            let components = Components::read(from, Self::NAME, &from.model().vocabulary)?;
            let form = FormShape::One(components.ok_or_else(|| from.missing(Self::NAME))?);
            return Ok(Self { form, factor, text });
        }
        let mut blocks: Vec<FormBlock> = Vec::new();
        for (name, entries) in given {
            let block = FormBlock::read(from, &name, entries)?;
            let is_same = |other: &FormBlock| {
                let (a, b) = ((block.row, block.column), (other.row, other.column));
                a == b || a == (b.1, b.0)
            };
            if blocks.iter().any(is_same) {
                let message = format!("the coefficients of {name} are given already");
                let remedy = "give each pair once: the opposite follows from skewness";
                return Err(from.complaint(Self::NAME, message, remedy));
            }
            blocks.push(block);
        }
        Ok(Self { form: FormShape::Two(blocks), factor, text })
    }

    fn at_images_of_maps(&self) -> Vec<&Formula> {
        self.formulas()
    }

    fn formulas(&self) -> Vec<&Formula> {
        let own: Vec<&Formula> = match &self.form {
            FormShape::One(components) => components.formulas().collect(),
            FormShape::Two(blocks) => blocks.iter().map(|block| &block.entries).collect(),
        };
        own.into_iter().chain(&self.factor).collect()
    }

    fn text(&self) -> Option<String> {
        Some(self.text.clone())
    }

    fn particulars(&self) -> Option<String> {
        Some(format!("factor {}", self.factor.as_ref()?.text().trim()))
    }

    fn about(&self, entries: Formula) -> Option<Self> {
        let mut other = self.clone();
        match &mut other.form {
            FormShape::Two(blocks) => blocks.first_mut()?.entries = entries,
            FormShape::One(_) => return None,
        }
        Some(other)
    }

    fn objection(&self, model: &Model) -> Option<Objection> {
        let is_open = self.formulas().into_iter().any(|formula| model.has_antiderivative(formula));
        is_open.then(|| Objection::open_constant("a form"))
    }

    fn conditions(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> Vec<Condition> {
        let own = self.coefficients(jet);
        let vacuous = Condition::nonzero(own.clone(), "the form is 0: this says nothing");
        match jet.phase.model().system.is_map() {
            true => vec![vacuous],
            false => vec![vacuous, Condition::continuous(own, "the form")],
        }
    }

    fn residual<T: Scalar>(&self, jet: &DualPoint<'_, T>, kept: &[bool]) -> Vec<T> {
        let gradients = jet.level_gradients(kept);
        let across = transversals(&gradients);
        match &self.form {
            FormShape::One(form) => {
                let mut found = self.of_one(form, jet);
                along_level(&mut found, &gradients, &across);
                found
            }
            FormShape::Two(blocks) => {
                let (mut found, mut residual) = self.of_two(blocks, jet);
                // along the level in the first argument, then in the second
                for _ in 0..2 {
                    found.iter_mut().for_each(|row| along_level(row, &gradients, &across));
                    found = transposed(&found);
                }
                for (i, row) in found.iter().enumerate() {
                    residual.extend(&row[i + 1..]);
                }
                residual
            }
        }
    }

    fn context(&self, jet: &DualPoint<'_, Expr>, _: &[bool]) -> ResidualContext {
        let value = self.coefficients(jet);
        let steep: Expr = jet.derivative().iter().map(|column| dot(column, column)).sum();
        let scale = dot(&value, &value) * (steep + Expr::from(1.0));
        ResidualContext { scale: Some(scale), value, ..ResidualContext::default() }
    }
}
