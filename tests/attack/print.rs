//! Expressions and systems in the language of case files, in one of several notations.

use super::expr::{Expr, Function, Number, Tree};
use super::scene::{Origin, Scene, Symbol};

/// Binding strength of the text of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Hold {
    Sum,
    Product,
    Prefix,
    Power,
    Atom,
}

/// A notation of formulas: the bits choose among equivalent signs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hand(pub u8);

impl Hand {
    fn long(self) -> bool {
        self.0 & 1 != 0
    }

    fn ascii(self) -> bool {
        self.0 & 2 != 0
    }

    fn raised(self) -> bool {
        self.0 & 4 != 0
    }

    /// Writes an expression.
    pub fn text(self, tree: &Tree, names: &[String]) -> String {
        self.written(tree, names).0
    }

    fn within(self, tree: &Tree, names: &[String], least: Hold) -> String {
        let (text, hold) = self.written(tree, names);
        if hold >= least { text } else { format!("({text})") }
    }

    fn written(self, tree: &Tree, names: &[String]) -> (String, Hold) {
        let minus = if self.ascii() { "-" } else { "−" };
        let pair = |a: &Tree, sign: &str, b: &Tree, left: Hold, right: Hold, hold: Hold| {
            (format!("{}{sign}{}", self.within(a, names, left), self.within(b, names, right)), hold)
        };
        match &**tree {
            Expr::Number(number) => self.number(*number),
            Expr::Symbol(place) => (names[*place].clone(), Hold::Atom),
            Expr::Neg(a) => {
                (format!("{minus}{}", self.within(a, names, Hold::Power)), Hold::Prefix)
            }
            Expr::Add(a, b) => pair(a, " + ", b, Hold::Sum, Hold::Product, Hold::Sum),
            Expr::Sub(a, b) => {
                pair(a, &format!(" {minus} "), b, Hold::Sum, Hold::Product, Hold::Sum)
            }
            Expr::Mul(a, b) => pair(a, "*", b, Hold::Product, Hold::Power, Hold::Product),
            Expr::Div(a, b) => pair(a, "/", b, Hold::Product, Hold::Power, Hold::Product),
            Expr::Power(a, 2, 1) if self.raised() => {
                (format!("{}²", self.within(a, names, Hold::Atom)), Hold::Power)
            }
            Expr::Power(a, top, bottom) => {
                let base = self.within(a, names, Hold::Atom);
                let exponent = match (top, bottom) {
                    (n, 1) if *n >= 0 => n.to_string(),
                    (n, 1) => format!("({minus}{})", n.unsigned_abs()),
                    (n, d) if *n >= 0 => format!("({n}/{d})"),
                    (n, d) => format!("({minus}{}/{d})", n.unsigned_abs()),
                };
                (format!("{base}^{exponent}"), Hold::Power)
            }
            Expr::PowerTo(a, b) => {
                let base = self.within(a, names, Hold::Atom);
                (format!("{base}^{}", self.within(b, names, Hold::Atom)), Hold::Power)
            }
            Expr::Of(function, a) => self.of(*function, a, names),
            Expr::Norm(parts) => {
                let parts = parts.each_ref().map(|part| self.text(part, names));
                (format!("|[{}]|", parts.join(", ")), Hold::Atom)
            }
        }
    }

    fn of(self, function: Function, a: &Tree, names: &[String]) -> (String, Hold) {
        let inner = self.text(a, names);
        let text = match function {
            Function::Root if self.long() => format!("sqrt({inner})"),
            Function::Root => {
                let inner = self.within(a, names, Hold::Atom);
                return (format!("√{inner}"), Hold::Prefix);
            }
            Function::Modulus if self.long() => format!("abs({inner})"),
            Function::Modulus => format!("|{inner}|"),
            Function::Exp => format!("exp({inner})"),
            Function::Log => format!("log({inner})"),
            Function::Sin => format!("sin({inner})"),
            Function::Cos => format!("cos({inner})"),
            Function::Atan => format!("atan({inner})"),
        };
        (text, Hold::Atom)
    }

    fn number(self, number: Number) -> (String, Hold) {
        let minus = if self.ascii() { "-" } else { "−" };
        let sign = if number.top < 0 { minus } else { "" };
        let top = number.top.unsigned_abs();
        let tens = if number.tens == 0 { String::new() } else { format!("e{}", number.tens) };
        match number.bottom {
            1 if number.top < 0 => (format!("{sign}{top}{tens}"), Hold::Prefix),
            1 => (format!("{top}{tens}"), Hold::Atom),
            bottom => (format!("{sign}{top}{tens}/{bottom}"), Hold::Product),
        }
    }
}

impl Scene {
    /// Writes the case file with these claims, each the body of a table.
    pub fn text(&self, claims: &[String], hand: Hand) -> String {
        let names = self.names();
        let quoted = |tree: &Tree| format!("\"{}\"", hand.text(tree, &names));
        let plain = |n: &Number| Hand(2).text(&std::rc::Rc::new(Expr::Number(*n)), &names);
        let range = |a: &Number, b: &Number| format!("\"{}..{}\"", plain(a), plain(b));
        let mut text = String::from("title = \"t\"\n");
        let parameter = |symbol: &Symbol| match &symbol.origin {
            Origin::Range(a, b) => Some(range(a, b)),
            Origin::Fixed(n) => Some(format!("\"{}\"", plain(n))),
            Origin::List(list) => {
                let list: Vec<String> = list.iter().map(plain).collect();
                Some(format!("\"one of {}\"", list.join(", ")))
            }
            Origin::Formula(tree) => Some(quoted(tree)),
            Origin::State(..) | Origin::Input(..) => None,
        };
        let parameters: Vec<(&String, String)> = self
            .symbols
            .iter()
            .filter_map(|symbol| Some((&symbol.name, parameter(symbol)?)))
            .collect();
        if !parameters.is_empty() {
            text.push_str("[parameters]\n");
        }
        for (name, value) in parameters {
            text.push_str(&format!("\"{name}\" = {value}\n"));
        }
        text.push_str("[state]\n");
        for symbol in &self.symbols {
            if let Origin::State(a, b) = &symbol.origin {
                text.push_str(&format!("{} = {}\n", symbol.name, range(a, b)));
            }
        }
        text.push_str("[field]\n");
        for place in self.states() {
            let rate = self.rate(place).map_or("\"0\"".to_string(), quoted);
            text.push_str(&format!("\"{}'\" = {rate}\n", names[place]));
        }
        if let Some(level) = &self.level {
            let side = |(a, b): &(Tree, Tree)| {
                format!("\"{} = {}\"", hand.text(a, &names), hand.text(b, &names))
            };
            let equations: Vec<String> = level.equations.iter().map(side).collect();
            text.push_str(&format!("[level]\nequations = [{}]\n", equations.join(", ")));
            if let Some(chart) = &level.chart {
                let input = |symbol: &Symbol| match &symbol.origin {
                    Origin::Input(a, b) => Some(format!("{} = {}", symbol.name, range(a, b))),
                    _ => None,
                };
                let inputs: Vec<String> = self.symbols.iter().filter_map(input).collect();
                text.push_str(&format!("[level.chart]\ninputs = {{ {} }}\n", inputs.join(", ")));
                for (place, tree) in chart {
                    text.push_str(&format!("{} = {}\n", names[*place], quoted(tree)));
                }
            }
        }
        for claim in claims {
            text.push_str(&format!("[[claim]]\n{claim}\nexpect = \"open\"\n"));
        }
        text
    }
}
