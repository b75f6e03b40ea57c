#!/bin/bash
# Faults from outside: bash faults.sh TEST RSC FOLDER. Each must end in the right exit status and a
# message that says what to do, with nothing under the final name and no work in progress left
# behind.
test=$1 rsc=$2 folder=$3
. "$(dirname "$0")/common.sh"

# A map of heights is written, too: it fills disks.
cat > case.nml << 'END'
&surface     n = 128  L_lambda_l = 4  L_lambda_s = 32 /
&indentation steps = 8 /
&output      file = 'out.nc'  map_cells = 20  heights = .true.  compression = 0 /
END
# A surface, or levels, or a file, that take their time.
slow() {
    cat > case.nml << END
&run         threads = 1 /
&surface     n = 2048  L_lambda_l = 8  L_lambda_s = 512 /
&solver      model = 'asperities' /
&asperities  law = 'hertz' /
&indentation $1 /
&output      file = 'work/out.nc'  $2 /
END
    mkdir -p work
}

# Where this user may mount one.
test_full_disk() {
    mkdir disk
    mount -t tmpfs -o size=96k none disk 2> /dev/null || exit 77
    trap 'umount "$folder/disk"' EXIT
    for format in netcdf4 cdf5 classic; do
        expect 1 "$rsc" -s "output%format='$format'" -o disk/out.nc case.nml
        says "disk/out.nc.*full"
        left disk ""
    done
    # A file that was there stays as it was.
    expect 0 "$rsc" -s output%heights=F -s output%map_cells=1 -s indentation%steps=1 \
        -s "output%contacts='none'" -s output%radial_bins=1 \
        -s output%pdf_bins=1 -s "output%format='classic'" -s "compare%levels='none'" \
        -o disk/out.nc case.nml
    cp disk/out.nc before.nc
    expect 1 "$rsc" -o disk/out.nc case.nml
    cmp before.nc disk/out.nc || fail "the file that was there is not what it was"
    left disk out.nc
    # No room for a folder: not one block, or not one inode.
    mount -o remount,nr_inodes=2 disk
    expect 1 "$rsc" -o disk/new/out.nc case.nml
    says "disk/new"
    left disk out.nc
}

test_file_limit() {
    mkdir work
    expect 1 bash -c 'ulimit -f 16; exec "$0" -o work/out.nc case.nml' "$rsc"
    says "work/out.nc.*ulimit -f"
    left work ""
}

# Lines of a run of some time: the reason is that of the write, not that of a later call. The file
# is complete.
test_full_output() {
    [ -c /dev/full ] || exit 77
    expect 1 bash -c 'exec "$0" -o out.nc case.nml > /dev/full' "$rsc"
    says "standard output.*No space left"
    [ -s out.nc ] || fail "no result"
}

test_read_only() {
    mkdir work
    chmod 0555 work
    if [ "$(id -u)" -eq 0 ]; then
        setpriv --version > /dev/null 2>&1 || exit 77
        # Nobody may go everywhere that root's build is.
        open=$(mktemp -d) && trap 'rm -rf "$open"; chmod 0755 "$folder/work"' EXIT
        cp "$rsc" case.nml "$open" && chmod 0755 "$open" && mkdir "$open/work" &&
            chmod 0555 "$open/work"
        nobody() {
            (cd "$open" && setpriv --reuid=65534 --regid=65534 --clear-groups \
                ./rsc "$@" case.nml < /dev/null)
        }
        at=$open
    else
        nobody() { "$rsc" "$@" case.nml; }
        at=$folder
        trap 'chmod 0755 "$folder/work"' EXIT
    fi
    expect 2 nobody -o work/out.nc
    says "folder 'work'.*Permission denied"
    left "$at/work" ""
    expect 2 nobody -o work/new/out.nc
    says "folder 'work'.*Permission denied"
    # What may not be read.
    chmod 0777 "$at"
    echo "1 2 3" > "$at/secret" && chmod 0000 "$at/secret"
    expect 2 nobody -s "surface%source='heights'" -s "surface%file='secret'" -s surface%L=1 \
        -o "$at/secret.nc"
    says "secret: Permission denied"
}

test_memory() {
    # Sanitizers reserve address space without end.
    bash -c 'ulimit -v 4000000; exec "$0" --version' "$rsc" > /dev/null 2>&1 || exit 77
    mkdir work
    local least=20000 refused=0 done=0   # what the program needs to exist, in KiB: its libraries
    limited() {
        bash -c 'ulimit -v "$1"; shift; OPENBLAS_NUM_THREADS=1 exec "$0" "$@"' "$rsc" "$@" \
            > said 2>&1
    }
    until limited $least --version; do
        least=$((least + 4000))
        [ $least -lt 2000000 ] || exit 77
    done
    for more in 0 4000 8000 12000 16000 24000 32000 48000 64000 96000 128000 192000 256000 \
        384000; do
        rm -f work/out.nc
        limited $((least + more)) -s run%threads=2 -s surface%n=1024 -o work/out.nc case.nml
        case $? in
            0) left work out.nc; done=$((done + 1)) ;;
            1) left work ""; refused=$((refused + 1)); says "memory\|[Tt]hread" ;;
            *) cat said; fail "the exit status with $((least + more)) KiB" ;;
        esac
    done
    [ $refused -ge 3 ] && [ $done -ge 1 ] || fail "refused $refused times, done $done times"
}

running() { kill -0 "$1" 2> /dev/null && [ "$(cut -d' ' -f3 "/proc/$1/stat" 2> /dev/null)" != Z ]; }
# Memory the process has, in KiB.
has() { sed -n 's/^VmRSS:[ \t]*\([0-9]*\) kB/\1/p' "/proc/$1/status" 2> /dev/null || echo 0; }

# stopped SIGNAL WHEN command...: the signal comes as soon as `WHEN` succeeds; the command ends by
# it.
stopped() {
    local signal=$1 when=$2 number
    shift 2
    : > said  # what the one before said is not what is waited for
    "$@" > said 2>&1 &
    local process=$!
    until eval "$when"; do
        running $process || { cat said; fail "ended before the signal could be sent: $when"; }
        sleep 0.01
    done
    kill -s "$signal" $process
    wait $process
    got=$?
}

status_of() { [ "$1" = INT ] && echo 130 || echo 143; }

# Waiting for a case that does not come.
test_signal_reading() {
    mkdir work
    mkfifo pipe
    exec 3<> pipe
    for signal in TERM INT; do
        stopped $signal 'grep -q rsc "/proc/$process/cmdline" && sleep 0.2' \
            env --default-signal=INT \
            bash -c 'exec "$0" -o work/out.nc < pipe' "$rsc"
        [ $got -eq "$(status_of $signal)" ] || { cat said; fail "exit status $got"; }
        left work ""
    done
}

# While the surface, some 400 MiB of it, is being made; while levels are solved.
ends_without_trace() { # ends_without_trace WHEN arguments...
    local when=$1
    shift
    for signal in TERM INT; do
        stopped $signal "$when" env --default-signal=INT "$rsc" "$@" case.nml
        [ $got -eq "$(status_of $signal)" ] || { cat said; fail "exit status $got"; }
        says "SIG$signal"
        left work ""
    done
}
test_signal_surface() {
    slow "steps = 2" ""
    ends_without_trace '[ "$(has $process)" -gt 150000 ]' -s surface%n=8192 \
        -s surface%L_lambda_s=3000
}
test_signal_levels() {
    slow "steps = 4000" ""
    ends_without_trace 'grep -q "^ *9 .*converged" said'
}

# The file that is being written is finished: it is a matter of a moment, and nothing is lost.
test_signal_writing() {
    slow "steps = 2" "heights = .true.  compression = 9"
    for signal in TERM INT; do
        rm -f work/*
        stopped $signal 'ls work | grep -q part' env --default-signal=INT \
            "$rsc" -s surface%n=1024 -s surface%L_lambda_s=256 case.nml
        [ $got -eq 0 ] || { cat said; fail "exit status $got"; }
        left work out.nc
        ncdump -h work/out.nc > /dev/null || fail "the file is not whole"
    done
}

"test_$test"
