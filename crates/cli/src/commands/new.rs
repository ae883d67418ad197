//! The command `liouville new`: a commented case to start from.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use liouville_catalogue::templates;

use super::{CommandOutput, write_new};

#[derive(Debug, Args)]
pub struct New {
    /// Kind of system
    #[arg(value_enum)]
    pub kind: NewCaseKind,
    /// File to write; printed by default
    pub file: Option<PathBuf>,
}

/// Kind of system that a new case has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NewCaseKind {
    /// Rates of the state variables, typed
    Field,
    /// A Hamiltonian and a bracket
    Hamiltonian,
    /// A Lagrangian, with constraints or without
    Lagrangian,
    /// Images of the state variables under a map
    Map,
    /// A body that rolls on a plane without slipping or spinning
    Rolling,
    /// A ball that rolls on a surface
    Surface,
}

impl NewCaseKind {
    /// Returns the case to start from.
    pub fn template(self) -> &'static str {
        match self {
            NewCaseKind::Field => templates::FIELD,
            NewCaseKind::Hamiltonian => templates::HAMILTONIAN,
            NewCaseKind::Lagrangian => templates::LAGRANGIAN,
            NewCaseKind::Map => templates::MAP,
            NewCaseKind::Rolling => templates::ROLLING,
            NewCaseKind::Surface => templates::SURFACE,
        }
    }
}

pub fn run(options: &New) -> Result<CommandOutput, String> {
    let text = options.kind.template();
    let Some(file) = &options.file else {
        return Ok(CommandOutput { text: text.to_string(), code: 0 });
    };
    write_new(file, text)?;
    let shown = file.display();
    Ok(CommandOutput { text: format!("{shown}\nnext: liouville check {shown}\n"), code: 0 })
}

#[cfg(test)]
mod tests {
    use liouville::case::Case;
    use liouville::verdict::{Options, Verdict};

    use super::*;

    #[test]
    fn every_template_is_judged_as_it_says() {
        for kind in NewCaseKind::value_variants() {
            let case = Case::parse(kind.template(), &[]).expect("a case");
            let report = liouville_search::judge(&case, &Options::default()).expect("judged");
            assert!(report.warnings.is_empty(), "{kind:?}: {:?}", report.warnings);
            for claim in &report.claims {
                assert!(claim.agrees, "{kind:?}: {}", claim.name);
                let settled = [Verdict::Proved, Verdict::Refuted].contains(&claim.verdict);
                assert!(settled, "{kind:?}: {} is {:?}", claim.name, claim.verdict);
            }
        }
    }
}
