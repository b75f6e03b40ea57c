# The Fortran programs under valgrind: no invalid access, no use of what was never set, nothing lost.
find_program(RSC_VALGRIND valgrind)
if(NOT RSC_VALGRIND OR RSC_SANITIZE)
  return()
endif()
set(valgrind ${RSC_VALGRIND} --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite,indirect
             --errors-for-leak-kinds=definite,indirect)
add_test(NAME valgrind.api COMMAND ${valgrind} $<TARGET_FILE:test_api_fortran>)
add_test(NAME valgrind.read_results COMMAND ${valgrind} $<TARGET_FILE:test_results> ${CMAKE_CURRENT_SOURCE_DIR}/test_results.f90
                                            result_one.nc result_measured.nc)
# Programs of modules/example, which is read after this folder: paths, not targets.
add_test(NAME valgrind.example_bouncing COMMAND ${valgrind} ${PROJECT_BINARY_DIR}/modules/example/example_bouncing 1)
set(programs valgrind.api valgrind.read_results valgrind.example_bouncing)
find_package(OpenMP COMPONENTS Fortran)
if(OpenMP_Fortran_FOUND)
  add_test(NAME valgrind.example_threads COMMAND ${valgrind} ${PROJECT_BINARY_DIR}/modules/example/example_threads)
  list(APPEND programs valgrind.example_threads)
endif()
set_tests_properties(${programs} PROPERTIES LABELS valgrind TIMEOUT 300 COST 9 ENVIRONMENT "OMP_NUM_THREADS=1;OPENBLAS_NUM_THREADS=1")
set_tests_properties(valgrind.read_results PROPERTIES FIXTURES_REQUIRED result_files)
