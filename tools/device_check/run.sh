#!/bin/sh
# run.sh [OPTION...]: checks Brittle on this machine's Vulkan device, in at most six minutes. Options are those of
# `brittle check-device`, except --kit, --loader and --library-path, which this script gives itself.
# -o DIR says where the results go, this folder if not given. Without a shell on the machine: ./busybox sh run.sh
#
# The script needs the kernel, /dev/null and the busybox beside it. It works in three steps:
#   unpack       programs.tar.xz to unpacked-<12 hex digits>, beside the script or in $TMPDIR
#   find_device  tries `brittle devices` with each Vulkan loader, in a process with a time limit
#   the check    replaces this shell
set -u
trap '' PIPE # If the reader of the output has gone, the check goes on: its files count.

complain() { printf '%s\n' "run.sh: $*" >&2; }
give_up() {
  code=$1
  shift
  complain "$*"
  exit "$code"
}
[ -c /dev/null ] || give_up 4 "/dev/null is missing; mount /dev before the check"
exec </dev/null
true 3>&2 || exec 2>/dev/null # if it is closed, a driver's file would take its number
{ true 3>&1; } 2>/dev/null || exec >/dev/null
exec 5>&2 # a signal may come while 2 is redirected

script=$0
[ ! -L "$script" ] || script=$(readlink -f -- "$script") || give_up 2 "the link $0 cannot be followed; run the script in its own folder"
kit=${script%/*}
[ "$kit" != "$script" ] || kit=.
kit=$(CDPATH='' cd -- "$kit" && pwd) || exit 2
temporary=${TMPDIR:-/tmp}
case $temporary in /*) ;; *) temporary=$PWD/$temporary ;; esac
box() { "$kit/busybox" "$@"; }

# Sets `mount` to the mount point that holds the folder $1, if it is mounted noexec. Returns 1 if it is not, or if that is unknown.
find_noexec() {
  mount= mounted=
  [ -r /proc/mounts ] || return 1
  while read -r _ point _ settings _; do
    [ "$point" = / ] || case $1/ in "$point"/*) ;; *) continue ;; esac
    [ ${#point} -lt ${#mount} ] || mount=$point mounted=$settings
  done </proc/mounts
  case ,$mounted, in *,noexec,*) return 0 ;; *) return 1 ;; esac
}

# Says why the files of this folder cannot be used, if they cannot.
check_files() {
  for file in busybox programs.tar.xz; do
    [ -f "$kit/$file" ] || give_up 2 "$file is missing in $kit; copy the whole folder again"
    [ -r "$kit/$file" ] || give_up 2 "$kit/$file cannot be read by this user"
    [ -s "$kit/$file" ] || give_up 2 "$kit/$file is empty; copy the whole folder again"
  done
  [ "$(box echo runs 2>/dev/null)" != runs ] || return 0
  ! find_noexec "$kit" || give_up 2 "$kit/busybox may not be executed, because $mount is mounted noexec; copy the folder to another disk"
  [ -x "$kit/busybox" ] || give_up 2 "$kit/busybox may not be executed; try chmod +x, or copy the folder to another disk"
  machine=$(uname -m 2>/dev/null || echo unknown)
  [ "$machine" != x86_64 ] || give_up 2 "$kit/busybox is damaged, or this machine forbids to execute it; copy the whole folder again"
  give_up 4 "$kit/busybox does not run here; the programs are for x86-64 Linux, and this machine is $machine"
}

# Sets `device` to what --device says, `output` and `results` to the folder for results without and with -o, `helps` if only help is
# wanted, and `limit` to the seconds that a search for a device may take.
limit=30
spent=0 # s, on searches that hung
read_options() {
  device= helps=false before= scale=1
  output=$kit
  [ -w "$kit" ] || output=.
  results=$output
  for word in "$@"; do
    case $before in
      --device) device=$word ;;
      --limit-scale) scale=$word ;;
      -o | --output) results=$word ;;
    esac
    case $word in
      --kit | --kit=* | --loader | --loader=* | --library-path | --library-path=*)
        give_up 2 "${word%%=*} cannot be given: run.sh gives it itself. run.sh --help lists the options" ;;
      --device=*) device=${word#*=} ;;
      --limit-scale=*) scale=${word#*=} ;;
      --output=*) results=${word#*=} ;;
      -o?*) results=${word#-o} ;;
      -h | --help) helps=true ;;
    esac
    before=$word
  done
  limit=$(box awk -v scale="$scale" -v limit=$limit 'BEGIN { print int(limit * (scale + 0 > 1 && scale + 0 <= 100 ? scale : 1)) }')
}

# One program at a time runs in the background as `worker`, so that signals and time limits reach this script meanwhile.
# `guard` ends it if this script is killed.
worker= guard= new=
start() {
  "$@" &
  worker=$!
  watch "$worker" >/dev/null 2>&1 5>&- &
  guard=$!
}
watch() {
  while kill -0 "$$" && kill -0 "$1"; do box usleep 50000; done
  kill -0 "$$" || kill -KILL "$1"
}

# Returns 1 if the worker still runs after $1 ticks of 50 ms. -1: no limit.
ends_within() {
  ticks=$1
  while kill -0 "$worker" 2>/dev/null; do
    [ "$ticks" -ne 0 ] || return 1
    box usleep 50000
    ticks=$((ticks - 1))
  done
}

# Waits for the worker, $1 ticks at most. Sets `code` to its exit code, to `hangs`, or to `stuck` if it cannot even be killed.
attend() {
  if ends_within "$1"; then
    wait "$worker"
    code=$?
    wait "$guard"
    worker=
    return
  fi
  code=hangs
  end_worker 2>/dev/null || code=stuck
}

# Kills the worker. Returns 1 if it does not end, because its driver waits in the kernel.
end_worker() {
  [ -n "$worker" ] || return 0
  kill -KILL "$worker" 2>/dev/null
  ended=0
  ends_within 20 || ended=1
  [ $ended -eq 0 ] || kill "$guard" 2>/dev/null
  wait "$guard" 2>/dev/null
  worker=
  return $ended
}

# Leaves no program that goes on, and no half unpacked folder.
clean_up() {
  end_worker 2>/dev/null
  [ -z "$new" ] || box rm -rf "$new"
}
end_by_signal() {
  trap '' HUP INT TERM
  complain "ended by signal $1 before the check began, results until now are in $results" 2>&5
  exit "$2"
}
trap clean_up EXIT
trap 'end_by_signal HUP 129' HUP
trap 'end_by_signal INT 130' INT
trap 'end_by_signal TERM 143' TERM

# Notes that `folder` cannot take the programs, and why.
refused=
refuse() {
  refused="$refused${refused:+; }$folder $*"
  return 1
}

# `rejected` is a folder whose files turned out to be damaged.
rejected=
is_ours() { [ "$folder" = "$kit" ] || [ -O "$programs" ]; }
is_usable() { [ "$programs" != "$rejected" ] && [ -f "$programs/complete" ] && [ -f "$programs/bin/brittle" ] && is_ours && is_whole; }
# A shell would run a truncated program as a script. So `complete` holds its size.
is_whole() { [ "$(box cat "$programs/complete")" = "$(box stat -c %s "$programs/bin/brittle")" ]; }

# Process ids mean nothing on another machine or in another container, which may share this folder.
maker() { echo "$(box uname -n) $(box readlink /proc/self/ns/pid)"; }

# Removes folders that a killed run.sh of this user and machine has left half unpacked.
remove_leftovers() {
  for left in "$folder"/unpacked-????????????.new.*; do
    [ -d "$left" ] && [ ! -L "$left" ] && [ -O "$left" ] || continue
    digits=${left##*/unpacked-}
    process=${digits#*.new.}
    case ${digits%%.*}/$process in *[!0-9a-f]*/* | */ | */*[!0-9]*) continue ;; esac
    [ "$process" -eq $$ ] || ! kill -0 "$process" 2>/dev/null || continue
    [ -s "$left/maker" ] || box rm -f "$left/maker" # killed right at the beginning
    if [ "$(box cat "$left/maker" 2>/dev/null)" = "$(maker)" ]; then box rm -rf "$left"; else box rmdir "$left" 2>/dev/null; fi
  done
}

unpack_archive() { exec "$kit/busybox" tar -xJf "$kit/programs.tar.xz" -C "$new" 5>&-; }

# Unpacks to $new. The file `complete` is written last: a folder without it is not used.
needed=110 # MB
unpack_new() {
  maker >"$new/maker" 2>/dev/null && box cp "$kit/busybox" "$new/busybox" 2>/dev/null || { refuse_for_room "cannot be written to"; return; }
  "$new/busybox" true 2>/dev/null || { refuse "does not let programs be executed; it may be mounted noexec"; return; }
  box rm "$new/busybox"
  complain "unpacking to $programs"
  start unpack_archive
  attend -1
  [ "$code" -eq 0 ] && [ -f "$new/bin/brittle" ] && box stat -c %s "$new/bin/brittle" 2>/dev/null >"$new/complete" ||
    refuse_for_room "could not take all files"
}
refuse_for_room() {
  free=$(box df -Pk "$folder" 2>/dev/null | box awk 'NR == 2 { print int($4 / 1024) }')
  [ "${free:-$needed}" -ge $needed ] || { refuse "has no room: $needed MB are needed, and $free MB are left"; return; }
  refuse "$*"
}

# Moves $new to its place. Of several that unpack at a time, the first does this; a damaged folder is replaced.
put_in_place() {
  ! box mv -T "$new" "$programs" 2>/dev/null || { rejected=; return; }
  ! is_usable || return 0
  box mv -T "$programs" "$new/replaced" 2>/dev/null
  if [ "$programs" != "$rejected" ] && (programs=$new/replaced && is_whole) 2>/dev/null; then
    box mv -T "$new/replaced" "$programs" # another process was faster
  elif box mv -T "$new" "$programs" 2>/dev/null; then
    rejected=
    box rm -rf "$programs/replaced"
  fi
  is_usable || refuse "holds unpacked-$name, which is damaged and cannot be replaced by this user; remove it"
}

# Unpacks below `folder`, or returns 1 and says why not in `refused`.
unpack_here() {
  programs=$folder/unpacked-$name
  case $folder in *[:\;]*) refuse "has a colon or a semicolon in its path, at which lists of libraries are split"; return ;; esac
  [ -d "$folder" ] || { refuse "is not a folder"; return; }
  remove_leftovers
  ! is_usable || return 0
  if [ -e "$programs" ] && ! is_ours; then
    refuse "holds unpacked-$name of another user; remove it, or set TMPDIR to a folder of yours"
    return
  fi
  box mkdir "$programs.new.$$" 2>/dev/null || { refuse_for_room "cannot be written to"; return; }
  new=$programs.new.$$
  unpack_new && put_in_place
  unpacked=$?
  box rm -rf "$new"
  new=
  return $unpacked
}

# Unpacks the programs once: beside this script, or if that is not possible, in a folder for temporary files. A folder of another
# user is not used there.
unpack() {
  name=$(box md5sum <"$kit/programs.tar.xz" | box cut -c1-12)
  refused=
  for folder in "$kit" "$temporary"; do
    ! unpack_here || return 0
    [ "$kit" != "$temporary" ] || break
  done
  box xzcat "$kit/programs.tar.xz" >/dev/null 2>&1 || give_up 2 "$kit/programs.tar.xz is damaged; copy the folder again"
  give_up 2 "the programs cannot be unpacked: $refused. TMPDIR=DIR run.sh unpacks to another folder"
}

# Returns 1 and sets `damaged` to a file that is not as it was packed.
is_intact() {
  damaged=$(cd "$programs" && box md5sum -c md5sums 2>&1 |
    box sed -n -e 's/: FAILED.*//p' -e "s/.*open 'md5sums'.*/md5sums/p" | box head -n 1)
  for program in "$programs"/bin/* "$programs"/system/ld-linux*; do
    case $(box stat -c %A "$program" 2>/dev/null) in *x* | "") ;; *) damaged=${damaged:-${program#"$programs/"}} ;; esac
  done
  [ -z "$damaged" ]
}

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
    [ -e "$file" ] || continue
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
  if [ "$(machine_glibc)" -lt "$(as_number "$(box cat "$programs/system/version" 2>/dev/null)")" ]; then
    loader=$programs/system/ld-linux-x86-64.so.2
    libraries=$libraries:$programs/cxx:$programs/system
  elif [ "$theirs" -lt "$ours" ]; then
    libraries=$libraries:$programs/cxx
  fi
}

# Replaces this shell by `brittle` with the libraries in $1, so that signals reach it.
become_brittle() {
  path=$1
  shift
  if [ -n "$loader" ]; then
    exec "$loader" --library-path "$path:$machine_libraries" "$programs/bin/brittle" "$@"
  else
    exec "$kit/busybox" env LD_LIBRARY_PATH="$path${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}" "$programs/bin/brittle" "$@"
  fi
}

# Opens a file that has no name, so that it never stays: 3 writes to it, 4 reads it.
open_note() {
  for place in "$temporary" "$kit" "$programs" .; do
    note=$(box mktemp "$place/run-XXXXXX" 2>/dev/null) || continue
    if echo room 2>/dev/null >"$note"; then
      exec 3>"$note" 4<"$note"
      box rm -f "$note"
      return
    fi
    box rm -f "$note"
  done
  give_up 2 "no file can be written in $temporary, $kit or $PWD: the disk is full, or this user may not write there; set TMPDIR"
}

# Runs `brittle devices` with the libraries in $1, for `limit` seconds. Sets `said` to its output, and `code`.
become_search() { become_brittle "$1" devices ${device:+--device "$device"} >&3 2>&3 3>&- 4<&- 5>&-; }
search() {
  open_note
  start become_search "$1"
  attend $((limit * 20))
  said=$(box head -c 65536 <&4)
  exec 3>&- 4<&-
}

# Sets `chosen` to libraries with which a GPU is found, else with which any device is. The machine's own loader comes first.
# `hung` and `crashed` say with which loaders `brittle` did not end by itself.
find_device() {
  chosen= said= hung= crashed= is_stuck=false
  for way in "this machine's Vulkan loader" "the folder's Vulkan loader" "NVIDIA's driver in /usr/local/nvidia"; do
    libraries_now=$libraries:$programs/vulkan
    case $way in
      this*) libraries_now=$libraries ;;
      NVIDIA*)
        manifest=/usr/local/nvidia/share/vulkan/icd.d/nvidia_icd.json
        [ -f $manifest ] && [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || continue
        export VK_DRIVER_FILES=$manifest VK_ICD_FILENAMES=$manifest ;;
    esac
    search "$libraries_now"
    line=$(printf '%s\n' "$said" | box grep ': chosen')
    case $code in
      hangs) hung="$hung${hung:+ and }$way" line= spent=$((spent + limit)) ;;
      stuck) hung="$hung${hung:+ and }$way" line= is_stuck=true spent=$((spent + limit)) ;;
      *) [ "$code" -le 128 ] || crashed="$crashed${crashed:+ and }signal $((code - 128)) with $way" line= ;;
    esac
    case $line in
      "") ;;
      *"(CPU)"*) [ -n "$chosen" ] || chosen=$libraries_now found=$line ;;
      *) chosen=$libraries_now found=$line; break ;;
    esac
    case $way in NVIDIA*) unset VK_DRIVER_FILES VK_ICD_FILENAMES ;; esac
  done
  [ -n "$chosen" ] || return 1
  [ -z "$hung" ] || complain "warning: the Vulkan driver hangs with $hung"
  [ -z "$crashed" ] || complain "warning: the Vulkan driver crashes, $crashed"
}

# Unpacks again if a file is not as it was packed: a damaged test or model would look like a fault of the device.
repair() {
  ! is_intact || return 0
  complain "$programs/$damaged is damaged"
  box rm -f "$programs/complete" 2>/dev/null
  rejected=$programs
  unpack
}

# Says why `brittle` does not run, if it does not.
explain_no_start() {
  is_intact || give_up 2 "$programs/$damaged is damaged right after unpacking; the disk or the memory may be faulty"
  case $code in
    126)
      ! find_noexec "$programs" || give_up 2 "$programs/bin/brittle may not be executed, because $mount is mounted noexec;" \
        "TMPDIR=DIR run.sh unpacks to another folder"
      give_up 2 "$programs/bin/brittle may not be executed: $reason" ;;
    127) give_up 4 "brittle cannot be started, though its files are intact: $reason." \
      "A library of this machine may not fit; LD_LIBRARY_PATH and LD_PRELOAD are used" ;;
  esac
}

# Says why there is no device, and what to do about it.
explain_no_device() {
  reason=$(printf '%s\n' "$said" | box sed -n 's/^brittle: //p' | box tail -n 1)
  : "${reason:=$said}"
  if [ -n "$hung" ]; then
    ! $is_stuck || complain "a process that uses the driver cannot be ended: it waits in the kernel. A restart of the machine may help"
    give_up 4 "the Vulkan driver hangs: \`brittle devices\` did not end in $limit s with $hung." \
      "The kernel's log may say why; --limit-scale 4 gives four times as long"
  fi
  case $reason in
    *BRITTLE_DEVICE_WITHOUT*) give_up 2 "$reason" ;;
    *"this machine has no Vulkan device"*) ;;
    *"no usable device matches"*) give_up 4 "$reason; --device or BRITTLE_DEVICE asks for this device" ;;
    *) explain_no_start ;;
  esac
  [ -z "$crashed" ] || give_up 4 "the Vulkan driver crashes: \`brittle devices\` was ended by $crashed. Install the driver again"
  complain "no Vulkan device can be used: $reason"
  manifests=${VK_DRIVER_FILES:-${VK_ICD_FILENAMES:-}}
  [ -z "$manifests" ] || complain "drivers are taken from $manifests alone, because VK_DRIVER_FILES or VK_ICD_FILENAMES says so"
  for file in /dev/nvidia[0-9]* /dev/nvidiactl /dev/dri/renderD*; do
    [ ! -c "$file" ] || { [ -r "$file" ] && [ -w "$file" ]; } || complain "this user cannot open $file; a group such as video or render may"
  done
  give_up 4 "install this GPU's Vulkan driver; drivers are listed in /usr/share/vulkan/icd.d or \$VK_DRIVER_FILES"
}

check_files
[ "$(box uname -m)" = x86_64 ] || give_up 4 "the programs are for x86-64, this machine is $(box uname -m)"
read_options "$@"
unpack
$helps || repair
choose_libraries
if $helps; then
  chosen=$libraries
  printf '%s\n' "run.sh gives --kit, --loader and --library-path itself, and -o with this folder. The other options can be given:" "" 2>/dev/null
elif find_device; then
  printf '%s\n' "device: $found" 2>/dev/null
else
  explain_no_device
fi
exec 5>&-
if [ -n "$loader" ]; then
  become_brittle "$chosen" check-device --kit "$programs" -o "$output" --spent "$spent" \
    --loader "$loader" --library-path "$chosen:$machine_libraries" "$@"
else
  become_brittle "$chosen" check-device --kit "$programs" -o "$output" --spent "$spent" "$@"
fi
