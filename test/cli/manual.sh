#!/bin/sh
# manual.sh RSC: rsc --man holds every option of --help and every key of --describe, as text that man can show.
set -u
rsc=$1
failed=0
fail() {
    echo "FAILED: $*"
    failed=1
}
page=$("$rsc" --man) || fail "--man ends with status $?"
plain=$(printf '%s\n' "$page" | sed 's/\\-/-/g; s/\\&//; s/\\e/\\/g')
for option in $("$rsc" --help | grep -o -- '--[a-z]*' | sort -u); do
    printf '%s\n' "$plain" | grep -q -- "^\.B .*$option" || fail "no option $option"
done
"$rsc" --describe | {
    keys=0
    missing=0
    while IFS= read -r line; do
        case $line in
            '      '*) continue ;;
            '  '*) keys=$((keys + 1)) ;;
            *) continue ;;
        esac
        printf '%s\n' "$plain" | grep -qF -- ".B ${line#  }" || { echo "FAILED: no key $line"; missing=1; }
    done
    [ $keys -gt 40 ] || { echo "FAILED: $keys keys only"; missing=1; }
    exit $missing
} || failed=1
if command -v groff > /dev/null 2>&1; then
    warnings=$(printf '%s\n' "$page" | groff -man -Tutf8 -ww 2>&1 > /dev/null)
    [ -z "$warnings" ] || fail "groff: $warnings"
    # No control line got lost in the text: words of each section are shown.
    shown=$(printf '%s\n' "$page" | groff -man -Tutf8 -P-cbou 2> /dev/null)
    for word in 'EXIT STATUS' '&surface' 'L_lambda_s' 'ncdump'; do
        printf '%s\n' "$shown" | grep -q -- "$word" || fail "not shown: $word"
    done
fi
exit $failed
