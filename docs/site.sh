#!/usr/bin/env bash
# Makes a site of these pages and the gallery, with a report on each case of some folders:
# docs/site.sh FOLDER [CASES…], by default the bodies on a plane and on a sphere.
# It needs mdbook and liouville (cargo install mdbook; cargo install --path crates/cli).
set -euo pipefail
out=${1:?usage: docs/site.sh FOLDER [CASES...]}
shift
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- cases/plane cases/sphere

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
mkdir -p "$stage/src/python" "$stage/src/crates/fuzz" "$out"
out=$(cd "$out" && pwd)
cp docs/book.toml "$stage"
cp -r README.md CONTRIBUTING.md SECURITY.md CHANGELOG.md LICENSE-* CITATION.cff docs cases examples "$stage/src"
cp -r python/notebooks "$stage/src/python"
cp crates/fuzz/README.md "$stage/src/crates/fuzz"
rm "$stage/src/docs/SUMMARY.md" "$stage/src/docs/book.toml" "$stage/src/docs/site.sh"
# Paths from the folder above; a last chapter for the reports.
sed -e 's|](\.\./|](|; t' -e 's|](|](docs/|' docs/SUMMARY.md >"$stage/src/SUMMARY.md"
mdbook build "$stage" --dest-dir "$out"
cp "$out/index.html" "$out/README.html"
liouville site "$@" --out "$out/reports"
echo "written: $out/index.html, and $out/reports/index.html"
