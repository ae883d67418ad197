//! Mutations of texts: bytes, tokens, lines, and pieces of other files.

use std::path::{Path, PathBuf};
use std::{fs, io};

use liouville::number::{GOLDEN, scrambled};

/// Tokens that formulas and case files are made of, and some that they are not.
const TOKENS: [&str; 84] = [
    "+",
    "-",
    "−",
    "*",
    "/",
    "^",
    "²",
    "⁻¹",
    "ᵀ",
    "√",
    "∫",
    "×",
    "⊗",
    "|",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    "=",
    "≠",
    "<",
    "..",
    ".",
    "'",
    "\"",
    "\\",
    "\n",
    " ",
    "γ",
    "ω",
    "M",
    "E",
    "e",
    "π",
    "t",
    "x",
    "m",
    "R",
    "I",
    "J",
    "h",
    "energy",
    "1",
    "0",
    "2",
    "1/3",
    "1e400",
    "99999999999999999999",
    "0.5",
    "-1",
    "sin(",
    "exp(",
    "log(",
    "sqrt(",
    "tr(",
    "det(",
    "inverse(",
    "sum(i, 1..n, ",
    "vector(",
    "matrix(",
    "if(i = j, ",
    "max(",
    "atan2(",
    "[[claim]]",
    "[let]",
    "[state]",
    "[field]",
    "integral",
    "density",
    "expect",
    "fails",
    "vector(3, -1..1)",
    "1..2",
    "inertia(0.5..5)",
    "mod",
    "\u{0}",
    "é",
    "𝒥",
    "\u{202e}",
    "#",
];

/// Formulas that are put into claims.
const HEADS: [&str; 3] = [
    "title = 't'\nsystem = 'rubber-plane'\n[parameters]\nm = '0.5..2'\nR = '1..3'\nI = 'inertia(0.5..5)'\n\
     c = 'vector(-0.4..0.4)'\n[body]\nshape = 'ball'\n",
    "title = 't'\n[parameters]\nn = 3\nk = '1..2'\nA = 'matrix(-1..1)'\n[state]\nx = 'vector(n, -1..1)'\n\
     M = 'vector(-2..2)'\n[field]\n\"x[i]'\" = 'x[i]'\n\"M'\" = 'M × A*M'\n",
    "title = 't'\n[state]\nx = '1..2'\ny = '-1..1'\n[field]\n\"x'\" = 'y'\n\"y'\" = '-x'\n",
];

/// Random numbers: xorshift, the same on every machine.
pub struct Random(u64);

impl Random {
    /// Numbers for one input, which depend on the seed and its index alone.
    pub fn new(seed: u64, index: u64) -> Self {
        // two rounds of SplitMix64
        let mut word = seed.wrapping_mul(GOLDEN) ^ index;
        for _ in 0..2 {
            word = scrambled(word.wrapping_add(GOLDEN));
        }
        Self(word | 1)
    }

    /// A number below a bound.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as usize % bound.max(1)
    }

    /// One of some items.
    pub fn of<'a, T>(&mut self, items: &'a [T]) -> Option<&'a T> {
        items.get(self.below(items.len()))
    }
}

/// Texts from which inputs are made.
pub struct Corpus {
    files: Vec<String>,
    formulas: Vec<String>,
}

impl Corpus {
    /// Reads all case files of some folders, and the formulas between quotes in them.
    pub fn read(folders: &[PathBuf]) -> io::Result<Self> {
        let mut files = Vec::new();
        for folder in folders {
            gather(folder, &mut files)?;
        }
        let mut formulas = Vec::new();
        for line in files.iter().flat_map(|file| file.lines()) {
            let inner = line.split_once('"').and_then(|(_, rest)| rest.rsplit_once('"'));
            formulas.extend(inner.map(|(formula, _)| formula.to_string()));
        }
        formulas.sort();
        formulas.dedup();
        Ok(Self { files, formulas })
    }

    /// A mutated file, or a mutated formula in a claim.
    pub fn input(&self, random: &mut Random) -> String {
        if random.below(4) == 0 {
            let file = random.of(&self.files).cloned().unwrap_or_default();
            return self.mutated(file, random);
        }
        let formula = random.of(&self.formulas).cloned().unwrap_or_default();
        let formula = self.mutated(formula, random);
        let head = random.of(&HEADS).copied().unwrap_or_default();
        let keys = ["integral", "density", "identity", "rate", "lyapunov", "independent"];
        let key = random.of(&keys).copied().unwrap_or("integral");
        let quoted = formula.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', " ");
        let equals = if matches!(key, "rate" | "lyapunov") { "equals = \"0\"\n" } else { "" };
        format!("{head}[[claim]]\n{key} = \"{quoted}\"\n{equals}")
    }

    fn mutated(&self, mut text: String, random: &mut Random) -> String {
        if random.below(2) == 0 {
            for _ in 0..=random.below(3) {
                text = gentle(&text, random);
            }
            return text;
        }
        for _ in 0..=random.below(6) {
            let at = boundary(&text, random.below(text.len() + 1));
            match random.below(8) {
                0 | 1 => text.insert_str(at, random.of(&TOKENS).copied().unwrap_or_default()),
                2 => {
                    let end = boundary(&text, at + random.below(12));
                    text.replace_range(at..end, "");
                }
                3 => {
                    let end = boundary(&text, at + 1 + random.below(20));
                    let piece = text[at..end].to_string();
                    text.insert_str(at, &piece.repeat(1 + random.below(3)));
                }
                4 => {
                    let other = random.of(&self.formulas).cloned().unwrap_or_default();
                    let start = boundary(&other, random.below(other.len() + 1));
                    text.insert_str(at, &other[start..]);
                }
                5 => {
                    let end = boundary(&text, at + random.below(4));
                    let token = random.of(&TOKENS).copied().unwrap_or_default();
                    text.replace_range(at..end, token);
                }
                6 => {
                    let mut lines: Vec<&str> = text.lines().collect();
                    let (from, to) = (random.below(lines.len()), random.below(lines.len()));
                    if from < lines.len() && to < lines.len() {
                        lines.swap(from, to);
                    }
                    text = lines.join("\n");
                }
                _ => {
                    let open = random.of(&["(", "[", "-", "√", "|", "exp(", "x^"]).copied();
                    text.insert_str(at, &open.unwrap_or("(").repeat(1 + random.below(300)));
                }
            }
        }
        text
    }
}

/// Words that may take the place of each other without the loss of all sense.
const WORDS: [&str; 22] = [
    "x", "y", "M", "M1", "γ", "γ3", "ω", "ω1", "m", "R", "I", "J", "A", "k", "energy", "0", "1",
    "2", "7", "1000000", "n", "t",
];

/// Replaces a name or a number by another.
fn gentle(text: &str, random: &mut Random) -> String {
    let at = boundary(text, random.below(text.len() + 1));
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let Some(start) = text[at..].find(is_word).map(|offset| at + offset) else {
        return text.to_string();
    };
    let end = text[start..].find(|c| !is_word(c)).map_or(text.len(), |offset| start + offset);
    let word = random.of(&WORDS).copied().unwrap_or_default();
    format!("{}{word}{}", &text[..start], &text[end..])
}

fn gather(folder: &Path, files: &mut Vec<String>) -> io::Result<()> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    paths.sort();
    for path in paths {
        if path.is_dir() {
            gather(&path, files)?;
        } else if path.extension().is_some_and(|ending| ending == "toml") {
            files.push(fs::read_to_string(path)?);
        }
    }
    Ok(())
}

/// The first place from `at` on at which a character begins, or the end.
fn boundary(text: &str, at: usize) -> usize {
    (at..text.len()).find(|place| text.is_char_boundary(*place)).unwrap_or(text.len())
}
