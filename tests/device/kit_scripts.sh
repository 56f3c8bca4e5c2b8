#!/usr/bin/env bash
# kit_scripts.sh FOLDER: tests run.sh and the refusals of tools/gpu_check.sh below FOLDER. A shell script stands for the programs.
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
[ -x /bin/busybox ] || { echo "SKIPPED: there is no /bin/busybox"; exit 77; }
folder=$1
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

failed=0
# Runs a command and checks its exit code and a part of what it prints: expect CODE TEXT COMMAND...
expect() {
  local wanted=$1 text=$2 code=0
  shift 2
  "$@" >said 2>&1 || code=$?
  if [ "$code" -ne "$wanted" ] || ! grep -qF -- "$text" said; then
    echo "FAILED: $*: exit code $code, expected $wanted and \"$text\"; it said:"
    cat said
    failed=1
  fi
}
check() { "$@" || { echo "FAILED: $*"; failed=1; }; }

# $1: what stands for bin/brittle.
make_kit() {
  rm -rf kit packed
  mkdir -p kit packed/{bin,system,lib,cxx,vulkan}
  printf '%s\n' '#!/bin/sh' "$1" >packed/bin/brittle
  chmod +x packed/bin/brittle
  echo 0 >packed/system/version
  tar -C packed -cJf kit/programs.tar.xz .
  cp /bin/busybox kit/busybox
  install -m 755 "$source/tools/device_check/run.sh" kit/run.sh
}
works='case $1 in devices) echo "0  card, driver: chosen" ;; *) echo "checks with $*" ;; esac'

gpu_check_keeps_files_of_others() {
  local pack=("$source/tools/gpu_check.sh" --no-build -o)
  mkdir home
  echo mine >home/thesis.txt
  expect 2 "is no kit" "${pack[@]}" home
  touch home/programs.tar.xz
  expect 2 "thesis.txt" "${pack[@]}" home
  check grep -q mine home/thesis.txt
  expect 2 "is no folder" "${pack[@]}" home/thesis.txt
  expect 2 usage "${pack[@]}" ""
  expect 0 usage "$source/tools/gpu_check.sh" --help
}

run_sh_unpacks_whole() {
  make_kit "$works"
  expect 0 "checks with check-device" kit/run.sh --parts models
  local unpacked
  unpacked=$(echo kit/unpacked-*)
  check test -f "$unpacked/complete"
  rm "$unpacked/complete"
  rm "$unpacked/system/version"
  expect 0 "unpacking" kit/run.sh
  check test -f "$unpacked/system/version"
  ln -sf kit/run.sh link.sh
  expect 0 "checks with check-device" ./link.sh
}

run_sh_says_what_is_wrong() {
  make_kit "$works"
  chmod -x kit/busybox
  expect 2 "may not be executed" kit/run.sh
  rm kit/busybox
  expect 2 "busybox is missing" kit/run.sh
  make_kit "$works"
  head -c 200 kit/programs.tar.xz >kit/part
  mv kit/part kit/programs.tar.xz
  expect 2 "is damaged" env TMPDIR="$PWD" kit/run.sh
  check test -z "$(find . -name 'unpacked-*')"
}

run_sh_explains_a_missing_device() {
  make_kit 'echo "brittle: no usable device matches \"nosuch\"; this machine has 0: card (usable)" >&2; exit 4'
  expect 4 'no usable device matches "nosuch"' kit/run.sh --device nosuch
  check sh -c '! grep -q install said'
  make_kit 'echo "brittle: BRITTLE_DEVICE_WITHOUT: \"wings\" is no optional feature" >&2; exit 2'
  expect 2 '"wings" is no optional feature' kit/run.sh
  check sh -c '! grep -q install said'
  make_kit 'echo "brittle: no usable device; this machine has no Vulkan device at all" >&2; exit 4'
  expect 4 "install this GPU's Vulkan driver" kit/run.sh
}

# A busybox whose tar does not end stands for a slow disk.
run_sh_leaves_nothing_when_it_is_ended() {
  make_kit "$works"
  printf '%s\n' '#!/bin/sh' 'case $1 in tar) exec sleep 60 ;; *) exec /bin/busybox "$@" ;; esac' >kit/busybox
  chmod +x kit/busybox
  kit/run.sh >said 2>&1 &
  local shell=$! code=0
  for _ in $(seq 100); do [ -z "$(find kit -name '*.new.*')" ] || break; sleep 0.1; done
  check test -n "$(find kit -name '*.new.*')"
  kill -TERM "$shell"
  wait "$shell" || code=$?
  check test "$code" -eq 143
  check test -z "$(find kit -name '*.new.*')"
  check test -z "$(pgrep -P "$shell")"
}

gpu_check_keeps_files_of_others
run_sh_unpacks_whole
run_sh_says_what_is_wrong
run_sh_explains_a_missing_device
run_sh_leaves_nothing_when_it_is_ended
exit "$failed"
