#!/usr/bin/env bash
# Brings every source to the one format of .clang-format. Usage: tools/format.sh [--check]   (--check: only says what differs)
set -eu
cd "$(dirname "$0")/.."
command -v clang-format-14 >/dev/null || ./tools/bootstrap.sh clang-format-14
mode=(-i)
[ "${1:-}" != --check ] || mode=(--dry-run --Werror)
find libmc librender tools python tests bench examples \( -name '*.h' -o -name '*.cpp' -o -name '*.c' \) -print0 |
  xargs -0 -n 16 -P "$(nproc)" clang-format-14 --style=file "${mode[@]}" ||
  { echo "format.sh: the files above are not in the project's format; run tools/format.sh" >&2; exit 1; }
