#!/usr/bin/env bash
# Installs the build tree into a scratch folder, builds this project against it, runs its tests.
# Usage: run.sh BUILD_DIR CMAKE COMPILER
set -eu
build=$1 cmake=$2 compiler=$3
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
"$cmake" -S "$here" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" >/dev/null
"$cmake" --build "$scratch/build"
"$scratch/build/consumer_test"
carlo=$scratch/prefix/bin/carlo
[ ! -x "$carlo" ] || "$carlo" validate --plugin "$scratch/build/mine.so" --params n=1 --params n=1000 --samples 100000
