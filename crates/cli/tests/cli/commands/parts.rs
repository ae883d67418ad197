//! Jobs in parts: the merged file has the bytes of the one that a single run writes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command as Process;

use liouville::part::Part;
use liouville_cli::jobs::{AnyJob, Given};
use liouville_cli::parts::{Form, PartFile, Set};
use predicates::prelude::PredicateBooleanExt;
use predicates::str::contains;

use crate::commands::{folder, liouville};

const FLOW: &str = r#"
title = "a flow that ends for some"
[parameters]
a = "1..2"
b = 1
[state]
x = "-2..2"
y = "-2..2"
z = "20..24"
[field]
"x'" = "10*(y − x)"
"y'" = "28*a*x − y − x*z"
"z'" = "x*y − 8/3*z + b*z²*(a − 1)"
[[claim]]
name = "F"
integral = "x² + y²"
expect = "fails"
[[claim]]
name = "divergence"
divergence = "0"
expect = "fails"
"#;

/// Jobs with the ending of their data, and the largest number of parts to try.
const JOBS: [(&str, &str, u64); 8] = [
    ("motion chart flow.toml --x a=1..3/2 --y b=0..1 --size 5x3 --time 4", "csv", 17),
    (
        "motion exponents figures/fig-3 --start 1,0.2 --start 1,0.3 --start 1,1.5 --start 2,0.3 --time 20",
        "json",
        6,
    ),
    ("motion exponents flow.toml --starts starts.csv --time 2 --spectrum --set a=1", "json", 5),
    ("motion section flow.toml --section z=25 --orbits 5 --crossings 6 --set a=1", "csv", 7),
    ("motion section figures/fig-3 --orbits 5 --crossings 4 --both-ways --classes=5", "json", 6),
    ("sweep flow.toml --states 70000", "json", 5),
    ("check flow.toml --settings bodies.csv --states 64", "csv", 8),
    ("report flow.toml --settings bodies.csv --set b=0", "jsonl", 3),
];

/// Folder with the case and starts.
fn home(name: &str) -> PathBuf {
    let starts = "z,x,y\n20,1,2\n21,1,1\n22,-1,2\n";
    let bodies = "a\n1\n3/2\n\n2\n5/4\n7\n1/3\n";
    folder(name, &[("flow.toml", FLOW), ("starts.csv", starts), ("bodies.csv", bodies)])
}

fn words(arguments: &str) -> Vec<String> {
    arguments.split(' ').map(str::to_string).collect()
}

fn text(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

/// Runs the program in a folder; returns what it prints.
fn run(home: &Path, arguments: &[&str]) -> String {
    let done = liouville(arguments).current_dir(home).assert().success();
    String::from_utf8(done.get_output().stdout.clone()).expect("UTF-8")
}

/// Reads a job as another machine would, with the case alone.
fn job(arguments: &[String], home: &Path, out: Option<&Path>) -> AnyJob {
    let (name, text) = match arguments.iter().any(|word| word == "flow.toml") {
        true => ("flow.toml", FLOW.to_string()),
        false => ("figures/fig-3", run(home, &["cases", "show", "figures/fig-3"])),
    };
    let sets = arguments.windows(2).filter(|two| two[0] == "--set").map(|two| two[1].clone());
    let settings: Vec<String> = sets.collect();
    let given = Given { name, text: &text, settings: &settings, table: None };
    AnyJob::read(arguments, given, out).expect("a job")
}

#[test]
fn any_number_of_parts_in_any_order_gives_the_bytes_of_one_run() {
    for (number, (arguments, ending, most)) in JOBS.iter().enumerate() {
        let home = home(&format!("parts-{number}"));
        let whole = home.join(format!("whole.{ending}"));
        let printed = run(
            &home,
            &[&arguments.split(' ').collect::<Vec<_>>()[..], &["--out", text(&whole)]].concat(),
        );
        let whole = fs::read(whole).expect("data");
        assert!(whole.len() > 100, "{arguments} has data");
        let arguments: Vec<String> = words(arguments)
            .into_iter()
            .map(|word| match word.ends_with("s.csv") {
                true => text(&home.join(word)).to_string(),
                false => word,
            })
            .collect();
        let own = job(&arguments, &home, None);
        for count in [1, 3, *most] {
            let mut files: Vec<PartFile> = Part::all(count)
                .map(|part| {
                    own.file(part, 1 + (part.index() as usize + number) % 2).expect("a part")
                })
                .collect();
            // a different order for each number of parts
            files.rotate_left((count as usize * 5 + number) % count as usize);
            files.reverse();
            let set = Set::new(&files, "parts").expect("it is complete");
            let out = home.join(format!("merged.{ending}"));
            let merged =
                AnyJob::of(&set.header, Some(&out)).expect("a job").report(&set).expect("a report");
            assert!(fs::read(&out).expect("data") == whole, "{arguments:?} in {count} parts");
            let shown = printed.replace(&format!("whole.{ending}"), &format!("merged.{ending}"));
            assert_eq!(merged.text, shown, "{arguments:?} in {count} parts");
        }
    }
}

#[test]
fn parts_are_merged_to_the_picture_of_one_run() {
    let home = home("parts-picture");
    let plane =
        "motion chart flow.toml --x a=1..3/2 --y b=0..1 --size 5x3 --time 4 --colour exponent";
    let plane: Vec<&str> = plane.split(' ').collect();
    for ending in ["png", "pdf", "svg", "csv", "json"] {
        run(&home, &[&plane[..], &["--out", &format!("whole.{ending}")]].concat());
    }
    for (part, threads) in [("2/3", "1"), ("3/3", "2"), ("1/3", "2")] {
        let more = ["--part", part, "--out", "parts/", "--threads", threads];
        let told = run(&home, &[&plane[..], &more].concat());
        assert!(told.ends_with(": 5 of 15 units\n"), "{told}");
        let again = run(&home, &[&plane[..], &more].concat());
        assert!(again.ends_with(": there\n"), "{again}");
        let forced = run(&home, &[&plane[..], &more, &["--force"]].concat());
        assert_eq!(told, forced);
    }
    // the case and the starts are not needed any more
    fs::remove_file(home.join("flow.toml")).expect("a file");
    for ending in ["png", "pdf", "svg", "csv", "json"] {
        run(&home, &["merge", "parts", "--out", &format!("merged.{ending}")]);
        let [one, other] = ["whole", "merged"]
            .map(|name| fs::read(home.join(format!("{name}.{ending}"))).expect("a file"));
        assert!(one == other, "{ending}");
    }
    run(&home, &["merge", "parts", "--out", "other.svg", "--", "--colour", "class", "--dark"]);
    let [one, other] =
        ["whole", "other"].map(|name| fs::read(home.join(format!("{name}.svg"))).expect("a file"));
    assert!(one != other, "another colour of the same numbers");
    liouville(&["merge", "parts", "--", "--time", "5"])
        .current_dir(&home)
        .assert()
        .code(2)
        .stderr(contains("the report has no option --time"));
}

#[test]
fn missing_doubled_foreign_and_damaged_parts_are_named() {
    let home = home("parts-wrong");
    let part = |seed: &str, part: &str| {
        let told = run(
            &home,
            &[
                "sweep",
                "flow.toml",
                "--states",
                "1000",
                "--seed",
                seed,
                "--part",
                part,
                "--out",
                "parts",
            ],
        );
        home.join("parts").join(told.split(':').next().expect("a name"))
    };
    let fails = |message: &str| {
        let done = liouville(&["merge", "parts", "--out", "all.json"]).current_dir(&home).assert();
        done.code(2).stderr(contains(message.to_string()).and(contains("help: ")));
        assert!(!home.join("all.json").exists(), "nothing is written");
    };
    fs::create_dir_all(home.join("parts")).expect("a folder");
    fails("parts has no parts");
    let first = part("1", "1/5");
    part("1", "4/5");
    fails("3 of 5 parts are missing: 2-3, 5");
    fails("liouville sweep flow.toml --states 1000 --seed 1 --part 2/5 --out parts");
    fs::rename(home.join("flow.toml"), home.join("flow.away")).expect("a file");
    fails("flow.toml is not here: run the command where the first parts were computed");
    fs::rename(home.join("flow.away"), home.join("flow.toml")).expect("a file");
    for index in ["2/5", "3/5", "5/5"] {
        part("1", index);
    }
    fs::write(home.join("parts/notes.json"), "{}").expect("a file that is no part");
    fs::write(home.join("parts/.sweep.tmp"), "half of a part")
        .expect("what a killed worker leaves");
    let copy = home.join("parts/copy.json");
    fs::copy(&first, &copy).expect("a copy");
    fails("part 1 is there twice");
    fs::remove_file(copy).expect("a file");
    let foreign = part("2", "1/5");
    fails("the parts are not of one job");
    fs::remove_file(foreign).expect("a file");
    let coarser = part("1", "1/4");
    fails("the parts are not of one job");
    fs::remove_file(coarser).expect("a file");
    let whole = fs::read_to_string(&first).expect("a part");
    fs::write(&first, &whole[..whole.len() / 2]).expect("half of it");
    fails("is damaged");
    let told = part("1", "1/5");
    assert_eq!(
        fs::read_to_string(told).expect("a part"),
        whole,
        "what is damaged is computed again"
    );
    run(&home, &["merge", "parts", "--out", "all.json"]);
    let all = fs::read_to_string(home.join("all.json")).expect("data");
    run(&home, &["sweep", "flow.toml", "--states", "1000", "--out", "whole.json"]);
    assert_eq!(all, fs::read_to_string(home.join("whole.json")).expect("data"));
}

#[test]
fn other_files_under_the_name_of_a_part_do_not_count_as_it() {
    let home = home("parts-names");
    let chart = "motion chart flow.toml --x a=1..3/2 --y b=0..1 --size 3x2 --time 1 --out parts";
    let words: Vec<&str> = chart.split(' ').collect();
    let part = |more: &[&str]| {
        let done = liouville(&[&words[..], more].concat()).current_dir(&home).assert().success();
        let output = done.get_output().clone();
        let [told, warned] =
            [output.stdout, output.stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
        let name = told.split(':').next().expect("a name");
        (home.join("parts").join(name), told, warned)
    };
    let (own, ..) = part(&["--part", "1/2"]);
    let (second, ..) = part(&["--part", "2/2"]);
    let (foreign, ..) = part(&["--part", "1/2", "--seed", "2"]);
    let whole = fs::read(&own).expect("a part");
    let titles = String::from_utf8_lossy(&whole).replace("\ni,j,x,y,", "\ni,j,y,x,").into_bytes();
    assert!(titles != whole, "other titles");
    let others = [
        (fs::read(&second).expect("a part"), "it is of another job, or another part"),
        (fs::read(&foreign).expect("a part"), "it is of another job, or another part"),
        (titles, "its contents do not fit its digest"),
        (whole[..whole.len() / 2].to_vec(), "it is cut off"),
        (vec![0xff, 0xfe], "it is not a text file"),
    ];
    fs::remove_file(foreign).expect("a file");
    for (bytes, reason) in others {
        fs::write(&own, bytes).expect("a file");
        let (_, told, warned) = part(&["--part", "1/2"]);
        assert!(told.ends_with(": 3 of 6 units\n"), "{told}");
        assert!(warned.contains(&format!("is computed again: {reason}")), "{warned}");
        assert!(fs::read(&own).expect("a part") == whole, "{reason}");
    }
    let (_, told, warned) = part(&["--part", "1/2"]);
    assert!(told.ends_with(": there\n") && warned.is_empty(), "{told}{warned}");
    run(&home, &["merge", "parts", "--out", "all.csv"]);
    fs::remove_file(&own).expect("a file");
    fs::create_dir(&own).expect("a folder of that name");
    let arguments = [&words[..], &["--part", "1/2"]].concat();
    let done = liouville(&arguments).current_dir(&home).assert().code(2);
    done.stderr(contains("cannot read").and(contains("help: remove it")));
}

#[test]
fn parts_have_the_titles_of_their_job() {
    let home = home("parts-titles");
    let arguments = words("motion chart flow.toml --x a=1..2 --y b=0..1 --size 1x2 --time 1");
    let own = job(&arguments, &home, None);
    let identity = own.identity().expect("a job");
    let file = |number: u64, titles: &str| {
        let part = Part::new(number, 2).expect("a part");
        let form = Form::Csv(titles.to_string());
        PartFile::new(&identity, part, &form, &["1,2".to_string()]).expect("a file")
    };
    let told = Set::new(&[file(1, "a,b"), file(2, "b,a")], "parts").expect_err("other titles");
    assert!(told.contains("has other columns than"), "{told}");
    let set = Set::new(&[file(1, "a,b"), file(2, "a,b")], "parts").expect("one table");
    let told = own.report(&set).err().expect("titles of another job");
    assert!(told.contains("the parts have other columns than the job"), "{told}");
}

#[test]
fn merge_takes_options_of_the_report_of_its_job() {
    let home = home("parts-styles");
    run(&home, &["sweep", "flow.toml", "--states", "100", "--part", "1/1", "--out", "states"]);
    let bodies = "check flow.toml --settings bodies.csv --states 64 --json --part 1/1 --out bodies";
    run(&home, &bodies.split(' ').collect::<Vec<_>>());
    let fails = |arguments: &str, message: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let done = liouville(&arguments).current_dir(&home).assert().code(2);
        done.stderr(contains(message.to_string()).and(contains("help: ")));
    };
    fails("merge states -- extra.toml", "the report has no option extra.toml");
    fails("merge states -- --json extra.toml", "the report has no option extra.toml");
    fails("merge states -- --dark", "the report has no option --dark");
    fails("merge bodies -- --colour class", "the report has no option --colour");
    fails("merge bodies -- --format", "--format has no value");
    // the parts were computed with --json
    let mut merged = liouville(&["merge", "bodies", "--", "--format", "csv"]);
    let merged = merged.current_dir(&home).assert().success().get_output().stdout.clone();
    assert!(merged.starts_with(b"row,line,a,proved,"), "{}", String::from_utf8_lossy(&merged));
}

#[test]
fn a_job_that_is_stopped_says_how_to_keep_what_is_reached() {
    let home = home("parts-within");
    let stopped = |arguments: &str, help: &'static str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        liouville(&arguments).current_dir(&home).assert().code(3).stderr(contains(help));
    };
    let sweep = "sweep flow.toml --states 1e15 --within 0.3";
    stopped(sweep, "in parts, which are kept: --part 1/100 --out parts/");
    stopped(&format!("{sweep} --part 1/2 --out parts"), "compute more parts than 2");
}

#[test]
fn options_of_parts_belong_together() {
    let home = home("parts-options");
    let fails = |arguments: &str, message: &'static str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        liouville(&arguments).current_dir(&home).assert().code(2).stderr(contains(message));
    };
    let chart = "motion chart flow.toml --x a=1..2 --y b=0..1";
    fails(&format!("{chart} --part 1/4"), "--out <FILE>");
    fails(&format!("{chart} --part 5/4 --out parts"), "write I/N, such as 3/40");
    fails(&format!("{chart} --force"), "--part <I/N>");
    fails(
        "motion section flow.toml flow.toml --section z=25 --part 1/2 --out parts",
        "--part is for one case",
    );
    fails(&format!("{chart} --part 1/4 --out flow.toml"), "give --out a folder of your own");
    fails("sweep flow.toml --states 0", "write a whole number from 1 to");
    fails("sweep flow.toml --claim nothing", "no claim has a name or source like `nothing`");
}

#[test]
fn the_state_of_the_largest_residual_is_a_command_for_the_shell() {
    let home = home("parts-state");
    let arguments = ["sweep", "plane/balanced-ball", "--claim", "F2 with I", "--states", "1000"];
    let printed = run(&home, &arguments);
    let line = printed.lines().find(|line| line.trim().starts_with("liouville eval"));
    let line = line.expect("a command").trim();
    let command = line.replacen("liouville", env!("CARGO_BIN_EXE_liouville"), 1);
    let done = Process::new("sh").args(["-c", &command]).current_dir(&home).output();
    let done = done.expect("it runs");
    assert!(done.status.success(), "{command}: {}", String::from_utf8_lossy(&done.stderr));
}
