//! Reduced row echelon form modulo a prime, by substitution, built row by row.
//!
//! Each column with a pivot is expressed by columns without one, so that a row takes one substitution
//! for each of its entries, however many rows there were before. That pays where few columns lack a
//! pivot at any time, as with Taylor coefficients by increasing order: these columns are the initial
//! values of a solution. An expression in which a column has got a pivot since is brought up to date
//! when it is read.

use crate::echelon::bytes;
use liouville::number::prime::Modulus;

/// The columns that rows determine by other columns.
pub struct ReducedEchelon {
    modulus: Modulus,
    /// Expressions of the columns with pivots.
    expressions: Vec<Option<Expression>>,
    /// Whether a column occurs in an expression.
    occurs: Vec<bool>,
    /// Number of pivots found in columns that occurred in expressions.
    replaced: usize,
    sum: SparseSum,
    steps: u64,
    entries: usize,
}

/// A combination of columns.
#[derive(Clone, Default)]
struct Expression {
    columns: Box<[u32]>,
    values: Box<[u64]>,
    /// Number of replaced columns at which it was up to date.
    replaced: usize,
}

impl ReducedEchelon {
    /// Makes a form without rows.
    pub fn new(columns: usize, modulus: Modulus) -> Self {
        Self {
            modulus,
            expressions: vec![None; columns],
            occurs: vec![false; columns],
            replaced: 0,
            sum: SparseSum::new(columns),
            steps: 0,
            entries: 0,
        }
    }

    /// Adds a row, given by its columns and values; returns `false` if it depends on those before it.
    /// Its pivot is the first column in which it is not 0 once it is reduced.
    pub fn push(&mut self, row: &[(usize, u64)]) -> bool {
        let m = self.modulus;
        for (column, _) in row {
            self.refresh(*column);
        }
        for (column, value) in row {
            self.steps += 1;
            match &self.expressions[*column] {
                None => self.sum.add(&m, *value, &[*column as u32], &[m.one()]),
                Some(own) => {
                    self.steps += own.columns.len() as u64;
                    self.sum.add(&m, *value, &own.columns, &own.values);
                }
            }
        }
        let mut terms = self.sum.take(&m);
        let first = terms.iter().enumerate().min_by_key(|(_, (column, _))| *column);
        let Some(place) = first.map(|(place, _)| place) else { return false };
        let (pivot, value) = terms.swap_remove(place);
        let factor = m.sub(0, m.inverse(value));
        terms.iter_mut().for_each(|(_, value)| *value = m.mul(*value, factor));
        if self.occurs[pivot as usize] {
            self.replaced += 1;
        }
        self.set(pivot as usize, &terms);
        true
    }

    /// Brings the expression of a column up to date, if it has one.
    fn refresh(&mut self, column: usize) {
        // Each column waits for those it needs, which have got their pivots later.
        let mut waiting = vec![column];
        while let Some(column) = waiting.last().copied() {
            let m = self.modulus;
            let Some(own) = self.stale(column) else {
                waiting.pop();
                continue;
            };
            let (looked_at, needed) = (own.columns.len() as u64, waiting.len());
            let others = own.columns.iter().map(|other| *other as usize);
            waiting.extend(others.filter(|other| self.stale(*other).is_some()));
            self.steps += looked_at;
            if waiting.len() > needed {
                continue;
            }
            waiting.pop();
            let Some(mut own) = self.expressions[column].take() else { continue };
            self.entries -= own.columns.len() + 1;
            if own.columns.iter().all(|other| self.expressions[*other as usize].is_none()) {
                own.replaced = self.replaced;
                self.entries += own.columns.len() + 1;
                self.expressions[column] = Some(own);
                continue;
            }
            for (other, value) in own.columns.iter().zip(&own.values) {
                match &self.expressions[*other as usize] {
                    None => self.sum.add(&m, *value, &[*other], &[m.one()]),
                    Some(expression) => {
                        self.steps += expression.columns.len() as u64;
                        self.sum.add(&m, *value, &expression.columns, &expression.values);
                    }
                }
            }
            let terms = self.sum.take(&m);
            self.set(column, &terms);
        }
    }

    /// Returns the expression of a column that may not be up to date.
    fn stale(&self, column: usize) -> Option<&Expression> {
        self.expressions[column].as_ref().filter(|own| own.replaced != self.replaced)
    }

    fn set(&mut self, column: usize, terms: &[(u32, u64)]) {
        terms.iter().for_each(|(other, _)| self.occurs[*other as usize] = true);
        self.entries += terms.len() + 1;
        let (columns, values) = terms.iter().copied().unzip::<u32, u64, Vec<_>, Vec<_>>();
        let (columns, values) = (columns.into(), values.into());
        self.expressions[column] = Some(Expression { columns, values, replaced: self.replaced });
    }

    /// Number of entries that were looked at: the work, the same on every machine.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Number of bytes that the expressions take.
    pub fn bytes(&self) -> u64 {
        bytes(self.entries)
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.expressions.len()
    }

    /// Whether some row has its pivot in this column.
    pub fn has_pivot(&self, column: usize) -> bool {
        self.expressions[column].is_some()
    }
}

/// A sum of multiples of expressions. Its coefficients are sums of products that are reduced at the
/// end, or when a further product might not fit.
struct SparseSum {
    wide: Vec<u128>,
    is_touched: Vec<bool>,
    touched: Vec<u32>,
    /// Number of products that a coefficient may have got since it was reduced.
    pending: u64,
}

impl SparseSum {
    fn new(columns: usize) -> Self {
        Self {
            wide: vec![0; columns],
            is_touched: vec![false; columns],
            touched: Vec::new(),
            pending: 0,
        }
    }

    /// Adds the multiple of an expression without repeated columns.
    fn add(&mut self, m: &Modulus, factor: u64, columns: &[u32], values: &[u64]) {
        if self.pending == m.most_products() {
            for column in &self.touched {
                let sum = &mut self.wide[*column as usize];
                *sum = m.widened(m.reduced(*sum));
            }
            self.pending = 0;
        }
        self.pending += 1;
        let factor = u128::from(factor);
        for (column, value) in columns.iter().zip(values) {
            let place = *column as usize;
            if !self.is_touched[place] {
                self.is_touched[place] = true;
                self.touched.push(*column);
            }
            self.wide[place] =
                self.wide[place].wrapping_add(factor.wrapping_mul(u128::from(*value)));
        }
    }

    /// Returns the terms other than 0, in the order in which they were met, and clears the sum.
    fn take(&mut self, m: &Modulus) -> Vec<(u32, u64)> {
        self.pending = 0;
        let mut terms = Vec::with_capacity(self.touched.len());
        for column in self.touched.drain(..) {
            let place = column as usize;
            let value = m.reduced(std::mem::take(&mut self.wide[place]));
            self.is_touched[place] = false;
            if value != 0 {
                terms.push((column, value));
            }
        }
        terms
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::echelon::Echelon;

    fn modulus() -> Modulus {
        Modulus::new(2_305_843_009_213_693_951)
    }

    /// Pseudorandom numbers below a bound.
    struct Sequence(u64);

    impl Sequence {
        fn below(&mut self, bound: u64) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (self.0 >> 33) % bound
        }
    }

    /// Compares pivots with those of the other form, after each row.
    fn agree(columns: usize, rows: &[Vec<(usize, u64)>]) -> usize {
        let m = modulus();
        let (mut reduced, mut echelon) =
            (ReducedEchelon::new(columns, m), Echelon::new(columns, m));
        for (index, row) in rows.iter().enumerate() {
            let mut dense = vec![0; columns];
            row.iter().for_each(|(column, value)| dense[*column] = m.add(dense[*column], *value));
            assert_eq!(reduced.push(row), echelon.push(dense), "row {index} is new");
            for column in 0..columns {
                let has = echelon.has_pivot(column);
                assert_eq!(reduced.has_pivot(column), has, "row {index}, column {column}");
            }
        }
        (0..columns).filter(|column| reduced.has_pivot(*column)).count()
    }

    #[test]
    fn pivots_are_those_of_the_echelon_form() {
        let (m, mut sequence) = (modulus(), Sequence(3));
        let mut ranks = Vec::new();
        for round in 0..60 {
            let columns = 1 + sequence.below(60) as usize;
            let mut rows: Vec<Vec<(usize, u64)>> = Vec::new();
            for _ in 0..sequence.below(80) {
                let sum_of_two = rows.len() > 2 && sequence.below(3) == 0;
                let row = if sum_of_two {
                    let pick = |sequence: &mut Sequence| sequence.below(rows.len() as u64) as usize;
                    let (a, b) = (pick(&mut sequence), pick(&mut sequence));
                    let factor = m.integer(1 + sequence.below(9));
                    let scaled = rows[b].iter().map(|(column, x)| (*column, m.mul(factor, *x)));
                    rows[a].iter().copied().chain(scaled).collect()
                } else {
                    let number = sequence.below(if round % 2 == 0 { 4 } else { 40 });
                    let mut entry = || {
                        let column = sequence.below(columns as u64) as usize;
                        (column, m.integer(sequence.below(5)))
                    };
                    (0..number).map(|_| entry()).collect()
                };
                rows.push(row);
            }
            ranks.push(agree(columns, &rows) == columns);
        }
        assert!(ranks.contains(&true) && ranks.contains(&false), "full and lower rank");
    }

    #[test]
    fn long_chains_of_substitutions_are_followed() {
        let m = modulus();
        let (one, minus) = (m.one(), m.sub(0, m.one()));
        let columns = 20_000;
        let mut reduced = ReducedEchelon::new(columns, m);
        // x₀ = x₁, x₁ = x₂, …: each expression is out of date as soon as it is made.
        for k in 0..columns - 1 {
            assert!(reduced.push(&[(k, one), (k + 1, minus)]), "row {k} is new");
        }
        let last = columns - 1;
        assert!(!reduced.push(&[(0, one), (last, minus)]), "x₀ is the last");
        assert!(!reduced.push(&[(1, one), (last - 1, minus)]), "so are all");
        assert!(!reduced.has_pivot(last), "which is free");
        assert!(reduced.steps() < 20 * columns as u64, "{} steps", reduced.steps());
        assert!(reduced.push(&[(5, one)]), "all are 0");
        assert!(!reduced.push(&[(last / 2, one)]), "the one in the middle, too");
    }

    #[test]
    fn sums_of_many_products_do_not_overflow() {
        let m = modulus();
        let most = m.prime() - 1;
        let count = 200;
        let mut reduced = ReducedEchelon::new(count + 1, m);
        for k in 0..count {
            assert!(reduced.push(&[(k, most), (count, most)]), "row {k} is new");
        }
        // Each of the first columns is minus the last.
        let row: Vec<(usize, u64)> = (0..count).map(|k| (k, most)).collect();
        let total = m.mul(m.integer(count as u64), most);
        let closing = [row.clone(), vec![(count, total)]].concat();
        assert!(!reduced.push(&closing), "the sum of all rows");
        assert!(reduced.push(&row), "without its end it is new");
    }
}
