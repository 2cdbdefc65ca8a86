#!/usr/bin/env bash
# The npm package as a stranger installs it, the custom element in bare pages, the documents that
# use it, and the benches in short.
set -euo pipefail
cd "$(dirname "$0")/../.."
web/package.sh
source web/toolchain.sh

# What cannot be built for want of a tool is left out, though not in CI.
missing=
for what in book sphinx; do
  status=0
  docs/build.sh $what || status=$?
  case $status in
    0) ;;
    77)
      echo "Not run: the tests of docs/$what, because its tool is missing."
      [ "${CI:-}" != true ] || exit 1
      missing=$missing${missing:+|}@$what
      ;;
    *) exit $status ;;
  esac
done

PROJECT=$(mktemp -d)
trap 'rm -rf "$PROJECT"' EXIT
export PROJECT
cp tests/package/site/* "$PROJECT"
tarball=$(ls "$PWD"/target/package/encoderscope-*.tgz)
version=${tarball##*-}

say "the npm package, in Node"
(cd "$PROJECT" && npm install --offline --no-audit --no-fund --loglevel=error "$tarball")
(cd "$PROJECT" && VERSION=${version%.tgz} node --test)

say "its types"
npx tsc -p "$PROJECT"

say "the custom element, in Chromium"
npx playwright test --config tests/package/playwright.config.js ${missing:+--grep-invert "$missing"} "$@"

say "the benches, in short"
BENCH_MEGABYTES=0.5 BENCH_ROUNDS=1 BENCH_SECONDS=0.05 tests/bench/run.sh | tee "$PROJECT/bench"
for row in period t485 asi1 biss-c; do grep -q "^| \`$row\`" "$PROJECT/bench"; done
