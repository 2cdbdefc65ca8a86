#![allow(missing_docs)]
use encoderscope::{decode::Decoder, export::*, profile::Profile};
fn main() {
    for f in [
        "t485", "rs485", "biss-c", "asi1", "ssi-tree", "asi4", "bus", "ssi7", "ssi",
    ] {
        let d = Decoder::new(Profile::parse([("format", f)]).unwrap()).unwrap();
        for l in Language::ALL {
            std::fs::write(
                format!("/tmp/exp_out/{}.{}", f.replace('-', "_"), l.extension()),
                source(&d, *l),
            )
            .unwrap();
        }
    }
}
