//! The commands of the tutorial and of the README run, and print what stands there.
//!
//! A block `toml NAME` is written to that file, each line of a block `sh` that begins with
//! `liouville` is run, and each line of the next block `text` has to be among what was printed.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

use rayon::prelude::*;

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

/// A picture of the gallery: its file, and the arguments that draw it.
struct Picture {
    file: String,
    arguments: Vec<String>,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Pictures that `docs/gallery/pictures.toml` lists, a key a line.
fn pictures() -> Vec<Picture> {
    let text = fs::read_to_string(root().join("docs/gallery/pictures.toml")).expect("the list");
    let values = |key: &str| -> Vec<String> {
        let lines = text.lines().filter_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
        lines.map(|value| value.trim_matches('"').to_string()).collect()
    };
    let common = values("options").concat();
    let (files, commands) = (values("file"), values("draw"));
    assert!(files.len() == commands.len() && files.len() > 20, "each file has its command");
    let arguments = |own: &String| {
        let common = if own.contains("--width") { "" } else { common.as_str() };
        let all = format!("{own} {common}");
        // Single quotes hold words with spaces.
        let parts = all.split('\'').enumerate();
        let words = parts.flat_map(|(place, part)| match place % 2 {
            0 => part.split_whitespace().map(str::to_string).collect(),
            _ => vec![part.to_string()],
        });
        words.collect()
    };
    let pairs = files.into_iter().zip(&commands);
    pairs.map(|(file, own)| Picture { file, arguments: arguments(own) }).collect()
}

/// Draws a picture with the program.
fn draw(arguments: &[String], out: &Path) -> Vec<u8> {
    let mut program = Command::new(env!("CARGO_BIN_EXE_liouville"));
    program.args(arguments).arg("--out").arg(out).current_dir(root());
    let output = program.output().expect("it runs");
    assert!(output.status.success(), "{arguments:?}\n{}", String::from_utf8_lossy(&output.stderr));
    fs::read(out).expect("a picture")
}

fn digest(parts: &[&[u8]]) -> String {
    use sha2::Digest;
    let mut hash = sha2::Sha256::new();
    for part in parts {
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    hash.finalize().iter().take(12).map(|byte| format!("{byte:02x}")).collect()
}

/// Part of a case that its picture depends on: all before its claims, and the points that it marks.
fn drawn_part(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a case");
    let mut parts = text.split("[[claim]]");
    let mut found = parts.next().unwrap_or_default().to_string();
    for claim in parts.filter(|claim| claim.contains("periodic-point")) {
        let keys = ["periodic-point", "period ", "stability", "expect"];
        let lines = claim.lines().filter(|line| keys.iter().any(|key| line.starts_with(key)));
        lines.for_each(|line| found.push_str(line));
    }
    found
}

/// The gallery is redrawn by `LIOUVILLE_BLESS=1 cargo test --release -p liouville-cli --test cli documents`.
#[test]
fn the_gallery_shows_what_the_program_draws() {
    let scratch = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("gallery");
    fs::create_dir_all(&scratch).expect("a scratch folder");
    // A small picture, which differs where the program draws or moves otherwise.
    let sample =
        "motion section cases/figures/fig-8.toml --orbits 3 --crossings 20 --skip 0 --width 60";
    let sample: Vec<String> = sample.split(' ').map(str::to_string).collect();
    let style = draw(&sample, &scratch.join("sample.png"));
    let gallery = root().join("docs/gallery");
    let list = gallery.join("digests.txt");
    let known = fs::read_to_string(&list).unwrap_or_default();
    let blesses = env::var_os("LIOUVILLE_BLESS").is_some();
    let current = |Picture { file, arguments }: &Picture| {
        let cases = arguments.iter().filter(|argument| argument.ends_with(".toml"));
        let cases: Vec<String> = cases.map(|case| drawn_part(&root().join(case))).collect();
        let (words, cases) = (arguments.join("\0"), cases.join("\0"));
        let path = gallery.join(file);
        let line = |bytes: &[u8]| {
            let inputs = digest(&[words.as_bytes(), cases.as_bytes(), &style]);
            format!("{file} {inputs} {}", digest(&[bytes]))
        };
        let found = fs::read(&path).map(|bytes| line(&bytes)).unwrap_or_default();
        match known.lines().any(|known| known == found) {
            true => Ok(found),
            false if blesses => Ok(line(&draw(arguments, &path))),
            false => Err(file.clone()),
        }
    };
    let lines: Vec<Result<String, String>> = pictures().par_iter().map(current).collect();
    let stale: Vec<&str> =
        lines.iter().filter_map(|line| line.as_deref().err().map(String::as_str)).collect();
    if blesses {
        let lines: Vec<&str> = lines.iter().flatten().map(String::as_str).collect();
        fs::write(&list, lines.join("\n") + "\n").expect("the digests are written");
    }
    let remedy = "LIOUVILLE_BLESS=1 cargo test --release -p liouville-cli --test cli gallery";
    assert!(stale.is_empty(), "draw anew, by {remedy}: {}", stale.join(", "));
}

#[test]
fn the_gallery_lists_all_pictures_of_its_folder() {
    let page = fs::read_to_string(root().join("docs/gallery.md")).expect("the page");
    let listed: Vec<String> = pictures().into_iter().map(|picture| picture.file).collect();
    for file in &listed {
        assert!(page.contains(&format!("gallery/{file}")), "{file} is on the page");
    }
    for entry in fs::read_dir(root().join("docs/gallery")).expect("a folder").flatten() {
        let name = entry.file_name().to_string_lossy().to_string();
        let is_picture = [".png", ".svg", ".pdf"].iter().any(|ending| name.ends_with(ending));
        assert!(!is_picture || listed.contains(&name), "{name} is drawn by the list");
    }
}

#[test]
fn the_contents_list_all_pages() {
    let contents = fs::read_to_string(root().join("docs/SUMMARY.md")).expect("the contents");
    let listed: Vec<&str> = contents
        .split("](")
        .skip(1)
        .map(|rest| rest.split(')').next().expect("a link ends"))
        .collect();
    for page in &listed {
        assert!(root().join("docs").join(page).is_file(), "{page} is there");
    }
    for entry in fs::read_dir(root().join("docs")).expect("a folder").flatten() {
        let name = entry.file_name().to_string_lossy().to_string();
        let is_page = name.ends_with(".md") && name != "SUMMARY.md";
        assert!(!is_page || listed.contains(&name.as_str()), "{name} is in the contents");
    }
}
