#!/usr/bin/env bash
# tools/demo.sh: sets up, builds, and shatters a built-in model: a twisted ring, not convex, with a hole through it. Leaves the
# fragments in out/demo.glb and a picture of them, moved apart, in out/demo.png.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
tools/build.sh release brittle
mkdir -p out
build/release/bin/brittle shatter builtin:ring -o out/demo.glb --sites 60 --seed 1 --verify \
  --picture out/demo.png --explode 0.35 </dev/null
