#!/usr/bin/env bash
# planted_constants.sh BUILD GLSLANG SPIRV_OPT: plants one wrong constant at a time in a kernel (planted_constants.txt), and runs
# a test of that kernel with it. Fails if such a test passes.
set -euo pipefail

build=$1 glslang=$2 optimizer=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
shaders=$(cd "$here/../../shaders-spirv" && pwd)
folder=$build/device-test/planted
source "$here/planting.sh"

# Leaves the kernel's words, with the change made, in $folder/KERNEL.spv. The change may be in any file that the kernel includes.
compile_changed() {
  local kernel=$1 file=$2 defines=$3 place=$4 change=$5
  local tree=$folder/tree
  rm -rf "$tree"
  mkdir -p "$tree"
  cp -r "$shaders"/. "$tree"
  sed -i "$change" "$tree/$place"
  if [ -n "$change" ] && cmp -s "$shaders/$place" "$tree/$place"; then
    report "FAILED: \"$change\" finds nothing to change in $place"
    return 1
  fi
  local options=()
  [ "$defines" = - ] || for define in $defines; do options+=("-D$define"); done
  "$glslang" --target-env vulkan1.1 -V --quiet -I"$tree" "${options[@]}" -o "$folder/raw.spv" "$tree/$file"
  "$optimizer" -O --preserve-bindings --preserve-spec-constants "$folder/raw.spv" -o "$folder/$kernel.spv"
}

rm -rf "$folder"
mkdir -p "$folder"
planted=0
while IFS='|' read -r kernel file defines place change program test; do
  [[ -n $kernel && $kernel != "#"* ]] || continue
  compile_changed "$kernel" "$file" "$defines" "$place" "$change" || continue
  wanted=fails
  [ -n "$change" ] || wanted=passes
  outcome=$(outcome_of "$program" "$test" "$kernel=$folder/$kernel.spv")
  planted=$((planted + 1))
  if [ "$outcome" = "$wanted" ]; then
    echo "$kernel: $test $outcome with \"$change\""
  else
    report "FAILED: $kernel: $test $outcome with \"$change\", but ${wanted%s} it must"
    tail -5 "$folder/log"
  fi
done <"$here/planted_constants.txt"
[ "$planted" -ge 20 ] || report "FAILED: only $planted lines of planted_constants.txt were tried"
[ "$failures" = 0 ]
