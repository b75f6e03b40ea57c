# The fuzzers, built by CLANG from SOURCE in FOLDER.
foreach(step "-S;${SOURCE};-B;${FOLDER};-DCMAKE_C_COMPILER=clang;-DCMAKE_CXX_COMPILER=${CLANG};-DCMAKE_BUILD_TYPE=Release;-DCMAKE_CXX_FLAGS_RELEASE=-O1;-DRSC_FORTRAN=OFF;-DRSC_SANITIZE=fuzzer,address,undefined"
             "--build;${FOLDER};--target;fuzzers;--parallel;2")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${output}")
  endif()
endforeach()
