#!/usr/bin/env bash
# Installs what is missing, refuses misformatted files, builds with warnings as errors, runs every test.
# Usage: tools/test.sh [sanitize | thread | clang | portable | PRESET]   (default: ci)
#   sanitize  address and undefined-behaviour sanitizers, assertions on
#   thread    thread sanitizer, for the tests of code that starts threads; without tests of statistics
#   clang     clang 14 instead of the system's compiler
#   portable  only that carlo built for any machine of the architecture gives the same bits as one built for this one
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
if [ "$preset" = portable ]; then
  for one in release portable; do
    cmake --preset "$one"
    cmake --build --preset "$one" --target carlo
  done
  # Code for newer machines must not stand in for code that every machine runs: none of it is shared.
  if find build/portable/librender -name trace.cpp.o -exec nm -C {} + | grep " [WV] "; then
    echo "test.sh: the functions above are compiled for an instruction set and may be called by all code" >&2
    exit 1
  fi
  exec ./tests/layout/same_bits.sh build/release/tools/carlo build/portable/tools/carlo
fi
cmake --preset "$preset"
cmake --build --preset "$preset"
ctest --preset "$preset" -j "$(nproc)"
