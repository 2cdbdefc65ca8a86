use super::{Input, check_record};
use encoderscope::{
    decode::{Decoded, Decoder},
    detect::{self, Candidate, Verdict},
    dump, link,
};
use std::collections::BTreeSet;

/// More candidates help nobody.
const MOST: usize = 24;

/// Arbitrary text.
///
/// # Panics
///
/// A law is broken: a candidate cannot be used, gives no reason, is surer than the one in front of
/// it, or is certain though few of its frames hold.
pub fn detect(data: &[u8]) {
    let text = Input(data).text();
    let found = detect::detect(&text);
    assert!(found.len() <= MOST);
    for (index, candidate) in found.iter().enumerate() {
        check_candidate(candidate);
        let same = |other: &Candidate| {
            (other.profile, other.change) == (candidate.profile, candidate.change)
        };
        assert!(!found[..index].iter().any(same), "{candidate:?} twice");
        if candidate.verdict == Verdict::Certain {
            check_certain(candidate, &text);
        }
    }
    let sureness = found.iter().map(|candidate| sure(candidate.verdict));
    let first = found.first().map(|candidate| sure(candidate.verdict));
    assert_eq!(sureness.max(), first, "{found:?}");
    let any = |verdict| found.iter().any(|candidate| candidate.verdict == verdict);
    assert!(
        !(any(Verdict::Certain) && any(Verdict::Ambiguous)),
        "{found:?}"
    );
    // To do it all again takes as long.
    if data.len().is_multiple_of(8) {
        assert_eq!(detect::detect(&text), found);
    }
}

const fn sure(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Certain => 3,
        Verdict::Likely => 2,
        Verdict::Ambiguous => 1,
        Verdict::Unlikely => 0,
    }
}

/// A candidate can be used, written down, and says why in sentences.
fn check_candidate(candidate: &Candidate) {
    assert!(Decoder::new(candidate.profile).is_ok(), "{candidate:?}");
    let query = link::query(&candidate.profile);
    let again = link::profile(&query).expect("what was written");
    assert_eq!(again.parameters(), candidate.profile.parameters());
    let said: BTreeSet<&String> = candidate.evidence.iter().collect();
    assert!(
        !said.is_empty() && said.len() == candidate.evidence.len(),
        "{candidate:?}"
    );
    assert!(
        said.iter().all(|sentence| sentence.len() > 8),
        "{candidate:?}"
    );
    check_record(&candidate.record().into());
    assert!(candidate.record().to_string().len() > 2);
}

/// What is certain needs no change, and more of it are different good frames than bad ones.
fn check_certain(candidate: &Candidate, text: &str) {
    assert_eq!(candidate.change, None);
    let decoder = Decoder::new(candidate.profile).expect("a profile that fits");
    let mut good = BTreeSet::new();
    let mut bad = 0;
    let text = dump::parse(text, candidate.profile.medium());
    decoder.dump(&text, &mut |decoded| match decoded {
        Decoded::Frame(frame) if frame.ok() => {
            good.insert(frame.bits.bytes().to_vec());
        }
        Decoded::Frame(_) => bad += 1,
        Decoded::Skip { .. } => {}
    });
    assert!(
        good.len() > 1 && bad <= 2 * good.len(),
        "{} good, {bad} bad: {candidate:?}",
        good.len()
    );
}
