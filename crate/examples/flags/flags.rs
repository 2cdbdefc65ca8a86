//! The flags of a command line: `--name value`, `--name=value`, and switches without a value.

/// What a command line says.
pub(crate) struct Flags {
    /// Names and values.
    pub(crate) pairs: Vec<(String, String)>,
    /// Names of the switches that are set.
    pub(crate) switches: Vec<String>,
}

impl Flags {
    /// Reads the words of this program's command line; those of `switches` have no value.
    pub(crate) fn read(switches: &[&str]) -> Result<Self, String> {
        let mut flags = Self {
            pairs: Vec::new(),
            switches: Vec::new(),
        };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            let name = word
                .strip_prefix("--")
                .ok_or_else(|| format!("{word:?} is no option; write --name value"))?;
            if switches.contains(&name) {
                flags.switches.push(name.to_owned());
                continue;
            }
            let (name, value) = match name.split_once('=') {
                Some((name, value)) => (name.to_owned(), value.to_owned()),
                None => {
                    let value = words
                        .next()
                        .ok_or_else(|| format!("--{name} needs a value"))?;
                    (name.to_owned(), value)
                }
            };
            flags.pairs.push((name, value));
        }
        Ok(flags)
    }

    /// Whether a switch is set.
    pub(crate) fn has(&self, switch: &str) -> bool {
        self.switches.iter().any(|known| known == switch)
    }

    /// The pairs as a profile takes them.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        let pairs = self.pairs.iter();
        pairs.map(|(name, value)| (name.as_str(), value.as_str()))
    }
}
