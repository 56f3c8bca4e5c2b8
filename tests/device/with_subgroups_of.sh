#!/usr/bin/env bash
# with_subgroups_of.sh LANES PROGRAM [ARG...]: runs a program on lavapipe with subgroups of LANES lanes.
#
# Mesa 22.3 does not look at the width when it looks a kernel up in its cache on disk: with a shared cache a program would run
# kernels that were compiled for another width. So each width has a cache of its own.
set -euo pipefail
lanes=$1
shift
export LP_NATIVE_VECTOR_WIDTH=$((32 * lanes))
export MESA_SHADER_CACHE_DIR=${XDG_CACHE_HOME:-$HOME/.cache}/brittle/subgroups_of_$lanes
mkdir -p "$MESA_SHADER_CACHE_DIR"
exec "$@"
