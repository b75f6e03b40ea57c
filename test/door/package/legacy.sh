#!/bin/sh
# Makefile.legacy makes the same program: builds ./rsc in a copy of the tree by plain make and
# compares its loads with another rsc's.
# Usage: sh test/door/package/legacy.sh /path/to/rsc
# It takes minutes: `cmake --build build --target check_legacy`.
set -eu
other=$1
top=$(cd "$(dirname "$0")/../../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -r "$top/src" "$top/test" "$top/Makefile.legacy" "$work"
[ ! -f "$top/make.inc" ] || cp "$top/make.inc" "$work"
cd "$work"
make -f Makefile.legacy -j 2 rsc > make.log 2>&1 || { cat make.log; exit 1; }
loads() {  # tolerance 1e-11: what is compared is the build, not how far Newton's method went
    printf '%s\n' "&surface n=1024 L_lambda_s=256 /" "&indentation steps=20 /" \
        "&solver model='asperities' tolerance=1e-11 /" "&output file='$2' /" | "$1" -q
    ncdump -v force "$2" | sed -n '/^data:/,$p' | tr -dc '0-9.eE+\-,\n' | tr ',' '\n' | grep '[0-9]'
}
loads ./rsc legacy.nc > legacy.txt
loads "$other" other.nc > other.txt
paste legacy.txt other.txt | awk '
    {
        d = $1 - $2
        if (d < 0) d = -d
        if (d > 1e-9 * $2) { print "loads differ:", $0; bad = 1 }
        n++
    }
    END {
        if (n != 20) { print "expected 20 loads, found", n; bad = 1 }
        if (!bad) print n, "loads equal to 1e-9"
        exit bad
    }'
