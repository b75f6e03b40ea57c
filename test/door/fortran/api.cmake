# The Fortran module of the library.
add_executable(test_api_fortran test_api.f90)
target_link_libraries(test_api_fortran PRIVATE rsc::fortran)
target_compile_options(test_api_fortran PRIVATE -fcheck=all,no-array-temps -Wall)
add_test(NAME fortran.api COMMAND test_api_fortran)

add_executable(test_api_stop test_api_stop.f90)
target_link_libraries(test_api_stop PRIVATE rsc::fortran)
set_tests_properties(fortran.api PROPERTIES LABELS fortran TIMEOUT 60)
add_test(NAME fortran.api_stop COMMAND test_api_stop)
set_tests_properties(fortran.api_stop PROPERTIES LABELS fortran TIMEOUT 60 PASS_REGULAR_EXPRESSION "ERROR STOP rsc: [^\n]*sigma"
                     FAIL_REGULAR_EXPRESSION "went on after a failure")

# Objects inside types and threads, optimised: there a compiler uses every freedom it has.
find_package(OpenMP COMPONENTS Fortran)
add_executable(test_objects test_objects.f90)
target_link_libraries(test_objects PRIVATE rsc::fortran)
if(OpenMP_Fortran_FOUND)
  target_link_libraries(test_objects PRIVATE OpenMP::OpenMP_Fortran)
endif()
target_compile_options(test_objects PRIVATE -O2)
add_test(NAME fortran.objects COMMAND test_objects)
set_tests_properties(fortran.objects PROPERTIES LABELS fortran TIMEOUT 60)
