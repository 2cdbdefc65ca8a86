//! The sources that are exported, compiled and run against the decoder they were made from.
//!
//! Needs a C compiler, `rustc` and `python3`.
#![cfg(not(target_arch = "wasm32"))]
#![allow(missing_docs)]

mod apci;
mod cases;
mod tools;

use cases::{Case, PROFILES, cases, members};
use encoderscope::{
    bits::{Bits, Span},
    check::Algorithm,
    export::{Language, crc_source, source},
    layout::Role,
    record::hex,
};
use encoderscope_tests::{Noise, decoder};
use std::{fmt::Write as _, fs, process::Command};
use tools::{answers, built, c_compiler, folder, python, rustc};

#[test]
fn the_source_has_every_quantity_that_the_layouts_have() {
    for parameters in PROFILES {
        let decoder = decoder(parameters);
        let mut wanted: Vec<&str> = Vec::new();
        for (_, layout) in decoder.replies() {
            for field in layout.fields() {
                let named = field.row.bits.iter().filter_map(|bit| bit.role);
                let roles = [field.row.role].into_iter().chain(named);
                wanted.extend(roles.filter_map(Role::quantity));
            }
        }
        wanted.sort_unstable();
        wanted.dedup();
        let members = members(&decoder);
        let mut names: Vec<_> = members.iter().map(|(name, _)| name.as_str()).collect();
        names.sort_unstable();
        assert_eq!(names, wanted, "{parameters}");
        for language in Language::ALL {
            let text = source(&decoder, *language);
            let shown = parameters.split(' ').all(|parameter| {
                let all: Vec<&str> = text.split_whitespace().collect();
                let bare = |word: &&str| word.trim_matches('`').to_owned();
                all.iter().any(|word| bare(word) == parameter)
            });
            assert!(shown, "{parameters} is not named in {language:?}");
            let widest = text.lines().map(|line| line.chars().count()).max();
            assert!(widest <= Some(100), "{parameters} {language:?}: {widest:?}");
            assert!(!text.contains("\n\n\n\n") && text.ends_with('\n'));
            assert!(
                text.lines().all(|line| !line.ends_with(' ')),
                "{parameters}"
            );
        }
    }
}

#[test]
fn exported_c_reads_what_the_decoder_reads() {
    let folder = folder("exports-c");
    for (index, case) in cases().iter().enumerate() {
        let name = case.decoder.profile().format.name().replace('-', "_");
        fs::write(folder.join("decoder.c"), source(&case.decoder, Language::C)).expect("room");
        let mut show = String::new();
        for (member, optional) in &case.members {
            let guard = match optional {
                true => format!("if (f.has_{member}) "),
                false => String::new(),
            };
            let format = match member.as_str() {
                "angle" => format!("(unsigned long long)f.{member}"),
                _ => format!("(long long)f.{member}"),
            };
            let letter = if member == "angle" { "u" } else { "d" };
            writeln!(show, "{guard}printf(\" {member}=%ll{letter}\", {format});").expect("room");
        }
        match case.members.iter().find(|(member, _)| member == "angle") {
            Some((_, true)) => show.push_str("if (f.has_angle) "),
            Some((_, false)) => {}
            None => show.push_str("if (0) "),
        }
        match case.members.iter().any(|(member, _)| member == "angle") {
            true => writeln!(show, "printf(\" degrees=%.6f\", {name}_degrees(f.angle));"),
            false => writeln!(show, "printf(\"?\");"),
        }
        .expect("room");
        let main = format!(
            "#include <stdio.h>\n#include <string.h>\n#include \"decoder.c\"\n\
             int main(void) {{\n    char line[256];\n    \
             while (fgets(line, sizeof line, stdin)) {{\n        uint8_t bytes[64];\n        \
             size_t len = 0;\n        unsigned byte;\n        \
             while (sscanf(line + 2 * len, \"%2x\", &byte) == 1) bytes[len++] = (uint8_t)byte;\n        \
             struct {name}_frame f;\n        memset(&f, 0xa5, sizeof f);\n        \
             if ({}(bytes, len, &f) != 0) {{ puts(\"bad\"); continue; }}\n        \
             printf(\"ok\");\n{show}\n        puts(\"\");\n    }}\n    return 0;\n}}\n",
            case.function()
        );
        let program = folder.join(format!("run{index}"));
        fs::write(folder.join("main.c"), main).expect("room");
        built(
            c_compiler()
                .arg(folder.join("main.c"))
                .arg("-o")
                .arg(&program),
        );
        let input: String = case.frames.iter().map(|frame| hex(frame) + "\n").collect();
        case.compare(Language::C, &answers(&mut Command::new(program), &input));
    }
}

/// The frames of all cases, each behind the number of its case.
fn numbered(cases: &[Case]) -> String {
    let mut out = String::new();
    for (index, case) in cases.iter().enumerate() {
        for frame in &case.frames {
            writeln!(out, "{index} {}", hex(frame)).expect("room");
        }
    }
    out
}

fn compare_all(cases: &[Case], language: Language, lines: &[String]) {
    let mut rest = lines;
    for case in cases {
        let (own, others) = rest.split_at(case.frames.len().min(rest.len()));
        case.compare(language, own);
        rest = others;
    }
    assert!(rest.is_empty());
}

#[test]
fn exported_rust_reads_what_the_decoder_reads() {
    let folder = folder("exports-rust");
    let cases = cases();
    let mut library = String::from("//! Decoders.\n#![no_std]\n#![forbid(unsafe_code)]\n");
    let mut arms = String::new();
    for (index, case) in cases.iter().enumerate() {
        let text = source(&case.decoder, Language::Rust);
        fs::write(folder.join(format!("p{index}.rs")), text).expect("room");
        writeln!(library, "pub mod p{index};").expect("room");
        let mut show = String::new();
        for (member, optional) in &case.members {
            let line = match optional {
                true => format!(
                    "if let Some(v) = f.{member} {{ write!(out, \" {member}={{}}\", v as i128).unwrap(); }}"
                ),
                false => format!("write!(out, \" {member}={{}}\", f.{member} as i128).unwrap();"),
            };
            show.push_str(&line);
        }
        show.push_str(
            match case.members.iter().find(|(member, _)| member == "angle") {
                Some((_, true)) => {
                    "if let Some(v) = f.degrees() { write!(out, \" degrees={v:.6}\").unwrap(); }"
                }
                Some((_, false)) => "write!(out, \" degrees={:.6}\", f.degrees()).unwrap();",
                None => "",
            },
        );
        writeln!(
            arms,
            "\"{index}\" => match decoders::p{index}::{}(&bytes) {{ Ok(f) => {{ {show} }} \
             Err(why) => {{ assert!(!why.to_string().is_empty()); out = \"bad\".into(); }} }},",
            case.function()
        )
        .expect("room");
    }
    let main = format!(
        "//! Runs them.\nuse std::{{fmt::Write, io::BufRead}};\nfn main() {{\n\
         for line in std::io::stdin().lock().lines() {{\nlet line = line.unwrap();\n\
         let (index, hex) = line.split_once(' ').unwrap();\n\
         let bytes: Vec<u8> = (0..hex.len() / 2).map(|at| \
         u8::from_str_radix(&hex[at * 2..at * 2 + 2], 16).unwrap()).collect();\n\
         let mut out = String::from(\"ok\");\nmatch index {{\n{arms}_ => panic!()\n}}\n\
         println!(\"{{out}}\");\n}}\n}}\n"
    );
    fs::write(folder.join("lib.rs"), library).expect("room");
    fs::write(folder.join("main.rs"), main).expect("room");
    let own = |command: &mut Command, file: &str| {
        built(
            command
                .arg(folder.join(file))
                .arg("--out-dir")
                .arg(&folder)
                .arg("-L")
                .arg(&folder),
        );
    };
    own(
        rustc().args(["--crate-name", "decoders", "--crate-type", "rlib"]),
        "lib.rs",
    );
    own(
        rustc().args(["--crate-name", "run", "--extern", "decoders"]),
        "main.rs",
    );
    let lines = answers(&mut Command::new(folder.join("run")), &numbered(&cases));
    compare_all(&cases, Language::Rust, &lines);
}

#[test]
fn exported_python_reads_what_the_decoder_reads() {
    let folder = folder("exports-python");
    let cases = cases();
    let mut main = String::from("import importlib\nimport sys\n\nALL = [\n");
    for (index, case) in cases.iter().enumerate() {
        let text = source(&case.decoder, Language::Python);
        fs::write(folder.join(format!("p{index}.py")), text).expect("room");
        let names: Vec<_> = case.members.iter().map(|(name, _)| name.as_str()).collect();
        writeln!(main, "    (\"{}\", {names:?}),", case.function()).expect("room");
    }
    main.push_str(
        "]\nMODULES = [importlib.import_module(f\"p{i}\") for i in range(len(ALL))]\n\
         for line in sys.stdin:\n    index, _, text = line.rstrip(\"\\n\").partition(\" \")\n    \
         function, names = ALL[int(index)]\n    try:\n        \
         frame = getattr(MODULES[int(index)], function)(bytes.fromhex(text))\n    \
         except ValueError:\n        print(\"bad\")\n        continue\n    \
         out = \"ok\"\n    for name in names:\n        value = getattr(frame, name)\n        \
         if value is not None:\n            out += f\" {name}={int(value)}\"\n    \
         if getattr(frame, \"degrees\", None) is not None:\n        \
         out += f\" degrees={frame.degrees:.6f}\"\n    print(out)\n",
    );
    fs::write(folder.join("main.py"), main).expect("room");
    let lines = answers(python().arg(folder.join("main.py")), &numbered(&cases));
    compare_all(&cases, Language::Python, &lines);
}

/// Texts over which CRCs are computed.
fn texts() -> Vec<Vec<u8>> {
    let mut noise = Noise::new(5);
    let mut random = |len: u64| (0..len).map(|_| noise.draw() as u8).collect();
    let mut all: Vec<Vec<u8>> = (0..12).map(&mut random).collect();
    all.push(b"123456789".to_vec());
    all
}

#[test]
fn exported_crcs_are_those_of_the_table_in_all_languages() {
    let folder = folder("exports-crc");
    let mut expected = Vec::new();
    let (mut c, mut rust, mut python_text) = (String::new(), String::new(), String::new());
    let (mut c_main, mut rust_main, mut python_main) =
        (String::new(), String::new(), String::new());
    for (_, crc) in Algorithm::KNOWN {
        let text = crc_source(crc, Language::Python);
        let name = text.split(['(', ' ']).nth(1).expect("a name").to_owned();
        c.push_str(&crc_source(crc, Language::C));
        rust.push_str(&crc_source(crc, Language::Rust));
        python_text.push_str(&text);
        for text in texts() {
            let all = Span::new(0, text.len() * 8);
            expected.push(crc.compute(Bits::of_bytes(&text), all).to_string());
            let list: Vec<String> = text.iter().map(ToString::to_string).collect();
            let list = list.join(",");
            let len = text.len();
            writeln!(
                c_main,
                "{{ static const uint8_t b[] = {{{list}{}}}; \
                 printf(\"%u\\n\", (unsigned){name}(b, {len})); }}",
                if len == 0 { "0" } else { "" }
            )
            .expect("room");
            writeln!(rust_main, "println!(\"{{}}\", {name}(&[{list}]));").expect("room");
            writeln!(python_main, "print({name}(bytes([{list}])))").expect("room");
        }
    }
    fs::write(
        folder.join("crc.c"),
        format!(
            "#include <stddef.h>\n#include <stdint.h>\n#include <stdbool.h>\n#include <stdio.h>\n\
             {c}int main(void) {{\n{c_main}return 0;\n}}\n"
        ),
    )
    .expect("room");
    fs::write(
        folder.join("crc.rs"),
        format!("//! CRCs.\n{rust}fn main() {{\n{rust_main}}}\n"),
    )
    .expect("room");
    fs::write(folder.join("crc.py"), python_text + &python_main).expect("room");
    let program = folder.join("crc-c");
    built(
        c_compiler()
            .arg(folder.join("crc.c"))
            .arg("-o")
            .arg(&program),
    );
    assert_eq!(answers(&mut Command::new(program), ""), expected);
    let program = folder.join("crc-rust");
    built(rustc().arg(folder.join("crc.rs")).arg("-o").arg(&program));
    assert_eq!(answers(&mut Command::new(program), ""), expected);
    assert_eq!(answers(python().arg(folder.join("crc.py")), ""), expected);
}
