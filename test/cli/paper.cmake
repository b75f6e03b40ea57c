# The paper's figures, shortened: the script from end to end, and what it says when it cannot run.
add_test(NAME cli.paper
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/paper.sh $<TARGET_FILE:rsc> ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR}/paper.run)
set_tests_properties(cli.paper PROPERTIES LABELS cli TIMEOUT 900 SKIP_RETURN_CODE 77)
