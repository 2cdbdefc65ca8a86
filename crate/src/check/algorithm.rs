//! CRCs described by their parameters, and those that sensors are known to use.

use super::{BISS, X97, XOR};
use crate::{
    bits::{self, Bits, Polynomial, Span},
    language::t,
    say,
};
use alloc::{format, vec::Vec};
use core::fmt;

/// The parameters of a CRC (R. N. Williams, "A painless guide to CRC error detection
/// algorithms"), 3 to 16 bits wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Algorithm {
    /// Number of bits.
    pub width: u32,
    /// The generator without its highest power.
    pub polynomial: u64,
    /// The register at the start.
    pub init: u64,
    /// Whether each byte goes in least significant bit first.
    pub refin: bool,
    /// Whether the register is read out least significant bit first.
    pub refout: bool,
    /// What is added to the register at the end.
    pub xorout: u64,
}

/// The parameters of BiSS Safety's second CRC (BiSS Association, "BiSS Safety"), sent inverted.
const BISS_16: Algorithm = Algorithm {
    width: 16,
    polynomial: 0x90d9,
    init: 0,
    refin: false,
    refout: false,
    xorout: 0xffff,
};

macro_rules! known {
    ($($name:literal: $of:ident($algorithm:expr),)*) => {
        /// The names and parameters of CRCs that sensors use; the parameters are those of Greg
        /// Cook's catalogue of parametrised CRC algorithms and of the manuals.
        pub const KNOWN: &[(&str, Self)] = &[
            $(($name, Self::$of(&$algorithm)),)*
            ("CRC-16/BISS", BISS_16),
        ];
    };
}

impl Algorithm {
    known! {
        "CRC-3/GSM": of_u8(crc::CRC_3_GSM),
        "CRC-4/G-704": of_u8(crc::CRC_4_G_704),
        "CRC-4/INTERLAKEN": of_u8(crc::CRC_4_INTERLAKEN),
        "CRC-5/USB": of_u8(crc::CRC_5_USB),
        "CRC-5/EPC-C1G2": of_u8(crc::CRC_5_EPC_C1G2),
        "CRC-5/G-704": of_u8(crc::CRC_5_G_704),
        "CRC-6/BISS": of_u8(BISS),
        "CRC-6/G-704": of_u8(crc::CRC_6_G_704),
        "CRC-6/GSM": of_u8(crc::CRC_6_GSM),
        "CRC-6/DARC": of_u8(crc::CRC_6_DARC),
        "CRC-7/MMC": of_u8(crc::CRC_7_MMC),
        "CRC-8/0x97": of_u8(X97),
        "exclusive or": of_u8(XOR),
        "CRC-8/SMBUS": of_u8(crc::CRC_8_SMBUS),
        "CRC-8/I-432-1": of_u8(crc::CRC_8_I_432_1),
        "CRC-8/ROHC": of_u8(crc::CRC_8_ROHC),
        "CRC-8/MAXIM": of_u8(crc::CRC_8_MAXIM_DOW),
        "CRC-8/NRSC-5": of_u8(crc::CRC_8_NRSC_5),
        "CRC-8/AUTOSAR": of_u8(crc::CRC_8_AUTOSAR),
        "CRC-8/OPENSAFETY": of_u8(crc::CRC_8_OPENSAFETY),
        "CRC-8/SAE-J1850": of_u8(crc::CRC_8_SAE_J1850),
        "CRC-8/GSM-A": of_u8(crc::CRC_8_GSM_A),
        "CRC-8/LTE": of_u8(crc::CRC_8_LTE),
        "CRC-8/WCDMA": of_u8(crc::CRC_8_WCDMA),
        "CRC-8/CDMA2000": of_u8(crc::CRC_8_CDMA2000),
        "CRC-8/DVB-S2": of_u8(crc::CRC_8_DVB_S2),
        "CRC-8/BLUETOOTH": of_u8(crc::CRC_8_BLUETOOTH),
        "CRC-10/ATM": of_u16(crc::CRC_10_ATM),
        "CRC-11/FLEXRAY": of_u16(crc::CRC_11_FLEXRAY),
        "CRC-12/DECT": of_u16(crc::CRC_12_DECT),
        "CRC-12/UMTS": of_u16(crc::CRC_12_UMTS),
        "CRC-14/DARC": of_u16(crc::CRC_14_DARC),
        "CRC-15/CAN": of_u16(crc::CRC_15_CAN),
        "CRC-16/BUYPASS": of_u16(crc::CRC_16_UMTS),
        "CRC-16/ARC": of_u16(crc::CRC_16_ARC),
        "CRC-16/MODBUS": of_u16(crc::CRC_16_MODBUS),
        "CRC-16/USB": of_u16(crc::CRC_16_USB),
        "CRC-16/CCITT-FALSE": of_u16(crc::CRC_16_IBM_3740),
        "CRC-16/XMODEM": of_u16(crc::CRC_16_XMODEM),
        "CRC-16/KERMIT": of_u16(crc::CRC_16_KERMIT),
        "CRC-16/X-25": of_u16(crc::CRC_16_IBM_SDLC),
        "CRC-16/GENIBUS": of_u16(crc::CRC_16_GENIBUS),
        "CRC-16/MCRF4XX": of_u16(crc::CRC_16_MCRF4XX),
        "CRC-16/DNP": of_u16(crc::CRC_16_DNP),
        "CRC-16/T10-DIF": of_u16(crc::CRC_16_T10_DIF),
        "CRC-16/PROFIBUS": of_u16(crc::CRC_16_PROFIBUS),
    }

    pub(super) const fn of_u8(from: &crc::Algorithm<u8>) -> Self {
        Self {
            width: from.width as u32,
            polynomial: from.poly as u64,
            init: from.init as u64,
            refin: from.refin,
            refout: from.refout,
            xorout: from.xorout as u64,
        }
    }

    pub(super) const fn of_u16(from: &crc::Algorithm<u16>) -> Self {
        Self {
            width: from.width as u32,
            polynomial: from.poly as u64,
            init: from.init as u64,
            refin: from.refin,
            refout: from.refout,
            xorout: from.xorout as u64,
        }
    }

    /// The usual name, where the parameters have one.
    ///
    /// ```
    /// use encoderscope::check::{Algorithm, Checksum};
    /// let crc = Checksum::Crc16x8005.algorithm().unwrap();
    /// assert_eq!(crc.name(), Some("CRC-16/BUYPASS"));
    /// ```
    #[must_use]
    pub fn name(&self) -> Option<&'static str> {
        let mut known = Self::KNOWN.iter();
        known
            .find(|(_, known)| known == self)
            .map(|(name, _)| *name)
    }

    /// The generator with its highest power.
    #[must_use]
    pub fn generator(&self) -> Polynomial {
        Polynomial::from(1).followed(self.polynomial, self.width)
    }

    /// The CRC of a run of bits.
    ///
    /// With `refin` each eight bits from the start of the run go in last bit first, and so do
    /// those of a shorter rest.
    ///
    /// ```
    /// use encoderscope::{bits::{Bits, Span}, check::Algorithm};
    /// let (_, modbus) = Algorithm::KNOWN.iter().find(|(name, _)| *name == "CRC-16/MODBUS").unwrap();
    /// assert_eq!(modbus.compute(Bits::of_bytes(b"123456789"), Span::new(0, 72)), 0x4b37);
    /// ```
    #[must_use]
    pub fn compute(&self, bits: Bits<'_>, over: Span) -> u64 {
        let mut register = self.start();
        self.order(over, |at| register = self.shifted(register, bits.bit(at)));
        self.result(register)
    }

    /// What a program looks up that goes byte by byte: the register, 0 at first, after each value
    /// of a byte, or of as many bits as the register has where those are fewer.
    ///
    /// ```
    /// use encoderscope::check::Checksum;
    /// let table = Checksum::Crc6Biss.algorithm().unwrap().table();
    /// assert_eq!((table.len(), &table[..3]), (64, &[0x00, 0x03, 0x06][..]));
    /// ```
    #[must_use]
    pub fn table(&self) -> Vec<u64> {
        let width = self.width.min(8);
        let entry = |value: u64| {
            // Reflected, the first bit to go in is the least significant one.
            let sent = if self.refin {
                bits::reversed(value, width)
            } else {
                value
            };
            let register = (0..width).rev().fold(0, |register, place| {
                self.shifted(register, bits::bit(sent, place))
            });
            if self.refin {
                bits::reversed(register, self.width)
            } else {
                register
            }
        };
        (0..=bits::mask(width as usize)).map(entry).collect()
    }

    /// The register before the first bit.
    pub(super) const fn start(&self) -> u64 {
        self.init & bits::mask(self.width as usize)
    }

    /// The register after one more bit.
    pub(super) const fn shifted(&self, register: u64, bit: bool) -> u64 {
        let moved = bits::placed(register, 1) & bits::mask(self.width as usize);
        match self.subtracts(register, bit) {
            true => moved ^ self.polynomial,
            false => moved,
        }
    }

    /// Whether the bit that the register shifts out and the one that comes in differ, so that the
    /// polynomial is subtracted.
    pub(super) const fn subtracts(&self, register: u64, bit: bool) -> bool {
        bits::bit(register, self.width.saturating_sub(1)) != bit
    }

    /// Tells the places of a run in the order in which they go in.
    pub(super) fn order(&self, over: Span, mut take: impl FnMut(usize)) {
        for from in (over.start..over.end()).step_by(8) {
            let to = over.end().min(from + 8);
            match self.refin {
                true => (from..to).rev().for_each(&mut take),
                false => (from..to).for_each(&mut take),
            }
        }
    }

    /// What the register comes to at the end.
    pub(super) const fn result(&self, register: u64) -> u64 {
        let out = match self.refout {
            true => bits::reversed(register, self.width),
            false => register,
        };
        (out ^ self.xorout) & bits::mask(self.width as usize)
    }
}

impl fmt::Display for Algorithm {
    /// The usual name with the polynomial, or all parameters.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = self.width.div_ceil(4) as usize;
        let hex = |number: u64| format!("{number:0digits$X}");
        if *self == Self::of_u8(&XOR) {
            return f.write_str(t("exclusive or of all bytes"));
        }
        if let Some(name) = self.name() {
            return say!(f, "{} (polynomial 0x{})", name, hex(self.polynomial));
        }
        say!(
            f,
            "CRC-{} with polynomial 0x{}, start 0x{}",
            self.width,
            hex(self.polynomial),
            hex(self.init)
        )?;
        match (self.refin, self.refout) {
            (false, false) => {}
            (true, true) => f.write_str(t(", reflected"))?,
            (true, false) => f.write_str(t(", bytes reflected"))?,
            (false, true) => f.write_str(t(", result reflected"))?,
        }
        match self.xorout {
            0 => Ok(()),
            all if all == bits::mask(self.width as usize) => f.write_str(t(", inverted")),
            other => say!(f, ", result changed by 0x{}", hex(other)),
        }
    }
}
