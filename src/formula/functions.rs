//! The named functions: their spellings, what they take, and the nodes they become.

use super::arena::{Arena, Extreme, Function, NodeId, Operation};
use super::error::{FormulaError, Span};
use super::typing::Operand;
use super::value::Type::{self, Matrix, Scalar, Vector};
use crate::number::rational::Rational;

/// Builds the nodes of a function whose arguments have the right number and types.
type Build = fn(&mut Arena, &[NodeId], Span) -> NodeId;

/// One way to call a function.
struct Overload {
    names: &'static [&'static str],
    arguments: &'static [Type],
    build: Build,
}

const fn overload(
    names: &'static [&'static str],
    arguments: &'static [Type],
    build: Build,
) -> Overload {
    Overload { names, arguments, build }
}

const FUNCTIONS: &[Overload] = &[
    overload(&["dot"], &[Vector, Vector], |f, a, s| f.push(Operation::Dot(a[0], a[1]), Scalar, s)),
    overload(&["cross"], &[Vector, Vector], |f, a, s| {
        f.push(Operation::Cross(a[0], a[1]), Vector, s)
    }),
    overload(&["outer"], &[Vector, Vector], |f, a, s| {
        f.push(Operation::Outer(a[0], a[1]), Matrix, s)
    }),
    overload(&["norm"], &[Vector], |f, a, s| {
        let square = f.push(Operation::Dot(a[0], a[0]), Scalar, s.clone());
        f.push(Operation::Function(Function::Sqrt, square), Scalar, s)
    }),
    overload(&["transpose"], &[Matrix], |f, a, s| f.push(Operation::Transpose(a[0]), Matrix, s)),
    overload(&["inverse", "inv"], &[Matrix], |f, a, s| f.push(Operation::Inverse(a[0]), Matrix, s)),
    overload(&["adj"], &[Matrix], |f, a, s| f.push(Operation::Adjugate(a[0]), Matrix, s)),
    overload(&["det"], &[Matrix], |f, a, s| f.push(Operation::Determinant(a[0]), Scalar, s)),
    overload(&["trace", "tr", "Tr"], &[Matrix], |f, a, s| {
        f.push(Operation::Trace(a[0]), Scalar, s)
    }),
    overload(&["solve"], &[Matrix, Vector], |f, a, s| {
        f.push(Operation::Solve(a[0], a[1]), Vector, s)
    }),
    overload(&["diag"], &[Vector], |f, a, s| f.push(Operation::Diagonal(a[0]), Matrix, s)),
    overload(&["diag"], &[Scalar; 3], |f, a, s| {
        let entries = vector(f, a, s.clone());
        f.push(Operation::Diagonal(entries), Matrix, s)
    }),
    overload(&["hat"], &[Vector], hat),
    overload(&["vec"], &[Scalar; 3], vector),
    overload(&["mat"], &[Vector; 3], |f, a, s| {
        f.push(Operation::Rows([a[0], a[1], a[2]]), Matrix, s)
    }),
    overload(&["mat"], &[Scalar; 9], |f, a, s| {
        let rows = [0, 3, 6].map(|start| vector(f, &a[start..], s.clone()));
        f.push(Operation::Rows(rows), Matrix, s)
    }),
    overload(&["sqrt"], &[Scalar], |f, a, s| scalar(f, Function::Sqrt, a, s)),
    overload(&["exp"], &[Scalar], |f, a, s| scalar(f, Function::Exp, a, s)),
    overload(&["log", "ln"], &[Scalar], |f, a, s| scalar(f, Function::Ln, a, s)),
    overload(&["sin"], &[Scalar], |f, a, s| scalar(f, Function::Sin, a, s)),
    overload(&["cos"], &[Scalar], |f, a, s| scalar(f, Function::Cos, a, s)),
    overload(&["tan"], &[Scalar], |f, a, s| scalar(f, Function::Tan, a, s)),
    overload(&["asin", "arcsin"], &[Scalar], |f, a, s| scalar(f, Function::Asin, a, s)),
    overload(&["acos", "arccos"], &[Scalar], |f, a, s| scalar(f, Function::Acos, a, s)),
    overload(&["atan", "arctan"], &[Scalar], |f, a, s| scalar(f, Function::Atan, a, s)),
    overload(&["sinh"], &[Scalar], |f, a, s| scalar(f, Function::Sinh, a, s)),
    overload(&["cosh"], &[Scalar], |f, a, s| scalar(f, Function::Cosh, a, s)),
    overload(&["tanh"], &[Scalar], |f, a, s| scalar(f, Function::Tanh, a, s)),
    overload(&["asinh", "arsinh"], &[Scalar], |f, a, s| scalar(f, Function::Asinh, a, s)),
    overload(&["acosh", "arcosh"], &[Scalar], |f, a, s| scalar(f, Function::Acosh, a, s)),
    overload(&["atanh", "artanh"], &[Scalar], |f, a, s| scalar(f, Function::Atanh, a, s)),
    overload(&["abs"], &[Scalar], |f, a, s| scalar(f, Function::Modulus, a, s)),
    overload(&["sign", "sgn"], &[Scalar], |f, a, s| scalar(f, Function::Sign, a, s)),
    overload(&["atan2"], &[Scalar, Scalar], |f, a, s| {
        f.push(Operation::Angle(a[0], a[1]), Scalar, s)
    }),
    overload(&["min"], &[Scalar, Scalar], |f, a, s| extreme(f, Extreme::Least, a, s)),
    overload(&["max"], &[Scalar, Scalar], |f, a, s| extreme(f, Extreme::Greatest, a, s)),
    overload(&["∫", "integral"], &[Scalar, Scalar], |f, a, s| {
        f.push(Operation::Antiderivative(a[0], a[1]), Scalar, s)
    }),
];

fn scalar(arena: &mut Arena, function: Function, a: &[NodeId], span: Span) -> NodeId {
    arena.push(Operation::Function(function, a[0]), Scalar, span)
}

fn extreme(arena: &mut Arena, which: Extreme, a: &[NodeId], span: Span) -> NodeId {
    arena.push(Operation::Extreme(which, a.into()), Scalar, span)
}

fn vector(arena: &mut Arena, a: &[NodeId], span: Span) -> NodeId {
    arena.push(Operation::Vector([a[0], a[1], a[2]]), Vector, span)
}

/// `[a]×`, the matrix with `[a]× b = a × b`.
fn hat(arena: &mut Arena, a: &[NodeId], span: Span) -> NodeId {
    let zero = arena.push(Operation::Number(Rational::from(0)), Scalar, span.clone());
    let [x, y, z] =
        [0, 1, 2].map(|k| arena.push(Operation::Component(a[0], k), Scalar, span.clone()));
    let [minus_x, minus_y, minus_z] =
        [x, y, z].map(|k| arena.push(Operation::Negate(k), Scalar, span.clone()));
    let rows = [[zero, minus_z, y], [z, zero, minus_x], [minus_y, x, zero]]
        .map(|row| vector(arena, &row, span.clone()));
    arena.push(Operation::Rows(rows), Matrix, span)
}

/// Every spelling of every function.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FUNCTIONS.iter().flat_map(|function| function.names.iter().copied())
}

/// Is this the name of a function?
pub(super) fn is_function(name: &str) -> bool {
    names().any(|known| known == name)
}

/// How a function is called, for help: `solve(matrix, vector)`.
pub(super) fn usage(name: &str) -> String {
    let calls: Vec<String> = overloads(name)
        .map(|function| match function.arguments {
            [Scalar, .., Scalar] if function.arguments.len() == 9 => {
                format!("`{name}(…)` of 9 scalars")
            }
            [Scalar, Scalar] => match name {
                "atan2" => "`atan2(y, x)`".to_string(),
                "min" | "max" => format!("`{name}(a, b)`"),
                _ => format!("`{name}(integrand, variable)`"),
            },
            arguments => {
                let types: Vec<String> = arguments.iter().map(Type::to_string).collect();
                format!("`{name}({})`", types.join(", "))
            }
        })
        .collect();
    format!("write {}", calls.join(" or "))
}

fn overloads(name: &str) -> impl Iterator<Item = &'static Overload> {
    FUNCTIONS.iter().filter(move |function| function.names.contains(&name))
}

/// The node for `name(arguments)`, the whole call standing at `span`.
pub(super) fn call(
    arena: &mut Arena,
    name: &str,
    arguments: &[Operand],
    span: Span,
) -> Result<NodeId, FormulaError> {
    let fits = |function: &&Overload| {
        function.arguments.iter().copied().eq(arguments.iter().map(|a| a.value_type))
    };
    if let Some(function) = overloads(name).find(fits) {
        let nodes: Vec<NodeId> = arguments.iter().map(|argument| argument.node).collect();
        return Ok((function.build)(arena, &nodes, span));
    }
    let error = match overloads(name).find(|f| f.arguments.len() == arguments.len()) {
        Some(function) => {
            let wrong =
                function.arguments.iter().zip(arguments).find(|(ty, a)| **ty != a.value_type);
            let (span, ty, found) =
                wrong.map_or((span, Scalar, Scalar), |(ty, a)| (a.span.clone(), *ty, a.value_type));
            FormulaError::new(span, format!("`{name}` takes a {ty} here, this is a {found}"))
        }
        None => {
            let counts: Vec<String> =
                overloads(name).map(|f| f.arguments.len().to_string()).collect();
            let (counts, count) = (counts.join(" or "), arguments.len());
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
mod tests {
    use super::*;

    fn operands(types: &[Type]) -> (Arena, Vec<Operand>) {
        let mut arena = Arena::default();
        let operands = types.iter().enumerate().map(|(i, ty)| Operand {
            node: arena.push(Operation::Identity, *ty, i..i + 1),
            value_type: *ty,
            span: i..i + 1,
        });
        let operands = operands.collect();
        (arena, operands)
    }

    #[test]
    fn every_overload_builds_from_its_own_arguments() {
        for function in FUNCTIONS {
            let (mut arena, arguments) = operands(function.arguments);
            for name in function.names {
                let node = call(&mut arena, name, &arguments, 0..9);
                assert_eq!(node, Ok(arena.nodes.len() - 1), "`{name}` is the last node");
            }
        }
    }

    #[test]
    fn wrong_arguments_are_told_apart() {
        let (mut arena, arguments) = operands(&[Matrix, Scalar]);
        let error = call(&mut arena, "solve", &arguments, 0..9).expect_err("a scalar");
        assert_eq!(error.message(), "`solve` takes a vector here, this is a scalar");
        assert_eq!((error.span(), error.help()), (1..2, Some("write `solve(matrix, vector)`")));
        let error = call(&mut arena, "diag", &arguments, 0..9).expect_err("two arguments");
        assert_eq!(
            error.message(),
            "`diag` takes 1 or 3 arguments, not 2",
            "both counts are given"
        );
        assert_eq!(error.span(), 0..9, "the whole call");
    }
}
