#!/usr/bin/env bash
# Installs the build tree into a scratch folder and builds this project against it: with g++ and clang, in Debug and
# Release, with plain flags and with -march=native, all against the one installed library. Runs its tests and the
# examples of libmc/README.md, which must print what stands there.
# Usage: run.sh BUILD_DIR CMAKE COMPILER [one]   (one: only COMPILER in Release, for libraries built with a sanitizer)
set -eu
build=$1 cmake=$2 compiler=$3 only=${4:-all}
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
"$here/../house/readme_examples.sh" "$here/../../libmc/README.md" "$scratch/readme_examples.h" "$scratch/expected.txt"

compilers=("$compiler") configurations=(Debug Release)
if [ "$only" = one ]; then
  configurations=(Release)
else
  other=clang++-14
  if "$compiler" --version | grep -qi clang; then other=g++; fi
  if command -v "$other" >/dev/null; then compilers+=("$other"); else echo "skipped: $other is not installed"; fi
fi

for i in "${!compilers[@]}"; do
  "$cmake" -G "Ninja Multi-Config" -S "$here" -B "$scratch/$i" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
    -DCMAKE_CXX_COMPILER="${compilers[i]}" -DREADME_EXAMPLES_DIR="$scratch" >/dev/null
  for configuration in "${configurations[@]}"; do
    "$cmake" --build "$scratch/$i" --config "$configuration" -j 1 >"$scratch/log" || { cat "$scratch/log"; exit 1; }
    for flags in plain native; do
      program=$scratch/$i/$configuration/consumer_$flags
      "$program" --readme | diff -u "$scratch/expected.txt" - || { echo "FAILED: ${compilers[i]} $configuration $flags"; exit 1; }
      [ "$configuration" = Debug ] || "$program" --gtest_brief=1
      echo "${compilers[i]} $configuration $flags: as the READMEs say"
    done
  done
done

# Without CMake. The flags of mc-render hold those of mc.
export PKG_CONFIG_PATH=$scratch/prefix/lib/pkgconfig
"$compiler" -std=c++20 "$here/control_variates.cpp" -o "$scratch/with_pkg_config" $(pkg-config --cflags --libs mc-render)
LD_LIBRARY_PATH=$scratch/prefix/lib "$scratch/with_pkg_config"

if [ -d "$scratch/prefix/include/render" ]; then
  "$cmake" --build "$scratch/0" --config Release --target picture >"$scratch/log" || { cat "$scratch/log"; exit 1; }
  for ending in png exr; do "$scratch/0/Release/picture" "$scratch/picture.$ending"; done
fi

carlo=$scratch/prefix/bin/carlo
[ ! -x "$carlo" ] || "$carlo" validate --plugin "$scratch/0/Release/mine.so" --params n=1 --params n=1000 --samples 100000
