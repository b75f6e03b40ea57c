#!/bin/sh
# All results of the paper: runs the cases of input/paper, draws the pictures and writes the
# report.
# Usage: sh input/paper/run.sh [--short] [RSC [FOLDER]], as explained in input/run_cases.sh;
# FOLDER is output/paper by default.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
study=paper

# The short version: an eighth of the grid and of its waves, and a few realizations.
shorten() {
    case $1 in
        asperities | dgesv) script='
            s/n = 2048/n = 256/; s/n = 1024/n = 512/; s/L_lambda_s = 512/L_lambda_s = 64/
            s/steps = 100/steps = 8/' ;;
        curvatures) script='
            s/n = 8192/n = 1024/; s/L_lambda_s = 512/L_lambda_s = 64/
            s/2048, 1024, 512/256, 128, 64/' ;;
        density) script='
            s/n = 4096/n = 512/; s/L_lambda_s = 25,.*/L_lambda_s = 25, 50, 125 \//
            s/hurst = 0.1,.*0.9$/hurst = 0.1, 0.5, 0.9/
            s/realizations = .*/realizations = 3 \//' ;;
        density_grid) script='
            s/L_lambda_s = 1000/L_lambda_s = 125/; s/2048,.*/256, 512, 1024 \//
            s/realizations = .*/realizations = 3 \//' ;;
        laws) script='
            s/3\*64, 3\*128, 3\*256, 6\*512/3*64, 6*128/
            s/3\*512, 3\*1024, 3\*2048, 3\*2048, 3\*4096/3*512, 3*512, 3*1024/
            s/realizations = [0-9]*/realizations = 4/; /hertz.*hertz/d' ;;
        elements) script='
            s/64, 128, 256, 2\*512/64, 2*128/; s/4\*.false., .true./2*.false., .true./
            s/realizations = [0-9]*/realizations = 4/' ;;
        contacts) script='
            s/n = 2048/n = 256/; s/L_lambda_s = 512/L_lambda_s = 64/; s/5, 6, .*/5 \//; /^ *21/d' ;;
        *) script='
            s/realizations = [0-9]*/realizations = 6/; s/n = 2048, 4096/n = 256, 512/
            s/n = 2048/n = 256/; s/256, 512 \/$/32, 64 \//; s/L_lambda_s = 256/L_lambda_s = 32/
            s/L_lambda_s = 512/L_lambda_s = 64/; s/L_lambda_l = 24/L_lambda_l = 8/
            s/L_lambda_l = 48/L_lambda_l = 16/; s/steps = 100/steps = 16/' ;;
    esac
    sed -e "$script"
}

cases='asperities curvatures density density_grid area area_R5 area_l48 maps maps_plateau contacts
       yielding trials trials_R5 laws elements dgesv'
. "$here/../run_cases.sh"
