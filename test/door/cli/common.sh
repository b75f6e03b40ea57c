# Shared by the scripts of this folder: . common.sh after test, rsc and folder are set. Works in an empty folder. Exit status of a
# script: 0 passed, 77 skipped, anything else failed.
set -u
export SOURCE_DATE_EPOCH=1700000000   # files are equal to the last byte then
umask 022
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || exit 1

fail() { echo "failed: $*"; exit 1; }
# expect STATUS command...: the exit status; stdout and stderr go to the file `said`.
expect() {
    local wanted=$1 got
    shift
    "$@" > "$folder/said" 2>&1
    got=$?
    [ $got -eq "$wanted" ] || { cat "$folder/said"; fail "exit status $got instead of $wanted: $*"; }
}
says() { grep -q -- "$1" "$folder/said" || { cat "$folder/said"; fail "it does not say: $1"; }; }
silent_on() { ! grep -q -- "$1" "$folder/said" || { cat "$folder/said"; fail "it says: $1"; }; }
same() { cmp "$1" "$2" || fail "$1 and $2 differ"; }
# Two results of equal names: the same text, and numbers within 1e-9 of each other.
alike() {
    command -v ncdump > /dev/null || exit 77
    for file in "$1" "$2"; do ncdump "$file" | tr ',; ' '\n\n\n' | sed '/^$/d'; done > words
    awk -v half=$(($(wc -l < words) / 2)) '{ w[NR] = $0 } END { for (k = 1; k <= half; ++k) {
        a = w[k]; b = w[k + half]; d = a - b; s = a < 0 ? -a : a + 0
        if (a != b && !(a ~ /^[-+.0-9e]+$/ && b ~ /^[-+.0-9e]+$/ && d <= 1e-9 * s && -d <= 1e-9 * s)) { print a, b; exit 1 } }
        exit NR != 2 * half }' words || fail "$1 and $2 differ"
    rm words
}
# left FOLDER NAMES: what is there, and nothing else.
left() { [ "$(ls -A "$1" | tr '\n' ' ')" = "${2:+$2 }" ] || fail "left in $1: $(ls -A "$1"); expected: $2"; }
# shortened NAME PICTURES...: input/NAME/run.sh --short from beginning to end leaves these pictures, and a report without "not a number" that says it is
# the shortened one; its output is log.txt. 77 where Python lacks its modules.
shortened() {
    local name=$1
    shift
    sh "$project/input/$name/run.sh" --short "$rsc" "$folder/$name" > "$folder/log.txt" 2>&1
    local status=$?
    [ $status -ne 77 ] || { cat "$folder/log.txt"; exit 77; }
    [ $status -eq 0 ] || fail "run.sh --short ends with status $status: $(tail -n 20 "$folder/log.txt")"
    for picture; do head -c 8 "$folder/$name/${name}_$picture.png" 2> /dev/null | grep -q PNG || fail "${name}_$picture.png is no picture"; done
    report=$folder/$name/report.txt
    [ -s "$report" ] || fail "no report"
    grep -q 'SHORTENED' "$report" || fail "the report does not say that it is the shortened one"
    ! grep -n -w -i nan "$report" || fail "not a number in the report"
}
# in_folder NAME command...: in a folder of that name, so that the result file can have one name everywhere.
in_folder() { mkdir -p "$1" && (cd "$1" && shift && "$@"); }
