//! Fingerprints of nodes: their values at random points of prime fields, by which equal nodes are
//! found.
//!
//! Two different rational values agree at all 64 points with a probability below (d/2^60)^64, where
//! d is their degree. √x is the root that is itself a square: √x √y = √(xy) is found, and √(x²) = x
//! is not, since x is not a square at half of the points. A point at which some root does not exist
//! is drawn again. exp, sin and the like are random functions: equal for equal arguments, and
//! related in no other way.
//!
//! For measuring only. Proofs and rounding bounds run the graph as it was recorded.

use super::{Choice, Expr, Fault, Graph, Member, Node, Points, Step};
use crate::number::prime::{Modulus, Prime, UNDEFINED, is_prime};
use crate::number::rational::Rational;
use crate::number::{BinaryOperation, Domain, GOLDEN, UnaryFunction, scrambled};

/// Number of points, half of them modulo each of two primes.
const FINGERPRINT_POINTS: usize = 64;
const HALF: usize = FINGERPRINT_POINTS / 2;
/// Number of blocks of points to try: enough for four independent roots.
const TRIES: u64 = 48;
/// Bound on numerators and denominators of factors. Below it one prime determines them, and the
/// other agrees by chance with a probability of 2^-61.
const MOST_IN_FACTOR: i64 = 1 << 29;

/// Names of the free numbers of points, apart from the inputs.
const FREE: u64 = 1 << 32;

type Values = [u64; FINGERPRINT_POINTS];

/// Size above which a graph stays as it is: the needs of each class are kept as a set.
const MOST_NODES: usize = 1 << 13;

impl Graph {
    /// Rebuilds the outputs with fewer operations, in a new graph: proportional values are computed
    /// once, in the cheapest way found among what outputs and `shortcuts` need. Exact, up to the
    /// probability above, wherever the outputs have values.
    ///
    /// An output that is zero without having been folded stays a computed sum: none of its terms is
    /// made from the others.
    pub fn merged(
        &self,
        outputs: &[Expr],
        shortcuts: &[Expr],
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let reached = self.reached(outputs.iter().chain(shortcuts).copied());
        let needed = self.reached(outputs.iter().copied());
        let moduli = moduli();
        let few = reached.iter().filter(|reached| **reached).count() <= MOST_NODES;
        let found = if few { self.fingerprints(&moduli, &reached, &needed, None) } else { None };
        let Some(mut values) = found else { return self.copied(outputs) };
        let short = self.reached(shortcuts.iter().copied());
        for output in outputs.iter().filter(|output| self.constant_value(**output).is_none()) {
            self.part(self.place(*output), &mut values, &moduli, &short);
        }
        self.rebuilt_from(outputs, &reached, &values, &moduli)
    }

    /// Merges nodes of equal value at some points only, where more values are proportional; `None`
    /// where an output that was not folded is zero at all of these, as nothing would be left of it,
    /// or where no points were found.
    pub fn merged_at(
        &self,
        outputs: &[Expr],
        shortcuts: &[Expr],
        points: &Points<'_>,
    ) -> Result<Option<(Graph, Vec<Expr>)>, Fault> {
        let reached = self.reached(outputs.iter().chain(shortcuts).copied());
        let needed = self.reached(outputs.iter().copied());
        let moduli = moduli();
        if reached.iter().filter(|reached| **reached).count() > MOST_NODES {
            return Ok(None);
        }
        let Some(values) = self.fingerprints(&moduli, &reached, &needed, Some(points)) else {
            return Ok(None);
        };
        let is_lost = |output: &Expr| {
            self.constant_value(*output).is_none()
                && values[self.place(*output)].is_some_and(|values| vanishes(&values))
        };
        if outputs.iter().any(is_lost) {
            return Ok(None);
        }
        self.rebuilt_from(outputs, &reached, &values, &moduli).map(Some)
    }

    /// Rebuilds the outputs from the cheapest members of the classes.
    fn rebuilt_from(
        &self,
        outputs: &[Expr],
        reached: &[bool],
        values: &[Option<Values>],
        moduli: &[Modulus; FINGERPRINT_POINTS],
    ) -> Result<(Graph, Vec<Expr>), Fault> {
        let members = self.classes(values, moduli);
        let rebuilt = self.rebuilt(outputs, &members, Choice::Cheapest(reached))?;
        let is_folded = |(before, after): (&Expr, &Expr)| {
            rebuilt.0.constant_value(*after).is_some() && self.constant_value(*before).is_none()
        };
        let is_longer = rebuilt.0.operations(&rebuilt.1) > self.operations(outputs);
        if is_longer || outputs.iter().zip(&rebuilt.1).any(is_folded) {
            return self.copied(outputs);
        }
        Ok(rebuilt)
    }

    /// Makes the terms of a sum that is zero incomparable: one of them, preferably a short one, is
    /// taken out of its class with everything proportional to it on its path.
    fn part(
        &self,
        output: usize,
        values: &mut [Option<Values>],
        moduli: &[Modulus; FINGERPRINT_POINTS],
        short: &[bool],
    ) {
        let mut open = vec![output];
        while let Some(place) = open.pop() {
            if !values[place].is_some_and(|values| vanishes(&values)) {
                continue;
            }
            values[place] = None;
            let step = self.step(place);
            let vanishing = |place: &usize| values[*place].is_some_and(|values| vanishes(&values));
            let zeros: Vec<usize> = step.arguments().filter(vanishing).collect();
            if let (true, Step::Binary(_, a, b)) = (zeros.is_empty(), step) {
                let own = if short[a] && !short[b] { a } else { b };
                let Some(direction) = values[own] else { continue };
                let cone = self.reached_from(&[own]);
                for (value, _) in values.iter_mut().zip(cone).filter(|(_, needed)| *needed) {
                    if value.is_some_and(|value| are_proportional(&value, &direction, moduli)) {
                        *value = None;
                    }
                }
            }
            open.extend(zeros);
        }
    }

    /// Sorts the nodes into classes of proportional values; constants are multiples of 1.
    fn classes(
        &self,
        values: &[Option<Values>],
        moduli: &[Modulus; FINGERPRINT_POINTS],
    ) -> Vec<Member> {
        let inverse = |x: u64, lane: usize| (x != 0).then(|| moduli[lane].inverse(x));
        let direction = |values: &Values| -> Option<Values> {
            if vanishes(values) {
                return Some(std::array::from_fn(|lane| moduli[lane].one()));
            }
            let unit = [inverse(values[0], 0)?, inverse(values[HALF], HALF)?];
            Some(std::array::from_fn(|lane| moduli[lane].mul(values[lane], unit[lane / HALF])))
        };
        let factor = |own: &Values, other: &Values| -> Option<Rational> {
            let quotient =
                |lane: usize| Some(moduli[lane].mul(own[lane], inverse(other[lane], lane)?));
            let found = fraction(&moduli[0], quotient(0)?)?;
            (moduli[HALF].rational(&found) == Some(quotient(HALF)?)).then_some(found)
        };
        self.members(values, direction, factor)
    }

    /// Evaluates the reached nodes at points where the needed ones have values; `None` if too few
    /// such points were found.
    fn fingerprints(
        &self,
        moduli: &[Modulus; FINGERPRINT_POINTS],
        reached: &[bool],
        needed: &[bool],
        points: Option<&Points<'_>>,
    ) -> Option<Vec<Option<Values>>> {
        let domain = Fingerprint(Prime::new(*moduli));
        let mut found: Vec<Values> = vec![[UNDEFINED; FINGERPRINT_POINTS]; self.len()];
        let mut accepted = [0, HALF];
        for round in 0..TRIES {
            let inputs = points.map(|points| points.at(&domain, round)).unwrap_or_default();
            let input = |index: u32| match inputs.get(index as usize) {
                Some(values) => *values,
                None => domain.point(u64::from(index), round),
            };
            let values = self.values_at(&domain, reached, input);
            let mut defined = [true; FINGERPRINT_POINTS];
            for (values, _) in values.iter().zip(needed).filter(|(_, needed)| **needed) {
                for (defined, value) in defined.iter_mut().zip(values) {
                    *defined &= *value != UNDEFINED;
                }
            }
            for lane in 0..FINGERPRINT_POINTS {
                let place = &mut accepted[lane / HALF];
                if !defined[lane] || *place == (lane / HALF + 1) * HALF {
                    continue;
                }
                found.iter_mut().zip(&values).for_each(|(found, new)| found[*place] = new[lane]);
                *place += 1;
            }
            if accepted == [HALF, FINGERPRINT_POINTS] {
                let whole = |values: Values| (!values.contains(&UNDEFINED)).then_some(values);
                return Some(found.into_iter().map(whole).collect());
            }
        }
        None
    }

    /// Evaluates the reached nodes at one block of points.
    fn values_at(
        &self,
        domain: &Fingerprint,
        reached: &[bool],
        input: impl Fn(u32) -> Values,
    ) -> Vec<Values> {
        let constants: Vec<Values> =
            self.constants.iter().map(|value| domain.constant(value)).collect();
        let mut values: Vec<Values> = Vec::with_capacity(self.len());
        for (node, reached) in self.nodes.iter().zip(reached) {
            let mut value = [UNDEFINED; FINGERPRINT_POINTS];
            match *node {
                Node::Constant(index) => value = constants[index as usize],
                _ if !reached => {}
                Node::Input(index) => value = input(index),
                Node::Unary(function, a) => {
                    domain.unary(function, &values[a.0 as usize], &mut value);
                }
                Node::Binary(operation, a, b) => {
                    let (a, b) = (&values[a.0 as usize], &values[b.0 as usize]);
                    domain.binary(operation, a, b, &mut value);
                }
                Node::Power(a, exponent) => {
                    let exponent = &self.constants[exponent as usize];
                    domain.power(&values[a.0 as usize], exponent, &mut value);
                }
            }
            values.push(value);
        }
        values
    }
}

impl Points<'_> {
    /// Computes the inputs at one block of points.
    fn at(&self, domain: &Fingerprint, round: u64) -> Vec<Values> {
        let free = |index: u32| match self.signs.get(index as usize) {
            Some(true) => domain.sign(FREE + u64::from(index), round),
            _ => domain.point(FREE + u64::from(index), round),
        };
        let reached = self.graph.reached(self.inputs.iter().copied());
        let values = self.graph.values_at(domain, &reached, free);
        self.inputs.iter().map(|input| values[self.graph.place(*input)]).collect()
    }
}

fn vanishes(values: &Values) -> bool {
    values.iter().all(|x| *x == 0)
}

/// Whether xᵢyⱼ = xⱼyᵢ modulo each prime.
fn are_proportional(x: &Values, y: &Values, moduli: &[Modulus; FINGERPRINT_POINTS]) -> bool {
    moduli.iter().enumerate().all(|(lane, modulus)| {
        let first = lane / HALF * HALF;
        modulus.mul(x[lane], y[first]) == modulus.mul(x[first], y[lane])
    })
}

/// Returns two primes p = 3 mod 4 near 2^61, one for each half of the points.
fn moduli() -> [Modulus; FINGERPRINT_POINTS] {
    let mut primes = (0..).map(|k| (1u64 << 61) - 1 - 4 * k).filter(|p| is_prime(*p));
    let mut next = || Modulus::new(primes.next().unwrap_or((1 << 61) - 1));
    let both = [next(), next()];
    std::array::from_fn(|lane| both[lane / HALF])
}

/// Mixes two numbers into one.
fn mixed(a: u64, b: u64) -> u64 {
    scrambled(a.wrapping_mul(GOLDEN) ^ b)
}

/// Recovers the fraction with small parts whose image is x, by Euclid's algorithm (Wang 1981).
fn fraction(modulus: &Modulus, x: u64) -> Option<Rational> {
    let (mut r, mut s) = ([modulus.prime() as i64, modulus.to_integer(x) as i64], [0i64, 1i64]);
    while r[1] >= MOST_IN_FACTOR {
        let quotient = r[0] / r[1];
        (r, s) = (
            [r[1], r[0] - quotient * r[1]],
            [s[1], s[0].checked_sub(quotient.checked_mul(s[1])?)?],
        );
    }
    (s[1] != 0 && s[1].abs() < MOST_IN_FACTOR).then(|| Rational::new(r[1], s[1]))
}

/// Prime fields with random functions in place of the functions that fields lack.
struct Fingerprint(Prime<FINGERPRINT_POINTS>);

impl Fingerprint {
    /// Draws a random element for each lane.
    fn point(&self, input: u64, round: u64) -> Values {
        let moduli = self.0.moduli();
        let seed = mixed(input, round);
        std::array::from_fn(|lane| moduli[lane].integer(mixed(seed, lane as u64 + 1)))
    }

    /// Draws 1 or -1 for each lane.
    fn sign(&self, input: u64, round: u64) -> Values {
        let (seed, moduli) = (mixed(input, round), self.0.moduli());
        std::array::from_fn(|lane| match mixed(seed, lane as u64 + 1) & 1 {
            0 => moduli[lane].one(),
            _ => moduli[lane].sub(0, moduli[lane].one()),
        })
    }

    /// Evaluates function number `name` at x and y.
    fn random(&self, name: u64, x: &Values, y: &Values, out: &mut Values) {
        for (lane, modulus) in self.0.moduli().iter().enumerate() {
            out[lane] = match x[lane] == UNDEFINED || y[lane] == UNDEFINED {
                true => UNDEFINED,
                false => modulus.integer(mixed(mixed(x[lane], y[lane]), name)),
            };
        }
    }
}

impl Domain for Fingerprint {
    type Block = Values;

    fn constant(&self, value: &Rational) -> Values {
        self.0.constant(value)
    }

    fn values(&self, values: &[Rational]) -> Values {
        self.0.values(values)
    }

    fn unary(&self, function: UnaryFunction, x: &Values, out: &mut Values) {
        match function {
            UnaryFunction::Neg
            | UnaryFunction::Recip
            | UnaryFunction::Sqrt
            | UnaryFunction::Abs => {
                self.0.unary(function, x, out);
            }
            UnaryFunction::Exp => self.random(1, x, x, out),
            UnaryFunction::Ln => self.random(2, x, x, out),
            UnaryFunction::Sin => self.random(3, x, x, out),
            UnaryFunction::Cos => self.random(4, x, x, out),
            UnaryFunction::Atan => self.random(5, x, x, out),
        }
    }

    fn binary(&self, operation: BinaryOperation, x: &Values, y: &Values, out: &mut Values) {
        match operation {
            BinaryOperation::Pow => self.random(6, x, y, out),
            _ => self.0.binary(operation, x, y, out),
        }
    }

    fn power(&self, x: &Values, exponent: &Rational, out: &mut Values) {
        match exponent.to_integer() {
            Some(_) => self.0.power(x, exponent, out),
            None => self.random(6, x, &self.constant(exponent), out),
        }
    }
}
