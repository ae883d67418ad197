//! The files of the collection, and their schema.

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Usual number of seeds to test; `LIOUVILLE_DRAWS` times as many are, if it is set. A correct answer does
/// not depend on the states drawn, and a wrong one that is avoided by chance at one seed appears at
/// another: so `.ci/nightly` takes ten.
const SEEDS: u64 = 1;

/// A system with claims about it.
#[derive(Clone, Debug)]
pub struct Group {
    /// Subject of all its claims.
    pub shows: String,
    /// Case without claims.
    pub case: String,
    /// Whether all claims are in one file.
    pub together: bool,
    /// Number of seeds to test.
    pub seeds: u64,
    /// Claims with their answers.
    pub claims: Vec<Claim>,
}

/// A claim as typed, with the allowed answers.
#[derive(Clone, Debug)]
pub struct Claim {
    /// Lines of its table.
    pub body: String,
    /// Correct answers, as words.
    pub right: String,
    /// Further requirement, if any.
    pub also: Option<String>,
}

/// A search, with the theorems that it must not state.
#[derive(Clone, Debug)]
pub struct Asked {
    pub shows: String,
    pub case: String,
    /// Hamiltonian of the brackets to search for.
    pub hamiltonian: Option<String>,
    /// Parts of wrong theorems.
    pub wrong: Vec<String>,
    /// A degree, and a lower bound on the number of integrals up to it.
    pub least: Option<(u32, usize)>,
    /// Whether there is a density that depends on the positions alone.
    pub density: bool,
    /// Number of seeds to test.
    pub seeds: u64,
}

/// A file that is refused, with the line that the complaint shows.
#[derive(Clone, Debug)]
pub struct Complaint {
    pub shows: String,
    pub case: String,
    pub line: usize,
}

/// A case whose mutants are all refuted or equivalent.
#[derive(Clone, Debug)]
pub struct Mutation {
    pub shows: String,
    pub case: String,
}

/// One entry of a file.
#[derive(Clone, Debug)]
pub enum Entry {
    Group(Group),
    Search(Asked),
    Complaint(Complaint),
    Mutation(Mutation),
}

/// Returns all entries of the files in a folder, in order.
pub fn entries(folder: &str) -> Vec<Entry> {
    let listed = std::fs::read_dir(Path::new(folder)).expect("the collection is a folder");
    let mut paths: Vec<PathBuf> = listed.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    paths.iter().flat_map(|path| entries_of(path)).collect()
}

fn entries_of(path: &Path) -> Vec<Entry> {
    let text = std::fs::read_to_string(path).expect("a file of the collection");
    let root = DeTable::parse(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut found = Vec::new();
    for (kind, list) in in_order(root.get_ref()) {
        let DeValue::Array(list) = list else { panic!("{}: {kind} is a list", path.display()) };
        for item in list.iter() {
            let DeValue::Table(table) = item.get_ref() else { panic!("an entry is a table") };
            let table = Table(table);
            found.push(match kind.as_str() {
                "group" => Entry::Group(group(&table)),
                "search" => Entry::Search(asked(&table)),
                "complaint" => Entry::Complaint(Complaint {
                    shows: table.text("shows"),
                    case: table.text("case"),
                    line: table.number("line"),
                }),
                "mutation" => Entry::Mutation(Mutation {
                    shows: table.text("shows"),
                    case: table.text("case"),
                }),
                other => panic!("{}: `{other}` is no kind of entry", path.display()),
            });
        }
    }
    found
}

fn group(table: &Table<'_, '_>) -> Group {
    let (state, field) = (table.pairs("state"), table.pairs("field"));
    let mut case = String::from("title = \"t\"\n");
    let more = table.optional("more").unwrap_or_default();
    // Text before the first table belongs to the head.
    let (head, tables) = more.split_at(more.find('[').unwrap_or(more.len()));
    case.push_str(head);
    let write = |case: &mut String, name: &str, pairs: &[(String, String)]| {
        if !pairs.is_empty() {
            case.push_str(&format!("[{name}]\n"));
        }
        for (key, value) in pairs {
            case.push_str(&format!("\"{key}\" = \"{value}\"\n"));
        }
    };
    write(&mut case, "parameters", &table.pairs("parameters"));
    write(&mut case, "state", &state);
    // Variables without a rate are constant.
    let still = |name: &str, range: &str| match range.starts_with("vector") {
        true => format!("0*{name}"),
        false => "0".to_string(),
    };
    let rate = |(name, range): &(String, String)| {
        let given = field.iter().find(|(known, _)| known == name);
        (format!("{name}'"), given.map_or_else(|| still(name, range), |(_, rate)| rate.clone()))
    };
    match &table.pairs("map")[..] {
        [] => write(&mut case, "field", &state.iter().map(rate).collect::<Vec<_>>()),
        map => write(&mut case, "map", map),
    }
    let level = table.texts("level");
    if !level.is_empty() {
        let quoted: Vec<String> = level.iter().map(|text| format!("\"{text}\"")).collect();
        case.push_str(&format!("[level]\nequations = [{}]\n", quoted.join(", ")));
    }
    case.push_str(tables);
    let claims = table.array("claims").into_iter().map(|claim| match &claim[..] {
        [right, body] => Claim { body: body.clone(), right: right.clone(), also: None },
        [right, body, also] => {
            Claim { body: body.clone(), right: right.clone(), also: Some(also.clone()) }
        }
        other => panic!("a claim has answers and a text: {other:?}"),
    });
    let claims = claims.collect();
    Group {
        shows: table.text("shows"),
        case,
        together: table.has("together"),
        seeds: table.seeds(),
        claims,
    }
}

fn asked(table: &Table<'_, '_>) -> Asked {
    let least = table
        .table("least")
        .map(|least| (least.number("degree") as u32, least.number("integrals")));
    Asked {
        shows: table.text("shows"),
        case: table.text("case"),
        hamiltonian: table.optional("hamiltonian"),
        wrong: table.texts("false"),
        least,
        density: table.has("density"),
        seeds: table.seeds(),
    }
}

/// A table with access to values by name.
struct Table<'t, 'i>(&'t DeTable<'i>);

impl Table<'_, '_> {
    fn get(&self, key: &str) -> Option<&DeValue<'_>> {
        self.0.get(key).map(Spanned::get_ref)
    }

    fn has(&self, key: &str) -> bool {
        self.0.get(key).is_some()
    }

    fn optional(&self, key: &str) -> Option<String> {
        self.get(key).map(string)
    }

    fn text(&self, key: &str) -> String {
        self.optional(key).unwrap_or_else(|| panic!("an entry has `{key}`"))
    }

    fn number(&self, key: &str) -> usize {
        match self.get(key) {
            Some(DeValue::Integer(number)) => number.to_string().parse().expect("a small number"),
            other => panic!("`{key}` is a number, not {other:?}"),
        }
    }

    /// Returns the number of seeds: few where a judgement takes seconds.
    fn seeds(&self) -> u64 {
        let times = std::env::var("LIOUVILLE_DRAWS").ok();
        let times = times.map_or(1, |text| text.parse().expect("LIOUVILLE_DRAWS is a number"));
        if self.has("seeds") { self.number("seeds") as u64 } else { SEEDS * times }
    }

    fn table(&self, key: &str) -> Option<Table<'_, '_>> {
        self.get(key).map(|value| match value {
            DeValue::Table(table) => Table(table),
            other => panic!("`{key}` is a table, not {other:?}"),
        })
    }

    fn texts(&self, key: &str) -> Vec<String> {
        self.get(key).map_or(Vec::new(), strings)
    }

    fn array(&self, key: &str) -> Vec<Vec<String>> {
        match self.get(key) {
            Some(DeValue::Array(list)) => list.iter().map(|item| strings(item.get_ref())).collect(),
            other => panic!("`{key}` is a list, not {other:?}"),
        }
    }

    /// Returns names and texts, in the order of the file.
    fn pairs(&self, key: &str) -> Vec<(String, String)> {
        let Some(table) = self.table(key) else { return Vec::new() };
        in_order(table.0).into_iter().map(|(name, value)| (name, string(value))).collect()
    }
}

/// Returns the entries of a table in the order of the file.
fn in_order<'t, 'i>(table: &'t DeTable<'i>) -> Vec<(String, &'t DeValue<'i>)> {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    entries.into_iter().map(|(key, value)| (key.get_ref().to_string(), value.get_ref())).collect()
}

fn string(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => text.to_string(),
        other => panic!("a text is expected, not {other:?}"),
    }
}

fn strings(value: &DeValue<'_>) -> Vec<String> {
    match value {
        DeValue::Array(list) => list.iter().map(|item| string(item.get_ref())).collect(),
        other => panic!("a list of texts is expected, not {other:?}"),
    }
}
