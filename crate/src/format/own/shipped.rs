//! Layouts of other makers' encoders that come with the program.

use crate::format::said;

/// A layout that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shipped {
    /// Its name in links.
    pub name: &'static str,
    /// The layout.
    pub text: &'static str,
    /// Where it is described.
    pub source: &'static str,
}

/// All of them.
pub const SHIPPED: &[Shipped] = &[
    Shipped {
        name: "incoder-ssi1",
        text: "IncOder SSI1;line;valid:1,zero-default:1,angle:22",
        source: said("IncOder product guide, SSI1: 24 bits"),
    },
    Shipped {
        name: "incoder-ssi2",
        text: "IncOder SSI2;line;angle:22,even:1,error:1",
        source: said("IncOder product guide, SSI2: 24 bits, parity over the position"),
    },
    Shipped {
        name: "incoder-ssi4",
        text: "IncOder SSI4;line;valid:1,zero-default:1,angle:19,skip:11:name=time in 10 µs",
        source: said("IncOder product guide, SSI4: 32 bits with a time stamp"),
    },
    Shipped {
        name: "incoder-ssi6",
        text: "IncOder SSI6;line;crc:8:0x97:from=valid:to=angle,valid:1,zero-default:1,angle:22",
        source: said("IncOder product guide, SSI6: 32 bits, CRC in front"),
    },
    Shipped {
        name: "incoder-ssi9",
        text: "IncOder SSI9;line;valid:1,zero-default:1,angle:19,skip:11:name=time in µs",
        source: said("IncOder product guide, SSI9: SSI4 with a finer time stamp"),
    },
    Shipped {
        name: "rls-biss-26",
        text: "RLS BiSS 26 bit;biss;angle:26,error:1:low,warning:1:low,crc:6:0x03:xor=0x3f",
        source: said("Renishaw and RLS BiSS-C data sheets: 26-bit position"),
    },
    Shipped {
        name: "rls-biss-32",
        text: "RLS BiSS 32 bit;biss;angle:32,error:1:low,warning:1:low,crc:6:0x03:xor=0x3f",
        source: said("Renishaw BiSS-C data sheets: 32-bit position"),
    },
    Shipped {
        name: "rls-aksim2-biss-18",
        text: "RLS AksIM-2 BiSS 18 bit;biss;turns:16,angle:18,error:1:low,warning:1:low,crc:6:0x03:xor=0x3f",
        source: said("RLS AksIM-2 data sheet, BiSS-C, multi-turn"),
    },
    Shipped {
        name: "rls-orbis-serial",
        text: "RLS Orbis serial;poll:31;const:8:0x31,angle:14,error:1:low,warning:1:low",
        source: said("RLS Orbis data sheet, asynchronous serial, command 1; it has no checksum"),
    },
    Shipped {
        name: "rls-aksim2-serial-18",
        text: "RLS AksIM-2 serial 18 bit;poll:31;const:8:0x31,angle:18,zeros:4,error:1:low,warning:1:low",
        source: said("RLS AksIM-2 data sheet, asynchronous serial, command 1; it has no checksum"),
    },
    Shipped {
        name: "rls-serial-crc",
        text: "RLS word with CRC;stream;turns:16,angle:18,zeros:4,error:1:low,warning:1:low,crc:8:0x97:xor=0xff",
        source: said("RLS AksIM-2 data sheet, SPI: position, error, warning, inverted CRC-8"),
    },
];
