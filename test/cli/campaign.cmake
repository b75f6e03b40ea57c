# Campaigns and studies from outside: threads, ranks, kills, resumption, job arrays.
set(rsc_mpi_program "")
if(TARGET rsc_mpi)
  set(rsc_mpi_program $<TARGET_FILE:rsc_mpi>)
endif()
foreach(name threads ranks kills signals refused study limit full_disk)
  add_test(NAME cli.campaign_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/campaign.sh ${name} $<TARGET_FILE:rsc> "${rsc_mpi_program}"
                   ${CMAKE_CURRENT_BINARY_DIR}/campaign_${name}.run)
  set_tests_properties(cli.campaign_${name} PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
