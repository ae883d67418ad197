//! How motions tend to a limit with a parameter.

use super::{Beginning, Motional, Stated, count, number, time};
use crate::claim::Reader;
use crate::claim::limit::scalar_parameter;
use crate::formula::Formula;

/// After a time, |F at ε - F at ε = 0| = C ε^order + o(ε^order), with C as given, if it is.
#[derive(Clone, Debug)]
pub struct LimitOfMotion {
    /// F, at the end of the motion.
    pub function: Formula,
    /// ε, as a component of the free parameters; `None` where it has a fixed value.
    pub component: Option<usize>,
    /// The order of the error.
    pub order: usize,
    /// C
    pub constant: Option<Stated>,
    /// The start of the motions.
    pub beginning: Beginning,
    /// Their length.
    pub time: f64,
}

impl Motional for LimitOfMotion {
    const NAME: &'static str = "limit-of-motion";
    const COMPANIONS: &'static [&'static str] =
        &["parameter", "order", "constant", "start", "state", "time"];

    fn read<R: Reader>(from: &R) -> Result<Self, R::Error> {
        let parameter = scalar_parameter(from, "parameter")?;
        Ok(Self {
            function: from.required(Self::NAME, None)?,
            component: from.model().free_component(parameter),
            order: count(from, "order")?.unwrap_or(1),
            constant: number(from, "constant")?,
            beginning: Beginning::read(from)?,
            time: time(from)?,
        })
    }

    fn beginning(&self) -> &Beginning {
        &self.beginning
    }

    fn text(&self) -> String {
        format!("{} tends to its limit, error of order {}", self.function.text(), self.order)
    }
}
