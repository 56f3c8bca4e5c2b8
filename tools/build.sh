#!/usr/bin/env bash
# tools/build.sh PRESET [TARGET...]: configures and builds one of the CMake presets, and shows how far it is: on a terminal in one
# line that is rewritten, elsewhere in a line every ten seconds. Warnings and errors are printed in full.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source tools/progress.sh

preset=${1:?usage: tools/build.sh PRESET [TARGET...]}
shift
targets=("${@:-all}")

log=$(mktemp)
trap 'end_progress; rm -f "$log"' EXIT

# Prints how many of ninja's steps are done, and what the last one was.
build_state() {
  tail -c 4000 "$log" | tr '\r' '\n' | sed -n 's|^\[\([0-9]*/[0-9]*\)\] \(.*\)|\1  \2|p' | tail -n 1
}

quietly() {
  if ! "$@" >"$log" 2>&1 </dev/null; then
    end_progress
    grep -vE '^\[[0-9]+/[0-9]+\] ' "$log" >&2 || true # all but the steps that went well
    echo "build: failed: $*" >&2
    exit 1
  fi
  end_progress
  # Warnings are for reading even where the build goes on.
  grep -E 'warning:' "$log" >&2 || true
}

# Another checkout has the same files elsewhere: it finds what this one has compiled.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
export NINJA_STATUS='[%f/%t] '

start=$SECONDS
show_progress "build: configuring $preset"
quietly cmake --preset "$preset"
show_progress "build: ${targets[*]} ($preset)" build_state
quietly cmake --build --preset "$preset" --parallel "$(nproc)" --target "${targets[@]}"
echo "built ${targets[*]} ($preset) in $((SECONDS - start)) s"
