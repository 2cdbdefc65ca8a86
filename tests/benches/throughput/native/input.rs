//! What a bench decodes, made when it is first asked for.

use encoderscope_tests::workload::{Sums, Workload};
use std::{cell::OnceCell, env};

/// Where nothing else is said.
const MEGABYTES: f64 = 16.0;

/// The input of a bench; what the core reads in it is checked before it is measured.
pub(crate) struct Input<'w> {
    workload: &'w Workload,
    most: usize,
    bytes: OnceCell<Vec<u8>>,
}

impl<'w> Input<'w> {
    /// So many times as much as usual of a workload.
    pub(crate) fn of(workload: &'w Workload, times: f64) -> Self {
        let said = env::var("BENCH_MEGABYTES").ok();
        let megabytes = said.map_or(MEGABYTES, |said| said.parse().expect("a number"));
        Self {
            workload,
            most: (megabytes * times * 1e6) as usize,
            bytes: OnceCell::new(),
        }
    }

    /// How many bytes there are at most; a frame may be missing.
    pub(crate) fn most(&self) -> u64 {
        self.most as u64
    }

    /// The bytes.
    pub(crate) fn bytes(&self) -> &[u8] {
        self.bytes.get_or_init(|| {
            let (bytes, made) = self.workload.input(self.most);
            let mut read = Sums::default();
            let decoder = self.workload.decoder();
            let mut add = |columns: &_| read.add(columns);
            self.workload.read(&decoder, &bytes, &mut add);
            assert!(
                self.workload.admits(made, read),
                "{}: {made:?} were encoded, {read:?} decoded",
                self.workload.name
            );
            bytes
        })
    }
}
