//! Parameters that are a word out of a few.

/// An enum whose values have a word each, for links, the command line and JavaScript.
macro_rules! choice {
    ($(#[doc = $doc:expr])* $name:ident { $($(#[doc = $value_doc:literal])* $value:ident = $word:literal,)* }) => {
        $(#[doc = $doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name { $($(#[doc = $value_doc])* $value,)* }

        impl $name {
            /// All values.
            pub const ALL: &[Self] = &[$(Self::$value),*];

            /// The word for it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$value => $word,)* }
            }
        }

        impl Choice for $name {
            const WORDS: &[&str] = &[$($word),*];
            const DOCS: &[&str] = &[$(concat!($($value_doc),*)),*];

            fn word(self) -> &'static str {
                self.name()
            }

            fn of_word(word: &str) -> Option<Self> {
                match word { $($word => Some(Self::$value),)* _ => None }
            }
        }
    };
}

/// What all choices share.
pub trait Choice: Copy {
    /// The words, in the order of the values.
    const WORDS: &[&str];
    /// What each of them means.
    const DOCS: &[&str];

    /// The word for a value.
    fn word(self) -> &'static str;

    /// The value of a word.
    fn of_word(word: &str) -> Option<Self>;
}

choice! {
    /// On which side the bits of a dump stand in its bytes.
    Justify {
        /// The first bit on the wire is the most significant bit of the first byte (SPI capture).
        Left = "left",
        /// The last bit on the wire is the least significant bit of the last byte (a number).
        Right = "right",
    }
}

choice! {
    /// How a word stands for a number.
    Code {
        /// One Gray-coded word: neighbours differ in one bit.
        Gray = "gray",
        /// Binary.
        Binary = "binary",
    }
}

choice! {
    /// Where the number stands in an SSI word.
    Align {
        /// Fir-tree: turns to the left of a fixed axis, angle to the right of it.
        Tree = "tree",
        /// At the end of the word.
        Right = "right",
    }
}

choice! {
    /// How a parity bit is computed.
    Parity {
        /// There is no parity bit, or nothing is known of it.
        None = "none",
        /// The number of ones is even, parity bit included.
        Even = "even",
        /// The number of ones is odd, parity bit included.
        Odd = "odd",
    }
}

choice! {
    /// How the turn counter is read.
    TurnsCode {
        /// From 0 up.
        Unsigned = "unsigned",
        /// Two's complement: turns below the zero are negative.
        Signed = "signed",
    }
}

choice! {
    /// Which level of a status bit says that the condition is there.
    StatusActive {
        /// 1.
        High = "high",
        /// 0.
        Low = "low",
    }
}

choice! {
    /// Whose meaning the T485 alarm byte has, and which requests are known.
    Dialect {
        /// MPP and PT: angle, turns, all, and two resets.
        Mpp = "mpp",
        /// Tamagawa's own encoders: identity, EEPROM and error reset too.
        Tamagawa = "tamagawa",
    }
}

choice! {
    /// Which bytes of an ASI1 packet have their top bit set; any is accepted.
    Marker {
        /// None.
        None = "none",
        /// The first of a packet.
        First = "first",
    }
}
pub(crate) use choice;
