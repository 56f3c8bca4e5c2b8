#!/bin/sh
# Behaves like a GoogleTest program with four tests: the second crashes, the third hangs, the fourth fails.
case "$*" in
  *--gtest_list_tests*)
    printf 'Fake.\n  Passes\n  Crashes\n  Hangs\n  Fails\nGiven/Values.\n  Pass/0  # GetParam() = 1\n'
    exit 0
    ;;
esac
wants() { case "$*" in *"$name"*) return 0 ;; *) return 1 ;; esac; }
for name in Fake.Passes Fake.Crashes Fake.Hangs Fake.Fails Given/Values.Pass/0; do
  wants "$@" || continue
  echo "[ RUN      ] $name"
  case $name in
    *Crashes) kill -SEGV $$ ;;
    *Hangs) exec sleep 60 ;;
    *Fails) echo "the value is 3"; echo "[  FAILED  ] $name (7 ms)" ;;
    *) echo "[       OK ] $name (5 ms)" ;;
  esac
done
