//! Expressions of the attack, with separate growth, rewriting, evaluation and printing.

use std::rc::Rc;

/// A number `top/bottom · 10^tens`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Number {
    pub top: i64,
    pub bottom: i64,
    pub tens: i32,
}

/// A function of one variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    Root,
    Modulus,
    Exp,
    Log,
    Sin,
    Cos,
    Atan,
}

/// A shared expression.
pub type Tree = Rc<Expr>;

/// An expression in the symbols of a scene.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Expr {
    Number(Number),
    /// A state variable or a parameter, by its index in the scene.
    Symbol(usize),
    Neg(Tree),
    Add(Tree, Tree),
    Sub(Tree, Tree),
    Mul(Tree, Tree),
    Div(Tree, Tree),
    /// A power with a rational exponent `top/bottom`.
    Power(Tree, i64, i64),
    /// A power with any exponent.
    PowerTo(Tree, Tree),
    Of(Function, Tree),
    /// The norm of a vector.
    Norm([Tree; 3]),
}

/// Makes `top/bottom`.
pub fn ratio(top: i64, bottom: i64) -> Tree {
    Rc::new(Expr::Number(Number { top, bottom, tens: 0 }))
}

/// Makes an integer.
pub fn whole(n: i64) -> Tree {
    ratio(n, 1)
}

/// Makes `10^tens`.
pub fn ten_to(tens: i32) -> Tree {
    Rc::new(Expr::Number(Number { top: 1, bottom: 1, tens }))
}

pub fn symbol(place: usize) -> Tree {
    Rc::new(Expr::Symbol(place))
}

pub fn neg(a: &Tree) -> Tree {
    Rc::new(Expr::Neg(a.clone()))
}

pub fn add(a: &Tree, b: &Tree) -> Tree {
    Rc::new(Expr::Add(a.clone(), b.clone()))
}

pub fn sub(a: &Tree, b: &Tree) -> Tree {
    Rc::new(Expr::Sub(a.clone(), b.clone()))
}

pub fn mul(a: &Tree, b: &Tree) -> Tree {
    Rc::new(Expr::Mul(a.clone(), b.clone()))
}

pub fn div(a: &Tree, b: &Tree) -> Tree {
    Rc::new(Expr::Div(a.clone(), b.clone()))
}

/// Makes a power with the exponent in lowest terms, so that 2/2 is 1.
pub fn power(a: &Tree, top: i64, bottom: i64) -> Tree {
    let common = divisor(top.abs(), bottom).max(1);
    Rc::new(Expr::Power(a.clone(), top / common, bottom / common))
}

/// Computes the greatest common divisor.
fn divisor(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { divisor(b, a % b) }
}

pub fn square(a: &Tree) -> Tree {
    power(a, 2, 1)
}

pub fn of(function: Function, a: &Tree) -> Tree {
    Rc::new(Expr::Of(function, a.clone()))
}

pub fn root(a: &Tree) -> Tree {
    of(Function::Root, a)
}

pub fn modulus(a: &Tree) -> Tree {
    of(Function::Modulus, a)
}

impl Expr {
    /// Returns the parts of an expression, in order.
    pub fn parts(&self) -> Vec<&Tree> {
        match self {
            Expr::Number(_) | Expr::Symbol(_) => Vec::new(),
            Expr::Neg(a) | Expr::Power(a, _, _) | Expr::Of(_, a) => vec![a],
            Expr::Add(a, b)
            | Expr::Sub(a, b)
            | Expr::Mul(a, b)
            | Expr::Div(a, b)
            | Expr::PowerTo(a, b) => vec![a, b],
            Expr::Norm(parts) => parts.iter().collect(),
        }
    }

    /// Makes the same expression with other parts.
    pub fn with_parts(&self, parts: &[Tree]) -> Expr {
        let part = |k: usize| parts[k].clone();
        match self {
            Expr::Number(_) | Expr::Symbol(_) => self.clone(),
            Expr::Neg(_) => Expr::Neg(part(0)),
            Expr::Power(_, top, bottom) => Expr::Power(part(0), *top, *bottom),
            Expr::Of(function, _) => Expr::Of(*function, part(0)),
            Expr::Add(..) => Expr::Add(part(0), part(1)),
            Expr::Sub(..) => Expr::Sub(part(0), part(1)),
            Expr::Mul(..) => Expr::Mul(part(0), part(1)),
            Expr::Div(..) => Expr::Div(part(0), part(1)),
            Expr::PowerTo(..) => Expr::PowerTo(part(0), part(1)),
            Expr::Norm(_) => Expr::Norm([part(0), part(1), part(2)]),
        }
    }

    /// Number of nodes.
    pub fn size(&self) -> usize {
        1 + self.parts().iter().map(|part| part.size()).sum::<usize>()
    }

    /// Whether some node satisfies a test.
    pub fn any(&self, test: &mut dyn FnMut(&Expr) -> bool) -> bool {
        test(self) || self.parts().iter().any(|part| part.any(test))
    }

    /// Whether the symbol occurs.
    pub fn has(&self, place: usize) -> bool {
        self.any(&mut |node| matches!(node, Expr::Symbol(found) if *found == place))
    }

    /// Whether the expression is this number.
    pub fn is(&self, n: i64) -> bool {
        matches!(self, Expr::Number(x) if x.tens == 0 && x.bottom == 1 && x.top == n)
    }
}

/// Returns node `index` in preorder.
pub fn node(tree: &Tree, index: usize) -> Option<Tree> {
    let mut left = index;
    find(tree, &mut left)
}

fn find(tree: &Tree, left: &mut usize) -> Option<Tree> {
    if *left == 0 {
        return Some(tree.clone());
    }
    *left -= 1;
    tree.parts().into_iter().find_map(|part| find(part, left))
}

/// Replaces node `index` in preorder.
pub fn replaced(tree: &Tree, index: usize, by: &Tree) -> Tree {
    let mut left = index as isize;
    replace(tree, &mut left, by)
}

fn replace(tree: &Tree, left: &mut isize, by: &Tree) -> Tree {
    *left -= 1;
    if *left == -1 {
        return by.clone();
    }
    if *left < 0 || tree.parts().is_empty() {
        return tree.clone();
    }
    let parts: Vec<Tree> = tree.parts().into_iter().map(|part| replace(part, left, by)).collect();
    Rc::new(tree.with_parts(&parts))
}

/// Replaces each symbol.
pub fn substituted(tree: &Tree, by: &dyn Fn(usize) -> Tree) -> Tree {
    if let Expr::Symbol(place) = **tree {
        return by(place);
    }
    if tree.parts().is_empty() {
        return tree.clone();
    }
    let parts: Vec<Tree> = tree.parts().into_iter().map(|part| substituted(part, by)).collect();
    Rc::new(tree.with_parts(&parts))
}
