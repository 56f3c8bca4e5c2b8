#!/usr/bin/env bash
# tools/gpu_check.sh [-o DIR] [--no-build] [--small]: packs a folder that checks Brittle on any x86-64 Linux machine with a Vulkan driver.
# The machine needs nothing else: no packages, no compiler, no network, no root. DIR is out/gpu-check of this tree if not given.
#
# DIR/run.sh unpacks programs.tar.xz beside itself and runs `brittle check-device`. See modules/brittle/docs/checking_a_gpu.md.
# --small packs a part of the models and scenes, and no validation layer: for the test of the folder itself.
# The expected fragments and scene states come from this machine's device, which should be Mesa's lavapipe.
# DIR must be new, empty, or an earlier folder of this script with nothing else in it. Results of earlier checks stay there.
set -euo pipefail
called_in=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { echo "usage: tools/gpu_check.sh [-o DIR] [--no-build] [--small]"; }
say() { echo "gpu_check: $*" >&2; }
refuse() {
  say "$*"
  exit 2
}
misused() {
  usage >&2
  exit 2
}

out= build=true small=false
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) usage; exit 0 ;;
    -o) [ $# -ge 2 ] && [ -n "$2" ] || misused; out=$2; shift 2 ;;
    --no-build) build=false; shift ;;
    --small) small=true; shift ;;
    *) misused ;;
  esac
done
case $out in "") out=out/gpu-check ;; /*) ;; *) out=$called_in/$out ;; esac

# The first line of a kit's README.txt is its mark; earlier kits have it, too.
readme=tools/device_check/kit_readme.txt
is_kit() { [ -f "$out/README.txt" ] && [ "$(head -n 1 "$out/README.txt")" = "$(head -n 1 "$readme")" ]; }

# Names of folders that run.sh unpacks to. They are removed when the programs change.
is_unpacked() { [[ $1 =~ ^unpacked-[0-9a-f]{12}(\.new\.[0-9]+)?$ ]]; }
is_result() { [[ $1 =~ ^results\.(json|html)(\.[0-9]+|\.part[0-9]+)?$ || $1 =~ ^compiled(-[0-9]+)?$ || $1 =~ ^scratch-[A-Za-z0-9]{6}$ ]]; }

# Refuses a folder that holds anything but an earlier kit and the results of its runs: packing replaces files there.
check_folder() {
  [ -e "$out" ] || [ -L "$out" ] || return 0
  [ -d "$out" ] || refuse "$out is no folder; give another one with -o"
  local name
  while IFS= read -r -d '' name; do
    is_kit || refuse "$out holds files and is no kit: README.txt of a kit is missing; give a new or an empty folder with -o"
    case $name in
      busybox | programs.tar.xz | run.sh | README.txt)
        [ -f "$out/$name" ] && [ ! -L "$out/$name" ] ||
          refuse "$out/$name is no file of a kit; move it away, or give another folder with -o" ;;
      *)
        is_unpacked "$name" || is_result "$name" ||
          refuse "$out holds $name, which no kit has; move it away, or give another folder with -o" ;;
    esac
  done < <(find "$out/" -mindepth 1 -maxdepth 1 -printf '%f\0')
  [ -z "$(programs_in_use)" ] || refuse "$out is in use by a check; wait for its end, or give another folder with -o"
}
programs_in_use() { find /proc/[0-9]*/exe -lname "$(realpath "$out")/unpacked-*" 2>/dev/null || true; }
check_folder

# Removes the programs that earlier runs unpacked.
remove_unpacked() {
  local path
  for path in "$out"/unpacked-*; do
    if is_unpacked "${path##*/}"; then rm -rf "$path"; fi
  done
}

bin=build/release/bin
tests=(brittle_tests_engine brittle_tests_kernel brittle_tests_module brittle_tests_abi)
if $build; then
  tools/setup.sh test
  tools/build.sh release brittle brittle_library "${tests[@]}"
fi
for program in brittle "${tests[@]}"; do
  [ -x "$bin/$program" ] || { echo "gpu_check: $bin/$program is missing; run without --no-build" >&2; exit 1; }
done

kit=$(mktemp -d)
trap 'rm -rf "$kit"' EXIT
mkdir -p "$kit"/{bin,lib,cxx,system,vulkan,meshes,modules,source}

# The shared libraries that these programs load, one path per line.
libraries_of() {
  local file
  for file in "$@"; do ldd "$file"; done | awk '/=> \//{print $3} /^\t\/lib.*ld-linux/{print $1}' | sort -u
}

# Copies a library to a folder of the kit under the name that programs ask for.
add_library() { cp -L "$1" "$kit/$2/$(basename "$1")"; }

pack_programs() {
  say "programs"
  local program
  for program in brittle "${tests[@]}"; do strip -o "$kit/bin/$program" "$bin/$program"; done
  cp build/release/modules/*.so "$kit/modules/" 2>/dev/null || true
  local library
  for library in $(libraries_of "$bin/brittle" "${tests[@]/#/$bin/}"); do
    case $(basename "$library") in
      ld-linux* | libc.so* | libm.so* | libdl.so* | librt.so* | libpthread.so* | libresolv.so*) add_library "$library" system ;;
      libstdc++* | libgcc_s*) add_library "$library" cxx ;;
      *) add_library "$library" lib ;;
    esac
  done
  # Drivers load these by name; their symbols have moved to libc.
  for library in libdl.so.2 librt.so.1 libpthread.so.0; do add_library "/lib/x86_64-linux-gnu/$library" system; done
  strip "$kit"/lib/* "$kit"/cxx/*
}

# The files of installed packages: drivers made for desktops load X11 and GLVND, which servers often lack.
pack_vulkan() {
  say "the Vulkan loader, and the libraries that drivers expect on a desktop"
  local package library
  for package in libvulkan1 libegl1 libglvnd0 libglx0 libx11-6 libxext6 libxcb1 libxau6 libxdmcp6 libbsd0 libmd0; do
    for library in $(dpkg -L "$package" | grep '/lib/.*\.so\.'); do cp -P "$library" "$kit/vulkan/"; done
  done
  cp /bin/busybox "$kit/busybox"
}

pack_layer() {
  if $small; then return 0; fi
  local layer=/usr/lib/x86_64-linux-gnu/libVkLayer_khronos_validation.so
  local manifest=/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json
  [ -f "$layer" ] && [ -f "$manifest" ] || return 0
  say "the validation layer"
  mkdir -p "$kit/layer"
  strip -o "$kit/layer/libVkLayer_khronos_validation.so" "$layer"
  sed 's|"library_path": *"[^"]*"|"library_path": "./libVkLayer_khronos_validation.so"|' "$manifest" >"$kit/layer/VkLayer_khronos_validation.json"
}

# A check fails if it misses a mesh of the list, so the list names only those that are packed.
skip_mesh() {
  say "skipped $2: the folder of meshes is not here"
  sed -i "/^$1 /d" "$kit/meshes.txt"
}

# Copies the files that tests and scenes read, laid out as in the source tree.
pack_sources() {
  say "scenes and meshes"
  local path
  for path in README.md modules/brittle/scene/README.md modules/brittle/scene/examples; do
    mkdir -p "$kit/source/$(dirname "$path")"
    cp -r "$path" "$kit/source/$(dirname "$path")/"
  done
  if $small; then
    grep -E '^(ring|cube|bumpy|gearwheel) ' tests/device/meshes.txt >"$kit/meshes.txt"
    printf 'stack_10\nwindow_pane\n' >"$kit/scenes.txt"
  else
    cp tests/device/meshes.txt "$kit/"
  fi
  local name source
  while read -r name source; do
    case $name in '' | '#'*) continue ;; esac
    case $source in builtin:*) continue ;; esac
    if [ -f "../shared/meshes/$source" ]; then cp "../shared/meshes/$source" "$kit/meshes/"; else skip_mesh "$name" "$source"; fi
  done < <(cat "$kit/meshes.txt")
}

write_expected() {
  say "motion, fragments and scene states, on this machine's device"
  local scene
  mkdir -p "$kit/recordings"
  for scene in stack_10 card_house hull_pile_100; do
    "$bin/brittle" compare --device 0 "$scene" --seconds 0.5 --record "$kit/recordings/$scene.motion" --passes-of 1 >/dev/null
  done
  "$bin/brittle" check-device --kit "$kit" --write-expected "$kit/expected.json"
}

# run.sh compares the unpacked files with these before each check.
write_checksums() {
  local sums
  sums=$(cd "$kit" && find . -xtype f -printf '%P\0' | sort -z | xargs -0 md5sum)
  printf '%s\n' "$sums" >"$kit/md5sums"
}

write_folder() {
  say "packing"
  "$kit"/system/ld-linux-x86-64.so.2 --version | sed -n '1s/.* \([0-9.]*[0-9]\)\.*$/\1/p' >"$kit/system/version"
  check_folder
  mkdir -p "$out"
  cp "$readme" "$out/README.txt"
  remove_unpacked
  install -m 755 "$kit/busybox" "$out/busybox"
  rm "$kit/busybox"
  git describe --always --dirty >"$kit/commit" 2>/dev/null || echo unknown >"$kit/commit"
  write_checksums
  tar -C "$kit" --owner=0 --group=0 --sort=name -cf - . | xz "-$($small && echo 1 || echo 6)" -T2 >"$out/programs.tar.xz"
  install -m 755 tools/device_check/run.sh "$out/run.sh"
  du -sh "$out"
}

pack_programs
pack_vulkan
pack_layer
pack_sources
write_expected
write_folder
