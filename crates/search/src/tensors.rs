//! Terms and factors that the tensors of a user's system offer: (A u, v) for a matrix A among the parameters and
//! vectors u and v of the state, as |Iω|² − (Iω,γ)² and √(γ,I⁻¹γ) of Veselova's system.

use liouville::formula::{Formula, FormulaResult, Type};
use liouville::mechanics::{Model, System};

/// Largest numbers of matrices and of vectors.
const MATRICES: usize = 2;
const VECTORS: usize = 3;

/// Matrices among the parameters and vectors of the state; none where there are many.
fn tensors(model: &Model) -> (Vec<Formula>, Vec<Formula>) {
    if !matches!(
        model.system,
        System::Lagrangian(_) | System::Hamiltonian(_) | System::Field(_) | System::Map(_)
    ) {
        return (Vec::new(), Vec::new());
    }
    let named = |name: &str| Formula::name(name, &model.vocabulary).ok();
    let matrices = model.parameters.iter().filter(|own| own.kind == Type::MATRIX);
    let matrices: Vec<Formula> = matrices.filter_map(|own| named(&own.name)).collect();
    let vectors = model.state.iter().filter(|own| own.kind == Type::VECTOR);
    let vectors: Vec<Formula> = vectors.filter_map(|own| named(&own.name)).collect();
    match matrices.len() <= MATRICES && vectors.len() <= VECTORS {
        true => (matrices, vectors),
        false => (Vec::new(), Vec::new()),
    }
}

/// Lists the factors (A v, v) and (A⁻¹ v, v) of densities.
pub fn factors(model: &Model) -> Vec<Formula> {
    let (matrices, vectors) = tensors(model);
    let inverses: Vec<Formula> = matrices.iter().filter_map(|own| own.raised(-1).ok()).collect();
    let both = matrices.iter().chain(&inverses);
    let of = |own: &Formula| {
        vectors.iter().filter_map(|v| v.dot(&(own * v).ok()?).ok()).collect::<Vec<Formula>>()
    };
    both.flat_map(of).collect()
}

/// Lists products of two of the vectors v and A v, one of them with a matrix; and the squares of (A u, v).
pub fn products(model: &Model) -> (Vec<Formula>, Vec<Formula>) {
    let (matrices, vectors) = tensors(model);
    let turned: Vec<Formula> = matrices
        .iter()
        .flat_map(|own| vectors.iter().filter_map(move |v| (own * v).ok()))
        .collect();
    let scalars = |made: Vec<FormulaResult>| -> Vec<Formula> {
        let made = made.into_iter().flatten();
        made.filter(|own| own.value_type() == Type::Scalar).collect()
    };
    let (mut found, mut squares) = (Vec::new(), Vec::new());
    for (k, own) in turned.iter().enumerate() {
        let mixed = vectors.iter().map(|v| own.dot(v));
        found.extend(mixed.clone());
        found.extend(turned[k..].iter().map(|other| own.dot(other)));
        squares.extend(mixed.flatten().map(|form| form.raised(2)));
    }
    (scalars(found), scalars(squares))
}
