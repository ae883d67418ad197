//! The papers' tables: formulas in cells, what is proved absent, and documents that compile.

use std::process::{Command, Stdio};

use predicates::str::contains;
use serde_json::Value;

use super::{folder, json, liouville};

/// Folders of the catalogue with the columns of a table.
fn folders(number: &str) -> &'static [&'static str] {
    match number {
        "1" => &["plane"],
        "2" => &["sphere", "flat-base"],
        "3" => &["surface"],
        _ => &["spin"],
    }
}

/// Output of `table NUMBER --format FORMAT`.
fn rendered(number: &str, format: &str) -> String {
    let arguments = [&["table", number, "--format", format], folders(number)].concat();
    let output = liouville(&arguments).output().expect("it runs");
    assert!(output.status.success(), "table {number} as {format}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// The list at a key of a JSON object.
fn list<'v>(value: &'v Value, key: &str) -> &'v [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn the_tables_come_out_of_the_catalogue() {
    for (number, columns) in [("1", 6), ("2", 8), ("4", 11)] {
        let table = json(&["table", number, "--json"], 0);
        assert_eq!(list(&table, "columns").len(), columns, "table {number}");
        for row in list(&table, "rows") {
            for cell in list(row, "cells") {
                assert_ne!(cell["status"], "contradicts", "{row}");
            }
        }
        assert!(table["caption"].is_string(), "table {number} has a caption");
    }
    // The text is made of the same table.
    let arguments = [&["table", "1"], folders("1")].concat();
    liouville(&arguments).assert().code(0).stdout(contains("proved"));
}

#[test]
fn cells_hold_the_formulas_of_the_papers() {
    // By column: a measure, an additional integral; empty where the paper has none.
    let expected = [
        (
            "1",
            &[
                ("(γ,J⁻¹*γ)^(1/2)", "(J*ω × γ)²"),
                ("", "(Ĩ*ω × γ, Ĩ*ω × γ) − 2*m*R*(γ,c)*(Ĩ*ω,ω)"),
                ("√|X_b + (α*β − 1)*det(B)|*|(r,γ)²*(Δ_b + β*r²) − det(B)|*(r,γ)^(-2)*f^(-1)", ""),
                (
                    "√|X_b + (α*β − 1)*det(B)|*|(r,γ)²*(Δ_b + β*r²) − det(B)|*(r,γ)^(-2)*f^(-1)",
                    "(Ĩ*ω,B⁻¹*ω)",
                ),
                ("√g1*g2", "√g1*ω3"),
                ("(μ + m*r²)*√(μ + m*(r,γ)²)", ""),
            ][..],
        ),
        (
            "2",
            &[
                ("δ^(1/(2*κ))", ""),
                ("1/√δ", "((J*ω,J*ω) + det(J)*(ω,J*ω)*(J⁻¹*γ,J⁻¹*γ))/δ"),
                ("det(𝒥)*(γ,𝒥⁻¹*γ)", ""),
                ("P_ell", ""),
                ("I1*I2 + m*(I1*r1² + I2*r2²)", "(Ĩ*ω,Ĩ*ω) − m*(r1² + r2²)*(Ĩ*ω,ω)"),
                ("√g1*g2*(1 − k*f1)*(1 − k*f2')*exp(−Q)", "λ*ω3"),
                ("g1^((1 + k*R)/2)*g2", "g1^((1 + k*R)/2)*ω3"),
                ("(I1 + m*(r1² + r2² + z²))*exp(−ε)", "(r1*ω1 + r2*ω2)*exp(−ε)"),
            ][..],
        ),
    ];
    for (number, columns) in expected {
        let table = json(&[&["table", number, "--json"], folders(number)].concat(), 0);
        for (row, of) in [("measure", 0), ("integral", 1)] {
            let found = list(&table, "rows").iter().find(|found| found["row"] == row);
            let cells = list(found.expect("the row"), "cells");
            for (index, formulas) in columns.iter().enumerate() {
                let formula = [formulas.0, formulas.1][of];
                let (cell, place) =
                    (&cells[index], format!("table {number}, {row}, {}", index + 1));
                assert_eq!(cell["exists"], !formula.is_empty(), "{place}");
                let claims = list(cell, "claims");
                assert!(claims.iter().all(|claim| claim["agrees"] == true), "{place}");
                let is_stated = claims
                    .iter()
                    .any(|own| own["verdict"] == "proved" && own["formula"] == formula);
                // A cell of absence names its theorem, or refutes that a density exists.
                let is_absent = claims
                    .iter()
                    .any(|own| own["theorem"].is_number() || own["verdict"] == "refuted");
                assert!(if formula.is_empty() { is_absent } else { is_stated }, "{place}: {cell}");
            }
        }
        for own in list(&table, "definitions") {
            assert_eq!(own["verdict"], "proved", "{own}");
        }
        assert!(list(&table, "definitions").len() >= 7, "letters are defined");
        assert!(list(&table, "theorems").len() >= 2, "what is absent is a theorem");
        assert!(list(&table, "notes").iter().any(|note| note.to_string().contains('¹')));
    }
}

#[test]
fn a_table_is_a_latex_document() {
    for number in ["1", "2", "3", "4"] {
        check_latex(number, &rendered(number, "latex"));
    }
    let text = rendered("1", "latex");
    for part in ["\\multicolumn{4}", "\\multicolumn{2}", "\\cellcolor", "\\boldsymbol{J}"] {
        assert!(text.contains(part), "table 1 has group heads, shades and formulas: {part}");
    }
}

/// Checks that a document is one for any LaTeX.
fn check_latex(number: &str, text: &str) {
    assert!(text.starts_with("\\documentclass"), "table {number}");
    assert!(text.ends_with("\\end{document}\n"), "table {number}");
    assert!(text.chars().all(|c| c <= 'ſ'), "table {number} has letters of any LaTeX");
    let mut depth = 0_i32;
    let mut before = ' ';
    for c in text.chars() {
        match (before, c) {
            ('\\', _) => {}
            (_, '{') => depth += 1,
            (_, '}') => depth -= 1,
            _ => {}
        }
        assert!(depth >= 0, "table {number}: a brace is closed that was not opened");
        before = if before == '\\' { ' ' } else { c };
    }
    assert_eq!(depth, 0, "table {number}: braces");
    compile(number, text);
}

/// Compiles a document where there is a pdfLaTeX; no line may stand out of its cell by more than
/// the width of a letter.
fn compile(number: &str, text: &str) {
    let path = folder(&format!("latex-{number}"), &[("table.tex", text)]);
    let run = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", "table.tex"])
        .current_dir(&path)
        .stdout(Stdio::null())
        .status();
    let Ok(status) = run else { return };
    let log = std::fs::read(path.join("table.log")).unwrap_or_default();
    let log = String::from_utf8_lossy(&log);
    let errors: Vec<&str> = log.lines().filter(|line| line.starts_with('!')).collect();
    assert!(status.success(), "table {number}: {errors:?}");
    for line in log.lines().filter_map(|line| line.strip_prefix("Overfull \\hbox (")) {
        let excess: f64 = line.split("pt").next().and_then(|n| n.parse().ok()).expect("a width");
        assert!(excess < 10.0, "table {number}: a line is {excess} pt too long");
    }
    assert!(!log.contains("Overfull \\vbox"), "table {number} fits on its page");
}

#[test]
fn a_table_is_a_page_with_formulas_and_group_heads() {
    let text = rendered("2", "html");
    for part in ["<math>", "colspan=\"5\"", "class=\"exists\"", "<caption>Table 2.", "(a) "] {
        assert!(text.contains(part), "{part}");
    }
    let text = rendered("1", "markdown");
    for part in ["**Table 1.", "| **additional integral** |", "](<cases/plane/", "(a) "] {
        assert!(text.contains(part), "{part}");
    }
}

/// Claims of each kind of row: a wide formula, particulars, a wrong expectation and an open claim.
const OWN: &str = "title = \"50% of A_1 & B\"\nsource = \"Author, J. #3\"\n[parameters]\nk = \"0.5..2\"\n\
    [state]\nx = \"-2..2\"\nv = \"-2..2\"\n[field]\n\"x'\" = \"v\"\n\"v'\" = \"-k*x\"\n\
    [[claim]]\nname = \"energy_1\"\nintegral = \"v² + k*x²\"\n\
    [[claim]]\nintegral = \"√(v² + k*x² + v²*(v² + k*x²) + k*x²*(v² + k*x²) + v^4 + 2*k*x²*v² + k^2*x^4)\"\n\
    [[claim]]\nname = \"wrong\"\nintegral = \"v² − k*x²\"\nsource = \"(2) [p. 3]\"\n\
    [[claim]]\nname = \"rest\"\nfixed-point = {}\nspectrum = [\"± √k*i\"]\n\
    [[claim]]\nname = \"time\"\nreversor = { v = \"−v\" }\n";

#[test]
fn verdicts_are_tables_for_papers() {
    let path = folder("verdicts", &[("a.toml", OWN), ("b.toml", "title = 1\n")]);
    let path = path.to_str().expect("a path");
    let set = |format: &str| {
        let output = liouville(&["check", path, "--format", format]).output().expect("it runs");
        assert_eq!(output.status.code(), Some(2), "one file is wrong");
        String::from_utf8(output.stdout).expect("UTF-8")
    };
    let text = set("latex");
    check_latex("of verdicts", &text);
    for part in [
        "\\begin{longtable}",
        "50\\% of A\\_1 \\& B",
        "(Author, J. \\#3)",
        "\\textbf{refuted} (not expected)",
        "[(2) [p. 3]]",
        "x = v = 0 , \\, \\lambda = ",
        "v \\mapsto - v",
        "not judged: ",
        "\n[1] $",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let text = set("markdown");
    for part in [
        "| claim | kind | statement | verdict | evidence |",
        "energy\\_1 | integral | $",
        "**refuted**",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let text = set("html");
    for part in ["<table>", "50% of A_1 &amp; B", "<math>", "class=\"unexpected\"", "residual "] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    liouville(&["check", "plane/disk", "--settings", "a.csv", "--format", "latex"])
        .assert()
        .code(2)
        .stderr(contains("latex"));
}
