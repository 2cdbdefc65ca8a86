#!/usr/bin/env bash
# Builds the static site into dist/.
set -euo pipefail
cd "$(dirname "$0")/.."
source web/toolchain.sh

say "building the core and the page"
wasm_cargo build --profile wasm -p encoderscope-web --bins
built=$wasm_target_dir/$wasm_target/wasm

# What rustc and wasm-bindgen emit; more would shut browsers out.
features=(--enable-bulk-memory --enable-multivalue --enable-mutable-globals
  --enable-nontrapping-float-to-int --enable-reference-types --enable-sign-ext)

# One WASM file: its cargo name, the name it is imported by.
bind() {
  local from=$built/$1.wasm to=web/pkg/$2_bg.wasm
  [ "$to" -nt "$from" ] && return
  wasm-bindgen --target web --no-typescript --out-dir web/pkg/new --out-name "$2" "$from"
  npx wasm-opt "${features[@]}" -O3 "web/pkg/new/$2_bg.wasm" -o "web/pkg/new/$2_bg.wasm"
  mv web/pkg/new/* web/pkg
}
mkdir -p web/pkg
bind page page
bind module encoderscope

inputs=(index.html vite.config.js package-lock.json web/pkg web/js web/public web/style web/icon.svg)
if [ ! -e dist/index.html ] || [ -n "$(find "${inputs[@]}" -newer dist/index.html -print -quit)" ]; then
  say "bundling into dist/"
  npx vite build --logLevel warn
  for file in dist/assets/*.wasm; do
    printf '%s: %s bytes, %s with brotli\n' "$file" "$(stat -c %s "$file")" \
      "$(node -e 'process.stdout.write(String(require("zlib").brotliCompressSync(require("fs").readFileSync(process.argv[1])).length))' "$file")"
  done
fi
