# The common part of input/paper/run.sh and input/flat/run.sh, which define: `here` the folder
# of the cases, `study` its name, `cases` their names in order, and the function shorten, which
# reads a case and writes its short version.
# Usage: sh input/STUDY/run.sh [--short] [RSC [FOLDER]]
#   RSC      the program (default ./rsc)
#   FOLDER   folder of results, pictures and report.txt (default output/STUDY)
#   --short  few realizations and small grids, as a check; the numbers are those of other
#            surfaces. Default FOLDER: output/STUDY_short. Options may be anywhere.
# Results of a full run are never replaced by those of a short one, nor vice versa, nor files
# that run.sh did not write. After an interruption the same command with the same program and
# cases continues: finished cases are kept, and the finished realizations of the interrupted
# case. After a complete run, the next one starts anew.
# PYTHON: a Python with numpy, scipy, matplotlib and netCDF4; default: python3 or
# /usr/bin/python3 if they have them.
usage="usage: sh input/$study/run.sh [--short] [RSC [FOLDER]]"
short=no
rsc=
folder=
for word; do
    case $word in
        --short) short=yes ;;
        -*)
            echo "run.sh: unknown option $word; $usage" >&2
            exit 2
            ;;
        *)
            if [ -z "$rsc" ]; then rsc=$word
            elif [ -z "$folder" ]; then folder=$word
            else
                echo "run.sh: too many words at '$word'; $usage" >&2
                exit 2
            fi
            ;;
    esac
done
rsc=${rsc:-./rsc}
kind=full
[ $short = no ] || kind=shortened
default=output/$study
[ $short = no ] || default=${default}_short
folder=${folder:-$default}
case $rsc in */*) ;; *) rsc=./$rsc ;; esac
if [ ! -x "$rsc" ]; then
    echo "run.sh: no program $rsc; build it first: sh input/setup.sh" >&2
    exit 1
fi
if [ -z "${PYTHON:-}" ]; then
    for PYTHON in python3 /usr/bin/python3 ''; do
        [ -n "$PYTHON" ] || break
        "$PYTHON" -c 'import numpy, scipy, matplotlib, netCDF4' 2> /dev/null && break
    done
fi
if [ -z "$PYTHON" ]; then
    echo 'run.sh: Python modules are missing; on Debian:' \
        'apt install python3-scipy python3-matplotlib python3-netcdf4' >&2
    exit 77
fi

of=$(echo $cases | wc -w)

# Keeps the results of an interrupted run of the same program on the same cases and removes
# everything else.
mkdir -p "$folder"
there=$(cat "$folder/kind.txt" 2> /dev/null || true)
if [ "$there" != $kind ] && ls "$folder"/*.nc > /dev/null 2>&1; then
    what='files that run.sh did not make'
    [ -z "$there" ] || what="results of a $there run"
    echo "run.sh: $folder holds $what: give this $kind run another FOLDER, or remove that one" >&2
    exit 2
fi
echo $kind > "$folder/kind.txt"
this="$short $(cat "$rsc" "$here"/*.nml "$here/run.sh" "$here/../run_cases.sh" | cksum)"
if [ "$(cat "$folder/unfinished.txt" 2> /dev/null)" = "$this" ]; then
    echo 'going on with the run that was interrupted'
else
    rm -f "$folder"/*.nc "$folder"/*.checkpoint* "$folder"/*.part-* "$folder"/times.txt \
        "$folder"/begun.txt "$folder"/report.txt "$folder/${study}"_*.png
    echo "$this" > "$folder/unfinished.txt"
fi
touch "$folder/times.txt" "$folder/begun.txt"
stopped() {
    finished=$(wc -l < "$folder/times.txt")
    echo "run.sh: stopped; the same command continues ($finished of $of cases are finished)" >&2
    exit "$1"
}
trap 'stopped 130' INT
trap 'stopped 143' TERM

begin=$(date +%s)
number=0
for name in $cases; do
    number=$((number + 1))
    if grep -q "^$name " "$folder/times.txt"; then
        echo "$number of $of, $name: is there"
        continue
    fi
    case=$here/$name.nml
    if [ $short = yes ]; then
        shorten $name < "$case" > "$folder/$name.nml"
        case=$folder/$name.nml
    fi
    again=$(grep -x "$name" "$folder/begun.txt" | sed 's/.*/ resumed/;q')
    echo "$name" >> "$folder/begun.txt"
    echo "$number of $of, $name: $(sed -n "s/^&run *title = '\([^']*\)'.*/\1/p" "$case")"
    from=$(date +%s)
    status=0
    "$rsc" "$case" --quiet --resume --progress always --output "$folder/$name.nc" || status=$?
    [ $status -eq 0 ] || stopped $status
    echo "$name $(($(date +%s) - from))$again" >> "$folder/times.txt"
    echo "    $(sed -n "s/^$name \([0-9]*\).*/\1/p" "$folder/times.txt") s"
done
from=$(date +%s)
echo 'pictures and report'
"$PYTHON" "$here/../../output/plot/$study.py" "$folder"
rm -f "$folder/unfinished.txt" "$folder/begun.txt"
end=$(date +%s)
echo "everything: $((end - begin)) s, of which pictures and report $((end - from)) s"
echo "the report: $folder/report.txt"
