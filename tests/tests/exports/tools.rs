//! Compilers and programs.

use std::{
    fs,
    io::Write as _,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// A program that must be there.
pub(crate) fn tool(name: &str, why: &str) -> Command {
    let found = Command::new(name)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(
        found.is_ok_and(|status| status.success()),
        "{name} is missing: {why}"
    );
    Command::new(name)
}

pub(crate) fn c_compiler() -> Command {
    let name = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    let mut cc = tool(
        &name,
        "it compiles the exported C; install gcc and libc6-dev",
    );
    cc.args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]);
    cc
}

pub(crate) fn rustc() -> Command {
    let mut rustc = tool(
        "rustc",
        "it compiles the exported Rust; see https://rustup.rs",
    );
    rustc.args(["--edition", "2021", "-D", "warnings", "-D", "missing_docs"]);
    rustc
}

pub(crate) fn python() -> Command {
    let mut python = tool("python3", "it runs the exported Python; install python3");
    python.args(["-W", "error", "-B"]);
    python
}

/// A directory of this test's own.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("an old directory goes");
    }
    fs::create_dir_all(&folder).expect("a directory");
    folder
}

pub(crate) fn built(command: &mut Command) {
    let out = command.output().expect("a compiler that starts");
    let said = String::from_utf8_lossy(&out.stderr);
    assert!(out.status.success(), "{command:?}: {said}");
}

/// What a program writes when it reads `input`.
pub(crate) fn answers(command: &mut Command, input: &str) -> Vec<String> {
    let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = piped.spawn().expect("a program that starts");
    let mut stdin = child.stdin.take().expect("its input");
    let text = input.to_owned();
    let writer = std::thread::spawn(move || stdin.write_all(text.as_bytes()));
    let out = child.wait_with_output().expect("its output");
    assert!(out.status.success(), "{command:?}: {}", out.status);
    writer.join().expect("no panic").expect("all of it is read");
    let text = String::from_utf8(out.stdout).expect("text");
    text.lines().map(str::to_owned).collect()
}
