#!/usr/bin/env bash
# tools/demo.sh: sets up, builds, and shatters a built-in model: a twisted ring, not convex, with a hole through it. Leaves the
# fragments in out/demo.glb and a picture of them, moved apart, in out/demo.png. Then two seconds of a scene in which a ball
# breaks a window pane: as an animation in out/window_pane.glb and, where ffmpeg is there, as a film in out/window_pane.mp4.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
tools/build.sh release brittle
mkdir -p out
start=$SECONDS
echo "demo: breaking a ring into out/demo.glb and out/demo.png"
brittle=build/release/bin/brittle
"$brittle" shatter builtin:ring -o out/demo.glb --sites 60 --seed 1 --verify \
  --picture out/demo.png --explode 0.35 </dev/null

echo "demo: simulating two seconds of a window pane into out/window_pane.glb"
scene=modules/brittle/scene/examples/window_pane.toml
"$brittle" simulate "$scene" -o out/window_pane.glb --seconds 2 </dev/null
if command -v ffmpeg >/dev/null; then
  echo "demo: filming them into out/window_pane.mp4"
  "$brittle" simulate "$scene" -o out/window_pane.mp4 --seconds 2 </dev/null
else
  echo "demo: no film, since there is no program ffmpeg"
fi
echo "demo: done in $((SECONDS - start)) s"
