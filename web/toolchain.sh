# Gets what building for the browser needs; source it from the top of the checkout.
# Afterwards `wasm_cargo` is a cargo with the wasm target, and PATH has wasm-bindgen.

say() { printf '\033[1m== %s\033[0m\n' "$*"; }

# Says what the user must do and stops.
need() { printf '%s\n' "encoderscope: $1" "  run: $2" >&2; exit 1; }

as_root() { [ "$(id -u)" = 0 ] || need "$1 is missing and may not be installed without root" "sudo $2"; }

apt_get() { # what for, packages
  local what=$1; shift
  as_root "$what" "apt-get install $*"
  say "installing $*"
  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

command -v cargo >/dev/null || need "cargo is missing" "curl https://sh.rustup.rs -sSf | sh"
node -e 'process.exit(parseInt(process.versions.node) < 20 ? 1 : 0)' 2>/dev/null ||
  need "Node.js 20 or newer is missing" "see https://nodejs.org/en/download"
command -v cc >/dev/null || apt_get "a C linker" gcc libc6-dev

wasm_target=wasm32-unknown-unknown
wasm_target_dir=target

# Debian builds its own Rust for Chromium and Firefox; with its sources the target's library
# can be built where rustup's server cannot be reached.
debian_wasm() {
  local lib=/usr/lib/rustlib/$wasm_target/lib scratch
  if ! ls "$lib"/libstd-*.rlib >/dev/null 2>&1; then
    apt_get "the wasm target (rustup cannot fetch it)" rustc-web cargo-web rust-web-src lld-22
    say "building the standard library for $wasm_target"
    scratch=$(mktemp -d)
    mkdir -p "$scratch/src" "$lib"
    printf '[package]\nname = "empty"\nversion = "0.0.0"\nedition = "2021"\n' >"$scratch/Cargo.toml"
    echo '#![no_std]' >"$scratch/src/lib.rs"
    (cd "$scratch" && PATH=/usr/bin:$PATH RUSTC_BOOTSTRAP=1 /usr/bin/cargo build --release \
      -Zbuild-std=std,panic_abort,panic_unwind,test --target $wasm_target)
    find "$scratch/target/$wasm_target/release/deps" -name '*.rlib' ! -name 'libempty-*' \
      -exec cp {} "$lib" \;
    rm -rf "$scratch"
  fi
  # rustc asks for its linker by this name.
  mkdir -p target/tools/bin
  ln -sf "$(ls /usr/bin/lld-[0-9]* | sort -V | tail -n 1)" target/tools/bin/rust-lld
  wasm_target_dir=target/debian
}

if rustup target list --installed 2>/dev/null | grep -qx $wasm_target ||
  ls "$(rustc --print sysroot)/lib/rustlib/$wasm_target/lib/"libstd-*.rlib >/dev/null 2>&1; then
  :
else
  say "adding the target $wasm_target"
  timeout 120 rustup target add $wasm_target || debian_wasm
fi

# Debian's Rust comes without clippy.
wasm_clippy() {
  if [ $wasm_target_dir = target ]; then
    wasm_cargo clippy "$@"
  else
    echo "Not run: the lints of the page, because Debian's Rust for the browser has no clippy."
  fi
}

# What is built names no directory of the machine that built it, and is shorter for it.
nowhere() {
  local from flags=
  for from in "${CARGO_HOME:-$HOME/.cargo}"/registry/src/*/; do
    flags+="'--remap-path-prefix=$from=',"
  done
  echo "target.$wasm_target.rustflags=[$flags]"
}

wasm_cargo() {
  if [ $wasm_target_dir = target ]; then
    CARGO_BUILD_TARGET=$wasm_target cargo --config "$(nowhere)" "$@"
  else
    # The library built above has no bitcode, which optimising across crates would need.
    PATH=/usr/bin:$PATH CARGO_BUILD_TARGET=$wasm_target CARGO_TARGET_DIR=$wasm_target_dir \
      CARGO_PROFILE_WASM_LTO=off CARGO_PROFILE_SMALL_LTO=off \
      /usr/bin/cargo --config "$(nowhere)" "$@"
  fi
}

bindgen_version=$(grep -A1 '^name = "wasm-bindgen"$' Cargo.lock | sed -n 's/^version = "\(.*\)"/\1/p')
tools=$PWD/target/tools
PATH=$tools/bin:$PATH
if [ "$(wasm-bindgen --version 2>/dev/null)" != "wasm-bindgen $bindgen_version" ]; then
  say "installing wasm-bindgen $bindgen_version (three minutes, once)"
  install_bindgen() { cargo install wasm-bindgen-cli --version "$bindgen_version" --root "$tools" "$@"; }
  # Registries serve some locked dependencies late; then newer ones do.
  install_bindgen --locked || install_bindgen
fi

split_version=0.2.4
if ! wasm-split-cli --help >/dev/null 2>&1 || [ "$(cat "$tools/wasm-split-version" 2>/dev/null)" != $split_version ]; then
  say "installing wasm-split-cli $split_version (a minute, once)"
  install_split() {
    cargo install wasm_split_cli_support --version $split_version --features build-binary --root "$tools" "$@"
  }
  install_split --locked || install_split
  echo $split_version >"$tools/wasm-split-version"
fi

if [ ! -e node_modules/.package-lock.json ] || [ package-lock.json -nt node_modules/.package-lock.json ]; then
  say "installing npm packages"
  npm ci --no-audit --no-fund --loglevel=error &&
    touch node_modules/.package-lock.json
fi
