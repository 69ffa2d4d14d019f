#!/bin/sh
#SBATCH --job-name=cbox --time=01:00:00 --requeue --signal=B:TERM@60
# A render for a queue that may end it at any time and start it again: it goes on where it was. The picture has the bits
# of a run without interruption.
# Usage: job.sh [SPP]   in the folder of the results
carlo=${CARLO:-carlo}
state=cbox.ckpt
[ ! -e "$state" ] || resume="--resume $state"
# shellcheck disable=SC2086
exec "$carlo" render cbox --size 64x64 --spp "${1:-1024}" -o cbox.exr --checkpoint "$state" --every 1min ${resume:-}
