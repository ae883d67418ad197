//! Operations on one operand, and the bracketed pair `(a,b)`.

use super::arena::{ElementaryFunction, NodeOperation};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::typing::{Builder, Built, Operand};

impl Builder<'_> {
    /// Builds `(a,b)`.
    pub fn dot(&mut self, a: &Operand, b: &Operand, span: Span) -> Built {
        for factor in [a, b] {
            if !matches!(factor.value_type, Type::Vector(_)) {
                let message =
                    format!("a dot product takes two vectors, this is a {}", factor.value_type);
                let error = FormulaError::new(factor.span.clone(), message);
                let has_scalar = [a, b].iter().any(|own| own.value_type == Type::Scalar);
                return Err(match has_scalar {
                    true => {
                        error.with_help(format!("write `{}*{}`", self.written(a), self.written(b)))
                    }
                    false => error,
                });
            }
        }
        if a.value_type != b.value_type {
            let message = format!(
                "a dot product takes two vectors of one length, not a {} and a {}",
                a.value_type.in_full(),
                b.value_type.in_full()
            );
            return Err(FormulaError::new(span, message).with_sizes());
        }
        Ok(self.push(NodeOperation::Dot(a.node, b.node), Type::Scalar, span))
    }

    /// Builds `-a`.
    pub fn negate(&mut self, a: &Operand, span: Span) -> Operand {
        let operation = NodeOperation::Negate(a.node);
        let node = if a.value_type == Type::Scalar {
            self.arena.push_folded(operation, &[a.node], span.clone(), |n| Some(-n[0]))
        } else {
            self.arena.push(operation, a.value_type, span.clone())
        };
        self.operand(node, span)
    }

    /// Builds `√a`.
    pub fn root(&mut self, a: &Operand, span: Span) -> Built {
        if a.value_type == Type::Scalar {
            return Ok(self.push(
                NodeOperation::Function(ElementaryFunction::Sqrt, a.node),
                Type::Scalar,
                span,
            ));
        }
        let message = format!("a {} has no square root", a.value_type);
        Err(FormulaError::new(a.span.clone(), message))
    }

    /// Builds `|a|`.
    pub fn modulus(&mut self, a: &Operand, span: Span) -> Built {
        Ok(match a.value_type {
            Type::Scalar => {
                let operation = NodeOperation::Function(ElementaryFunction::Modulus, a.node);
                self.push_folded(operation, &[a.node], span, |n| Some(n[0].abs()))
            }
            Type::Vector(_) => {
                let square =
                    self.push(NodeOperation::Dot(a.node, a.node), Type::Scalar, span.clone());
                self.root(&square, span)?
            }
            Type::Matrix(..) => {
                let error = FormulaError::new(span, "bars cannot enclose a matrix");
                return Err(error.with_help(format!("write `det({})`", self.written(a))));
            }
        })
    }

    /// Builds `aᵀ`.
    pub fn transpose(&mut self, a: &Operand, span: Span) -> Built {
        if let Type::Matrix(rows, columns) = a.value_type {
            let kind = Type::Matrix(columns, rows);
            return Ok(self.push(NodeOperation::Transpose(a.node), kind, span));
        }
        let message = format!("only a matrix is transposed, this is a {}", a.value_type);
        let error = FormulaError::new(a.span.clone(), message);
        Err(match a.value_type {
            Type::Vector(_) => error.with_help("write `(a,b)` for aᵀb and `a ⊗ b` for abᵀ"),
            _ => error,
        })
    }

    /// Builds `a[i]` or `a[i,j]`, counted from 1.
    pub fn index(&mut self, a: &Operand, indices: &[(i64, Span)], brackets: Span) -> Built {
        let span = a.span.start..brackets.end;
        let within = |(index, place): &(i64, Span), count: usize, what: &str| {
            let found = usize::try_from(*index).ok().filter(|index| (1..=count).contains(index));
            found.map(|index| index - 1).ok_or_else(|| {
                let message = format!("there is no {what} {index}");
                let help = format!("`{}` has the {what}s 1 to {count}", self.written(a));
                FormulaError::new(place.clone(), message).with_help(help).with_index_out_of_range()
            })
        };
        match (a.value_type, indices) {
            (Type::Vector(length), [i]) => {
                let i = within(i, length, "component")?;
                Ok(self.push(NodeOperation::Component(a.node, i), Type::Scalar, span))
            }
            (Type::Matrix(rows, columns), [i]) => {
                let i = within(i, rows, "row")?;
                Ok(self.push(NodeOperation::Row(a.node, i), Type::Vector(columns), span))
            }
            (Type::Matrix(rows, columns), [i, j]) => {
                let (i, j) = (within(i, rows, "row")?, within(j, columns, "column")?);
                Ok(self.push(NodeOperation::Entry(a.node, i, j), Type::Scalar, span))
            }
            (Type::Vector(_), _) => {
                let error = FormulaError::new(brackets, "a vector has one index");
                Err(error.with_help(format!("write `{}[1]`", self.written(a))))
            }
            (Type::Matrix(..), _) => {
                let error = FormulaError::new(brackets, "a matrix has two indices");
                Err(error.with_help(format!("write `{}[1,2]`", self.written(a))))
            }
            (Type::Scalar, _) => {
                let error = FormulaError::new(brackets, "a scalar has no components");
                Err(error.with_help(format!("write `{}`", self.written(a))))
            }
        }
    }

    /// Builds the vector `[a,b,…]` of some scalars.
    pub fn vector(&mut self, parts: &[Operand], span: Span) -> Built {
        if let Some(wrong) = parts.iter().find(|part| part.value_type != Type::Scalar) {
            let message = format!("a component is a scalar, this is a {}", wrong.value_type);
            let help = "a matrix with the rows u, v, w is written `mat(u,v,w)`";
            return Err(FormulaError::new(wrong.span.clone(), message).with_help(help));
        }
        let nodes = parts.iter().map(|part| part.node).collect();
        self.push_sized(NodeOperation::Vector(nodes), Type::Vector(parts.len()), span)
    }

    /// Builds the matrix with these vectors as rows.
    pub fn rows(&mut self, rows: &[Operand], span: Span) -> Built {
        let first = rows.first().map_or(Type::Scalar, |row| row.value_type);
        if let Some(wrong) = rows.iter().find(|row| !matches!(row.value_type, Type::Vector(_))) {
            let message =
                format!("a row of a matrix is written `[a,b,c]`, this is a {}", wrong.value_type);
            let help = "a matrix with the rows u, v, w is written `mat(u,v,w)`";
            return Err(FormulaError::new(wrong.span.clone(), message).with_help(help));
        }
        if let Some(wrong) = rows.iter().find(|row| row.value_type != first) {
            let (first, own) = (first.size(), wrong.value_type.size());
            let message = format!("this row has {own} entries, and the first has {first}");
            return Err(FormulaError::new(wrong.span.clone(), message));
        }
        let nodes = rows.iter().map(|row| row.node).collect();
        self.push_sized(NodeOperation::Rows(nodes), Type::Matrix(rows.len(), first.size()), span)
    }
}
