use super::{Input, check_record};
use encoderscope::{
    decode::Decoder,
    detect::{self, Verdict},
};

/// Arbitrary text.
///
/// # Panics
///
/// A law is broken: a candidate cannot be used, gives no reason, or is not alone in being certain.
pub fn detect(data: &[u8]) {
    let text = Input(data).text();
    let found = detect::detect(&text);
    for candidate in &found {
        assert!(Decoder::new(candidate.profile).is_ok(), "{candidate:?}");
        assert!(!candidate.evidence.is_empty());
        check_record(&candidate.record().into());
        assert!(candidate.record().to_string().len() > 2);
    }
    let certain = |verdict: Verdict| verdict == Verdict::Certain;
    let ambiguous = |verdict: Verdict| verdict == Verdict::Ambiguous;
    let any = |is: fn(Verdict) -> bool| found.iter().any(|candidate| is(candidate.verdict));
    assert!(!(any(certain) && any(ambiguous)), "{found:?}");
}
