#!/usr/bin/env bash
# Installs the build tree into a scratch folder. Builds this project against the one installed library in Debug with
# -march=native, and in Release with plain flags. Runs its tests and the examples of libmc/README.md, and compares the
# output of the examples with the README.
# Usage: run.sh BUILD_DIR CMAKE COMPILER [one | other]
#   one    Release only, for libraries built with a sanitizer.
#   other  Release only, by clang if COMPILER is g++, else by g++; exits with 77 if it is not installed.
set -eu
build=$1 cmake=$2 compiler=$3 what=${4:-all}
configurations=(Debug Release)
[ "$what" = all ] || configurations=(Release)
if [ "$what" = other ]; then
  if "$compiler" --version | grep -qi clang; then compiler=g++; else compiler=clang++-14; fi
  command -v "$compiler" >/dev/null || { echo "skipped: $compiler is not installed"; exit 77; }
fi
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
"$here/../layout/readme_examples.sh" "$here/../../libmc/README.md" "$scratch/readme_examples.h" "$scratch/expected.txt"

"$cmake" -G "Ninja Multi-Config" -S "$here" -B "$scratch/built" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DREADME_EXAMPLES_DIR="$scratch" >/dev/null
for configuration in "${configurations[@]}"; do
  "$cmake" --build "$scratch/built" --config "$configuration" -j 1 >"$scratch/log" || { cat "$scratch/log"; exit 1; }
  program=$scratch/built/$configuration/consumer
  "$program" --readme | diff -u "$scratch/expected.txt" - || { echo "FAILED: $compiler $configuration"; exit 1; }
  [ "$configuration" = Debug ] || "$program" --gtest_brief=1
  echo "$compiler $configuration: as the READMEs say"
done
[ "$what" != other ] || exit 0 # the rest once

# Without CMake. The flags of mc-render include the flags of mc.
export PKG_CONFIG_PATH=$scratch/prefix/lib/pkgconfig
"$compiler" -std=c++20 "$here/control_variates.cpp" -o "$scratch/with_pkg_config" $(pkg-config --cflags --libs mc-render)
LD_LIBRARY_PATH=$scratch/prefix/lib "$scratch/with_pkg_config"

if [ -d "$scratch/prefix/include/render" ]; then
  "$cmake" --build "$scratch/built" --config Release --target picture >"$scratch/log" || { cat "$scratch/log"; exit 1; }
  for ending in png exr; do "$scratch/built/Release/picture" "$scratch/picture.$ending"; done
fi

carlo=$scratch/prefix/bin/carlo
[ ! -x "$carlo" ] || "$carlo" validate --plugin "$scratch/built/Release/mine.so" --params n=1 --params n=1000 --samples 100000
