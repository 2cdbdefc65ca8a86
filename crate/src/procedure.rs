//! How the zero of each product is set: a checklist, with what is to be seen after each step.
//!
//! What is sent, how often, and how long the encoder is silent is that of [`crate::sequence`].
//!
//! ```
//! use encoderscope::{procedure::zero, product::{Interface, Series}};
//! let zero = zero(Series::Mpp, Interface::Rs485)?;
//! let pairs = zero.procedures[0].steps.iter().find(|step| step.times > 1).unwrap();
//! assert_eq!((pairs.times, pairs.sends.clone()), (10, vec![vec![0x31], vec![0x30]]));
//! # Ok::<(), encoderscope::calculator::Fault>(())
//! ```

mod by_command;
mod by_wire;

use crate::{
    calculator::Fault,
    language::{msg, t},
    product::{Interface, Series},
    profile::Profile,
    sequence::Change,
};
use alloc::{string::String, vec::Vec};

pub use by_wire::HOLD;

/// How the zero of an encoder is set.
#[derive(Clone, Debug)]
pub struct Zero {
    /// The ways there are.
    pub procedures: Vec<Procedure>,
    /// What does not exist.
    pub missing: Vec<Missing>,
}

/// A way of setting a zero.
#[derive(Clone, Debug)]
pub struct Procedure {
    /// Its name, in kebab-case.
    pub name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// What it does.
    pub about: &'static str,
    /// What is to be done, in order.
    pub steps: Vec<Step>,
    /// What else to know.
    pub notes: Vec<&'static str>,
    /// What the console does of it, where it is done by commands.
    pub change: Option<Change>,
    /// The profile with which the console can do or watch it.
    pub console: Option<Profile>,
}

/// A step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// What to do.
    pub text: String,
    /// What is to be seen then.
    pub expect: String,
    /// What is sent, a command each.
    pub sends: Vec<Vec<u8>>,
    /// How often all of it is sent.
    pub times: u8,
    /// Where it is from.
    pub source: &'static str,
}

/// What does not exist, so that nobody looks for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The sentences.
    pub text: &'static str,
    /// Where they are from.
    pub source: &'static str,
}

/// How the zero of an encoder with an interface is set.
///
/// # Errors
///
/// The series does not come with the interface.
pub fn zero(series: Series, interface: Interface) -> Result<Zero, Fault> {
    crate::wiring::exists(series, interface)?;
    Ok(match interface {
        Interface::Rs485 | Interface::Rs422 => by_command::rs485(interface),
        Interface::T485 => by_command::t485(),
        Interface::Bus => by_command::bus(),
        Interface::Ssi | Interface::BissC | Interface::Period => offset(interface),
        Interface::Asi1 | Interface::Asi4 | Interface::Ssi7 => by_wire::ip75(interface),
        Interface::SsiTree => by_wire::preset(),
    })
}

impl Step {
    /// A step done by hand.
    fn by_hand(text: impl Into<String>, expect: impl Into<String>, source: &'static str) -> Self {
        Self {
            text: text.into(),
            expect: expect.into(),
            sends: Vec::new(),
            times: 0,
            source: t(source),
        }
    }
}

const STILL: (&str, &str) = (
    msg("Turn the shaft to where the zero is to be, and hold it there."),
    msg("the angle repeats to ±1 bit"),
);

/// Where the encoder only sends, the controller takes the zero off.
fn offset(interface: Interface) -> Zero {
    let source = match interface {
        Interface::Period => t("MPP and PT, PERIOD"),
        Interface::BissC => t("MPP and PT, BiSS-C"),
        _ => t("MPP and PT, SSI"),
    };
    let text = match interface {
        Interface::Period => t(
            "PERIOD listens to nothing on RX, so no command can set the zero. The manuals name no \
             other way.",
        ),
        _ => t("The manuals name no command and no input that sets the zero with this interface."),
    };
    let missing = [
        Missing { text, source },
        Missing {
            text: t(
                "Where the encoder itself must hold the zero, order it with R (RS485), A \
                   (RS422) or D (BUS): those store it by command. T (T485) has a command too, but \
                   the manuals do not say that it is kept without power.",
            ),
            source: t("MPP and PT, order code"),
        },
    ];
    let arithmetic = t("arithmetic; MPP and PT, data format");
    let steps = [
        Step::by_hand(t(STILL.0), t(STILL.1), t("MPP and PT, repeatability")),
        Step::by_hand(
            t(
                "Read the position and store it in the controller as the offset Z: the angle, or \
             turns and angle as one number where turns are counted.",
            ),
            t("the offset is kept without power"),
            arithmetic,
        ),
        Step::by_hand(
            t("Subtract Z from every position, modulo 2 to the number of bits."),
            t("0 at the place of the zero, and no jump elsewhere"),
            arithmetic,
        ),
    ];
    let procedure = Procedure {
        name: "offset",
        title: t("In the controller"),
        about: t("The encoder keeps its zero; the controller takes an offset off."),
        steps: steps.into(),
        notes: Vec::new(),
        change: None,
        console: None,
    };
    Zero {
        procedures: [procedure].into(),
        missing: missing.into(),
    }
}
