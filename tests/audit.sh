#!/usr/bin/env bash
# Asks the advisory databases about every dependency: RustSec through cargo-deny or cargo-audit,
# and npm's. Ends with 0 only where both have answered and know of nothing, with 1 where something
# is known, with 2 where one could not be asked.
set -uo pipefail
cd "$(dirname "$0")/.."

known=0
unasked=0
say() { printf '\033[1m== %s\033[0m\n' "$*"; }
not_asked() { echo "Not checked: $1"; unasked=1; }

say "Rust"
if cargo deny --version >/dev/null 2>&1; then
  if cargo deny fetch db; then
    cargo deny --offline check || known=1
  else
    not_asked "the RustSec database cannot be reached."
  fi
elif cargo audit --version >/dev/null 2>&1; then
  # It has no other way to tell a database that is away from one that knows something.
  said=$(cargo audit --json 2>/dev/null)
  case $(node -pe 'JSON.parse(process.argv[1]).vulnerabilities.found' "$said" 2>/dev/null) in
    false) echo "Nothing is known." ;;
    true) cargo audit --no-fetch; known=1 ;;
    *) not_asked "the RustSec database cannot be reached." ;;
  esac
else
  not_asked "there is neither cargo-deny nor cargo-audit (cargo install --locked cargo-deny)."
fi

say "npm"
said=$(npm audit --json 2>/dev/null)
case $(node -pe 'JSON.parse(process.argv[1]).metadata.vulnerabilities.total' "$said" 2>/dev/null) in
  0) echo "Nothing is known." ;;
  [1-9]*) npm audit; known=1 ;;
  *) not_asked "npm's database cannot be reached: $(node -pe 'JSON.parse(process.argv[1]).message' "$said" 2>/dev/null)" ;;
esac

[ $known = 0 ] || exit 1
[ $unasked = 0 ] || exit 2
