//! Pictures: sizes, panels, formats, tracks.

use std::fs;

use predicates::str::contains;

use crate::commands::{folder, liouville};

/// Draws a picture and returns its bytes.
fn drawn(folder_name: &str, file: &str, arguments: &[&str]) -> Vec<u8> {
    let path = folder(folder_name, &[]).join(file);
    let out = path.to_str().expect("UTF-8");
    liouville(&[arguments, &["--out", out]].concat()).assert().success();
    fs::read(path).expect("a picture")
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).expect("UTF-8")
}

const FEW: [&str; 4] = ["--orbits", "2", "--crossings", "3"];

#[test]
fn several_cases_are_one_picture_with_letters() {
    let cases = ["motion", "section", "figures/fig-3", "figures/fig-4", "figures/fig-5"];
    let arguments = [&cases[..], &FEW, &["--panels", "3x1"]].concat();
    let svg = text(drawn("panels", "three.svg", &arguments));
    assert!(svg.contains("width=\"180mm\""), "panels have a page's width");
    for words in ["(a)", "(b)", "(c)"] {
        assert!(svg.contains(&format!(">{words}</text>")), "{words} is in a corner");
    }
    assert!(svg.contains("Figure 4"), "the caption has the titles");
    let few = [&cases[..], &FEW, &["--panels", "2x1", "--out", "x.svg"]].concat();
    liouville(&few).assert().code(2).stderr(contains("--panels has room for 2 of 3 cases"));
    let data = [&cases[..], &FEW, &["--out", "x.csv"]].concat();
    liouville(&data).assert().code(2).stderr(contains("several cases are one picture"));
}

#[test]
fn sizes_are_in_millimetres_and_words_can_be_chosen() {
    let case = ["motion", "section", "figures/fig-8"];
    let svg = text(drawn("sizes", "one.svg", &[&case[..], &FEW, &["--width", "84"]].concat()));
    assert!(svg.contains("width=\"84mm\""), "as asked for");
    assert!(svg.contains("Figure 8") && svg.contains("=\u{a0}π, "), "title and caption");
    assert!(svg.contains(">sink</text>"), "the claimed sink is in the legend");
    let bare = ["--title", "", "--caption", "", "--no-marks"];
    let svg = text(drawn("sizes", "bare.svg", &[&case[..], &FEW, &bare].concat()));
    assert!(!svg.contains("=\u{a0}π, ") && !svg.contains(">sink</text>"), "left out");
    let png = drawn(
        "sizes",
        "two.png",
        &[&case[..], &FEW, &["--no-marks", "--width", "50.8", "--dpi", "300"]].concat(),
    );
    let width = png.get(16..20).expect("a header");
    assert_eq!(width, 600u32.to_be_bytes(), "two inches at 300 dots each");
    let old = [&case[..], &FEW, &["--width", "900", "--out", "x.png"]].concat();
    liouville(&old).assert().code(2).stderr(contains("millimetres from 30 to 600"));
}

#[test]
fn a_pdf_has_its_fonts_and_its_size() {
    let case = ["motion", "section", "figures/fig-3"];
    let pdf = drawn("fonts", "one.pdf", &[&case[..], &FEW, &["--width", "127"]].concat());
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-") && text.trim_end().ends_with("%%EOF"), "a whole file");
    assert!(text.contains("[0 0 360 "), "five inches are 360 points");
    assert!(text.contains("/FontFile2") && text.contains("DejaVuSansCondensed"), "embedded");
    assert!(!text.contains("/CreationDate"), "the same bytes on every day");
}

#[test]
fn attractor_and_repeller_are_told_apart() {
    let case = ["motion", "section", "figures/fig-8", "--start", "1.27,-0.04", "--both-ways"];
    let svg = text(drawn("both", "both.svg", &[&case[..], &["--crossings", "5"]].concat()));
    for words in ["forwards in time", "backwards in time"] {
        assert!(svg.contains(&format!(">{words}</text>")), "{words}");
    }
    let shaded = ["motion", "section", "figures/fig-8", "--crossings", "5", "--shade"];
    let svg = text(drawn("both", "shade.svg", &shaded));
    assert!(svg.contains("data:image/png;base64,") && svg.contains("crossings a cell"), "shaded");
}

#[test]
fn charts_show_exponents_and_the_case_itself() {
    let plane = ["--x", "a_g=5..25", "--y", "c3=0..1", "--size", "4x3", "--time", "20"];
    let chart = ["motion", "chart", "figures/fig-8", "--colour", "exponent"];
    let svg = text(drawn("exponents", "chart.svg", &[&chart[..], &plane].concat()));
    assert!(svg.contains(">largest exponent</text>"), "a colour bar");
    assert!(svg.contains(">the case itself</text>"), "a mark");
}

#[test]
fn tracks_are_the_path_of_the_contact_point() {
    let spin = ["motion", "orbit", "spin/rattleback-reversal", "--time", "2", "--every", "1/10"];
    let state = ["--state", "ω=[1/50,1/50,1] γ=[0,0,1]", "--track"];
    let csv = text(drawn("track", "track.csv", &[&spin[..], &state].concat()));
    let rows: Vec<&str> = csv.lines().collect();
    assert_eq!((rows[0], rows.len()), ("t,X,Y", 22), "0, 1/10, …, 2");
    assert!(rows[1] == "0.0,0.0,0.0" && rows[21].starts_with("2.0,"), "{csv}");
    drawn("track", "track.pdf", &[&spin[..], &state].concat());
    let pendulum = ["motion", "orbit", "figures/fig-13", "--track", "--out", "x.svg"];
    liouville(&pendulum).assert().code(2).stderr(contains("contact point on a plane"));
}

#[test]
fn a_section_can_be_drawn_on_the_sphere() {
    let case = ["motion", "section", "figures/fig-5"];
    let svg = text(drawn("sphere", "two.svg", &[&case[..], &FEW, &["--sphere"]].concat()));
    assert!(svg.contains("&gt;") && svg.contains("&lt;"), "the discs L > 0 and L < 0");
    assert!(!svg.contains("(c)"), "two discs");
    let shaded = [&case[..], &["--sphere", "--shade", "--out", "x.svg"]].concat();
    liouville(&shaded).assert().code(2).stderr(contains("cannot be used with"));
}
