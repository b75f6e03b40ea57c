#!/bin/sh
# run_cases.sh PROJECT FOLDER: input/run_cases.sh by way of input/flat/run.sh, with a program and a Python that only write down what they
# are asked for: which cases, in which order, what is kept, what is refused.
set -u
project=$1
folder=$2
fail() { echo "FAILED: $*"; exit 1; }
rm -rf "$folder" && mkdir -p "$folder/work" && cd "$folder/work" || exit 1
run=$project/input/flat/run.sh
cases='alpha_elements alpha_asperities size_elements size_asperities'
# A program that leaves a file, or ends with status 5 at the case that the file `breaks` names.
cat > rsc << 'END'
#!/bin/sh
echo "$*" >> calls.txt
case $1 in */"$(cat breaks 2> /dev/null || echo no)".nml) exit 5 ;; esac
for word; do out=$word; done
echo result > "$out"
END
cat > python << 'END'
#!/bin/sh
[ -d "$2" ] && echo report > "$2/report.txt"
END
chmod +x rsc python
PYTHON=$folder/work/python
export PYTHON
called() { [ "$(sed 's|.*/\([a-z_]*\)\.nml.*|\1|' calls.txt | tr '\n' ' ')" = "$* " ] || fail "called for: $(cat calls.txt); expected: $*"; rm calls.txt; }

# Whole, and shortened: each in a folder of its own.
sh "$run" > said.txt 2>&1 || fail "$(cat said.txt)"
called $cases
[ "$(cat output/flat/kind.txt)" = full ] && [ -s output/flat/report.txt ] && [ -s output/flat/times.txt ] || fail "output/flat: $(ls output/flat)"
sh "$run" --short > said.txt 2>&1 || fail "$(cat said.txt)"
called $cases
grep -q 'realizations = 3' output/flat_short/size_elements.nml || fail 'the shortened case is not shortened'
sh "$run" rsc --short other > said.txt 2>&1 || fail "$(cat said.txt)"  # options anywhere
called $cases

# Refused, with nothing called and nothing written.
refused() { # refused STATUS WORD ARGUMENTS...
    status=$1
    word=$2
    shift 2
    sh "$run" "$@" > said.txt 2>&1
    [ $? -eq "$status" ] && grep -q -- "$word" said.txt || fail "$*: $(cat said.txt)"
}
mkdir mine && echo precious > mine/x.nc
refused 2 --shor --shor
refused 2 three rsc two three
refused 1 nothing nothing
refused 2 full --short rsc output/flat
refused 2 shortened rsc other
refused 2 mine rsc mine
[ "$(cat mine/x.nc)" = precious ] && [ ! -e calls.txt ] || fail 'a refused run has done something'

# A run that breaks off has the status of the program and goes on; with another program, or once it is through, it starts anew.
echo size_elements > breaks
sh "$run" rsc broken > said.txt 2>&1
[ $? -eq 5 ] && grep -q '2 of 4' said.txt || fail "a run that breaks off: $(cat said.txt)"
rm breaks calls.txt
echo kept > broken/alpha_elements.nc
sh "$run" rsc broken > said.txt 2>&1 || fail "$(cat said.txt)"
called size_elements size_asperities
[ "$(cat broken/alpha_elements.nc)" = kept ] || fail 'a finished case is made again'
touch broken/flat_kappa.png broken/old.nc broken/mine.txt
sh "$run" rsc broken > said.txt 2>&1
called $cases
[ ! -e broken/flat_kappa.png ] && [ ! -e broken/old.nc ] && [ -e broken/mine.txt ] || fail "what is left of the run before: $(ls broken)"
echo alpha_asperities > breaks
sh "$run" rsc broken > said.txt 2>&1
rm breaks calls.txt
echo '# another program' >> rsc
sh "$run" rsc broken > said.txt 2>&1
called $cases
