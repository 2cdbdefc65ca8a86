#!/usr/bin/env bash
# Looks for bytes that break a law of the core: tests/fuzz/run.sh TARGET SECONDS
#
#   tests/fuzz/run.sh decode 600     fuzzes for ten minutes, then merges what it has found
#   tests/fuzz/run.sh session 0      only minimises the corpus
#
# A target is a file of fuzz_targets; its laws are in tests/src/fuzz. A corpus is a text file, one
# input a line in hexadecimal, which the ordinary tests replay. Of its inputs a run keeps as few as
# reach all code that is reached, and those below a remark (#) anyway: they once broke a law. An
# input that breaks one is printed as such a line. libFuzzer needs a C++ compiler.
set -euo pipefail
cd "$(dirname "$0")"
targets=$(basename -s .rs fuzz_targets/*.rs | xargs)
target=${1:?a target: $targets}
seconds=${2:?seconds}
corpus=$PWD/corpus/$target.txt
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/../../target}
work=$CARGO_TARGET_DIR/fuzz/$target
host=$(rustc -vV | sed -n 's/^host: //p')
longest=600
# A program keeps all layouts of users that it has met, up to a limit: then another one goes on.
case $target in
  link | sketch) runs=30000 ;;
  *) runs=-1 ;;
esac

rm -rf "$work/seeds" "$work/least" "$work/broken"
mkdir -p "$work"/{seeds,found,least,broken}

# The coverage that libFuzzer steers by, of this program alone and not of what builds it.
RUSTFLAGS="--cfg fuzzing -Cpasses=sancov-module
  -Cllvm-args=-sanitizer-coverage-level=4
  -Cllvm-args=-sanitizer-coverage-inline-8bit-counters
  -Cllvm-args=-sanitizer-coverage-pc-table
  -Cllvm-args=-sanitizer-coverage-trace-compares" \
  cargo build -q --release --target "$host" --bin "$target"
fuzz=("$CARGO_TARGET_DIR/$host/release/$target" -timeout=10 -rss_limit_mb=2048
  -max_len=$longest "-artifact_prefix=$work/broken/")

perl -ne 'BEGIN { $work = shift } chomp; next if /^#/;
  open F, ">", "$work/$."; print F pack "H*", $_; close F' "$work/seeds" "$corpus"

status=0
SECONDS=0
while ((status == 0 && SECONDS < seconds)); do
  "${fuzz[@]}" -runs="$runs" -max_total_time=$((seconds - SECONDS)) -print_final_stats=1 \
    "$work/found" "$work/seeds" || status=$?
done
for broken in "$work"/broken/*; do
  [[ -e $broken ]] || continue
  perl -e 'print "$ARGV[0]:\n"; open F, "<", shift; local $/; print unpack("H*", <F>), "\n"' "$broken"
done
((status == 0)) || exit $status

"${fuzz[@]}" -set_cover_merge=1 -use_counters=0 "$work/least" "$work/seeds" "$work/found" 2>"$work/merge.log"
perl -e '($corpus, @files) = @ARGV;
  open F, "<", $corpus; while (<F>) { if (/^#/) { push @kept, $_, scalar <F>; $known{$kept[-1]} = 1 } }
  for (@files) { open G, "<", $_; local $/; push @least, unpack("H*", <G>) . "\n" }
  open F, ">", $corpus;
  print F @kept, sort { length $a <=> length $b or $a cmp $b } grep { !$known{$_} } @least' "$corpus" "$work"/least/*
wc -lc "$corpus"
