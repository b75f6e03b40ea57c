#!/bin/bash
# paper.sh RSC PROJECT FOLDER: input/paper/run.sh --short from beginning to end; 77 where Python lacks its modules.
rsc=$1 project=$2 folder=$3
. "$(dirname "$0")/common.sh"

shortened paper asperities curvatures area area_slope maps radial pressure_mean pressure_full spots density
grep -q "^the report: $folder/paper/report.txt" "$folder/log.txt" || fail "run.sh does not end with where the report is"
# It begins with a verdict on nine numbers of the paper, made from its own rows.
[ "$(head -n 25 "$report" | grep -c ': agrees$\|: does not agree, [-+][0-9]* %$')" -eq 9 ] || fail "not nine verdicts: $(head -n 25 "$report")"
# What does not depend on the size of the run: Greenwood's mode by its own formula, kappa1/kappa2 = 2.2153.
grep -q 'ratio 2\.2153' "$report" || fail "the mode of Greenwood's density is not at kappa1/kappa2 = 2.2153"
grep -q "value of Greenwood's formula itself  *1\.356  *1\.356 " "$report" || fail "the mean of Greenwood's density is not 1.356"
# The surfaces beside elements are not shortened, only fewer: eight points to the shortest wave, of which hertz takes the highest for
# summits, so that its load is 4 to 9 % too low; that of fourth_order is within 3 %.
for waves in 64 128; do
    load() { sed -n "s/^ *$waves $1  *\([-+][0-9.]*\) (.*/\1/p" "$report"; }
    awk -v h="$(load hertz)" -v f="$(load fourth_order)" 'BEGIN { exit !(h != "" && f != "" && h < -4 && h > -9 && f > -3 && f < 1) }' ||
        fail "load beside elements, L/lambda_s = $waves: hertz $(load hertz) %, fourth_order $(load fourth_order) %"
done
# Gold yields, and carries far less then.
load() { sed -n "s/^ *N at Z0\/sigma = 2 \[N\], $1  *-  *\([0-9.e+-]*\) .*/\1/p" "$report"; }
awk -v e="$(load elastic)" -v y="$(load yielding)" 'BEGIN { exit !(e > 0 && y > 0 && y < 0.3 * e) }' || fail "N elastic $(load elastic), yielding $(load yielding)"
# Rough elastic contact, solved without asperities: beta near 0.9 on these surfaces.
beta=$(sed -n 's/^ *beta at 1 sigma, .*, elements *0\.2 *\([0-9.]*\) .*/\1/p' "$report")
awk -v b="$beta" 'BEGIN { exit !(b > 0.8 && b < 1.05) }' || fail "beta of elements = '$beta'"
# Six small surfaces scatter, but A E* slope/N of any rough elastic contact lies between Persson's 1.6 and Bush, Gibson and Thomas' 2.5
# within a fifth: beta between 0.5 and 1.2. The paper's 0.2, or a lost factor of 2, is outside.
beta=$(sed -n 's/^ *beta, mean of the six members *0\.2 *\([0-9.]*\) .*/\1/p' "$report")
awk -v b="$beta" 'BEGIN { exit !(b > 0.5 && b < 1.2) }' || fail "beta = '$beta' is no rough elastic contact's"
