#!/bin/sh
# The whole ctest under sanitizers, and the Fortran programs under valgrind. Anything they find makes a test fail.
# Usage: sh test/sanitize.sh [address|thread|valgrind]...   (all three without); builds in build/sanitize-<kind>; CTEST_ARGS goes to ctest.
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
jobs=$(getconf _NPROCESSORS_ONLN 2> /dev/null || echo 2)

suite() {  # suite KIND FLAGS CTEST_ARGS...
    kind=$1 flags=$2
    shift 2
    build=$top/build/sanitize-$kind
    cmake -S "$top" -B "$build" -DRSC_SANITIZE="$flags" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DRSC_FORTRAN="${fortran:-ON}"
    cmake --build "$build" --parallel "$jobs"
    # What the tests build themselves (installed package) needs the flags, too.
    # shellcheck disable=SC2086
    (cd "$build" && CFLAGS="-fsanitize=$flags" CXXFLAGS="-fsanitize=$flags" FFLAGS="-fsanitize=$flags" LDFLAGS="-fsanitize=$flags" \
        ctest --output-on-failure --timeout 1500 "$@" ${CTEST_ARGS:-})
}

[ $# -gt 0 ] || set -- address thread valgrind
for kind in "$@"; do
    case $kind in
        address)
            # FFTW, OpenBLAS and HDF5 keep some memory until the end of the process; what rsc itself loses is told.
            export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1
            export LSAN_OPTIONS=suppressions=$top/test/leaks.supp:print_suppressions=0
            export UBSAN_OPTIONS=print_stacktrace=1
            suite address address,undefined -E ranks
            # MPI's own modules lose memory, and are gone when it is told.
            ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 suite address address,undefined -R ranks
            ;;
        thread)
            # libgomp is not instrumented, its barriers are not seen: parallel regions run on one thread. What rsc starts itself (campaigns,
            # handles on several threads) runs as always.
            export OMP_NUM_THREADS=1 OMP_THREAD_LIMIT=1 OPENBLAS_NUM_THREADS=1
            export TSAN_OPTIONS=suppressions=$top/test/threads.supp:halt_on_error=1:second_deadlock_stack=1
            fortran=OFF suite thread thread -LE package
            ;;
        valgrind)
            cmake -S "$top" -B "$top/build" > /dev/null
            cmake --build "$top/build" --parallel "$jobs"
            # shellcheck disable=SC2086
            (cd "$top/build" && ctest --output-on-failure -L valgrind ${CTEST_ARGS:-})
            ;;
        *)
            echo "sanitize.sh: address, thread or valgrind, not '$kind'" >&2
            exit 2
            ;;
    esac
done
