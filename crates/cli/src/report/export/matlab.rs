//! MATLAB and Octave, in doubles: one file that returns handles of its functions.

use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::python::code_name;
use super::target::{Rank, Target, TargetTerm, comments, double, is_plain};

/// MATLAB.
pub struct Matlab;

/// Functions that have no value where the language has an infinite one.
const HELPERS: &str = "
% No value at 0, where 1/x and log(x) would be infinite.
function y = reciprocal(x)
  if x == 0
    y = NaN;
  else
    y = 1/x;
  end
end

function y = logarithm(x)
  if x == 0
    y = NaN;
  else
    y = reallog(x);
  end
end

% x^y for x > 0.
function z = power_of(x, y)
  if x > 0
    z = x^y;
  else
    z = NaN;
  end
end
";

impl Target for Matlab {
    fn is_exact(&self) -> bool {
        false
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "break",
            "case",
            "catch",
            "classdef",
            "continue",
            "else",
            "elseif",
            "end",
            "endif",
            "endfunction",
            "endwhile",
            "for",
            "function",
            "global",
            "if",
            "otherwise",
            "parfor",
            "persistent",
            "return",
            "spmd",
            "switch",
            "try",
            "while",
            "until",
            "unwind_protect",
            "abs",
            "realsqrt",
            "reallog",
            "realpow",
            "exp",
            "sin",
            "cos",
            "atan",
            "NaN",
            "do",
            "reciprocal",
            "logarithm",
            "power_of",
            "state",
            "parameters",
            "values",
            "functions",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        double(value, "")
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        // The real functions raise an error where the others are complex.
        let name = match function {
            UnaryFunction::Sqrt => "realsqrt",
            UnaryFunction::Ln => "logarithm",
            other => super::target::usual(other),
        };
        TargetTerm::atom(format!("{name}({})", argument.text))
    }

    fn tangent(&self, argument: &TargetTerm) -> Option<TargetTerm> {
        Some(TargetTerm::atom(format!("tanh({})", argument.text)))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let above = self.number(&exponent.abs());
        let (text, rank) = match is_plain(exponent) {
            true => (format!("{}^{}", base.at_least(Rank::Atom), above.text), Rank::Power),
            false => (self.power_of(base, &above).text, Rank::Atom),
        };
        match exponent.is_negative() {
            true => TargetTerm::atom(format!("reciprocal({text})")),
            false => TargetTerm::of(text, rank),
        }
    }

    fn power_of(&self, base: &TargetTerm, exponent: &TargetTerm) -> TargetTerm {
        TargetTerm::atom(format!("power_of({}, {})", base.text, exponent.text))
    }

    fn reciprocal(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::atom(format!("reciprocal({})", a.text))
    }

    fn quotient(&self, _: &TargetTerm, _: &TargetTerm) -> Option<TargetTerm> {
        None
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let module = export.module;
        let mut text = format!("function functions = {module}()\n");
        text.push_str(&comments(&export.heading(), "% ", ""));
        text.push_str(&comments(&export.listed(names, 1), "% ", ""));
        text.push_str(&format!(
            "%\n% Save as {module}.m; f = {module}(); f.{}(state, parameters)\n",
            bodies.first().map_or("field", |body| body.name.as_str())
        ));
        for body in bodies {
            text.push_str(&format!("  functions.{0} = @{0};\n", body.name));
        }
        text.push_str("end\n");
        for body in bodies {
            text.push('\n');
            text.push_str(&comments(&export.described(body), "% ", ""));
            text.push_str(&format!("function values = {}(state, parameters)\n", body.name));
            let line =
                |list: &str, at: usize, own: &str| format!("  {own} = {list}({});\n", at + 1);
            text.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                text.push_str(&format!("  {name} = {value};\n"));
            }
            text.push_str("  values = [\n");
            for output in &body.outputs {
                text.push_str(&format!("    ({output});\n"));
            }
            text.push_str("  ];\nend\n");
        }
        text + HELPERS
    }
}
