#!/bin/bash
# Where main() puts what it says: refusals with status 2 and warnings on standard error, what was
# asked for on standard output, and no file but the result: bash said.sh TEST RSC DATA FOLDER. What
# is refused and told in which words: test_refusals.
test=$1 rsc=$2 data=$3 folder=$4
. "$(dirname "$0")/common.sh"

# run STATUS FILES arguments... < case: in an empty folder, with FILES there in the end.
run() {
    local wanted=$1 files=$2
    shift 2
    rm -rf work && mkdir work
    (cd work && exec "$rsc" "$@") > out 2> err
    local got=$?
    [ $got -eq "$wanted" ] || { cat out err; fail "exit status $got instead of $wanted: $*"; }
    left work "$files"
}
# The whole of a stream, its lines in one, matches; '' asserts silence.
stream() {
    if [ -z "$2" ]; then [ ! -s "$1" ]; else tr '\n' '|' < "$1" | grep -qE -- "$2"; fi || {
        head -n 20 out err
        fail "$1 is not '$2'"
    }
}
err() { stream err "$1"; }
out() { stream out "$1"; }

test_refused() {
    run 2 "" <<< $'&surface simga=1\n hurst=2 /\n&solver method=\'x\' /'
    out ''
    err '^<stdin>:1:10: .*\|<stdin>:2:8: .*\|<stdin>:3:16: '
    run 2 "" nowhere.nml; out ''; err 'nowhere.nml: No such file'
    run 2 "" .; out ''; err '\.: is a folder'
    run 2 "" --case nowhere.nc; out ''; err 'nowhere.nc: No such file'
    run 2 "" --chek; out ''; err 'chek.*--check'
    run 2 "" --describe surface%simga; out ''; err 'sigma'
}

test_asked() {
    run 0 "" --check -q -s run%seed=42 -o there.nc <<< '&surface sigma=2d-2 /'
    err ''; out 'seed += 42\|.*sigma += 0.02\|.*file += .there.nc.\|'
    run 0 "" --check -q <<< '&indentation start=1, stop=4 /'
    err 'start = 1.0.*stop = 4.0'
    out start
    # A study whose members are all right, on a base that is not: nothing runs the base.
    run 0 "" --check -q <<< $'&surface n=64 L_lambda_l=2 /\n&study surface%L_lambda_s = 8, 16 /'
    err ''
    out 'L_lambda_s += 512.0\|.*surface%L_lambda_s = 8, 16\|'
    run 0 "" --describe; err ''; out '&run: .*&surface: .*hurst = 0.8.*&study: '
    run 0 "" --describe surface%hurst; err ''; out 'hurst = 0.8\| +real, unit 1, 0 to 1\|'
    run 0 "" --help; err ''; out '^usage: rsc '
    run 0 "" --version; err ''; out '^rsc [0-9.]+\|$'
}

# Alone under the tip on a flat of E* = 1 an asperity of radius 1 pressed in by 0.01 carries
# N = (4/3) 0.01^(3/2) on A = 0.01 pi. Two whose spots overlap (a = 0.01 each but for their
# interaction, 0.015 apart) have one solution: above (2/pi) a.
test_levels() {
    flats="&solids E=1, Infinity, nu=0, 0, R=Infinity, Infinity /"
    run 0 result.nc -o result.nc <<< "
&surface source='asperities', file='$data/one_asperity.txt', sigma=0.01, L=1 / $flats
&indentation levels=0.01, unit='length' / &run length_unit='um', force_unit='mN' /"
    err ''
    local columns='level +Z0 .um. +Z0/sigma +N .mN. +A .um2. +contacts candidates.*\|'
    out "$columns +1 +0.01 +1.00000 +0.0013333333 +0.031415927 +1 +1 "
    run 0 result.nc -o result.nc <<< "
&surface source='asperities', file='$data/two_asperities.txt', sigma=0.01, L=20 / $flats
&indentation levels=0.0, unit='length', boundary='periodic' /"
    err ''; out '\| +1 +0 +0.00000 [^|]*  overlapping\|.*1 of 1 levels: overlapping - '
    # Names with blanks are quoted in the commands for the next step.
    run 0 "it's one.nc" -o "it's one.nc" <<< "&surface n=64, L_lambda_l=2, L_lambda_s=8 /
&indentation steps=2 /"
    out "picture: python3 [^ ]*plot.py 'it'.''s one.nc'"
    run 1 result.nc -o result.nc <<< "&surface n=64, L_lambda_l=2, L_lambda_s=16 /
&indentation levels=0.5, 0.0, -1.0 / &solver max_iterations=1 / &compare levels='none' /"
    err '[1-3] of 3 levels did not converge'; out '[1-3] of 3 levels: '
}

"test_$test"
