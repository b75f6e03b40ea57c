# The fuzzers, built by CLANG with FLAGS from SOURCE in FOLDER. The checks of null and misaligned
# pointers are left out: they are a third of the work of building, and the address sanitizer sees
# what they are about.
set(flags "${FLAGS} -fno-sanitize=null,alignment,object-size,vptr")
string(REPLACE "clang++" "clang" clang_c "${CLANG}")
set(configure -S ${SOURCE} -B ${FOLDER} -DCMAKE_C_COMPILER=${clang_c} -DCMAKE_CXX_COMPILER=${CLANG}
              -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS_RELEASE=${flags}" -DRSC_FORTRAN=OFF
              -DRSC_MPI=OFF -DRSC_SANITIZE=fuzzer,address,undefined)
set(build --build ${FOLDER} --target fuzzers --parallel 2)
foreach(step configure build)
  execute_process(COMMAND ${CMAKE_COMMAND} ${${step}} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${output}")
  endif()
endforeach()
