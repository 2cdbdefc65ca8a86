#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| encoderscope_tests::fuzz::vcd(data));
