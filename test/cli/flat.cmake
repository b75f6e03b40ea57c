# What rough flats are known for, shortened: the script from end to end.
add_test(NAME cli.flat
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/flat.sh $<TARGET_FILE:rsc> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/flat.run)
set_tests_properties(cli.flat PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
# The script's own doings: order, words, what it keeps and refuses, what it tells.
add_test(NAME cli.run_cases COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/run_cases.sh ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/run_cases.run)
set_tests_properties(cli.run_cases PROPERTIES LABELS cli TIMEOUT 60)
