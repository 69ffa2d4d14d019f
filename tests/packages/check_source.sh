#!/usr/bin/env bash
# Unpacks a source archive, and configures a build there: it needs no git and nothing from outside of its folder.
# Usage: check_source.sh ARCHIVE
set -eu
archive=$(realpath "$1")
name=$(basename "$archive" .tar.xz)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "check_source.sh: $1" >&2; exit 1; }
tar -C "$work" -xf "$archive"
[ "$(ls "$work")" = "$name" ] || fail "$archive contains $(ls "$work"); one folder $name is needed"
cmake -G Ninja -S "$work/$name" -B "$work/build" -DMC_BUILD_TESTS=OFF >"$work/log" 2>&1 ||
  fail "cannot be configured: $(tail -3 "$work/log")"
cmake --build "$work/build" --target help | grep -q "^carlo: " || fail "builds no carlo"
echo "check_source.sh: $name is whole"
