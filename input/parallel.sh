#!/bin/sh
# A study by GNU parallel, a member a core: sh input/parallel.sh input/study.nml (from the folder that holds rsc).
./rsc --list "$1" | parallel --colsep ' ' ./rsc --quiet --resume --member '{1}' -s run%threads=1 "$1"
