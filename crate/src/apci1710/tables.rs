//! The registers as tables, the highest bit first.

use crate::layout::{Active, layout};

layout! {
    /// Divides the PCI clock down to the clock of the encoders, which must not exceed 1 MHz.
    pub static FRQ(p) {
        /// The clock is the PCI clock divided by twice this number; 0 divides by 2 as 1 does.
        divider: Count[16];
    }
}

layout! {
    /// Busy, and the levels of the data lines and of the inputs.
    pub static STATUS(p) {
        /// Bits that table 5 does not name.
        unused: Framing[25];
        /// D6, the input on Gx: 0 is high, 1 is low.
        input_3: Status[1];
        /// D5, the input on Fx: 0 is high, 1 is low.
        input_2: Status[1];
        /// D4, the input on Ex: 0 is high, 1 is low.
        input_1: Status[1];
        /// D3, the data line of the third encoder, on Dx: 1 is high.
        data_3: Status[1];
        /// D2, the data line of the second encoder, on Cx: 1 is high.
        data_2: Status[1];
        /// D1, the data line of the first encoder, on Bx: 1 is high.
        data_1: Status[1];
        /// D0: 0 when the words are in SHIFT, 1 as long as they are clocked out.
        busy: Valid[1], active = Active::Low;
    }
}

layout! {
    /// How many bits the words have.
    pub static COUNTS(p) {
        /// Bits of a word; the module sends one clock more, 26 for 25 bits.
        bits: Count[8];
    }
}

layout! {
    /// The word of one encoder, its last bit in D0; the bits above the word are to be masked.
    pub static SHIFT(p) {
        /// What has been clocked in, converted from Gray code where CONTROL says so.
        word: Framing[32];
    }
}

layout! {
    /// A write starts a reading of all three encoders.
    pub static START(p) {
        /// What is written does not matter.
        any: Framing[32];
    }
}

layout! {
    /// Which words the module converts from Gray code; none after a restart.
    pub static CONTROL(p) {
        /// Bits that the article does not name.
        unused: Framing[5];
        /// D2, the word in SHIFT 3: 1 converts it.
        gray_3: Status[1];
        /// D1, the word in SHIFT 2: 1 converts it.
        gray_2: Status[1];
        /// D0, the word in SHIFT 1: 1 converts it.
        gray_1: Status[1];
    }
}

layout! {
    /// The digital output, which has nothing to do with SSI.
    pub static OUTPUT(p) {
        /// Bits that the article does not name.
        unused: Framing[31];
        /// D0, the output on Hx: 1 switches it on.
        output: Status[1];
    }
}

layout! {
    /// What the module is, in characters: SI10 is Synchronous Serial Interface, revision 1.0.
    pub static IDENTITY(p) {
        /// The function of the module, two characters.
        function: Enid[16];
        /// Its revision, two characters.
        revision: Enid[16];
    }
}
