//! Index of a site of reports: by hierarchy, and by folder.

use liouville_search::survey::HierarchyClass;

use crate::typeset::mathml::escaped;
use crate::{FileFailure, counted};

const STYLE: &str = include_str!("survey/page.css");

/// A case of the site.
#[derive(Clone, Debug)]
pub struct Page {
    /// Path of the case, as it was found.
    pub path: String,
    /// Title of the case.
    pub title: String,
    /// Description of the system in one sentence.
    pub lead: String,
    /// Publication that the case is taken from.
    pub source: String,
    /// Outcome for the case.
    pub outcome: SiteOutcome,
}

/// Outcome for a case of the site.
#[derive(Clone, Debug)]
pub enum SiteOutcome {
    /// A report, in the file of this name, with `/` between folders.
    Report(String, SiteGroup),
    /// No report: the reasons.
    Failed(Vec<FileFailure>),
    /// No report, because the run was stopped.
    Unreached,
}

/// Group of a case in the index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteGroup {
    /// Class of the system in the hierarchy.
    Class(HierarchyClass),
    /// Verdicts on the claims alone.
    Claims,
}

/// Order of the index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiteOrder {
    /// By the class of the system.
    Hierarchy,
    /// By the folder of the case.
    Folder,
}

impl SiteOrder {
    /// Both orders.
    pub const ALL: [Self; 2] = [Self::Hierarchy, Self::Folder];

    /// Name of the file of the index in this order.
    pub fn file(self) -> &'static str {
        match self {
            Self::Hierarchy => "index.html",
            Self::Folder => "folders.html",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Hierarchy => "by hierarchy",
            Self::Folder => "by folder",
        }
    }
}

/// Groups of the hierarchy in the order of the index.
const STANDINGS: [SiteGroup; 6] = [
    SiteGroup::Class(HierarchyClass::IntegralAndMeasure),
    SiteGroup::Class(HierarchyClass::MeasureOnly),
    SiteGroup::Class(HierarchyClass::IntegralOnly),
    SiteGroup::Class(HierarchyClass::Neither),
    SiteGroup::Class(HierarchyClass::NotKnown),
    SiteGroup::Claims,
];

impl SiteGroup {
    fn words(self) -> &'static str {
        match self {
            Self::Class(HierarchyClass::NotKnown) => "class not known",
            Self::Class(class) => class.words(),
            Self::Claims => "verdicts on claims alone",
        }
    }
}

/// Renders the index in an order; `origin` names the program.
pub fn index(title: &str, origin: &str, pages: &[Page], order: SiteOrder) -> String {
    let (title, mut groups) = (escaped(title), Vec::new());
    match order {
        SiteOrder::Hierarchy => groups.extend(STANDINGS.iter().map(|standing| {
            let is_meant = |page: &&Page| page.standing() == Some(*standing);
            (standing.words().to_string(), pages.iter().filter(is_meant).collect::<Vec<_>>())
        })),
        SiteOrder::Folder => {
            for page in pages.iter().filter(|page| page.standing().is_some()) {
                let folder = page.path.rsplit_once('/').map_or("", |(folder, _)| folder);
                match groups.iter_mut().find(|(own, _)| own == folder) {
                    Some((_, members)) => members.push(page),
                    None => groups.push((folder.to_string(), vec![page])),
                }
            }
        }
    }
    groups.retain(|(_, members)| !members.is_empty());
    let others = SiteOrder::ALL.into_iter().map(|other| match other == order {
        true => format!("<li>{}</li>\n", other.words()),
        false => format!("<li><a href=\"{}\">{}</a></li>\n", other.file(), other.words()),
    });
    let others: String = others.collect();
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<header>\n\
         <h1>{title}</h1>\n<p class=\"lead\">{}, {}</p>\n</header>\n<nav><ul>\n{others}</ul></nav>\n\
         <nav><ul>\n",
        counted(pages.iter().filter(|page| page.standing().is_some()).count(), "report"),
        escaped(origin),
    );
    let (failed, unreached) = (failed(pages), unreached(pages));
    let mut headings: Vec<(String, usize)> =
        groups.iter().map(|(words, members)| (words.clone(), members.len())).collect();
    headings.extend([("not reached".to_string(), unreached.len())]);
    headings.extend([("without a report".to_string(), failed.len())]);
    headings.retain(|(_, count)| *count > 0);
    for (number, (words, count)) in headings.iter().enumerate() {
        out.push_str(&format!("<li><a href=\"#s{number}\">{}</a> {count}</li>\n", escaped(words)));
    }
    out.push_str("</ul></nav>\n");
    let contents =
        groups.iter().map(|(_, members)| members.iter().map(|page| entry(page, order)).collect());
    let contents = contents.chain([unreached.concat(), failed.concat()]);
    let contents = contents.filter(|text: &String| !text.is_empty());
    for (number, ((words, _), content)) in headings.iter().zip(contents).enumerate() {
        out.push_str(&format!("<section id=\"s{number}\">\n<h2>{}</h2>\n", escaped(words)));
        out.push_str(&format!("{content}</section>\n"));
    }
    out + "</main>\n</body>\n</html>\n"
}

impl Page {
    /// Group of the case, if it has a report.
    fn standing(&self) -> Option<SiteGroup> {
        match self.outcome {
            SiteOutcome::Report(_, standing) => Some(standing),
            SiteOutcome::Failed(_) | SiteOutcome::Unreached => None,
        }
    }
}

fn entry(page: &Page, order: SiteOrder) -> String {
    let SiteOutcome::Report(file, standing) = &page.outcome else { return String::new() };
    let class = match standing {
        SiteGroup::Class(HierarchyClass::IntegralAndMeasure) => "holds",
        SiteGroup::Class(HierarchyClass::Neither) => "fails",
        _ => "open",
    };
    let mut out = format!(
        "<article class=\"{class}\">\n<h3><a href=\"{}\">{}</a>",
        escaped(&address(file)),
        escaped(&page.title)
    );
    if !page.source.is_empty() {
        out.push_str(&format!(" <cite>{}</cite>", escaped(&page.source)));
    }
    out.push_str("</h3>\n");
    if !page.lead.is_empty() {
        out.push_str(&format!("<p class=\"remark\">{}</p>\n", escaped(&page.lead)));
    }
    let path = escaped(&page.path);
    let told = match order {
        SiteOrder::Hierarchy => path,
        SiteOrder::Folder => format!("{}; {path}", standing.words()),
    };
    out + &format!("<p class=\"remark\">{told}</p>\n</article>\n")
}

fn failed(pages: &[Page]) -> Vec<String> {
    let each = pages.iter().filter_map(|page| match &page.outcome {
        SiteOutcome::Failed(failures) => Some((page, failures)),
        SiteOutcome::Report(..) | SiteOutcome::Unreached => None,
    });
    each.map(|(page, failures)| {
        let texts: Vec<&str> = failures.iter().map(|one| one.rendered.as_str()).collect();
        format!(
            "<article class=\"fails\">\n<h3>{}</h3>\n<div class=\"scroll\"><pre>{}</pre></div>\n</article>\n",
            escaped(&page.path),
            escaped(&texts.join("\n\n"))
        )
    })
    .collect()
}

fn unreached(pages: &[Page]) -> Vec<String> {
    let each = pages.iter().filter(|page| matches!(page.outcome, SiteOutcome::Unreached));
    each.map(|page| format!("<p>{}</p>\n", escaped(&page.path))).collect()
}

/// Way back from a page to the index, as long as the page is deep in folders.
pub fn way_back(file: &str) -> String {
    "../".repeat(file.matches('/').count()) + SiteOrder::Hierarchy.file()
}

/// Name of a file in an address: what an address would read as something else is escaped.
fn address(file: &str) -> String {
    let mut out = String::new();
    for byte in file.bytes() {
        match byte.is_ascii_alphanumeric() || b"-_.~/".contains(&byte) {
            true => out.push(char::from(byte)),
            false => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(path: &str, outcome: SiteOutcome) -> Page {
        let [lead, source] = ["a <body>", "(1.1)"].map(str::to_string);
        Page { path: path.to_string(), title: format!("Case {path}"), lead, source, outcome }
    }

    #[test]
    fn every_case_is_in_both_indices() {
        let report =
            |file: &str, class| SiteOutcome::Report(file.to_string(), SiteGroup::Class(class));
        let failure = crate::diagnostic::of_file("c.toml", "bad <key>", "mend it", false);
        let pages = [
            page("a.toml", report("a.html", HierarchyClass::Neither)),
            page("b/50% & γ.toml", report("b/50% & γ.html", HierarchyClass::IntegralAndMeasure)),
            page("b/map.toml", SiteOutcome::Report("b/map.html".to_string(), SiteGroup::Claims)),
            page("c.toml", SiteOutcome::Failed(vec![failure])),
            page("d.toml", SiteOutcome::Unreached),
        ];
        for order in SiteOrder::ALL {
            let text = index("Cases", "liouville 1", &pages, order);
            for words in [
                "<a href=\"a.html\">Case a.toml</a>",
                "<a href=\"b/50%25%20%26%20%CE%B3.html\">Case b/50% &amp; γ.toml</a>",
                "bad &lt;key&gt;",
                "<p>d.toml</p>",
                "3 reports, liouville 1",
                "a &lt;body&gt;",
            ] {
                assert!(text.contains(words), "{order:?}: {words} in\n{text}");
            }
            assert_eq!(text.matches("<section").count(), text.matches("</section>").count());
            let anchors = text.matches("href=\"#s").count();
            assert_eq!(anchors, text.matches("<section id=\"s").count(), "{order:?}: anchors");
        }
        let text = index("Cases", "liouville 1", &pages, SiteOrder::Hierarchy);
        let place = |words: &str| text.find(&format!("<h2>{words}</h2>"));
        let places = ["integral and measure", "neither integral nor measure", "without a report"];
        let places = places.map(|words| place(words).expect("a heading"));
        assert!(places.is_sorted(), "{places:?}");
    }

    #[test]
    fn pages_lead_back() {
        assert_eq!(way_back("a.html"), "index.html");
        assert_eq!(way_back("a/b/c.html"), "../../index.html");
    }
}
