#!/usr/bin/env bash
# tools/demo.sh: sets up, builds, and shatters a built-in model: a twisted ring, not convex, with a hole through it. Leaves the
# fragments in out/demo.glb and a picture of them, moved apart, in out/demo.png. Then a ball breaks a window pane: a picture of that
# is in out/window_pane.png, two seconds of it are an animation in out/window_pane.glb and, if there is ffmpeg, a film in
# out/window_pane.mp4.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/progress.sh

tools/setup.sh
tools/build.sh release brittle
mkdir -p out
start=$SECONDS
log=$(mktemp)
trap 'end_progress; rm -f "$log"' EXIT

# shown TEXT ARG...: runs brittle with these arguments, shows that it goes on, and then what it said.
shown() {
  local status=0
  echo "demo: $1"
  show_progress "demo: $1"
  shift
  build/release/bin/brittle "$@" >"$log" 2>&1 </dev/null || status=$?
  end_progress
  cat "$log"
  return "$status"
}

scene=modules/brittle/scene/examples/window_pane.toml
if [ ! -d "${XDG_CACHE_HOME:-$HOME/.cache}/mesa_shader_cache" ]; then
  echo "demo: a driver that has no cache yet compiles kernels first, which takes some seconds"
fi
shown "breaking a ring into out/demo.glb and out/demo.png" shatter builtin:ring -o out/demo.glb --sites 60 --seed 1 --verify \
  --picture out/demo.png --explode 0.35
shown "breaking a window pane into out/window_pane.png" simulate "$scene" -o out/window_pane.png --seconds 0.35
shown "simulating two seconds of a window pane into out/window_pane.glb" simulate "$scene" -o out/window_pane.glb --seconds 2
if command -v ffmpeg >/dev/null; then
  shown "filming them into out/window_pane.mp4" simulate "$scene" -o out/window_pane.mp4 --seconds 2 --fps 30
else
  echo "demo: no film, since there is no program ffmpeg"
fi
echo "demo: done in $((SECONDS - start)) s"
