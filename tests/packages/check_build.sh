#!/usr/bin/env bash
# Packs a build into .deb files and checks them. Exits with 77 where the tools of Debian are not installed.
# Usage: check_build.sh BUILD_DIR CPACK
set -eu
build=$1 cpack=$2
command -v dpkg-shlibdeps >/dev/null || { echo "skipped: dpkg-dev is not installed"; exit 77; }
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cpack" --config "$build/CPackConfig.cmake" -G DEB -B "$folder" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip >"$folder/log" ||
  { cat "$folder/log"; exit 1; }
"$here/check_debs.sh" "$folder"
