//! Reading a stream into columns that are cleared and used again allocates nothing.
#![cfg(not(target_arch = "wasm32"))]

use encoderscope::{
    columns::Columns,
    decode::{Decoder, Words},
    framing::Framer,
    reading::Values,
};
use encoderscope_tests::{Noise, decoder, disturbed};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

/// The system's allocator, which counts what each thread asks it for.
struct Counting;

thread_local! {
    static ASKED: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // At the end of a thread its cell is gone before its last allocation.
    let _ = ASKED.try_with(|asked| asked.set(asked.get() + 1));
}

// SAFETY: everything is left to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        unsafe { System.dealloc(place, layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(place, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

const CHUNK: usize = 65_536;
const BYTES: usize = 4 * CHUNK + 1_000;

/// A shaft that turns.
fn stream(decoder: &Decoder) -> Vec<u8> {
    let width = decoder.profile().angle_bits as i32;
    let mut bytes = Vec::new();
    for index in 0u32.. {
        let position = 300.3 + f64::from(index) * 0.000_37;
        let values = Values {
            turns: Some(position as i64),
            angle: Some((position.fract() * 2f64.powi(width)) as u64),
            ..Values::default()
        };
        bytes.extend(decoder.encode(&values).into_bytes());
        if bytes.len() >= BYTES {
            break;
        }
    }
    bytes
}

/// Allocations while `read` reads a stream for the second time.
fn allocations(mut read: impl FnMut() -> usize) -> u64 {
    let first = read();
    assert!(first > 1_000, "{first}");
    let before = ASKED.get();
    let second = read();
    let after = ASKED.get();
    // The last frames of the first time are only reported in the second.
    assert!(second.abs_diff(first) <= 20, "{first} and {second}");
    after - before
}

#[test]
fn the_counter_counts() {
    let before = ASKED.get();
    let room: Vec<u8> = std::hint::black_box(Vec::with_capacity(10));
    assert_eq!((room.len(), ASKED.get() - before), (0, 1));
}

#[test]
fn framing_a_stream_allocates_nothing() {
    for parameters in [
        "format=period",
        "format=rs485",
        "format=rs485 command=1 turns-bits=0",
        "format=rs485 command=t",
        "format=t485",
        "format=t485 angle-bits=17",
        "format=bus",
        "format=asi1",
        "format=asi4",
    ] {
        for per_thousand in [0, 1, 10] {
            let decoder = decoder(parameters);
            let clean = stream(&decoder);
            let bytes = disturbed(&clean, per_thousand, &mut Noise::new(11));
            let mut framer = Framer::at_start();
            let mut columns = Columns::default();
            let found = allocations(|| {
                let mut readings = 0;
                for chunk in bytes.chunks(CHUNK) {
                    framer.push_runs(&decoder, chunk, &mut |run| columns.take(&run));
                    readings += columns.len();
                    columns.clear();
                }
                readings
            });
            assert_eq!(found, 0, "{parameters}, {per_thousand} in 1000");
        }
    }
}

#[test]
fn reading_equal_lines_allocates_nothing() {
    for parameters in ["format=biss-c", "format=ssi angle-bits=17", "format=ssi7"] {
        let decoder = decoder(parameters);
        let bytes = stream(&decoder);
        let mut words = Words::new(&decoder, decoder.main_layout().len, &bytes);
        let mut columns = Columns::default();
        let found = allocations(|| {
            let mut readings = 0;
            for chunk in bytes.chunks(CHUNK) {
                words.push_runs(&decoder, chunk, &mut |run| columns.take(&run));
                readings += columns.len();
                columns.clear();
            }
            readings
        });
        assert_eq!(found, 0, "{parameters}");
    }
}
