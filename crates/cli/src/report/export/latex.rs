//! LaTeX with amsmath: a document with the field, the level equations and the claims.

use liouville::formula::{Layout, Type};
use liouville::number::Function;
use liouville::number::rational::Rational;
use liouville::program::Part;

use super::Export;
use super::lines::Body;
use super::names::Names;
use super::target::{Rank, Target, Term};
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

    fn number(&self, value: &Rational) -> Term {
        let (above, below) = value.parts();
        let sign = if value.is_negative() { "-" } else { "" };
        let rank = |own: Rank| if value.is_negative() { Rank::Sum } else { own };
        match below == 1.into() {
            true => Term::of(above.to_string(), rank(Rank::Atom)),
            false => {
                let above = value.abs().parts().0;
                Term::of(format!("{sign}\\tfrac{{{above}}}{{{below}}}"), rank(Rank::Product))
            }
        }
    }

    fn call(&self, function: Function, argument: &Term) -> Term {
        let text = &argument.text;
        Term::atom(match function {
            Function::Sqrt => format!("\\sqrt{{{text}}}"),
            Function::Abs => format!("\\left\\lvert {text} \\right\\rvert"),
            Function::Ln => format!("\\ln\\left({text}\\right)"),
            Function::Atan => format!("\\arctan\\left({text}\\right)"),
            other => format!("\\{}\\left({text}\\right)", super::target::usual(other)),
        })
    }

    fn power(&self, base: &Term, exponent: &Rational) -> Term {
        let raised = self.number(exponent).text.replace("tfrac", "frac");
        Term::of(format!("{{{}}}^{{{raised}}}", operand(base, Rank::Atom)), Rank::Power)
    }

    fn power_of(&self, base: &Term, exponent: &Term) -> Term {
        let text = format!("{{{}}}^{{{}}}", operand(base, Rank::Atom), exponent.text);
        Term::of(text, Rank::Power)
    }

    fn negative(&self, a: &Term) -> Term {
        Term::of(format!("-{}", operand(a, Rank::Product)), Rank::Sum)
    }

    fn reciprocal(&self, a: &Term) -> Term {
        Term::of(format!("\\frac{{1}}{{{}}}", a.text), Rank::Product)
    }

    fn quotient(&self, a: &Term, b: &Term) -> Option<Term> {
        Some(Term::of(format!("\\frac{{{}}}{{{}}}", a.text, b.text), Rank::Product))
    }

    fn sum(&self, a: &Term, sign: &str, b: &Term) -> Term {
        Term::of(format!("{} {sign} {}", a.text, operand(b, Rank::Product)), Rank::Sum)
    }

    fn product(&self, a: &Term, b: &Term) -> Term {
        let (a, b) = (operand(a, Rank::Product), operand(b, Rank::Product));
        let is_number = b.starts_with(|c: char| c.is_ascii_digit());
        let sign = if is_number { "\\cdot" } else { "\\," };
        Term::of(format!("{a} {sign} {b}"), Rank::Product)
    }

    fn file(&self, export: &Export<'_>, names: &Names, bodies: &[Body]) -> String {
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
            let left = |index: usize| match body.part {
                Part::Field if export.case.model.system.is_map() => {
                    format!("\\Phi\\left({}\\right)", names.inputs[state[index].0])
                }
                Part::Field => format!("\\frac{{d}}{{dt}} {}", names.inputs[state[index].0]),
                Part::Level => format!("F_{{{}}}", index + 1),
                Part::Value(_) => format!("V_{{{}}}", index + 1),
                Part::Residual(_) => format!("R_{{{}}}", index + 1),
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
fn operand(term: &Term, rank: Rank) -> String {
    match term.rank >= rank {
        true => term.text.clone(),
        false => format!("\\left({}\\right)", term.text),
    }
}
