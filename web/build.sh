#!/usr/bin/env bash
# Builds the static site into dist/.
set -euo pipefail
cd "$(dirname "$0")/.."
source web/toolchain.sh

say "checking the texts of other languages"
node web/locales/build.mjs

say "building the core"
wasm_cargo build --profile wasm -p encoderscope-web --bin module
say "building the page"
# What is split off is found by the relocations.
wasm_cargo rustc --profile small -p encoderscope-web --bin page -- -Clink-args=--emit-relocs
say "building the custom element"
wasm_cargo build --profile small -p encoderscope-web --bin element --no-default-features --features element

# What rustc and wasm-bindgen emit; more would shut browsers out.
features=(--enable-bulk-memory --enable-multivalue --enable-mutable-globals
  --enable-nontrapping-float-to-int --enable-reference-types --enable-sign-ext)
# Control flow made anew from scratch comes out smaller.
smallest=(--strip-producers --flatten --rereloop -Oz -Oz -Oz)

# One WASM file: its cargo profile and name, the name it is imported by, how it is optimised.
bind() {
  local from=$wasm_target_dir/$wasm_target/$1.wasm to=web/pkg/$2_bg.wasm
  [ "$to" -nt "$from" ] && return
  wasm-bindgen --target web --no-typescript --out-dir web/pkg/new --out-name "$2" "$from"
  npx wasm-opt "${features[@]}" "${@:3}" "web/pkg/new/$2_bg.wasm" -o "web/pkg/new/$2_bg.wasm"
  mv web/pkg/new/* web/pkg
}
# The page: its first WASM file, and one for each part that comes when it is wanted.
bind_page() {
  local from=$wasm_target_dir/$wasm_target/small/page.wasm to=web/pkg/page new=web/pkg/new/page file
  [ "$to/page_bg.wasm" -nt "$from" ] && return
  rm -rf $to $new && mkdir -p $new
  wasm-split-cli "$from" $new --target web --out-name page
  wasm-bindgen --target web --no-typescript --keep-lld-exports --out-dir $new --out-name page $new/page.wasm
  rm $new/page.wasm
  for file in $new/*.wasm; do
    npx wasm-opt "${features[@]}" "${smallest[@]}" "$file" -o "$file"
  done
  mv $new $to
}
mkdir -p web/pkg
bind_page
bind wasm/module encoderscope -O3
bind small/element encoder-frame "${smallest[@]}"

# Whether one of the paths is newer than the file, or there is no such file.
outdated() { # file, paths
  local file=$1; shift
  [ ! -e "$file" ] || [ -n "$(find "$@" -newer "$file" -print -quit)" ]
}

brotli() {
  node -e 'process.stdout.write(String(require("zlib").brotliCompressSync(require("fs").readFileSync(process.argv[1])).length))' "$1"
}

sources=(package-lock.json web/pkg/ru.json web/pkg/*.js web/pkg/*.wasm web/pkg/page web/js web/public web/style)
npm=web/pkg/npm
if outdated $npm/encoder-frame.js web/modules.config.js "${sources[@]}"; then
  say "bundling the modules"
  npx vite build --config web/modules.config.js --logLevel warn
fi

# Whether so many bytes, with brotli, are within the limit.
budget() { # what, bytes, limit
  printf '%s: %s bytes with brotli, of at most %s\n' "$1" "$2" "$3"
  [ "$2" -le "$3" ] && return
  echo "That is too much." >&2
  # Debian's Rust does not optimise across crates.
  [ $wasm_target_dir != target ] || exit 1
}

sum() { # files
  local file total=0
  for file in "$@"; do total=$((total + $(brotli "$file"))); done
  echo $total
}

if outdated dist/index.html index.html vite.config.js web/icon.svg web/icons $npm "${sources[@]}"; then
  say "bundling into dist/"
  npx vite build --logLevel warn
fi

# Every page of a document that shows a frame waits for the element, and every visitor for the
# first view: what the page names, the WASM that its script asks for at once among it.
budget "the custom element" "$(sum dist/encoder-frame.js dist/encoder-frame_bg.wasm)" 60000
mapfile -t first < <({ echo index.html; grep -o 'assets/[^"]*' dist/index.html; cd dist; ls assets/page_bg-*.wasm; } | sort -u)
budget "the console's first visit" "$(sum "${first[@]/#/dist/}")" 150000
