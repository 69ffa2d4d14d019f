#!/usr/bin/env bash
# Compiles every public header by itself. Usage: headers_compile_alone.sh COMPILER SOURCE_DIR INCLUDE_DIR...
set -u
compiler=$1 source=$2
shift 2
flags=(-std=c++20 -fsyntax-only -x c++)
for folder in "$@"; do
  # -isystem of the default folder would hide the C headers from the C++ ones.
  for one in ${folder//;/ }; do [ "$one" = /usr/include ] || flags+=(-isystem "$one"); done
done
export compiler
check() {
  header=$1
  shift
  "$compiler" "$@" - <<<"#include <$header>" || { echo "FAILED: <$header> does not compile alone"; return 1; }
}
export -f check
headers() { for base in libmc librender; do (cd "$source/$base" && find . -name '*.h' -printf '%P\n'); done | sort; }
n=$(headers | wc -l)
headers | xargs -P "$(nproc)" -I{} bash -c 'check "$@"' _ {} "${flags[@]}" && echo "$n headers compile alone"
