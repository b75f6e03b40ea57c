#!/bin/sh
# paper.sh RSC PROJECT FOLDER: input/paper/run.sh --short from beginning to end; 77 where Python lacks its modules.
set -u
rsc=$1
project=$2
folder=$3
failed=0
fail() {
    echo "FAILED: $*"
    failed=1
}
rm -rf "$folder"
mkdir -p "$folder"

# Every case as it stands, not shortened, is one that rsc takes.
for case in "$project"/input/paper/*.nml; do
    "$rsc" --check "$case" > "$folder/check.txt" 2>&1 || fail "--check refuses $(basename "$case"): $(cat "$folder/check.txt")"
done

# Without the program it says so and writes nothing.
sh "$project/input/paper/run.sh" "$folder/no_such_program" "$folder/nothing" > "$folder/refused.txt" 2>&1
[ $? -eq 1 ] || fail "a missing program is not refused with status 1"
grep -q 'no program' "$folder/refused.txt" || fail "a missing program is not named"
[ ! -e "$folder/nothing" ] || fail "a refused run leaves files"

sh "$project/input/paper/run.sh" --short "$rsc" "$folder/paper" > "$folder/log.txt" 2>&1
status=$?
[ $status -ne 77 ] || { cat "$folder/log.txt"; exit 77; }
[ $status -eq 0 ] || fail "run.sh --short ends with status $status: $(tail -n 20 "$folder/log.txt")"

for picture in asperities curvatures area area_slope maps radial pressure_mean pressure_full spots density; do
    head -c 8 "$folder/paper/paper_$picture.png" 2> /dev/null | grep -q PNG || fail "paper_$picture.png is no picture"
done

report=$folder/paper/report.txt
[ -s "$report" ] || { fail "no report"; exit 1; }
grep -q 'SHORTENED' "$report" || fail "the report does not say that it is the shortened one"
if grep -n -w -i nan "$report"; then fail "not a number in the report"; fi
# A row for every number the paper states and a shortened run has.
for words in 'kappa1/kappa2 at the mode  *2\.214 ' '<kappa_g>/sqrt(m4), geometric mean curvature  *1\.356 ' 'beta, mean of the six members  *0\.2 ' \
             'N\*/(m2^(3/2) E\*/m4).*212\.7 ' 'N at Z0/sigma = 1\.43 \[N\], no plateau  *116\.6 ' 'N at Z0/sigma = 1\.43 \[N\], plateau  *116\.6 ' \
             'contacts at Z0/sigma = 2, ' 'contacts at Z0/sigma = 2\.5, ' 'contacts at Z0/sigma = 3, ' 'Rayleigh scale at' 'hardness at r = 0\.18 um \[N/mm2\]  *1200  *550 ' \
             'r_g = 1/<kappa_g> \[um\], no plateau, of the grid  *0\.18 ' 'rms slope of the gold surface  *4\.7 ' 'exponent alpha at .*0\.6667 ' 'exponent beta at .*1\.5 ' \
             'mean spot area at' 'grid error, .*H = 0\.9 ' 'grid error, .*H = 0\.1 ' 'solves a level'; do
    grep -q "$words" "$report" || fail "no row in the report like: $words"
done
# What does not depend on the size of the run: Greenwood's mode by its own formula, kappa1/kappa2 = 2.2153.
grep -q 'ratio 2\.2153' "$report" || fail "the mode of Greenwood's density is not at kappa1/kappa2 = 2.2153"
# Six small surfaces scatter, but A E* slope/N of any rough elastic contact lies between Persson's 1.6 and Bush, Gibson and Thomas' 2.5
# within a fifth: beta between 0.5 and 1.2. The paper's 0.2, or a lost factor of 2, is outside.
beta=$(sed -n 's/^ *beta, mean of the six members *0\.2 *\([0-9.]*\) .*/\1/p' "$report")
awk -v b="$beta" 'BEGIN { exit !(b > 0.5 && b < 1.2) }' || fail "beta = '$beta' is no rough elastic contact's"
exit $failed
