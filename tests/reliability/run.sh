#!/usr/bin/env bash
# Reads every format under every fault; what is given is passed on to Playwright. With WRITE=1 the
# tables of docs/reliability.md are written anew, from what this run and earlier ones have measured.
set -euo pipefail
cd "$(dirname "$0")/../.."
[ -n "${PTY_ENCODER:-}" ] || cargo build -q -p encoderscope-tests --bin pty-encoder
PAGE_CONFIG=tests/reliability/playwright.config.js tests/page/run.sh "$@"
[ -z "${WRITE:-}" ] || node tests/reliability/table.js
