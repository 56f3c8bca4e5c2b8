#!/usr/bin/env bash
# tools/corpus.sh: unpacks the models of Debian's libcgal-demo into build/corpus, for the long tests. Nothing is installed.
# Where the package cannot be had, it says so, and the tests on these models skip.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

package=libcgal-demo
folder=build/corpus/$package
if [ -d "$folder/meshes" ]; then exit 0; fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fetch() {
  if ! apt-cache show "$package" >/dev/null 2>&1; then
    if [ "$(id -u)" = 0 ]; then apt-get update -qq; else sudo -n apt-get update -qq; fi
  fi
  (cd "$work" && apt-get download -qq "$package" 2>/dev/null && dpkg-deb --extract "$package"_*.deb .)
}

if ! fetch </dev/null; then
  echo "corpus: $package cannot be fetched; the tests on its models will skip"
  exit 0
fi
archive=$(find "$work" -name data.tar.gz -print -quit)
if [ -z "$archive" ]; then
  echo "corpus: $package holds no models; the tests on them will skip"
  exit 0
fi
mkdir -p "$work/models" "$folder"
tar -xzf "$archive" -C "$work/models"
mv "$work/models/data/meshes" "$folder/meshes"
echo "corpus: $(find "$folder/meshes" -type f | wc -l) files in $folder"
