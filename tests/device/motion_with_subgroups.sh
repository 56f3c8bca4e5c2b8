#!/usr/bin/env bash
# motion_with_subgroups.sh BUILD SECONDS SCENE...: simulates scenes on lavapipe with subgroups of 8 and of 4 lanes, and compares the
# states in the end bit by bit. With 4 lanes workgroups of islands have two subgroups, which run one after the other: a barrier that
# is missing between them shows. Exit code 77: no device is lavapipe.
set -euo pipefail
[ $# -ge 3 ] || { echo "usage: motion_with_subgroups.sh BUILD SECONDS SCENE..." >&2; exit 2; }
build=$1 seconds=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

hash_with() { "$here/with_subgroups_of.sh" "$1" "$build/bin/brittle" simulate "$2" --seconds "$seconds" --state-hash; }

failures=0
for scene in "$@"; do
  code=0
  wide=$(hash_with 8 "$scene") || code=$?
  [ "$code" != 77 ] || { echo "$wide"; exit 77; }
  narrow=$(hash_with 4 "$scene") || code=$?
  if [ "$code" = 0 ] && [ -n "$wide" ] && [ "$wide" = "$narrow" ]; then
    echo "$scene: $wide"
  else
    echo "FAILED: $scene: exit code $code, state ${wide:-unknown} with 8 lanes and ${narrow:-unknown} with 4"
    failures=$((failures + 1))
  fi
done
[ "$failures" = 0 ]
