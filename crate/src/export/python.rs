//! Rust.
use super::plan::{Plan, Reach};
use crate::check::Algorithm;
use alloc::{string::String, vec::Vec};
pub(super) fn source(_plan: &Plan<'_>) -> String { String::new() }
pub(super) fn crc(_crc: &Algorithm, _reach: Reach) -> Vec<String> { Vec::new() }
