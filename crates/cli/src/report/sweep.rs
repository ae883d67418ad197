//! Report of `sweep`: the largest residual of each claim, and the state where it is.

use liouville::sweep::Extremes;
use liouville_report::evidence::shell_quoted;
use serde_json::{Value, json};

/// A value by its name.
type NamedValue = (String, String);

/// Result of one claim.
pub struct Found {
    /// Name of the claim.
    pub claim: String,
    /// Largest residual, and numbers of states.
    pub found: Extremes,
    /// Parameters and state of the largest residual, by name, as `--set` and `--state` read them.
    pub at: Option<(Vec<NamedValue>, Vec<NamedValue>)>,
    /// Reason why the claim has no sweep.
    pub reason: Option<String>,
}

/// A sweep with its request.
pub struct SweepReport<'r> {
    /// Title of the case.
    pub title: &'r str,
    /// Name of the case, for the command that evaluates it.
    pub path: &'r str,
    /// Values of `--set`.
    pub settings: &'r [String],
    /// Number of states.
    pub states: u64,
    /// Seed of the states.
    pub seed: u64,
    /// Results of the claims.
    pub found: &'r [Found],
}

impl SweepReport<'_> {
    /// Renders a few lines for each claim.
    pub fn text(&self) -> String {
        let mut out = format!("{}\n{} states of seed {}\n", self.title, self.states, self.seed);
        for Found { claim, found, at, reason } in self.found {
            match (found.peak, reason) {
                (_, Some(reason)) => out.push_str(&format!("{claim}: no sweep: {reason}\n")),
                (None, None) => out.push_str(&format!("{claim}: the residual has no value\n")),
                (Some(peak), None) => {
                    out.push_str(&format!("{claim}: at most {:.3e} of its scale", peak.ratio));
                    let undefined = found.states - found.defined;
                    if undefined > 0 {
                        out.push_str(&format!(", without a value at {undefined} states"));
                    }
                    out.push_str(&format!("; largest at state {}\n", peak.index));
                }
            }
            if let Some((parameters, state)) = at {
                out.push_str(&format!("  {}\n", self.command(parameters, state)));
            }
        }
        out
    }

    /// Command that evaluates the case at a state.
    fn command(&self, parameters: &[NamedValue], state: &[NamedValue]) -> String {
        let set = self.settings.iter().cloned().chain(parameters.iter().map(equation));
        let set: String = set.map(|word| format!("--set {} ", shell_quoted(&word))).collect();
        let state: Vec<String> = state.iter().map(equation).collect();
        let (path, state) = (shell_quoted(self.path), shell_quoted(&state.join(" ")));
        format!("liouville eval {path} {set}--state {state}")
    }

    /// Renders the results as JSON.
    pub fn json(&self) -> Result<String, serde_json::Error> {
        let named = |values: &[NamedValue]| -> Value {
            values.iter().map(|(name, value)| (name.clone(), json!(value))).collect()
        };
        let entry = |own: &Found| {
            json!({
                "claim": own.claim,
                "states": own.found.states,
                "defined": own.found.defined,
                "largest": own.found.peak.map(|peak| peak.ratio),
                "index": own.found.peak.map(|peak| peak.index),
                "parameters": own.at.as_ref().map(|(parameters, _)| named(parameters)),
                "state": own.at.as_ref().map(|(_, state)| named(state)),
                "reason": own.reason,
            })
        };
        let claims: Vec<Value> = self.found.iter().map(entry).collect();
        serde_json::to_string_pretty(&json!({
            "title": self.title,
            "states": self.states,
            "seed": self.seed,
            "claims": claims,
        }))
    }
}

fn equation((name, value): &NamedValue) -> String {
    format!("{name}={value}")
}
