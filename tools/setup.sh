#!/usr/bin/env bash
# tools/setup.sh [run] [test] [bench]: installs what Brittle needs, by package name, as root or with sudo. Works on Debian 12 and newer.
#   run    what building and running the program needs; this is the default
#   test   that, and what all tests need
#   bench  that, and the programs that the benchmark compares with
# Installs nothing and asks nobody if all of it is there.
set -euo pipefail

run=(
  # compilers and build
  build-essential cmake ninja-build ccache pkg-config
  glslang-tools glslang-dev spirv-tools spirv-headers
  # Vulkan: headers, loader, and a device for machines without a GPU
  libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers
  # libraries
  libassimp-dev libcli11-dev libdraco-dev libeigen3-dev libmeshoptimizer-dev libqhull-dev libstb-dev libtinygltf-dev libtomlplusplus-dev nlohmann-json3-dev
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

echo "setup: reading package lists"
as_root env DEBIAN_FRONTEND=noninteractive apt-get update -qq </dev/null
missing=$(missing_of "${wanted[@]}" | sort -u)
echo "setup: installing" $missing
as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing </dev/null
