#!/usr/bin/env bash
#SBATCH --job-name=carlo
#SBATCH --array=1-100
#SBATCH --cpus-per-task=8
#SBATCH --time=04:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --output=carlo-%A-%a.log
# Runs a command of carlo as an array of parts, and merges them.
# Usage: sbatch slurm.sh OUTPUT COMMAND...      e.g. sbatch --array=1-200 slurm.sh out.exr render scene.xml --spp 65536
#   OUTPUT   what -o of the command names
# Every part saves its state, and goes on from it after a requeue. The last part to end submits the job that merges;
# that job submits a further round where the run has a barrier.
set -eu
output=$1
shift
work=carlo-parts-$SLURM_ARRAY_JOB_ID parts=$SLURM_ARRAY_TASK_COUNT k=$SLURM_ARRAY_TASK_ID
base=${CARLO_BASE:-} # merged results of the round before
mkdir -p "$work"
part=$work/part$k.ckpt
resume=()
[ -z "$base" ] || resume=(--resume "$base")

# USR1, two minutes before the limit: carlo saves its state and ends, and the part is queued again.
"${CARLO:-carlo}" "$@" "${resume[@]}" --threads "$SLURM_CPUS_PER_TASK" --part "$k/$parts" -o "$part" &
program=$!
trap 'kill -USR1 $program' USR1
code=0
wait "$program" || code=$?
while kill -0 "$program" 2>/dev/null; do wait "$program" || code=$?; done
if [ "$code" -ge 128 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$k"
  exit 0
fi
[ "$code" -eq 0 ] || exit "$code"

touch "$work/done$k"
[ "$(ls "$work"/done* | wc -l)" -eq "$parts" ] || exit 0
mkdir "$work/merging" 2>/dev/null || exit 0 # another part was the last, too
all=$work/all.ckpt
# shellcheck disable=SC2086
"${CARLO:-carlo}" merge $base "$work"/part*.ckpt -o "$output" --checkpoint "$all" || code=$?
[ -e "$all" ] || exit "$code" # the results are written
time=$(squeue --noheader --jobs="${SLURM_ARRAY_JOB_ID}_$k" --format=%l)
CARLO_BASE=$all sbatch --export=ALL --array="1-$parts" --cpus-per-task="$SLURM_CPUS_PER_TASK" --time="$time" \
  ${SLURM_JOB_PARTITION:+--partition="$SLURM_JOB_PARTITION"} ${SLURM_JOB_ACCOUNT:+--account="$SLURM_JOB_ACCOUNT"} \
  "$0" "$output" "$@"
