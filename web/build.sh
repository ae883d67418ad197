#!/usr/bin/env bash
# Puts the page and the verifier for it into one folder: web/build.sh [FOLDER]
# Once before: rustup target add wasm32-unknown-unknown
set -euo pipefail
out=$(realpath -m "${1:-$(dirname "$0")/../target/playground}")
cd "$(dirname "$0")/.."
cargo build --locked --profile web --target wasm32-unknown-unknown -p liouville-web
mkdir -p "$out"
cp web/index.html web/*.css web/*.js "$out"
cp "${CARGO_TARGET_DIR:-target}/wasm32-unknown-unknown/web/liouville_web.wasm" "$out/liouville.wasm"
echo "$out: $(wc -c <"$out/liouville.wasm") bytes, $(gzip -9 <"$out/liouville.wasm" | wc -c) compressed"
