#!/usr/bin/env bash
# Checks that two builds of carlo give the same bits: images, integrals and all figures of a validation except times.
# Usage: same_bits.sh CARLO OTHER_CARLO
set -eu
scenes=$(cd "$(dirname "$0")/../../librender/scenes" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
# same NAME: compares the files `one` and `two`, which contain no parts that differ between runs.
same() {
  if cmp -s "$scratch/one" "$scratch/two"; then echo "same bits: $1"; else
    echo "DIFFERENT: $1"
    diff "$scratch/one" "$scratch/two" | head -n 6
    failed=1
  fi
}

for scene in "$scenes"/*.xml; do
  for run in "one $1" "two $2"; do
    read -r name carlo <<<"$run"
    "$carlo" render "$scene" -o "$scratch/$name.pfm" --size 32x32 --spp 16 >/dev/null
    mv "$scratch/$name.pfm" "$scratch/$name"
  done
  same "$(basename "$scene")"
done
for integrand in "exp(-x*x)*cos(y) -d x=0:1,y=-1:2" "sqrt(x)*log(y)+z*v -d x=0:1,y=1:2,z=0:1,v=0:3" "genz_c0_8d" \
  "x*y exp(x) x+y -d x=0:1,y=0:1 --derive I2/I1-I3"; do
  for run in "one $1" "two $2"; do
    read -r name carlo <<<"$run"
    # shellcheck disable=SC2086
    "$carlo" integrate $integrand --rel-error 1e-4 | sed 's/ in [0-9.]* [m]*s / /' >"$scratch/$name"
  done
  same "integrate $integrand"
done
for run in "one $1" "two $2"; do
  read -r name carlo <<<"$run"
  "$carlo" validate --all --samples 20000 --json "$scratch/$name.json" >/dev/null || true
  tr ',' '\n' <"$scratch/$name.json" | grep -vE '"(ns_per_sample|seconds|command|commit)"' >"$scratch/$name"
done
same "validate --all"
exit $failed
