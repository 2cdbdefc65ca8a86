//! What a receiver makes of bytes that were sent at another baud rate.

use crate::bits;
use alloc::vec::Vec;

/// Bits of a byte on the wire, 8N1: a start bit, eight bits, a stop bit.
const FRAME: u64 = 10;

/// The bytes that a receiver at `to` baud takes from a burst that is sent at `from` baud.
///
/// The receiver samples in the middle of its bits; a start bit that is not there any more by then
/// is none, and a byte whose stop bit is missing is lost.
///
/// ```
/// use encoderscope::emulator::heard;
/// assert!(heard(&[0x64], 115_200, 2_500_000).is_empty());
/// assert_eq!(heard(&[0x64], 2_500_000, 2_526_316), [0x64]);
/// ```
#[must_use]
pub fn heard(bytes: &[u8], from: u32, to: u32) -> Vec<u8> {
    if from == to {
        return bytes.into();
    }
    // In units in which both bits are whole numbers.
    let (sent, bit) = (u64::from(to).max(1), u64::from(from).max(1));
    let end = bytes.len() as u64 * FRAME * sent;
    let is_high = |at: u64| level(bytes, at / sent);
    let next = |at: u64| (at / sent + 1) * sent;
    let mut out = Vec::new();
    let mut at = 0;
    while at < end {
        if is_high(at) {
            at = next(at);
            continue;
        }
        let sample = |index: u64| at + index * bit + bit / 2;
        if is_high(sample(0)) {
            at = sample(0);
            continue;
        }
        let byte = (0..8u32).fold(0, |byte, place| {
            byte | bits::placed(is_high(sample(1 + u64::from(place))).into(), place)
        });
        let mut stop = sample(9);
        if is_high(stop) {
            out.push(bits::low_byte(byte));
        }
        while stop < end && !is_high(stop) {
            stop = next(stop);
        }
        at = stop;
    }
    out
}

/// Whether the line is high during a bit of the burst; it is before and after.
fn level(bytes: &[u8], index: u64) -> bool {
    let Some(byte) = bytes.get((index / FRAME) as usize) else {
        return true;
    };
    match index % FRAME {
        0 => false,
        9 => true,
        place => bits::bit(u64::from(*byte), place as u32 - 1),
    }
}
