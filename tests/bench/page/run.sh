#!/usr/bin/env bash
# Measures the page in Chromium: at a port, with large files, on its first visit.
# With --write the table goes into docs/performance.md.
set -euo pipefail
cd "$(dirname "$0")/../../.."
web/build.sh
source web/toolchain.sh
command -v "${CHROMIUM:-chromium}" >/dev/null || apt_get "Chromium, which runs the benches" chromium
cargo build -q --release -p encoderscope-tests --bin pty-encoder

say "measuring the page"
PAGE_CONFIG=tests/bench/page/playwright.config.js PTY_ENCODER=$PWD/target/release/pty-encoder tests/page/run.sh
node tests/bench/page/table.js "$@"
