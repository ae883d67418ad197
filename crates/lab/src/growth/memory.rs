//! Largest resident memory of the process, as Linux tells it.

/// Makes the system count the largest resident memory anew.
pub fn forget_peak() {
    // Where the system refuses, the peak stays that of the whole run.
    _ = std::fs::write("/proc/self/clear_refs", "5");
}

/// Returns the largest resident memory in bytes since it was last forgotten.
pub fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(1024 * kibibytes)
}
