#!/usr/bin/env bash
# Packs the npm package into target/package/.
set -euo pipefail
cd "$(dirname "$0")/.."
web/build.sh
source web/toolchain.sh

say "packing the npm package"
npm=web/pkg/npm
version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"/\1/p' Cargo.toml)
cp web/npm/* LICENSE-* $npm
mkdir -p target/package
rm -f target/package/*.tgz
(cd $npm && npm pkg set version="$version" && npm pack --silent --pack-destination ../../../target/package)
