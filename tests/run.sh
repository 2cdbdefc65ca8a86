#!/usr/bin/env bash
# Every test there is, in the order in which failures are cheapest to find.
set -euo pipefail
cd "$(dirname "$0")/.."
source web/toolchain.sh

if ! command -v chromium >/dev/null || ! command -v chromedriver >/dev/null; then
  apt_get "Chromium, which runs the tests" chromium chromium-driver
fi
command -v tshark >/dev/null || apt_get "Wireshark, which reads recordings" tshark
command -v python3 >/dev/null || apt_get "Python, which runs the exported decoders" python3
export CHROMEDRIVER=${CHROMEDRIVER:-/usr/bin/chromedriver}

for tool in fmt clippy; do
  cargo $tool --version >/dev/null 2>&1 ||
    need "cargo $tool is missing" "rustup component add rustfmt clippy"
done

say "format"
cargo fmt --check

say "lints"
cargo clippy -q -p encoderscope -p encoderscope-tests --all-targets -- -D warnings
wasm_clippy -q -p encoderscope-web --bins -- -D warnings
wasm_clippy -q -p encoderscope-web --bin element --no-default-features --features element -- -D warnings
RUSTDOCFLAGS="-D warnings" cargo doc -q --no-deps -p encoderscope --features pcapng

say "the core, native"
cargo test -p encoderscope -p encoderscope-tests

say "licences and sources"
node tests/licences.mjs

say "the core, in headless Chromium"
WASM_BINDGEN_TEST_TIMEOUT=600 wasm_cargo test --profile browser -p encoderscope-tests --test core

say "the page"
web/build.sh
node web/single/build.js
cargo build -q -p encoderscope-tests --bin pty-encoder
tests/page/run.sh

# Every fault with a format that is asked and one that streams; `make reliability` takes them
# all, and five minutes of mixed traffic.
say "the page under faults"
tests/reliability/run.sh matrix tabs unplugged -g ': (t485|asi1) |two tabs|write EEPROM'

say "the npm package, the custom element and the documents"
tests/package/run.sh
