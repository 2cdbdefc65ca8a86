//! Figures of a shaft at rest.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    emulator::{Emulator, Shaft},
    standstill::{Figures, Standstill},
};
use encoderscope_tests::{Noise, decoder};

fn figures(angle_bits: u32, angles: &[u64]) -> Figures {
    let mut standstill = Standstill::new(angle_bits);
    for (at, angle) in (0..).zip(angles) {
        standstill.push(at, *angle);
    }
    standstill.figures().unwrap()
}

#[test]
fn a_shaft_at_rest_has_no_spread_at_all() {
    let found = figures(24, &[4_194_304; 1_000]);
    assert_eq!((found.sigma, found.peak_to_peak), (0.0, 0));
    assert_eq!((found.mean, found.width), (4_194_304.0, 1));
    assert_eq!(found.bins, [1_000]);
}

#[test]
fn the_same_noise_has_the_same_figures_wherever_zero_is() {
    let mut noise = Noise::new(1);
    let spread: Vec<u64> = (0..3_000).map(|_| noise.below(7)).collect();
    let plain = figures(17, &spread.iter().map(|n| 1_000 + n).collect::<Vec<_>>());
    for zero in [0, 1, 2, 3, 6] {
        let codes = 131_072;
        let angles: Vec<u64> = spread.iter().map(|n| (codes - zero + n) % codes).collect();
        let found = figures(17, &angles);
        let mean = (plain.mean - 1_000.0 - zero as f64).rem_euclid(codes as f64);
        assert!((found.mean - mean).abs() < 1e-9, "{zero}: {}", found.mean);
        assert_eq!(
            Figures {
                mean: plain.mean,
                ..found
            },
            plain,
            "{zero}"
        );
    }
}

#[test]
fn sigma_is_the_standard_deviation() {
    let mut noise = Noise::new(2);
    for spread in [2, 10, 1_000, 1_000_000] {
        let angles: Vec<u64> = (0..2_000)
            .map(|_| 5_000_000 + noise.below(spread))
            .collect();
        let mean = angles.iter().sum::<u64>() as f64 / 2_000.0;
        let squares = angles.iter().map(|angle| (*angle as f64 - mean).powi(2));
        let sigma = (squares.sum::<f64>() / 2_000.0).sqrt();
        let found = figures(24, &angles);
        assert!((found.sigma - sigma).abs() < 1e-5 * sigma, "{spread}");
        assert!((found.mean - mean).abs() < 1e-6, "{spread}");
        assert_eq!(
            found.peak_to_peak,
            angles.iter().max().unwrap() - angles.iter().min().unwrap()
        );
    }
}

#[test]
fn every_sample_is_in_a_bin_of_whole_counts() {
    let mut noise = Noise::new(3);
    for round in 0..300 {
        let angle_bits = 1 + noise.below(64) as u32;
        let codes = 2f64.powi(angle_bits as i32);
        let limit = 1 + (noise.below(1_000) * noise.below(1_000)).min(codes as u64 - 1);
        let count = 1 + noise.below(if round == 0 { 9_000 } else { 200 });
        let angles: Vec<u64> = (0..count).map(|_| noise.below(limit)).collect();
        let found = figures(angle_bits, &angles);
        assert_eq!(found.samples, angles.len().min(4_096));
        assert_eq!(found.bins.iter().sum::<u32>() as usize, found.samples);
        assert!(found.bins.len() <= 41 && found.bins.len() % 2 == 1 && found.width >= 1);
        assert!(found.mean >= 0.0 && found.mean < codes, "{}", found.mean);
        assert!(found.sigma <= found.peak_to_peak as f64 / 2.0 + 1e-3);
    }
}

#[test]
fn only_the_last_second_counts() {
    let mut standstill = Standstill::new(20);
    standstill.push(0, 500);
    for at in 1..=100 {
        standstill.push(at * 20_000, 1_000);
    }
    assert_eq!(standstill.figures().unwrap().peak_to_peak, 0);
    assert_eq!(standstill.figures().unwrap().samples, 51);
    standstill.forget(4_000_000);
    assert_eq!(standstill.figures(), None);
    standstill.push(u64::MAX, 1);
    standstill.push(0, 2);
    standstill.clear();
    assert_eq!(standstill.figures(), None);
}

#[test]
fn counts_are_arc_seconds() {
    let found = figures(23, &[1, 2, 3]);
    assert!((found.arcseconds(1.0) - 0.154_495).abs() < 1e-6);
}

#[test]
fn noise_is_around_the_angle_and_takes_the_turns_along() {
    for (start, noise) in [(3.0, 2), (2.5, 1), (0.0, 3)] {
        let profile = *decoder("format=rs485 angle-bits=17").profile();
        let mut noisy = Emulator::new(profile, Shaft::still(start)).unwrap();
        noisy.noise = noise;
        let mut seen = vec![0; 2 * noise as usize + 1];
        for at in 0..3_000 {
            let values = noisy.values(at * 1_000);
            assert_eq!(values, noisy.values(at * 1_000));
            // Below zero the turns are those of a counter without a sign.
            let turns = i64::from(values.turns.unwrap() as u16 as i16);
            let position = turns * 131_072 + values.angle.unwrap() as i64;
            let off = position - (start * 131_072.0) as i64;
            seen[(off + i64::from(noise)) as usize] += 1;
        }
        let even = 3_000 / seen.len();
        assert!(seen.iter().all(|count| *count > even / 2), "{seen:?}");
    }
}
