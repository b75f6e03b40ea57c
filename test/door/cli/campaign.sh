#!/bin/bash
# Campaigns and studies from outside: bash campaign.sh TEST RSC RSC_MPI FOLDER, RSC_MPI empty where
# it is not built.
test=$1 rsc=$2 rsc_mpi=$3 folder=$4
. "$(dirname "$0")/common.sh"

ranks() {
    local n=$1
    shift
    local root=
    [ "$(id -u)" -eq 0 ] && root=--allow-run-as-root
    # --foreground: a signal comes once. Told twice, mpirun leaves at once and its ranks behind, at
    # work.
    local run=(timeout --foreground 100 mpirun $root --oversubscribe -n "$n" "$rsc_mpi" "$@")
    if [ "$BASHPID" = $$ ]; then "${run[@]}"; else exec "${run[@]}"; fi
}

# $1 realizations of a few milliseconds each.
campaign() {
    cat > case.nml << END
&run         realizations = $1  first_realization = 3 /
&surface     n = 128  L_lambda_l = 8  L_lambda_s = 50  hurst = 0.7 /
&solver      model = 'asperities' /
&indentation steps = 20 /
&output      file = 'out.nc'  map_cells = 20 /
END
}
study() {
    cat > case.nml << 'END'
&surface     n = 128  L_lambda_l = 4  L_lambda_s = 32 /
&solver      model = 'asperities' /
&indentation steps = 8 /
&output      file = 'out/rsc.nc'  map_cells = 10 /
&study       surface%sigma = 0.005, 0.01, 0.02   run%realizations = 1, 5 /
END
}

# until_state SIZE PROCESS: until the state is larger, or the process has ended.
until_state() {
    while kill -0 "$2" 2> /dev/null &&
        [ "$(stat -c %s out.nc.checkpoint 2> /dev/null || echo 0)" -le "$1" ]; do
        sleep 0.01
    done
}

# The same bits whatever the number of threads.
test_threads() {
    campaign 40
    for n in 1 2 3; do
        expect 0 in_folder "threads$n" "$rsc" -s "run%threads=$n" ../case.nml
        same threads1/out.nc "threads$n/out.nc"
        [ "$(ls "threads$n")" = out.nc ] || fail "something is left beside out.nc"
    done
}

# The same bits whatever the number of ranks, and an interrupted job is finished by another number
# of them.
test_ranks() {
    campaign 60
    expect 0 in_folder one "$rsc" -s run%threads=1 ../case.nml
    for n in 1 2 3; do
        expect 0 in_folder "ranks$n" ranks $n ../case.nml
        same one/out.nc "ranks$n/out.nc"
    done
    expect 0 in_folder hybrid ranks 2 -s run%threads=2 ../case.nml
    same one/out.nc hybrid/out.nc
    campaign 400
    expect 0 in_folder whole "$rsc" -q ../case.nml
    mkdir killed && cd killed
    ranks 3 -q ../case.nml > said 2>&1 &   # a subshell, which leaves its place to the command
    until_state 20000 $!   # some work must be there to be kept
    kill -TERM %1 2> /dev/null
    wait
    expect 0 ranks 2 --resume ../case.nml
    cd .. && same whole/out.nc killed/out.nc
    # A refusal is one message, and the exit status of all.
    expect 2 ranks 2 -s surface%n=101 case.nml
    [ "$(grep -c "n = 101: must be even" said)" -eq 1 ] || fail "the message should be there once"
    # A study: members of one realization side by side, a campaign over all ranks.
    study
    expect 0 in_folder study1 "$rsc" ../case.nml
    expect 0 in_folder study3 ranks 3 ../case.nml
    diff -r study1/out study3/out || fail "the study differs"
}

# A signal leaves a state, says how to go on, and has its exit status; one realization leaves
# nothing (faults.sh).
test_signals() {
    campaign 20000
    for signal in TERM INT; do
        env --default-signal=INT "$rsc" -q --resume case.nml > said 2>&1 &
        until_state "$(stat -c %s out.nc.checkpoint 2> /dev/null || echo 0)" $!
        kill -s $signal $!
        wait $!
        [ $? -eq $([ $signal = INT ] && echo 130 || echo 143) ] || fail "exit status"
        says "SIG$signal; [0-9]* of 20000 realizations.*out.nc.checkpoint.*--resume"
        [ -s out.nc.checkpoint ] && [ ! -e out.nc ] || fail "the state is not as it should be"
    done
}

# Starts the command and kills it as soon as some work is in its state, however slow the machine is.
# What a kill at any byte leaves: test_campaign.
kill_with_state() {
    "$@" &
    until_state 20000 $!
    kill -s KILL $! && wait $!
    [ -s out.nc.checkpoint ] || fail "no state was left by $*"
}

# Nothing is lost by accident, and nothing is mixed up.
test_refused() {
    campaign 300
    sed 's/300/30000/' case.nml > long.nml
    kill_with_state "$rsc" -q long.nml
    cp out.nc.checkpoint before
    for check in "" --check; do
        expect 2 "$rsc" $check long.nml
        says "out.nc.checkpoint.*--resume"
    done
    expect 2 "$rsc" --resume -s surface%hurst=0.75 -s run%seed=2 long.nml
    says "surface%hurst: 0.7 there, 0.75 now"
    says "run%seed: 1 there, 2 now"
    expect 2 "$rsc" --resume case.nml
    says "run%realizations: 30000 there, 300 now"
    head -c "$(stat -c %s out.nc.checkpoint)" before | cmp - out.nc.checkpoint ||
        fail "a refusal has changed the state"
    # A torn frame at the end may be cut off, nothing else.
    [ $(($(stat -c %s before) - $(stat -c %s out.nc.checkpoint))) -lt 20000 ] ||
        fail "a refusal has taken from the state"
    [ ! -e out.nc ] || fail "a refusal has written"
    # Two at a time.
    "$rsc" -q --resume -s run%threads=1 long.nml 2> /dev/null &
    until_state "$(stat -c %s out.nc.checkpoint)" $!
    expect 2 "$rsc" --resume long.nml
    says "another process"
    kill %1
    wait
    # Another spectrum in the file that the case names.
    rm out.nc.checkpoint
    printf '6.3 1e-5\n200 1e-9\n' > table.txt
    sed -e "s/&surface/\&surface source = 'spectrum' file = 'table.txt'/" \
        -e 's/ *L_lambda_[ls] *= *[0-9]*//g' -e 's/ hurst *= *[0-9.]*//' long.nml > table.nml
    kill_with_state "$rsc" -q table.nml
    expect 2 "$rsc" --resume -s run%realizations=10 table.nml
    says "run%realizations"
    printf '6.3 1e-5\n200 2e-9\n' > table.txt
    expect 2 "$rsc" --resume table.nml
    says "input files"
    # Another number of threads, and another format, are the same case.
    rm out.nc.checkpoint
    expect 0 in_folder whole "$rsc" -q -s "output%format='classic'" ../case.nml
    kill_with_state "$rsc" -q -s run%threads=1 case.nml
    expect 0 "$rsc" --resume -s run%threads=3 -s "output%format='classic'" case.nml
    same whole/out.nc out.nc
    expect 0 "$rsc" --resume -s "output%format='classic'" case.nml
    says "is complete"
}

# A finished campaign grows: the realizations there are not computed again, and the file is that of
# the whole, within rounding.
test_grow() {
    campaign 30
    expect 0 in_folder whole "$rsc" -q ../case.nml
    mkdir grown && cd grown
    expect 0 "$rsc" -q -s run%realizations=11 ../case.nml
    expect 0 "$rsc" --resume -s run%realizations=18 ../case.nml
    says "11 of them"
    expect 0 "$rsc" --resume ../case.nml
    says "18 of them"
    alike ../whole/out.nc out.nc
    # A growth that is interrupted goes on from its own state, without the result.
    sed 's/= 30 /= 30000 /' ../case.nml > long.nml
    "$rsc" -q --resume long.nml 2> /dev/null &
    until_state 1000000 $!   # three times what the result had
    kill -s KILL $! && wait $!
    cp out.nc.checkpoint before
    rm out.nc
    "$rsc" --resume long.nml > said 2>&1 &
    until_state "$(stat -c %s out.nc.checkpoint)" $!
    kill -s KILL $! && wait $!
    [ "$(sed -n 's/.*; \([0-9]*\) of them are finished/\1/p' said)" -ge 30 ] || {
        cat said
        fail "what the result had is lost"
    }
    rm -f out.nc.checkpoint before long.nml
    # Fewer: refused, and nothing is lost. Another case: told, and computed.
    expect 0 "$rsc" -q ../case.nml
    cp out.nc before
    for fewer in realizations=5 first_realization=4,realizations=2 realizations=1; do
        expect 2 "$rsc" --resume -s "run%${fewer%,*}" -s "run%${fewer#*,}" ../case.nml
        says "complete: it holds 30 realizations"
        cmp out.nc before || fail "the file was changed"
    done
    rm before
    expect 0 "$rsc" --resume -s surface%hurst=0.75 ../case.nml
    says "surface%hurst: 0.7 there, 0.75 now"
    silent_on "are finished"
}

# Parts of a campaign are put together into the file of the whole; what does not belong together is
# refused by name.
test_merge() {
    campaign 30
    expect 0 in_folder whole "$rsc" -q ../case.nml
    part() {
        expect 0 in_folder "$1" "$rsc" -q -s run%first_realization="$2" -s run%realizations="$3" \
            "${@:4}" ../case.nml
    }
    part a 3 11
    part b 14 3
    part c 17 16
    mkdir merged && cd merged
    expect 0 "$rsc" --merge ../c/out.nc ../a/out.nc ../b/out.nc -o out.nc
    says "30 realizations, 600 levels"
    alike ../whole/out.nc out.nc
    cd ..
    # Times of levels are the same in all realizations.
    local relaxing=(-s solids%relaxation_share=0.5 -s solids%relaxation_time=1.0
        -s indentation%duration=2.0)
    part soft 1 4 "${relaxing[@]}"
    part soft_a 1 2 "${relaxing[@]}"
    part soft_b 3 2 "${relaxing[@]}"
    mkdir soft_merged && cd soft_merged
    expect 0 "$rsc" --merge ../soft_a/out.nc ../soft_b/out.nc -o out.nc
    alike ../soft/out.nc out.nc
    cd ..
    part law 14 4 -s "asperities%law='elliptic'"
    part one 14 1
    part later 15 2
    part classic 14 3 -s "output%format='classic'"
    study
    expect 0 in_folder study "$rsc" -q ../case.nml
    echo text > text.nc
    refused() {
        local word=$1
        shift
        expect 2 "$rsc" --merge "$@" -o new.nc
        says "$word"
        [ ! -e new.nc ] || fail "a refusal has written"
    }
    refused "asperities%law: 'fourth_order' in 'a/out.nc', 'elliptic' in 'law/out.nc'" \
        a/out.nc law/out.nc
    refused "one/out.nc.*single" a/out.nc one/out.nc
    refused "rsc_manifest.nc.*manifest" a/out.nc study/out/rsc_manifest.nc
    refused "text.nc.*no result of rsc" a/out.nc text.nc
    refused "realizations 3 to 13 .*'a/out.nc'.*'a/../a/out.nc'" a/out.nc a/../a/out.nc
    refused "realizations 14 to 16 .*missing" a/out.nc c/out.nc
    refused "realization 14 .*missing" a/out.nc later/out.nc
    sed -i 's/rsc 0\.[0-9]*\.[0-9]*,/rsc 0.0.9,/' classic/out.nc
    truncate -s -47 classic/out.nc  # its checksum
    refused "classic/out.nc.*0.0.9" a/out.nc classic/out.nc
    expect 2 "$rsc" --merge a/out.nc b/out.nc -o text.nc
    grep -q text text.nc || fail "a file of somebody else was replaced"
    expect 2 "$rsc" --merge a/out.nc b/out.nc -o b/out.nc; says "input of the run"
}

# A study in one go and as an array of jobs: the same files. A bad member is refused before anything
# runs.
test_study() {
    study
    expect 0 in_folder one "$rsc" ../case.nml
    expect 0 in_folder one "$rsc" --list ../case.nml
    [ "$(wc -l < said)" -eq 6 ] || fail "--list has not six lines"
    says "^5  out/rsc_005.nc  surface%sigma=0.02 run%realizations=1"
    mkdir array
    for k in 6 2 4 1 5 3; do (cd array && "$rsc" -q --member $k ../case.nml) & done
    wait
    diff -r one array || fail "the array differs"
    [ "$(ls one/out | wc -l)" -eq 7 ] || fail "six members and a manifest were expected"

    expect 2 in_folder bad "$rsc" -s surface%n=60 ../case.nml
    expect 2 in_folder bad "$rsc" --member 7 ../case.nml
    [ -z "$(ls bad)" ] || fail "a refused study has written"

    # Finished members are left alone, the others are made.
    cd array
    rm out/rsc_003.nc
    touch -d @1000000000 out/rsc_00*.nc
    expect 0 "$rsc" --resume ../case.nml
    says "member 2 .*is complete"
    cd ..
    [ "$(find array/out -name 'rsc_00*.nc' -newermt @1000000001 | wc -l)" -eq 1 ] ||
        fail "one member should have been made"
    diff -r one array || fail "the resumed study differs"
    # One from another case is made again.
    cp one/out/rsc_001.nc array/out/rsc_002.nc
    expect 0 in_folder array "$rsc" --resume ../case.nml
    diff -r one array || fail "a member of another case was taken"
}

# No room for the state: the work so far is kept, and goes on once there is room. Here the limit of
# file sizes stands for the disk.
test_limit() {
    campaign 300
    expect 0 in_folder whole "$rsc" -q -s run%realizations=310 ../case.nml
    expect 1 bash -c 'ulimit -f 256; exec "$0" -q case.nml' "$rsc"
    says "cannot write 'out.nc.checkpoint'"
    says "of 300 realizations are finished and saved.*--resume"
    [ ! -e out.nc ] || fail "there is a file under the final name"
    [ "$(stat -c %s out.nc.checkpoint)" -gt 200000 ] || fail "the work is lost"
    expect 0 "$rsc" --resume -s run%realizations=310 case.nml   # and as a larger one
    same whole/out.nc out.nc
}

"test_$test"
