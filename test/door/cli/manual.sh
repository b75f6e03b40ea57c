#!/bin/sh
# manual.sh RSC: groff finds nothing wrong with the page of rsc --man, and shows its sections. That every key is there is a unit test.
set -u
command -v groff > /dev/null 2>&1 || exit 77
page=$("$1" --man) || exit 1
warnings=$(printf '%s\n' "$page" | groff -man -Tutf8 -ww 2>&1 > /dev/null)
[ -z "$warnings" ] || { echo "groff: $warnings"; exit 1; }
shown=$(printf '%s\n' "$page" | groff -man -Tutf8 -P-cbou 2> /dev/null)
for word in 'Exit status' '&surface' 'L_lambda_s' 'ncdump'; do
    printf '%s\n' "$shown" | grep -q -- "$word" || { echo "not shown: $word"; exit 1; }
done
