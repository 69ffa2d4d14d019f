#!/usr/bin/env bash
# Installs the libraries and tools that the build needs, where they are missing (Debian, Ubuntu). Safe to run again.
# Usage: bootstrap.sh [PACKAGE...]   (packages needed besides, e.g. clang-14)
set -eu

packages=(
  g++ cmake ninja-build git pkg-config clang-format-14   # build
  libeigen3-dev libfmt-dev libpcg-cpp-dev      # libmc
  libboost-dev libmpfr-dev libtbb-dev libgtest-dev libgmock-dev
  libpugixml-dev zlib1g-dev libpng-dev libturbojpeg0-dev libopenexr-dev   # librender
  libcli11-dev nlohmann-json3-dev libmuparser-dev gnuplot-nox                # carlo
  pybind11-dev python3-dev python3-numpy python3-scipy python3-pytest        # the Python module and its tests
  python3-nbconvert python3-ipykernel python3-matplotlib dpkg-dev            # notebooks and packages
  libopenmpi-dev openmpi-bin parallel          # several ranks of MPI, and parts by GNU parallel
  "$@"
)

if ! command -v dpkg-query >/dev/null; then
  cat >&2 <<'TEXT'
bootstrap.sh: this is not a Debian system. Please install: a C++20 compiler (g++ 12 or clang 14), CMake 3.25, Ninja, git,
Eigen 3.4, fmt 9, pcg-cpp, Boost 1.74 (headers), MPFR 4, oneTBB, GoogleTest, pugixml, zlib, libpng,
libjpeg-turbo 2, OpenEXR 3, CLI11 2, nlohmann-json 3.11, muparser, gnuplot, OpenMPI 4, GNU parallel, clang-format 14, pybind11 2.10, and for
Python 3.9 NumPy, SciPy, pytest, nbconvert, ipykernel and matplotlib; then run tools/test.sh again.
TEXT
  exit 2
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "bootstrap: everything is installed"
  exit 0
fi

sudo=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "bootstrap.sh: run as root, or install: ${missing[*]}" >&2; exit 2; }
  sudo=sudo
fi
echo "bootstrap: installing ${missing[*]}"
log=$(mktemp)
install() { DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y --no-install-recommends "${missing[@]}" >"$log" 2>&1; }
# The package lists may be absent or stale: refresh them only then.
if ! install && ! { $sudo apt-get update >>"$log" 2>&1 && install; }; then
  tail -n 20 "$log" >&2
  echo "bootstrap.sh: apt-get could not install: ${missing[*]}" >&2
  exit 2
fi
rm -f "$log"
echo "bootstrap: done"
