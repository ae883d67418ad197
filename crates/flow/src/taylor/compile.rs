//! Compilation of a graph to a Taylor program: gathers sums of products and folds constants
//! exactly.

mod limits;
pub(crate) mod proved;
mod simpler;
mod voids;

use crate::error::FlowError;
use crate::taylor::compile::proved::PowersNear;
use crate::taylor::form::{BilinearForm, Row};
use crate::taylor::program::{RowInstruction, Rule, TaylorProgram};
use crate::taylor::quotients::Needed;
use crate::taylor::saturating::Saturating;
use liouville::graph::{Expr, Graph, Step};
use liouville::number::double_double::{DoubleDouble, DoubleDoubles};
use liouville::number::rational::Rational;
use liouville::number::{BinaryOperation, Domain, UnaryFunction};

/// Size above which coefficients are no longer folded.
const MAX_COEFFICIENT_BITS: u64 = 1 << 13;
/// Largest number of terms of a sum that its readers repeat instead of sharing a row.
const MAX_REPEATED_TERMS: usize = 1;

impl TaylorProgram {
    /// Compiles a field: `rates` and `outputs` as functions of the graph's inputs, which are the
    /// state alone.
    pub fn compile(graph: &Graph, rates: &[Expr], outputs: &[Expr]) -> Result<Self, FlowError> {
        Self::with_constants(graph, Some(&constants(graph)), rates, outputs)
    }

    /// Compiles a field without rounding: constants such as √2 are rows. Moduli are refused.
    pub fn exact(graph: &Graph, rates: &[Expr]) -> Result<Self, FlowError> {
        if graph.has_step(rates, |step| matches!(step, Step::Unary(UnaryFunction::Abs, _))) {
            return Err(FlowError::NotAnalytic);
        }
        Self::with_constants(graph, None, rates, &[])
    }

    fn with_constants(
        graph: &Graph,
        constants: Option<&[Option<DoubleDouble>]>,
        rates: &[Expr],
        outputs: &[Expr],
    ) -> Result<Self, FlowError> {
        let dimension = rates.len();
        let wanted: Vec<usize> =
            rates.iter().chain(outputs).map(|expr| graph.place(*expr)).collect();
        let needed = match constants {
            Some(_) => Needed::by(graph, &wanted),
            None => Needed::exactly(graph, &wanted),
        };
        let reached = &needed.places;
        let mut uses = vec![0usize; graph.len()];
        wanted.iter().for_each(|place| uses[*place] += 1);
        for (_, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            step.arguments().for_each(|argument| uses[argument] += 1);
        }
        let mut compiler = Compiler {
            uses,
            forms: vec![None; graph.len()],
            rows: vec![None; graph.len()],
            instructions: Vec::new(),
            next: dimension,
            circular: Vec::new(),
            thetas: Vec::new(),
            signs: Vec::new(),
            saturating: Vec::new(),
            is_exact: constants.is_none(),
            moduli: if constants.is_some() { voids::may_be_zero(graph) } else { Vec::new() },
            voids: Vec::new(),
            series: Vec::new(),
        };
        for (place, step) in graph.steps().enumerate().filter(|(place, _)| reached[*place]) {
            let form = match (step, constants.and_then(|constants| constants[place])) {
                (Step::Constant(value), _) => BilinearForm::of_constant(value),
                (_, Some(value)) => {
                    BilinearForm::of_constant(&value.to_rational().unwrap_or(Rational::from(0)))
                }
                _ => match &needed.simpler[place] {
                    Some(simpler) => compiler.simpler(simpler)?,
                    None => match compiler.modulus(graph, step)? {
                        Some(form) => form,
                        None => match compiler
                            .extreme(graph, step)
                            .or_else(|| constants.and_then(|_| compiler.area_or_sine(graph, place)))
                        {
                            Some(form) => form,
                            None => compiler.form_of(step, dimension)?,
                        },
                    },
                },
            };
            compiler.forms[place] = Some(form);
        }
        let mut rows = Vec::new();
        for place in wanted {
            rows.push(compiler.row(place));
        }
        let outputs = rows.split_off(dimension);
        Ok(TaylorProgram {
            dimension,
            rows: compiler.next,
            instructions: compiler.instructions,
            rates: rows,
            outputs,
            jumps: false,
            level: None,
            presence: None,
        })
    }
}

/// Values of the steps that depend only on constants, such as √2.
fn constants(graph: &Graph) -> Vec<Option<DoubleDouble>> {
    let mut values: Vec<Option<DoubleDouble>> = Vec::with_capacity(graph.len());
    for step in graph.steps() {
        let at = |place: usize| values[place];
        let mut out = DoubleDouble::NAN;
        let made = match step {
            Step::Constant(value) => Some(DoubleDouble::from_rational(value)),
            Step::Input(_) => None,
            Step::Unary(function, a) => at(a).map(|x| {
                DoubleDoubles.unary(function, &x, &mut out);
                out
            }),
            Step::Binary(operation, a, b) => at(a).zip(at(b)).map(|(x, y)| {
                DoubleDoubles.binary(operation, &x, &y, &mut out);
                out
            }),
            Step::Power(a, exponent) => at(a).map(|x| x.power(exponent)),
        };
        values.push(made.filter(|value| value.is_finite()));
    }
    values
}

struct Compiler {
    uses: Vec<usize>,
    forms: Vec<Option<BilinearForm>>,
    /// Row of each step that has one, up to a factor.
    rows: Vec<Option<(Rational, Row)>>,
    instructions: Vec<RowInstruction>,
    next: Row,
    /// Sines and cosines, made together: argument, sine, cosine.
    circular: Vec<(Row, Row, Row)>,
    /// Pairs of a row x and its row θx.
    thetas: Vec<(Row, Row)>,
    /// Pairs of a row x and the row of its sign.
    signs: Vec<(Row, Row)>,
    /// Functions that tend to constants: argument, function.
    saturating: Vec<(Saturating, Row, Row)>,
    /// Steps that contain moduli and are not negative, by their form.
    moduli: Vec<bool>,
    /// Bases of roots that contain moduli: rows, the same with 1 in place of what is not positive, and
    /// rows that are 0 there and 1 elsewhere.
    voids: Vec<(Row, Row, Row)>,
    /// Whether nothing may be rounded.
    is_exact: bool,
    /// Powers of the variables of proved series, made once.
    series: Vec<PowersNear>,
}

impl Compiler {
    fn emit(&mut self, rule: Rule, form: BilinearForm) -> Row {
        let out = self.next;
        self.next += 1;
        self.instructions.push(RowInstruction { rule, out, form });
        out
    }

    fn one() -> Rational {
        Rational::from(1)
    }

    fn product(a: Row, b: Row) -> BilinearForm {
        BilinearForm::of_product(Self::one(), a, b)
    }

    fn form_of(&mut self, step: Step<'_>, dimension: usize) -> Result<BilinearForm, FlowError> {
        Ok(match step {
            Step::Constant(value) => BilinearForm::of_constant(value),
            Step::Input(input) if input < dimension => BilinearForm::of_row(Self::one(), input),
            Step::Input(_) => return Err(FlowError::Antiderivative),
            Step::Binary(BinaryOperation::Add, a, b) => self.term(a).plus(self.term(b)),
            Step::Binary(BinaryOperation::Sub, a, b) => {
                let minus = self.term(b).times(&Rational::from(-1));
                self.term(a).plus(minus)
            }
            Step::Binary(BinaryOperation::Mul, a, b) => self.times(a, b),
            Step::Binary(BinaryOperation::Pow, a, b) => {
                let base = self.row(a);
                let logarithm = self.logarithm(base);
                let (factor, exponent) = self.factor(b);
                let argument =
                    self.emit(Rule::Sum, BilinearForm::of_product(factor, exponent, logarithm));
                BilinearForm::of_row(Self::one(), self.exponential(argument))
            }
            Step::Unary(UnaryFunction::Neg, a) => self.term(a).times(&Rational::from(-1)),
            Step::Unary(UnaryFunction::Recip, a) => {
                let (factor, row) = self.reciprocal(a)?;
                BilinearForm::of_row(factor, row)
            }
            Step::Unary(UnaryFunction::Sqrt, a) if self.may_be_void(a) => {
                let (x, on) = self.base(a);
                let root = self.function(UnaryFunction::Sqrt, x)?;
                Self::product(on, root)
            }
            Step::Unary(function, a) => {
                let x = self.row(a);
                let row = self.function(function, x)?;
                BilinearForm::of_row(Self::one(), row)
            }
            Step::Power(a, exponent) => {
                // Of others 0 has no power, as written.
                let is_half = (exponent * &Rational::from(2)).to_integer().is_some();
                let may_be_void = is_half && !exponent.is_negative() && self.may_be_void(a);
                let (x, on) = match may_be_void {
                    true => {
                        let (x, on) = self.base(a);
                        (x, Some(on))
                    }
                    false => (self.row(a), None),
                };
                let theta = self.theta(x);
                // The row itself, and its θ, which comes after it.
                let (out, own_theta) = (self.next, self.next + 1);
                let form = BilinearForm::of_product(exponent.clone(), theta, out)
                    .plus(BilinearForm::of_product(Rational::from(-1), own_theta, x));
                let rule = Rule::Power { x, exponent: exponent.clone() };
                let row = self.emit(rule, form);
                self.theta(row);
                match on {
                    Some(on) => Self::product(on, row),
                    None => BilinearForm::of_row(Self::one(), row),
                }
            }
        })
    }

    fn function(&mut self, function: UnaryFunction, x: Row) -> Result<Row, FlowError> {
        Ok(match function {
            UnaryFunction::Sqrt => {
                let out = self.next;
                self.emit(Rule::Sqrt(x), Self::product(out, out))
            }
            UnaryFunction::Exp => self.exponential(x),
            UnaryFunction::Ln => self.logarithm(x),
            UnaryFunction::Sin => self.sine_and_cosine(x).0,
            UnaryFunction::Cos => self.sine_and_cosine(x).1,
            UnaryFunction::Atan => {
                let square = BilinearForm::of_constant(&Self::one()).plus(Self::product(x, x));
                let square = self.emit(Rule::Sum, square);
                let own_theta = self.next + 1;
                let row = self.emit(Rule::Atan { x, square }, Self::product(own_theta, square));
                self.theta(row);
                row
            }
            UnaryFunction::Neg | UnaryFunction::Recip | UnaryFunction::Abs => {
                return Err(FlowError::NotAnalytic);
            }
        })
    }

    /// 1/x as a factor times a row.
    fn reciprocal(&mut self, place: usize) -> Result<(Rational, Row), FlowError> {
        let (factor, x) = self.factor(place);
        let out = self.next;
        let row = self.emit(Rule::Recip(x), Self::product(x, out));
        let nowhere = || FlowError::Singular { time: 0.0, state: Vec::new() };
        Ok((factor.recip().ok_or_else(nowhere)?, row))
    }

    fn exponential(&mut self, x: Row) -> Row {
        let theta = self.theta(x);
        let out = self.next;
        self.emit(Rule::Exp(x), Self::product(theta, out))
    }

    fn logarithm(&mut self, x: Row) -> Row {
        let own_theta = self.next + 1;
        let row = self.emit(Rule::Ln(x), Self::product(own_theta, x));
        self.theta(row);
        row
    }

    fn sine_and_cosine(&mut self, x: Row) -> (Row, Row) {
        if let Some((_, sine, cosine)) = self.circular.iter().find(|(argument, ..)| *argument == x)
        {
            return (*sine, *cosine);
        }
        let theta = self.theta(x);
        let (sine, cosine) = (self.next, self.next + 1);
        self.emit(Rule::Sin { x, cosine }, Self::product(theta, cosine));
        self.emit(Rule::Cos { x, sine }, Self::product(theta, sine));
        self.circular.push((x, sine, cosine));
        (sine, cosine)
    }

    fn theta(&mut self, x: Row) -> Row {
        if let Some((_, theta)) = self.thetas.iter().find(|(row, _)| *row == x) {
            return *theta;
        }
        let theta = self.emit(Rule::Theta(x), BilinearForm::default());
        self.thetas.push((x, theta));
        theta
    }

    fn times(&mut self, a: usize, b: usize) -> BilinearForm {
        for (constant, other) in [(a, b), (b, a)] {
            let value = self.forms[constant].as_ref().and_then(BilinearForm::as_constant);
            if let Some(value) = value
                && value.bits() <= MAX_COEFFICIENT_BITS
            {
                return self.term(other).times(&value);
            }
        }
        let ((p, x), (q, y)) = (self.factor(a), self.factor(b));
        BilinearForm::of_product(&p * &q, x, y)
    }

    /// Contribution of a step to a sum: its own terms, or the row that holds them.
    fn term(&mut self, place: usize) -> BilinearForm {
        if let Some((factor, row)) = &self.rows[place] {
            return BilinearForm::of_row(factor.clone(), *row);
        }
        let Some(form) = &self.forms[place] else { return BilinearForm::default() };
        if self.uses[place] <= 1 || form.len() <= MAX_REPEATED_TERMS && form.products.is_empty() {
            return form.clone();
        }
        let (factor, row) = self.factor(place);
        BilinearForm::of_row(factor, row)
    }

    /// A step as a factor times a row.
    fn factor(&mut self, place: usize) -> (Rational, Row) {
        if let Some(known) = &self.rows[place] {
            return known.clone();
        }
        let form = self.forms[place].clone().unwrap_or_default();
        let known = match form.as_row() {
            Some((factor, row)) => (factor.clone(), row),
            None => (Self::one(), self.emit(Rule::Sum, form)),
        };
        self.rows[place] = Some(known.clone());
        known
    }

    /// A step as a separate row, without a factor.
    fn row(&mut self, place: usize) -> Row {
        let (factor, row) = self.factor(place);
        if factor.is_one() {
            return row;
        }
        let row = self.emit(Rule::Sum, BilinearForm::of_row(factor, row));
        self.rows[place] = Some((Self::one(), row));
        row
    }
}
