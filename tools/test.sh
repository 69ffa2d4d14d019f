#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors, runs every test. Usage: tools/test.sh [PRESET]   (default: ci)
set -eu
cd "$(dirname "$0")/.."
preset=${1:-ci}
./tools/bootstrap.sh
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" -j "$(nproc)"
