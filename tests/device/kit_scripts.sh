#!/usr/bin/env bash
# kit_scripts.sh FOLDER: tests run.sh and the refusals of tools/gpu_check.sh below FOLDER. A shell script stands for the programs.
# $KIT_SHELL: a shell, such as "/bin/busybox sh", that runs run.sh instead of /bin/sh.
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

# Makes the kit `$kit`. $1: what stands for bin/brittle, which finds its lib/part. The search for a device may take 1 s.
kit=kit
make_kit() {
  rm -rf "$kit" packed
  mkdir -p "$kit" packed/{bin,system,lib,cxx,vulkan}
  printf '%s\n' '#!/bin/sh' "$1" >packed/bin/brittle
  chmod +x packed/bin/brittle
  echo 0 >packed/system/version
  echo part >packed/lib/part
  (cd packed && md5sum bin/brittle system/version lib/part >md5sums)
  XZ_OPT=-0 tar -C packed --force-local -cJf "$kit/programs.tar.xz" .
  cp /bin/busybox "$kit/busybox"
  sed "1s|.*|#!${KIT_SHELL:-/bin/sh}|; s/^limit=30$/limit=1/" "$source/tools/device_check/run.sh" >"$kit/run.sh"
  chmod +x "$kit/run.sh"
}
works='case $1 in devices) echo "0  card, driver: chosen" ;; *) echo "checks with $*" | tee "$5/results" ;; esac'
needs_part='[ -s "${0%/*}/../lib/part" ] || { echo "$0: error while loading shared libraries: part: file too short"; exit 127; }'
hangs='case $1 in devices) exec sleep 61.7 ;; esac'
no_device='echo "brittle: no usable device; this machine has no Vulkan device at all" >&2; exit 4'

# A busybox whose tar takes $1 seconds stands for a slow disk.
slow_tar() {
  printf '%s\n' '#!/bin/sh' "case \$1 in tar) sleep $1 ;; esac" 'exec /bin/busybox "$@"' >"$kit/busybox"
  chmod +x "$kit/busybox"
}
wait_until() { for _ in $(seq 50); do ! "$@" || return 0; sleep 0.1; done; }
unpacks() { [ -n "$(find "$kit" -name '*.new.*')" ]; }
searches() { pgrep -f 'sleep 61\.7' >pids; }
left_files() { find "$kit" -mindepth 1 -maxdepth 1 | grep -Ev '/(busybox|programs.tar.xz|run.sh|results|unpacked-[0-9a-f]{12})$'; }

# A file with the name of a kit's file makes no kit. In a kit, only names that run.sh makes are accepted.
gpu_check_keeps_files_of_others() {
  local pack=("$source/tools/gpu_check.sh" --no-build -o) name
  mkdir home
  echo mine >home/thesis.txt
  expect 2 "is no kit" "${pack[@]}" home
  touch home/programs.tar.xz
  echo "Read me" >home/README.txt
  expect 2 "is no kit" "${pack[@]}" home
  cp "$source/tools/device_check/kit_readme.txt" home/README.txt
  expect 2 "thesis.txt" "${pack[@]}" home
  check grep -q mine home/thesis.txt
  expect 2 "is no folder" "${pack[@]}" home/thesis.txt
  rm home/thesis.txt
  for name in unpacked-photos unpacked-0123456789ab.old compiled_by_me scratch-pad; do
    mkdir home/$name
    expect 2 "holds $name, which no kit has" "${pack[@]}" home
    check test -d home/$name
    rmdir home/$name
  done
  mkdir home/unpacked-0123456789ab
  cp /bin/sleep home/unpacked-0123456789ab/brittle
  home/unpacked-0123456789ab/brittle 60 &
  local check=$!
  expect 2 "is in use by a check" "${pack[@]}" home
  kill $check
  rm -r home/unpacked-0123456789ab
  mv home/programs.tar.xz elsewhere
  ln -s ../elsewhere home/programs.tar.xz
  expect 2 "programs.tar.xz is no file of a kit" "${pack[@]}" home
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
  make_kit "$no_device"
  expect 4 "install this GPU's Vulkan driver" kit/run.sh
}

# Starts run.sh, sends it signal $2 when $1 holds, and sets `code` to its exit code.
end_when() {
  "$kit/run.sh" >said 2>&1 &
  local shell=$!
  code=0
  wait_until "$1"
  check "$1"
  kill "-$2" "$shell"
  wait "$shell" 2>/dev/null || code=$?
  check test -z "$(pgrep -P "$shell")"
}

run_sh_leaves_nothing_when_it_is_ended() {
  make_kit "$works"
  slow_tar 60
  end_when unpacks TERM
  check test "$code" -eq 143
  check grep -qF "ended by signal TERM" said
  check test -z "$(left_files)"
  make_kit "$hangs"
  local signal
  for signal in HUP:129 TERM:143; do
    end_when searches "${signal%:*}"
    check test "$code" -eq "${signal#*:}"
    check grep -qF "ended by signal ${signal%:*}" said
    check test "$(wc -l <said)" -le 2
    check test -z "$(left_files)"
    check eval '! searches'
  done
}

# A driver may also crash, or hang with one loader and not with another.
run_sh_ends_a_driver_that_hangs() {
  make_kit "$hangs"
  expect 4 "the Vulkan driver hangs: \`brittle devices\` did not end in 1 s with this machine's Vulkan loader and the folder's" kit/run.sh
  check eval '! searches'
  check test -z "$(left_files)"
  make_kit 'case $1$LD_LIBRARY_PATH in devices*/vulkan*) ;; devices*) exec sleep 61.7 ;; esac;'"$works"
  expect 0 "checks with" kit/run.sh
  check grep -qF "warning: the Vulkan driver hangs with this machine's" said
  make_kit 'kill -SEGV $$'
  expect 4 "the Vulkan driver crashes" kit/run.sh
}

run_sh_unpacks_damaged_files_again() {
  make_kit "$needs_part
$works"
  expect 0 "checks with" kit/run.sh
  local unpacked
  unpacked=$(echo kit/unpacked-*)
  rm "$unpacked/lib/part"
  expect 0 "lib/part is damaged" kit/run.sh
  echo 'touch executed' >"$unpacked/bin/brittle"
  expect 0 "unpacking" kit/run.sh
  check test ! -e executed
  chmod -x "$unpacked/bin/brittle"
  expect 0 "bin/brittle is damaged" kit/run.sh
  check test -z "$(left_files)"
  make_kit 'echo "brittle: libX.so: version too old" >&2; exit 127'
  expect 4 "brittle cannot be started, though its files are intact: libX.so" kit/run.sh
}

# A kit below a folder with a colon unpacks to $TMPDIR.
run_sh_says_why_a_folder_cannot_take_programs() {
  kit=a:b/kit
  make_kit "$works"
  mkdir temporary
  expect 0 "unpacking to $PWD/temporary/unpacked-" env TMPDIR="$PWD/temporary" $kit/run.sh
  expect 2 "$PWD/a:b/kit has a colon" env TMPDIR="$PWD/a:b" $kit/run.sh
  expect 2 "nowhere is not a folder" env TMPDIR="$PWD/nowhere" $kit/run.sh
  if [ "$(id -u)" = 0 ] && chown 4321 temporary/unpacked-* 2>/dev/null; then
    expect 2 "of another user" env TMPDIR="$PWD/temporary" $kit/run.sh
  fi
  if unshare --mount --map-root-user true 2>/dev/null; then
    mkdir small
    in_small() { unshare --mount --map-root-user sh -c 'mount -t tmpfs -o '"$1"' small small && TMPDIR=$PWD/small '"$kit/run.sh"; }
    expect 2 "noexec" in_small noexec
    expect 2 "MB are left" in_small size=1m
    kit=small/kit
    rm -rf small/kit
    expect 2 "busybox may not be executed, because $PWD/small is mounted noexec" unshare --mount --map-root-user sh -c \
      'mount -t tmpfs small small && cp -r a:b/kit small/ && mount -o remount,noexec small && '"${KIT_SHELL:-sh}"' small/kit/run.sh'
  fi
  kit=kit
  make_kit "$works"
  head -c 5000 /bin/busybox >kit/busybox
  expect 2 "busybox is damaged" kit/run.sh
  : >kit/busybox
  expect 2 "busybox is empty" kit/run.sh
}

run_sh_works_without_a_reader() {
  make_kit "sleep 0.1
$works"
  { kit/run.sh 2>&1 || true; } | true
  wait_until test -f kit/results
  check grep -q "checks with" kit/results
  rm kit/results
  expect 0 "ended with 0" sh -c '(kit/run.sh <&- >&-); echo "ended with $?"'
  check grep -q "checks with" kit/results
  expect 0 "ended with 0" sh -c '(kit/run.sh <&- >&- 2>&-); echo "ended with $?"'
}

run_sh_may_run_twice_at_once() {
  make_kit "$works"
  slow_tar 0.5
  local code=0 first
  kit/run.sh >said_first 2>&1 &
  first=$!
  expect 0 "unpacking" kit/run.sh
  wait "$first" || code=$?
  check test "$code" -eq 0
  check grep -q "unpacking" said_first
  check test "$(find kit -name 'unpacked-*' | wc -l)" -eq 1
}

# A kit that is killed leaves a half unpacked folder. Folders of living processes, of other machines and of the user stay.
run_sh_removes_what_a_killed_one_left() {
  make_kit "$works"
  slow_tar 0.7
  end_when unpacks KILL
  check unpacks
  mkdir -p "kit/unpacked-0123456789ab.new.$$" kit/unpacked-0123456789ab.new.999999999 kit/unpacked-photos.2026.new.999999999
  echo "elsewhere pid:[1]" >kit/unpacked-0123456789ab.new.999999999/maker
  expect 0 "checks with" kit/run.sh
  check test "$(find kit -name '*.new.*' | wc -l)" -eq 3
  rm -r kit/unpacked-*.new.*
  make_kit "$hangs"
  end_when searches KILL
  sleep 0.3
  check eval '! searches'
  check test -z "$(left_files)"
}

run_sh_gives_some_options_itself() {
  make_kit "$works"
  expect 0 "run.sh gives --kit, --loader and --library-path itself" kit/run.sh --help
  local option
  for option in --kit --loader=/lib/ld.so --library-path; do expect 2 "${option%=*} cannot be given" kit/run.sh $option x; done
}

# $TESTS: only these.
for test in ${TESTS:-gpu_check_keeps_files_of_others run_sh_unpacks_whole run_sh_says_what_is_wrong run_sh_explains_a_missing_device \
  run_sh_leaves_nothing_when_it_is_ended run_sh_ends_a_driver_that_hangs run_sh_unpacks_damaged_files_again \
  run_sh_says_why_a_folder_cannot_take_programs run_sh_works_without_a_reader run_sh_may_run_twice_at_once \
  run_sh_removes_what_a_killed_one_left run_sh_gives_some_options_itself}; do
  echo "$test $SECONDS"
  $test
done
exit "$failed"
