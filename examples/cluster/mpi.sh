#!/usr/bin/env bash
#SBATCH --job-name=carlo
#SBATCH --ntasks=64
#SBATCH --cpus-per-task=1
#SBATCH --time=04:00:00
#SBATCH --signal=USR1@120
#SBATCH --requeue
# Runs a command of carlo on the ranks of MPI (a build with -DMC_MPI=ON). Goes on from its checkpoint after a requeue.
# Usage: sbatch mpi.sh COMMAND...               e.g. sbatch --ntasks=256 mpi.sh render scene.xml --spp 65536 -o out.exr
set -eu
state=carlo-$SLURM_JOB_ID.ckpt
files=(--checkpoint "$state" --every 5min)
[ ! -e "$state" ] || files=(--resume "$state" --every 5min)
code=0
srun --mpi=pmix "${CARLO:-carlo}" "$@" --threads "$SLURM_CPUS_PER_TASK" "${files[@]}" || code=$?
[ "$code" -lt 128 ] || scontrol requeue "$SLURM_JOB_ID"
exit "$code"
