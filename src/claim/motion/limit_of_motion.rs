//! Convergence of motions to a limit as a parameter tends to 0.

use super::{Beginning, Motional, Stated, count, number, time};
use crate::claim::Reader;
use crate::claim::limit::scalar_parameter;
use crate::formula::Formula;

/// The claim that at a given time |F at ε - F at ε = 0| = C ε^order + o(ε^order), with the constant
/// C if one is given.
#[derive(Clone, Debug)]
pub struct LimitOfMotion {
    /// Function F, at the end of the motion.
    pub function: Formula,
    /// Parameter ε, as a component of the free parameters; `None` if it has a fixed value.
    pub component: Option<usize>,
    /// Order of the error.
    pub order: usize,
    /// Constant C.
    pub constant: Option<Stated>,
    /// Start of the motions.
    pub beginning: Beginning,
    /// Length of the motions in time.
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
            order: count(from, "order", 1)?.unwrap_or(1),
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
