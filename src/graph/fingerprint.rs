//! Values of nodes at random points of prime fields, by which equal ones are found.
//!
//! Two rational values that differ agree at all 64 points with a probability below (d/2^60)^64, d
//! their degree. √x is the root that is a square itself: √x √y = √(xy) is seen, and √(x²) = x is not,
//! since x is no square at half of the points. A point at which some root does not exist is drawn
//! anew. exp, sin and the like are random functions: equal for equal arguments, and nothing else.
//!
//! For measuring only. A proof, and whoever bounds rounding, run what was recorded.

use super::merge::Member;
use super::{Expr, Fault, Graph, Node, Step};
use crate::number::prime::{Modulus, Prime, UNDEFINED, is_prime};
use crate::number::rational::Rational;
use crate::number::{Domain, Function, Operation};

/// Points, half of them modulo each of two primes.
const POINTS: usize = 64;
const HALF: usize = POINTS / 2;
/// Blocks of points that are tried: enough for four independent roots.
const TRIES: u64 = 48;
/// Numerators and denominators of factors are below: then one prime tells them, and the other agrees
/// by chance with a probability of 2^-61.
const MOST_IN_FACTOR: i64 = 1 << 29;

type Values = [u64; POINTS];

impl Graph {
    /// The outputs from fewer operations, in a graph of their own: nodes of proportional value are
    /// one node. Exact, up to the probability above, wherever the outputs have values.
    ///
    /// An output that is constant but was not folded is left as it was recorded, with all it needs:
    /// nothing comes out exact that is not computed.
    pub fn merged(&self, outputs: &[Expr]) -> Result<(Graph, Vec<Expr>), Fault> {
        let moduli = moduli();
        let Some(mut values) = self.fingerprints(&moduli, outputs) else {
            return self.copied(outputs);
        };
        let is_constant = |values: &Values| {
            values[..HALF].iter().all(|x| *x == values[0])
                && values[HALF..].iter().all(|x| *x == values[HALF])
        };
        let unfolded = outputs.iter().filter(|output| {
            let values = values[self.place(**output)].as_ref();
            self.constant_value(**output).is_none() && values.is_some_and(is_constant)
        });
        for (place, kept) in self.reached(unfolded.copied()).into_iter().enumerate() {
            if kept {
                values[place] = None;
            }
        }
        let inverse = |x: u64, lane: usize| (x != 0).then(|| moduli[lane].inverse(x));
        let direction = |values: &Values| -> Option<Values> {
            if values.iter().all(|x| *x == 0) {
                // A multiple of 1.
                return Some(std::array::from_fn(|lane| moduli[lane].one()));
            }
            let unit = [inverse(values[0], 0)?, inverse(values[HALF], HALF)?];
            Some(std::array::from_fn(|lane| moduli[lane].mul(values[lane], unit[lane / HALF])))
        };
        let factor = |own: &Values, other: &Values| -> Option<Rational> {
            let quotient = |lane: usize| {
                Some(moduli[lane].mul(own[lane], inverse(other[lane], lane)?))
            };
            let found = fraction(&moduli[0], quotient(0)?)?;
            (moduli[HALF].rational(&found) == Some(quotient(HALF)?)).then_some(found)
        };
        let members: Vec<Member> = self.members(&values, direction, factor);
        self.rebuilt(outputs, &members)
    }

    /// The values of all nodes at points where the outputs have values; `None` if too few were found.
    fn fingerprints(
        &self,
        moduli: &[Modulus; POINTS],
        outputs: &[Expr],
    ) -> Option<Vec<Option<Values>>> {
        let reached = self.reached(outputs.iter().copied());
        let domain = Fingerprint(Prime::new(*moduli));
        let mut found: Vec<Values> = vec![[UNDEFINED; POINTS]; self.len()];
        let mut accepted = [0, HALF];
        for round in 0..TRIES {
            let values = self.values_at(&domain, round);
            for lane in 0..POINTS {
                let place = &mut accepted[lane / HALF];
                let is_full = *place == (lane / HALF + 1) * HALF;
                let mut needed = values.iter().zip(&reached).filter(|(_, reached)| **reached);
                if is_full || needed.any(|(values, _)| values[lane] == UNDEFINED) {
                    continue;
                }
                found.iter_mut().zip(&values).for_each(|(found, new)| found[*place] = new[lane]);
                *place += 1;
            }
            if accepted == [HALF, POINTS] {
                let whole = |values: Values| (!values.contains(&UNDEFINED)).then_some(values);
                return Some(found.into_iter().map(whole).collect());
            }
        }
        None
    }

    /// The values of all nodes at one block of points.
    fn values_at(&self, domain: &Fingerprint, round: u64) -> Vec<Values> {
        let constants: Vec<Values> =
            self.constants.iter().map(|value| domain.constant(value)).collect();
        let mut values: Vec<Values> = Vec::with_capacity(self.len());
        for node in &self.nodes {
            let mut value = [UNDEFINED; POINTS];
            match *node {
                Node::Constant(index) => value = constants[index as usize],
                Node::Input(input) => value = domain.point(u64::from(input), round),
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

/// Two primes p = 3 mod 4 near 2^61, one for each half of the points.
fn moduli() -> [Modulus; POINTS] {
    let mut primes = (0..).map(|k| (1u64 << 61) - 1 - 4 * k).filter(|p| is_prime(*p));
    let mut next = || Modulus::new(primes.next().unwrap_or((1 << 61) - 1));
    let both = [next(), next()];
    std::array::from_fn(|lane| both[lane / HALF])
}

/// A well mixed number that depends on both (Steele, Lea, Flood 2014: SplitMix64).
fn mixed(a: u64, b: u64) -> u64 {
    let mut z = a.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ b;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// The fraction with small parts that x is the image of, by Euclid's algorithm (Wang 1981).
fn fraction(modulus: &Modulus, x: u64) -> Option<Rational> {
    let (mut r, mut s) = ([modulus.prime() as i64, modulus.to_integer(x) as i64], [0i64, 1i64]);
    while r[1] >= MOST_IN_FACTOR {
        let quotient = r[0] / r[1];
        (r, s) = ([r[1], r[0] - quotient * r[1]], [s[1], s[0].checked_sub(quotient.checked_mul(s[1])?)?]);
    }
    (s[1] != 0 && s[1].abs() < MOST_IN_FACTOR).then(|| Rational::new(r[1], s[1]))
}

/// Prime fields in which a function that they do not have is a random function.
struct Fingerprint(Prime<POINTS>);

impl Fingerprint {
    /// A random element for each lane.
    fn point(&self, input: u64, round: u64) -> Values {
        let moduli = self.0.moduli();
        let seed = mixed(input, round);
        std::array::from_fn(|lane| moduli[lane].integer(mixed(seed, lane as u64 + 1)))
    }

    /// The value of function number `name` at x and y.
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

    fn unary(&self, function: Function, x: &Values, out: &mut Values) {
        match function {
            Function::Neg | Function::Recip | Function::Sqrt | Function::Abs => {
                self.0.unary(function, x, out);
            }
            Function::Exp => self.random(1, x, x, out),
            Function::Ln => self.random(2, x, x, out),
            Function::Sin => self.random(3, x, x, out),
            Function::Cos => self.random(4, x, x, out),
            Function::Atan => self.random(5, x, x, out),
        }
    }

    fn binary(&self, operation: Operation, x: &Values, y: &Values, out: &mut Values) {
        match operation {
            Operation::Pow => self.random(6, x, y, out),
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
