#!/usr/bin/env bash
# tools/sample_models.sh PROGRAM FOLDER...: reads every model under the folders with PROGRAM (brittle) and prints a table of
# outcomes per folder, then each refusal with its reason. A reader that crashes or takes longer than 20 s is an error.
# Packages with samples: assimp-testmodels, openscad-testing-data, and of npm @webxr-input-profiles/assets.
set -uo pipefail

usage() {
  echo "sample_models: $1; usage: tools/sample_models.sh PROGRAM FOLDER..." >&2
  exit 2
}

[ $# -ge 2 ] || usage "no program or no folder is given"
program=$1
shift
[ -x "$program" ] || usage "$program is not a program"
for folder in "$@"; do
  [ -d "$folder" ] || usage "$folder is not a folder"
done
refusals=$(mktemp)
trap 'rm -f "$refusals"' EXIT
status=0

# Prints sound, unsound or refused; notes refusals.
outcome_of() {
  local text code
  text=$(timeout 20 "$program" doctor "$1" 2>&1)
  code=$?
  case $text in
    *"sound, can be broken"*) echo sound ;;
    *"cannot be broken"*) echo unsound ;;
    *) echo refused; echo "- \`$(basename "$1")\`: $(echo "$text" | tail -n 1 | sed "s|.*$(basename "$1"): ||")" >>"$refusals" ;;
  esac
  [ "$code" = 0 ] || [ "$code" = 2 ] || { echo "sample_models: $1 ended with $code" >&2; return 1; }
}

echo "| folder | files | sound | read, not sound | refused |"
echo "|---|---|---|---|---|"
for folder in "$@"; do
  sound=0 unsound=0 refused=0
  while IFS= read -r -d '' file; do
    outcome=$(outcome_of "$file") || status=1
    case $outcome in sound) ((sound++)) ;; unsound) ((unsound++)) ;; *) ((refused++)) ;; esac
  done < <(find "$folder" -type f -regextype posix-extended -iregex '.*\.(obj|stl|ply|off|glb|gltf|fbx|dae)' -print0 | sort -z)
  echo "| $(basename "$folder") | $((sound + unsound + refused)) | $sound | $unsound | $refused |"
done
echo
cat "$refusals"
exit "$status"
