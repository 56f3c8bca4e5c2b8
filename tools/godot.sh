#!/usr/bin/env bash
# tools/godot.sh [ARG...]: runs Godot 4 with these arguments. tools/godot.sh --obtain: obtains Godot and prints its path.
#
# $BRITTLE_GODOT, if set, is the Godot to run. Otherwise the script unpacks Debian's package from a newer suite than Debian 12
# (tools/unpack_debian.sh). It downloads about 170 MB once and takes 650 MB on disk.
# Exit code 77, with the reason: Godot cannot be obtained on this machine.
set -euo pipefail

tool=godot
suite=forky # bookworm has Godot 3, trixie as well
source "$(dirname "${BASH_SOURCE[0]}")/unpack_debian.sh"

# Starts Godot with its own loader and libraries, and with the unpacked lavapipe unless the caller chose a driver.
write_launcher() {
  cat >"$1/godot" <<LAUNCHER
#!/usr/bin/env bash
here=\$(cd "\$(dirname "\${BASH_SOURCE[0]}")" && pwd)
export VK_DRIVER_FILES=\${VK_DRIVER_FILES:-\$here/lavapipe.json}
lib=\$here/$unpacked_lib
exec "\$here/$unpacked_loader" --library-path "\$lib:\$lib/pulseaudio" "\$here/root/usr/bin/godot" "\$@"
LAUNCHER
  chmod +x "$1/godot"
}

obtain() {
  echo "godot: obtaining Debian's package godot of $suite, 170 MB, once; BRITTLE_GODOT names another Godot" >&2
  unpack_packages "$1" godot mesa-vulkan-drivers libvulkan1
  write_lavapipe_manifest "$1"
  write_launcher "$1"
  "$1/godot" --version >&2 || cannot "the package godot of Debian $suite does not run on this machine"
}

if [ -n "${BRITTLE_GODOT:-}" ]; then
  godot=$BRITTLE_GODOT
  command -v "$godot" >/dev/null || cannot "BRITTLE_GODOT is $godot, which is no program"
else
  home=$(cache_folder "godot-$suite")
  obtain_once "$home" godot obtain
  godot=$home/godot
fi

if [ "${1:-}" = --obtain ]; then
  echo "$godot"
else
  exec "$godot" "$@"
fi
