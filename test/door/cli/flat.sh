#!/bin/bash
# flat.sh RSC PROJECT FOLDER: input/flat/run.sh --short from beginning to end; 77 where Python lacks its modules.
rsc=$1 project=$2 folder=$3
. "$(dirname "$0")/common.sh"
for case in "$project"/input/flat/*.nml; do expect 0 "$rsc" --check "$case"; done
shortened flat kappa stiffness
# Nine small surfaces: area over load lies between Persson's and a little above that of Bush, Gibson and Thomas, both models within 5 %, and a
# small surface at light pressures is stiffer than in proportion.
awk '$3 ~ /^[0-9.]+$/ && /\+-/ && NF == 11 { n++; if (!($4 > 1.6 && $4 < 2.7)) bad = 1; d = $10; sub("%", "", d); if (d > 5 || d < -5) bad = 1 }
     END { exit bad || n != 3 }' "$report" || fail "area over load: $(grep -e '+-' "$report")"
awk '/^ *p\/\(E/ { table = 1; next } table && $1 ~ /^[0-9]/ { if (!light) light = $2; heavy = $2 } table && $1 ~ /^L/ { exit } END { exit !(light > 2 * heavy && heavy > 1.8 && heavy < 2.7) }' "$report" ||
    fail "stiffness over pressure: $(sed -n '/^ *p\/(E/,$p' "$report")"
