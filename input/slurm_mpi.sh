#!/bin/bash
# A campaign or a study over the ranks of one Slurm job. From the folder that holds rsc_mpi:
#
#     sbatch --ntasks=64 input/slurm_mpi.sh input/campaign.nml
#
# Submitted once more it goes on where a time limit has stopped it, with as many ranks as you like.
#SBATCH --job-name=rsc_mpi
#SBATCH --ntasks=2
#SBATCH --time=01:00:00
#SBATCH --output=rsc_mpi-%j.log
exec mpirun -n "$SLURM_NTASKS" ./rsc_mpi --resume --progress always "$@"
