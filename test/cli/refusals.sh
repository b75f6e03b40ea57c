#!/bin/bash
# What is refused before a run because of files, surfaces and places: bash refusals.sh TEST RSC FOLDER. Each message word by word, status 2,
# nothing written; and what is just right is taken. What the text of a case alone can get wrong is in test/data/said/refusals.txt.
# Exit status 0: passed, 77: skipped, anything else: failed.
set -u
test=$1 rsc=$2 folder=$3
export SOURCE_DATE_EPOCH=1700000000
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder" || exit 1
failures=0

fail() { echo "failed: $*"; failures=$((failures + 1)); }
# status STATUS 'what stderr says' words...: rsc with these words.
status() {
    local wanted=$1 words=$2 got
    shift 2
    "$rsc" "$@" > out 2> err < /dev/null
    got=$?
    [ $got -eq "$wanted" ] || fail "status $got instead of $wanted: $*: $(cat err)"
    [ "$(cat err)" = "$words" ] || fail "$*
  said:     $(cat err)
  expected: $words"
}
# refused 'words' arguments...: the case below with these, checked and run.
refused() {
    local words=$1
    shift
    ls -A > before
    status 2 "$words" case.nml "$@"
    status 2 "$words" --check case.nml "$@"
    ls -A | cmp -s - before || fail "something was written: $*"
}
# taken arguments...
taken() {
    "$rsc" --check -q case.nml "$@" > out 2> err || fail "refused: $*: $(cat err)"
    [ ! -s err ] || fail "says of $*: $(cat err)"
}
touch before out err
cat > case.nml << 'END'
&surface     n = 64  L_lambda_l = 2  L_lambda_s = 16 /
&indentation steps = 2 /
&output      file = 'out.nc'  map_cells = 4 /
END
# Heights as text, with its four summits; nine points more than the border needs.
cat > map.txt << 'END'
0 0 0 0 0 0 0
0 3 0 0 0 2 0
0 0 0 0 0 0 0
0 0 0 4 0 0 0
0 0 0 0 0 0 0
0 1 0 0 0 5 0
0 0 0 0 0 0 0
END
printf '0.2 0.3 0.010 0.05\n0.6 0.8 0.012 0.04\n' > list.txt
sed 's/n = 64.*16//' case.nml > read.nml
# read from SOURCE FILE: the case for it takes the place of the other.
from() { sed "s/&surface/\&surface source = '$1' file = '$2'/" read.nml > case.nml; }

test_paths() {
    mkdir folder
    echo mine > mine.txt
    refused "&output file='folder': this is a folder; name a file in it, such as 'folder/rsc.nc'" -o folder
    refused "&output file='none/': a file name is expected after the last '/'" -o none/
    refused "&output file='mine.txt/out.nc': 'mine.txt' is not a folder" -o mine.txt/out.nc
    refused "&output file='mine.txt': this file exists and is no result of rsc; it is left alone: name another, or remove it first" -o mine.txt
    refused "&output file='case.nml': this is an input of the run ('case.nml'), which the result would overwrite; name another file" -o case.nml
    refused "&output file='/nowhere/at/out.nc': folder '/nowhere/at' does not exist; make it first" -o /nowhere/at/out.nc
    refused "&output file='/dev/null': something that is not a plain file has this name" -o /dev/null
    taken -o new/folder/out.nc
    taken -o folder/out.nc
    for kept in last all; do
        refused "&output contacts: contacts are kept for one realization only, and this case has 2; use contacts='none' or 'auto', or realizations=1" \
            -s run%realizations=2 -s "output%contacts='$kept'"
    done
    taken -s run%realizations=2 -s "output%contacts='none'"
    taken -s "output%contacts='last'"
}

test_program() {
    local why="times by an MPI launcher, but this program knows nothing of MPI: use rsc_mpi (cmake -DRSC_MPI=ON, or make -f Makefile.legacy rsc_mpi), or rsc --member K"
    OMPI_COMM_WORLD_SIZE=4 status 2 "rsc: started 4 $why" case.nml
    PMI_SIZE=3 status 2 "rsc: started 3 $why" case.nml
    MPI_LOCALNRANKS=2 status 2 "rsc: started 2 $why" --check case.nml
    PMI_SIZE=2 status 2 "--member: the case has no &study" --member 1 case.nml
    PMI_SIZE=1 status 0 "" --check -q case.nml
    status 2 "case.nml: no result of rsc, whose case could be shown" --case case.nml
    status 2 "--list: the case has no &study" --list case.nml
    status 2 "--member: the case has no &study" --member 1 case.nml
    status 2 "nowhere.nml: cannot be opened" nowhere.nml
    status 2 ".: cannot be read" .
    status 2 "unknown option '--chek'; did you mean '--check'? (--help lists the options)" --chek
    # What --check says when all is well: how long with how many threads.
    for threads in 1 2; do
        "$rsc" --check case.nml -s run%threads=$threads > out 2> err || fail "--check"
        local s=; [ $threads = 1 ] || s=s
        sed 's/about [0-9][^ ]* \(ms\|s\)/about TIME/' err > masked
        [ "$(cat masked)" = "rsc: the inputs can be read and the result can be written; expected to take about TIME with $threads thread$s" ] || fail "--check says $(cat err)"
        grep -q "^  threads           = $threads\$" out || fail "--check shows no threads"
    done
    printf "&study surface%%sigma = 0.01, 0.02  run%%seed = 7, 8 /\n" >> case.nml
    status 2 "--member 5: the study has 4 members (--list names them)" --member 5 case.nml
    status 0 "" --list case.nml -o there/new.nc --member 2
    [ "$(head -n 1 out)" = "1  there/new_001.nc  surface%sigma=0.01 run%seed=7" ] || fail "--list -o: $(cat out)"
    status 0 "" --list case.nml
    [ "$(cat out)" = "1  out_001.nc  surface%sigma=0.01 run%seed=7
2  out_002.nc  surface%sigma=0.01 run%seed=8
3  out_003.nc  surface%sigma=0.02 run%seed=7
4  out_004.nc  surface%sigma=0.02 run%seed=8" ] || fail "--list: $(cat out)"
}

test_surfaces() {
    from heights map.txt
    refused "map.txt: a text matrix has no spacing; L, its extent in x, must be given"
    taken -s surface%L=7
    refused "map.txt: no summit 6 or more points inside the map: no point lies strictly above its 8 neighbours" -s surface%L=7 -s "asperities%law='elliptic'"
    printf '1 1 1 1 1\n1 1 1 1 1\n1 1 1 1 1\n' > flat.txt
    from heights flat.txt
    refused "flat.txt: no summit inside the map: no point lies strictly above its 8 neighbours" -s surface%L=1
    from heights 'm?p.txt'
    taken -s surface%L=7
    refused "m?p.txt: realizations up to 2 are asked for, and 1 files match" -s surface%L=7 -s run%realizations=2
    refused "m?p.txt: realization 2 is asked for, and 1 files match" -s surface%L=7 -s run%first_realization=2
    from heights 'x*.txt'
    refused "x*.txt: no file matches this pattern" -s surface%L=7
    from heights map.txt
    refused "indentation%centre: the tip at x = 7.1, y = 3 is not above the surface, which reaches from x = 0 to 7 and from y = 0 to 7" -s surface%L=7 -s indentation%centre=7.1,3
    refused "indentation%centre: the tip at x = 3, y = -0.5 is not above the surface, which reaches from x = 0 to 7 and from y = 0 to 7" -s surface%L=7 -s indentation%centre=3,-0.5
    taken -s surface%L=7 -s indentation%centre=7,0
    # Six rows of seven: x and y end at different places.
    head -n 6 map.txt > six.txt
    from heights six.txt
    refused "indentation%centre: the tip at x = 3, y = 6.5 is not above the surface, which reaches from x = 0 to 7 and from y = 0 to 6" -s surface%L=7 -s indentation%centre=3,6.5
    taken -s surface%L=7 -s indentation%centre=6.5,3

    printf '20 1e-9\n40 1e-10\n60 1e-11\n80 1e-12\n' > spectrum.txt
    from spectrum spectrum.txt
    refused "&output file='spectrum.txt': this is an input of the run ('spectrum.txt'), which the result would overwrite; name another file" -o spectrum.txt

    from asperities list.txt
    refused "surface%L = 0.490000 is less than the extent of the asperities in list.txt, 0.500000" -s surface%L=0.49
    taken -s surface%L=0.51
    refused "indentation%centre: the tip at x = 4, y = 0.55 is not above the surface, which reaches from x = 0.15 to 0.65 and from y = 0.3 to 0.8 (the asperities' own extent; surface%L would say)" -s indentation%centre=4,0.55
    taken -s indentation%centre=3.1,0.55
    refused "asperities%law = 'elliptic' needs the principal curvatures of every asperity; these were given without: only 'hertz' is possible" -s "asperities%law='elliptic'"
    printf '0.2 0.3 0.01 0.05\n0.6 0.8 0.01 0.04\n' > level.txt
    from asperities level.txt
    local zero="surface%sigma: the rms height of what was read is 0; give a sigma > 0 (it scales unit='sigma' and solver%delta0), and unit='length' if the levels are lengths"
    refused "$zero"
    taken -s surface%sigma=0.01
    from asperities list.txt
    flats=(-s solids%R=Infinity,Infinity -s "indentation%boundary='periodic'" -s "indentation%control='pressure'")
    refused "indentation%unit = 'relative': the surface's rms slope is not known, only summits; use unit = 'pressure'" \
        "${flats[@]}" -s "indentation%unit='relative'" -s indentation%levels=0.1 -s surface%L=2
}

# A pressure that closes the gap; grids too large for elements; maps of different sizes.
test_sizes() {
    # E* sqrt(2 m2) of a wave 0.1 cos(2 pi x/8) on 8 points of step 1 by forward differences: m2 is half the mean square slope.
    : > wave.txt
    for j in 1 2 3 4 5 6 7 8; do echo "0.1 0.0707106781 0 -0.0707106781 -0.1 -0.0707106781 0 0.07071067811$j" >> wave.txt; done
    from heights wave.txt
    flats=(-s solids%R=Infinity,Infinity -s solids%E=1,Infinity -s solids%nu=0,0 -s "indentation%boundary='periodic'" -s "solver%model='elements'"
           -s "indentation%control='pressure'" -s "indentation%unit='pressure'" -s surface%L=8 -s "surface%detrend='none'")
    # sqrt(<z_x^2>) = 0.1 sqrt(2) sin(pi/8) = 0.0541196
    refused "indentation: a pressure of 0.0542 closes the gap altogether: it must be below E* sqrt(2 m2) = 0.0541196" "${flats[@]}" -s indentation%levels=0.01,0.0542
    taken "${flats[@]}" -s indentation%levels=0.0541
    head -n 6 map.txt > m1.txt
    cp map.txt m2.txt
    from heights 'm[12].txt'
    for model in asperities elements; do
        status 1 "realization 2: the map of realization 2 is 7.000000 x 7.000000, the first is 7.000000 x 6.000000; maps of one size are expected
1 of 2 realizations are finished and kept in 'out.nc.checkpoint': the same command with --resume goes on from there" \
            case.nml -q -s surface%L=7 -s run%realizations=2 -s run%threads=1 -s "solver%model='$model'" -s "indentation%levels=4,3.5"
        rm -f out.nc.checkpoint
    done
    # By less than a thousandth, in y alone: x y z of 7 x 7 points.
    for k in 1 2; do
        awk -v k=$k '{ for (i = 1; i <= NF; i++) printf "%g %.6f %g\n", i - 1, (NR - 1) * (k == 1 ? 1 : 1.0005), $i }' map.txt > t$k.txt
    done
    from heights 't?.txt'
    status 1 "realization 2: the map of realization 2 is 7.000000 x 7.003500, the first is 7.000000 x 7.000000; maps of one size are expected
1 of 2 realizations are finished and kept in 'out.nc.checkpoint': the same command with --resume goes on from there" \
        case.nml -q -s run%realizations=2 -s run%threads=1 -s "indentation%levels=4,3.5"
}

# The manifest of a study, and what of a study is in the way.
test_study() {
    printf "&study surface%%sigma = 0.01, 0.02  solids%%R(2) = 2, Infinity /\n" >> case.nml
    local left="; it is left alone: let &output file have another name"
    echo mine > out_manifest.txt
    refused "the manifest of the study, 'out_manifest.txt': this file exists and is no manifest of rsc$left"
    mv out_manifest.txt out_manifest.nc
    refused "the manifest of the study, 'out_manifest.nc': this file exists and is no manifest of rsc$left"
    rm out_manifest.nc
    cp case.nml out_manifest.txt
    "$rsc" out_manifest.txt 2> err && fail "the case was taken for a manifest"
    [ "$(cat err)" = "the manifest of the study, 'out_manifest.txt': this is an input of the run$left" ] || fail "an input: $(cat err)"
    rm out_manifest.txt
    mkdir out_003.nc
    refused "member 3 (surface%sigma=0.02 solids%R(2)=2): &output file='out_003.nc': this is a folder; name a file in it, such as 'out_003.nc/rsc.nc'"
    rmdir out_003.nc
    status 0 "" case.nml -s "run%title='T'" -s "run%length_unit='um'"
    [ "$(cat out_manifest.txt)" = "# member	file	surface%sigma	solids%R(2)
1	out_001.nc	0.01	2
2	out_002.nc	0.01	Infinity
3	out_003.nc	0.02	2
4	out_004.nc	0.02	Infinity" ] || fail "the manifest: $(cat out_manifest.txt)"
    # Each member is what its line says: the number, the force, the area, the separation in the file.
    [ "$(tail -n 1 out)" = "4 of 4 members; the manifest: out_manifest.nc" ] || fail "the last line: $(tail -n 1 out)"
    if command -v ncdump > /dev/null; then
        ncdump out_manifest.nc > cdl
        for words in ':title = "T: manifest of the study"' ':source = "rsc ' \
            ':comment = "member k of the study is `file`(k), beside this one; the other variables are the keys that differ between members"' \
            'member = 4 ;' 'file_length = 10 ;' 'member:long_name = "number of the member"' 'file:long_name = "result file of the member"' \
            'member = 1, 2, 3, 4 ;' '"out_001.nc",' '"out_004.nc" ;' 'surface_sigma:units = "um"' 'surface_sigma:key = "surface%sigma"' \
            'surface_sigma = 0.01, 0.01, 0.02, 0.02 ;' 'char solids_R_2(member, solids_R_2_length)' 'solids_R_2:key = "solids%R(2)"' \
            'solids_R_2_length = 8 ;' '"Infinity",' ':Conventions = "CF-1.10"'; do
            grep -qF -- "$words" cdl || fail "the manifest lacks $words: $(cat cdl)"
        done
        number() { ncdump -v "$2" -p 9,15 "$1" | sed -n "s/^ $2 = *//;T;:a;/;/!{N;ba};s/[ ;\n]//g;p"; }
        for k in 1 2 3 4; do
            sed -n "s/^member $k (.*): N = \([^ ]*\) N, A = \([^ ]*\) um2 at Z0 = \([^ ]*\) um; out_00$k.nc\$/\1 \2 \3/p" out > told
            [ -s told ] || fail "no line of member $k: $(cat out)"
            ncdump -v force,contact_area,separation -p 9,15 out_00$k.nc | awk -v k=$k '
                /^data:/ { data = 1 } !data || /}/ { next }
                /=/ { name = $1; sub(/.*=/, "") }
                { gsub(/[;,]/, " "); for (i = 1; i <= NF; i++) last[name] = $i }
                END { getline line < "told"; split(line, t, " ")
                      exit !(sprintf("%.8g", last["force"]) == t[1] && sprintf("%.8g", last["contact_area"]) == t[2] && sprintf("%.6g", last["separation"]) == t[3]) }' ||
                fail "member $k: told $(cat told)"
        done
    fi
    status 0 "rsc: the results of 4 of the members are there already and will be replaced" case.nml -q -s "run%length_unit='um'"
    status 0 "rsc: member 2 (surface%sigma=0.01 solids%R(2)=Infinity): 'out_002.nc' is there and whole: nothing to do" \
        case.nml --resume --member 2 -s "run%length_unit='um'"
    command -v ncdump > /dev/null && { ncdump -h out_manifest.nc | grep -qF ':title = "Manifest of a study"' || fail "the title of the manifest"; }
    cp read.nml case.nml
    sed -i 's/&surface/\&surface n = 64 L_lambda_l = 2 L_lambda_s = 16/' case.nml
    printf "&study solids%%%%E(1) = 1e4, 2e4  surface%%%%n = 64, 66  indentation%%%%start = 4, 3  mode = 'zip' /\n" | sed 's/%%/%/g' >> case.nml
    status 0 "" case.nml -q -o other.nc -s "run%force_unit='kN'"
    sed "s/&study/\&study run%force_unit = 'kN', 'N'/" case.nml > units.nml
    status 0 "" units.nml -q -o units.nc
    if command -v ncdump > /dev/null; then
        ncdump other_manifest.nc > cdl
        for words in 'solids_E_1:units = "kN mm-2"' 'solids_E_1 = 10000, 20000 ;' 'int surface_n(member)' 'surface_n:units = "1"' 'surface_n = 64, 66 ;' \
            'indentation_start = 4, 3 ;' 'indentation_start:long_name = "first level"'; do
            grep -qF -- "$words" cdl || fail "the other manifest lacks $words: $(cat cdl)"
        done
        # Numbers in different units have none.
        ncdump -h units_manifest.nc | grep -q 'solids_E_1:units' && fail "one unit of E for kN and N"
    fi
    return 0
}

# Results that are no part of a campaign, told where --resume would go on with them; and parts that are not of one whole.
test_parts() {
    other() { echo "rsc: '$1' is not the first part of this campaign ($2): all realizations are computed, and it is replaced"; }
    sed -i "s/steps = 2/levels = 3, 2/" case.nml read.nml
    status 0 "" case.nml -q -s run%realizations=2 -s "output%format='classic'"
    sed -i 's/rsc 0\.[0-9]*\.[0-9]*,/rsc 0.0.9,/' out.nc
    status 0 "$(other out.nc 'it is of another version of rsc')" case.nml -q --resume -s run%realizations=3 -s "output%format='classic'"
    # A result of this very case is left alone, another one is not.
    status 0 "" case.nml -q -o one.nc
    status 0 "rsc: 'one.nc' is there and whole: nothing to do" case.nml -q --resume -o one.nc
    status 0 "" case.nml -q --resume -o one.nc -s run%seed=5
    status 0 "rsc: 'one.nc' is there and whole: nothing to do" case.nml -q --resume -o one.nc -s run%seed=5 -s run%threads=1
    cp case.nml study.nml
    printf "&study surface%%sigma = 0.01, 0.02 /\n" >> study.nml
    status 0 "" study.nml -q
    status 0 "$(other out_manifest.nc 'it is no campaign')" case.nml -q --resume -s run%realizations=2 -o out_manifest.nc
    for k in 1 2 3 4; do sed "s/5/$k.5/" map.txt > m$k.txt; done
    from heights 'm?.txt'
    maps=(-q -s surface%L=7)
    status 0 "" case.nml "${maps[@]}" -o a.nc -s run%realizations=2
    sleep 0.02; touch m2.txt
    status 0 "$(other a.nc 'an input has changed since')" case.nml "${maps[@]}" -o a.nc --resume -s run%realizations=2
    # The first map of each part says what sigma is, and where bins lie.
    status 0 "" case.nml "${maps[@]}" -o b.nc -s run%realizations=2 -s run%first_realization=3
    status 2 "'b.nc': pressure_mean_bin begins at another value than the case gives: the surfaces were not the same" -q --merge a.nc b.nc -o whole.nc
    status 2 "--merge: 'case.nml' is no result of rsc" -q --merge a.nc case.nml -o new.nc
    status 0 "" case.nml "${maps[@]}" -o c.nc -s run%realizations=2 -s run%first_realization=2
    status 2 "--merge: realization 2 are in 'a.nc' and in 'c.nc'" -q --merge a.nc c.nc -o new.nc
    # The result finds no room: the work is kept, and the next run but writes it.
    sed 's/m?.txt/map.txt/; s/heights/synthetic/' case.nml > full.nml
    (ulimit -f 40; "$rsc" -q full.nml -s surface%n=64 -s surface%L_lambda_s=16 -s surface%L_lambda_l=2 -s output%map_cells=200 -s output%compression=0 \
        -s run%realizations=3 -o f.nc 2> err)
    [ $? -eq 1 ] || fail "no room: status"
    [ "$(tail -n 1 err)" = "3 of 3 realizations are finished and kept in 'f.nc.checkpoint': the same command with --resume writes the file without computing them again" ] ||
        fail "no room: $(cat err)"
}

# A study that is stopped says how far it came: as many members as there are results.
test_stopped() {
    printf "&study run%%seed = 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12 /\n" >> case.nml
    "$rsc" -q case.nml -s surface%n=1024 -s surface%L_lambda_s=256 -s indentation%steps=60 -s run%threads=1 2> err &
    until ls | grep -q 'out_002.nc$'; do kill -0 $! || break; sleep 0.01; done
    kill -TERM $!
    wait $!
    [ $? -eq 143 ] || fail "status"
    local there told
    there=$(ls | grep -c 'out_0[0-9]*.nc$')
    [ $there -lt 12 ] || exit 77
    # The signal may come when a result is in place and not yet counted.
    for told in $there $((there - 1)); do
        [ "$(cat err)" = "rsc: stopped by SIGTERM; $told of 12 members are finished; the same command with --resume leaves them alone" ] && return
    done
    fail "$there are there: $(cat err)"
}

"test_$test"
exit $((failures > 0))
