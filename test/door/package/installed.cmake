# Installs the build, moves the installation, then builds and runs consumers in C and Fortran
# against it. Stops at the first thing that goes wrong.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Flags from pkg-config as a list.
function(flags variable)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${pc}:$ENV{PKG_CONFIG_PATH}"
                          ${PKG_CONFIG} ${ARGN}
                  RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE error
                  OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "pkg-config ${ARGN}: ${error}")
  endif()
  separate_arguments(list UNIX_COMMAND "${text}")
  set(${variable} "${list}" PARENT_SCOPE)
endfunction()

function(must_run program)
  run(${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${libraries}" ${program} ${VERSION})
  if(NOT output MATCHES "consumer: all is well")
    message(FATAL_ERROR "${program}: ${output}")
  endif()
  message(STATUS "${program}: ${output}")
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/first)
file(RENAME ${FOLDER}/first ${FOLDER}/prefix)  # an installation may be moved
set(prefix ${FOLDER}/prefix)
file(GLOB_RECURSE pc_files ${prefix}/*/rsc.pc)
list(GET pc_files 0 pc)
get_filename_component(pc ${pc} DIRECTORY)
get_filename_component(libraries ${pc} DIRECTORY)

# Nothing but the interface can be seen from outside, and a soname tells versions apart.
file(GLOB shared ${libraries}/librsc.so.*.*.*)
if(shared)
  run(${NM} -D --defined-only ${shared})
  string(REGEX REPLACE "[0-9a-f]+ T rsc_[a-z_]+\n" "" others "${output}")
  if(NOT output MATCHES " T rsc_contact_indent" OR NOT "${others}" STREQUAL "")
    message(FATAL_ERROR "symbols of ${shared} that are not of rsc.h, or none at all:\n${others}")
  endif()
endif()

# This build has used the compilers.
set(works -DCMAKE_C_COMPILER_WORKS=ON -DCMAKE_CXX_COMPILER_WORKS=ON
          -DCMAKE_Fortran_COMPILER_WORKS=ON)
# By CMake: the shared library from C, the static one from C, the module from Fortran.
run(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${FOLDER}/consumer "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    "-DCMAKE_Fortran_COMPILER=${FORTRAN_COMPILER}" -DRSC_VERSION=${VERSION} ${works})
run(${CMAKE_COMMAND} --build ${FOLDER}/consumer)
must_run(${FOLDER}/consumer/consumer_c)
must_run(${FOLDER}/consumer/consumer_static)

# By pkg-config. Flags of the environment are for sanitizers.
separate_arguments(c_extra UNIX_COMMAND "$ENV{CFLAGS}")
separate_arguments(fortran_extra UNIX_COMMAND "$ENV{FFLAGS}")
flags(version --modversion rsc)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "rsc.pc says version ${version}, not ${VERSION}")
endif()
flags(c_flags --cflags --libs rsc)
run(${C_COMPILER} ${c_extra} -Wall -Wextra -Werror ${SOURCE}/consumer/consumer.c
    -o ${FOLDER}/pc_c ${c_flags} -lm)
must_run(${FOLDER}/pc_c)
flags(static_flags --cflags --libs --static rsc)
list(TRANSFORM static_flags REPLACE "^-lrsc$" "${libraries}/librsc.a")
run(${C_COMPILER} ${c_extra} ${SOURCE}/consumer/consumer.c
    -o ${FOLDER}/pc_static ${static_flags} -lm)
must_run(${FOLDER}/pc_static)

if(FORTRAN_COMPILER)
  must_run(${FOLDER}/consumer/consumer_fortran)
  flags(fortran_flags --cflags --libs rsc_fortran)
  run(${FORTRAN_COMPILER} ${fortran_extra} -fcheck=all ${SOURCE}/consumer/consumer.f90
      -o ${FOLDER}/pc_fortran ${fortran_flags})
  must_run(${FOLDER}/pc_fortran)
  # With a compiler of one's own: the module from its source, which lies beside the .mod.
  flags(source --variable=fortran_source rsc)
  flags(c_flags --libs rsc)
  file(MAKE_DIRECTORY ${FOLDER}/own)
  run(${FORTRAN_COMPILER} ${fortran_extra} -fcheck=all -J ${FOLDER}/own ${source}/rsc.f90
      ${SOURCE}/consumer/consumer.f90 -o ${FOLDER}/own_fortran ${c_flags})
  must_run(${FOLDER}/own_fortran)
endif()

# A project in Fortran alone: static and shared library, the reader of results; and with a compiler
# that cannot read the .mod.
find_program(FLANG NAMES flang-new-19 flang-new flang)
foreach(compiler ${FORTRAN_COMPILER} ${FLANG})
  get_filename_component(name ${compiler} NAME)
  if(compiler STREQUAL FORTRAN_COMPILER)
    set(results ON)
  else()  # netcdf.mod, too, is for the compiler that wrote it
    set(results OFF)
  endif()
  run(${CMAKE_COMMAND} -S ${SOURCE}/fortran_only -B ${FOLDER}/only_${name}
      "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_Fortran_COMPILER=${compiler}"
      -DRSC_VERSION=0.3 -DRESULTS=${results} ${works})
  run(${CMAKE_COMMAND} --build ${FOLDER}/only_${name})
  must_run(${FOLDER}/only_${name}/only_shared)
  must_run(${FOLDER}/only_${name}/only_static)
  if(results)
    execute_process(COMMAND ldd ${FOLDER}/only_${name}/only_static
                    OUTPUT_VARIABLE needed ERROR_QUIET)
    if(needed MATCHES "librsc")
      message(FATAL_ERROR "only_static needs a shared librsc:\n${needed}")
    endif()
  endif()
endforeach()

# The Python package from the installation, far from its source: it finds the library beside it.
file(GLOB module ${prefix}/lib/python*/*/rsc/__init__.py)
foreach(python python3 /usr/bin/python3)
  execute_process(COMMAND ${python} -c "import numpy" RESULT_VARIABLE status ERROR_QUIET)
  if(module AND status EQUAL 0 AND NOT DEFINED ENV{ASAN_OPTIONS})
    get_filename_component(folder ${module}/../.. ABSOLUTE)
    run(${CMAKE_COMMAND} -E env PYTHONPATH=${folder} PYTHONDONTWRITEBYTECODE=1
        ${python} -c "import rsc
print(rsc._library.shared_object_path, rsc.version())")
    if(NOT output MATCHES "^${libraries}/librsc.so ${VERSION}")
      message(FATAL_ERROR "Python: ${output}")
    endif()
    break()
  endif()
endforeach()
if(NOT module)
  message(FATAL_ERROR "the Python package is not installed")
endif()

# The tree stands alone: what README sends to is there, a case finds its data, and the line that it
# prints for the picture works elsewhere.
file(GLOB doc ${prefix}/share/doc/*)
foreach(name README CHANGELOG LICENSE input/README input/first.nml input/map/map.sdf
        input/map/map.gwy modules/README output/README src/README
        src/THEORY.rst test/README example/fixed.f)
  if(NOT EXISTS ${doc}/${name})
    message(FATAL_ERROR "${name} is not installed")
  endif()
endforeach()
set(case ${prefix}/bin/rsc input/map/map.nml -o ${FOLDER}/map.nc)
execute_process(COMMAND ${case} WORKING_DIRECTORY ${doc}
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE error)
if(NOT status EQUAL 0 OR NOT output MATCHES "picture: ([^\n]*/share/rsc/plot/plot.py [^\n]*)\n")
  message(FATAL_ERROR "${case}: status ${status}\n${output}${error}")
endif()
execute_process(COMMAND sh -c "${CMAKE_MATCH_1} --only load" WORKING_DIRECTORY ${FOLDER}
                RESULT_VARIABLE status ERROR_VARIABLE error)
if(NOT EXISTS ${FOLDER}/map_load.png AND NOT error MATCHES "no other Python here")
  message(FATAL_ERROR "${CMAKE_MATCH_1}: status ${status}\n${error}")
endif()
