#!/usr/bin/env bash
# Installs the build tree into a scratch folder, and builds and runs every example against it.
# Usage: examples.sh BUILD_DIR CMAKE COMPILER
set -eu
build=$1 cmake=$2 compiler=$3
examples=$(cd "$(dirname "$0")/../../examples" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$cmake" --install "$build" --prefix "$scratch/prefix" >/dev/null
export CARLO=$scratch/prefix/bin/carlo
fail() { echo "examples.sh: $1" >&2; exit 1; }

make_example() {
  local log=$scratch/$1.log
  { "$cmake" -G Ninja -S "$examples/$1" -B "$scratch/$1" -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DCMAKE_CXX_COMPILER="$compiler" && "$cmake" --build "$scratch/$1" -j 1; } >"$log" 2>&1 ||
    { cat "$log"; fail "$1 does not build"; }
}

for example in bsdf integrand point-set plugin-c; do make_example "$example"; done
"$scratch/bsdf/bsdf_test" --gtest_brief=1
"$scratch/integrand/integrand"
"$scratch/point-set/point_set"
"$CARLO" validate --plugin "$scratch/plugin-c/mine.so" --params n=1 --samples 100000
if command -v gfortran >/dev/null; then
  make_example plugin-fortran
  "$CARLO" validate --plugin "$scratch/plugin-fortran/lobe.so" --samples 100000
else
  echo "plugin-fortran: skipped, gfortran is not installed"
fi
if command -v rustc >/dev/null; then
  make_example plugin-rust
  "$CARLO" validate --plugin "$scratch/plugin-rust/lobe.so" --samples 100000
else
  echo "plugin-rust: skipped, rustc is not installed"
fi
if [ -d "$scratch/prefix/include/render" ]; then
  make_example light
  "$scratch/light/light_test" --gtest_brief=1
  "$scratch/light/picture" "$scratch/hazy_sun.png"
fi
cd "$examples/program-python"
"$CARLO" validate --command "python3 sampler.py" --domain disk --samples 20000
"$CARLO" integrate --command "python3 integrand.py" -d "x=0:1,y=0:2"

# A job that is ended, and goes on when it is started again.
mkdir "$scratch/job" && cd "$scratch/job"
code=0
timeout -s TERM 1 "$examples/batch-job/job.sh" 100000 || code=$?
[ "$code" -eq 143 ] || [ "$code" -eq 124 ] || fail "the job ended with $code before SIGTERM"
[ -e cbox.ckpt ] || fail "the job left no checkpoint"
"$examples/batch-job/job.sh" 256
[ -e cbox.exr ] || fail "the job left no picture"
echo "examples.sh: all examples work"
