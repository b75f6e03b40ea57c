#!/bin/sh
# run_cases.sh PROJECT FOLDER: input/run_cases.sh by way of input/flat/run.sh, with a program and a Python that only write down what they are asked
# for: words, order, what is kept, removed, refused, and every line that is told.
set -u
project=$1
folder=$2
failed=0
fail() {
    echo "FAILED: $*"
    failed=1
}
same() { # same WHAT EXPECTED FOUND
    [ "$2" = "$3" ] || fail "$1:
--- expected
$2
--- found
$3"
}
rm -rf "$folder"
mkdir -p "$folder/work"
cd "$folder/work" || exit 1
run=$project/input/flat/run.sh
cases='alpha_elements alpha_asperities size_elements size_asperities'
title() { sed -n "s/^&run *title = '\([^']*\)'.*/\1/p" "$project/input/flat/$1.nml"; }
seconds() { sed 's/[0-9][0-9]* s/N s/g'; }

# A program that leaves a file, or ends with the status in the file `status` when it is asked for the case in the file `breaks`.
cat > rsc << 'END'
#!/bin/sh
echo "$*" >> calls.txt
case $1 in */"$(cat breaks 2> /dev/null || echo no)".nml) exit "$(cat status)" ;; esac
for word; do out=$word; done
echo result > "$out"
END
cat > python << 'END'
#!/bin/sh
echo "python $*"
[ -d "$2" ] && echo report > "$2/report.txt"
END
chmod +x rsc python
PYTHON=$folder/work/python
export PYTHON
lines() { # lines FOLDER: what a whole run tells
    k=0
    for case in $cases; do
        k=$((k + 1))
        printf '%s\n    N s\n' "$k of 4, $case: $(title $case)"
    done
    printf '%s\n' 'pictures and report' "python $project/input/flat/../../output/plot/flat.py $1" 'everything: N s, of which pictures and report N s' "the report: $1/report.txt"
}
calls() { # calls FOLDER-OF-CASES FOLDER
    for case in $cases; do echo "$1/$case.nml --quiet --resume --progress always --output $2/$case.nc"; done
}

# Whole, and shortened: cases as they stand or cut down, each with a folder of its own; defaults are ./rsc and output/flat.
same 'a full run' "$(lines output/flat)" "$(sh "$run" 2>&1 | seconds)"
same 'its calls' "$(calls "$project/input/flat" output/flat)" "$(cat calls.txt)"
same 'its kind and times' "full $cases" "$(cat output/flat/kind.txt) $(cut -d' ' -f1 output/flat/times.txt | tr '\n' ' ' | sed 's/ $//')"
rm calls.txt
same 'a shortened run' "$(lines output/flat_short)" "$(sh "$run" --short 2>&1 | seconds)"
same 'its calls' "$(calls output/flat_short output/flat_short)" "$(cat calls.txt)"
same 'its kind' shortened "$(cat output/flat_short/kind.txt)"
grep -q 'realizations = 3' output/flat_short/size_elements.nml || fail 'the shortened case is not shortened'
[ ! -e output/flat/unfinished.txt ] && [ ! -e output/flat/begun.txt ] || fail 'a finished run looks unfinished'

# Words: options anywhere, a program without a slash is the one here, refusals with status 2 and nothing written.
rm calls.txt
sh "$run" rsc --short other > said.txt 2>&1 || fail "rsc --short other: $(cat said.txt)"
same 'calls into another folder' "$(calls other other)" "$(cat calls.txt)"
refused() { # refused STATUS MESSAGE WORDS...
    status=$1
    message=$2
    shift 2
    said=$(sh "$run" "$@" 2>&1)
    same "status of $*" "$status" $?
    same "refusal of $*" "run.sh: $message" "$said"
}
rm calls.txt
refused 2 "unknown option --shor; usage: sh input/flat/run.sh [--short] [RSC [FOLDER]]" --shor
refused 2 "too many words at 'three'; usage: sh input/flat/run.sh [--short] [RSC [FOLDER]]" rsc two three
refused 1 'no program ./nothing; build it first (sh input/setup.sh, or make -f Makefile.legacy)' nothing
refused 2 'output/flat holds results of a full run: give this shortened run another FOLDER, or remove that one' --short rsc output/flat
refused 2 'other holds results of a shortened run: give this full run another FOLDER, or remove that one' rsc other
mkdir mine && echo precious > mine/x.nc
refused 2 'mine holds files that run.sh did not make: give this full run another FOLDER, or remove that one' rsc mine
[ "$(cat mine/x.nc)" = precious ] || fail 'a file that run.sh did not make is changed'
[ ! -e calls.txt ] || fail "a refused run has called the program: $(cat calls.txt)"

# A run that breaks off has the status of the program and goes on; with another program, or once it is through, it starts anew.
echo size_elements > breaks
echo 5 > status
sh "$run" rsc broken > said.txt 2>&1
same 'status of a run that breaks off' 5 $?
same 'what it says last' 'run.sh: stopped; the same command goes on from here (2 of 4 cases are finished)' "$(tail -n 1 said.txt)"
rm breaks calls.txt
echo kept > broken/alpha_elements.nc
said=$(sh "$run" rsc broken 2>&1 | seconds)
same 'what the next one says' "going on with the run that was interrupted
1 of 4, alpha_elements: is there
2 of 4, alpha_asperities: is there
$(lines broken | sed 1,4d)" "$said"
same 'what it calls' "$(calls "$project/input/flat" broken | tail -n 2)" "$(cat calls.txt)"
same 'what it keeps' kept "$(cat broken/alpha_elements.nc)"
same 'which it says was resumed' 'size_elements resumed' "$(sed -n 's/ [0-9]* resumed/ resumed/p' broken/times.txt)"
touch broken/flat_kappa.png broken/old.nc broken/mine.txt
rm calls.txt
sh "$run" rsc broken > said.txt 2>&1
same 'a run over a finished one' "$(calls "$project/input/flat" broken)" "$(cat calls.txt)"
[ ! -e broken/flat_kappa.png ] && [ ! -e broken/old.nc ] && [ -e broken/mine.txt ] || fail "what is left of the run before: $(ls broken)"
echo alpha_asperities > breaks
sh "$run" rsc broken > said.txt 2>&1
rm breaks calls.txt
echo '# another program' >> rsc
sh "$run" rsc broken > said.txt 2>&1
same 'calls of another program' "$(calls "$project/input/flat" broken)" "$(cat calls.txt)"
grep -q 'going on' said.txt && fail 'another program goes on with the run of the first'
exit $failed
