//! Values of functions that motions keep, by the options --energy and --fix.

use liouville::case::Case;
use liouville::number::rational::Rational;
use liouville_flow::{Conserved, Fixed};

/// Reads the functions whose values all motions of a command share.
pub fn fixed(
    case: &Case,
    energy: Option<&Rational>,
    texts: &[String],
) -> Result<Vec<Fixed>, String> {
    let mut all: Vec<Fixed> = energy.cloned().map(Fixed::energy).into_iter().collect();
    for text in texts {
        let read = Fixed::read(case, text).map_err(|mistake| {
            format!("error: --fix {text}: {}\nhelp: {}", mistake.message, mistake.help)
        })?;
        let name = read.function.name();
        if all.iter().any(|own| own.function.name() == name) {
            return Err(format!(
                "error: --fix {text}: `{name}` is fixed twice\nhelp: leave one of the values out"
            ));
        }
        all.push(read);
    }
    Ok(all)
}

/// Functions among these that are integrals.
pub fn integrals(fixed: &[Fixed]) -> Vec<Conserved> {
    let functions = fixed.iter().map(|own| own.function.clone());
    functions.filter(|own| matches!(own, Conserved::Integral { .. })).collect()
}
