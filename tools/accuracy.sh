#!/usr/bin/env bash
# tools/accuracy.sh [OPTION...]: runs brittle accuracy with these options into out/accuracy, and draws the plot of the README,
# tools/accuracy.png, from the page that it writes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh test bench
tools/build.sh release brittle brittle_peer_cgal
build/release/bin/brittle accuracy "$@" -o out/accuracy

profile=$(mktemp -d)
trap 'rm -rf "$profile"' EXIT
chromium --headless=new --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$profile" --window-size=900,600 \
  --screenshot=tools/accuracy.png "file://$PWD/out/accuracy/report.html#only=pareto-pile" 2>/dev/null
echo "drawn      tools/accuracy.png"
