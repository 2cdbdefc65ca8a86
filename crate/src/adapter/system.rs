//! What a computer's drivers need before they serve an encoder well.

use crate::language::t;

/// An operating system with a browser that has Web Serial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum System {
    /// Windows.
    Windows,
    /// Linux.
    Linux,
    /// macOS.
    MacOs,
    /// `ChromeOS`.
    ChromeOs,
}

impl System {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Windows, Self::Linux, Self::MacOs, Self::ChromeOs];

    /// Its name in links.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Windows => "windows",
            Self::Linux => "linux",
            Self::MacOs => "macos",
            Self::ChromeOs => "chromeos",
        }
    }

    /// Its name for people.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Windows => "Windows",
            Self::Linux => "Linux",
            Self::MacOs => "macOS",
            Self::ChromeOs => "ChromeOS",
        }
    }

    /// The system of a name in links.
    ///
    /// ```
    /// use encoderscope::adapter::System;
    /// assert_eq!(System::parse("linux"), Some(System::Linux));
    /// ```
    #[must_use]
    pub fn parse(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|system| system.key() == key)
    }

    /// How the latency timer of an FTDI adapter is set to its least (FTDI AN232B-04; the sysfs of
    /// Linux `ftdi_sio`; FTDI TN_105).
    #[must_use]
    pub fn latency(self) -> &'static str {
        match self {
            Self::Windows => t(
                "Device Manager, Ports, the adapter's properties, Port Settings, Advanced: \
                 Latency Timer 1 ms. It is kept for this adapter.",
            ),
            Self::Linux => t(
                "echo 1 | sudo tee /sys/bus/usb-serial/devices/ttyUSB0/latency_timer, which \
                 lasts until the adapter is unplugged; for good, a udev rule: \
                 ACTION==\"add\", SUBSYSTEM==\"usb-serial\", DRIVER==\"ftdi_sio\", \
                 ATTR{latency_timer}=\"1\"",
            ),
            Self::MacOs => t(
                "Apple's own driver has no setting; FTDI's driver takes LatencyTimer from its \
                 Info.plist, which newer systems protect. Ask for fewer replies a second, or use \
                 an encoder that streams (PERIOD).",
            ),
            Self::ChromeOs => t(
                "There is no setting. Ask for fewer replies a second, or use an encoder that \
                 streams (PERIOD).",
            ),
        }
    }

    /// What must be allowed before the browser can open a port.
    #[must_use]
    pub fn permission(self) -> &'static str {
        match self {
            Self::Windows => t(
                "Nothing. A port that another program holds cannot be opened: close terminals \
                 and the encoder's own tool.",
            ),
            Self::Linux => t(
                "Your user must be in the group of the port: sudo usermod -aG dialout $USER \
                 (Debian, Ubuntu, Fedora) or -aG uucp (Arch), then log in again. A browser from a \
                 snap or flatpak may be kept from USB: use the distribution's or Google's \
                 package. If the port vanishes right after plugging in, brltty has taken it for a \
                 braille display: sudo systemctl mask brltty-udev brltty. If strange bytes go out \
                 at first, ModemManager is probing: sudo systemctl disable --now ModemManager.",
            ),
            Self::MacOs => t(
                "Nothing for FTDI and CP210x; CH34x and PL2303 may want their maker's driver, \
                 which is allowed under Privacy & Security.",
            ),
            Self::ChromeOs => t(
                "Nothing; on a managed device the administrator's policy for serial ports decides.",
            ),
        }
    }
}
