#!/usr/bin/env bash
# tools/fuzz.sh [SECONDS]: fuzzes the importers, the mending of meshes, the reader of scenes and the C ABI for that many seconds of one core
# (default 1800, half an hour), as many formats at a time as there are cores. What it learns stays in build/fuzz/corpus for the
# next time. A format stops at its first finding, which lies in build/fuzz/findings; build/fuzz/bin/brittle_fuzz_FORMAT FILE shows
# it again. The suite (tools/test.sh) runs the same for about a minute.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-1800}
case $seconds in *[!0-9]* | "") echo "usage: tools/fuzz.sh [SECONDS]" >&2; exit 2 ;; esac
tools/setup.sh test
tools/build.sh fuzz
cd build/fuzz
mkdir -p findings logs
export ASAN_OPTIONS=max_allocation_size_mb=2048:allocator_may_return_null=1
export LSAN_OPTIONS=suppressions=$PWD/../../tests/lsan.supp

# run FORMAT SECONDS MAX_BYTES
run() {
  mkdir -p "corpus/$1"
  local verdict=passed
  "bin/brittle_fuzz_$1" -max_total_time="$2" -timeout=60 -rss_limit_mb=4096 -max_len="$3" -print_final_stats=1 \
    -artifact_prefix="findings/$1-" "corpus/$1" $([ ! -d "seeds/$1" ] || echo "seeds/$1") >"logs/$1.log" 2>&1 </dev/null || verdict="FAILED, see build/fuzz/logs/$1.log"
  echo "$1: $(sed -n 's/^stat::number_of_executed_units: *//p' "logs/$1.log") inputs in $2 s, $verdict"
  [ "$verdict" = passed ]
}
export -f run

# Most of the time goes to our own readers without a process of their own: glb, gltf, fbx and dae start one for every input.
while read -r format percent max_bytes; do
  time=$((seconds * percent / 100))
  echo "$format $((time > 0 ? time : 1)) $max_bytes"
done <<FORMATS | xargs -P "$(nproc)" -L 1 bash -c 'run "$@"' run
abi 20 2048
obj 15 8192
ply 10 8192
off 10 8192
stl 10 8192
toml 10 4096
gltf_reader 15 8192
glb 2 24576
gltf 2 24576
fbx 3 24576
dae 3 24576
FORMATS
