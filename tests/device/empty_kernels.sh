#!/usr/bin/env bash
# empty_kernels.sh BUILD NAMES [KERNEL...]: checks for each kernel that a test fails if the kernel does nothing (empty_kernels.txt).
# NAMES is a file with the names of all kernels, one per line. Without KERNEL every row is checked, and a kernel without a row is
# a failure.
set -euo pipefail

build=$1 names=$2
shift 2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
table=$here/empty_kernels.txt
source "$here/planting.sh"

rows() { grep -v '^#' "$table"; }

# The table and the build name the same kernels, each of them once.
check_names() {
  local name
  for name in $(rows | cut -d'|' -f1 | sort | uniq -d); do report "FAILED: $name has two rows in $table"; done
  for name in $(comm -13 <(rows | cut -d'|' -f1 | sort -u) <(sort -u "$names")); do report "FAILED: $name has no row in $table"; done
  for name in $(comm -23 <(rows | cut -d'|' -f1 | sort -u) <(sort -u "$names")); do report "FAILED: $table names $name, which is no kernel"; done
}

# Leaves the kernel with an entry point that returns at once in $folder/empty.spv.
empty() {
  spirv-dis --raw-id --no-header "$build/spirv/$1.spv" | awk -f "$here/empty_kernel.awk" >"$folder/empty.spvasm"
  spirv-as --target-env spv1.3 -o "$folder/empty.spv" "$folder/empty.spvasm"
}

# The test passes with the kernel as it is built, so it fails because the kernel is empty.
declare -A passed
check_kernel() {
  local kernel=$1 replaced=$2 program=$3 test=$4 outcome
  if [ -z "${passed[$program $test $replaced]:-}" ] || [ "$kernel" != "$replaced" ]; then
    outcome=$(outcome_of "$program" "$test" "$replaced=$build/spirv/$kernel.spv")
    [ "$outcome" = passes ] || { report "FAILED: $test $outcome with $kernel as it is built" && tail -5 "$folder/log"; return; }
    passed[$program $test $replaced]=yes
  fi
  empty "$kernel"
  outcome=$(outcome_of "$program" "$test" "$replaced=$folder/empty.spv")
  case $outcome in
    fails | stops) echo "$kernel: $test $outcome" ;;
    *) report "FAILED: $test $outcome, but $kernel does nothing" ;;
  esac
}

check_names
wanted=" $* "
checked=0
while IFS='|' read -r kernel replaced program test; do
  [ $# = 0 ] || [[ $wanted == *" $kernel "* ]] || continue
  checked=$((checked + 1))
  [ "$replaced" = none ] && continue
  [ -n "$replaced" ] || replaced=$kernel
  check_kernel "$kernel" "$replaced" "$program" "$test"
done < <(rows)
[ $# = 0 ] || [ $checked = $# ] || report "FAILED: $checked of $# kernels have a row"
echo "$checked kernels, $failures failures"
[ "$failures" = 0 ]
