#!/bin/bash
# What input/ offers, run as its comments say, smaller where it would take long:
# bash inputs.sh TEST RSC PROJECT FOLDER.
# Exit status 0: passed, 77: something that is no part of rsc is missing, anything else: failed.
test=$1 rsc=$2 project=$3 folder=$4
. "$(dirname "$0")/common.sh"
mkdir output && cp -r "$project/input" input && cp "$rsc" rsc
if python3 -c 'import numpy, matplotlib, netCDF4' 2> /dev/null; then
    python=python3
else
    python=/usr/bin/python3
fi
draws() { "$python" -c 'import numpy, matplotlib, netCDF4' 2> /dev/null; }
pictures() { find output -name '*.png' | wc -l; }
small='-s indentation%steps=4 -s run%realizations=2'

# A study and a campaign run, and a picture is made of the latter.
test_cases() {
    expect 0 ./rsc --list input/study.nml
    [ "$(wc -l < said)" -eq 6 ] || fail "six members were expected: $(cat said)"
    expect 0 ./rsc $small input/study.nml
    for k in 001 002 003 004 005 006 manifest; do
        [ -s output/study_$k.nc ] || fail "no output/study_$k.nc: $(ls output)"
    done
    expect 0 ./rsc --resume $small input/study.nml
    [ "$(grep -c 'is complete' said)" -eq 6 ] || fail "finished members are run again: $(cat said)"
    expect 0 ./rsc $small -s surface%n=512 -s surface%L_lambda_s=128 input/campaign.nml
    [ -s output/campaign.nc ] || fail "the campaign has left no file"
    expect 0 ./rsc input/map/map.nml
    # input/README breaks the long lines of the report; their second halves are indented further.
    sed -n '/^    map: 160/,/^$/s/^    //p' input/README | sed -e :a -e 'N;$!ba;s/\n  / /g' > told
    [ "$(wc -l < told)" -eq 6 ] && ! grep -vxFf said told ||
        fail "input/README tells of another map: $(cat said)"
    draws || exit 77
    expect 0 "$python" "$project/output/plot/plot.py" output/campaign.nc
    [ "$(pictures)" -ge 1 ] || fail "plot.py has made no picture: $(ls output)"
}

# The newcomer's script from end to end; what installs and builds is replaced by what only puts the
# program in place.
test_first() {
    draws || exit 77
    rm rsc
    mkdir -p output/plot modules/rsc
    cp "$project"/output/plot/*.py output/plot/
    cp "$project"/modules/rsc/_sound.py modules/rsc/
    cat > input/setup.sh << END
#!/bin/sh
[ "\$(pwd)" = "$(pwd)" ] || exit 1
mkdir -p build && cp "$rsc" build/rsc && echo "\$@" > setup_was_called
END
    expect 0 in_folder / sh "$folder/input/first.sh"
    grep -q RSC_TESTS=OFF setup_was_called || fail "setup.sh was not called to build without tests"
    [ -s output/first.nc ] || fail "no output/first.nc: $(ls output)"
    grep -q '^  *6  ' said || fail "no table of 6 levels: $(cat said)"
    [ "$(pictures)" -ge 1 ] || fail "no picture: $(ls output)"
}

# A study by GNU parallel leaves what a study in one go leaves.
test_parallel() {
    parallel --version 2> /dev/null | grep -q GNU || exit 77
    sed 's/realizations = 20/realizations = 2/; s/steps = 50/steps = 4/' input/study.nml > small.nml
    expect 0 sh input/parallel.sh small.nml < /dev/null
    mkdir one_go && cd one_go && ../rsc -q ../small.nml || fail "the study in one go"
    for k in 1 2 3 4 5 6; do same output/study_00$k.nc ../output/study_00$k.nc; done
}

# The scripts for Slurm, with its variables set as sbatch sets them: the array leaves what a study
# in one go leaves, and is complete when submitted again; the ranks get their number and the case.
test_slurm() {
    sed 's/realizations = 20/realizations = 2/; s/steps = 50/steps = 4/' input/study.nml > small.nml
    for again in '' complete; do
        for k in 1 2 3 4 5 6; do
            expect 0 env SLURM_ARRAY_TASK_ID=$k SLURM_CPUS_PER_TASK=2 \
                bash input/slurm_array.sh small.nml
            says "$again"
        done
    done
    mkdir one_go && cd one_go && ../rsc -q ../small.nml || fail "the study in one go"
    for k in 1 2 3 4 5 6; do same output/study_00$k.nc ../output/study_00$k.nc; done
    cd ..
    printf '#!/bin/sh\necho ranks "$@"\n' > mpirun && chmod +x mpirun
    expect 0 env PATH="$PWD:$PATH" SLURM_NTASKS=3 bash input/slurm_mpi.sh small.nml
    says "^ranks -n 3 ./rsc_mpi --resume .*small.nml$"
}

"test_$test"
