//! Julia, in doubles.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Rank, Target, TargetTerm, comments, double, usual};

/// Julia.
pub struct Julia;

/// Functions that have no value where the language has an infinite one.
const HELPERS: &str = "
# No value at 0, where 1/x and log(x) would be infinite.
reciprocal(x) = iszero(x) ? oftype(x, NaN) : inv(x)
logarithm(x) = iszero(x) ? oftype(x, NaN) : log(x)
";

impl Target for Julia {
    fn is_exact(&self) -> bool {
        false
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "baremodule",
            "begin",
            "break",
            "catch",
            "const",
            "continue",
            "do",
            "else",
            "elseif",
            "end",
            "export",
            "false",
            "finally",
            "for",
            "function",
            "global",
            "if",
            "import",
            "let",
            "local",
            "macro",
            "module",
            "quote",
            "return",
            "struct",
            "true",
            "try",
            "using",
            "while",
            "abs",
            "sqrt",
            "exp",
            "log",
            "sin",
            "cos",
            "atan",
            "inv",
            "iszero",
            "oftype",
            "NaN",
            "reciprocal",
            "logarithm",
            "state",
            "parameters",
            "in",
            "isa",
            "where",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        double(value, ".0")
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let name = if function == UnaryFunction::Ln { "logarithm" } else { usual(function) };
        TargetTerm::atom(format!("{name}({})", argument.text))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let above = exponent.abs();
        let raised = match above.to_integer() {
            Some(n) => n.to_string(),
            None => self.number(&above).at_least(Rank::Atom),
        };
        let text = format!("{}^{raised}", base.at_least(Rank::Atom));
        match exponent.is_negative() {
            true => TargetTerm::atom(format!("reciprocal({text})")),
            false => TargetTerm::of(text, Rank::Power),
        }
    }

    fn reciprocal(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::atom(format!("reciprocal({})", a.text))
    }

    fn quotient(&self, _: &TargetTerm, _: &TargetTerm) -> Option<TargetTerm> {
        None
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let mut text = comments(&export.heading(), "# ", "");
        text.push_str(&comments(&export.listed(names, 1), "# ", ""));
        text.push_str(HELPERS);
        for body in bodies {
            text.push('\n');
            text.push_str(&comments(&export.subject(body.part), "# ", ""));
            text.push_str(&format!("function {}(state, parameters)\n", body.name));
            let line =
                |list: &str, at: usize, own: &str| format!("    {own} = {list}[{}]\n", at + 1);
            text.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                text.push_str(&format!("    {name} = {value}\n"));
            }
            text.push_str("    return [\n");
            for output in &body.outputs {
                text.push_str(&format!("        {output},\n"));
            }
            text.push_str("    ]\nend\n");
        }
        text
    }
}
