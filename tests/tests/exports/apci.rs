//! The program that reads an APCI-1710, compiled and run against a board that is played.

use crate::tools::{answers, built, c_compiler, folder};
use encoderscope::calculator::Calculator;
use std::{fs, process::Command};

/// A board: it takes note of what is written, is busy for some polls, and holds three words.
const BOARD: &str = r#"
#include <stdint.h>
#include <stdio.h>

static uint32_t busy, left, polls, words[3] = { WORDS };

uint32_t port_in(uint32_t address)
{
    if (address == MODULE) {
        polls++;
        return 0x7eu | (left > 0 ? left--, 1u : 0u);
    }
    if (address >= MODULE + 4 && address <= MODULE + 12 && address % 4 == 0)
        return words[(address - MODULE) / 4 - 1];
    printf("read %x\n", (unsigned)address);
    return 0;
}

void port_out(uint32_t value, uint32_t address)
{
    printf("%x to +%u\n", (unsigned)value, (unsigned)(address - MODULE));
    if (address == MODULE + 8)
        left = busy;
}

extern void ssi_setup(void);
extern int ssi_read(uint32_t word[3]);

int main(void)
{
    uint32_t word[3] = { 0, 0, 0 };
    int got;
    ssi_setup();
    busy = 100;
    got = ssi_read(word);
    printf("%d %u %x %x %x\n", got, (unsigned)polls, (unsigned)word[0], (unsigned)word[1], (unsigned)word[2]);
    busy = 0xffffffffu;
    polls = 0;
    got = ssi_read(word);
    printf("%d %d\n", got, polls >= ENOUGH && polls < 4 * ENOUGH);
    return 0;
}
"#;

#[test]
fn the_program_for_the_board_reads_what_the_board_holds() {
    let folder = folder("apci-1710");
    let cases = [
        ("", 0u32, 132u32, 25u32, 1u32, 0x01ff_ffffu32, 6_864u32),
        (
            "module=3 base=0xD000 clock=1000 bits=32 gray=1-2-3",
            0xd0c0,
            17,
            32,
            7,
            u32::MAX,
            1_100,
        ),
        (
            "module=1 bits=13 gray=none clock=1 pci-clock=40",
            64,
            20_000,
            13,
            0,
            0x1fff,
            560_000,
        ),
    ];
    let calculator = Calculator::named("apci-1710").expect("a calculator");
    for (entered, module, frq, bits, control, mask, enough) in cases {
        let outcome = calculator.work(|name| {
            let mut pairs = entered
                .split_whitespace()
                .filter_map(|pair| pair.split_once('='));
            pairs
                .find(|(known, _)| *known == name)
                .map(|(_, value)| value)
        });
        let code = outcome.expect("an outcome").code.expect("a program");
        assert!(
            code.text
                .lines()
                .all(|line| line.len() <= 100 && !line.ends_with(' '))
        );
        fs::write(folder.join(code.file), &code.text).expect("room");
        built(
            c_compiler()
                .arg("-fsyntax-only")
                .arg(folder.join(code.file)),
        );
        let words = [0xffff_ffffu32, 0x014a_5223, 0x8000_0001];
        let board = BOARD
            .replace("MODULE", &format!("{module}u"))
            .replace("ENOUGH", &format!("{enough}u"))
            .replace("WORDS", &words.map(|word| format!("{word}u")).join(", "));
        fs::write(folder.join("board.c"), board).expect("room");
        let program = folder.join("run");
        built(
            c_compiler()
                .args([folder.join(code.file), folder.join("board.c")])
                .arg("-o")
                .arg(&program),
        );
        let [one, two, three] = words.map(|word| word & mask);
        assert_eq!(
            answers(&mut Command::new(&program), ""),
            [
                format!("{frq:x} to +0"),
                format!("{bits:x} to +4"),
                format!("{control:x} to +12"),
                "0 to +8".into(),
                format!("0 101 {one:x} {two:x} {three:x}"),
                "0 to +8".into(),
                // It gives up, but not before a reading is over.
                "-1 1".into(),
            ],
            "{entered}"
        );
    }
}
