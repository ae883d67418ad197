//! Rust, in doubles.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Target, TargetTerm, comments, double, is_plain, usual};

/// Rust.
pub struct Rust;

/// Functions that have no value where the language has an infinite one.
const HELPERS: [(&str, &str); 3] = [
    (
        "reciprocal(",
        "\n/// 1/x; no value at 0.\nfn reciprocal(x: f64) -> f64 {\n    \
         if x == 0.0 { f64::NAN } else { 1.0/x }\n}\n",
    ),
    (
        "logarithm(",
        "\n/// ln x; no value at 0.\nfn logarithm(x: f64) -> f64 {\n    \
         if x == 0.0 { f64::NAN } else { x.ln() }\n}\n",
    ),
    (
        "power(",
        "\n/// x^y for x > 0.\nfn power(x: f64, y: f64) -> f64 {\n    \
         if x > 0.0 { x.powf(y) } else { f64::NAN }\n}\n",
    ),
];

impl Target for Rust {
    fn is_exact(&self) -> bool {
        false
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "as",
            "async",
            "await",
            "box",
            "break",
            "const",
            "continue",
            "crate",
            "do",
            "dyn",
            "else",
            "enum",
            "extern",
            "false",
            "final",
            "fn",
            "for",
            "if",
            "impl",
            "in",
            "let",
            "loop",
            "macro",
            "match",
            "mod",
            "move",
            "mut",
            "override",
            "priv",
            "pub",
            "ref",
            "return",
            "self",
            "Self",
            "static",
            "struct",
            "super",
            "trait",
            "true",
            "try",
            "type",
            "typeof",
            "unsafe",
            "unsized",
            "use",
            "virtual",
            "where",
            "while",
            "yield",
            "abstract",
            "become",
            "gen",
            "f64",
            "reciprocal",
            "logarithm",
            "power",
            "state",
            "parameters",
            "main",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        double(value, ".0")
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        match function {
            UnaryFunction::Ln => TargetTerm::atom(format!("logarithm({})", argument.text)),
            other => TargetTerm::atom(format!("f64::{}({})", usual(other), argument.text)),
        }
    }

    fn tangent(&self, argument: &TargetTerm) -> Option<TargetTerm> {
        Some(TargetTerm::atom(format!("f64::tanh({})", argument.text)))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let name = if is_plain(exponent) { "f64::powf" } else { "power" };
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
        let (state, parameters) = (export.inputs(true).len(), export.inputs(false).len());
        let mut code = String::new();
        for body in bodies {
            code.push('\n');
            code.push_str(&comments(&export.described(body), "/// ", ""));
            let count = body.outputs.len();
            let argument = |name: &str, is_state| match export.used(body, is_state).is_empty() {
                true => format!("_{name}"),
                false => name.to_string(),
            };
            code.push_str(&format!(
                "#[allow(non_snake_case, clippy::all)]\npub fn {}({}: &[f64; {state}], {}: &[f64; {parameters}]) -> [f64; {count}] {{\n",
                body.name,
                argument("state", true),
                argument("parameters", false),
            ));
            let line =
                |list: &str, at: usize, own: &str| format!("    let {own} = {list}[{at}];\n");
            code.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                code.push_str(&format!("    let {name} = {value};\n"));
            }
            code.push_str("    [\n");
            for output in &body.outputs {
                code.push_str(&format!("        {output},\n"));
            }
            code.push_str("    ]\n}\n");
        }
        let mut text = comments(&export.heading(), "// ", "");
        text.push_str(&comments(&export.listed(names, 0), "// ", ""));
        text.push_str("// A number without a value is NaN.\n\n");
        let helpers = HELPERS.iter().filter(|(call, _)| code.contains(call));
        helpers.for_each(|(_, helper)| text.push_str(helper));
        text + &code
    }
}
