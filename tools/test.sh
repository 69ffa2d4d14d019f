#!/usr/bin/env bash
# Installs what is missing, refuses misformatted files, builds with warnings as errors, runs every test.
# Usage: tools/test.sh [sanitize | thread | clang | PRESET]   (default: ci)
#   sanitize  address and undefined-behaviour sanitizers, assertions on
#   thread    thread sanitizer
#   clang     clang 14 instead of the system's compiler
set -eu
cd "$(dirname "$0")/.."
case ${1:-ci} in
  sanitize) preset=checked ;;
  thread) preset=tsan ;;
  *) preset=${1:-ci} ;;
esac
extra=()
[ "$preset" != clang ] || extra=(clang-14)
./tools/bootstrap.sh "${extra[@]}"
./tools/format.sh --check
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" -j "$(nproc)"
