//! Catalogue of cases, and cases to start from, as texts inside the program.

use std::path::Path;

pub mod templates;

/// Cases of the catalogue: path from `cases/` on, and text; sorted by path.
pub static CATALOGUE: &[(&str, &str)] = &include!(concat!(env!("OUT_DIR"), "/catalogue.rs"));

/// Returns the title of a case.
pub fn title(text: &str) -> &str {
    let value = text.lines().find_map(|line| line.strip_prefix("title"));
    value.map_or("", |value| value.trim_matches([' ', '=', '"', '\'']))
}

/// Lists the cases of the catalogue that a path names: a case, with or without `cases/` and
/// `.toml`, or all cases of a folder.
pub fn inside(path: &Path) -> Vec<(&'static str, &'static str)> {
    let Some(text) = path.to_str() else { return Vec::new() };
    let text = text.strip_prefix("./").unwrap_or(text).trim_end_matches('/');
    let matches = |name: &str| {
        let short = name.strip_prefix("cases/").unwrap_or(name);
        [name, short].iter().any(|name| {
            let rest = name.strip_prefix(text);
            rest.is_some_and(|rest| rest.is_empty() || rest == ".toml" || rest.starts_with('/'))
        })
    };
    CATALOGUE.iter().copied().filter(|(name, _)| !text.is_empty() && matches(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_are_found_by_path_with_and_without_the_folder() {
        for name in
            ["cases/plane/balanced-ball.toml", "plane/balanced-ball", "./plane/balanced-ball"]
        {
            let found = inside(Path::new(name));
            assert_eq!(found.len(), 1, "{name}");
            assert_eq!(found[0].0, "cases/plane/balanced-ball.toml");
        }
        assert!(inside(Path::new("plane/")).len() > 10, "a folder");
        assert_eq!(inside(Path::new("cases")).len(), CATALOGUE.len());
        for name in ["pla", "plane/balanced", "", "cases/nothing"] {
            assert!(inside(Path::new(name)).is_empty(), "{name}");
        }
    }
}
