//! Numbers of true claims proved, by the constructs they contain.

use std::collections::BTreeMap;

use super::claim::Claim;
use super::expr::{Expr, Function, Tree};
use super::scene::{Origin, Scene};
use super::wrong::Truth;

/// Names the constructs of a claim.
pub fn constructs(scene: &Scene, claim: &Claim) -> Vec<&'static str> {
    let trees = claim.trees();
    let any = |test: &mut dyn FnMut(&Expr) -> bool| trees.iter().any(|tree| tree.any(test));
    let is_root = |node: &Expr| matches!(node, Expr::Of(Function::Root, _));
    let is_modulus = |node: &Expr| matches!(node, Expr::Of(Function::Modulus, _));
    let nested = |tree: &Tree| tree.parts().iter().any(|part| part.any(&mut |node| is_root(node)));
    let mut found = vec![claim.kind()];
    let mut note = |is: bool, name: &'static str| {
        if is {
            found.push(name);
        }
    };
    let roots = any(&mut |node| is_root(node) || matches!(node, Expr::Norm(_)));
    let moduli = any(&mut |node| is_modulus(node));
    let powers = any(&mut |node| matches!(node, Expr::Power(_, _, bottom) if *bottom > 2));
    let functions = any(&mut |node| match node {
        Expr::Of(function, _) => !matches!(function, Function::Root | Function::Modulus),
        Expr::PowerTo(..) => true,
        _ => false,
    });
    note(!roots && !moduli && !powers && !functions, "rational");
    note(roots, "√");
    note(
        any(&mut |node| matches!(node, Expr::Of(Function::Root, a) if is_root(a) || nested(a))),
        "√ in √",
    );
    note(
        any(
            &mut |node| matches!(node, Expr::Of(Function::Root, a) if a.any(&mut |node| is_modulus(node))),
        ),
        "|·| in √",
    );
    note(
        any(
            &mut |node| matches!(node, Expr::Of(Function::Root, a) if !a.any(&mut |node| matches!(node, Expr::Symbol(_)))),
        ),
        "√ of a number",
    );
    note(moduli, "|·|");
    note(
        any(
            &mut |node| matches!(node, Expr::Of(Function::Modulus, a) if a.any(&mut |node| is_modulus(node))),
        ),
        "|·| in |·|",
    );
    note(powers, "x^(p/q), q > 2");
    note(functions, "exp, log, sin, cos, atan, x^y");
    note(any(&mut |node| matches!(node, Expr::Number(n) if n.tens < 0)), "10^-3 … 10^-40");
    note(any(&mut |node| matches!(node, Expr::Norm(_))), "|[a, b, c]|");
    let origins = || scene.symbols.iter().map(|symbol| &symbol.origin);
    note(origins().any(|origin| matches!(origin, Origin::List(_))), "a list of values");
    note(origins().any(|origin| matches!(origin, Origin::Formula(_))), "a parameter by a formula");
    if let Some(level) = &scene.level {
        let name = match (level.chart.is_some(), level.equations.len(), level.branches.len()) {
            (true, _, _) => "level with a chart",
            (_, 2.., _) => "two linear equations",
            (_, _, 0) => "level without points",
            (_, _, 1) => "level, a graph",
            _ => "level of several branches",
        };
        note(true, name);
    }
    found
}

/// Verdicts on claims of the same truth, by construct.
#[derive(Clone, Debug, Default)]
pub struct Table {
    rows: BTreeMap<(Truth, &'static str), BTreeMap<&'static str, usize>>,
}

impl Table {
    /// Counts a claim.
    pub fn note(&mut self, constructs: &[&'static str], truth: Truth, word: &'static str) {
        for name in constructs.iter().chain(&["all"]) {
            *self.rows.entry((truth, name)).or_default().entry(word).or_default() += 1;
        }
    }

    /// Writes the table.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let words = ["proved", "confirmed", "undecided", "refuted", "error"];
        for (truth, title) in [
            (Truth::Holds, "claims that hold"),
            (Truth::Fails, "claims that fail"),
            (Truth::Void, "claims without a value anywhere"),
            (Truth::Unsure, "claims that the oracle leaves open"),
        ] {
            text.push_str(&format!("\n{title:<32}{:>8}", "claims"));
            for word in words {
                text.push_str(&format!("{word:>11}"));
            }
            text.push('\n');
            let own = self.rows.iter().filter(|((own, _), _)| *own == truth);
            for ((_, name), row) in own {
                let total: usize = row.values().sum();
                text.push_str(&format!("  {name:<30}{total:>8}"));
                for word in words {
                    let share = 100.0 * row.get(word).copied().unwrap_or(0) as f64 / total as f64;
                    text.push_str(&format!("{share:>9.1} %"));
                }
                text.push('\n');
            }
        }
        text
    }
}
