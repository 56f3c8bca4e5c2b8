#!/usr/bin/env bash
# kit_in_chroot.sh --can-run | KIT FOLDER [WORDS...]: runs KIT/run.sh with these words in an empty root file system below FOLDER. That holds
# the kit, the kernel's own file systems, and the files of Mesa's lavapipe with the libraries it loads, without the C and C++
# libraries. Results land in FOLDER/root/kit. Exit code 77, with the reason: file systems cannot be mounted here.
# No kernels are compiled before the first run: the folder keeps its own below FOLDER/root/kit, and the user's cache is not there.
# $KIT_RESULTS_SIZE: results go to a disk of this size, which is FOLDER/root/kit/results.
set -euo pipefail

usage() {
  echo "usage: kit_in_chroot.sh --can-run | KIT FOLDER [WORDS...]" >&2
  exit 2
}
[ "${1:-}" = --can-run ] || [ $# -ge 2 ] || usage
driver=/usr/lib/x86_64-linux-gnu/libvulkan_lvp.so
[ -f "$driver" ] || { echo "SKIPPED: Mesa's lavapipe is not at $driver"; exit 77; }
unshare --mount --map-root-user true 2>/dev/null || { echo "SKIPPED: no mount namespace can be made here"; exit 77; }
[ "${1:-}" != --can-run ] || exit 0

kit=$1 folder=$2 root=$2/root
shift 2

make_root() {
  mkdir -p "$root"/{kit/results,proc,dev,sys,tmp,usr/lib/x86_64-linux-gnu,usr/share/vulkan/icd.d}
  cp -r "$kit/." "$root/kit/"
  cp -L "$driver" "$root/usr/lib/x86_64-linux-gnu/"
  cp -L /usr/share/vulkan/icd.d/lvp_icd.x86_64.json "$root/usr/share/vulkan/icd.d/"
  ldd "$driver" | awk '/=> \//{print $3}' | grep -vE '/(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so' |
    xargs -I{} cp -L {} "$root/usr/lib/x86_64-linux-gnu/"
}

[ -d "$root" ] || make_root
exec env -i PATH=/nowhere ${VK_DRIVER_FILES:+VK_DRIVER_FILES="$VK_DRIVER_FILES"} root="$root" size="${KIT_RESULTS_SIZE:-}" /usr/bin/unshare --mount --map-root-user /bin/sh -c '
  for system in proc dev sys; do /bin/mount --rbind /$system "$root/$system" || exit 77; done
  [ -z "$size" ] || /bin/mount -t tmpfs -o size="$size" results "$root/kit/results" || exit 77
  /usr/sbin/chroot "$root" /kit/busybox sh /kit/run.sh "$@"
  code=$?
  [ -z "$size" ] || { /bin/mkdir -p "$root/kept"; /bin/cp -r "$root/kit/results/." "$root/kept/"; }
  exit $code
' sh "$@"
