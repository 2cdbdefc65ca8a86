//! What is asked, by the names of links.

use super::{Adapter, Battery, Setup};
use crate::{
    calculator::Fault,
    product::{Interface, Series},
    text,
};
use alloc::vec::Vec;

/// The series and the interface that are entered under `series` and `interface`.
///
/// Without a series it is MPP; without an interface RS485, or the first that the series has.
///
/// # Errors
///
/// Names what is not known.
///
/// ```
/// use encoderscope::{product::{Interface, Series}, wiring::encoder};
/// let chosen = encoder(|name| (name == "series").then_some("ip-75"))?;
/// assert_eq!(chosen, (Series::Ip75, Interface::Asi1));
/// assert!(encoder(|_| Some("IP75")).is_err());
/// # Ok::<(), encoderscope::calculator::Fault>(())
/// ```
pub fn encoder<'a>(
    entered: impl Fn(&str) -> Option<&'a str>,
) -> Result<(Series, Interface), Fault> {
    let series = match entered("series") {
        None => Series::Mpp,
        Some(key) => Series::parse(key)
            .ok_or_else(|| unknown("series", key, &Series::ALL.map(Series::key)))?,
    };
    let interface = match entered("interface") {
        None => usual(series),
        Some(key) => Interface::parse(key)
            .ok_or_else(|| unknown("interface", key, &Interface::ALL.map(Interface::key)))?,
    };
    Ok((series, interface))
}

fn usual(series: Series) -> Interface {
    let all = series.interfaces();
    let wanted = all.iter().find(|known| **known == Interface::Rs485);
    wanted.or(all.first()).copied().unwrap_or(Interface::Rs485)
}

fn unknown(input: &'static str, key: &str, known: &[&str]) -> Fault {
    Fault {
        input,
        message: text!("\"{}\" is none of {}", key, known.join(", ")),
    }
}

impl Setup {
    /// What is entered under `series`, `interface`, `battery` and `adapter`.
    ///
    /// Without an adapter it is the first that fits.
    ///
    /// # Errors
    ///
    /// Names what is not known.
    ///
    /// ```
    /// use encoderscope::wiring::{Adapter, Setup};
    /// let setup = Setup::parse(|name| (name == "interface").then_some("biss-c"))?;
    /// assert_eq!(setup.adapter, Adapter::Master);
    /// # Ok::<(), encoderscope::calculator::Fault>(())
    /// ```
    pub fn parse<'a>(entered: impl Fn(&str) -> Option<&'a str>) -> Result<Self, Fault> {
        let (series, interface) = encoder(&entered)?;
        let battery = match entered("battery") {
            None => Battery::None,
            Some(key) => Battery::parse(key)
                .ok_or_else(|| unknown("battery", key, &Battery::ALL.map(Battery::key)))?,
        };
        let setup = Self {
            series,
            interface,
            battery,
            adapter: Adapter::TwoWire,
        };
        let adapter = match entered("adapter") {
            None => setup.fitting().first().copied().unwrap_or(setup.adapter),
            Some(key) => Adapter::parse(key)
                .ok_or_else(|| unknown("adapter", key, &Adapter::ALL.map(Adapter::key)))?,
        };
        Ok(Self { adapter, ..setup })
    }

    /// The adapters that fit this encoder.
    #[must_use]
    pub fn fitting(self) -> Vec<Adapter> {
        let fits = |adapter: &Adapter| {
            let setup = Self {
                adapter: *adapter,
                ..self
            };
            setup.wire().is_ok()
        };
        Adapter::ALL.into_iter().filter(fits).collect()
    }
}
