//! Sizes and characteristics of the products.
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::{
    model::parse,
    product::{
        Series,
        facts::{CURRENT, FACTS, SUPPLY, TEMPERATURE},
        sizes::{Mount, SIZES},
    },
};

#[test]
fn the_size_tables_keep_the_manuals_proportions() {
    let of = |series| SIZES.iter().filter(move |size| size.series == series);
    assert_eq!((of(Series::Mpp).count(), of(Series::Pt).count()), (7, 28));
    for size in SIZES {
        let name = size.name();
        let (rotor, stator) = (
            f64::from(size.rotor_diameter()),
            f64::from(size.stator_diameter()),
        );
        // Every row of both tables has its stator's screws on a circle 3.4 mm smaller.
        assert!((stator - size.stator_circle - 3.4).abs() < 1e-9, "{name}");
        match (size.series, size.mount) {
            (Series::Mpp, Mount::Screws(circle)) => {
                assert!((circle - rotor - 3.1).abs() < 1e-9, "{name}");
                assert_eq!(stator - rotor, 20.0, "{name}");
            }
            (Series::Pt, Mount::Thread(thread, bore)) => {
                assert_eq!(thread, format!("M{rotor} × 0.4 mm"), "{name}");
                assert_eq!(bore, rotor - 1.0, "{name}");
                assert!(!size.rotor.ends_with('B'), "{name}");
            }
            (Series::Pt, Mount::Bonded(a, b, c)) => {
                assert_eq!((a, b), (rotor - 1.0, rotor), "{name}");
                assert!((c - rotor - 2.6).abs() < 1e-9, "{name}");
                assert!(size.rotor.ends_with('B'), "{name}");
            }
            (series, mount) => panic!("{series:?} {mount:?}"),
        }
        assert_eq!(size.is_back_mounted(), name.ends_with('H'), "{name}");
    }
    let printed: Vec<_> = SIZES
        .iter()
        .filter_map(|size| Some((size.name(), size.thickness?)))
        .collect();
    let expected = [("MPP-40-60", 5.6), ("MPP-60-80", 6.7), ("PT-20B-30", 6.7)];
    let expected = expected.map(|(name, thickness)| (name.to_owned(), thickness));
    assert_eq!(printed, expected);
}

#[test]
fn every_characteristic_is_said_once_and_has_its_source() {
    for series in Series::ALL {
        for fact in series.facts() {
            let same = series.facts().filter(|other| other.name == fact.name);
            assert_eq!(same.count(), 1, "{series:?} {}", fact.name);
        }
        for name in [SUPPLY, TEMPERATURE, "accuracy", "greatest speed"] {
            assert!(series.fact(name).is_some(), "{series:?} {name}");
        }
    }
    for fact in FACTS {
        assert!(
            !fact.series.is_empty() && !fact.value.is_empty(),
            "{fact:?}"
        );
        let manuals = ["MPP", "PT", "IP-75", "P+F article"];
        let from = |manual: &&str| fact.source.starts_with(*manual) && fact.source.contains(", ");
        assert!(manuals.iter().any(from), "{fact:?}");
    }
    assert_eq!(Series::Mpp.fact(CURRENT).unwrap().value, "≈ 60 mA");
    assert_eq!(Series::Pt.fact(CURRENT).unwrap().value, "≈ 100 mA");
}

#[test]
fn the_temperature_of_a_model_is_that_of_the_manual() {
    for (code, series) in [
        ("IP-75-ASI1", Series::Ip75),
        ("AVM58", Series::Avm58),
        ("ASS58-H", Series::Ass58),
    ] {
        let (least, most) = parse(code).unwrap().temperature().unwrap();
        let said = format!("−{}…+{most} °C", -least);
        assert_eq!(series.fact(TEMPERATURE).unwrap().value, said);
    }
}
