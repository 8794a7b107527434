#!/usr/bin/env bash
#SBATCH --job-name=barehand
#SBATCH --cpus-per-task=1
#SBATCH --mem=1G
#SBATCH --requeue
#SBATCH --signal=B:TERM@60
# Tracks a list of logs as a Slurm array job. If it is submitted again, it tracks the logs that are not finished.
#   sbatch --array=0-$(($(wc -l <LIST) - 1)) /usr/share/barehand/deploy/batch/slurm.sh LIST OUT [TRACK OPTIONS]
# If there are more logs than the cluster's MaxArraySize, use fewer elements (--array=0-999): each tracks several logs,
# one after the other. The elements must be numbered from 0 without gaps. The environment variable BAREHAND_BATCH names
# the folder of share.sh, because Slurm runs a copy of this script.
set -u

[ $# -ge 2 ] && [ -n "${SLURM_ARRAY_TASK_ID:-}" ] || { sed -n '7,11s/^# \{0,1\}//p' "$0" >&2; exit 2; }
list=$1 out=$2
shift 2
exec "${BAREHAND_BATCH:-/usr/share/barehand/deploy/batch}/share.sh" "$SLURM_ARRAY_TASK_ID" "$SLURM_ARRAY_TASK_COUNT" \
  "$list" "$out" "$@"
