# Sourced by tools/godot.sh and tools/newer_lavapipe.sh, and by tools/fresh_system.sh for the mirror: unpacks packages of a newer
# Debian suite into a folder of the user's cache, without root, from the mirror that apt uses. The caller sets `suite` (the Debian
# suite) and `tool` (its own name, for messages). What is unpacked runs by its own dynamic loader, so nothing of the system changes.

unpacked_lib=root/usr/lib/x86_64-linux-gnu # below the folder
unpacked_loader=root/usr/lib64/ld-linux-x86-64.so.2

# Ends the script with code 77, by which ctest knows a skipped test.
cannot() {
  echo "$tool: $*" >&2
  exit 77
}

cache_folder() { echo "${XDG_CACHE_HOME:-$HOME/.cache}/brittle/$1"; }

# Prints the mirror of Debian itself that apt uses on this system.
mirror() {
  apt-get indextargets --format '$(ORIGIN) $(REPO_URI) $(SUITE)' 'Created-By: Packages' 2>/dev/null |
    awk '$1 == "Debian" && $3 !~ /security/ {print $2; exit}'
}

# Makes folder $1 hold a state of apt of its own, which takes packages of $suite alone from mirror $2.
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

# unpack_packages FOLDER PACKAGE...: unpacks the packages and all that they depend on below FOLDER/root.
unpack_packages() {
  local folder=$1 from
  shift
  [ "$(uname -m)" = x86_64 ] || cannot "this machine is not x86_64, for which the packages are"
  command -v apt-get >/dev/null || cannot "there is no apt on this machine"
  from=$(mirror)
  [ -n "$from" ] || cannot "apt knows no mirror of Debian; run apt-get update"
  rm -rf "$folder"
  mkdir -p "$folder/root"
  private_apt "$folder/apt" "$from"
  export APT_CONFIG=$folder/apt/apt.conf
  apt-get -qq update >&2 || cannot "the package list of Debian $suite cannot be downloaded from $from"
  apt-get install -y -qq --download-only "$@" >/dev/null || cannot "the packages of Debian $suite cannot be downloaded from $from"
  for package in "$folder"/apt/cache/archives/*.deb; do dpkg-deb -x "$package" "$folder/root"; done
  rm -rf "$folder/apt"
  unset APT_CONFIG
}

# Describes the lavapipe below folder $1 to the Vulkan loader, in $1/lavapipe.json.
write_lavapipe_manifest() {
  cat >"$1/lavapipe.json" <<JSON
{"file_format_version": "1.0.0", "ICD": {"library_path": "./$unpacked_lib/libvulkan_lvp.so", "api_version": "1.4.0"}}
JSON
}

# obtain_once FOLDER LAUNCHER FUNCTION: unless FOLDER/LAUNCHER exists, has FUNCTION fill FOLDER.new and moves it to FOLDER.
# Scripts that run side by side wait for the first.
obtain_once() {
  local folder=$1 launcher=$1/$2 fill=$3
  [ -x "$launcher" ] && return
  mkdir -p "$(dirname "$folder")"
  exec 9>"$folder.lock"
  flock 9
  if [ ! -x "$launcher" ]; then
    "$fill" "$folder.new"
    rm -rf "$folder"
    mv "$folder.new" "$folder"
  fi
  exec 9>&-
}
