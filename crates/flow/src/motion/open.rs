//! Model of a case in which parameters that the case fixes are free.

use liouville::formula::Type;
use liouville::mechanics::{Draw, Model, ParameterOrigin, Range, SamplerSpec, components};
use liouville::number::rational::Rational;

/// Model in which the varied parameters are free.
pub(crate) struct OpenModel {
    pub model: Model,
    /// Components of all free parameters.
    pub parameters: Vec<Rational>,
    /// Offset of each parameter in the components.
    pub places: Vec<usize>,
}

impl OpenModel {
    /// Frees the parameters of these indices; `drawn` are the components of those that were free.
    pub fn new(model: &Model, drawn: &[Rational], varied: &[usize]) -> Self {
        let mut drawn = drawn;
        let mut model = model.clone();
        let (mut parameters, mut places) = (Vec::new(), Vec::new());
        for (index, parameter) in model.parameters.iter_mut().enumerate() {
            places.push(parameters.len());
            match &parameter.origin {
                ParameterOrigin::Free(_) => {
                    let (own, others) = drawn.split_at(components(parameter.kind));
                    parameters.extend_from_slice(own);
                    drawn = others;
                }
                ParameterOrigin::Fixed(values) if varied.contains(&index) => {
                    parameters.extend_from_slice(values);
                    parameter.origin = ParameterOrigin::Free(open(parameter.kind));
                }
                ParameterOrigin::Fixed(_) | ParameterOrigin::Formula(_) => {}
            }
        }
        Self { model, parameters, places }
    }
}

/// Recipe that admits any value of a type; nothing is drawn from it.
fn open(kind: Type) -> SamplerSpec {
    let draw = Draw::Within(Range { low: Rational::from(-1), high: Rational::from(1) });
    match kind {
        Type::Scalar => SamplerSpec::Scalar(draw),
        Type::Vector(length) => SamplerSpec::Vector(length, draw),
        Type::Matrix(rows, columns) => SamplerSpec::Matrix(rows, columns, draw),
    }
}
