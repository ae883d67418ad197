//! The first steps of a user: a case from nothing, the catalogue inside the program, what the
//! terminal shows, formats for other programs.

use std::fs;

use assert_cmd::Command;
use predicates::prelude::PredicateBooleanExt;
use predicates::str::{contains, starts_with};

use crate::commands::{GOOD, folder, liouville};

/// Makes the command in a folder without a checkout.
fn alone(name: &str, arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("liouville").expect("the binary is built");
    command.current_dir(folder(name, &[])).args(arguments);
    command
}

#[test]
fn the_catalogue_is_inside_the_program() {
    alone("alone-check", &["check", "-q", "suslov", "classical/planar"])
        .assert()
        .code(0)
        .stdout(contains("0 against expectation"));
    alone("alone-one", &["check", "plane/balanced-ball", "cases/suslov"])
        .assert()
        .code(0)
        .stdout(contains("cases/plane/balanced-ball.toml: ").and(contains("cases/suslov/")));
    alone("alone-eval", &["eval", "plane/balanced-ball.toml", "--digits", "20"]).assert().code(0);
    alone("alone-list", &["cases", "list", "KOWAL", "top"]).assert().code(2);
    alone("alone-found", &["cases", "list", "Kovalevskaya"])
        .assert()
        .code(0)
        .stdout(contains("classical/"));
    alone("alone-show", &["cases", "show", "plane/balanced-ball"])
        .assert()
        .code(0)
        .stdout(contains("system = \"rubber-plane\""));
    alone("alone-none", &["cases", "show", "plane/nothing"])
        .assert()
        .code(2)
        .stderr(contains("no case plane/nothing").and(contains("cases list")));
}

#[test]
fn a_case_is_copied_once() {
    let home = folder("copied", &[]);
    let copy = || {
        let mut command = Command::cargo_bin("liouville").expect("the binary is built");
        command.current_dir(&home).args(["cases", "copy", "suslov"]);
        command
    };
    copy().assert().code(0).stdout(contains("suslov"));
    let count = fs::read_dir(home.join("suslov")).expect("a folder").count();
    assert!(count > 3, "{count} cases");
    copy().assert().code(2).stderr(contains("exists already"));
}

#[test]
fn a_new_case_is_judged_and_never_overwritten() {
    let home = folder("new", &[]);
    let run = |arguments: &[&str], code: i32| {
        let mut command = Command::cargo_bin("liouville").expect("the binary is built");
        command.current_dir(&home).args(arguments).assert().code(code)
    };
    for kind in ["field", "hamiltonian", "lagrangian", "map", "rolling", "surface"] {
        let file = format!("{kind}.toml");
        run(&["new", kind, &file], 0).stdout(contains(format!("next: liouville check {file}")));
        run(&["check", &file], 0).stdout(contains("0 against expectation"));
        run(&["names", &file], 0).stdout(starts_with("state variables\n"));
    }
    run(&["new", "field", "field.toml"], 2).stderr(contains("exists already"));
}

#[test]
fn a_case_comes_from_standard_input() {
    liouville(&["check", "-"])
        .write_stdin(GOOD)
        .assert()
        .code(0)
        .stdout(starts_with("-\n  balanced ball"));
    liouville(&["check", "-"]).write_stdin("title = ").assert().code(2).stdout(contains("-:1"));
    liouville(&["eval", "-"]).write_stdin(GOOD).assert().code(0);
    liouville(&["check", "-"]).write_stdin([0xff, 0xfe]).assert().code(2).stdout(contains("UTF-8"));
}

#[test]
fn names_are_listed_with_their_meaning() {
    liouville(&["names", "plane/unbalanced-ball"])
        .assert()
        .code(0)
        .stdout(contains("state variables").and(contains("I + m r²E − m r⊗r")));
}

#[test]
fn words_of_reports_are_explained() {
    liouville(&["explain", "proved"]).assert().code(0).stdout(contains("- proved: the residual"));
    liouville(&["explain"]).assert().code(0).stdout(contains("Witness\n"));
    liouville(&["explain", "flibber"]).assert().code(2).stderr(contains("no glossary entry"));
}

#[test]
fn a_folder_has_a_line_for_each_case_and_details_of_what_is_unexpected() {
    let wrong = GOOD.replace("name = \"F2\"", "name = \"F2\"\nexpect = \"fails\"");
    let path = folder("lines", &[("good.toml", GOOD), ("wrong.toml", &wrong)]);
    let path = path.to_str().expect("UTF-8");
    liouville(&["check", path]).assert().code(1).stdout(
        contains("good.toml: 1 proved, 1 refuted\n").and(contains("✗ proved   expected: fails")),
    );
    liouville(&["check", path, "-q"])
        .assert()
        .code(1)
        .stdout(contains("good.toml").not().and(contains("✗ proved   expected: fails")));
    liouville(&["check", path, "-v"]).assert().code(1).stdout(contains("climb"));
}

#[test]
fn claims_are_chosen_by_name_or_source() {
    liouville(&["check", "plane/unbalanced-ball", "--claim", "(3.19)"])
        .assert()
        .code(0)
        .stdout(contains("(3.19)").and(contains("1 case, 1 claim: 1 proved")));
    liouville(&["check", "cases/plane", "--claim", "F2 with *"])
        .assert()
        .code(0)
        .stdout(contains("F2 with I").and(contains("F2 by the energy").not()));
    liouville(&["check", "cases/plane", "--claim", "flibber"])
        .assert()
        .code(2)
        .stderr(contains("no claim has a name or source like `flibber`"));
}

#[test]
fn settings_fix_parameters_of_all_cases() {
    liouville(&["check", "plane/balanced-ball", "--set", "m=2"]).assert().code(0);
    liouville(&["check", "plane/balanced-ball", "--set", "flibber=2"])
        .assert()
        .code(2)
        .stdout(contains("flibber"));
}

#[test]
fn a_witness_is_a_command_for_the_shell() {
    let text = "title = 'x'\nsystem = 'nonholonomic'\n[parameters]\nk = '1..2'\n[state]\nx = '-1..1'\n\
                \"x'\" = '-1..1'\n[lagrangian]\nkinetic = \"x'²/2\"\npotential = 'k*x²/2'\n\
                [[claim]]\nintegral = 'x'\nexpect = 'fails'\n";
    let home = folder("witness", &[("a case.toml", text)]);
    let mut check = Command::cargo_bin("liouville").expect("the binary is built");
    let output = check.current_dir(&home).args(["check", "a case.toml", "-v"]).output();
    let output = String::from_utf8(output.expect("it runs").stdout).expect("UTF-8");
    let line = output.lines().find(|line| line.trim().starts_with("liouville eval"));
    let line = line.expect("a witness").trim();
    let binary = Command::cargo_bin("liouville").expect("the binary is built");
    let binary = binary.get_program().to_str().expect("UTF-8").to_string();
    let command = line.replacen("liouville", &binary, 1);
    let mut shell = Command::new("sh");
    shell.current_dir(&home).args(["-c", &command]).assert().code(0).stdout(contains("x"));
}

#[test]
fn verdicts_come_as_csv_and_junit() {
    let wrong = GOOD.replace("name = \"F2\"", "name = \"F2\"\nexpect = \"fails\"");
    let files = [("good.toml", GOOD), ("wrong.toml", wrong.as_str()), ("bad.toml", "title = ")];
    let path = folder("formats", &files);
    let path = path.to_str().expect("UTF-8");
    let csv = liouville(&["check", path, "--format", "csv"]).assert().code(2);
    csv.stdout(
        starts_with(
            "path,title,claim,kind,source,expected,verdict,as_expected,method,reason,remark\n",
        )
        .and(contains("good.toml,balanced ball,F2,integral,,holds,proved,yes,"))
        .and(contains("wrong.toml,balanced ball,F2,integral,,fails,proved,no,"))
        .and(contains("bad.toml,,,,,,error,no,,")),
    );
    let csv =
        liouville(&["check", "sphere/body-of-revolution", "--format", "csv"]).assert().code(0);
    csv.stdout(contains("prime field,,\"it is not known that D_T"));
    let junit = liouville(&["check", path, "--format", "junit"]).assert().code(2);
    junit.stdout(
        contains("<testsuites tests=\"5\" failures=\"1\" errors=\"1\"")
            .and(contains("<failure type=\"proved\" message=\"proved, expected: fails\">"))
            .and(contains("wrong.toml:"))
            .and(contains("<error type=\"mistake\" message=")),
    );
    // A mistake is one test, with its line and its help.
    let two = GOOD.replace("[body]", "[bodie]").replace("title", "titel");
    let path = folder("mistakes", &[("two.toml", two.as_str())]);
    let junit =
        liouville(&["check", path.to_str().expect("UTF-8"), "--format", "junit"]).assert().code(2);
    let text = String::from_utf8(junit.get_output().stdout.clone()).expect("UTF-8");
    let (cases, errors) = (text.matches("<testcase").count(), text.matches("<error").count());
    assert!(cases > 1 && cases == errors, "{text}");
    assert!(text.contains(&format!("errors=\"{errors}\"")) && text.contains("help: "), "{text}");
}

#[test]
fn former_names_of_commands_work_and_are_not_shown() {
    let help = liouville(&["--help"]).assert().code(0);
    help.stdout(contains("motion").and(contains("\n  orbit").not()));
    for arguments in [["motion", "orbit"], ["measure", "stress"]] {
        liouville(&[arguments[0], arguments[1], "--help"])
            .assert()
            .code(0)
            .stdout(contains("Example"));
        liouville(&[arguments[1], "--help"]).assert().code(0);
    }
}
