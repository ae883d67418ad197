//! Maple, exact.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Target, TargetTerm, comments, exact, raised};

/// Maple.
pub struct Maple;

impl Target for Maple {
    fn is_exact(&self) -> bool {
        true
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "and",
            "assuming",
            "break",
            "by",
            "catch",
            "description",
            "do",
            "done",
            "elif",
            "else",
            "end",
            "error",
            "export",
            "fi",
            "finally",
            "for",
            "from",
            "global",
            "if",
            "implies",
            "in",
            "intersect",
            "local",
            "minus",
            "mod",
            "module",
            "next",
            "not",
            "od",
            "option",
            "options",
            "or",
            "proc",
            "quit",
            "read",
            "return",
            "save",
            "stop",
            "subset",
            "then",
            "to",
            "try",
            "union",
            "use",
            "uses",
            "while",
            "xor",
            "D",
            "I",
            "O",
            "Pi",
            "Beta",
            "Zeta",
            "Psi",
            "GAMMA",
            "gamma",
            "Catalan",
            "constants",
            "infinity",
            "undefined",
            "abs",
            "sqrt",
            "exp",
            "ln",
            "sin",
            "cos",
            "arctan",
            "state",
            "parameters",
            "Re",
            "Im",
            "Chi",
            "Si",
            "Ci",
            "Ei",
            "Li",
            "type",
            "op",
            "lambda",
            "value",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        exact(value)
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let name = match function {
            UnaryFunction::Ln => "ln",
            UnaryFunction::Atan => "arctan",
            other => super::target::usual(other),
        };
        TargetTerm::atom(format!("{name}({})", argument.text))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        raised(base, exponent)
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let mut text = comments(&export.heading(), "# ", "");
        text.push_str(&comments(&export.listed(names, 1), "# ", ""));
        text.push_str("# Each function takes two lists, of numbers or of names.\n");
        for body in bodies {
            text.push('\n');
            text.push_str(&comments(&export.described(body), "# ", ""));
            text.push_str(&format!("{} := proc(state, parameters)\n", body.name));
            let locals = export.locals(body, names);
            if !locals.is_empty() {
                text.push_str(&format!("  local {};\n", locals.join(", ")));
            }
            let line =
                |list: &str, at: usize, own: &str| format!("  {own} := {list}[{}];\n", at + 1);
            text.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                text.push_str(&format!("  {name} := {value};\n"));
            }
            text.push_str(&format!("  [\n    {}\n  ]\nend proc:\n", body.outputs.join(",\n    ")));
        }
        text
    }
}
