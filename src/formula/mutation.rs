//! Perturbed formulas: each mutant is the text with one change, read again.
//!
//! Changes affect coefficients (one more, the negative, a near miss by a relative 2⁻⁵⁰, a doubled
//! term), signs, exponents, terms and factors (dropped), quotients (inverted), arguments (swapped)
//! and names (a tensor, a vector or a scalar for another). A mutant that cannot be read, has
//! another type, or equals the original is left out.

use super::Formula;
use super::arena::{ElementaryFunction, Extreme, NodeId, NodeOperation};
use super::kind::Type;
use super::scope::Scope;
use crate::number::rational::Rational;

/// Limit on the mutants of one formula; of more, an evenly spaced selection is taken.
const MOST_MUTANTS: usize = 60;
/// The factor 1 + 2⁻⁵⁰.
const NEAR_ONE: &str = "1125899906842625/1125899906842624";
/// Number of replacements tried for each use of a name.
const MOST_NAMES: usize = 3;

/// A formula with one change.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// Changed formula.
    pub formula: Formula,
    /// Description of the change, e.g. `2 → 3`.
    pub change: String,
}

impl Formula {
    /// All mutants, in the order of the text; at most 60.
    pub fn mutants(&self, scope: &dyn Scope) -> Vec<Mutant> {
        let mut edits = Vec::new();
        for node in self.written_nodes() {
            self.edits_of(node, scope, &mut edits);
        }
        let mut mutants: Vec<Mutant> = Vec::new();
        let stripped =
            |formula: &Formula| formula.text.split_whitespace().collect::<Vec<_>>().concat();
        let mut known = vec![stripped(self)];
        for edit in edits {
            let Ok(formula) = Formula::parse(&edit.text, scope) else { continue };
            let text = stripped(&formula);
            let same =
                formula.operations().eq(self.operations()) && formula.symbols().eq(self.symbols());
            if formula.value_type() == self.value_type() && !same && !known.contains(&text) {
                known.push(text);
                mutants.push(Mutant { formula, change: edit.change });
            }
        }
        let step = mutants.len().div_ceil(MOST_MUTANTS).max(1);
        mutants.into_iter().step_by(step).collect()
    }

    /// Nodes that stand in the text: all but those that make up a derivative.
    fn written_nodes(&self) -> Vec<NodeId> {
        let mut hidden = vec![false; self.arena.nodes.len()];
        for (node, own) in self.arena.nodes.iter().enumerate() {
            if let NodeOperation::Partial { by, .. } = own.operation {
                hidden[by + 1..node].fill(true);
            }
        }
        (0..hidden.len()).filter(|node| !hidden[*node]).collect()
    }

    fn operations(&self) -> impl Iterator<Item = &NodeOperation> {
        self.arena.nodes.iter().map(|node| &node.operation)
    }

    fn part(&self, node: NodeId) -> &str {
        self.text.get(self.arena.nodes[node].span.clone()).unwrap_or("")
    }

    /// Replaces the part of `node` in the text.
    fn edit(&self, node: NodeId, by: &str, change: String) -> MutantEdit {
        let span = &self.arena.nodes[node].span;
        let before = self.text.get(..span.start).unwrap_or("");
        let after = self.text.get(span.end..).unwrap_or("");
        let would_join =
            before.ends_with(char::is_alphanumeric) || after.starts_with(char::is_alphanumeric);
        let text = match is_one_operand(by) && !would_join {
            true => format!("{before}{by}{after}"),
            false => format!("{before}({by}){after}"),
        };
        MutantEdit { text, change }
    }

    /// Replaces the operator between two operands in the text.
    fn operator(&self, a: NodeId, b: NodeId, from: &[char], to: &str) -> Option<MutantEdit> {
        let gap = self.arena.nodes[a].span.end..self.arena.nodes[b].span.start;
        let found = self.text.get(gap.clone())?.find(from)? + gap.start;
        let sign = self.text[found..].chars().next()?;
        let (before, after) = (&self.text[..found], &self.text[found + sign.len_utf8()..]);
        Some(MutantEdit {
            text: format!("{before}{to}{after}"), change: format!("{sign} → {to}")
        })
    }

    fn edits_of(&self, node: NodeId, scope: &dyn Scope, edits: &mut Vec<MutantEdit>) {
        let own = self.part(node);
        let replaced = |by: String| self.edit(node, &by, format!("{own} → {by}"));
        match &self.arena.nodes[node].operation {
            NodeOperation::Number(value) => {
                edits.push(replaced((value + &Rational::from(1)).to_string()));
                edits.push(replaced(format!("-({own})")));
                edits.push(replaced(format!("{own}*({NEAR_ONE})")));
            }
            NodeOperation::Constant(_) => edits.push(replaced(format!("{own}*({NEAR_ONE})"))),
            NodeOperation::Angle(y, x) => {
                edits.push(replaced(format!("atan2({}, {})", self.part(*x), self.part(*y))));
            }
            NodeOperation::Extreme(which, all) => {
                edits.extend(all.iter().map(|a| self.kept(node, *a)));
                let arguments: Vec<&str> = all.iter().map(|a| self.part(*a)).collect();
                let other = match which {
                    Extreme::Least => "max",
                    Extreme::Greatest => "min",
                };
                edits.push(replaced(format!("{other}({})", arguments.join(", "))));
            }
            NodeOperation::Symbol(slot) => {
                let (_, kind) = self.arena.symbols[*slot];
                edits.extend(others(own, kind, scope).into_iter().map(replaced));
            }
            NodeOperation::Negate(a) => edits.push(replaced(self.part(*a).to_string())),
            NodeOperation::Add(a, b) => {
                edits.extend(self.operator(*a, *b, &['+'], "−"));
                self.terms(node, *a, *b, edits);
            }
            NodeOperation::Subtract(a, b) => {
                edits.extend(self.operator(*a, *b, &['-', '−'], "+"));
                self.terms(node, *a, *b, edits);
            }
            NodeOperation::Multiply(a, b)
            | NodeOperation::Scale(a, b)
            | NodeOperation::Apply(a, b)
            | NodeOperation::Compose(a, b)
            | NodeOperation::Solve(a, b) => {
                for kept in [*a, *b] {
                    edits.push(self.kept(node, kept));
                }
            }
            NodeOperation::Divide(a, b) => {
                let (above, below) = (self.part(*a), self.part(*b));
                edits.push(self.kept(node, *a));
                edits.push(replaced(format!("({below})/({above})")));
            }
            NodeOperation::Power(a, exponent) => {
                let base = self.part(*a);
                let one = Rational::from(1);
                for other in [exponent + &one, -exponent, exponent + &Rational::new(1, 2)] {
                    edits.push(replaced(format!("({base})^({other})")));
                }
            }
            NodeOperation::Function(
                ElementaryFunction::Sqrt | ElementaryFunction::Modulus | ElementaryFunction::Sign,
                a,
            )
            | NodeOperation::Inverse(a)
            | NodeOperation::Transpose(a)
            | NodeOperation::Adjugate(a) => edits.push(self.kept(node, *a)),
            NodeOperation::Dot(a, b) => {
                let (left, right) = (self.part(*a), self.part(*b));
                edits.push(replaced(format!("({left},{left})")));
                edits.push(replaced(format!("({right},{right})")));
            }
            _ => {}
        }
    }

    /// Edits of a sum: a term doubled, a near miss of it, and each term dropped.
    fn terms(&self, node: NodeId, a: NodeId, b: NodeId, edits: &mut Vec<MutantEdit>) {
        for term in [a, b] {
            let text = self.part(term);
            edits.push(self.edit(term, &format!("2*({text})"), format!("{text} doubled")));
            let near = format!("({NEAR_ONE})*({text})");
            edits.push(self.edit(term, &near, format!("{text} · (1 + 2⁻⁵⁰)")));
        }
        edits.push(self.kept(node, a));
        edits.push(self.kept(node, b));
    }

    /// Replaces a node by one of its operands.
    fn kept(&self, node: NodeId, operand: NodeId) -> MutantEdit {
        let (own, part) = (self.part(node), self.part(operand));
        self.edit(node, part, format!("{own} → {part}"))
    }
}

/// Changed text.
struct MutantEdit {
    text: String,
    change: String,
}

/// Whether a text is a name, a whole number, or all inside one pair of parentheses.
fn is_one_operand(text: &str) -> bool {
    if text.chars().all(char::is_alphanumeric) || text == "Ĩ" {
        return !text.is_empty();
    }
    let mut depth = 0;
    let closes = text.char_indices().find_map(|(place, sign)| {
        depth += i32::from(sign == '(') - i32::from(sign == ')');
        (depth <= 0).then_some(place)
    });
    text.starts_with('(') && closes == Some(text.len() - 1)
}

/// Names of the same type, the most easily confused first.
fn others(name: &str, kind: Type, scope: &dyn Scope) -> Vec<String> {
    let likely: &[&str] = match kind {
        Type::Matrix(..) => &["Ĩ", "J", "I", "B", "Γ"],
        Type::Vector(_) => &["γ", "ω", "r", "c"],
        Type::Scalar => &["m", "R", "μ", "k", "κ"],
    };
    let is_other =
        |other: &str| other != name && scope.lookup(other).is_some_and(|(_, found)| found == kind);
    let names = likely.iter().filter(|other| is_other(other)).map(|other| other.to_string());
    names.take(MOST_NAMES).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Scope, Symbol};
    use super::*;

    struct LetterSpans;

    impl Scope for LetterSpans {
        fn lookup(&self, name: &str) -> Option<(Symbol, Type)> {
            let kind = match name {
                "m" | "R" => Type::Scalar,
                "ω" | "γ" => Type::VECTOR,
                "I" | "J" => Type::MATRIX,
                _ => return None,
            };
            Some((Symbol(u32::from(name.chars().next()?) as _), kind))
        }

        fn names(&self) -> Vec<String> {
            ["m", "R", "ω", "γ", "I", "J"].map(String::from).to_vec()
        }
    }

    fn texts(text: &str) -> Vec<String> {
        let formula = Formula::parse(text, &LetterSpans).expect("a formula");
        let mutants = formula.mutants(&LetterSpans);
        mutants.iter().map(|mutant| mutant.formula.text().to_string()).collect()
    }

    #[test]
    fn each_kind_of_change_occurs() {
        let found = texts("(J*ω,ω) − 2*m*R²");
        for expected in [
            "(J*ω,ω) + 2*m*R²",
            "(J*ω,ω) − 3*m*R²",
            "(J*ω,ω) − 2*m*((R)^(3))",
            "(I*ω,ω) − 2*m*R²",
            "(J*γ,ω) − 2*m*R²",
            "(J*ω,ω)",
            "(J*ω,ω) − 2*R*R²",
            "(2*((J*ω,ω))) − 2*m*R²",
        ] {
            assert!(found.iter().any(|text| text == expected), "{expected} among {found:#?}");
        }
    }

    #[test]
    fn mutants_keep_the_type_and_differ() {
        for text in [
            "max(m, R)",
            "atan2(m, R)",
            "π*m",
            "√m",
            "-m",
            "m/R",
            "(ω × γ,J⁻¹*ω)",
            "det(J)^(1/2)",
            "(ω,γ)²/m",
        ] {
            let formula = Formula::parse(text, &LetterSpans).expect("a formula");
            let mutants = formula.mutants(&LetterSpans);
            assert!(!mutants.is_empty(), "{text} can be wrong in some way");
            for mutant in mutants {
                assert_eq!(mutant.formula.value_type(), Type::Scalar, "{}", mutant.change);
                assert_ne!(mutant.formula.text(), text, "{}", mutant.change);
            }
        }
    }
}
