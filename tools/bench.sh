#!/usr/bin/env bash
# tools/bench.sh [OPTION...]: sets up, builds with the peers, and runs `brittle bench` with these options.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh bench
tools/build.sh release brittle brittle_peer_cgal
exec build/release/bin/brittle bench "$@" </dev/null
