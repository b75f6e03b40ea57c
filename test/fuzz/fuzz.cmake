# Runs FUZZER for SECONDS from a copy of CORPUS. Fails on a crash, a broken promise of the harness,
# an input that takes more than a minute (slow as these builds are), a single allocation of more
# than 256 MB, or more than 1 GB altogether.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/found)
set(options -max_total_time=${SECONDS} -seed=1 -timeout=60 -malloc_limit_mb=256 -rss_limit_mb=1024
            -max_len=4096 -print_final_stats=1 -print_funcs=0
            -artifact_prefix=${FOLDER}/)
set(leaks ${CMAKE_CURRENT_LIST_DIR}/../leaks.supp)
execute_process(COMMAND ${CMAKE_COMMAND} -E env "OMP_NUM_THREADS=1" "RSC_FUZZ_FOLDER=${FOLDER}"
                        "LSAN_OPTIONS=suppressions=${leaks}:print_suppressions=0"
                        ${FUZZER} ${options} found ${CORPUS} WORKING_DIRECTORY ${FOLDER}
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
string(REGEX MATCH "stat::number_of_executed_units: ([0-9]+)" units "${output}")
if(NOT status EQUAL 0 OR NOT units)
  message(FATAL_ERROR "${output}")
endif()
message(STATUS "${CMAKE_MATCH_1} inputs in ${SECONDS} s")
