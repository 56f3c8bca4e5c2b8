#!/usr/bin/env bash
# tools/newer_lavapipe.sh PROGRAM [ARG...]: runs a program of this build on a newer lavapipe than the system's: that of Debian
# forky. tools/newer_lavapipe.sh --obtain: obtains that lavapipe and prints its folder.
#
# The driver and the libraries it depends on are unpacked once (tools/unpack_debian.sh) and take 320 MB on disk.
# The program runs by the newer suite's loader. Each library comes from the newer suite if that was unpacked (libstdc++, libz,
# LLVM), otherwise from the system (assimp, Draco, meshoptimizer, qhull).
# Exit code 77, with the reason: the driver cannot be obtained on this machine.
set -euo pipefail

tool=newer_lavapipe
suite=forky
source "$(dirname "${BASH_SOURCE[0]}")/unpack_debian.sh"

write_launcher() {
  cat >"$1/run" <<LAUNCHER
#!/usr/bin/env bash
here=\$(cd "\$(dirname "\${BASH_SOURCE[0]}")" && pwd)
program=\$(command -v "\$1") || { echo "newer_lavapipe: \$1 is no program" >&2; exit 2; }
shift
export VK_DRIVER_FILES=\$here/lavapipe.json
exec "\$here/$unpacked_loader" --library-path "\$here/$unpacked_lib:/usr/lib/x86_64-linux-gnu" "\$program" "\$@"
LAUNCHER
  chmod +x "$1/run"
}

obtain() {
  echo "newer_lavapipe: obtaining Debian's package mesa-vulkan-drivers of $suite, once" >&2
  unpack_packages "$1" mesa-vulkan-drivers libvulkan1 libstdc++6
  write_lavapipe_manifest "$1"
  write_launcher "$1"
  "$1/run" /bin/true || cannot "programs of this system do not run by the loader of Debian $suite"
}

[ $# -gt 0 ] || { echo "newer_lavapipe: usage: tools/newer_lavapipe.sh --obtain | PROGRAM [ARG...]" >&2; exit 2; }
home=$(cache_folder "lavapipe-$suite")
obtain_once "$home" run obtain
if [ "$1" = --obtain ]; then
  echo "$home"
else
  exec "$home/run" "$@"
fi
