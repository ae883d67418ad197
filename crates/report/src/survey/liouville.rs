//! Liouville's theorem in words.

use liouville_search::survey::LiouvilleProof;

/// Liouville's theorem for a system, with its hypotheses.
pub fn in_involution(proof: &LiouvilleProof) -> String {
    let bracket = match proof.bracket.as_str() {
        "momenta" => "the canonical bracket of coordinates and momenta".to_string(),
        "hamiltonian" => "the bracket of the system".to_string(),
        name => format!("the bracket `{name}` of the file, which the motion preserves,"),
    };
    let count = proof.functions.len();
    let names = proof.functions.join(", ");
    let known = match count {
        1 => format!("{names} alone is enough"),
        _ => format!("{names} are in involution, and these {count} are enough"),
    };
    format!(
        "In {bracket} {known} for Liouville's theorem. It applies to compact connected joint levels on \
         which the gradients are independent; compactness is not checked."
    )
}
