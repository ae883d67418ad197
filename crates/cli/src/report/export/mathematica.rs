//! Mathematica, exact.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Target, TargetTerm, comments, exact, raised};

/// Mathematica.
pub struct Mathematica;

impl Target for Mathematica {
    fn is_exact(&self) -> bool {
        true
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "C",
            "D",
            "E",
            "I",
            "K",
            "N",
            "O",
            "Pi",
            "Beta",
            "Gamma",
            "Zeta",
            "List",
            "Module",
            "state",
            "parameters",
        ]
    }

    /// Names have no underscores, and begin with a small letter so that none is a built-in one.
    fn name(&self, name: &str) -> String {
        let plain = code_name(name).replace('_', "$");
        match plain.starts_with(|c: char| c.is_ascii_uppercase()) {
            true => format!("v{plain}"),
            false => plain,
        }
    }

    fn function_name(&self, words: &[&str]) -> String {
        words.join("$")
    }

    fn another(&self, name: &str, count: usize) -> String {
        format!("{name}$n{count}")
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        exact(value)
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let name = match function {
            UnaryFunction::Sqrt => "Sqrt",
            UnaryFunction::Abs => "Abs",
            UnaryFunction::Exp => "Exp",
            UnaryFunction::Ln => "Log",
            UnaryFunction::Sin => "Sin",
            UnaryFunction::Cos => "Cos",
            UnaryFunction::Atan => "ArcTan",
            UnaryFunction::Neg | UnaryFunction::Recip => "Identity",
        };
        TargetTerm::atom(format!("{name}[{}]", argument.text))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        raised(base, exponent)
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let mut text = comments(&export.heading(), "(* ", " *)");
        text.push_str(&comments(&export.listed(names, 1), "(* ", " *)"));
        text.push_str("(* Each function takes two lists, of numbers or of symbols. *)\n");
        for body in bodies {
            text.push('\n');
            text.push_str(&comments(&export.described(body), "(* ", " *)"));
            let locals = export.locals(body, names);
            text.push_str(&format!(
                "{}[state_List, parameters_List] := Module[{{{}}},\n",
                body.name,
                locals.join(", ")
            ));
            let line =
                |list: &str, at: usize, own: &str| format!("  {own} = {list}[[{}]];\n", at + 1);
            text.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                text.push_str(&format!("  {name} = {value};\n"));
            }
            text.push_str(&format!("  {{\n    {}\n  }}\n];\n", body.outputs.join(",\n    ")));
        }
        text
    }
}
