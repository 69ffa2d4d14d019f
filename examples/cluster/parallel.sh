#!/usr/bin/env bash
# Runs a command of carlo in parts by GNU parallel, and merges them.
# Usage: parallel.sh PARTS OUTPUT COMMAND...     e.g. parallel.sh 100 out.exr render scene.xml --spp 4096
#   OUTPUT           what -o of the command names; "" for commands without -o, as validate --json r.json
#   CARLO            the program; default: carlo
#   WORK             folder for the files of the parts, which is kept; default: carlo-parts
#   PARALLEL         options of GNU parallel, as "--sshloginfile nodes --wd ." for several machines
# Run it again after an interruption: finished parts are not repeated.
set -eu
[ $# -ge 3 ] || { sed -n '2,8s/^# \?//p' "$0" >&2; exit 2; }
parts=$1 output=$2
shift 2
carlo=${CARLO:-carlo} work=${WORK:-carlo-parts}
mkdir -p "$work"
merge=("$carlo" merge)
[ -z "$output" ] || merge+=(-o "$output")

round=$(cat "$work/round" 2>/dev/null || echo 1)
while :; do
  resume=()
  [ "$round" = 1 ] || resume=(--resume "$work/all$((round - 1)).ckpt")
  # A part is one thread here; parallel runs one a processor.
  seq "$parts" | parallel --will-cite --halt soon,fail=1 \
    "$carlo" "${@@Q}" "${resume[@]@Q}" --threads 1 --part "{}/$parts" -o "$work/round$round-part{}.ckpt"
  files=("$work"/round"$round"-part*.ckpt)
  [ "$round" = 1 ] || files+=("$work/all$((round - 1)).ckpt")
  code=0
  rm -f "$work/all$round.ckpt"
  "${merge[@]}" "${files[@]}" --checkpoint "$work/all$round.ckpt" || code=$?
  [ -e "$work/all$round.ckpt" ] || exit "$code" # the results are written
  round=$((round + 1))
  echo "$round" >"$work/round"
done
