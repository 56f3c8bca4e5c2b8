#!/usr/bin/env bash
# with_subgroups_of.sh LANES PROGRAM [ARG...]: runs a program of the build on lavapipe with subgroups of LANES lanes. Fails if the
# device does not have as many. Exit code 77: no device is lavapipe.
#
# Mesa 22.3 does not look at the width when it looks a kernel up in its cache on disk: with a shared cache a program would run
# kernels that were compiled for another width. So each width has a cache of its own.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: with_subgroups_of.sh LANES PROGRAM [ARG...]" >&2; exit 2; }
lanes=$1
shift
export LP_NATIVE_VECTOR_WIDTH=$((32 * lanes))
export MESA_SHADER_CACHE_DIR=${XDG_CACHE_HOME:-$HOME/.cache}/brittle/subgroups_of_$lanes
mkdir -p "$MESA_SHADER_CACHE_DIR"

export BRITTLE_DEVICE=llvmpipe
brittle=$(dirname "$1")/brittle
code=0
said=$("$brittle" devices 2>&1) || code=$?
[ "$code" != 4 ] || { echo "SKIPPED: there is no lavapipe"; exit 77; }
[ "$code" = 0 ] || { echo "FAILED: brittle devices ended with $code: $said" >&2; exit 1; }
found=$("$brittle" check-device --work facts | sed -n 's/.*"subgroups":{"size":\([0-9]*\).*/\1/p')
[ "$found" = "$lanes" ] || { echo "FAILED: the device has subgroups of ${found:-unknown} lanes, expected $lanes" >&2; exit 1; }
exec "$@"
