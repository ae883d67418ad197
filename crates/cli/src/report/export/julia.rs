//! Julia, in doubles.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Rank, Target, TargetTerm, comments, double, is_plain, usual};

/// Julia.
pub struct Julia;

/// Functions that have no value where the language has an infinite one.
const HELPERS: &str = "
# No value at 0, where 1/x and log(x) would be infinite.
reciprocal(x) = iszero(x) ? oftype(x, NaN) : inv(x)
logarithm(x) = iszero(x) ? oftype(x, NaN) : log(x)

# x^y for x > 0.
power(x, y) = x > 0 ? x^y : oftype(x, NaN)
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
            "power",
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

    fn tangent(&self, argument: &TargetTerm) -> Option<TargetTerm> {
        Some(TargetTerm::atom(format!("tanh({})", argument.text)))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let above = exponent.abs();
        let term = match above.to_integer().filter(|_| is_plain(exponent)) {
            Some(n) => TargetTerm::of(format!("{}^{n}", base.at_least(Rank::Atom)), Rank::Power),
            None => self.power_of(base, &self.number(&above)),
        };
        match exponent.is_negative() {
            true => TargetTerm::atom(format!("reciprocal({})", term.text)),
            false => term,
        }
    }

    fn power_of(&self, base: &TargetTerm, exponent: &TargetTerm) -> TargetTerm {
        TargetTerm::atom(format!("power({}, {})", base.text, exponent.text))
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
            text.push_str(&comments(&export.described(body), "# ", ""));
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
