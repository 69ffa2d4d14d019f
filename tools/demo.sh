#!/usr/bin/env bash
# From a clean clone: installs missing packages, builds carlo, renders two scenes, checks every distribution, measures
# convergence, and writes the page out/index.html.
set -eu
cd "$(dirname "$0")/.."
./tools/bootstrap.sh
cmake --preset release -DMC_BUILD_TESTS=OFF
cmake --build --preset release
carlo=build/release/tools/carlo
mkdir -p out

failed=0
# run NAME ARGUMENT...: runs carlo with these arguments; keeps the command, the output and the exit code for the page.
run() {
  local name=$1 code=0
  shift
  echo "carlo $*" | tee "out/$name.command"
  $carlo "$@" | tee "out/$name.txt" || code=$?
  echo "$code" >"out/$name.exit"
  [ "$code" -eq 0 ] || failed=1
}
set -o pipefail

run cbox render cbox -o out/cbox.png --spp 128
run glass render book3-cornell-glass -o out/cornell_glass.png --size 400x400 --spp 144
run validate validate --all --json out/validate.json --report out/validate
run converge converge pi -o out/convergence --report out/convergence

./tools/demo_page.sh out "$($carlo --version)"
echo
echo "The pictures, the plot and the verdicts: $PWD/out/index.html"
exit $failed
