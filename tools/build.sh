#!/usr/bin/env bash
# tools/build.sh PRESET [TARGET...]: configures and builds one of the CMake presets, quietly unless something goes wrong.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${1:?usage: tools/build.sh PRESET [TARGET...]}
shift
targets=("${@:-all}")

log=$(mktemp)
trap 'rm -f "$log"' EXIT

quietly() {
  if ! "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    exit 1
  fi
  # Warnings are for reading even where the build goes on.
  grep -E 'warning:' "$log" >&2 || true
}

# Another checkout has the same files elsewhere: it finds what this one has compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

start=$SECONDS
quietly cmake --preset "$preset"
quietly cmake --build --preset "$preset" --parallel "$(nproc)" --target "${targets[@]}"
echo "built ${targets[*]} ($preset) in $((SECONDS - start)) s"
