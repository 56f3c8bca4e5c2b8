#!/usr/bin/env bash
# engine_test.sh interface|headless|screen BUILD_FOLDER CXX: the plugin in the real engine, in a folder of its own below BUILD_FOLDER.
# Exit code 77, with the reason: it cannot be run here.
set -euo pipefail

mode=$1 build=$2 compiler=$3
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$(cd "$here/../.." && pwd)
folder=$build/godot-test/$mode

godot=$("$source/tools/godot.sh" --obtain) || {
  [ $? = 77 ] || exit 1
  echo "SKIPPED: the real engine cannot be had here, so nothing of this has been tested with it"
  exit 77
}
rm -rf "$folder"
mkdir -p "$folder"
# What the engine keeps for its user stays out of the user's own folders.
export XDG_DATA_HOME=$folder/data XDG_CONFIG_HOME=$folder/config

fail() {
  echo "FAILED: $*"
  exit 1
}

# What the plugin declares by hand is what this engine has.
check_interface() {
  (cd "$folder" && "$godot" --headless --dump-gdextension-interface --dump-extension-api >/dev/null)
  "$compiler" -std=c++20 -fsyntax-only -I"$folder" -I"$source" "$here/interface_check.cpp"
  local declared=$source/modules/brittle/godot/interface/gdextension.h name
  for name in $(grep -oE '^ +X\([a-z0-9_]+' "$declared" | grep -oE '[a-z0-9_]+$'); do
    grep -q "@name $name\$" "$folder/gdextension_interface.h" || fail "the engine has no function $name"
  done
  local called
  called=$(grep -rhoE '\bcall\("[a-z0-9_]+"' "$source/modules/brittle/godot" --include=*.cpp | grep -oE '[a-z0-9_]+"' | tr -d '"' | sort -u)
  [ "$(wc -l <<<"$called")" -ge 30 ] || fail "hardly a method is found to be called: $called"
  for name in $called; do
    grep -q "\"name\": \"$name\"" "$folder/extension_api.json" || fail "the engine has no method $name"
  done
  grep -A8 '"name": "notification"' "$folder/extension_api.json" | grep -q '"hash": 4023243586' || fail "Object.notification has another hash"
}

# The demo with the addon as they are installed, and the checks beside it.
make_project() {
  cmake --install "$build" --prefix "$folder" --component godot >/dev/null
  project=$folder/share/brittle/godot/demo
  cp "$here"/project/*.gd "$project"
}

# check SCRIPT OPTION...: runs a script of checks; its output stays in $log.
check() {
  local script=$1
  shift
  log=$folder/$script.log
  echo "== $script $*"
  "${screen[@]}" "$godot" --path "$project" --audio-driver Dummy --fixed-fps 60 "$@" --script "res://$script.gd" >"$log" 2>&1 </dev/null || {
    cat "$log"
    fail "$script"
  }
  grep -E '^[1-9][0-9]* checks hold, 0 do not$' "$log" || fail "$script did not come to its end"
}

# Nothing is wrong, and nothing is left at the end. $1: what the engine also says of itself, with an empty project.
silent() {
  if grep -nE '^(ERROR|WARNING|SCRIPT ERROR|USER ERROR|USER WARNING):|leaked' "$log" | grep -vE "${1:-^$}"; then
    fail "the engine complains, see $log"
  fi
}

tells() { grep -qF "$1" "$log" || fail "no message says: $1"; }

check_headless() {
  screen=()
  "$godot" --headless --path "$project" --import >"$folder/import.log" 2>&1 </dev/null || fail "the editor cannot import the project"
  check demo_check --headless
  silent
  check nodes_check --headless
  silent
  check errors_check --headless
  tells "there is no BrittleBody3D below it"
  tells "Sheet:<BrittleBody3D"
  tells "4 open edges"
  tells "its mesh has no triangles"
  tells "its transform flattens it"
  tells "a plane does not move"
  tells "'density' is -1"
  tells "it has to be one of glass, porcelain"
  tells "'dt' is 0"
  tells "its MultiMesh is not of 3D transforms"
  tells "damage: the world has not been started"
  tells "energy has to be above 0"
  tells "nothing in this world can break"
  tells "too few bytes for a saved state"
  tells "there is no fragment 12345"
  tells "Method expected 3 argument(s), but called with 1"
  tells "Cannot convert argument 1 from String to int"
}

# Both ways of drawing: on the main thread, and on a thread of its own.
check_screen() {
  command -v Xvfb xvfb-run >/dev/null || {
    echo "SKIPPED: there is no Xvfb; tools/setup.sh test installs it"
    exit 77
  }
  screen=(xvfb-run --auto-servernum --server-args="-screen 0 1280x720x24")
  mkdir -p "$build/godot-test/pictures"
  local drawn=(screen_check --rendering-driver vulkan --rendering-method forward_plus)
  check "${drawn[@]}" --render-thread safe
  silent
  cp "$project"/*.png "$build/godot-test/pictures"
  check "${drawn[@]}" --render-thread separate
  silent 'separate rendering thread feature|This function \(finalize\)|ObjectDB instances leaked'
  echo "pictures in $build/godot-test/pictures"
}

if [ "$mode" != interface ]; then make_project; fi
"check_$mode"
