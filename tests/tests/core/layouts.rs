//! Every layout of every format, at every width that the format allows.

use encoderscope::{
    decode::Decoder,
    format::{Format, Medium, asi4, bus, own::SHIPPED, rs485, ssi_tree, t485},
    layout::{Resolved, Shape},
    profile::{Choice, Dialect, Marker, Parity},
};
use encoderscope_tests::decoder;
use std::sync::LazyLock;

/// A layout and the parameters it comes from.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) layout: Resolved,
}

impl Case {
    /// Whether its frames are bytes, which a sieve judges.
    pub(crate) fn is_bytes(&self) -> bool {
        self.layout.shape.medium() == Medium::Bytes
    }
}

/// All layouts, made once for all tests.
pub(crate) fn layouts() -> &'static [Case] {
    static ALL: LazyLock<Vec<Case>> = LazyLock::new(|| {
        let mut cases = Cases::default();
        for format in Format::ALL.iter().chain(&[Format::Own]) {
            match format {
                Format::Ssi => cases.ssi(),
                Format::BissC => cases.biss_c(),
                Format::Rs485 => cases.rs485(),
                Format::T485 => cases.t485(),
                Format::Bus => cases.bus(),
                Format::Period | Format::As5048 => cases.plain(*format),
                Format::Asi1 => cases.asi1(),
                Format::Asi4 => cases.asi4(),
                Format::Ssi7 => cases.ssi7(),
                Format::SsiTree => cases.ssi_tree(),
                Format::Own => cases.own(),
            }
        }
        cases.0
    });
    &ALL
}

/// The parameters of every angle width of a format with some turns widths, the narrowest and
/// the widest among them.
pub(crate) fn widths(format: Format) -> Vec<String> {
    let limits = format.limits();
    let mut turns = vec![0, 1, 5, 8, 12, 16, limits.turns];
    turns.retain(|turns| *turns <= limits.turns);
    turns.sort_unstable();
    turns.dedup();
    let pairs = (1..=limits.angle).flat_map(|angle| turns.iter().map(move |turns| (angle, turns)));
    pairs
        .filter(|(angle, turns)| angle + *turns <= limits.together)
        .map(|(angle, turns)| {
            format!(
                "format={} angle-bits={angle} turns-bits={turns}",
                format.name()
            )
        })
        .collect()
}

#[derive(Default)]
struct Cases(Vec<Case>);

impl Cases {
    fn push(&mut self, name: String, layout: Resolved) {
        self.0.push(Case { name, layout });
    }

    fn main(&mut self, name: String) {
        let layout = decoder(&name).main_layout().clone();
        self.push(name, layout);
    }

    /// The layout of frames that begin with these bytes.
    fn of(&mut self, name: &str, decoder: &Decoder, bytes: &[u8]) {
        let layout = decoder.layout(bytes).unwrap().clone();
        self.push(format!("{name} {bytes:02x?}"), layout);
    }

    /// The layout of a line with something around the frame.
    fn shaped(&mut self, name: &str, change: impl Fn(&mut Shape)) {
        let decoder = decoder(name);
        let mut shape = Shape::of(*decoder.profile());
        change(&mut shape);
        let layout = Resolved::new(decoder.main_layout().layout, shape);
        self.push(format!("{name} {shape:?}"), layout);
    }

    fn ssi(&mut self) {
        for name in widths(Format::Ssi) {
            self.main(name);
        }
        self.shaped("format=ssi", |shape| (shape.idle, shape.tail) = (3, 5));
        self.shaped("format=ssi", |shape| shape.unused = 7);
    }

    fn biss_c(&mut self) {
        for name in widths(Format::BissC) {
            for more in ["status-bits=0", "", "status-active=low"] {
                self.main(format!("{name} {more}"));
            }
        }
        for status in 0..=8 {
            for active in ["high", "low"] {
                self.main(format!(
                    "format=biss-c status-bits={status} status-active={active}"
                ));
            }
        }
        for ack in [1, 2, 14, 64] {
            self.main(format!("format=biss-c ack-bits={ack}"));
        }
        self.shaped("format=biss-c", |shape| {
            (shape.idle, shape.ack, shape.tail) = (9, 31, 12);
        });
        self.shaped("format=biss-c", |shape| {
            (shape.idle, shape.preamble, shape.tail) = (4, false, 3);
        });
    }

    fn rs485(&mut self) {
        for name in widths(Format::Rs485) {
            for command in rs485::Command::ALL {
                self.main(format!("{name} command={}", command.letter()));
            }
        }
    }

    fn t485(&mut self) {
        for name in widths(Format::T485) {
            let decoder = decoder(&name);
            for request in t485::Request::ALL {
                self.of(&name, &decoder, &[request.byte()]);
            }
        }
        for dialect in Dialect::ALL {
            let name = format!("format=t485 dialect={}", dialect.word());
            let decoder = decoder(&name);
            for request in t485::Request::ALL {
                self.of(&name, &decoder, &[request.byte()]);
                let asked = Resolved::new(request.request(), Shape::of(*decoder.profile()));
                self.push(format!("{name} {request:?} asked"), asked.sieved());
            }
        }
    }

    fn bus(&mut self) {
        for name in widths(Format::Bus) {
            for parity in Parity::ALL {
                let name = format!("{name} parity={}", parity.word());
                let decoder = decoder(&name);
                for operation in bus::Operation::ALL {
                    let byte = bus::request(decoder.profile(), *operation, 0x1f);
                    self.of(&name, &decoder, &[byte]);
                }
            }
        }
    }

    fn plain(&mut self, format: Format) {
        for name in widths(format) {
            self.main(name);
        }
    }

    fn asi1(&mut self) {
        for name in widths(Format::Asi1) {
            for marker in Marker::ALL {
                self.main(format!("{name} marker={}", marker.word()));
            }
        }
    }

    fn asi4(&mut self) {
        for name in widths(Format::Asi4) {
            let decoder = decoder(&name);
            for digits in 1..=asi4::DIGITS {
                let line = format!("{}\r\n", &"12345"[..digits]);
                self.of(&name, &decoder, line.as_bytes());
            }
        }
    }

    fn own(&mut self) {
        for shipped in SHIPPED {
            self.main(format!("format=own layout={}", shipped.name));
        }
    }

    fn ssi7(&mut self) {
        for name in widths(Format::Ssi7) {
            for frame in 24..=30 {
                self.main(format!("{name} frame-bits={frame}"));
            }
        }
        self.shaped("format=ssi7", |shape| shape.unused = 2);
    }

    fn ssi_tree(&mut self) {
        for widths in widths(Format::SsiTree) {
            for code in ["gray", "binary"] {
                for align in ["tree", "right"] {
                    for parity in ["none", "even", "odd"] {
                        let name = format!("{widths} code={code} align={align} parity={parity}");
                        let natural = *decoder(&name).profile();
                        let needed = ssi_tree::needed_bits(&natural);
                        let fixed = [13, 25, 26, 32].into_iter();
                        for frame in fixed.chain([natural.frame_bits, needed]) {
                            if frame >= needed {
                                self.main(format!("{name} frame-bits={frame}"));
                            }
                        }
                    }
                }
            }
        }
        for code in ["gray", "binary"] {
            for (words, parity) in [(2, "none"), (2, "even"), (3, "odd")] {
                for turns in [0, 12] {
                    let name = format!(
                        "format=ssi-tree angle-bits=12 turns-bits={turns} code={code} parity={parity}"
                    );
                    self.shaped(&name, |shape| {
                        (shape.repeats, shape.idle, shape.tail) = (words - 1, 1, 2);
                    });
                }
            }
        }
    }
}
