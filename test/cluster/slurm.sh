#!/bin/bash
# The Slurm scripts of input/ and the GNU parallel one against a real one-node cluster, started here and stopped at the end:
# bash slurm.sh RSC RSC_MPI INPUT FOLDER. Wants root, slurmctld, slurmd, munged. Exit status 77: skipped.
set -u
rsc=$1 rsc_mpi=$2 input=$3 folder=$4
[ "$(id -u)" -eq 0 ] || { echo "wants root"; exit 77; }
for program in slurmctld slurmd sbatch munged mungekey; do
    PATH=$PATH:/usr/sbin command -v $program > /dev/null || { echo "no $program"; exit 77; }
done
PATH=$PATH:/usr/sbin
export SOURCE_DATE_EPOCH=1700000000 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
rm -rf "$folder" && mkdir -p "$folder/state" "$folder/spool" && cd "$folder" || exit 1
folder=$PWD

pids=()
stop() {
    scancel --state=RUNNING --user=root 2> /dev/null
    for pid in "${pids[@]}"; do kill "$pid" 2> /dev/null; done
    wait
    rm -rf "$socket"
}
fail() {
    echo "failed: $*"
    tail -n 20 slurmctld.log slurmd.log rsc*.log 2> /dev/null
    exit 1
}
socket=$(mktemp -d --tmpdir rsc-munge-XXXXXX)   # munged wants a path that is safe, and short
chmod 755 "$socket"
trap stop EXIT

mungekey --create --keyfile="$socket/key" || exit 77
munged --foreground --force --key-file="$socket/key" --socket="$socket/socket" --log-file="$socket/log" --pid-file="$socket/pid" \
    --seed-file="$socket/seed" > munged.log 2>&1 &
pids+=($!)
host=$(hostname -s)
cat > slurm.conf << END
ClusterName=rsc
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$socket/socket
CredType=cred/munge
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf
sleep 1
slurmctld -D > /dev/null 2>&1 &
pids+=($!)
slurmd -D > /dev/null 2>&1 &
pids+=($!)
for _ in $(seq 60); do
    sinfo -h -o %T 2> /dev/null | grep -q idle && break
    sleep 0.5
done
sinfo -h -o %T 2> /dev/null | grep -q idle || { tail -n 20 slurmctld.log slurmd.log; echo "the cluster does not start"; exit 77; }

cp "$rsc" rsc && cp "$rsc_mpi" rsc_mpi && cp -r "$input" input || exit 1
sed -i 's/n = 1024/n = 256/; s/L_lambda_s = 256/L_lambda_s = 100/; s/128, 256/64, 100/; s/realizations = 20 /realizations = 5 /' input/study.nml
sed -i 's/n = 2048/n = 512/; s/L_lambda_s = 512/L_lambda_s = 200/; s/realizations = 200 /realizations = 800 /' input/campaign.nml
./rsc -q input/study.nml && ./rsc -q input/campaign.nml || fail "the direct run"
mv output direct && mkdir output

# The array, as the script's head says.
sbatch --wait --array=1-"$(./rsc --list input/study.nml | wc -l)" input/slurm_array.sh input/study.nml || fail "the array"
for file in direct/study_*; do cmp "$file" "output/${file#direct/}" || fail "the array differs"; done
echo "array: six members, the same files"

# The ranks; stopped in the middle by a signal as at a time limit, then submitted again.
job=$(sbatch --parsable --ntasks="$(nproc)" input/slurm_mpi.sh input/campaign.nml) || fail "sbatch"
for _ in $(seq 400); do
    [ "$(stat -c %s output/campaign.nc.checkpoint 2> /dev/null || echo 0)" -gt 100000 ] && break
    sleep 0.05
done
scancel --full --signal=TERM "$job"
while squeue -h -j "$job" 2> /dev/null | grep -q .; do sleep 0.2; done
[ -e output/campaign.nc.checkpoint ] || fail "the stopped job has left no state"
[ ! -e output/campaign.nc ] || fail "the job was not stopped"
sbatch --wait --ntasks="$(nproc)" input/slurm_mpi.sh input/campaign.nml || fail "the ranks"
cmp direct/campaign.nc output/campaign.nc || fail "the campaign differs"
echo "ranks: stopped, submitted again, the same file"

if command -v parallel > /dev/null; then
    rm output/study_*
    sh input/parallel.sh input/study.nml > parallel.log 2>&1 || { cat parallel.log; fail "parallel"; }
    for file in direct/study_*; do cmp "$file" "output/${file#direct/}" || fail "parallel differs"; done
    echo "parallel: the same files"
fi
