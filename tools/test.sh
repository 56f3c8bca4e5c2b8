#!/usr/bin/env bash
# tools/test.sh [--long]: sets up, builds and runs the tests: all of them in the release build, a part of them under the Vulkan
# validation layers (core, synchronization, GPU-assisted), a part of them under the address and undefined-behavior sanitizers,
# and the fuzzers of the importers for a minute in all (tools/fuzz.sh runs them for longer).
# --long adds the long tests: every model there is (tools/corpus.sh fetches some), larger models, more sites and seeds, the slow
# cases of the kernels.
