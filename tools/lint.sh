#!/usr/bin/env bash
# clang-tidy with the checks of .clang-tidy over every source, or over the named ones. Usage: tools/lint.sh [FILE.cpp...]
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh clang-14 clang-tidy-14
cmake --preset lint >/dev/null
cmake --build build/lint --target carlo_generated
if [ $# -eq 0 ]; then
  mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' build/lint/compile_commands.json | grep "^$PWD/[lt]" | sort -u)
else
  files=("$@")
fi
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p build/lint --quiet 2> >(grep -v 'warnings\? generated' >&2)
echo "lint: ${#files[@]} files are clean"
