//! Named functions: their spellings, their arguments, and the nodes they become.

use super::arena::{ElementaryFunction, Extreme, NodeOperation};
use super::error::{FormulaError, Span};
use super::kind::Type;
use super::typing::{Builder, Built, Infix, Operand};
use crate::number::rational::Rational;

/// Limit on the rows of a matrix whose determinant, adjugate or inverse is taken.
const MOST_ROWS: usize = 16;

/// Builder of the nodes of a function whose arguments have the right number and types.
type Build = fn(&mut Builder<'_>, &[Operand], Span) -> Built;

/// Type required of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum RequiredType {
    Scalar,
    Vector,
    /// Vector of ℝ³.
    Spatial,
    Matrix,
    Square,
}

use RequiredType::{Matrix, Scalar, Spatial, Square, Vector};

impl RequiredType {
    fn takes(self, found: Type) -> bool {
        match (self, found) {
            (Scalar, Type::Scalar) | (Vector, Type::Vector(_)) | (Matrix, Type::Matrix(..)) => true,
            (Spatial, found) => found == Type::VECTOR,
            (Square, Type::Matrix(rows, columns)) => rows == columns,
            _ => false,
        }
    }

    fn name(self, found: Type) -> &'static str {
        match (self, found) {
            (Scalar, _) => "scalar",
            (Spatial, Type::Vector(_)) => "vector of length 3",
            (Square, Type::Matrix(..)) => "square matrix",
            (Vector | Spatial, _) => "vector",
            (Matrix | Square, _) => "matrix",
        }
    }
}

/// Arguments of a function.
#[derive(Clone, Copy, Debug)]
enum ArgumentTypes {
    /// One argument for each entry.
    These(&'static [RequiredType]),
    /// At least this number of arguments of one kind.
    Several(usize, RequiredType),
}

use ArgumentTypes::{Several, These};

impl ArgumentTypes {
    fn fit(self, arguments: &[Operand]) -> bool {
        self.takes_count(arguments.len())
            && arguments.iter().enumerate().all(|(k, a)| self.at(k).takes(a.value_type))
    }

    fn takes_count(self, count: usize) -> bool {
        match self {
            These(wanted) => wanted.len() == count,
            Several(least, _) => count >= least,
        }
    }

    fn at(self, place: usize) -> RequiredType {
        match self {
            These(wanted) => wanted[place],
            Several(_, wanted) => wanted,
        }
    }

    fn count(self) -> String {
        match self {
            These(wanted) => wanted.len().to_string(),
            Several(least, _) => format!("{least} or more"),
        }
    }
}

/// Overload of a function.
struct Overload {
    names: &'static [&'static str],
    arguments: ArgumentTypes,
    build: Build,
}

const fn overload(
    names: &'static [&'static str],
    arguments: ArgumentTypes,
    build: Build,
) -> Overload {
    Overload { names, arguments, build }
}

const FUNCTIONS: &[Overload] = &[
    overload(&["dot"], These(&[Vector, Vector]), |f, a, s| f.dot(&a[0], &a[1], s)),
    overload(&["cross"], These(&[Spatial, Spatial]), |f, a, s| {
        f.vector_product(Infix::Cross, &a[0], &a[1], s)
    }),
    overload(&["outer"], These(&[Vector, Vector]), |f, a, s| {
        f.vector_product(Infix::Outer, &a[0], &a[1], s)
    }),
    overload(&["norm"], These(&[Vector]), |f, a, s| f.modulus(&a[0], s)),
    overload(&["transpose"], These(&[Matrix]), |f, a, s| f.transpose(&a[0], s)),
    overload(&["inverse", "inv"], These(&[Square]), |f, a, s| f.inverse(&a[0], s)),
    overload(&["adj"], These(&[Square]), |f, a, s| {
        f.small(&a[0])?;
        Ok(f.push(NodeOperation::Adjugate(a[0].node), a[0].value_type, s))
    }),
    overload(&["det"], These(&[Square]), |f, a, s| {
        f.small(&a[0])?;
        Ok(f.push(NodeOperation::Determinant(a[0].node), Type::Scalar, s))
    }),
    overload(&["trace", "tr", "Tr"], These(&[Square]), |f, a, s| {
        Ok(f.push(NodeOperation::Trace(a[0].node), Type::Scalar, s))
    }),
    overload(&["solve"], These(&[Square, Vector]), solve),
    overload(&["solve"], These(&[Square, Matrix]), solve_columns),
    overload(&["diag"], These(&[Vector]), |f, a, s| f.diagonal(&a[0], s)),
    overload(&["diag"], Several(2, Scalar), |f, a, s| {
        let entries = f.vector(a, s.clone())?;
        f.diagonal(&entries, s)
    }),
    overload(&["hat"], These(&[Spatial]), hat),
    overload(&["vec"], Several(1, Scalar), |f, a, s| f.vector(a, s)),
    overload(&["mat"], Several(1, Vector), |f, a, s| f.rows(a, s)),
    overload(&["mat"], Several(1, Scalar), square_of_entries),
    overload(&["sqrt"], These(&[Scalar]), |f, a, s| f.root(&a[0], s)),
    overload(&["exp"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Exp, a, s)),
    overload(&["log", "ln"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Ln, a, s)),
    overload(&["sin"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Sin, a, s)),
    overload(&["cos"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Cos, a, s)),
    overload(&["tan"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Tan, a, s)),
    overload(&["asin", "arcsin"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Asin, a, s)
    }),
    overload(&["acos", "arccos"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Acos, a, s)
    }),
    overload(&["atan", "arctan"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Atan, a, s)
    }),
    overload(&["sinh"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Sinh, a, s)),
    overload(&["cosh"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Cosh, a, s)),
    overload(&["tanh"], These(&[Scalar]), |f, a, s| scalar(f, ElementaryFunction::Tanh, a, s)),
    overload(&["asinh", "arsinh"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Asinh, a, s)
    }),
    overload(&["acosh", "arcosh"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Acosh, a, s)
    }),
    overload(&["atanh", "artanh"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Atanh, a, s)
    }),
    overload(&["abs"], These(&[Scalar]), |f, a, s| f.modulus(&a[0], s)),
    overload(&["sign", "sgn"], These(&[Scalar]), |f, a, s| {
        scalar(f, ElementaryFunction::Sign, a, s)
    }),
    overload(&["atan2"], These(&[Scalar, Scalar]), |f, a, s| {
        Ok(f.push(NodeOperation::Angle(a[0].node, a[1].node), Type::Scalar, s))
    }),
    overload(&["min"], Several(1, Scalar), |f, a, s| extreme(f, Extreme::Least, a, s)),
    overload(&["max"], Several(1, Scalar), |f, a, s| extreme(f, Extreme::Greatest, a, s)),
    overload(&["∫", "integral"], These(&[Scalar, Scalar]), |f, a, s| {
        Ok(f.push(NodeOperation::Antiderivative(a[0].node, a[1].node), Type::Scalar, s))
    }),
];

fn scalar(f: &mut Builder<'_>, function: ElementaryFunction, a: &[Operand], span: Span) -> Built {
    Ok(f.push(NodeOperation::Function(function, a[0].node), Type::Scalar, span))
}

/// Builds the least or the greatest of some scalars.
pub(super) fn extreme(f: &mut Builder<'_>, which: Extreme, a: &[Operand], span: Span) -> Built {
    let nodes: Vec<usize> = a.iter().map(|a| a.node).collect();
    let operation = NodeOperation::Extreme(which, nodes.clone().into());
    Ok(f.push_folded(operation, &nodes, span, |numbers: &[&Rational]| {
        let best = match which {
            Extreme::Least => numbers.iter().min(),
            Extreme::Greatest => numbers.iter().max(),
        };
        best.map(|number| (*number).clone())
    }))
}

fn solve(f: &mut Builder<'_>, a: &[Operand], span: Span) -> Built {
    let rows = f.small(&a[0])?;
    if a[1].value_type != Type::Vector(rows) {
        return Err(unsolvable(a));
    }
    Ok(f.push(NodeOperation::Solve(a[0].node, a[1].node), a[1].value_type, span))
}

/// Builds `A⁻¹B`.
fn solve_columns(f: &mut Builder<'_>, a: &[Operand], span: Span) -> Built {
    let rows = f.small(&a[0])?;
    match a[1].value_type {
        Type::Matrix(other, columns) if other == rows => {
            let inverse = f.inverse(&a[0], span.clone())?;
            let operation = NodeOperation::Compose(inverse.node, a[1].node);
            f.push_sized(operation, Type::Matrix(rows, columns), span)
        }
        _ => Err(unsolvable(a)),
    }
}

fn unsolvable(a: &[Operand]) -> FormulaError {
    let (left, right) = (a[0].value_type.in_full(), a[1].value_type.in_full());
    let message = format!("a {left} cannot be solved for a {right}");
    FormulaError::new(a[1].span.clone(), message)
}

/// Builds a square matrix `mat(a,b,c,d)` from its entries.
fn square_of_entries(f: &mut Builder<'_>, a: &[Operand], span: Span) -> Built {
    let rows = a.len().isqrt();
    if rows * rows != a.len() {
        let message = format!("{} entries do not fill a square matrix", a.len());
        let help = "give 4, 9, 16, … entries, or the rows: `mat([a,b,c],[d,e,f])`";
        return Err(FormulaError::new(span, message).with_help(help));
    }
    let lines = a.chunks(rows).map(|row| f.vector(row, span.clone()));
    let lines = lines.collect::<Result<Vec<Operand>, _>>()?;
    f.rows(&lines, span)
}

/// Builds `[a]×`, the matrix with `[a]× b = a × b`.
fn hat(f: &mut Builder<'_>, a: &[Operand], span: Span) -> Built {
    let zero = f.push(NodeOperation::Number(Rational::from(0)), Type::Scalar, span.clone());
    let [x, y, z] = [0, 1, 2]
        .map(|k| f.push(NodeOperation::Component(a[0].node, k), Type::Scalar, span.clone()));
    let [minus_x, minus_y, minus_z] = [&x, &y, &z].map(|k| f.negate(k, span.clone()));
    let rows = [[&zero, &minus_z, &y], [&z, &zero, &minus_x], [&minus_y, &x, &zero]]
        .map(|row| f.vector(&row.map(Operand::clone), span.clone()));
    let rows = rows.into_iter().collect::<Result<Vec<Operand>, _>>()?;
    f.rows(&rows, span)
}

impl Builder<'_> {
    /// Builds `a⁻¹`.
    pub fn inverse(&mut self, a: &Operand, span: Span) -> Built {
        self.small(a)?;
        Ok(self.push(NodeOperation::Inverse(a.node), a.value_type, span))
    }

    fn diagonal(&mut self, a: &Operand, span: Span) -> Built {
        let rows = a.value_type.size();
        self.push_sized(NodeOperation::Diagonal(a.node), Type::Matrix(rows, rows), span)
    }

    /// Number of rows of a matrix, or an error if it is too large for a determinant.
    fn small(&self, a: &Operand) -> Result<usize, FormulaError> {
        let Type::Matrix(rows, _) = a.value_type else { return Ok(1) };
        if rows <= MOST_ROWS {
            return Ok(rows);
        }
        let message = format!("a {} is too large for a determinant", a.value_type.in_full());
        let help = format!("determinants and inverses take at most {MOST_ROWS} rows");
        Err(FormulaError::new(a.span.clone(), message).with_help(help))
    }
}

/// Lists all spellings of all functions.
pub fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().flat_map(|function| function.names.iter().copied())
}

/// Whether this is the name of a function.
pub(super) fn is_function(name: &str) -> bool {
    names().any(|known| known == name)
}

/// Syntax of a call of a function, for help: `solve(matrix, vector)`.
pub(super) fn usage(name: &str) -> String {
    let call = |function: &Overload| match (name, function.arguments) {
        ("atan2", _) => "`atan2(y, x)`".to_string(),
        ("∫" | "integral", _) => format!("`{name}(integrand, variable)`"),
        ("mat", Several(_, Scalar)) => "`mat(…)` of 4, 9, 16, … scalars".to_string(),
        (_, Several(1, wanted)) => format!("`{name}({}, …)`", wanted.name(Type::Scalar)),
        (_, Several(_, wanted)) => {
            let kind = wanted.name(Type::Scalar);
            format!("`{name}({kind}, {kind}, …)`")
        }
        (_, These(wanted)) => {
            let kinds: Vec<&str> = wanted.iter().map(|one| one.name(Type::Scalar)).collect();
            format!("`{name}({})`", kinds.join(", "))
        }
    };
    let calls: Vec<String> = overloads(name).map(call).collect();
    format!("write {}", calls.join(" or "))
}

/// Whether the function of this name takes one argument.
pub(super) fn takes_one(name: &str) -> bool {
    overloads(name).all(|own| matches!(own.arguments, These([_])))
}

fn overloads(name: &str) -> impl Iterator<Item = &'static Overload> {
    FUNCTIONS.iter().filter(move |function| function.names.contains(&name))
}

/// Builds `name(arguments)`; `span` covers the whole call.
pub(super) fn call(
    builder: &mut Builder<'_>,
    name: &str,
    arguments: &[Operand],
    span: Span,
) -> Built {
    if let Some(function) = overloads(name).find(|function| function.arguments.fit(arguments)) {
        return (function.build)(builder, arguments, span);
    }
    let count = arguments.len();
    let error = match overloads(name).find(|f| f.arguments.takes_count(count)) {
        Some(function) => {
            let wanted = |place: usize| function.arguments.at(place);
            let place =
                (0..count).find(|place| !wanted(*place).takes(arguments[*place].value_type));
            let place = place.unwrap_or_default();
            let found = arguments[place].value_type;
            let (wanted, found) = (
                wanted(place).name(found),
                match wanted(place) {
                    Spatial | Square
                        if wanted(place).name(found) != wanted(place).name(Type::Scalar) =>
                    {
                        found.in_full()
                    }
                    _ => found.to_string(),
                },
            );
            let message = format!("`{name}` takes a {wanted} here, this is a {found}");
            let error = FormulaError::new(arguments[place].span.clone(), message);
            if (name, arguments[place].value_type) == ("norm", Type::Scalar) {
                let own = builder.written(&arguments[place]);
                return Err(error.with_help(format!("write `|{own}|`")));
            }
            error
        }
        None => {
            let mut counts: Vec<String> = overloads(name).map(|f| f.arguments.count()).collect();
            counts.dedup();
            let counts = counts.join(" or ");
            let plural = if counts == "1" { "" } else { "s" };
            FormulaError::new(
                span,
                format!("`{name}` takes {counts} argument{plural}, not {count}"),
            )
        }
    };
    Err(error.with_help(usage(name)))
}

#[cfg(test)]
mod tests;
