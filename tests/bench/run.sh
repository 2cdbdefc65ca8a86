#!/usr/bin/env bash
# Measures the core, natively and in Chromium, beside what else would read the same bytes.
# With --write the table goes into docs/performance.md.
set -euo pipefail
cd "$(dirname "$0")/../.."
web/build.sh
source web/toolchain.sh
command -v "${CHROMIUM:-chromium}" >/dev/null || apt_get "Chromium, which runs the benches" chromium

construct=2.10.70
at=target/tools/construct
if ! $at/bin/python -c "import construct; assert construct.__version__ == '$construct'" 2>/dev/null; then
  say "installing construct $construct"
  python3 -c 'import ensurepip, venv' 2>/dev/null || apt_get "Python's venv, for construct" python3-venv
  python3 -m venv $at && $at/bin/pip install -q construct==$construct ||
    echo "Not measured: construct, because it could not be installed."
fi
if $at/bin/python -c 'import construct' 2>/dev/null; then export BENCH_PYTHON=$at/bin/python; fi

say "making the input"
megabytes=${BENCH_MEGABYTES:-64}
cargo run -q --release -p encoderscope-tests --bin bench-data -- \
  "target/bench/$megabytes" "$megabytes"

say "measuring"
node tests/bench/bench.js "$@"
