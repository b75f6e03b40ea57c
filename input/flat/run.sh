#!/bin/sh
# Known results on rough flats under pressure: runs the cases of input/flat, draws two pictures
# and writes the report.
# Usage: sh input/flat/run.sh [--short] [RSC [FOLDER]], as explained in input/run_cases.sh;
# FOLDER is output/flat by default.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
study=flat

# The short version: three of the smaller surfaces each.
shorten() {
    sed -e 's/realizations = 20/realizations = 3/; s/8, 8, 8, 4, 4, 4, 2, 2$/8, 8, 4/' \
        -e 's/16, 32, 64, 64, 128, 256, 256, 512$/16, 32, 32/' \
        -e 's/64, 128, 256, 256, 512, 1024, 1024, 2048/64, 128, 128/; s/2, 4, 8$/2, 4/' \
        -e 's/32, 64, 128$/32, 64/; s/128, 256, 512 /128, 256 /; s/steps = 10/steps = 5/'
}

cases='alpha_elements alpha_asperities size_elements size_asperities'

. "$here/../run_cases.sh"
