#!/usr/bin/env bash
# tools/godot.sh [ARG...]: runs Godot 4 with these arguments. tools/godot.sh --obtain: only sees to it that it is there.
#
# $BRITTLE_GODOT, if set, is the Godot to run. Else it is Debian's: its package and all that it needs are unpacked from a newer
# suite than Debian 12 into a folder of the user's cache, from the mirror that apt is set up with, without root, and run through
# their own dynamic loader, so nothing of the system changes. That takes about 170 MB to download and 650 MB on disk, once.
# Exit code 77, with the reason: it cannot be had here.
set -euo pipefail

suite=forky # bookworm has Godot 3, trixie as well
packages=(godot mesa-vulkan-drivers libvulkan1)
home=${XDG_CACHE_HOME:-$HOME/.cache}/brittle/godot-$suite

cannot() {
  echo "godot: $*" >&2
  exit 77
}

# The mirror of Debian itself that apt uses for this system.
mirror() {
  apt-get indextargets --format '$(ORIGIN) $(REPO_URI) $(SUITE)' 'Created-By: Packages' 2>/dev/null |
    awk '$1 == "Debian" && $3 !~ /security/ {print $2; exit}'
}

# apt with a state of its own in $1, which takes packages from that suite alone.
private_apt() {
  local folder=$1 from=$2
  mkdir -p "$folder"/{lists/partial,cache/archives/partial,etc/apt.conf.d,etc/preferences.d}
  : >"$folder/status"
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $from $suite main" >"$folder/etc/sources.list"
  cat >"$folder/apt.conf" <<CONF
Dir::State "$folder"; Dir::State::lists "$folder/lists"; Dir::State::status "$folder/status"; Dir::Cache "$folder/cache";
Dir::Etc "$folder/etc"; Dir::Etc::sourcelist "$folder/etc/sources.list"; Dir::Etc::sourceparts "-";
Dir::Etc::preferencesparts "$folder/etc/preferences.d";
APT::Install-Recommends "false"; APT::Sandbox::User ""; Debug::NoLocking "1";
Acquire::Languages "none"; Acquire::Check-Valid-Until "false"; Acquire::Retries "1"; Acquire::http::Timeout "30";
CONF
}

# Programs of the newer suite run by its loader and libraries; its lavapipe is what Vulkan finds where nothing else is asked for.
write_launcher() {
  local folder=$1 lib=root/usr/lib/x86_64-linux-gnu
  cat >"$folder/lavapipe.json" <<JSON
{"file_format_version": "1.0.0", "ICD": {"library_path": "./$lib/libvulkan_lvp.so", "api_version": "1.4.0"}}
JSON
  cat >"$folder/godot" <<LAUNCHER
#!/usr/bin/env bash
here=\$(cd "\$(dirname "\${BASH_SOURCE[0]}")" && pwd)
export VK_DRIVER_FILES=\${VK_DRIVER_FILES:-\$here/lavapipe.json}
exec "\$here/root/usr/lib64/ld-linux-x86-64.so.2" --library-path "\$here/$lib:\$here/$lib/pulseaudio" "\$here/root/usr/bin/godot" "\$@"
LAUNCHER
  chmod +x "$folder/godot"
}

obtain() {
  [ "$(uname -m)" = x86_64 ] || cannot "this is not x86_64; set BRITTLE_GODOT to a Godot 4.4 or newer"
  command -v apt-get >/dev/null || cannot "there is no apt here; set BRITTLE_GODOT to a Godot 4.4 or newer"
  local from fresh=$home.new
  from=$(mirror)
  [ -n "$from" ] || cannot "apt knows no mirror of Debian; run apt-get update, or set BRITTLE_GODOT to a Godot 4.4 or newer"
  rm -rf "$fresh"
  mkdir -p "$fresh/root"
  echo "godot: obtaining Debian's package godot of $suite, 170 MB, once" >&2
  private_apt "$fresh/apt" "$from"
  export APT_CONFIG=$fresh/apt/apt.conf
  apt-get -qq update >&2 || cannot "the list of packages of Debian $suite cannot be had from $from"
  apt-get install -y -qq --download-only "${packages[@]}" >/dev/null || cannot "the packages of Debian $suite cannot be had from $from"
  for package in "$fresh"/apt/cache/archives/*.deb; do dpkg-deb -x "$package" "$fresh/root"; done
  rm -rf "$fresh/apt"
  write_launcher "$fresh"
  "$fresh/godot" --version >&2 || cannot "what was unpacked of Debian $suite does not run here"
  rm -rf "$home"
  mv "$fresh" "$home"
}

if [ -n "${BRITTLE_GODOT:-}" ]; then
  godot=$BRITTLE_GODOT
  command -v "$godot" >/dev/null || cannot "BRITTLE_GODOT is $godot, which is no program"
else
  godot=$home/godot
  if [ ! -x "$godot" ]; then
    mkdir -p "$(dirname "$home")"
    exec 9>"$home.lock" # tests that run side by side wait for the first
    flock 9
    [ -x "$godot" ] || obtain
    exec 9>&-
  fi
fi

if [ "${1:-}" = --obtain ]; then
  echo "$godot"
else
  exec "$godot" "$@"
fi
