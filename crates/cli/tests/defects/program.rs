//! Messages of the program on files that it refuses.

use std::path::PathBuf;

use assert_cmd::Command;
use libtest_mimic::{Failed, Trial};

use crate::file::Complaint;

/// Tests that the complaint about a file shows the line concerned.
pub fn complaint(complaint: Complaint) -> Trial {
    Trial::test(complaint.shows.clone(), move || {
        let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("defects");
        std::fs::create_dir_all(&folder)?;
        let path = folder.join(format!("line-{}.toml", complaint.line));
        std::fs::write(&path, &complaint.case)?;
        let mut command = Command::cargo_bin("liouville")?;
        let output = command.arg("check").arg(&path).output()?;
        let told = String::from_utf8_lossy(&output.stdout).into_owned();
        if output.status.code() != Some(2) {
            let code = output.status.code();
            return Err(Failed::from(format!("the exit code is {code:?}: {told}")));
        }
        let place = format!("line-{}.toml:{}", complaint.line, complaint.line);
        match told.contains(&place) {
            true => Ok(()),
            false => Err(Failed::from(format!("`{place}` is not shown in\n{told}"))),
        }
    })
}
