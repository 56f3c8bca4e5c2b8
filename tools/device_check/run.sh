#!/bin/sh
# run.sh [OPTION...]: checks Brittle on this machine's Vulkan device, in at most six minutes. Options are those of
# `brittle check-device`; -o DIR says where the results go, this folder if not given.
# Without a shell on the machine: ./busybox sh run.sh
set -u

complain() { echo "run.sh: $*" >&2; }
give_up() {
  code=$1
  shift
  complain "$*"
  exit "$code"
}
script=$0
[ ! -L "$script" ] || script=$(readlink -f -- "$script") || give_up 2 "the link $0 cannot be followed; run the script in its own folder"
kit=${script%/*}
[ "$kit" != "$script" ] || kit=.
kit=$(CDPATH='' cd -- "$kit" && pwd) || exit 2
box() { "$kit/busybox" "$@"; }

# Says why the files of this folder cannot be used, if they cannot.
check_files() {
  for file in busybox programs.tar.xz; do
    [ -e "$kit/$file" ] || give_up 2 "$file is missing in $kit; copy the whole folder again"
    [ -r "$kit/$file" ] || give_up 2 "$kit/$file cannot be read by this user"
  done
  ! box true 2>/dev/null || return 0
  [ -x "$kit/busybox" ] || give_up 2 "$kit/busybox may not be executed; try chmod +x, or copy the folder to a disk that is not mounted noexec"
  give_up 4 "$kit/busybox does not run here; the programs are for x86-64 Linux, and this machine is $(uname -m 2>/dev/null || echo unknown)"
}

# Leaves no half unpacked folder, and no program that goes on unpacking.
new= worker=
clean_up() {
  [ -z "$worker" ] || kill "$worker" 2>/dev/null && wait "$worker" 2>/dev/null
  [ -z "$new" ] || box rm -rf "$new"
}
trap clean_up EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM

# Unpacks to $new. The file `complete` is written last: a folder without it is not used.
unpack_new() {
  box tar -xJf "$kit/programs.tar.xz" -C "$new" &
  worker=$!
  wait "$worker" && [ -f "$new/bin/brittle" ] && echo complete >"$new/complete"
  unpacked=$?
  worker=
  return $unpacked
}

# Unpacks the programs once: beside this script, or if that cannot be written to, in a folder for temporary files. Of several
# that unpack at a time, the first puts its folder in place. A folder of another user is not used.
unpack() {
  name=$(box md5sum <"$kit/programs.tar.xz" | box cut -c1-12)
  for folder in "$kit" "${TMPDIR:-/tmp}"; do
    programs=$folder/unpacked-$name
    ! is_usable || return 0
    box mkdir -p "$programs.new.$$" 2>/dev/null || continue
    new=$programs.new.$$
    complain "unpacking to $programs"
    if unpack_new; then
      ! is_ours || is_usable || box rm -rf "$programs"
      [ -e "$programs" ] || box mv "$new" "$programs" 2>/dev/null
    fi
    box rm -rf "$new"
    new=
    ! is_usable || return 0
  done
  box xzcat "$kit/programs.tar.xz" >/dev/null 2>&1 || give_up 2 "$kit/programs.tar.xz is damaged; copy the folder again"
  give_up 2 "the programs cannot be unpacked: there are no 110 MB in $kit or ${TMPDIR:-/tmp}, or the folders cannot be written to"
}

is_ours() { [ "$folder" = "$kit" ] || [ -O "$programs" ]; }
is_usable() { [ -f "$programs/complete" ] && [ -f "$programs/bin/brittle" ] && is_ours; }

# 236 of glibc 2.36; 0 if there is no version.
as_number() {
  case $1 in
    [0-9]*.[0-9]*) minor=${1#*.}; echo $((${1%%.*} * 100 + ${minor%%.*})) ;;
    *) echo 0 ;;
  esac
}

machine_glibc() {
  [ -x /lib64/ld-linux-x86-64.so.2 ] || { echo 0; return; }
  as_number "$(/lib64/ld-linux-x86-64.so.2 --version 2>/dev/null | box sed -n '1s/.* \([0-9.]*[0-9]\)\.*$/\1/p')"
}

# The number behind libstdc++.so.6.0. in these folders; 0 if no file exists.
newest_cxx() {
  newest=0
  for file in "$@"; do
    number=$(box readlink -f "$file" 2>/dev/null | box sed -n 's/.*libstdc++\.so\.6\.0\.\([0-9]*\)$/\1/p')
    [ -z "$number" ] || [ "$number" -le "$newest" ] || newest=$number
  done
  echo "$newest"
}

# Drivers of this machine want its C and C++ libraries, or newer ones. So the newer ones are used of each.
machine_libraries=/usr/lib/x86_64-linux-gnu:/lib/x86_64-linux-gnu:/usr/lib64:/lib64:/usr/local/nvidia/lib64
choose_libraries() {
  libraries=$programs/lib
  ours=$(newest_cxx "$programs"/cxx/libstdc++.so.6.0.*)
  theirs=$(newest_cxx /usr/lib/x86_64-linux-gnu/libstdc++.so.6 /lib/x86_64-linux-gnu/libstdc++.so.6 /usr/lib64/libstdc++.so.6 /lib64/libstdc++.so.6)
  loader=
  if [ "$(machine_glibc)" -lt "$(as_number "$(box cat "$programs/system/version")")" ]; then
    loader=$programs/system/ld-linux-x86-64.so.2
    libraries=$libraries:$programs/cxx:$programs/system
  elif [ "$theirs" -lt "$ours" ]; then
    libraries=$libraries:$programs/cxx
  fi
}

# Runs `brittle` with the libraries in $1. With `in_place=exec` it takes the place of this shell, and signals reach it.
in_place=
brittle() {
  path=$1
  shift
  if [ -n "$loader" ]; then
    $in_place "$loader" --library-path "$path:$machine_libraries" "$programs/bin/brittle" "$@"
  else
    $in_place "$kit/busybox" env LD_LIBRARY_PATH="$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$programs/bin/brittle" "$@"
  fi
}

# Sets `device` to what --device says, and `helps` if only help is wanted.
read_options() {
  device= helps=false before=
  for word in "$@"; do
    [ "$before" != --device ] || device=$word
    case $word in
      --device=*) device=${word#*=} ;;
      -h | --help) helps=true ;;
    esac
    before=$word
  done
}

# Sets `chosen` to libraries with which a GPU is found, else with which any device is. The machine's own loader comes first.
find_device() {
  chosen= said=
  for way in machine kit nvidia; do
    [ $way = machine ] || libraries_now=$libraries:$programs/vulkan
    [ $way != machine ] || libraries_now=$libraries
    if [ $way = nvidia ]; then
      manifest=/usr/local/nvidia/share/vulkan/icd.d/nvidia_icd.json
      [ -f $manifest ] && [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || continue
      export VK_DRIVER_FILES=$manifest VK_ICD_FILENAMES=$manifest
    fi
    said=$(brittle "$libraries_now" devices ${device:+--device "$device"} 2>&1)
    line=$(echo "$said" | box grep ': chosen')
    case $line in
      "") ;;
      *"(CPU)"*) [ -n "$chosen" ] || chosen=$libraries_now found=$line ;;
      *) chosen=$libraries_now found=$line; return 0 ;;
    esac
    [ $way != nvidia ] || unset VK_DRIVER_FILES VK_ICD_FILENAMES
  done
  [ -n "$chosen" ]
}

# Says why there is no device, and what to do about it.
explain_no_device() {
  reason=$(echo "$said" | box sed -n 's/^brittle: //p' | box tail -n 1)
  : "${reason:=$said}"
  case $reason in
    *BRITTLE_DEVICE_WITHOUT*) give_up 2 "$reason" ;;
    *"this machine has no Vulkan device"*) ;;
    *"no usable device matches"*) give_up 4 "$reason; --device or BRITTLE_DEVICE asks for this device" ;;
  esac
  complain "no Vulkan device can be used: $reason"
  manifests=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}
  [ -z "$manifests" ] || complain "drivers are taken from $manifests alone, because VK_DRIVER_FILES or VK_ICD_FILENAMES says so"
  give_up 4 "install this GPU's Vulkan driver; drivers are listed in /usr/share/vulkan/icd.d or \$VK_DRIVER_FILES"
}

check_files
[ "$(box uname -m)" = x86_64 ] || give_up 4 "the programs are for x86-64, this machine is $(box uname -m)"
read_options "$@"
unpack
choose_libraries
if $helps; then
  chosen=$libraries
elif find_device; then
  echo "device: $found"
else
  explain_no_device
fi
output=$kit
[ -w "$kit" ] || output=.
in_place=exec
if [ -n "$loader" ]; then
  brittle "$chosen" check-device --kit "$programs" -o "$output" --loader "$loader" --library-path "$chosen:$machine_libraries" "$@"
else
  brittle "$chosen" check-device --kit "$programs" -o "$output" "$@"
fi
