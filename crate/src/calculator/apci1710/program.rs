//! The program that reads the encoders of a module, in C.

use crate::{
    apci1710::{Channel, Register, divider},
    bits,
    calculator::{Code, quantity::rounded},
    language::msg,
};
use alloc::{format, string::String};

/// What is filled in.
pub(super) struct Program {
    /// FRQ.
    pub(super) frq: u16,
    /// The clock that results, in hertz.
    pub(super) real: f64,
    /// The PCI clock, in hertz.
    pub(super) pci: f64,
    /// Bits of the word.
    pub(super) bits: u32,
    /// CONTROL.
    pub(super) control: u32,
    /// The module.
    pub(super) module: u32,
    /// The address of the board; 0 where it is not known.
    pub(super) base: u64,
    /// PCI clocks that a reading takes; a read of the bus takes more than one.
    pub(super) polls: f64,
}

impl Program {
    pub(super) fn code(&self) -> Code {
        Code {
            title: msg("Reading the module in C"),
            file: "apci1710.c",
            text: self.text(),
        }
    }

    fn text(&self) -> String {
        let Self { bits, control, .. } = self;
        let clock = plain(self.real / 1e3);
        let board = match self.base {
            0 => "; set the address of the board here",
            _ => "",
        };
        let defines: String = Register::ALL
            .into_iter()
            .filter(|register| !matches!(register, Register::Output | Register::Identity))
            .map(|register| {
                format!(
                    "#define {:<11} (BOARD + 0x{:02X}u) /* {} */\n",
                    name(register),
                    register.place(self.module),
                    register.access().name()
                )
            })
            .collect();
        let reads: String = Channel::ALL
            .iter()
            .map(|channel| {
                format!(
                    "    word[{}] = port_in({}) & 0x{:08X}u;\n",
                    channel.number() - 1,
                    name(Register::Shift(*channel)),
                    bits::mask(*bits as usize)
                )
            })
            .collect();
        let polls = (self.polls * 2.0).min(f64::from(u32::MAX)) as u32;
        format!(
            "/* APCI-1710, SSI module {module}: words of {bits} bits at {clock} kHz. */\n\
             #include <stdint.h>\n\
             \n\
             /* Access to the ports, which the system gives: on Linux inl() and outl() of <sys/io.h>. */\n\
             extern uint32_t port_in(uint32_t address);\n\
             extern void port_out(uint32_t value, uint32_t address);\n\
             \n\
             #define BOARD       0x{base:04X}u /* its own address{board} */\n\
             {defines}\
             \n\
             /* Once, before the first reading. */\n\
             void ssi_setup(void)\n\
             {{\n\
             \x20   port_out({frq}u, FRQ); /* {pci} MHz / {divider} */\n\
             \x20   port_out({bits}u, COUNTS); /* {clocks} clocks */\n\
             \x20   port_out(0x{control:X}u, CONTROL); /* Gray to binary, a bit an encoder */\n\
             }}\n\
             \n\
             /* Reads the words of the three encoders: 0 when they are there, -1 when they do not come. */\n\
             int ssi_read(uint32_t word[3])\n\
             {{\n\
             \x20   uint32_t polls = {polls}u; /* longer than a reading */\n\
             \n\
             \x20   port_out(0u, START);\n\
             \x20   while (port_in(STATUS) & 1u) {{\n\
             \x20       if (polls-- == 0u)\n\
             \x20           return -1;\n\
             \x20   }}\n\
             {reads}\
             \x20   return 0;\n\
             }}\n",
            module = self.module,
            base = self.base,
            frq = self.frq,
            pci = plain(self.pci / 1e6),
            divider = divider(self.frq),
            clocks = bits + 1,
        )
    }
}

/// A number for a comment, without spaces between its digits.
fn plain(number: f64) -> String {
    let digits = rounded(number, 6);
    digits
        .chars()
        .filter(|letter| *letter != '\u{202f}')
        .collect()
}

/// The name of a register in C.
fn name(register: Register) -> String {
    register.title().replace(' ', "_")
}
