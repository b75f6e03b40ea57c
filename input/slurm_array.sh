#!/bin/bash
# A study as a Slurm job array, one member per task. From the folder of rsc:
#
#     sbatch --array=1-$(./rsc --list input/study.nml | wc -l) input/slurm_array.sh input/study.nml
#
# Submitted again, it completes interrupted members and keeps finished ones.
#SBATCH --job-name=rsc
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
#SBATCH --output=rsc-%A_%a.log
exec ./rsc --resume --member "$SLURM_ARRAY_TASK_ID" -s "run%threads=${SLURM_CPUS_PER_TASK:-1}" "$@"
