//! Tests of the overloads of functions.

use super::super::arena::Arena;
use super::*;

fn operands(types: &[Type]) -> (Builder<'static>, Vec<Operand>) {
    let mut arena = Arena::default();
    let operands = types.iter().enumerate().map(|(i, ty)| Operand {
        node: arena.push(NodeOperation::Identity, *ty, i..i + 1),
        value_type: *ty,
        span: i..i + 1,
    });
    let operands = operands.collect();
    (Builder { arena, text: "0123456789" }, operands)
}

#[test]
fn every_overload_builds_from_its_own_arguments() {
    let kind = |wanted: RequiredType| match wanted {
        Scalar => Type::Scalar,
        Vector | Spatial => Type::VECTOR,
        Matrix | Square => Type::MATRIX,
    };
    for function in FUNCTIONS {
        let types: Vec<Type> = match function.arguments {
            These(wanted) => wanted.iter().map(|wanted| kind(*wanted)).collect(),
            Several(least, wanted) => vec![kind(wanted); least.max(4)],
        };
        let (mut builder, arguments) = operands(&types);
        for name in function.names {
            let built = call(&mut builder, name, &arguments, 0..9).expect("it is built");
            assert_eq!(built.node, builder.arena.nodes.len() - 1, "`{name}` is the last node");
        }
    }
}

#[test]
fn wrong_arguments_are_told_apart() {
    let (mut builder, arguments) = operands(&[Type::MATRIX, Type::Scalar]);
    let error = call(&mut builder, "solve", &arguments, 0..9).expect_err("a scalar");
    assert_eq!(error.message(), "`solve` takes a vector here, this is a scalar");
    assert_eq!(
        (error.span(), error.help()),
        (1..2, Some("write `solve(matrix, vector)` or `solve(matrix, matrix)`"))
    );
    let error = call(&mut builder, "hat", &arguments, 0..9).expect_err("two arguments");
    assert_eq!(error.message(), "`hat` takes 1 argument, not 2", "the count is given");
    assert_eq!(error.span(), 0..9, "the whole call");
    let (mut builder, arguments) = operands(&[Type::Matrix(2, 3), Type::Vector(4)]);
    let error = call(&mut builder, "det", &arguments[..1], 0..9).expect_err("not square");
    let message = "`det` takes a square matrix here, this is a matrix of size 2×3";
    assert_eq!(error.message(), message, "the size is given");
    let error = call(&mut builder, "hat", &arguments[1..], 0..9).expect_err("too long");
    let message = "`hat` takes a vector of length 3 here, this is a vector of length 4";
    assert_eq!(error.message(), message, "the length is given");
}

#[test]
fn sizes_have_to_fit() {
    let (mut builder, arguments) = operands(&[Type::Matrix(4, 4), Type::VECTOR]);
    let error = call(&mut builder, "solve", &arguments, 0..9).expect_err("3 is not 4");
    let message = "a matrix of size 4×4 cannot be solved for a vector of length 3";
    assert_eq!((error.message(), error.span()), (message, 1..2));
    let (mut builder, arguments) = operands(&[Type::Matrix(4, 4), Type::Matrix(3, 4)]);
    let error = call(&mut builder, "solve", &arguments, 0..9).expect_err("3 rows are not 4");
    assert_eq!(error.message(), "a matrix of size 4×4 cannot be solved for a matrix of size 3×4");
    let (mut builder, arguments) = operands(&[Type::Matrix(4, 4), Type::Matrix(4, 2)]);
    let built = call(&mut builder, "solve", &arguments, 0..9).expect("4 rows");
    assert_eq!(built.value_type, Type::Matrix(4, 2), "the size of A⁻¹B");
    let (mut builder, arguments) = operands(&[Type::Matrix(17, 17)]);
    let error = call(&mut builder, "inverse", &arguments, 0..9).expect_err("too large");
    assert_eq!(error.help(), Some("determinants and inverses take at most 16 rows"));
    assert!(call(&mut builder, "trace", &arguments, 0..9).is_ok(), "a trace is a sum");
}
