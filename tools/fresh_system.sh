#!/usr/bin/env bash
# tools/fresh_system.sh [--ccache] SUITE [demo|test]: runs tools/demo.sh (the default) or tools/test.sh on a bare system of a
# Debian suite: bookworm, trixie, forky or sid. It ends with a line that has the times of setup, build and run and the size of the
# download. The system is a chroot below ${TMPDIR:-/var/tmp}, takes 5 GB there, holds the files of HEAD, and is removed at the end.
#   --ccache   keeps compiled objects in the user's cache, for the next run
# Run it as root. It needs git, the package mmdebstrap, and the mirror of Debian that apt uses on this system.
# Exit code 77, with the reason: this machine cannot make such a system.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
tool=fresh_system
source tools/unpack_debian.sh
source tools/progress.sh

usage() {
  echo "usage: tools/fresh_system.sh [--ccache] SUITE [demo|test]" >&2
  exit 2
}

fail() {
  echo "$tool: $*" >&2
  exit 1
}

# Runs git on this checkout, also one of another user.
checkout() { git -c safe.directory='*' "$@"; }

check_machine() {
  [ "$(id -u)" = 0 ] || cannot "a chroot needs root; run: sudo tools/fresh_system.sh $suite"
  command -v mmdebstrap >/dev/null || cannot "there is no program mmdebstrap; run tools/setup.sh test"
  mirror=$(mirror)
  [ -n "$mirror" ] || cannot "apt knows no mirror of Debian; run apt-get update"
  unshare --mount true 2>/dev/null || cannot "this machine forbids mounts; run on one, or in a container, that allows them"
  checkout rev-parse --quiet --verify HEAD >/dev/null 2>&1 || cannot "this folder is no checkout of git; clone the repository"
}

# Makes the system below $root, with nothing but what Debian calls required, and apt.
make_system() {
  show_progress "$tool: making a system of Debian $suite"
  # Mirrors may lag behind: a list that is some weeks old does as well.
  if ! mmdebstrap --mode=root --variant=minbase --include=ca-certificates --aptopt='Acquire::Check-Valid-Until "false"' \
    --aptopt='Acquire::Retries "2"' "$suite" "$root" "$mirror" >"$folder/mmdebstrap.log" 2>&1 </dev/null; then
    end_progress
    tail -n 5 "$folder/mmdebstrap.log" >&2
    cannot "no system of Debian $suite can be made from $mirror; check the name of the suite and the network"
  fi
  end_progress
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
}

# Mounts exist in a namespace of their own, so they end with the command, however it ends.
in_system() {
  unshare --mount --pid --fork --kill-child --propagation private bash -c '
    set -e
    root=$1 cache=$2
    shift 2
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    [ -z "$cache" ] || mount --bind "$cache" "$root/ccache"
    exec chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 CCACHE_DIR=/ccache \
      ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"' \
    bash "$root" "$cache" "$@"
}

# Complains about files of the demo that are missing, empty or of another kind.
check_results() {
  local file kind
  for file in demo.png demo.glb window_pane.png window_pane.glb; do
    [ -s "$root/brittle/out/$file" ] || fail "Debian $suite: out/$file is missing or empty"
    kind=$(head -c 4 "$root/brittle/out/$file" | tr -d '\211\0')
    case $file:$kind in
      *.png:PNG | *.glb:glTF) ;;
      *) fail "Debian $suite: out/$file begins with '$kind'" ;;
    esac
  done
}

# Prints what follows the words of $1 in the log.
logged() { sed -n "s/^$1//p" "$folder/log" | tail -n 1; }

with_cache=false
if [ "${1:-}" = --ccache ]; then
  with_cache=true
  shift
fi
suite=${1:-} command=${2:-demo}
[ $# -le 2 ] || usage
case $suite in "" | -*) usage ;; esac
case $command in demo | test) ;; *) usage ;; esac
check_machine

folder=$(mktemp -d "${TMPDIR:-/var/tmp}/brittle-$suite.XXXXXX")
trap 'end_progress; rm -rf --one-file-system "$folder"' EXIT
trap 'exit 130' INT TERM
root=$folder/root cache=
make_system
mkdir -p "$root/brittle" "$root/ccache"
checkout archive HEAD | tar -x -C "$root/brittle"
if $with_cache; then
  cache=$(cache_folder "ccache-$suite")
  mkdir -p "$cache"
fi

start=$SECONDS
in_system bash -c "cd /brittle && tools/$command.sh" 2>&1 </dev/null | tee "$folder/log" ||
  fail "Debian $suite: tools/$command.sh failed"
took=$((SECONDS - start))
[ "$command" = test ] || check_results
echo "$tool: Debian $suite: tools/$command.sh took $took s;" \
  "setup:$(logged 'setup: installed'); build:$(logged 'built [^)]*)'); run:$(logged 'demo: done')"
