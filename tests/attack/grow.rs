//! Random expressions with many difficulties: roots of squares, of one-sided expressions, of
//! constants.

use super::expr::{
    Expr, Function, Tree, add, div, modulus, mul, of, power, ratio, root, square, sub, symbol,
    whole,
};
use super::random::Stream;
use super::scene::{Origin, Scene};

/// A generator of expressions in the symbols of a scene.
pub struct Garden<'a> {
    pub scene: &'a Scene,
    /// Symbols that may be used.
    pub symbols: Vec<usize>,
    /// Whether exp, log, sin, cos and atan may be used.
    pub functions: bool,
    /// Whether roots, moduli and fractional powers may be used.
    pub roots: bool,
}

impl<'a> Garden<'a> {
    /// Makes a generator with all symbols except chart inputs and parameters that tend to 0.
    pub fn new(scene: &'a Scene, stream: &mut Stream) -> Self {
        let usable = |place: &usize| {
            let symbol = &scene.symbols[*place];
            !matches!(symbol.origin, Origin::Input(..)) && symbol.name != "ε"
        };
        let symbols = (0..scene.symbols.len()).filter(usable).collect();
        Self { scene, symbols, functions: stream.once_in(12), roots: !stream.once_in(8) }
    }

    pub fn symbol(&self, stream: &mut Stream) -> Tree {
        symbol(*stream.pick(&self.symbols))
    }

    fn constant(&self, stream: &mut Stream) -> Tree {
        let numbers =
            [(1, 1), (2, 1), (3, 1), (1, 2), (-1, 1), (5, 1), (2, 3), (-3, 2), (7, 1), (1, 5)];
        let (top, bottom) = *stream.pick(&numbers);
        ratio(top, bottom)
    }

    /// Grows a small positive number.
    fn count(&self, stream: &mut Stream) -> Tree {
        whole(*stream.pick(&[1, 1, 2, 2, 3, 5]))
    }

    pub fn atom(&self, stream: &mut Stream) -> Tree {
        if stream.below(4) < 3 { self.symbol(stream) } else { self.constant(stream) }
    }

    /// Grows an expression of about this depth.
    pub fn tree(&self, stream: &mut Stream, depth: usize) -> Tree {
        if depth == 0 {
            return self.atom(stream);
        }
        let inner = |stream: &mut Stream| self.tree(stream, depth - 1);
        match stream.below(if self.roots { 24 } else { 13 }) {
            0..=3 => add(&inner(stream), &inner(stream)),
            4..=5 => sub(&inner(stream), &inner(stream)),
            6..=9 => mul(&inner(stream), &self.tree(stream, depth / 2)),
            10 => div(&inner(stream), &self.divisor(stream)),
            11 => power(&inner(stream), *stream.pick(&[2, 2, 3]), 1),
            12 if self.functions => self.function(stream, depth - 1),
            12 => self.atom(stream),
            13..=16 => root(&self.radicand(stream, depth - 1)),
            17..=19 => modulus(&inner(stream)),
            20..=21 => self.one_sided(stream),
            22 => {
                let (top, bottom) =
                    *stream.pick(&[(1, 2), (3, 2), (1, 4), (3, 4), (1, 3), (-1, 2), (5, 4)]);
                power(&self.radicand(stream, depth / 2), top, bottom)
            }
            _ => {
                let parts = [inner(stream), self.atom(stream), self.atom(stream)];
                std::rc::Rc::new(Expr::Norm(parts))
            }
        }
    }

    fn function(&self, stream: &mut Stream, depth: usize) -> Tree {
        use Function::{Atan, Cos, Exp, Log, Sin};
        let inner = self.tree(stream, depth.min(1));
        match *stream.pick(&[Exp, Exp, Log, Sin, Cos, Sin, Cos, Atan]) {
            Log => of(Log, &self.radicand(stream, depth.min(1))),
            function => of(function, &inner),
        }
    }

    /// Grows an expression that is seldom or never 0.
    fn divisor(&self, stream: &mut Stream) -> Tree {
        match stream.below(3) {
            0 => add(&whole(1), &square(&self.symbol(stream))),
            1 => self.symbol(stream),
            _ => add(&modulus(&self.symbol(stream)), &self.count(stream)),
        }
    }

    /// Grows an expression that has a root on a good part of the range.
    pub fn radicand(&self, stream: &mut Stream, depth: usize) -> Tree {
        let a = self.tree(stream, depth.min(1));
        let b = self.symbol(stream);
        match stream.below(16) {
            0 => self.symbol(stream),
            1 => add(&square(&a), &square(&b)),
            2 => add(&self.count(stream), &square(&a)),
            3 => mul(&b, &modulus(&b)),
            4..=5 => mul(&b, &self.one_sided(stream)),
            6 => self.one_sided(stream),
            7 => self.expanded_square(stream),
            8 => add(&b, &root(&self.expanded_square(stream))),
            9 => {
                let c = self.count(stream);
                let twice = mul(&mul(&whole(2), &c), &root(&b));
                add(&add(&b, &square(&c)), &twice)
            }
            10 => add(&self.symbol(stream), &self.number_root(stream)),
            11 => mul(&self.symbol(stream), &self.symbol(stream)),
            12 => div(&self.symbol(stream), &self.count(stream)),
            13 => add(&square(&self.one_sided(stream)), &self.symbol(stream)),
            14 => mul(&self.one_sided(stream), &self.one_sided(stream)),
            _ => self.tree(stream, depth),
        }
    }

    /// Grows an expanded square.
    fn expanded_square(&self, stream: &mut Stream) -> Tree {
        let a = self.symbol(stream);
        let b = if stream.once_in(2) { self.symbol(stream) } else { self.count(stream) };
        let cross = mul(&mul(&whole(2), &a), &b);
        let squares = [square(&a), square(&b)];
        match stream.once_in(2) {
            true => add(&add(&squares[0], &cross), &squares[1]),
            false => add(&sub(&squares[0], &cross), &squares[1]),
        }
    }

    /// Grows the root of a number, or of a number with a root.
    fn number_root(&self, stream: &mut Stream) -> Tree {
        let n = whole(*stream.pick(&[2, 3, 5, 6, 8, 12]));
        match stream.below(4) {
            0 => root(&sub(&whole(3), &mul(&whole(2), &root(&whole(2))))),
            1 => root(&sub(&whole(5), &mul(&whole(2), &root(&whole(6))))),
            2 => sub(&root(&whole(3)), &root(&whole(2))),
            _ => root(&n),
        }
    }

    /// Grows an expression that is never negative and vanishes on a part of the range, or the
    /// maximum of two.
    pub fn one_sided(&self, stream: &mut Stream) -> Tree {
        let a = match stream.below(5) {
            0 => sub(&self.symbol(stream), &self.atom(stream)),
            1 => mul(&self.symbol(stream), &self.symbol(stream)),
            _ => self.symbol(stream),
        };
        match stream.below(7) {
            0 => add(&a, &modulus(&a)),
            1 => sub(&modulus(&a), &a),
            2 => modulus(&add(&a, &modulus(&a))),
            3 => add(&root(&square(&a)), &a),
            4 => root(&add(&a, &modulus(&a))),
            5 => add(&modulus(&a), &modulus(&modulus(&a))),
            _ => {
                let c = self.atom(stream);
                div(&add(&add(&a, &c), &modulus(&sub(&a, &c))), &whole(2))
            }
        }
    }
}
