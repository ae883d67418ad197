//! Peak memory of commands, against the table of docs/performance.md.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

/// Largest multiple of the stated peak: other machines have other allocators.
const ROOM: f64 = 1.6;

/// Commands of the first table of "Memory", with their megabytes.
fn stated() -> Vec<(String, f64)> {
    let docs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/performance.md");
    let text = fs::read_to_string(docs).expect("the page is there");
    let (_, section) = text.split_once("## Memory").expect("a section about memory");
    let row = |line: &str| {
        let (command, rest) = line.strip_prefix("| `")?.split_once("` | ")?;
        let (peak, _) = rest.split_once(" MB |")?;
        Some((command.to_string(), peak.parse().ok()?))
    };
    let table = section.lines().skip_while(|line| row(line).is_none());
    table.map_while(row).collect()
}

/// Largest peak seen of a command in megabytes, where the system tells.
fn peak(command: &str) -> Option<f64> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../cases");
    let arguments = command.split(' ').map(|word| word.trim_matches('\''));
    let mut child = Command::new(env!("CARGO_BIN_EXE_liouville"))
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("starts");
    let status = format!("/proc/{}/status", child.id());
    let mut most = None;
    let ended = loop {
        let kilobytes = fs::read_to_string(&status).ok().and_then(|text| {
            let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
            line.split_whitespace().next()?.parse::<f64>().ok()
        });
        most = kilobytes.map(|kilobytes| kilobytes / 1024.0).or(most);
        match child.try_wait().expect("a child") {
            Some(ended) => break ended,
            None => std::thread::sleep(Duration::from_millis(1)),
        }
    };
    assert!(ended.code().is_some_and(|code| code <= 1), "`liouville {command}`: {ended}");
    most
}

#[test]
fn commands_take_the_memory_that_is_stated() {
    let stated = stated();
    assert!(stated.len() >= 12, "one command of each kind: {stated:?}");
    for (command, megabytes) in stated {
        let Some(found) = peak(&command) else { continue };
        assert!(
            found <= ROOM * megabytes,
            "`liouville {command}` took {found:.0} MB, and not {megabytes} MB"
        );
    }
}
