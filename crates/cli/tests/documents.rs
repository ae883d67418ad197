//! The commands of the tutorial and of the README run, and print what stands there.
//!
//! A block `toml NAME` is written to that file, each line of a block `sh` that begins with
//! `liouville` is run, and each line of the next block `text` has to be among what was printed.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// A fenced block: the words behind the fence, and its text.
struct Block {
    words: String,
    text: String,
}

fn blocks(page: &str) -> Vec<Block> {
    let parts: Vec<&str> = page.split("```").collect();
    let inside = parts.iter().skip(1).step_by(2);
    let block = inside.map(|part| {
        let (words, text) = part.split_once('\n').expect("a fence ends its line");
        Block { words: words.trim().to_string(), text: text.to_string() }
    });
    block.collect()
}

/// Runs a line in a shell that finds the program.
fn run(line: &str, folder: &Path) -> Output {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_liouville"));
    let own = program.parent().expect("a folder").to_path_buf();
    let others = env::split_paths(&env::var_os("PATH").unwrap_or_default()).collect::<Vec<_>>();
    let path = env::join_paths(std::iter::once(own).chain(others)).expect("a path");
    let mut shell = Command::new("sh");
    shell.args(["-c", line]).current_dir(folder).env("PATH", path).env("NO_COLOR", "1");
    shell.output().expect("it runs")
}

/// Text with single spaces.
fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Runs a page; returns how many commands it has.
fn follow(page: &str) -> usize {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let text = fs::read_to_string(root.join(page)).expect("the page");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(page.replace(['/', '.'], "-"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a scratch folder");
    let (mut printed, mut commands) = (String::new(), 0);
    for block in blocks(&text) {
        match block.words.split_once(' ').unwrap_or((&block.words, "")) {
            ("toml", name) if !name.is_empty() => {
                fs::write(folder.join(name), &block.text).expect("a scratch file");
            }
            ("sh", _) => {
                printed.clear();
                for line in block.text.lines().filter(|line| line.starts_with("liouville ")) {
                    let (_, code) = line.split_once("# exit code ").unwrap_or(("", "0"));
                    let output = run(line, &folder);
                    let both = [output.stdout, output.stderr].concat();
                    printed.push_str(&String::from_utf8_lossy(&both));
                    let found = output.status.code().map(|code| code.to_string());
                    assert_eq!(found.as_deref(), Some(code.trim()), "{page}: {line}\n{printed}");
                    commands += 1;
                }
                printed = plain(&printed);
            }
            ("text", _) => {
                for line in block.text.lines().map(plain).filter(|line| !line.is_empty()) {
                    assert!(printed.contains(&line), "{page}: `{line}` is not in\n{printed}");
                }
            }
            _ => {}
        }
    }
    commands
}

#[test]
fn the_tutorial_runs() {
    assert!(follow("docs/tutorial.md") >= 7, "commands of the tutorial");
}

#[test]
fn the_readme_runs() {
    assert!(follow("README.md") >= 3, "commands of the README");
}
