#!/usr/bin/env bash
# Static checks: every public symbol is documented, each public header compiles alone, and clang-tidy passes over every
# source with the checks of .clang-tidy; or clang-tidy over the sources whose path matches an expression, with the
# groups that contain them. Benchmarks against GSL and Embree are included where these libraries are installed.
# Usage: tools/lint.sh [EXPRESSION]
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh clang-14 clang-tidy-14 libbenchmark-dev doxygen
cmake --preset lint >/dev/null
# The groups of sources that are compiled together are also checked together, since most of the time is for headers. The
# analyzer looks into the sources of a group only if the name of the group says what it is.
database=build/lint/groups
mkdir -p "$database"
sed 's|/Unity/unity_\([a-z0-9_]*\)_cxx[.]cxx|/Unity/UnifiedSource-\1.cpp|g' build/lint/compile_commands.json \
  >"$database/compile_commands.json"
find build/lint -path '*/Unity/unity_*_cxx.cxx' | while read -r group; do
  cp -u "$group" "$(sed 's|/unity_\([a-z0-9_]*\)_cxx[.]cxx|/UnifiedSource-\1.cpp|' <<<"$group")"
done
cp tests/.clang-tidy build/lint/tests/ # clang-tidy looks for it beside the group
cmake --build build/lint --target carlo_generated
if [ $# -eq 0 ]; then
  cmake --build build/lint --target docs # an undocumented public symbol is an error
  ./tests/layout/headers_compile_alone.sh clang++-14 "$PWD" "$PWD/libmc" "$PWD/librender" \
    "$(pkg-config --cflags-only-I eigen3 | sed 's/-I//; s/ *$//')"
fi
mapfile -t files < <(sed -n 's/^ *"file": "\(.*\)".*/\1/p' "$database/compile_commands.json" |
  grep "^$PWD/\(bench\|lib\|python\|tests\|tools\|build/lint/.*/Unity/\)" | sort -u | while read -r file; do
    case $file in
      */UnifiedSource-*) grep -q -e "${1:-}" "$file" && echo "$file" ;;
      *) grep -e "${1:-}" <<<"$file" ;;
    esac || true
  done)
[ ${#files[@]} -gt 0 ] || { echo "lint.sh: no source or group matches $1" >&2; exit 2; }
# Deep analysis follows calls through every template, which takes hours.
shallow=(--extra-arg=-Xclang --extra-arg=-analyzer-config --extra-arg=-Xclang --extra-arg=mode=shallow)
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-14 -p "$database" --quiet "${shallow[@]}" \
  --checks=-bugprone-suspicious-include 2> >(grep -v 'warnings\? generated' >&2)
echo "lint: ${#files[@]} files and groups are clean"
