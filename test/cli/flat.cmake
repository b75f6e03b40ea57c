# What rough flats are known for, shortened: the script from end to end.
add_test(NAME cli.flat
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/flat.sh $<TARGET_FILE:rsc> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/flat.run)
set_tests_properties(cli.flat PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
