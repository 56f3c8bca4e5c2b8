#!/usr/bin/env bash
# shatter_bytes.sh BUILD DEVICE SITES...: shatters the models of meshes.txt into these numbers of sites with BUILD/bin/brittle.
# DEVICE is one of:
#   reference           the system's device; writes the files that the others are compared with
#   newer               a newer lavapipe (tools/newer_lavapipe.sh)
#   subgroup_4          lavapipe with subgroups of 4 lanes instead of 8
#   without_all         the system's device without any optional feature (BRITTLE_DEVICE_WITHOUT)
# Fails if any file differs from the reference by a byte; on the newer lavapipe, if it holds other fragments (same_fragments.cpp):
# the last bits of normals and masses are the driver's. Exit code 77, with the reason: the device cannot be had, or models that
# are files are missing (the built-in models are compared all the same).
set -euo pipefail

build=$1 device=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$(cd "$here/../.." && pwd)
meshes=${BRITTLE_SHARED:-$source/../shared}/meshes
reference=$build/device-test/reference
folder=$build/device-test/$device
brittle=("$build/bin/brittle")

fail() {
  echo "FAILED: $*"
  exit 1
}

skip() {
  echo "SKIPPED: $*"
  exit 77
}

choose_newer() {
  "$source/tools/newer_lavapipe.sh" --obtain >/dev/null || {
    [ $? = 77 ] || fail "tools/newer_lavapipe.sh"
    skip "no newer lavapipe can be had here"
  }
  brittle=("$source/tools/newer_lavapipe.sh" "${brittle[@]}")
  local old new
  old=$("$build/bin/brittle" devices) new=$("${brittle[@]}" devices)
  [[ $new == *"llvmpipe Mesa "* ]] || fail "the newer lavapipe is not the device: $new"
  [ "$old" != "$new" ] || skip "the system's device is the newer lavapipe itself"
}

choose_subgroups_of() {
  brittle=("$here/with_subgroups_of.sh" "$1" "${brittle[@]}")
  local code=0
  "${brittle[@]}" devices >/dev/null || code=$?
  [ "$code" != 77 ] || skip "there is no lavapipe"
  [ "$code" = 0 ] || fail "lavapipe has no subgroups of $1"
}

case $device in
  reference) ;;
  newer) choose_newer ;;
  subgroup_4) choose_subgroups_of 4 ;;
  without_all) export BRITTLE_DEVICE_WITHOUT=all ;;
  *) fail "no device is named $device" ;;
esac
rm -rf "$folder"
mkdir -p "$folder"

compare() {
  case $device in
    reference) ;;
    newer) "$build/bin/same_fragments" "$1" "$2" >"$folder/difference" || fail "$3: $(cat "$folder/difference")" ;;
    *) cmp "$1" "$2" || fail "$3" ;;
  esac
}

compared=0 missing=0
while read -r name model; do
  [[ -n $name && $name != "#"* ]] || continue
  [[ $model == builtin:* ]] || model=$meshes/$model
  if [[ $model != builtin:* && ! -f $model ]]; then
    missing=$((missing + 1))
    continue
  fi
  for sites in "$@"; do
    file=$name-$sites.glb
    "${brittle[@]}" shatter "$model" --sites "$sites" -o "$folder/$file" >/dev/null || fail "$name into $sites on $device"
    compare "$reference/$file" "$folder/$file" "$name into $sites differs on $device"
    compared=$((compared + 1))
  done
done <"$here/meshes.txt"

[ "$compared" -ge $((4 * $#)) ] || fail "only $compared files were made; the built-in models alone are more"
echo "$compared files on $device"
[ "$device" != reference ] || exit 0
rm -rf "$folder"
[ "$missing" = 0 ] || skip "$missing of the models are files that are not in $meshes"
