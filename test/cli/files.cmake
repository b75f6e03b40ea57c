# What a run does to files that are there already.
foreach(name lost lost_maps replaced newer_input study check case growth)
  add_test(NAME cli.files_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/files.sh ${name} $<TARGET_FILE:rsc> ${CMAKE_CURRENT_BINARY_DIR}/files_${name}.run)
  set_tests_properties(cli.files_${name} PROPERTIES LABELS cli TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
