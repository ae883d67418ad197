//! Zeros of an expression in a tower of square roots: those on every sheet over every point of a
//! small field are counted and compared with the bound on which proofs rest.
//!
//! Let y_j² = a_j be k roots over m inputs z, the radicands a_j polynomials in z and in earlier
//! roots; let z have weight 1 and y_j half the weight of a_j. If P has weight n and does not vanish
//! on a component of g_C sheets, then at most g_C·n·p^(m−1) pairs of a point and a sheet over it
//! are zeros of P.

use libtest_mimic::Failed;

use super::random::Stream;

/// An element a + b i of the field of p² elements, p = 3 mod 4.
type Element = [u64; 2];

#[derive(Clone, Copy)]
struct Field {
    p: u64,
}

impl Field {
    fn of(self, n: i64) -> Element {
        [n.rem_euclid(self.p as i64) as u64, 0]
    }

    fn add(self, x: Element, y: Element) -> Element {
        [(x[0] + y[0]) % self.p, (x[1] + y[1]) % self.p]
    }

    fn mul(self, x: Element, y: Element) -> Element {
        let p = self.p;
        [(x[0] * y[0] + (p - x[1]) * y[1]) % p, (x[0] * y[1] + x[1] * y[0]) % p]
    }

    fn neg(self, x: Element) -> Element {
        x.map(|part| (self.p - part) % self.p)
    }

    fn power(self, x: Element, mut n: u64) -> Element {
        let (mut result, mut square) = (self.of(1), x);
        while n > 0 {
            if n & 1 == 1 {
                result = self.mul(result, square);
            }
            square = self.mul(square, square);
            n >>= 1;
        }
        result
    }

    /// Computes a root of an element of the smaller field, preferring one that is itself a square;
    /// it may lie in the larger field.
    fn principal(self, a: u64) -> Element {
        let x = self.power([a, 0], self.p.div_ceil(4))[0];
        if x * x % self.p == a {
            return [x, 0];
        }
        let y = self.power([self.p - a, 0], self.p.div_ceil(4))[0];
        [0, y]
    }

    /// Computes a root, if the larger field contains one.
    fn root(self, x: Element) -> Option<Element> {
        let [a, b] = x;
        if b == 0 {
            return Some(self.principal(a));
        }
        // (u + v i)² = a + b i with u² = (a ± √(a² + b²))/2.
        let norm = (a * a + b * b) % self.p;
        let [length, off] = self.principal(norm);
        if off != 0 {
            return None;
        }
        let half = self.p.div_ceil(2);
        [length, self.p - length].into_iter().find_map(|length| {
            let [u, off] = self.principal((a + length) % self.p * half % self.p);
            if off != 0 || u == 0 {
                return None;
            }
            let v = b * half % self.p * self.power([u, 0], self.p - 2)[0] % self.p;
            Some([u, v])
        })
    }
}

/// A sum of monomials: coefficient, and exponents of inputs and roots.
#[derive(Clone, Debug)]
struct Polynomial(Vec<(i64, Vec<u32>)>);

impl Polynomial {
    fn random(stream: &mut Stream, weights: &[f64], most: f64, even: bool) -> Self {
        let mut terms = Vec::new();
        for _ in 0..2 + stream.below(3) {
            let mut exponents = vec![0; weights.len()];
            let mut left = most;
            for _ in 0..4 {
                let k = stream.below(weights.len());
                // Roots to the first power, so that a nonzero polynomial does not vanish in the
                // tower.
                let room = if k >= weights.len() { 0 } else { 3 };
                let is_root = weights[k] != 1.0 || even;
                if weights[k] <= left && exponents[k] < if is_root { 1 } else { room } {
                    exponents[k] += 1;
                    left -= weights[k];
                }
            }
            if !terms.iter().any(|(_, known)| *known == exponents) {
                terms.push((1 + stream.below(9) as i64, exponents));
            }
        }
        Self(terms)
    }

    fn weight(&self, weights: &[f64]) -> f64 {
        let term = |(_, exponents): &(i64, Vec<u32>)| -> f64 {
            exponents.iter().zip(weights).map(|(e, w)| f64::from(*e) * w).sum()
        };
        self.0.iter().map(term).fold(0.0, f64::max)
    }

    fn at(&self, field: Field, values: &[Element]) -> Element {
        self.0.iter().fold(field.of(0), |total, (coefficient, exponents)| {
            let term = exponents.iter().zip(values).fold(field.of(*coefficient), |term, (e, x)| {
                (0..*e).fold(term, |term, _| field.mul(term, *x))
            });
            field.add(total, term)
        })
    }
}

/// A tower of roots over some inputs.
struct Tower {
    field: Field,
    inputs: usize,
    radicands: Vec<Polynomial>,
}

/// Results of an enumeration of all sheets.
#[derive(Default)]
struct Count {
    /// Number of pairs of a point and a sheet at which the expression is 0.
    zeros: u64,
    /// For each root, whether its radicand is a non-square at some point where all earlier roots
    /// exist.
    refused: Vec<bool>,
}

impl Tower {
    fn weights(&self) -> Vec<f64> {
        let mut weights = vec![1.0; self.inputs];
        for radicand in &self.radicands {
            weights.push(radicand.weight(&weights) / 2.0);
        }
        weights
    }

    /// Visits the values on each sheet over an accepted point.
    fn sheets(&self, point: &[Element], refused: &mut [bool], visit: &mut dyn FnMut(&[Element])) {
        let mut values = point.to_vec();
        self.climb(&mut values, refused, visit);
    }

    fn climb(
        &self,
        values: &mut Vec<Element>,
        refused: &mut [bool],
        visit: &mut dyn FnMut(&[Element]),
    ) {
        let level = values.len() - self.inputs;
        let Some(radicand) = self.radicands.get(level) else {
            return visit(values);
        };
        let a = radicand.at(self.field, values);
        if a == [0, 0] {
            return;
        }
        // A non-square with everything in the smaller field: the root is independent of those
        // before it.
        let small = values.iter().all(|value| value[1] == 0);
        refused[level] |= small && a[1] == 0 && self.field.principal(a[0])[1] != 0;
        let Some(y) = self.field.root(a) else {
            // The same holds for a non-square of the larger field.
            refused[level] = true;
            return;
        };
        for y in [y, self.field.neg(y)] {
            values.push(y);
            self.climb(values, refused, visit);
            values.pop();
        }
    }

    fn count(&self, of: &Polynomial) -> Count {
        let mut count = Count { zeros: 0, refused: vec![false; self.radicands.len()] };
        let mut refused = count.refused.clone();
        for index in 0..self.field.p.pow(self.inputs as u32) {
            let point: Vec<Element> = (0..self.inputs)
                .map(|k| [index / self.field.p.pow(k as u32) % self.field.p, 0])
                .collect();
            self.sheets(&point, &mut refused, &mut |values| {
                count.zeros += u64::from(of.at(self.field, values) == [0, 0]);
            });
        }
        count.refused = refused;
        count
    }
}

/// Checks that the zeros of random expressions are within the bound, in random towers, nested ones
/// included.
pub fn random_towers() -> Result<(), Failed> {
    let (mut counted, mut nested, mut most) = (0, 0, 0f64);
    for index in 0..400 {
        let mut stream = Stream::new(2024, index);
        let stream = &mut stream;
        let inputs = 1 + usize::from(stream.once_in(4));
        let field = Field { p: if inputs == 1 { 1019 } else { 83 } };
        let mut tower = Tower { field, inputs, radicands: Vec::new() };
        for _ in 0..1 + stream.below(4) {
            let weights = tower.weights();
            let radicand = Polynomial::random(stream, &weights, 2.0, false);
            tower.radicands.push(radicand);
        }
        let weights = tower.weights();
        let of = Polynomial::random(stream, &weights, 4.0, false);
        let sheets = f64::from(1u32 << tower.radicands.len());
        let bound = sheets * of.weight(&weights);
        if bound >= field.p as f64 {
            continue;
        }
        let count = tower.count(&of);
        // Only towers whose roots are seen to be independent are counted.
        if !count.refused.iter().all(|refused| *refused) {
            continue;
        }
        counted += 1;
        nested += usize::from(tower.radicands.iter().any(|radicand| {
            radicand.0.iter().any(|(_, exponents)| {
                exponents[inputs.min(exponents.len())..].iter().any(|e| *e > 0)
            })
        }));
        let bound = bound * (field.p as f64).powi(inputs as i32 - 1);
        most = most.max(count.zeros as f64 / bound.max(1.0));
        if count.zeros as f64 > bound {
            let radicands = &tower.radicands;
            let zeros = count.zeros;
            return Err(Failed::from(format!(
                "{zeros} zeros, bound {bound}: {of:?} over {radicands:?}"
            )));
        }
    }
    match (counted, nested) {
        (100.., 30..) if most > 0.3 => Ok(()),
        _ => Err(Failed::from(format!(
            "{counted} towers, {nested} nested, at most {most:.2} of the bound"
        ))),
    }
}

/// Checks that Π(y_j − c_j) over y_j² = z + e_j attains the bound, and exceeds it if each root has
/// its principal value instead of a random sign.
pub fn principal_roots() -> Result<(), Failed> {
    let field = Field { p: 1019 };
    let shifts = [0, 7, 20, 101, 333];
    // A principal root is itself a square.
    let constants = shifts.map(|e: i64| field.power([(3 * e + 2) as u64, 0], 2));
    let linear = |e: i64| Polynomial(vec![(1, vec![1]), (e, vec![0])]);
    let tower = Tower { field, inputs: 1, radicands: shifts.iter().map(|e| linear(*e)).collect() };
    let product = |values: &[Element]| {
        let factors = values[1..].iter().zip(&constants).map(|(y, c)| field.add(*y, field.neg(*c)));
        factors.fold(field.of(1), |product, factor| field.mul(product, factor))
    };
    let (mut zeros, mut principal) = (0, 0);
    for z in 0..field.p {
        tower.sheets(&[[z, 0]], &mut [false; 5], &mut |values| {
            zeros += u64::from(product(values) == [0, 0]);
        });
        let radicands = shifts.map(|e| (z + e as u64) % field.p);
        if radicands.iter().all(|a| *a != 0) {
            let roots = radicands.map(|a| field.principal(a));
            let values: Vec<Element> = [[z, 0]].into_iter().chain(roots).collect();
            principal += u64::from(product(&values) == [0, 0]);
        }
    }
    let weight = shifts.len() as f64 / 2.0;
    match (zeros, principal) {
        (zeros, _) if zeros as f64 > 32.0 * weight => {
            Err(Failed::from(format!("{zeros} zeros on all sheets, above 32·{weight}")))
        }
        // Two of the factors may vanish at one pair, which counts once.
        (zeros, _) if (zeros as f64) < 0.9 * 32.0 * weight => {
            Err(Failed::from(format!("{zeros} zeros: the bound 32·{weight} should be met")))
        }
        (_, principal) if principal as f64 > weight => Ok(()),
        (_, principal) => Err(Failed::from(format!(
            "{principal} zeros on the principal sheet: no more than {weight}, so that signs are no matter"
        ))),
    }
}

/// Checks the components of √z and √(z (z+1)²): an expression that vanishes on one is within the
/// bound on the other.
pub fn dependent_roots() -> Result<(), Failed> {
    let field = Field { p: 1019 };
    let first = Polynomial(vec![(1, vec![1])]);
    let second = Polynomial(vec![(1, vec![3, 0]), (2, vec![2, 0]), (1, vec![1, 0])]);
    let tower = Tower { field, inputs: 1, radicands: vec![first, second] };
    let (mut all, mut beside, mut vanishing) = (0, 0, 0);
    for z in 0..field.p {
        tower.sheets(&[[z, 0]], &mut [false; 2], &mut |values| {
            let [z, y, w] = values[..] else { return };
            // Zero on the component w = (z + 1) y.
            let on = field.add(w, field.neg(field.mul(field.add(z, field.of(1)), y)));
            let of = field.mul(on, field.add(y, field.of(-5)));
            all += 1;
            vanishing += u64::from(on == [0, 0]);
            beside += u64::from(on != [0, 0] && of == [0, 0]);
        });
    }
    // (w − (z + 1) y)(y − 5) weighs 2, and each component has two sheets.
    let bound = 2 * 2;
    match (vanishing * 2 == all, (1..=bound).contains(&beside)) {
        (true, true) => Ok(()),
        _ => {
            Err(Failed::from(format!("{vanishing} of {all} on the component, {beside} beside it")))
        }
    }
}
