# What goes wrong outside of the program: disks, folders, damaged inputs, refused memory, signals.
foreach(name full_disk file_limit read_only folder cut_input wrong_shape missing_values memory signal_reading signal_surface signal_levels
             signal_writing)
  add_test(NAME cli.fault_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/faults.sh ${name} $<TARGET_FILE:rsc> ${CMAKE_CURRENT_BINARY_DIR}/fault_${name}.run)
  set_tests_properties(cli.fault_${name} PROPERTIES LABELS cli TIMEOUT 120 SKIP_RETURN_CODE 77)
endforeach()
