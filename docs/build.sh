#!/usr/bin/env bash
# Builds the documents into target/docs/: `book` with mdBook, `sphinx` with Sphinx, or both.
# Ends with 77 where the tool for it cannot be installed.
set -euo pipefail
cd "$(dirname "$0")/.."
[ -e dist/encoder-frame.js ] || web/build.sh
source web/toolchain.sh

mdbook=0.5.4
sphinx=8.1.3

lacks() { # what, how to get it
  printf '%s\n' "encoderscope: $1 is missing and could not be installed" "  run: $2" >&2
  exit 77
}

book() {
  if [ "$(target/tools/bin/mdbook --version 2>/dev/null)" != "mdbook v$mdbook" ]; then
    say "installing mdBook $mdbook (minutes, once)"
    local get=(cargo install mdbook --version $mdbook --no-default-features --root target/tools)
    "${get[@]}" --locked || "${get[@]}" || lacks "mdBook $mdbook" "${get[*]}"
  fi
  say "building docs/book"
  target/tools/bin/mdbook build docs/book
  # The chapters ask for them beside themselves, and documents for pictures where they stand.
  cp dist/encoder-frame.js dist/encoder-frame_bg.wasm target/docs/book
  mkdir -p target/docs/book/docs
  cp -r docs/pictures target/docs/book/docs
  cp docs/growth.svg target/docs/book
}

sphinx() {
  local at=target/tools/sphinx
  if [ "$($at/bin/sphinx-build --version 2>/dev/null)" != "sphinx-build $sphinx" ]; then
    say "installing Sphinx $sphinx"
    python3 -c 'import ensurepip, venv' 2>/dev/null || apt_get "Python's venv, for Sphinx" python3-venv
    { python3 -m venv --clear $at && $at/bin/pip install -q sphinx==$sphinx; } ||
      lacks "Sphinx $sphinx" "python3 -m venv $at && $at/bin/pip install sphinx==$sphinx"
  fi
  say "building docs/sphinx"
  $at/bin/sphinx-build -q -W --fresh-env -b html docs/sphinx target/docs/sphinx
}

[ $# -gt 0 ] || set -- book sphinx
for what in "$@"; do $what; done
