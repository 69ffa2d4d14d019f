#!/usr/bin/env bash
# Static checks: every public symbol is documented, each public header compiles alone, and clang-tidy passes over every
# source with the checks of .clang-tidy; or clang-tidy over the named sources only. Benchmarks against GSL and Embree
# are included where these libraries are installed. Usage: tools/lint.sh [FILE.cpp...]
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh clang-14 clang-tidy-14 libbenchmark-dev doxygen
cmake --preset lint >/dev/null
cmake --build build/lint --target carlo_generated
if [ $# -eq 0 ]; then
  cmake --build build/lint --target docs # an undocumented public symbol is an error
  mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' build/lint/compile_commands.json | grep "^$PWD/\(bench\|lib\|python\|tests\|tools\)" | sort -u)
  ./tests/layout/headers_compile_alone.sh clang++-14 "$PWD" "$PWD/libmc" "$PWD/librender" \
    "$(pkg-config --cflags-only-I eigen3 | sed 's/-I//; s/ *$//')"
else
  files=("$@")
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p build/lint --quiet 2> >(grep -v 'warnings\? generated' >&2)
echo "lint: ${#files[@]} files are clean"
