# What a run does to files that are there already.
foreach(name lost lost_maps replaced newer_input study check case growth)
  add_test(NAME cli.files_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/files.sh ${name} $<TARGET_FILE:rsc> ${CMAKE_CURRENT_BINARY_DIR}/files_${name}.run)
  set_tests_properties(cli.files_${name} PROPERTIES LABELS cli TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
# What is refused because of files, surfaces and places, word by word.
foreach(name paths program surfaces sizes study parts stopped)
  add_test(NAME cli.refusals_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/refusals.sh ${name} $<TARGET_FILE:rsc> ${CMAKE_CURRENT_BINARY_DIR}/refusals_${name}.run)
  set_tests_properties(cli.refusals_${name} PROPERTIES LABELS cli TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
