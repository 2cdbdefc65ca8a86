//! Where the manuals would lead a reader wrong, and the reading that was chosen.

use crate::format::Format;

/// One place of a manual.
#[derive(Clone, Copy, Debug)]
pub struct Erratum {
    /// Its number.
    pub number: u32,
    /// The manual, and the place in it.
    pub place: &'static str,
    /// The formats it concerns; none where it is about a product.
    pub formats: &'static [Format],
    /// What the manual says.
    pub says: &'static str,
    /// What is right.
    pub right: &'static str,
    /// Why.
    pub because: &'static str,
}

/// Writes the table once, as data and as its documentation.
macro_rules! errata {
    ($($number:literal msg($place:literal) [$($format:ident),*]
        msg($says:literal) => msg($right:literal), msg($because:literal);)*) => {
        /// All of them.
        ///
        /// | # | manual | it says | right | because |
        /// |---|---|---|---|---|
        $(#[doc = concat!("| ", $number, " | ", $place, " | ", $says, " | ", $right, " | ", $because, " |")])*
        pub static ERRATA: &[Erratum] = &[$(Erratum {
            number: $number,
            place: $place,
            formats: &[$(Format::$format),*],
            says: $says,
            right: $right,
            because: $because,
        }),*];
    };
}

errata! {
    1 msg("MPP and PT, BiSS-C data row") [BissC]
        msg("error b7, warning b6, status b5…b0") =>
        msg("error b13, warning b12, status b11…b6, CRC b5…b0"),
        msg("their own status table and frame lengths (47 bits for 17M, 30 for 16) fit nothing else");
    2 msg("MPP and PT, BiSS-C data row") [BissC]
        msg("turns b(24+X)…b(9+X), angle b(8+X)…b8") =>
        msg("the turns have 16 bits, the angle X"),
        msg("the column of widths");
    3 msg("MPP, SSI data row") [Ssi]
        msg("status b5…b0 is 1 bit") =>
        msg("six bits"),
        msg("the indices, and PT");
    4 msg("MPP and PT, CRC-6 program") [BissC]
        msg("x6+x5+1 and x^x+x1+1") =>
        msg("x⁶+x+1"),
        msg("the table begins 00 03 06");
    5 msg("MPP, T485 note 2") [T485]
        msg("CRC x+1") =>
        msg("x⁸+1, the exclusive or of all bytes"),
        msg("the appendix, and captures of real encoders");
    6 msg("PT, RS485 example") [Rs485]
        msg("sends 0x32 and reads seven bytes") =>
        msg("0x64 gives seven bytes, 0x31 six"),
        msg("the length of the replies");
    7 msg("PT, column of commands") [Rs485]
        msg("0x21, 0731, 0704") =>
        msg("0x31, 0x64, 0x74"),
        msg("the letters beside them, and MPP");
    8 msg("MPP and PT, T485 note 1") [T485]
        msg("data is left-aligned") =>
        msg("right-aligned and little-endian"),
        msg("of 17 bits the top seven of A2 are 0, as the same note says");
    9 msg("MPP and PT, T485 byte B5") [T485]
        msg("17") =>
        msg("the encoder identity, 0x17 for 23 bits or 0x11 for 17"),
        msg("Tamagawa's own format; shown, never required");
    10 msg("MPP and PT, T485 byte E") [T485]
        msg("b7 battery disconnected, b6 battery low") =>
        msg("so for MPP and PT; Tamagawa's own encoders mean the opposite"),
        msg("the parameter dialect chooses the names");
    11 msg("PT, RS485 commands") [Rs485]
        msg("no command s") =>
        msg("as in MPP"),
        msg("the same family of encoders");
    12 msg("MPP and PT, BUS example 16M1-D") [Bus]
        msg("28 µs") =>
        msg("right for a turn counter of 8 bits only; XXM 32 µs up to 16 bits per turn, 36 µs above"),
        msg("the formula beside it");
    13 msg("MPP and PT, rows of timing") [Ssi, BissC]
        msg("frequency t_CL 400 ns…14 µs") =>
        msg("this is the period; the row of frequencies counts, with t_M"),
        msg("the unit, and the contradiction with the frequencies");
    14 msg("IP-75, 5.3.2") [Asi4]
        msg("0…16384") =>
        msg("0…16383"),
        msg("14 bits");
    15 msg("IP-75, 5.4 note 2") [Ssi7]
        msg("each edge sends a bit") =>
        msg("each rising edge"),
        msg("the guide of the IncOder family, and every SSI");
    16 msg("IP-75, 5.4") [Ssi7]
        msg("T_mu and T_mi") =>
        msg("one time, 20 ± 1 µs after the last falling edge"),
        msg("both names stand for the same line of the drawing");
    17 msg("P+F, single-turn resolution") [SsiTree]
        msg("16 bits are 32 688 values") =>
        msg("65 536"),
        msg("2¹⁶");
    18 msg("P+F, register FRQ") []
        msg("divider up to 13 070") =>
        msg("131 070"),
        msg("twice the largest value of a register of 16 bits");
    19 msg("P+F, table 1") [SsiTree]
        msg("rows of 25 and of 26 columns") =>
        msg("the length of the word and the place of the parity are parameters"),
        msg("table 4");
    20 msg("PT, CRC-8 table") [Rs485, Period]
        msg("236 entries, 0x11 at 0xDC") =>
        msg("256 entries; 0xB5…0xC8 are missing, and it is 0xF1"),
        msg("computed from the polynomial");
    21 msg("PT, CRC-6 table") [BissC]
        msg("66 entries") =>
        msg("64"),
        msg("computed from the polynomial");
    22 msg("MPP, CRC-6 program") [BissC]
        msg("a program for frames of any length") =>
        msg("not to be ported"),
        msg("it does not compile for 33…38 bits and refuses good frames of 43, 49, 55 and 61");
    23 msg("MPP and PT, PERIOD") [Period]
        msg("wires A and B") =>
        msg("TX+ and TX−, pins 5 and 6"),
        msg("the table of pins");
    24 msg("P+F, APCI-1710, cable of 200 m") [SsiTree]
        msg("2900 ns of delay allow 300 kHz") =>
        msg("about 220 kHz by the sum that follows it, 200 kHz by table 2, 172 kHz for a shift of 180°"),
        msg("2900 + 0.5 · 3300 ≈ 4500 ns; the period of 300 kHz is 3333 ns");
}

impl Format {
    /// What the manuals say wrongly about this format.
    ///
    /// ```
    /// use encoderscope::format::Format;
    /// let numbers: Vec<u32> = Format::Asi4.errata().map(|erratum| erratum.number).collect();
    /// assert_eq!(numbers, [14]);
    /// ```
    pub fn errata(self) -> impl Iterator<Item = &'static Erratum> {
        let mine = move |erratum: &&Erratum| erratum.formats.contains(&self);
        ERRATA.iter().filter(mine)
    }
}
