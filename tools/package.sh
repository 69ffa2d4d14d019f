#!/usr/bin/env bash
# Builds the packages for any machine of the architecture: .deb files, the source archive of the last commit, and the
# wheel; and tests them.
# Usage: tools/package.sh [--no-tests]   The result is in build/package and build/package/wheel.
#   --no-tests  only the .deb files
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh python3-skbuild python3-pip python3-wheel python3-venv dpkg-dev xz-utils
cmake --preset package
cmake --build --preset package
cd build/package
rm -f ./*.deb
cpack -G DEB >/dev/null
ls -1 ./*.deb
[ "${1:-}" != --no-tests ] || exit 0

../../tests/packages/check_debs.sh "$PWD"
source=$(sed -n 's/^set(CPACK_PACKAGE_VERSION "\(.*\)")/libmc-\1/p' CPackConfig.cmake)
git -C ../.. archive --prefix="$source/" HEAD | xz >"$source.tar.xz"
../../tests/packages/check_source.sh "$source.tar.xz"
rm -rf wheel
/usr/bin/python3 -m pip wheel --no-build-isolation --no-deps --wheel-dir wheel ../..
../../tests/packages/check_wheel.sh wheel/*.whl
