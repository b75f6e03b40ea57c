#!/bin/bash
# What a run does to files, and what it says of them: bash files.sh TEST RSC FOLDER.
# Exit status 0: passed, 77: skipped, anything else: failed.
set -u
test=$1 rsc=$2 folder=$3
export SOURCE_DATE_EPOCH=1700000000   # files are equal to the last byte then
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
says() { grep -qF -- "$1" "$folder/said" || { cat "$folder/said"; fail "it does not say: $1"; }; }
silent_on() { ! grep -qF -- "$1" "$folder/said" || { cat "$folder/said"; fail "it says: $1"; }; }
same() { cmp "$1" "$2" || fail "$1 and $2 differ"; }

cat > case.nml << 'END'
&surface     n = 128  L_lambda_l = 4  L_lambda_s = 32 /
&indentation steps = 4 /
&output      file = 'out.nc'  map_cells = 10 /
END
cp case.nml before.nml

# The case, by whatever name, and what is no result of rsc are never overwritten.
test_lost() {
    expect 2 "$rsc" case.nml -o case.nml; says "file='case.nml': this is an input of the run ('case.nml')"
    expect 2 "$rsc" -o case.nml < case.nml; says "this is an input of the run"
    ln -s case.nml link.nc
    expect 2 "$rsc" case.nml -o link.nc; says "this is an input of the run"
    ln case.nml hard.nc
    expect 2 "$rsc" case.nml -o ./hard.nc; says "this is an input of the run"
    same case.nml before.nml
    echo "my thesis" > thesis.tex
    expect 2 "$rsc" case.nml -o thesis.tex; says "file='thesis.tex': this file exists and is no result of rsc; it is left alone"
    expect 2 "$rsc" --check case.nml -o thesis.tex; says "it is left alone"
    : > empty.nc
    expect 2 "$rsc" case.nml -o empty.nc; says "no result of rsc"
    [ "$(cat thesis.tex)" = "my thesis" ] || fail "thesis.tex is lost"
    # A campaign likewise, and its state is no place for other files.
    expect 2 "$rsc" case.nml -s run%realizations=3 -o thesis.tex; says "no result of rsc"
    for text in "my notes" "n"; do
        echo "$text" > c.nc.checkpoint
        expect 2 "$rsc" case.nml -s run%realizations=3 -o c.nc; says "no checkpoint of rsc"
        [ "$(cat c.nc.checkpoint)" = "$text" ] || fail "c.nc.checkpoint is lost"
    done
}

# Maps and lists that are read are inputs, too; another maker's NetCDF file is no result.
test_lost_maps() {
    command -v ncgen > /dev/null || exit 77
    printf 'netcdf m {\ndimensions: y=4; x=5;\nvariables: double height(y,x);\ndata: height=0,0,0,0,0, 0,1,0,1,0, 0,0,0,2,0, 0,0,0,0,0;\n}\n' > m.cdl
    ncgen -o m.nc m.cdl && cp m.nc before.nc
    heights=(-s "surface%source='heights'" -s "surface%file='m.nc'" -s surface%L=1)
    cat > measured.nml << 'END'
&indentation steps = 4  start = 1  stop = 0.5 /
&output      file = 'out.nc'  map_cells = 10 /
END
    expect 0 "$rsc" measured.nml "${heights[@]}"
    expect 2 "$rsc" measured.nml "${heights[@]}" -o m.nc; says "file='m.nc': this is an input of the run ('m.nc')"
    expect 2 "$rsc" case.nml -o m.nc; says "no result of rsc"
    same m.nc before.nc
    # A result as the next one's input.
    expect 0 "$rsc" case.nml -s output%heights=T
    expect 2 "$rsc" measured.nml -s "surface%source='heights'" -s "surface%file='out.nc'"; says "this is an input of the run ('out.nc')"
}

# A result takes the place of an older one, and the screen says so.
test_replaced() {
    for realizations in 1 3; do
        expect 0 "$rsc" case.nml -s run%realizations=$realizations -o r$realizations.nc; silent_on "replaces"
        cp r$realizations.nc first.nc
        expect 0 "$rsc" case.nml -s run%realizations=$realizations -o r$realizations.nc
        says "result: r$realizations.nc (replaces the result that was there)"
        same r$realizations.nc first.nc
    done
}

# --resume leaves a result alone that is there, unless the file it was read from is newer.
test_newer_input() {
    printf '0.4 0.5 0.010 0.01\n0.6 0.5 0.011 0.01\n' > list.txt
    resumed=(-s "surface%source='asperities'" -s "surface%file='list.txt'" -s surface%L=1 --resume -o list.nc)
    sed 's/n = 128.*32//' before.nml > list.nml
    expect 0 "$rsc" list.nml "${resumed[@]}"; says "result: list.nc"
    cp list.nc first.nc
    expect 0 "$rsc" list.nml "${resumed[@]}"; says "'list.nc' is there and whole: nothing to do"
    same list.nc first.nc
    printf '0.4 0.5 0.010 0.01\n0.6 0.5 0.012 0.01\n' > list.txt
    expect 0 "$rsc" list.nml "${resumed[@]}"; says "replaces the result"
    cmp -s list.nc first.nc && fail "the newer list was not read"
    return 0
}

# A study: its manifest, and every member.
test_study() {
    printf "&study surface%%sigma=0.01, 0.02 /\n" >> case.nml
    expect 0 "$rsc" case.nml; silent_on "replaced"
    expect 0 "$rsc" case.nml; says "rsc: the results of 2 of the members are there already and will be replaced"
    expect 0 "$rsc" case.nml --resume; silent_on "replaced"
    rm out_002.nc && echo mine > out_002.nc
    expect 2 "$rsc" case.nml; says "member 2 (surface%sigma=0.02): &output file='out_002.nc': this file exists and is no result of rsc"
    rm out_00?.nc && echo mine > out_manifest.txt
    expect 2 "$rsc" case.nml; says "the manifest of the study, 'out_manifest.txt': this file exists and is no manifest of rsc"
    [ "$(cat out_manifest.txt)" = mine ] || fail "out_manifest.txt is lost"
    rm out_manifest.txt && echo mine > out_manifest.nc
    expect 2 "$rsc" case.nml; says "'out_manifest.nc': this file exists and is no manifest of rsc"
    cp case.nml out_manifest.txt && rm out_manifest.nc
    expect 2 "$rsc" out_manifest.txt; says "this is an input of the run"
}

# --check does all that can fail before the first level, runs nothing, and says how long the run may take.
test_check() {
    heights=(-s "surface%source='heights'" -s surface%L=1)
    expect 0 "$rsc" --check case.nml; says "expected to take about "; says "'out.nc'"
    expect 0 "$rsc" --check -q case.nml; silent_on "expected to take"
    expect 2 "$rsc" --check case.nml "${heights[@]}" -s "surface%file='absent.txt'"; says "absent.txt: No such file"
    printf '1 2 3 4 5\n1 2 nan 4 5\n1 2 3 4 5\n' > bad.txt
    expect 2 "$rsc" --check case.nml "${heights[@]}" -s "surface%file='bad.txt'"; says "bad.txt:2: 'nan' in column 3 is not finite"
    expect 2 "$rsc" --check case.nml -o /nowhere/at/all/out.nc; says "folder '/nowhere/at/all' does not exist"
    expect 2 "$rsc" --check case.nml -o case.nml; says "this is an input of the run"
    expect 2 "$rsc" --check case.nml -s run%realizations=2 -s "output%contacts='all'"; says "contacts are kept for one realization only"
    printf "&study surface%%file='bad.txt', 'absent.txt' /\n" >> case.nml
    expect 2 "$rsc" --check case.nml "${heights[@]}"; says "member 1 (surface%file='bad.txt'): bad.txt:2:"
    expect 2 "$rsc" --check --member 2 case.nml "${heights[@]}"; says "member 2 (surface%file='absent.txt'): absent.txt: No such file"
    expect 2 "$rsc" --check --member 3 case.nml "${heights[@]}"; says "--member 3: the study has 2 members"
    [ "$(ls)" = "$(printf 'bad.txt\nbefore.nml\ncase.nml\nsaid')" ] || fail "something was written: $(ls)"
}

# The case inside a result: shown, and run again to the same file.
test_case() {
    expect 0 "$rsc" case.nml -s surface%sigma=0.02 -o made.nc
    "$rsc" --case made.nc > shown.nml || fail "--case fails"
    grep -q 'sigma *= 0.02' shown.nml || fail "--case does not show the case"
    if command -v ncdump > /dev/null; then
        (unset SOURCE_DATE_EPOCH && "$rsc" -q case.nml -s run%seed=3)
        ncdump -h out.nc | grep -q ':history = ".*Z rsc -q case.nml -s run%seed=3"' || fail "history: $(ncdump -h out.nc | grep history)"
    fi
    mkdir a b
    (cd a && expect 0 "$rsc" ../shown.nml) || exit 1
    (cd b && expect 0 "$rsc" ../made.nc) || exit 1
    same a/made.nc b/made.nc
    expect 2 "$rsc" made.nc; says "this is an input of the run"
    expect 2 "$rsc" < made.nc; says "<stdin>: is a NetCDF file"
    printf '\377\376&\000r\000' > utf16.nml
    expect 2 "$rsc" utf16.nml; says "utf16.nml: is text in UTF-16"
    expect 2 env OMPI_COMM_WORLD_SIZE=4 "$rsc" case.nml; says "use rsc_mpi"
}

# A campaign that was interrupted may go on as a larger one.
test_growth() {
    expect 0 "$rsc" case.nml -s run%realizations=12 -o out.nc
    mv out.nc whole.nc
    # No room for the result: the state stays.
    mkdir ro && (ulimit -f 40; "$rsc" case.nml -s run%realizations=5 -o out.nc > said 2>&1)
    [ -e out.nc.checkpoint ] || { cat said; fail "no state of the smaller campaign"; }
    expect 2 "$rsc" --resume case.nml -s run%realizations=3 -o out.nc; says "run%realizations: 5 there, 3 now"
    expect 0 "$rsc" --resume case.nml -s run%realizations=12 -o out.nc; says "of them are done"
    same out.nc whole.nc
}

"test_$test"
