//! The command `liouville verify`: proofs about motion, replayed from their certificates.

use std::path::{Path, PathBuf};

use crate::report::certificate::FORMAT;
use crate::report::motion_certificate::verify;
use clap::Args;
use liouville::verdict::Options;
use liouville_search::Meter;

use super::eval::read_settings;
use super::progress::telling;
use super::threads::pool;
use super::{CommandOutput, LimitArgs, parse_threads, source};

#[derive(Debug, Args)]
pub struct Verify {
    /// Certificates, as `liouville check --motion --certificate FOLDER` writes them
    #[arg(required = true)]
    pub certificates: Vec<PathBuf>,
    #[command(flatten)]
    pub limits: LimitArgs,
    /// Seed of the primes with which conserved quantities are proved again
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Number of threads; all cores by default
    #[arg(long, value_parser = parse_threads)]
    pub threads: Option<usize>,
}

pub fn run(options: &Verify) -> Result<CommandOutput, String> {
    let pool = pool(options.threads.unwrap_or(0))?;
    let (mut text, mut refused) = (String::new(), 0);
    for path in &options.certificates {
        let told = telling(Meter::default(), |tell| {
            tell(&format!("replaying {}", path.display()));
            pool.install(|| one(path, options))
        });
        match told? {
            Ok(told) => text.push_str(&told),
            Err(reason) => {
                refused += 1;
                text.push_str(&format!("REFUSED  {}: {reason}\n", path.display()));
            }
        }
    }
    let count = options.certificates.len();
    let noun = if count == 1 { "certificate" } else { "certificates" };
    text.push_str(&format!("{count} {noun}: {} proved, {refused} refused\n", count - refused));
    Ok(CommandOutput { text, code: u8::from(refused > 0) })
}

/// Verifies a certificate. The outer error is that of a file that cannot be read.
fn one(path: &Path, options: &Verify) -> Result<Result<String, String>, String> {
    let help = "`liouville check CASE --motion --certificate FOLDER` writes certificates";
    let text = source::text(path, help)?;
    let read: Option<serde_json::Value> = serde_json::from_str(&text).ok();
    if read.is_some_and(|own| own.get("format").is_some_and(|format| format == FORMAT)) {
        let reason = "a proof by points, which `python3 docs/certificates/check.py` checks";
        return Ok(Err(reason.to_string()));
    }
    let judging = Options { seed: options.seed, ..Options::default() };
    Ok(verify(&text, &judging, &read_settings).map(|report| {
        let theorem = report.evidence.theorem.unwrap_or_default();
        format!("proved   {}: {}\n         {theorem}\n", path.display(), report.name)
    }))
}
