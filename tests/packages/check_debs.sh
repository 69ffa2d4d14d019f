#!/usr/bin/env bash
# Unpacks the .deb files of a folder into an empty root, and runs carlo, the Python module and a build against it there.
# Usage: check_debs.sh FOLDER
set -eu
shopt -s nullglob
folder=$1
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
fail() { echo "check_debs.sh: $1" >&2; exit 1; }
for name in libmc-dev librender-dev carlo python3-libmc; do
  debs=("$folder/${name}"_*.deb)
  [ ${#debs[@]} -eq 1 ] || fail "${#debs[@]} packages $name in $folder; 1 is needed"
  dpkg-deb --info "${debs[0]}" | grep -q "^ Package: $name\$" || fail "${debs[0]} is not named $name"
  dpkg-deb --extract "${debs[0]}" "$root"
  [ -f "$root/usr/share/doc/$name/copyright" ] || fail "$name has no license"
done
dpkg-deb --field "$folder"/carlo_*.deb Depends | grep -q libopenexr || fail "carlo names no shared libraries"
dpkg-deb --field "$folder"/python3-libmc_*.deb Depends | grep -q python3-numpy || fail "python3-libmc needs NumPy"
cd "$root"
usr/bin/carlo integrate "x*y" -d "x=0:1,y=0:2" | grep -q "standard error" || fail "carlo integrate"
usr/bin/carlo render cbox --size 8x8 --spp 2 -o a.exr | grep -q "8x8 pixels" || fail "carlo render: the scenes are missing"
for page in carlo carlo-render carlo-integrate; do
  grep -q "^.TH" "usr/share/man/man1/$page.1" || fail "no manual page $page"
done
[ -f usr/share/bash-completion/completions/carlo ] || fail "no completion"
PYTHONPATH=usr/lib/python3/dist-packages PATH=$root/usr/bin:$PATH /usr/bin/python3 - <<'PYTHON' || fail "python3-libmc"
import subprocess, sys
import libmc
assert libmc.__file__.startswith("/tmp") or "dist-packages" in libmc.__file__
libmc.assert_distribution(libmc.warps.UniformDisk(), samples=20000)
subprocess.run([sys.executable, "-m", "libmc", "--version"], check=True)
PYTHON
grep -q "find_dependency(Eigen3" usr/lib/*/cmake/mc/mc-config.cmake usr/lib/cmake/mc/mc-config.cmake || fail "libmc-dev has no CMake package"
echo "check_debs.sh: 4 packages work"
