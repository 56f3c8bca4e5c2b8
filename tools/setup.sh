#!/usr/bin/env bash
# tools/setup.sh [run] [test] [bench]: installs what Brittle needs, by package name, as root or with sudo. Works on Debian 12 and newer.
#   run    what building and running the program needs; this is the default
#   test   that, and what all tests need
#   bench  that, and the programs that the benchmark compares with
# Installs nothing and asks nobody if all of it is there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/progress.sh"

run=(
  # compilers and build
  build-essential cmake ninja-build ccache pkg-config
  glslang-tools glslang-dev spirv-tools spirv-headers
  # Vulkan: headers, loader, and a device for machines without a GPU
  libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers
  # libraries
  libassimp-dev libcli11-dev libdraco-dev libeigen3-dev libmeshoptimizer-dev libqhull-dev libstb-dev libtinygltf-dev
  libtomlplusplus-dev nlohmann-json3-dev zlib1g-dev
  # the window and the allocator of shader_reload, which does without both
  libglfw3-dev libmimalloc-dev
)
test=(
  libgtest-dev librapidcheck-dev clang clang-tidy CLANG_RUNTIME
  vulkan-validationlayers
  # films of brittle simulate
  ffmpeg
  # the page of brittle accuracy
  chromium fonts-dejavu-core
  # a screen that nobody sees, for the plugin for Godot
  xvfb xauth
  # the folder of tools/gpu_check.sh: a shell for machines without one, and what drivers expect on a desktop
  busybox-static libegl1 libglx0 libxext6
  # hard cases run on Bullet, too
  libbullet-dev
  # bare systems of other Debian suites, for tools/fresh_system.sh
  mmdebstrap
)
bench=(libbullet-dev libcgal-dev libgmp-dev libmpfr-dev voro++-dev)

usage() {
  echo "usage: tools/setup.sh [run] [test] [bench]" >&2
  exit 2
}

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# The sanitizers of the system's clang, whose package has the version in its name.
clang_runtime() {
  local version
  version=$(apt-cache depends clang 2>/dev/null | sed -n 's/^ *Depends: clang-\([0-9]*\)$/\1/p' | head -n 1)
  [ -z "$version" ] || echo "libclang-rt-$version-dev"
}

# Prints the packages of the list that are not there.
missing_of() {
  local package
  for package in "$@"; do
    [ "$package" = CLANG_RUNTIME ] && package=$(clang_runtime)
    [ -n "$package" ] || package=clang # its version is not known before apt has its lists
    installed "$package" || echo "$package"
  done
}

# As root, whoever asks.
as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

# Runs apt-get; prints what it said only if it fails.
quietly() {
  if ! as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@" >"$log" 2>&1 </dev/null; then
    end_progress
    tail -n 30 "$log" >&2
    echo "setup: failed: $*; check the network and the lists of packages in /etc/apt" >&2
    exit 1
  fi
}

# Prints how many packages apt would install for these, and how many bytes it would download.
size_of() {
  apt-get install -y -s --no-install-recommends "$@" 2>/dev/null | grep -c '^Inst ' | tr '\n' ' '
  apt-get install -y -qq --print-uris --no-install-recommends "$@" 2>/dev/null | awk '{sum += $3} END {printf "%.0f\n", sum}'
}

# Prints how far apt is, by what it has said.
install_state() {
  awk -v all="$packages" '/^Get:/ {got++} /^Unpacking / {unpacked++} /^Setting up / {ready++}
    END {printf "downloaded %d, unpacked %d, ready %d of %d packages", got, unpacked, ready, all}' "$log"
}

wanted=("${run[@]}")
for group in "$@"; do
  case $group in
    run) ;;
    test) wanted+=("${test[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    *) usage ;;
  esac
done

missing=$(missing_of "${wanted[@]}" | sort -u)
[ -n "$missing" ] || exit 0
if [ "$(id -u)" != 0 ] && ! command -v sudo >/dev/null; then
  echo "setup: run as root, or install sudo; missing packages:" $missing >&2
  exit 1
fi

as_root true # asks for a password before anything else is printed
log=$(mktemp)
trap 'end_progress; rm -f "$log"' EXIT
start=$SECONDS

show_progress "setup: reading package lists"
quietly apt-get update -q
end_progress
missing=$(missing_of "${wanted[@]}" | sort -u)
read -r packages bytes < <(size_of $missing)
megabytes=$(((bytes + 500000) / 1000000))
echo "setup: installing $packages packages, $megabytes MB to download:" $missing
show_progress "setup" install_state
quietly apt-get install -y -q --no-install-recommends $missing
end_progress
echo "setup: installed $packages packages, $megabytes MB, in $((SECONDS - start)) s"
