#!/bin/sh
# A study by GNU parallel, one member per core: sh input/parallel.sh input/study.nml (from the
# folder of rsc).
if ! command -v parallel > /dev/null 2>&1 || ! parallel --version 2> /dev/null | grep -q GNU; then
    echo 'parallel.sh: GNU parallel is not installed (Debian: apt install parallel).' \
        './rsc CASE alone uses all cores, too.' >&2
    exit 1
fi
./rsc --list "$1" |
    parallel --colsep ' ' ./rsc --quiet --resume --member '{1}' -s run%threads=1 "$1"
