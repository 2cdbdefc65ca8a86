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
    ($($number:literal $place:literal [$($format:ident),*]
        $says:literal => $right:literal, $because:literal;)*) => {
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
    1 "MPP and PT, BiSS-C data row" [BissC]
        "error b7, warning b6, status b5…b0" =>
        "error b13, warning b12, status b11…b6, CRC b5…b0",
        "their own status table and frame lengths (47 bits for 17M, 30 for 16) fit nothing else";
    2 "MPP and PT, BiSS-C data row" [BissC]
        "angle b(24+X)…b(9+X), turns b(8+X)…b8" =>
        "the turns have 16 bits, the angle X",
        "the column of widths";
    3 "MPP, SSI data row" [Ssi]
        "status b5…b0 is 1 bit" =>
        "six bits",
        "the indices, and PT";
    4 "MPP and PT, CRC-6 program" [BissC]
        "x6+x5+1 and x^x+x1+1" =>
        "x⁶+x+1",
        "the table begins 00 03 06";
    5 "MPP, T485 note 2" [T485]
        "CRC x+1" =>
        "x⁸+1, the exclusive or of all bytes",
        "the appendix, and captures of real encoders";
    6 "PT, RS485 example" [Rs485]
        "sends 0x32 and reads seven bytes" =>
        "0x64 gives seven bytes, 0x31 six",
        "the length of the replies";
    7 "PT, column of commands" [Rs485]
        "0x21, 0731, 0704" =>
        "0x31, 0x64, 0x74",
        "the letters beside them, and MPP";
    8 "MPP and PT, T485 note 1" [T485]
        "data is left-aligned" =>
        "right-aligned and little-endian",
        "of 17 bits the top seven of A2 are 0, as the same note says";
    9 "MPP and PT, T485 byte B5" [T485]
        "17" =>
        "the encoder identity, 0x17 for 23 bits or 0x11 for 17",
        "Tamagawa's own format; shown, never required";
    10 "MPP and PT, T485 byte E" [T485]
        "b7 battery disconnected, b6 battery low" =>
        "so for MPP and PT; Tamagawa's own encoders mean the opposite",
        "the parameter dialect chooses the names";
    11 "PT, RS485 commands" [Rs485]
        "no command s" =>
        "as in MPP",
        "the same family of encoders";
    12 "MPP and PT, BUS example 16M1-D" [Bus]
        "28 µs" =>
        "right for a turn counter of 8 bits only; XXM 32 µs up to 16 bits per turn, 36 µs above",
        "the formula beside it";
    13 "MPP and PT, rows of timing" [Ssi, BissC]
        "frequency t_CL 400 ns…14 µs" =>
        "this is the period; the row of frequencies counts, with t_M",
        "the unit, and the contradiction with the frequencies";
    14 "IP-75, 5.3.2" [Asi4]
        "0…16384" =>
        "0…16383",
        "14 bits";
    15 "IP-75, 5.4 note 2" [Ssi7]
        "each edge sends a bit" =>
        "each rising edge",
        "the guide of the IncOder family, and every SSI";
    16 "IP-75, 5.4" [Ssi7]
        "T_mu and T_mi" =>
        "one time, 20 ± 1 µs after the last falling edge",
        "both names stand for the same line of the drawing";
    17 "P+F, single-turn resolution" [SsiTree]
        "16 bits are 32 688 values" =>
        "65 536",
        "2¹⁶";
    18 "P+F, register FRQ" []
        "divider up to 13 070" =>
        "131 070",
        "twice the largest value of a register of 16 bits";
    19 "P+F, table 1" [SsiTree]
        "rows of 25 and of 26 columns" =>
        "the length of the word and the place of the parity are parameters",
        "table 4";
    20 "PT, CRC-8 table" [Rs485, Period]
        "236 entries, 0x11 at 0xDC" =>
        "256 entries; 0xB5…0xC8 are missing, and it is 0xF1",
        "computed from the polynomial";
    21 "PT, CRC-6 table" [BissC]
        "66 entries" =>
        "64",
        "computed from the polynomial";
    22 "MPP, CRC-6 program" [BissC]
        "a program for frames of any length" =>
        "not to be ported",
        "it does not compile for 33…38 bits and refuses good frames of 43, 49, 55 and 61";
    23 "MPP and PT, PERIOD" [Period]
        "wires A and B" =>
        "TX+ and TX−, pins 5 and 6",
        "the table of pins";
    24 "P+F, APCI-1710, cable of 200 m" [SsiTree]
        "2900 ns of delay allow 300 kHz" =>
        "about 220 kHz by the sum that follows it, 200 kHz by table 2, 172 kHz for a shift of 180°",
        "2900 + 0.5 · 3300 ≈ 4500 ns; the period of 300 kHz is 3333 ns";
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
