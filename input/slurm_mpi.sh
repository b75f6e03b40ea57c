#!/bin/bash
# A campaign or a study on the ranks of one Slurm job. From the folder of rsc_mpi:
#
#     sbatch --ntasks=64 input/slurm_mpi.sh input/campaign.nml
#
# Submitted again, it continues after a time limit, with any number of ranks.
#SBATCH --job-name=rsc_mpi
#SBATCH --ntasks=2
#SBATCH --time=01:00:00
#SBATCH --output=rsc_mpi-%j.log
exec mpirun -n "$SLURM_NTASKS" ./rsc_mpi --resume --progress always "$@"
