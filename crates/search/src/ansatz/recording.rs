//! Values recorded at a state for a linear system: variables and factors with their derivatives.

use num_dual::Dual;

use liouville::formula::Formula;
use liouville::graph::Expr;
use liouville::mechanics::Phase;
use liouville::number::rational::Rational;
use liouville::scalar::Scalar;

/// Position of x, dx, W and dW of one direction among the outputs.
#[derive(Clone, Copy, Debug)]
pub struct Derivation {
    /// Place of the first.
    pub start: usize,
    /// Number of variables.
    pub variables: usize,
    /// Number of factors.
    pub factors: usize,
}

/// Values recorded at a state.
#[derive(Default)]
pub struct Recording {
    /// Recorded values.
    pub outputs: Vec<Expr>,
    /// Directions of derivatives, in order.
    pub derivations: Vec<Derivation>,
}

impl Recording {
    /// Adds an output and returns its index.
    pub fn give(&mut self, value: Expr) -> usize {
        self.outputs.push(value);
        self.outputs.len() - 1
    }

    /// Adds variables and factors with their derivatives along a direction; returns its index.
    pub fn derive(
        &mut self,
        moved: &Phase<'_, Dual<Expr>>,
        variables: &[Formula],
        factors: &[Formula],
    ) -> usize {
        let start = self.outputs.len();
        for terms in [variables, factors] {
            let values: Vec<Dual<Expr>> = terms.iter().map(|term| moved.scalar(term)).collect();
            self.outputs.extend(values.iter().map(|value| value.re));
            self.outputs.extend(values.iter().map(|value| value.eps));
        }
        let (variables, factors) = (variables.len(), factors.len());
        self.derivations.push(Derivation { start, variables, factors });
        self.derivations.len() - 1
    }

    /// Adds variables and factors that are multiplied by `by` in place of being differentiated; returns
    /// the direction's index.
    pub fn multiply(
        &mut self,
        at: &Phase<'_, Expr>,
        variables: &[Formula],
        factors: &[Formula],
        by: Expr,
    ) -> usize {
        let start = self.outputs.len();
        let zero = Expr::rational(&Rational::from(0));
        self.outputs.extend(variables.iter().map(|term| at.scalar(term)));
        self.outputs.extend(vec![zero; variables.len()]);
        let values: Vec<Expr> = factors.iter().map(|term| at.scalar(term)).collect();
        self.outputs.extend(values.iter().copied());
        self.outputs.extend(values.iter().map(|value| *value * by));
        let (variables, factors) = (variables.len(), factors.len());
        self.derivations.push(Derivation { start, variables, factors });
        self.derivations.len() - 1
    }

    /// Adds variables and factors whose products W x^a grow at an additional rate `growth`; returns the
    /// direction's index. Their derivative is v(W x^a) + growth·W x^a.
    pub fn derive_growing_over(
        &mut self,
        moved: &Phase<'_, Dual<Expr>>,
        (variables, factors): (&[Formula], &[Formula]),
        growth: Expr,
    ) -> usize {
        let direction = self.derive(moved, variables, factors);
        let (end, count) = (self.outputs.len(), factors.len());
        for k in 0..count {
            let (value, slope) = (self.outputs[end - 2 * count + k], self.outputs[end - count + k]);
            self.outputs[end - count + k] = slope + growth * value;
        }
        direction
    }

    /// Adds variables with an additional rate of growth `growth`; returns the direction's index. The
    /// derivative of x^a is v(x^a) + growth·x^a.
    pub fn derive_growing(
        &mut self,
        moved: &Phase<'_, Dual<Expr>>,
        variables: &[Formula],
        growth: Expr,
    ) -> usize {
        let direction = self.derive(moved, variables, &[]);
        self.outputs.extend([Expr::rational(&Rational::from(1)), growth]);
        self.derivations[direction].factors = 1;
        direction
    }
}
