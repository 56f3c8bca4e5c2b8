#!/usr/bin/env bash
# tools/fuzz.sh [SECONDS]: fuzzes the importers and the mending of meshes for that long in all (default 1800, half an hour), one
# format after the other on every core. What it learns stays in build/fuzz/corpus, what it finds in build/fuzz/findings;
# build/fuzz/bin/brittle_fuzz_FORMAT FILE shows a finding again. The suite (tools/test.sh) runs the same for one minute.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-1800}
case $seconds in *[!0-9]* | "") echo "usage: tools/fuzz.sh [SECONDS]" >&2; exit 2 ;; esac
tools/setup.sh
tools/build.sh fuzz

# Our own readers get most of the time: assimp's run in a process of their own, and are not ours to mend.
declare -A share=([obj]=22 [ply]=22 [off]=18 [stl]=18 [glb]=5 [gltf]=5 [fbx]=5 [dae]=5)
export ASAN_OPTIONS=max_allocation_size_mb=1024:allocator_may_return_null=1
root=build/fuzz
mkdir -p $root/findings $root/logs
failed=false
for format in obj ply off stl glb gltf fbx dae; do
  mkdir -p $root/corpus/$format
  time=$((seconds * share[$format] / 100))
  [ $time -gt 0 ] || time=1
  echo "== $format, $time s"
  # A fork per core; they share the corpus, and go on after a finding.
  if ! $root/bin/brittle_fuzz_$format -fork="$(nproc)" -ignore_crashes=1 -max_total_time=$time -timeout=25 -rss_limit_mb=2048 \
    -max_len=24576 -artifact_prefix=$root/findings/$format- $root/corpus/$format $root/seeds/$format \
    >$root/logs/$format.log 2>&1 </dev/null; then
    failed=true
  fi
  tail -n 1 $root/logs/$format.log
done
found=$(find $root/findings -type f | wc -l)
echo "findings: $found, in $root/findings"
if $failed || [ "$found" -gt 0 ]; then exit 1; fi
