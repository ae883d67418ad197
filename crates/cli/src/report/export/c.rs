//! C99, in doubles.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::super::counted;
use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Target, TargetTerm, comments, double, is_plain, usual};

/// C.
pub struct C;

/// Functions that have no value where the language has an infinite one.
const HELPERS: [(&str, &str); 3] = [
    (
        "reciprocal(",
        "/* 1/x; no value at 0. */\n\
         static double reciprocal(double x) { return x == 0.0 ? NAN : 1.0/x; }\n",
    ),
    (
        "logarithm(",
        "/* log(x); no value at 0. */\n\
         static double logarithm(double x) { return x == 0.0 ? NAN : log(x); }\n",
    ),
    (
        "power(",
        "/* x^y for x > 0. */\n\
         static double power(double x, double y) { return x > 0.0 ? pow(x, y) : NAN; }\n",
    ),
];

impl Target for C {
    fn is_exact(&self) -> bool {
        false
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "auto",
            "break",
            "case",
            "char",
            "const",
            "continue",
            "default",
            "do",
            "double",
            "else",
            "enum",
            "extern",
            "float",
            "for",
            "goto",
            "if",
            "inline",
            "int",
            "long",
            "register",
            "restrict",
            "return",
            "short",
            "signed",
            "sizeof",
            "static",
            "struct",
            "switch",
            "typedef",
            "union",
            "unsigned",
            "void",
            "volatile",
            "while",
            "main",
            "asm",
            "class",
            "private",
            "public",
            "template",
            "this",
            "new",
            "delete",
            "fabs",
            "sqrt",
            "exp",
            "log",
            "sin",
            "cos",
            "atan",
            "tanh",
            "pow",
            "NAN",
            "INFINITY",
            "I",
            "reciprocal",
            "logarithm",
            "power",
            "state",
            "parameters",
            "values",
            "gamma",
            "j0",
            "j1",
            "y0",
            "y1",
            "jn",
            "yn",
            "bool",
            "true",
            "false",
            "signgam",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        double(value, ".0")
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let name = match function {
            UnaryFunction::Abs => "fabs",
            UnaryFunction::Ln => "logarithm",
            other => usual(other),
        };
        TargetTerm::atom(format!("{name}({})", argument.text))
    }

    fn tangent(&self, argument: &TargetTerm) -> Option<TargetTerm> {
        Some(TargetTerm::atom(format!("tanh({})", argument.text)))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let name = if is_plain(exponent) { "pow" } else { "power" };
        let text = format!("{name}({}, {})", base.text, self.number(&exponent.abs()).text);
        match exponent.is_negative() {
            true => TargetTerm::atom(format!("reciprocal({text})")),
            false => TargetTerm::atom(text),
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
        let mut code = String::new();
        for body in bodies {
            code.push('\n');
            code.push_str(&comments(&export.described(body), "/* ", " */"));
            code.push_str(&format!(
                "void {}(const double *state, const double *parameters, double *values)\n{{\n",
                body.name
            ));
            for (list, is_state) in [("parameters", false), ("state", true)] {
                if export.used(body, is_state).is_empty() {
                    code.push_str(&format!("    (void){list};\n"));
                }
            }
            let line = |list: &str, at: usize, own: &str| {
                format!("    const double {own} = {list}[{at}];\n")
            };
            code.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                code.push_str(&format!("    const double {name} = {value};\n"));
            }
            for (index, output) in body.outputs.iter().enumerate() {
                code.push_str(&format!("    values[{index}] = {output};\n"));
            }
            code.push_str("}\n");
        }
        let mut text = comments(&export.heading(), "/* ", " */");
        text.push_str(&comments(&export.listed(names, 0), "/* ", " */"));
        for body in bodies {
            let count = body.outputs.len();
            let values = counted(count, "value");
            text.push_str(&format!("/* {} writes {values}. */\n", body.name));
        }
        text.push_str("/* A number without a value is NAN. */\n\n#include <math.h>\n\n");
        let helpers = HELPERS.iter().filter(|(call, _)| code.contains(call));
        helpers.for_each(|(_, helper)| text.push_str(helper));
        text + &code
    }
}
