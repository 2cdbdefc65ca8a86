#!/usr/bin/env bash
# Reads the emulated encoder for so many seconds with mixed traffic and faults, and tells of it
# every minute. SOAK_SEED repeats a run; with WRITE=1 its summary goes into docs/reliability.md.
set -euo pipefail
cd "$(dirname "$0")/../.."
export SOAK_SECONDS=${1:-3600}
tests/reliability/run.sh soak
