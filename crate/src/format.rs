//! The wire formats, one manual page a file.
//!
//! To add a format, write its file: a [`Spec`] with its name, parameters and limits, a [`Manual`]
//! with its layouts and an example; then name the file in [`Format`]'s list.

pub mod timing;

use crate::{
    language::msg,
    layout::{Layout, Resolved, Shape, StatusBit, layout},
    profile::Profile,
};
use alloc::{string::String, vec::Vec};
use timing::Timing;

/// Formats, each with its module, in the order of their pages in the manuals.
macro_rules! formats {
    ($($(#[$doc:meta])* $name:ident $module:ident),*; $(#[$own_doc:meta])* $own:ident $own_module:ident) => {
        $(pub mod $module;)*
        pub mod $own_module;

        /// A wire format.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Format {
            $($(#[$doc])* $name,)*
            $(#[$own_doc])* $own,
        }

        impl Format {
            /// All formats of the manuals, in the order of their pages.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// What is to be known of the format before any frame.
            #[must_use]
            pub const fn spec(self) -> &'static Spec {
                match self {
                    $(Self::$name => &$module::SPEC,)*
                    Self::$own => &$own_module::SPEC,
                }
            }

            /// What its manual says of it.
            #[must_use]
            pub const fn manual(self) -> &'static Manual {
                match self {
                    $(Self::$name => &$module::MANUAL,)*
                    Self::$own => &$own_module::MANUAL,
                }
            }
        }
    };
}

formats! {
    /// MPP and PT SSI: [`ssi`].
    Ssi ssi,
    /// BiSS-C: [`biss_c`].
    BissC biss_c,
    /// MPP and PT commands over RS485 and RS422: [`rs485`].
    Rs485 rs485,
    /// Tamagawa-compatible T485: [`t485`].
    T485 t485,
    /// MPP and PT high-speed bus: [`bus`].
    Bus bus,
    /// MPP and PT free-running: [`period`].
    Period period,
    /// IP-75 binary stream: [`asi1`].
    Asi1 asi1,
    /// IP-75 text stream: [`asi4`].
    Asi4 asi4,
    /// IP-75 SSI: [`ssi7`].
    Ssi7 ssi7,
    /// Pepperl+Fuchs and the classic SSI word: [`ssi_tree`].
    SsiTree ssi_tree,
    /// The SPI word of AS5047 and AS5048: [`as5048`].
    As5048 as5048;
    /// A layout of the user's own: [`own`].
    Own own
}

/// How frames come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// A master clocks them out; a USB adapter cannot.
    Clocked,
    /// A host asks over a serial line and the encoder answers.
    Polled,
    /// The encoder sends them over a serial line unasked.
    Stream,
}

/// What a dump of a format consists of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// A line is a frame, made of bits.
    Bits,
    /// The whole input is one stream of bytes.
    Bytes,
    /// As bytes, but lines of decimal numbers stand for themselves.
    Text,
}

/// How wide the numbers of a format can be, in bits.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Angle.
    pub angle: u32,
    /// Turn counter.
    pub turns: u32,
    /// Both together.
    pub together: u32,
    /// Shortest and longest frame, where its length is a parameter.
    pub frame: (u32, u32),
}

/// What is to be known of a format before any frame.
#[derive(Clone, Copy, Debug)]
pub struct Spec {
    /// The name in parameters and links.
    pub name: &'static str,
    /// The name for people.
    pub title: &'static str,
    /// How frames come.
    pub link: Link,
    /// The names of the parameters that matter.
    pub parameters: &'static [&'static str],
    /// The names of what its frames may hold beside position and health, in records.
    pub quantities: &'static [&'static str],
    /// How wide the numbers can be.
    pub limits: Limits,
    /// Microseconds from one frame of a stream to the next.
    pub interval: Option<u64>,
    /// What omitted parameters are: the widest encoder of the manual that speaks the format.
    pub default: Profile,
}

/// What a manual says of a format: how its frames are laid out, and what is to be read about them.
/// It stands apart from the [`Spec`], which every program needs first.
#[derive(Clone, Copy, Debug)]
pub struct Manual {
    /// What it is, in a few words.
    pub about: &'static str,
    /// The manual it comes from, and the place in it.
    pub source: &'static str,
    /// What its manual asks of clock and pause, where a master clocks the frames out.
    pub timing: Option<&'static Timing>,
    /// A dump of a few frames, from public captures and the manual's rules.
    pub example: &'static str,
    /// Profiles that detection tries, where it has no way of its own of making them.
    pub guesses: &'static [Profile],
    /// The layouts of the frames that a profile has.
    pub layouts: fn(&Profile, Shape) -> Vec<Resolved>,
}

impl Format {
    /// The name in parameters and links.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.spec().name
    }

    /// The name for people.
    #[must_use]
    pub const fn title(self) -> &'static str {
        self.spec().title
    }

    /// The format of a name.
    #[must_use]
    pub fn parse(name: &str) -> Option<Self> {
        Self::known().find(|format| format.name().eq_ignore_ascii_case(name))
    }

    /// All names, with spaces between.
    #[must_use]
    pub fn names() -> String {
        Self::known().map(Self::name).collect::<Vec<_>>().join(" ")
    }

    /// The formats of the manuals, and the user's own.
    fn known() -> impl Iterator<Item = Self> {
        Self::ALL.iter().copied().chain([Self::Own])
    }

    /// Microseconds from one frame of a stream to the next.
    #[must_use]
    pub const fn interval(self) -> Option<u64> {
        self.spec().interval
    }

    /// What its manual asks of clock and pause, where a master clocks the frames out.
    #[must_use]
    pub const fn timing(self) -> Option<&'static Timing> {
        self.manual().timing
    }

    /// The names of the parameters that matter to this format.
    #[must_use]
    pub const fn parameters(self) -> &'static [&'static str] {
        self.spec().parameters
    }

    /// How wide the numbers can be.
    #[must_use]
    pub const fn limits(self) -> Limits {
        self.spec().limits
    }

    /// The profile that omitted parameters are taken from.
    #[must_use]
    pub const fn default_profile(self) -> Profile {
        self.spec().default
    }
}

/// What changes an encoder must be asked for ten times (MPP "RS485" note 3, "T485" notes 3 and
/// 4, "BUS" set zero and set address).
pub const TIMES: u8 = 10;

/// What only the reference says, left out where a program must be small.
pub(crate) const fn said(text: &'static str) -> &'static str {
    spared(text)
}

/// What is no text, left out where a program must be small.
pub(crate) const fn spared(data: &'static str) -> &'static str {
    if cfg!(feature = "small") { "" } else { data }
}

/// The only layout of a format.
fn one(layout: &'static Layout, shape: Shape) -> Vec<Resolved> {
    Vec::from([Resolved::new(layout, shape)])
}

/// Bits above the angle in the two bytes, or above 16 bits per turn three, that RS485, RS422,
/// PERIOD and BUS send it in (MPP "RS485", note 2; "BUS").
const fn angle_padding(profile: &Profile) -> u32 {
    let bits = if profile.angle_bits > 16 { 24u32 } else { 16 };
    bits.saturating_sub(profile.angle_bits)
}

/// Bits above the turn counter in its whole bytes.
const fn turns_padding(profile: &Profile) -> u32 {
    profile.turns_bits.next_multiple_of(8) - profile.turns_bits
}

layout! {
    /// Error, warning and status, as SSI, RS485, RS422, PERIOD and BUS send them.
    pub static HEALTH(p) {
        /// The position is not valid; the encoder's LED is red.
        error: Error[1];
        /// The position is valid, but the status names something near its limit; LED yellow.
        warning: Warning[1];
        /// Battery, magnetic field, temperature and speed.
        status: Status[6], bits = STATUS;
    }
}

layout! {
    /// A request of one byte.
    pub static REQUEST_BYTE(p) {
        /// What the host asks for.
        command: Operation[8];
    }
}

/// Whether the encoder's LED blinks, once a second, while a status bit of this name is set: those
/// of the battery (MPP and PT, "LED").
///
/// ```
/// use encoderscope::format::blinks;
/// assert!(blinks("battery low") && !blinks("overspeed"));
/// ```
#[must_use]
pub fn blinks(name: &str) -> bool {
    let battery = STATUS.iter().filter(|bit| bit.place >= 4);
    battery.into_iter().any(|bit| bit.name == name)
}

/// The six status bits that SSI, BiSS-C, RS485, RS422, BUS and PERIOD share
/// (MPP and PT, "Status bits").
pub static STATUS: &[StatusBit] = &[
    StatusBit {
        place: 5,
        name: msg("battery disconnected"),
        doc: msg(
            "the turn counter was lost and restarted from 0; check the battery, then power-cycle",
        ),
        role: None,
    },
    StatusBit {
        place: 4,
        name: msg("battery low"),
        doc: msg("below 2.9 V the turns are still good, below 2.7 V not; replace the battery"),
        role: None,
    },
    StatusBit {
        place: 3,
        name: msg("field too strong"),
        doc: msg(
            "the rotor is too close to the stator or a magnet is near; check the mounting gap",
        ),
        role: None,
    },
    StatusBit {
        place: 2,
        name: msg("field too weak"),
        doc: msg("the rotor is too far from the stator; check the mounting gap"),
        role: None,
    },
    StatusBit {
        place: 1,
        name: msg("temperature out of range"),
        doc: msg("the encoder is hotter or colder than its order code allows"),
        role: None,
    },
    StatusBit {
        place: 0,
        name: msg("overspeed"),
        doc: msg("the shaft turns faster than the encoder can follow; slow down"),
        role: None,
    },
];
