#!/usr/bin/env bash
# Builds the wheel, installs it into a fresh environment, and tests it there.
set -euo pipefail
cd "$(dirname "$0")"
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT

step() { printf '\n== %s (%ss)\n' "$1" "$SECONDS"; }

step "tools"
python3 -m venv "$home/tools"
"$home/tools/bin/pip" install --quiet "maturin>=1.9,<2"
step "wheel"
"$home/tools/bin/maturin" build --release --locked --out "$home/wheels"
step "installation"
python3 -m venv "$home/fresh"
"$home/fresh/bin/pip" install --quiet "$(echo "$home"/wheels/*.whl)[test]"
step "tests"
# Away from the sources, so that the installed package is the one that is tested.
cp -r tests "$home/tests"
export LIOUVILLE_PYTHON=$PWD
cd "$home"
"$home/fresh/bin/python" -m pytest -q -p no:cacheprovider --rootdir "$home/tests" "$home/tests"
step "types"
"$home/tools/bin/pip" install --quiet mypy
"$home/tools/bin/mypy" --python-executable "$home/fresh/bin/python" --ignore-missing-imports -p liouville
step "done"
