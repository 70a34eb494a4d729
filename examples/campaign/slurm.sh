#!/bin/bash
# A campaign as an array job of Slurm. Each task plays a shard; all write into one folder, which has to be on a file
# system that the nodes share. The last to end writes the whole report.
#
#   sbatch --array=1-4 slurm.sh shoves.yaml results
#   sbatch --array=1-4 slurm.sh walk.yaml results -- python3 walk.py lo
#
#SBATCH --job-name=rehearse
#SBATCH --array=1-4
#SBATCH --cpus-per-task=2
#SBATCH --output=rehearse-%A-%a.log
set -eu

scenario=$1
out=${2:-results}
shift $(($# < 2 ? $# : 2))

exec understudy rehearse "$scenario" --out "$out" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
  --jobs "${SLURM_CPUS_PER_TASK:-1}" "$@"
