//! Python: with `math` in doubles, or with SymPy in exact numbers and symbols.

use liouville::formula::ascii_name;
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;

use super::ExportedCase;
use super::lines::CodeLines;
use super::names::ExportNames;
use super::target::{Rank, Target, TargetTerm, comments, double, is_plain, usual};

/// Powers with exponents that are not whole.
const POWER: &str = "

def power(x, y):
    # x^y for x > 0.
    if not x > 0:
        raise ValueError(\"a power of a number that is not positive\")
    return math.pow(x, y)
";

/// Python, numerical or symbolic.
pub struct Python {
    /// Whether values are SymPy's instead of floats.
    pub is_symbolic: bool,
}

impl Python {
    fn library(&self) -> &'static str {
        if self.is_symbolic { "sympy" } else { "math" }
    }
}

impl Target for Python {
    fn is_exact(&self) -> bool {
        self.is_symbolic
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[
            "False",
            "None",
            "True",
            "and",
            "as",
            "assert",
            "async",
            "await",
            "break",
            "class",
            "continue",
            "def",
            "del",
            "elif",
            "else",
            "except",
            "finally",
            "for",
            "from",
            "global",
            "if",
            "import",
            "in",
            "is",
            "lambda",
            "nonlocal",
            "not",
            "or",
            "pass",
            "raise",
            "return",
            "try",
            "while",
            "with",
            "yield",
            "abs",
            "power",
            "math",
            "sympy",
            "state",
            "parameters",
            "STATE",
            "PARAMETERS",
        ]
    }

    fn name(&self, name: &str) -> String {
        code_name(name)
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        let rank = |own: Rank| if value.is_negative() { Rank::Sum } else { own };
        match (self.is_symbolic, value.parts()) {
            (false, _) => double(value, ""),
            (true, (above, below)) if below == 1.into() => {
                TargetTerm::of(above.to_string(), rank(Rank::Atom))
            }
            (true, (above, below)) => TargetTerm::atom(format!("sympy.Rational({above}, {below})")),
        }
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let name = match (function, self.is_symbolic) {
            (UnaryFunction::Abs, false) => {
                return TargetTerm::atom(format!("abs({})", argument.text));
            }
            (UnaryFunction::Abs, true) => "Abs",
            (function, _) => usual(function),
        };
        TargetTerm::atom(format!("{}.{name}({})", self.library(), argument.text))
    }

    fn tangent(&self, argument: &TargetTerm) -> Option<TargetTerm> {
        let name = format!("{}.tanh({})", self.library(), argument.text);
        (!self.is_symbolic).then(|| TargetTerm::atom(name))
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let raised = self.number(exponent).at_least(Rank::Atom);
        // A float to a fractional power would be complex where the base is negative.
        match self.is_symbolic || is_plain(exponent) {
            true => {
                let text = format!("{}**{raised}", base.at_least(Rank::Atom));
                TargetTerm::of(text, Rank::Power)
            }
            false => self.power_of(base, &self.number(exponent)),
        }
    }

    fn power_of(&self, base: &TargetTerm, exponent: &TargetTerm) -> TargetTerm {
        match self.is_symbolic {
            true => {
                let exponent = exponent.at_least(Rank::Atom);
                TargetTerm::of(format!("{}**{exponent}", base.at_least(Rank::Atom)), Rank::Power)
            }
            false => TargetTerm::atom(format!("power({}, {})", base.text, exponent.text)),
        }
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let mut text = comments(&export.heading(), "# ", "");
        text.push_str(match self.is_symbolic {
            true => {
                "#\n# Each function takes lists of numbers or of symbols; without arguments, the \
                 symbols below.\n"
            }
            false => {
                "#\n# Each function takes two lists of floats, and raises an exception where it \
                 has no value.\n"
            }
        });
        text.push_str(&format!("\nimport {}\n", self.library()));
        for (title, is_state) in [("PARAMETERS", false), ("STATE", true)] {
            let all = export.inputs(is_state);
            text.push_str(&format!("\n{title} = ["));
            for (place, name) in &all {
                let own = &names.inputs[*place];
                let value = match self.is_symbolic {
                    true => format!("sympy.Symbol(\"{own}\", real=True)"),
                    false => format!("\"{own}\""),
                };
                let origin = if own == name { String::new() } else { format!("  # {name}") };
                text.push_str(&format!("\n    {value},{origin}"));
            }
            text.push_str(if all.is_empty() { "]\n" } else { "\n]\n" });
        }
        let raises = |body: &CodeLines| {
            let lines = body.lines.iter().map(|(_, value)| value);
            lines.chain(&body.outputs).any(|text| text.contains("power("))
        };
        if bodies.iter().any(raises) {
            text.push_str(POWER);
        }
        for body in bodies {
            let arguments = match self.is_symbolic {
                true => "state=STATE, parameters=PARAMETERS",
                false => "state, parameters",
            };
            text.push_str(&format!("\n\ndef {}({arguments}):\n", body.name));
            text.push_str(&comments(&export.described(body), "    # ", ""));
            let line = |list: &str, at: usize, own: &str| format!("    {own} = {list}[{at}]\n");
            text.push_str(&export.taken(body, names, line));
            for (name, value) in &body.lines {
                text.push_str(&format!("    {name} = {value}\n"));
            }
            text.push_str("    return [\n");
            for output in &body.outputs {
                text.push_str(&format!("        {output},\n"));
            }
            text.push_str("    ]\n");
        }
        text
    }
}

/// Spelling of a component's name in ASCII: `ω1` → `omega1`, `L[2,1]` → `L_2_1`.
pub fn code_name(name: &str) -> String {
    let plain = name.replace(']', "").replace(['[', ','], "_");
    ascii_name(&plain)
}
