# Campaigns and studies from outside: threads, ranks, kills, resumption, job arrays.
set(rsc_mpi_program "")
if(TARGET rsc_mpi)
  set(rsc_mpi_program $<TARGET_FILE:rsc_mpi>)
endif()
foreach(name threads ranks kills signals refused grow merge study limit full_disk memory)
  add_test(NAME cli.campaign_${name}
           COMMAND bash ${CMAKE_CURRENT_SOURCE_DIR}/campaign.sh ${name} $<TARGET_FILE:rsc> "${rsc_mpi_program}"
                   ${CMAKE_CURRENT_BINARY_DIR}/campaign_${name}.run)
  set_tests_properties(cli.campaign_${name} PROPERTIES LABELS cli TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
if(RSC_SANITIZE MATCHES "address")  # MPI's own modules lose memory, and are gone when it is told
  set_tests_properties(cli.campaign_ranks PROPERTIES ENVIRONMENT_MODIFICATION "ASAN_OPTIONS=string_append::detect_leaks=0")
endif()

# Against a real Slurm of one node; ctest -L cluster.
option(RSC_CLUSTER_TESTS "Test the scripts for Slurm and GNU parallel against a Slurm started for it (root, slurm-wlm, munge)" OFF)
if(RSC_CLUSTER_TESTS AND RSC_MPI)
  add_test(NAME cluster.slurm
           COMMAND bash ${PROJECT_SOURCE_DIR}/test/cluster/slurm.sh $<TARGET_FILE:rsc> $<TARGET_FILE:rsc_mpi> ${PROJECT_SOURCE_DIR}/input
                   ${CMAKE_CURRENT_BINARY_DIR}/slurm.run)
  set_tests_properties(cluster.slurm PROPERTIES LABELS cluster TIMEOUT 600 SKIP_RETURN_CODE 77)
endif()
