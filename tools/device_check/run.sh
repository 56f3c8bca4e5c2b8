#!/bin/sh
# run.sh [OPTION...]: checks Brittle on this machine's Vulkan device, in at most six minutes. Options are those of
# `brittle check-device`; -o DIR says where the results go, this folder if not given.
# Without a shell on the machine: ./busybox sh run.sh
set -u

complain() { echo "run.sh: $*" >&2; }
kit=${0%/*}
[ "$kit" != "$0" ] || kit=.
kit=$(CDPATH='' cd -- "$kit" && pwd) || exit 2
if [ ! -x "$kit/busybox" ] || [ ! -f "$kit/programs.tar.xz" ]; then
  complain "busybox or programs.tar.xz is missing in $kit; run the script in its own folder, not through a link"
  exit 2
fi
box() { "$kit/busybox" "$@"; }

# Unpacks the programs once: beside this script, or if that cannot be written to, in a folder for temporary files. Of several
# that unpack at a time, the first puts its folder in place. A folder of another user is not used.
unpack() {
  name=$(box md5sum <"$kit/programs.tar.xz" | box cut -c1-12)
  for folder in "$kit" "${TMPDIR:-/tmp}"; do
    programs=$folder/unpacked-$name
    ! is_usable || return 0
    box mkdir -p "$programs.new.$$" 2>/dev/null || continue
    complain "unpacking to $programs"
    if box tar -xJf "$kit/programs.tar.xz" -C "$programs.new.$$"; then
      [ -e "$programs" ] || box mv "$programs.new.$$" "$programs" 2>/dev/null
    fi
    box rm -rf "$programs.new.$$"
    ! is_usable || return 0
  done
  complain "the programs cannot be unpacked: programs.tar.xz is damaged, or there are no 110 MB in $kit or ${TMPDIR:-/tmp}"
  exit 2
}

is_usable() { [ -f "$programs/bin/brittle" ] && { [ "$folder" = "$kit" ] || [ -O "$programs" ]; }; }

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

# Runs `brittle` with the libraries in $1.
brittle() {
  path=$1
  shift
  if [ -n "$loader" ]; then
    "$loader" --library-path "$path:$machine_libraries" "$programs/bin/brittle" "$@"
  else
    LD_LIBRARY_PATH=$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$programs/bin/brittle" "$@"
  fi
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
    said=$(brittle "$libraries_now" devices 2>&1)
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

[ "$(box uname -m)" = x86_64 ] || { complain "the programs are for x86-64, this machine is $(box uname -m)"; exit 4; }
unpack
choose_libraries
if ! find_device; then
  complain "no Vulkan device can be used: $said"
  manifests=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}
  [ -z "$manifests" ] || complain "drivers are taken from $manifests alone, because VK_DRIVER_FILES or VK_ICD_FILENAMES says so"
  complain "install this GPU's Vulkan driver; drivers are listed in /usr/share/vulkan/icd.d or \$VK_DRIVER_FILES"
  exit 4
fi
echo "device: $found"
output=$kit
[ -w "$kit" ] || output=.
if [ -n "$loader" ]; then
  brittle "$chosen" check-device --kit "$programs" -o "$output" --loader "$loader" --library-path "$chosen:$machine_libraries" "$@"
else
  brittle "$chosen" check-device --kit "$programs" -o "$output" "$@"
fi
