#!/usr/bin/env bash
# Installs what Brittle needs on Debian 12, by package name, as root or with sudo. Does nothing when all of it is there.
set -euo pipefail

packages=(
  # compilers and build
  build-essential cmake ninja-build ccache pkg-config
  glslang-tools glslang-dev spirv-tools spirv-headers
  # Vulkan: headers, loader, a CPU device for machines without a GPU, layers for the tests
  libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers vulkan-validationlayers
  # libraries
  libassimp-dev libcli11-dev libeigen3-dev libqhull-dev libstb-dev libtinygltf-dev libtomlplusplus-dev nlohmann-json3-dev
  # the window of shader_reload, which does without it
  libglfw3-dev
  # the allocator of shader_reload, which does without it
  libmimalloc-dev
  # films; only brittle simulate -o FILE.mp4 and its test ask for it
  ffmpeg
  # the tests of the page of brittle accuracy
  chromium fonts-dejavu-core
  # the plugin for Godot is drawn by its test on a screen that nobody sees
  xvfb xauth
  # the folder of tools/gpu_check.sh: a shell for machines without one, and what drivers expect on a desktop
  busybox-static libegl1 libglx0 libxext6
  # tests, and the peers of the bench
  libgtest-dev librapidcheck-dev clang clang-tidy libclang-rt-14-dev libbullet-dev libcgal-dev libgmp-dev libmpfr-dev
  voro++-dev
)

installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=()
elif command -v sudo >/dev/null; then
  as_root=(sudo)
else
  echo "setup: run as root, or install sudo; missing packages: ${missing[*]}" >&2
  exit 1
fi

echo "setup: installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq </dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
