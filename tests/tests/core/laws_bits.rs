//! Laws of bit strings, checksums and codes.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    bits::{self, BitString, Bits, Span, from_gray, to_gray},
    check::Checksum,
};
use encoderscope_tests::Noise;

const CRCS: [(Checksum, u32); 4] = [
    (Checksum::Crc6Biss, 0x43),
    (Checksum::Crc8x97, 0x197),
    (Checksum::Crc8Xor, 0x101),
    (Checksum::Crc16x8005, 0x1_8005),
];

/// The remainder of the bits in `span`, with as many zeros behind as the divisor has bits but
/// one, by long division.
fn remainder(bits: Bits<'_>, span: Span, divisor: u32) -> u64 {
    let width = divisor.ilog2();
    let mut register = 0u32;
    for index in span.start..span.end() + width as usize {
        let next = index < span.end() && bits.bit(index);
        register = (register << 1) | u32::from(next);
        if register >> width == 1 {
            register ^= divisor;
        }
    }
    register.into()
}

fn random_bytes(noise: &mut Noise, len: usize) -> Vec<u8> {
    (0..len).map(|_| noise.draw() as u8).collect()
}

#[test]
fn check_values_of_the_checksums() {
    let text = b"123456789";
    let all = Span::new(0, 72);
    let of = |sum: Checksum| sum.compute(Bits::of_bytes(text), all);
    assert_eq!(of(Checksum::Crc8x97), 0x94);
    assert_eq!(of(Checksum::Crc8Xor), 0x31);
    assert_eq!(of(Checksum::Crc6Biss), 0x2e);
    assert_eq!(of(Checksum::Crc16x8005), 0xfee8);
    let moteus = [0b0001_0010, 0b0011_0100];
    assert_eq!(
        Checksum::Crc6Biss.compute(Bits::of_bytes(&moteus), Span::new(0, 16)),
        56 ^ 0x3f
    );
}

#[test]
fn a_crc_is_the_remainder_of_long_division() {
    let mut noise = Noise::new(1);
    for (sum, divisor) in CRCS {
        assert_eq!(sum.width(), divisor.ilog2(), "{sum:?}");
        let inverted = if sum == Checksum::Crc6Biss { 0x3f } else { 0 };
        for len in 0..=40 {
            let bytes = random_bytes(&mut noise, len);
            let bits = Bits::of_bytes(&bytes);
            let all = Span::new(0, len * 8);
            let expected = remainder(bits, all, divisor) ^ inverted;
            assert_eq!(sum.compute(bits, all), expected, "{sum:?} {bytes:02x?}");
        }
    }
}

/// The longest run that a frame of BiSS-C can have under its CRC is 74 bits.
#[test]
fn a_crc_of_any_number_of_bits_from_any_bit_on_is_the_remainder_of_long_division() {
    let mut noise = Noise::new(2);
    for (sum, divisor) in CRCS {
        let inverted = if sum == Checksum::Crc6Biss { 0x3f } else { 0 };
        for len in 1..=82 {
            for start in 0..8 {
                let bytes = random_bytes(&mut noise, 12);
                let bits = Bits::of_bytes(&bytes);
                let span = Span::new(start, len);
                let expected = match sum {
                    // The exclusive or of bytes that are not whole has no meaning on any wire.
                    Checksum::Crc8Xor if len % 8 != 0 => continue,
                    _ => remainder(bits, span, divisor) ^ inverted,
                };
                assert_eq!(sum.compute(bits, span), expected, "{sum:?} {span:?}");
            }
        }
    }
}

#[test]
fn the_crc_of_t485_and_bus_is_the_exclusive_or_of_all_bytes() {
    let mut noise = Noise::new(3);
    for len in 0..=12 {
        let bytes = random_bytes(&mut noise, len);
        let expected = bytes.iter().fold(0, |sum, byte| sum ^ byte);
        let computed = Checksum::Crc8Xor.compute(Bits::of_bytes(&bytes), Span::new(0, len * 8));
        assert_eq!(computed, u64::from(expected), "{bytes:02x?}");
    }
}

#[test]
fn a_parity_bit_makes_the_number_of_ones_even_or_odd() {
    let mut noise = Noise::new(4);
    for len in 1..=64 {
        let bytes = random_bytes(&mut noise, 10);
        let bits = Bits::of_bytes(&bytes);
        let span = Span::new(noise.below(80 - len) as usize, len as usize);
        let ones = (span.start..span.end()).filter(|at| bits.bit(*at)).count() as u64;
        let even = Checksum::EvenParity.compute(bits, span);
        let odd = Checksum::OddParity.compute(bits, span);
        assert_eq!(((ones + even) % 2, (ones + odd) % 2), (0, 1), "{span:?}");
    }
}

#[test]
fn neighbours_differ_in_one_bit_of_their_gray_codes() {
    for width in 1..=14 {
        let mut seen = vec![false; 1 << width];
        for number in 0..1u64 << width {
            let code = to_gray(number);
            assert_eq!(from_gray(code), number, "{width}");
            let next = to_gray((number + 1) & bits::mask(width));
            assert_eq!((code ^ next).count_ones(), 1, "{width} {number}");
            assert!(!core::mem::replace(&mut seen[code as usize], true));
        }
    }
}

#[test]
fn gray_codes_of_any_width_are_read_back() {
    let mut noise = Noise::new(5);
    for width in 1..=64 {
        let all = bits::mask(width);
        for _ in 0..50 {
            let number = (noise.draw() << 32 ^ noise.draw()) & all;
            let code = to_gray(number);
            assert_eq!(code & !all, 0, "{width} {number:x}");
            assert_eq!(from_gray(code), number, "{width}");
            assert_eq!(to_gray(from_gray(number)), number, "{width}");
            let next = to_gray(number.wrapping_add(1) & all);
            assert_eq!((code ^ next).count_ones(), 1, "{width} {number:x}");
        }
    }
}

#[test]
fn twos_complement_of_any_width_is_read_back() {
    for width in 1..=63 {
        let half = 1i64 << (width - 1);
        for number in [-half, -1, 0, half - 1] {
            assert_eq!(bits::signed(number as u64, width), number, "{width}");
            let code = number as u64 & bits::mask(width);
            assert_eq!(bits::signed(code, width), number, "{width}");
        }
    }
    for number in [i64::MIN, -1, 0, i64::MAX] {
        assert_eq!(bits::signed(number as u64, 64), number);
    }
}

#[test]
fn bits_are_read_as_they_were_written_anywhere() {
    let mut noise = Noise::new(6);
    for len in 0..=64 {
        for start in 0..16 {
            let before = BitString::of_bytes(random_bytes(&mut noise, 10));
            let mut after = before.clone();
            let span = Span::new(start, len);
            let number = (noise.draw() << 32 ^ noise.draw()) & bits::mask(len);
            after.write(span, number);
            assert_eq!(after.as_bits().read(span), number, "{span:?}");
            let digits = (start..span.end()).fold(0, |sum, at| {
                bits::placed(sum, 1) | u64::from(after.as_bits().bit(at))
            });
            assert_eq!(digits, number, "{span:?}");
            for at in (0..80).filter(|at| !span.contains(*at)) {
                let same = after.as_bits().bit(at) == before.as_bits().bit(at);
                assert!(same, "{span:?} {at}");
            }
            let (bytes, used) = after.as_bits().right_aligned::<16>(span);
            assert_eq!(used, len.div_ceil(8), "{span:?}");
            assert_eq!(u128::from_be_bytes(bytes), number.into(), "{span:?}");
        }
    }
}

#[test]
fn decimal_digits_are_read_as_they_were_written() {
    for number in (0..100_000).step_by(7) {
        let digits = bits::decimal_digits(number) as usize;
        let text = number.to_string();
        assert_eq!(digits, text.len());
        let span = Span::new(0, digits * 8);
        let mut out = BitString::zeros(span.len);
        out.write_decimal(span, number);
        assert_eq!(out.as_bits().bytes(), text.as_bytes());
        assert_eq!(out.as_bits().decimal(span), Some(number));
    }
    let none = Bits::of_bytes(b"1 3");
    assert_eq!(none.decimal(Span::new(0, 24)), None);
}
