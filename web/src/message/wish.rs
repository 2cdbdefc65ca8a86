//! What the parts of the page that come when they are wanted say to the engine, and hear from it.

use super::{Digest, Kept, Knobs, RecorderState, Setting, Story, Supply};
use crate::plot::{Plot, PlotRequest, Rest};
use serde::{Deserialize, Serialize};

/// From the page to the engine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Wish {
    /// Speak the language of the texts that come with this; English where none come.
    Speak,
    /// Change the encoder that is being read: begin a sequence.
    Set(Setting),
    /// End the sequence before its next command.
    StopSetting,
    /// Take the outcome of the last sequence off the page.
    ForgetSetting,
    /// Look for every device on the BUS that is being read, then read them all.
    Scan,
    /// Show this device of the BUS on the dial.
    Watch(u8),
    /// Send bytes by hand.
    Send {
        /// The bytes.
        bytes: Vec<u8>,
        /// Whether the user has been asked about those that change an encoder.
        confirmed: bool,
    },
    /// Ask so many times a second from now on; 0 is as fast as the link allows.
    Pace(f64),
    /// Read a cell of the EEPROM (T485, Tamagawa), 0…127.
    ReadMemory(u8),
    /// Switch the supply of the built-in encoder.
    Supply(Supply),
    /// Turn the shaft of the built-in encoder evenly, in revolutions per second.
    Turn(f64),
    /// What the built-in encoder reports, and what goes wrong on its line.
    Knobs(Knobs),
    /// The page wants to plot.
    Plot(PlotRequest),
    /// The page wants to know how much the angle of a shaft at rest varies.
    Rest,
    /// Record from now on.
    Record,
    /// Write the recording into the file beside this, too.
    Copy,
    /// Leave a note in the recording.
    Mark(String),
    /// End the recording.
    StopRecording,
    /// Which recordings are there.
    Recordings,
    /// Give a recording that was cut off its end.
    Settle(String),
    /// Let a recording go.
    Delete(String),
    /// Hand out a recording.
    Fetch(String),
    /// Replay a recording, or the file beside this.
    Replay {
        /// Its name.
        name: String,
        /// The profile, as the parameters of a link, where the recording has none.
        profile: String,
    },
    /// Go on at this speed: 1 is as it was, 0 holds.
    Play(f64),
    /// Go on at this part of the recording, 0…1.
    Seek(f64),
    /// Read two recordings to their end, and say what each comes to.
    Compare([String; 2]),
    /// What happened of late.
    Story,
    /// Make a support file, with this in front.
    Report(String),
}

/// From the engine to the page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// What there is to plot.
    Plot(Box<Plot>),
    /// How much the angle varied within the last second, where anything was read.
    Rest(Option<Box<Rest>>),
    /// The recording or replay that runs.
    Recorder(RecorderState),
    /// The recordings that are there, newest first.
    Recordings(Vec<Kept>),
    /// The file beside this is to be saved under a name.
    File(String),
    /// Something could not be done.
    Fault(String),
    /// What happened of late, newest last.
    Story(Story),
    /// A support file was opened: what stands in front of it.
    Report(String),
    /// What two recordings come to.
    Comparison(Box<[Digest; 2]>),
}
