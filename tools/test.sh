#!/usr/bin/env bash
# tools/test.sh [--long]: sets up, builds and runs the tests:
#   release       all tests in the release build
#   validation    a part under the Vulkan validation layer (core, synchronization)
#   gpu_assisted  a part under the layer's check of each access of a kernel
#   asan          a part under the address and undefined-behavior sanitizers
#   fuzz          the fuzzers of importers, scene files and the C ABI, for about two minutes (tools/fuzz.sh runs them for longer)
#   fresh_system  the demo on a bare system of another Debian suite (tools/fresh_system.sh); skipped where none can be made
# --long adds every model there is (tools/corpus.sh fetches some), larger models, more sites and seeds, the slow cases of the
# kernels, and all small tests under the check of each access.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

long=false
case "${1:-}" in
  "") ;;
  --long) long=true ;;
  *) echo "usage: tools/test.sh [--long]" >&2; exit 2 ;;
esac

tools/setup.sh test bench
logs=build/test-logs
mkdir -p "$logs"
summary=()
ctest_steps=()
failed=false

# step NAME COMMAND...: runs on after a failure, so that one run tells all. Exit code 77 means that a step cannot run here.
step() {
  local name=$1 start=$SECONDS verdict=passed status=0
  shift
  if [ "$1" = ctest ]; then ctest_steps+=("$name"); fi
  echo "== $name"
  "$@" </dev/null 2>&1 | tee "$logs/$name.log" || status=$?
  if [ "$status" = 77 ]; then
    verdict=skipped
  elif [ "$status" != 0 ]; then
    verdict=FAILED
    failed=true
  fi
  summary+=("$(printf '%-12s %-7s %4d s' "$name" "$verdict" $((SECONDS - start)))")
}

# A fuzzer finds by chance what the next run does not find again: its findings go to the log, to be given to
# build/fuzz/bin/brittle_fuzz_FORMAT by: base64 -d | gunzip
show_findings() {
  [ "${summary[-1]#*FAILED}" != "${summary[-1]}" ] || return 0
  local finding
  for finding in build/fuzz/findings/*; do
    [ -f "$finding" ] || continue
    echo "-- finding ${finding##*/}"
    gzip -9 <"$finding" | base64
  done
}

# Runs the demo on a suite that this system is not.
run_fresh_system() {
  local suite=trixie
  if grep -qs '^VERSION_CODENAME=trixie$' /etc/os-release; then suite=bookworm; fi
  if [ "$(id -u)" = 0 ]; then
    tools/fresh_system.sh --ccache "$suite"
  else
    sudo -n tools/fresh_system.sh --ccache "$suite"
  fi
}

step build tools/build.sh release all
if $failed; then exit 1; fi
step release ctest --preset release --label-regex '^quick$' --no-tests=error --parallel 2
step validation ctest --preset validation --label-regex '^validation$' --no-tests=error --parallel 2
step gpu_assisted ctest --preset gpu_assisted --label-regex '^gpu_assisted$' --no-tests=error --parallel 2
step build-asan tools/build.sh asan brittle_tests_abi brittle_tests_engine brittle_tests_godot brittle_tests_hard \
  brittle_tests_module brittle_tests_reference brittle_tests_reload
step asan ctest --preset asan --label-regex '^asan$' --no-tests=error --parallel 2
step build-fuzz tools/build.sh fuzz
step fuzz ctest --preset fuzz --label-regex '^fuzz$' --no-tests=error --parallel 2
show_findings
step fresh_system run_fresh_system
if $long; then
  step corpus tools/corpus.sh
  step long ctest --preset release --label-regex '^long$' --no-tests=error
  step gpu_assisted_long ctest --preset gpu_assisted --label-regex '^gpu_assisted_long$' --no-tests=error --parallel 2
fi

echo
echo "== summary"
printf '%s\n' "${summary[@]}"
echo
for name in "${ctest_steps[@]}"; do
  echo "-- $name"
  sed -n '/% tests passed/,$p' "$logs/$name.log"
done
if $failed; then exit 1; fi
