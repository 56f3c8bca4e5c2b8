#!/usr/bin/env bash
# compare_with_subgroups.sh BUILD SCENE...: records the motion of scenes with subgroups of 8 lanes, and compares with it on 4 lanes. Lists
# that lanes fill are in another order then, and nothing else may differ. Exit code 77: no device is lavapipe.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: compare_with_subgroups.sh BUILD SCENE..." >&2; exit 2; }
build=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

compare_with() {
  local lanes=$1
  shift
  "$here/with_subgroups_of.sh" "$lanes" "$build/bin/brittle" compare --device 0 --steps 10 "$@"
}

failures=0
for scene in "$@"; do
  code=0
  compare_with 8 "$scene" --record "$folder/motion" --passes-of 1 || code=$?
  [ "$code" != 77 ] || exit 77
  [ "$code" = 0 ] && compare_with 4 "$scene" --against "$folder/motion" --whole --fail-on-difference || failures=$((failures + 1))
done
[ "$failures" = 0 ]
