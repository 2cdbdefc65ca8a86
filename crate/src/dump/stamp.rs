//! Times in front of the lines of a log.

/// A time at the start of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stamp {
    /// Where what follows it begins.
    pub(super) end: usize,
    /// Seconds, of the day where it is a clock.
    pub(super) seconds: f64,
    /// The day, counted from some day, where there is a date.
    pub(super) day: Option<i64>,
    /// Whether it cannot be bytes.
    pub(super) strong: bool,
}

/// Reads a time at the start of `line`, which begins with no blank.
pub(super) fn read(line: &[u8]) -> Option<Stamp> {
    let mut scan = Scan { line, at: 0 };
    let open = scan.one_of(b"[(");
    scan.blanks();
    let day = scan.date();
    let clock = scan.clock();
    let (seconds, strong) = match clock {
        Some((seconds, fraction)) => (seconds, fraction || open.is_some() || day.is_some()),
        None if day.is_some() => (0.0, true),
        None => scan.number(open.is_some())?,
    };
    match open {
        Some(open) => {
            scan.blanks();
            scan.one_of(if open == b'[' { b"]" } else { b")" })?;
        }
        None => {
            // More digits behind the next colon make it bytes.
            let next = scan.peek(0);
            let ends = next.is_none_or(|next| b" \t,;|-]><".contains(&next));
            let colon =
                next == Some(b':') && scan.peek(1).is_none_or(|after| !after.is_ascii_hexdigit());
            if !ends && !colon {
                return None;
            }
        }
    }
    scan.blanks();
    if scan.one_of(b":,;|").is_some() || (scan.peek(0) == Some(b'-') && scan.peek(1) == Some(b' '))
    {
        scan.one_of(b"-");
        scan.blanks();
    }
    Some(Stamp {
        end: scan.at,
        seconds,
        day,
        strong,
    })
}

struct Scan<'a> {
    line: &'a [u8],
    at: usize,
}

impl Scan<'_> {
    fn peek(&self, ahead: usize) -> Option<u8> {
        self.line.get(self.at + ahead).copied()
    }

    fn one_of(&mut self, letters: &[u8]) -> Option<u8> {
        let found = self.peek(0).filter(|next| letters.contains(next))?;
        self.at += 1;
        Some(found)
    }

    fn blanks(&mut self) {
        while self.one_of(b" \t").is_some() {}
    }

    /// A number of `least` to `most` digits.
    fn digits(&mut self, least: usize, most: usize) -> Option<u64> {
        let rest = self.line.get(self.at..)?;
        let count = rest
            .iter()
            .take_while(|digit| digit.is_ascii_digit())
            .count();
        if !(least..=most).contains(&count) {
            return None;
        }
        let number = rest[..count].iter();
        self.at += count;
        Some(number.fold(0, |number, digit| number * 10 + u64::from(digit - b'0')))
    }

    /// What stands behind a decimal point, and how many digits it has.
    fn fraction(&mut self) -> Option<f64> {
        let start = self.at;
        let digits = self.digits(1, 12)?;
        let count = (self.at - start) as i32;
        let scale = (0..count).fold(1.0, |scale, _| scale * 10.0);
        Some(digits as f64 / scale)
    }

    /// `2024-05-06`, `2024/05/06`, `06.05.2024` or `5/6/2024`.
    fn date(&mut self) -> Option<i64> {
        let start = self.at;
        let day = self.date_here();
        match day {
            Some(_) => while self.one_of(b" ,T_\t").is_some() {},
            None => self.at = start,
        }
        day
    }

    fn date_here(&mut self) -> Option<i64> {
        let first = self.digits(1, 4)?;
        let between = self.one_of(b"-/.")?;
        let second = self.digits(1, 2)?;
        self.one_of(&[between])?;
        let third = self.digits(1, 4)?;
        let (year, month, day) = match (first, between, third) {
            (1900.., _, 1..=31) => (first, second, third),
            (_, b'/', 1900..) => (third, first, second),
            (_, _, 1900..) => (third, second, first),
            _ => return None,
        };
        let fits = (1..=12).contains(&month) && (1..=31).contains(&day);
        fits.then(|| day_number(year as i64, month as i64, day as i64))
    }

    /// `12:00:01.234` and how it may be shortened: its seconds, and whether it has a fraction.
    fn clock(&mut self) -> Option<(f64, bool)> {
        let start = self.at;
        let clock = self.clock_here();
        if clock.is_none() {
            self.at = start;
        }
        clock
    }

    fn clock_here(&mut self) -> Option<(f64, bool)> {
        let hours = self.digits(1, 2).filter(|hours| *hours < 24)?;
        self.one_of(b":")?;
        let minutes = self.digits(2, 2).filter(|minutes| *minutes < 60)?;
        self.one_of(b":")?;
        let seconds = self.digits(2, 2).filter(|seconds| *seconds < 61)?;
        let mut whole = (hours * 3600 + minutes * 60 + seconds) as f64;
        let mut strong = false;
        let start = self.at;
        if let Some(point) = self.one_of(b".,:") {
            let least = if point == b'.' { 1 } else { 3 };
            match self.fraction().filter(|_| self.at - start > least) {
                Some(fraction) => {
                    whole += fraction;
                    strong = true;
                }
                None => self.at = start,
            }
        }
        self.one_of(b"Z");
        let half = self
            .line
            .get(self.at..)
            .and_then(|rest| rest.first_chunk::<3>());
        if let Some(half) =
            half.filter(|half| half[0] == b' ' && half[2].eq_ignore_ascii_case(&b'm'))
        {
            let noon = 12.0 * 3600.0;
            match half[1].to_ascii_lowercase() {
                b'p' if hours < 12 => whole += noon,
                b'a' if hours == 12 => whole -= noon,
                b'a' | b'p' => {}
                _ => return Some((whole, strong)),
            }
            strong = true;
            self.at += 3;
        }
        Some((whole, strong))
    }

    /// `0.001234`, `1234.567 ms`, in brackets also `1234`; whether it cannot be bytes.
    fn number(&mut self, bracketed: bool) -> Option<(f64, bool)> {
        let negative = self.one_of(b"+-") == Some(b'-');
        let mut number = self.digits(1, 12)? as f64;
        let start = self.at;
        let mut strong = false;
        if let Some(point) = self.one_of(b".,") {
            let fraction = self.fraction();
            let fits = self.at - start > if point == b'.' { 1 } else { 3 };
            match fraction.filter(|_| fits) {
                Some(fraction) => {
                    number += fraction;
                    strong = true;
                }
                None => self.at = start,
            }
        }
        let unit = self.unit();
        number *= unit.unwrap_or(1.0);
        strong |= unit.is_some();
        (strong || bracketed).then_some((if negative { -number } else { number }, strong))
    }

    /// How many seconds the unit at hand has.
    fn unit(&mut self) -> Option<f64> {
        let start = self.at;
        self.blanks();
        let rest = self.line.get(self.at..).unwrap_or_default();
        let units: [(&[u8], f64); 8] = [
            (b"sec", 1.0),
            (b"ms", 1e-3),
            (b"us", 1e-6),
            ("µs".as_bytes(), 1e-6),
            ("μs".as_bytes(), 1e-6),
            (b"ns", 1e-9),
            (b"s", 1.0),
            (b"S", 1.0),
        ];
        for (name, seconds) in units {
            let after = rest.get(name.len());
            if rest.starts_with(name) && after.is_none_or(|after| !after.is_ascii_alphanumeric()) {
                self.at += name.len();
                return Some(seconds);
            }
        }
        self.at = start;
        None
    }
}

/// Days since 1 March of the year 0, in the Gregorian calendar.
const fn day_number(year: i64, month: i64, day: i64) -> i64 {
    // The year begins in March, so that the leap day is its last.
    let (year, month) = if month > 2 {
        (year, month - 3)
    } else {
        (year - 1, month + 9)
    };
    365 * year + year / 4 - year / 100 + year / 400 + (153 * month + 2) / 5 + day
}
