//! Taylor coefficients of a motion at a state.

use crate::taylor::batch::MOTION_LANES;
use crate::taylor::code::{BoundProgram, LINE, Place, PlacedRule};
use crate::taylor::expand::Expansion;
use crate::taylor::lanes::Lanes;
use crate::taylor::machine::{LaneMachine, TaylorCode};
use crate::taylor::number::{BLOCK, SeriesNumber};
use crate::taylor::program::TaylorProgram;
use liouville::graph::with_widest_vectors;
use liouville::number::rational::Rational;

/// A program over one type of number, with the memory to run it.
pub struct Series<T: SeriesNumber> {
    pub(crate) order: usize,
    /// Order to which rows are padded.
    pub(crate) orders: usize,
    pub(crate) code: BoundProgram<T>,
    /// Reciprocals 1/n, and the units of time over n.
    pub(crate) inverses: Vec<T>,
    pub(crate) advances: Vec<T>,
    pub(crate) units: T,
    /// Inner sums of the operations that have any, at the current order, before and after their
    /// parts are added.
    pub(crate) partial: Vec<T::Partial>,
    pub(crate) inner: Vec<T>,
    pub(crate) memory: Vec<T>,
    /// Memory for plain values at other states.
    pub(crate) probed: Vec<T>,
    /// Places of the rows that are no sums of products: functions without poles, and others.
    functions: [Vec<Place>; 2],
    /// Places of the arguments of exponential functions, with the rates k of those that fall as
    /// e^(−k|u|).
    exponents: Vec<(Place, Option<f64>)>,
    /// Places of the rows that are roots or powers, which are not negative.
    roots: Vec<Place>,
    /// Places of the rows that are divided by.
    divisors: Vec<Place>,
    /// Places of the rows that are 1 near 0, of their arguments, and how far near reaches.
    nears: Vec<(Place, Place, f64)>,
    /// Places of the rows that are 1 where others are not positive, and of these.
    voids: Vec<(Place, Place)>,
    /// Operations that are signs, with the places of their arguments.
    signs: Vec<(usize, Place)>,
    has_pulses: bool,
    /// Number of expansions so far, up to where machine code pays.
    pub(crate) expansions: u32,
    pub(crate) machine: Option<Box<T::Machine>>,
}

impl<T: SeriesNumber> Series<T> {
    /// Prepares the program for expansions to this order.
    pub fn new(program: &TaylorProgram, order: usize) -> Self {
        let line = LINE / size_of::<T>().clamp(1, LINE);
        let (_, length) = BoundProgram::<T>::new(program, order, line);
        let memory = vec![T::ZERO; length + line];
        let aligned = memory.as_ptr().align_offset(LINE).min(line);
        let (code, _) = BoundProgram::new(program, order, aligned);
        let sums = (code.counts.len() + 1).next_multiple_of(BLOCK);
        let placed = || code.operations.iter().zip(&code.finishes);
        let functions = [true, false].map(|is_entire| {
            let own = placed().filter(|(operation, _)| operation.rule.is_function(is_entire));
            own.map(|(_, finish)| finish.place).collect()
        });
        let exponents = code.operations.iter().filter_map(|operation| match operation.rule {
            PlacedRule::Exp(x) => Some((x, None)),
            PlacedRule::Saturating { function, x, .. } => Some((x, Some(function.rate()))),
            _ => None,
        });
        let exponents: Vec<(Place, Option<f64>)> = exponents.collect();
        let roots = placed().filter(|(operation, _)| {
            matches!(operation.rule, PlacedRule::Sqrt(_) | PlacedRule::Power { .. })
        });
        let roots = roots.map(|(_, finish)| finish.place).collect();
        let nears = placed().filter_map(|(operation, finish)| match operation.rule {
            PlacedRule::Near(x, reach) => Some((finish.place, x, reach)),
            _ => None,
        });
        let nears = nears.collect();
        let voids = placed().filter_map(|(operation, finish)| match operation.rule {
            PlacedRule::Void(x) => Some((finish.place, x)),
            _ => None,
        });
        let voids = voids.collect();
        let signs = code.operations.iter().enumerate();
        let signs = signs.filter_map(|(index, operation)| match operation.rule {
            PlacedRule::Sign(x) => Some((index, x)),
            _ => None,
        });
        let signs = signs.collect();
        let divisors = code.operations.iter().filter_map(|operation| match &operation.rule {
            PlacedRule::Recip(x) => Some(*x),
            PlacedRule::Power { x, exponent, .. } => {
                let is_quotient = exponent.is_negative() && exponent.to_integer().is_some();
                is_quotient.then_some(*x)
            }
            _ => None,
        });
        let mut divisors: Vec<Place> = divisors.collect();
        divisors.sort_unstable();
        divisors.dedup();
        let inverse = |n: usize| T::rational(&Rational::new(1, n.max(1) as i64));
        let inverses: Vec<T> = (0..=order).map(inverse).collect();
        Self {
            order,
            orders: order.next_multiple_of(T::WIDTH),
            code,
            advances: inverses.clone(),
            inverses,
            units: T::ONE,
            partial: vec![T::nothing(); sums],
            inner: vec![T::ZERO; sums],
            probed: memory.clone(),
            memory,
            functions,
            roots,
            divisors,
            has_pulses: !exponents.is_empty() || program.degree() > order,
            exponents,
            nears,
            voids,
            signs,
            expansions: 0,
            machine: None,
        }
    }

    /// Highest order of the state's coefficients.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Computes all coefficients at `state`.
    pub fn expand(&mut self, state: &[T]) {
        for (component, value) in self.code.state.iter().zip(state) {
            self.memory[component.place as usize] = *value;
        }
        with_widest_vectors(Expansion(self));
    }

    /// Measures the time of expansions in these units, which are powers of 2.
    pub(crate) fn measure_in(&mut self, units: T) {
        let is_same = |lane: usize| units.lane(lane).leading() == self.units.lane(lane).leading();
        if !(0..T::LANES).all(is_same) {
            let scaled = self.inverses.iter().map(|inverse| *inverse * units);
            (self.advances, self.units) = (scaled.collect(), units);
        }
    }

    /// Clears the memory: values that are not finite must not meet the zeros behind a row.
    pub fn clear(&mut self) {
        self.memory.fill(T::ZERO);
    }
}

/// Number of expansions of one motion that take as long as generating machine code.
const MANY: u32 = 32;
/// The same for motions in lanes.
const MANY_IN_LANES: u32 = 8;

impl Series<f64> {
    /// Computes all orders by machine code. Returns `false` where there is none.
    #[inline(always)]
    pub(crate) fn by_machine(&mut self) -> bool {
        if self.expansions < MANY {
            self.expansions += 1;
            if self.expansions == MANY {
                self.machine = TaylorCode::new(&self.code, self.order).map(Box::new);
            }
        }
        let Some(mut machine) = self.machine.take() else { return false };
        if !machine.begin([&self.inverses, &self.advances], &mut self.memory) {
            self.begin();
            machine.take(&self.code);
        }
        machine.run(&self.code, [&self.inverses, &self.advances], &mut self.memory);
        self.machine = Some(machine);
        true
    }

    /// Computes the values at the probed state by machine code. Returns `false` where there is none.
    #[inline(always)]
    pub(crate) fn values_by_machine(&mut self) -> bool {
        let machine = self.machine.as_mut();
        machine.is_some_and(|machine| {
            machine.begin([&self.inverses, &self.advances], &mut self.probed)
        })
    }
}

impl Series<Lanes<MOTION_LANES>> {
    /// Computes all orders by machine code. Returns `false` where there is none.
    #[inline(always)]
    pub(crate) fn by_machine(&mut self) -> bool {
        if self.expansions < MANY_IN_LANES {
            self.expansions += 1;
            if self.expansions == MANY_IN_LANES {
                self.machine = LaneMachine::new(&self.code, self.order).map(Box::new);
            }
        }
        let Some(mut machine) = self.machine.take() else { return false };
        if !machine.begin([&self.inverses, &self.advances], &mut self.memory) {
            self.begin();
            machine.take(&self.code);
        }
        machine.run(&self.code, [&self.inverses, &self.advances], &mut self.memory);
        self.machine = Some(machine);
        true
    }

    /// Computes the values at the probed state by machine code. Returns `false` where there is none.
    #[inline(always)]
    pub(crate) fn values_by_machine(&mut self) -> bool {
        let machine = self.machine.as_mut();
        machine.is_some_and(|machine| {
            machine.begin([&self.inverses, &self.advances], &mut self.probed)
        })
    }
}

impl<T: SeriesNumber> Series<T> {
    /// Coefficients of a component of the state, orders 0 to `order`.
    #[inline(always)]
    pub fn component(&self, index: usize) -> &[T] {
        let place = self.code.state[index].place as usize;
        &self.memory[place..=place + self.order]
    }

    /// Coefficients of the rows that are functions without poles, or other functions, orders 0 to
    /// `order` - 1.
    pub fn functions(&self, is_entire: bool) -> impl Iterator<Item = &[T]> {
        self.functions[usize::from(!is_entire)].iter().map(|place| self.row(*place))
    }

    /// Coefficients of the arguments u of exponential functions, orders 0 to `order` - 1, with the
    /// rates k of functions that vary by e^(−k|u|).
    pub fn exponents(&self) -> impl Iterator<Item = (&[T], Option<f64>)> {
        self.exponents.iter().map(|(place, rate)| (self.row(*place), *rate))
    }

    #[inline(always)]
    fn row(&self, place: Place) -> &[T] {
        &self.memory[place as usize..][..self.order]
    }

    /// Coefficients of the roots and powers, orders 0 to `order` - 1.
    pub fn roots(&self) -> impl Iterator<Item = &[T]> {
        self.roots.iter().map(|place| self.row(*place))
    }

    /// Rows that are divided by: their places, and coefficients of orders 0 to `order` - 1.
    pub fn divisors(&self) -> impl Iterator<Item = (Place, &[T])> {
        self.divisors.iter().map(|place| (*place, self.row(*place)))
    }

    /// Arguments of series that stand for quotients, with the rows that are 1 where they do, and how
    /// far they reach.
    pub fn nears(&self) -> impl Iterator<Item = (&T, &[T], f64)> {
        let nears = self.nears.iter();
        nears.map(|(near, x, reach)| (&self.memory[*near as usize], self.row(*x), *reach))
    }

    /// Bases of roots that are 0 where these are not positive: whether they are, place and coefficients.
    pub fn voids(&self) -> impl Iterator<Item = (&T, Place, &[T])> {
        let voids = self.voids.iter();
        voids.map(|(void, x)| (&self.memory[*void as usize], *x, self.row(*x)))
    }

    /// Gives a component the polynomial with these coefficients of orders 1 to 3, in one lane.
    pub fn put_component(&mut self, index: usize, lane: usize, terms: [T::One; 3]) {
        let place = self.code.state[index].place as usize;
        self.put(place + 1, self.order, lane, terms);
    }

    /// The same for a further function, orders 0 to 2, unless it is a component.
    pub fn put_output(&mut self, index: usize, lane: usize, terms: [T::One; 3]) {
        let place = self.code.outputs[index];
        if !self.code.state.iter().any(|component| component.place == place) {
            self.put(place as usize, self.order, lane, terms);
        }
    }

    fn put(&mut self, place: usize, count: usize, lane: usize, terms: [T::One; 3]) {
        for (n, target) in self.memory[place..place + count].iter_mut().enumerate() {
            let own = terms.get(n).copied().unwrap_or(T::One::ZERO);
            let old = *target;
            *target = T::from_lanes(|other| if other == lane { own } else { old.lane(other) });
        }
    }

    /// Number of signs of moduli.
    pub fn signs(&self) -> usize {
        self.signs.len()
    }

    /// Argument of a sign: its place, and coefficients of orders 0 to `order` - 1.
    pub fn signed(&self, sign: usize) -> (Place, &[T]) {
        let place = self.signs[sign].1;
        (place, self.row(place))
    }

    /// Whether a sign is that of positive arguments.
    pub fn is_positive(&self, sign: usize, lane: usize) -> bool {
        self.code.operations[self.signs[sign].0].constant.lane(lane).leading() > 0.0
    }

    /// Changes a sign in one lane.
    pub fn turn(&mut self, sign: usize, lane: usize) {
        let value = &mut self.code.operations[self.signs[sign].0].constant;
        let old = *value;
        *value =
            T::from_lanes(|other| if other == lane { -old.lane(other) } else { old.lane(other) });
    }

    /// Coefficients of orders 0 and 1 of the arguments of operations that have no value, or no series,
    /// at 0.
    pub fn arguments(&self) -> impl Iterator<Item = [T; 2]> {
        let arguments = self.code.operations.iter().filter_map(|operation| match operation.rule {
            PlacedRule::Recip(x)
            | PlacedRule::Sqrt(x)
            | PlacedRule::Ln(x)
            | PlacedRule::Power { x, .. } => Some(x as usize),
            _ => None,
        });
        arguments.map(|place| [self.memory[place], self.memory[place + 1]])
    }

    /// Whether the square of a quotient underflows, by which its series is formed.
    pub fn is_faint(&self, lane: usize) -> bool {
        self.divisors.iter().any(|place| {
            let value = self.memory[*place as usize].lane(lane).leading().recip();
            (value * value).is_subnormal() || value * value == 0.0
        })
    }

    /// Whether the first operation without a finite value at the state has arguments at which it has
    /// one: the value is too large.
    pub fn overflows(&self, lane: usize) -> bool {
        let value = |place: Place| self.memory[place as usize].lane(lane).leading();
        let mut placed = self.code.operations.iter().zip(&self.code.finishes);
        let first = placed.find(|(_, finish)| !value(finish.place).is_finite());
        match first.map(|(operation, _)| &operation.rule) {
            Some(PlacedRule::Recip(x)) => value(*x) != 0.0,
            Some(PlacedRule::Power { x, .. }) => value(*x) > 0.0,
            Some(PlacedRule::Sqrt(_) | PlacedRule::Ln(_)) => false,
            Some(_) => true,
            None => false,
        }
    }

    /// Whether the field has a value at all states.
    pub fn is_entire(&self) -> bool {
        !self.code.operations.iter().any(|operation| operation.rule.is_function(false))
    }

    /// Whether the field contains functions that may be 0 up to rounding over a part of a step, and
    /// not over the others.
    pub fn has_pulses(&self) -> bool {
        self.has_pulses
    }

    /// Number of components of the state.
    pub fn components(&self) -> usize {
        self.code.state.len()
    }

    /// Number of further functions.
    pub fn outputs(&self) -> usize {
        self.code.outputs.len()
    }

    /// Coefficients of a further function, orders 0 to `order` - 1.
    pub fn output(&self, index: usize) -> &[T] {
        let place = self.code.outputs[index] as usize;
        &self.memory[place..place + self.order]
    }
}

/// Returns Σ x_k h^k from k = 1 on.
#[inline(always)]
pub(crate) fn increment<T: SeriesNumber>(coefficients: &[T], step: T) -> T {
    let mut sum = T::ZERO;
    for coefficient in coefficients[1..].iter().rev() {
        sum = coefficient.fused(sum, step).settled();
    }
    sum * step
}
