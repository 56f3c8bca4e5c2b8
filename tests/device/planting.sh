# Sourced by the scripts that plant kernels: they run a test with other words in place of one kernel's (BRITTLE_TEST_KERNEL,
# tests/support/planted_kernel.h). Set `build` and `folder` before the calls.
failures=0

report() {
  echo "$1"
  failures=$((failures + 1))
}

# outcome_of PROGRAM TEST NAME=FILE.spv: prints "passes", "fails", "stops" (the program ends within the test), or another ending.
# Leaves what the program prints in $folder/log.
outcome_of() {
  local program=$build/bin/brittle_tests_$1 test=$2 status=0
  BRITTLE_TEST_KERNEL=$3 timeout 300 "$program" --gtest_filter="$test" >"$folder/log" 2>&1 || status=$?
  if [ $status = 0 ] && grep -q '\[       OK \]' "$folder/log"; then
    echo passes
  elif [ $status = 1 ] && grep -q "^\[  FAILED  \] " "$folder/log"; then
    echo fails
  elif [ $status != 0 ] && [ $status != 2 ] && [ $status != 124 ] && grep -q '\[ RUN      \]' "$folder/log"; then
    echo stops
  else
    echo "ends with $status"
  fi
}
