#!/bin/bash
# What a run does to files, and what it refuses because of files, surfaces and places, with status 2 and nothing written:
# bash files.sh TEST RSC FOLDER.
test=$1 rsc=$2 folder=$3
. "$(dirname "$0")/common.sh"

cat > case.nml << 'END'
&surface     n = 128  L_lambda_l = 4  L_lambda_s = 32 /
&indentation steps = 4 /
&output      file = 'out.nc'  map_cells = 10 /
END
cp case.nml before.nml
# Heights as text with its four summits, and a list of two.
for row in "0 0 0 0 0 0 0" "0 3 0 0 0 2 0" "0 0 0 0 0 0 0" "0 0 0 4 0 0 0" "0 0 0 0 0 0 0" "0 1 0 0 0 5 0" "0 0 0 0 0 0 0"; do echo "$row"; done > map.txt
printf '0.2 0.3 0.010 0.05\n0.6 0.8 0.012 0.04\n' > list.txt
# from SOURCE FILE: the case is of that file.
from() { sed "s/n = 128.*32/source = '$1' file = '$2'/" before.nml > case.nml; }
# refused WORD arguments...: the case with these, checked and run.
refused() {
    local word=$1
    shift
    ls -A | grep -v '^said$' > "$folder.before"
    expect 2 "$rsc" case.nml "$@"; says "$word"
    expect 2 "$rsc" --check case.nml "$@"; says "$word"
    ls -A | grep -v '^said$' | cmp -s - "$folder.before" || fail "something was written: $*"
}
taken() { expect 0 "$rsc" --check -q case.nml "$@"; }

# The case, by whatever name, and what is no result of rsc are never overwritten.
test_lost() {
    ln -s case.nml link.nc
    ln case.nml hard.nc
    for name in case.nml link.nc ./hard.nc; do expect 2 "$rsc" case.nml -o $name; says "input of the run"; done
    expect 2 "$rsc" -o case.nml < case.nml; says "input of the run"
    same case.nml before.nml
    echo "my thesis" > thesis.tex
    : > empty.nc
    refused "no result of rsc" -o thesis.tex
    refused "no result of rsc" -o empty.nc
    expect 2 "$rsc" case.nml -s run%realizations=3 -o thesis.tex; says "no result of rsc"
    [ "$(cat thesis.tex)" = "my thesis" ] || fail "thesis.tex is lost"
    # The state of a campaign is no place for other files.
    for text in "my notes" "n"; do
        echo "$text" > c.nc.checkpoint
        expect 2 "$rsc" case.nml -s run%realizations=3 -o c.nc; says "checkpoint"
        [ "$(cat c.nc.checkpoint)" = "$text" ] || fail "c.nc.checkpoint is lost"
    done
}

# Maps and lists that are read are inputs, too; another maker's NetCDF file is no result.
test_lost_maps() {
    command -v ncgen > /dev/null || exit 77
    printf 'netcdf m {\ndimensions: y=4; x=5;\nvariables: double height(y,x);\ndata: height=0,0,0,0,0, 0,1,0,1,0, 0,0,0,2,0, 0,0,0,0,0;\n}\n' > m.cdl
    ncgen -o m.nc m.cdl && cp m.nc unchanged.nc
    expect 2 "$rsc" case.nml -o m.nc; says "no result of rsc"
    from heights m.nc
    expect 0 "$rsc" case.nml -s surface%L=1 -s indentation%start=1 -s indentation%stop=0.5
    refused "input of the run" -s surface%L=1 -o m.nc
    same m.nc unchanged.nc
    # A result as the next one's input.
    expect 0 "$rsc" before.nml -s output%heights=T
    from heights out.nc
    refused "input of the run"
    # So is the map of an indenter, and what another member of a study reads.
    printf "&indenter shape = 'map' file = 'out.nc' /\n&solids R = 2*Infinity /\n" | cat before.nml - > case.nml
    refused "input of the run"
    cp out.nc out_001.nc && cp out.nc out_003.nc
    printf "&study indenter%%file = 'out_003.nc', 'out_001.nc' /\n" >> case.nml
    refused "member 1.*input of the run"
    refused "member 1.*input of the run" --member 1
}

# A result takes the place of an older one, and the screen says so.
test_replaced() {
    for realizations in 1 3; do
        expect 0 "$rsc" case.nml -s run%realizations=$realizations -o r$realizations.nc; silent_on "replaces"
        cp r$realizations.nc first.nc
        expect 0 "$rsc" case.nml -s run%realizations=$realizations -o r$realizations.nc; says "r$realizations.nc (replaces"
        same r$realizations.nc first.nc
    done
}

# --resume leaves a result alone that is there, unless the file it was read from is newer.
test_newer_input() {
    from asperities list.txt
    expect 0 "$rsc" case.nml -s surface%L=1 --resume
    cp out.nc first.nc
    expect 0 "$rsc" case.nml -s surface%L=1 --resume; says "complete"
    same out.nc first.nc
    sed -i 's/0.012/0.013/' list.txt
    expect 0 "$rsc" case.nml -s surface%L=1 --resume; says "replaces"
    ! cmp -s out.nc first.nc || fail "the newer list was not read"
    printf "&indenter shape = 'map' file = 'map.txt' /\n&solids R = 2*Infinity /\n" | cat before.nml - | sed "s/n = 128/n = 128 pixel = 0.2/" > case.nml
    expect 0 "$rsc" case.nml
    expect 0 "$rsc" case.nml --resume; says "complete"
    sed -i 's/5/6/' map.txt
    expect 0 "$rsc" case.nml --resume; says "replaces"
}

# A study: its manifest says what each member is, in the units of the case; what is in the way is refused.
test_study() {
    printf "&study surface%%sigma = 0.01, 0.02  solids%%R(2) = 2, Infinity /\n" >> case.nml
    echo mine > out_manifest.nc; refused "out_manifest.nc.*no manifest of rsc"
    cp case.nml out_manifest.nc
    expect 2 "$rsc" out_manifest.nc; says "input of the run"
    rm out_manifest.nc
    mkdir out_003.nc; refused "member 3 (surface%sigma=0.02 solids%R(2)=2).*folder"
    rmdir out_003.nc
    expect 0 "$rsc" case.nml -s "run%length_unit='um'"; silent_on "replaced"
    if command -v ncdump > /dev/null; then
        ncdump out_manifest.nc > cdl
        for words in 'member = 1, 2, 3, 4 ;' '"out_001.nc",' '"out_004.nc" ;' 'surface_sigma:units = "um"' 'surface_sigma:key = "surface%sigma"' \
            'surface_sigma = 0.01, 0.01, 0.02, 0.02 ;' 'solids_R_2:key = "solids%R(2)"' '"Infinity",'; do
            grep -qF -- "$words" cdl || fail "the manifest lacks $words: $(cat cdl)"
        done
        mkdir elsewhere; expect 0 "$rsc" case.nml -q -o elsewhere/out.nc; ncdump -v file elsewhere/out_manifest.nc > cdl
        grep -qF '"out_001.nc",' cdl || fail "files beside the manifest are not named as such: $(cat cdl)"
    fi
    expect 0 "$rsc" case.nml -q -s "run%length_unit='um'"; says "4 of the members.*replaced"
    expect 0 "$rsc" case.nml -q --resume --member 2 -s "run%length_unit='um'"; says "member 2.*complete"
    expect 0 "$rsc" --list case.nml
    [ "$(sed -n 3p said)" = "3  out_003.nc  surface%sigma=0.02 solids%R(2)=2" ] || fail "--list: $(cat said)"
    expect 2 "$rsc" --member 5 case.nml; says "4 members"
}

# --check does all that can fail before the first level, runs nothing, and says the memory that elements take.
test_check() {
    for threads in 1 2; do
        expect 0 "$rsc" --check case.nml -s run%threads=$threads -s "solver%model='elements'"; says "[0-9] MB .* $threads thread"
    done
    expect 0 "$rsc" --check -q case.nml; silent_on "can be written"
    from heights absent.txt; refused "absent.txt"
    printf '1 2 3 4 5\n1 2 nan 4 5\n1 2 3 4 5\n' > bad.txt
    from heights bad.txt; refused "bad.txt:2: 'nan' in column 3" -s surface%L=1
    printf "&study surface%%file='bad.txt', 'absent.txt' /\n" >> case.nml
    expect 2 "$rsc" --check case.nml -s surface%L=1; says "member 1 (surface%file='bad.txt'): bad.txt:2:"
    expect 2 "$rsc" --check --member 2 case.nml -s surface%L=1; says "member 2 (surface%file='absent.txt'): absent.txt"
    left . "bad.txt before.nml case.nml list.txt map.txt said"
}

# The case inside a result: shown, and run again to the same file. What is no case is named.
test_case() {
    expect 0 "$rsc" case.nml -s surface%sigma=0.02 -o made.nc
    "$rsc" --case made.nc > shown.nml || fail "--case fails"
    grep -q 'sigma *= 0.02' shown.nml || fail "--case does not show the case"
    if command -v ncdump > /dev/null; then
        (unset SOURCE_DATE_EPOCH && "$rsc" -q case.nml -s run%seed=3)
        ncdump -h out.nc | grep -q ':history = ".*rsc -q case.nml -s run%seed=3"' || fail "history: $(ncdump -h out.nc | grep history)"
    fi
    expect 0 in_folder a "$rsc" ../shown.nml
    expect 0 in_folder b "$rsc" ../made.nc
    same a/made.nc b/made.nc
    expect 2 "$rsc" made.nc; says "input of the run"
    expect 2 "$rsc" < made.nc; says "NetCDF"
    printf '\377\376&\000r\000' > utf16.nml
    expect 2 "$rsc" utf16.nml; says "UTF-16"
    expect 2 "$rsc" --case case.nml; says "no result of rsc"
    for option in --list "--member 1"; do expect 2 "$rsc" $option case.nml; says "no &study"; done
    for launcher in OMPI_COMM_WORLD_SIZE=4 PMI_SIZE=3 MPI_LOCALNRANKS=2; do expect 2 env $launcher "$rsc" case.nml; says "use rsc_mpi"; done
    expect 0 env PMI_SIZE=1 "$rsc" --check -q case.nml
}

test_paths() {
    mkdir folder
    refused "'folder'.*name a file in it" -o folder
    refused "none/.*file name" -o none/
    refused "map.txt.*not a folder" -o map.txt/out.nc
    refused "/nowhere/at.*does not exist" -o /nowhere/at/out.nc
    refused "/dev/null.*plain file" -o /dev/null
    taken -o new/folder/out.nc
    for kept in last all; do refused "contacts.*one realization" -s run%realizations=2 -s "output%contacts='$kept'"; done
    taken -s run%realizations=2 -s "output%contacts='none'"
}

# What a surface does not hold or does not reach; the neighbour of each that is right is taken.
test_surfaces() {
    from heights map.txt
    refused "map.txt.*surface%pixel must be given"
    refused "map.txt.*surface%pixel must be given" -s surface%L=7 -s "indenter%shape='map'" -s "indenter%file='map.txt'"
    taken -s surface%pixel=1 -s "indenter%shape='map'" -s "indenter%file='map.txt'"
    taken -s surface%L=7
    taken -s surface%L=7 -s "asperities%law='elliptic'"
    sed '1s/0/nan/' map.txt > hole.txt
    from heights hole.txt
    expect 0 "$rsc" case.nml -s surface%L=7 -s "surface%missing='fill'" -s "solver%model='elements'"; says "missing points: 1"
    head -n 6 map.txt > six.txt
    from heights six.txt
    refused "from x = 0 to 7 and from y = 0 to 6" -s surface%L=7 -s indentation%centre=3,6.5
    taken -s surface%L=7 -s indentation%centre=6.5,3
    from heights 'm?p.txt'
    refused "up to 2.*1 files" -s surface%L=7 -s run%realizations=2
    refused "realization 2.*1 files" -s surface%L=7 -s run%first_realization=2
    from heights 'x*.txt'; refused "no file" -s surface%L=7
    printf '1 1 1 1 1\n1 1 1 1 1\n1 1 1 1 1\n' > flat.txt
    from heights flat.txt; refused "rms height.* is 0" -s surface%L=1
    from asperities list.txt
    refused "x = 4.*from x = 0.15 to 0.65 and from y = 0.3 to 0.8" -s indentation%centre=4,0.55
    refused "elliptic.*curvatures" -s "asperities%law='elliptic'"
    flats=(-s solids%R=Infinity,Infinity -s "indentation%boundary='periodic'" -s "indentation%control='pressure'")
    refused "slope" "${flats[@]}" -s "indentation%unit='relative'" -s indentation%levels=0.1 -s surface%L=2
    printf '0.2 0.3 0.01 0.05\n0.6 0.8 0.01 0.04\n' > level.txt
    from asperities level.txt
    refused "sigma > 0"
    taken -s surface%sigma=0.01
}

# Results that are no part of a campaign, told where --resume would go on with them; and parts that are not of one whole.
test_parts() {
    sed -i "s/steps = 4/levels = 3, 2/" case.nml before.nml
    expect 0 "$rsc" case.nml -q -s run%realizations=2 -s "output%format='classic'"
    sed -i 's/rsc 0\.[0-9]*\.[0-9]*,/rsc 0.0.9,/' out.nc
    truncate -s -47 out.nc  # its checksum
    expect 0 "$rsc" case.nml -q --resume -s run%realizations=3 -s "output%format='classic'"; says "out.nc.*another version"
    expect 0 "$rsc" case.nml -q -o one.nc
    expect 0 "$rsc" case.nml -q --resume -o one.nc; says "complete"
    expect 0 "$rsc" case.nml -q --resume -o one.nc -s run%seed=5; silent_on "whole"
    expect 0 "$rsc" case.nml -q --resume -o one.nc -s run%seed=5 -s run%threads=1; says "complete"
    for k in 1 2 3 4; do sed "s/5/$k.5/" map.txt > m$k.txt; done
    from heights 'm[1-4].txt'
    maps=(case.nml -q -s surface%L=7 -s run%realizations=2)
    expect 0 "$rsc" "${maps[@]}" -o a.nc
    sleep 0.02; touch m2.txt
    expect 0 "$rsc" "${maps[@]}" -o a.nc --resume; says "a.nc.*input has changed"
    # The first map of each part says what sigma is, and where bins lie.
    expect 0 "$rsc" "${maps[@]}" -o b.nc -s run%first_realization=3
    expect 2 "$rsc" -q --merge a.nc b.nc -o whole.nc; says "b.nc.*not the same"
    expect 0 "$rsc" "${maps[@]}" -o c.nc -s run%first_realization=2
    expect 2 "$rsc" -q --merge a.nc c.nc -o new.nc; says "realization 2 .*a.nc.*c.nc"
}

# A study that is stopped says how far it came: as many members as there are results.
test_stopped() {
    printf "&study run%%seed = 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 /\n" >> case.nml
    "$rsc" -q case.nml -s surface%n=1024 -s surface%L_lambda_s=256 -s indentation%steps=60 -s run%threads=1 > said 2>&1 &
    until ls | grep -q 'out_002.nc$'; do kill -0 $! || break; sleep 0.01; done
    kill -TERM $!
    wait $!
    [ $? -eq 143 ] || fail "status"
    local there
    there=$(ls | grep -c 'out_0[0-9]*.nc$')
    [ $there -lt 12 ] || exit 77
    says "SIGTERM; \($there\|$((there - 1))\) of 12 members"  # the signal may come when a result is in place and not yet counted
}

"test_$test"
