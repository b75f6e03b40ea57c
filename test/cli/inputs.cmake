# The scripts and cases of input/, and a picture.
foreach(name cases first parallel)
  add_test(NAME cli.inputs_${name}
           COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/inputs.sh ${name} $<TARGET_FILE:rsc> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/inputs_${name}.run)
  set_tests_properties(cli.inputs_${name} PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
