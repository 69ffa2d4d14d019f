#!/usr/bin/env bash
# Makes a release of the version in CMakeLists.txt: all gates, then packages, source archive, checksums and a git tag.
# Usage: tools/release.sh [--dry-run]   (--dry-run: only says whether the tree is ready)
set -eu
cd "$(dirname "$0")/.."
fail() { echo "release.sh: $1" >&2; exit 2; }
version=$(sed -n 's/^project(mc VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
[ -n "$version" ] || fail "CMakeLists.txt names no version"
tag=v$version
[ -z "$(git status --porcelain)" ] || fail "the tree has changes; commit them"
! git rev-parse -q --verify "refs/tags/$tag" >/dev/null || fail "$tag exists; raise the version in CMakeLists.txt"
grep -q "^## \[$version\]" CHANGELOG.md || fail "CHANGELOG.md has no section [$version]; rename [Unreleased]"
grep -q "^version: $version\$" CITATION.cff || fail "CITATION.cff names another version than $version"
echo "release.sh: $tag is ready"
[ "${1:-}" != --dry-run ] || exit 0

for gate in ci sanitize thread clang portable; do ./tools/test.sh "$gate"; done
./tools/lint.sh
./tools/package.sh
out=out/release-$version
rm -rf "$out" && mkdir -p "$out"
cp build/package/*.deb build/package/libmc-"$version".tar.xz build/package/wheel/*.whl "$out"
(cd "$out" && sha256sum -- * >SHA256SUMS)
git tag -a "$tag" -m "libmc $version"
echo "release.sh: $out and the tag $tag; push it with: git push origin $tag"
