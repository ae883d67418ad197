//! Vectors, products of vectors, components and calls, made of formulas.

use super::arena::NodeOperation;
use super::bond::Bond;
use super::compose::{Draft, FormulaResult};
use super::error::FormulaError;
use super::kind::Type;
use super::typing::Infix;
use super::{Formula, Scope, functions};

impl Formula {
    /// Dot product `(a,b)`.
    pub fn dot(&self, other: &Formula) -> FormulaResult {
        Self::listed("(", ",", &[self, other], ")", |builder, parts, span| match parts {
            [a, b] => builder.dot(a, b, span),
            _ => Err(FormulaError::new(span, "a dot product takes two vectors")),
        })
    }

    /// Cross product `a × b`.
    pub fn cross(&self, other: &Formula) -> FormulaResult {
        self.joined(Infix::Cross, other)
    }

    /// Outer product `a ⊗ b`.
    pub fn outer(&self, other: &Formula) -> FormulaResult {
        self.joined(Infix::Outer, other)
    }

    /// Norm of a vector, or absolute value of a scalar.
    pub fn modulus(&self) -> FormulaResult {
        Self::listed("|", "", &[self], "|", |builder, parts, span| match parts {
            [a] => builder.modulus(a, span),
            _ => Err(FormulaError::new(span, "bars enclose one value")),
        })
    }

    /// Square root.
    pub fn sqrt(&self) -> FormulaResult {
        let mut draft = Draft::default();
        draft.write("√");
        let a = draft.place(self, self.bond() < Bond::Prefix);
        draft.build(|builder| {
            let span = 0..a.span.end;
            builder.root(&a, span)
        })
    }

    /// Component of a vector, or entry of a matrix, counted from 1: `γ[3]`, `I[1,2]`.
    pub fn component(&self, indices: &[usize]) -> FormulaResult {
        let mut draft = Draft::default();
        let a = draft.place(self, self.bond() < Bond::Whole);
        let open = draft.text.len();
        draft.write("[");
        let mut places = Vec::new();
        for (k, index) in indices.iter().enumerate() {
            draft.write(if k == 0 { "" } else { "," });
            let start = draft.text.len();
            draft.write(&index.to_string());
            places.push((i64::try_from(*index).unwrap_or(i64::MAX), start..draft.text.len()));
        }
        draft.write("]");
        let brackets = open..draft.text.len();
        draft.build(|builder| builder.index(&a, &places, brackets))
    }

    /// Component of a vector by its name, counted from 1: `γ3`, where this is what the scope reads in it; as
    /// [`component`] otherwise.
    ///
    /// [`component`]: Formula::component
    pub fn element(&self, index: usize, scope: &dyn Scope) -> FormulaResult {
        let by_index = self.component(&[index])?;
        let name = self.value_type().component(self.text().trim(), index - 1);
        // A name of the scope may be the same, as x2 next to a vector x.
        let operations = |own: &Formula| -> Vec<NodeOperation> {
            own.arena.nodes.iter().map(|node| node.operation.clone()).collect()
        };
        let is_same = |own: &Formula| {
            own.arena.symbols == by_index.arena.symbols && operations(own) == operations(&by_index)
        };
        Ok(Self::parse(&name, scope).ok().filter(is_same).unwrap_or(by_index))
    }

    /// Vector `[a, b, …]` of scalars.
    pub fn vector(parts: &[&Formula]) -> FormulaResult {
        Self::listed("[", ", ", parts, "]", |builder, parts, span| builder.vector(parts, span))
    }

    /// Matrix `[[a, b], [c, d]]` of the rows.
    pub fn rows(rows: &[Vec<&Formula>]) -> FormulaResult {
        let rows: Vec<Formula> =
            rows.iter().map(|row| Self::vector(row)).collect::<Result<_, _>>()?;
        let rows: Vec<&Formula> = rows.iter().collect();
        Self::listed("[", ", ", &rows, "]", |builder, rows, span| builder.rows(rows, span))
    }

    /// Call of a function of the language, such as `det`, `hat` or `exp`.
    pub fn call(function: &str, arguments: &[&Formula]) -> FormulaResult {
        if !functions::is_function(function) {
            let message = format!("`{function}` is not a function");
            return Err(FormulaError::new(0..function.len(), message));
        }
        let open = format!("{function}(");
        Self::listed(&open, ", ", arguments, ")", |builder, parts, span| {
            functions::call(builder, function, parts, span)
        })
    }
}

impl Type {
    /// Formula of this type with the given components, row by row.
    ///
    /// # Errors
    /// There are too few or too many components.
    pub fn filled(self, components: &[Formula]) -> FormulaResult {
        let parts: Vec<&Formula> = components.iter().collect();
        match (self, parts.as_slice()) {
            (_, all) if all.len() != self.size() => {
                let message = format!("{} components do not fill a {self}", all.len());
                Err(FormulaError::new(0..0, message))
            }
            (Type::Scalar, all) => Ok(all[0].clone()),
            (Type::Vector(_), all) => Formula::vector(all),
            (Type::Matrix(_, columns), all) => {
                let rows: Vec<Vec<&Formula>> =
                    all.chunks(columns.max(1)).map(<[&Formula]>::to_vec).collect();
                Formula::rows(&rows)
            }
        }
    }
}
