//! LaTeX with amsmath: a document with the field, the level equations and the claims.

use liouville::formula::{Layout, Type};
use liouville::number::UnaryFunction;
use liouville::number::rational::Rational;
use liouville::program::FunctionSubject;

use super::lines::CodeLines;
use super::names::ExportNames;
use super::target::{Rank, Target, TargetTerm};
use super::{ExportedCase, REQUIRED};
use crate::report::typeset::latex::{formula, prose};

/// LaTeX.
pub struct Latex;

/// Beginning of the document. Letters that pdfLaTeX does not know occur in formulas as typed.
const PREAMBLE: &str = "\\documentclass{article}
\\usepackage{amsmath,amssymb}
\\usepackage[margin=2cm]{geometry}
\\allowdisplaybreaks
\\setlength{\\parindent}{0pt}
\\setlength{\\parskip}{1ex}
\\begin{document}
";

impl Target for Latex {
    fn is_exact(&self) -> bool {
        true
    }

    fn reserved(&self) -> &'static [&'static str] {
        &[]
    }

    fn width(&self) -> usize {
        12
    }

    fn name(&self, name: &str) -> String {
        let (base, entry) = match name.split_once('[') {
            Some((base, entry)) => (base, Some(entry.trim_end_matches(']'))),
            None => (name, None),
        };
        let mut layout = Layout::name(base, Type::Scalar);
        if let (Layout::Name { index, .. }, Some(entry)) = (&mut layout, entry) {
            let separator = if index.is_empty() { "" } else { ";" };
            *index = format!("{index}{separator}{entry}");
        }
        // Letters that have no command need a font of their own.
        let text = formula(&layout);
        match text.is_ascii() {
            true => text,
            false => format!("\\mathit{{{}}}", super::python::code_name(name).replace('_', "\\_")),
        }
    }

    fn another(&self, name: &str, count: usize) -> String {
        format!("{{{name}}}^{{({count})}}")
    }

    fn temporary(&self, count: usize) -> String {
        format!("t_{{{count}}}")
    }

    fn number(&self, value: &Rational) -> TargetTerm {
        let (above, below) = value.parts();
        let sign = if value.is_negative() { "-" } else { "" };
        let rank = |own: Rank| if value.is_negative() { Rank::Sum } else { own };
        match below == 1.into() {
            true => TargetTerm::of(above.to_string(), rank(Rank::Atom)),
            false => {
                let above = value.abs().parts().0;
                TargetTerm::of(format!("{sign}\\tfrac{{{above}}}{{{below}}}"), rank(Rank::Product))
            }
        }
    }

    fn call(&self, function: UnaryFunction, argument: &TargetTerm) -> TargetTerm {
        let text = &argument.text;
        TargetTerm::atom(match function {
            UnaryFunction::Sqrt => format!("\\sqrt{{{text}}}"),
            UnaryFunction::Abs => format!("\\left\\lvert {text} \\right\\rvert"),
            UnaryFunction::Ln => format!("\\ln\\left({text}\\right)"),
            UnaryFunction::Atan => format!("\\arctan\\left({text}\\right)"),
            other => format!("\\{}\\left({text}\\right)", super::target::usual(other)),
        })
    }

    fn power(&self, base: &TargetTerm, exponent: &Rational) -> TargetTerm {
        let raised = self.number(exponent).text.replace("tfrac", "frac");
        TargetTerm::of(format!("{{{}}}^{{{raised}}}", operand(base, Rank::Atom)), Rank::Power)
    }

    fn power_of(&self, base: &TargetTerm, exponent: &TargetTerm) -> TargetTerm {
        let text = format!("{{{}}}^{{{}}}", operand(base, Rank::Atom), exponent.text);
        TargetTerm::of(text, Rank::Power)
    }

    fn negative(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("-{}", operand(a, Rank::Product)), Rank::Sum)
    }

    fn reciprocal(&self, a: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("\\frac{{1}}{{{}}}", a.text), Rank::Product)
    }

    fn quotient(&self, a: &TargetTerm, b: &TargetTerm) -> Option<TargetTerm> {
        Some(TargetTerm::of(format!("\\frac{{{}}}{{{}}}", a.text, b.text), Rank::Product))
    }

    fn sum(&self, a: &TargetTerm, sign: &str, b: &TargetTerm) -> TargetTerm {
        TargetTerm::of(format!("{} {sign} {}", a.text, operand(b, Rank::Product)), Rank::Sum)
    }

    fn product(&self, a: &TargetTerm, b: &TargetTerm) -> TargetTerm {
        let (a, b) = (operand(a, Rank::Product), operand(b, Rank::Product));
        let is_number = b.starts_with(|c: char| c.is_ascii_digit());
        let sign = if is_number { "\\cdot" } else { "\\," };
        TargetTerm::of(format!("{a} {sign} {b}"), Rank::Product)
    }

    fn file(&self, export: &ExportedCase<'_>, names: &ExportNames, bodies: &[CodeLines]) -> String {
        let mut text = String::from(PREAMBLE);
        let mut heading = export.heading().into_iter();
        let title = heading.next().unwrap_or_default();
        text.push_str(&format!("\\section*{{{}}}\n", prose(&title)));
        heading.for_each(|line| text.push_str(&format!("{}\\\\\n", prose(&line))));
        for (title, is_state) in [("State", true), ("Parameters", false)] {
            let own = export.inputs(is_state);
            let listed = own.iter().map(|(place, _)| format!("${}$", names.inputs[*place]));
            let listed = listed.collect::<Vec<_>>().join(", ");
            if !listed.is_empty() {
                text.push_str(&format!("\n{title}: {listed}.\n"));
            }
        }
        let state = export.inputs(true);
        for body in bodies {
            let subject = export.subject(body.part);
            text.push_str(&format!("\n\\subsection*{{{}}}\n", prose(&body.name.replace('_', " "))));
            subject.iter().for_each(|line| text.push_str(&format!("{}\\\\\n", prose(line))));
            for own in &body.required {
                text.push_str(&format!("{REQUIRED}: ${own}$.\\\\\n"));
            }
            let left = |index: usize| match body.part {
                FunctionSubject::Field if export.case.model.system.is_map() => {
                    format!("\\Phi\\left({}\\right)", names.inputs[state[index].0])
                }
                FunctionSubject::Field => {
                    format!("\\frac{{d}}{{dt}} {}", names.inputs[state[index].0])
                }
                FunctionSubject::Level => format!("F_{{{}}}", index + 1),
                FunctionSubject::Value(_) => format!("V_{{{}}}", index + 1),
                FunctionSubject::Residual(_) => format!("R_{{{}}}", index + 1),
            };
            let outputs = body.outputs.iter().enumerate();
            let outputs = outputs.map(|(index, value)| (left(index), value.clone()));
            let lines: Vec<String> = body
                .lines
                .iter()
                .cloned()
                .chain(outputs)
                .map(|(name, value)| format!("{name} &= {value}"))
                .collect();
            text.push_str(&format!(
                "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
                lines.join(" \\\\\n")
            ));
        }
        text + "\\end{document}\n"
    }
}

/// An operand that has to bind at least as strongly as `rank`.
fn operand(term: &TargetTerm, rank: Rank) -> String {
    match term.rank >= rank {
        true => term.text.clone(),
        false => format!("\\left({}\\right)", term.text),
    }
}
