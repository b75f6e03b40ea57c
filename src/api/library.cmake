# The libraries a program links, and what an installation holds: rsc.h, librsc shared and static,
# the Fortran module as source and compiled, the Python package, a CMake package (rsc::rsc,
# rsc::static, rsc::fortran) and pkg-config files.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set_target_properties(rsc_core PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
set(rsc_dependencies LAPACK::LAPACK Threads::Threads PkgConfig::FFTW PkgConfig::NETCDF rsc_udunits
    ZLIB::ZLIB)
if(rsc_cholmod)
  list(APPEND rsc_dependencies ${CHOLMOD_LIBRARY})
endif()

add_library(rsc_shared SHARED $<TARGET_OBJECTS:rsc_core>)
set_target_properties(rsc_shared PROPERTIES OUTPUT_NAME rsc EXPORT_NAME rsc LINKER_LANGUAGE CXX
                      VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_link_libraries(rsc_shared PRIVATE $<BUILD_INTERFACE:${rsc_dependencies}>)
if(CMAKE_SYSTEM_NAME STREQUAL "Linux")  # templates of the C++ library would be visible otherwise
  set(rsc_symbols ${CMAKE_CURRENT_LIST_DIR}/rsc.map)
  # nodelete: the threads of its loops sleep in the library until the process ends, so dlclose
  # leaves it where it is.
  target_link_options(rsc_shared PRIVATE "LINKER:--version-script=${rsc_symbols}"
                      "LINKER:-z,nodelete")
  set_target_properties(rsc_shared PROPERTIES LINK_DEPENDS ${rsc_symbols})
endif()

add_library(rsc_static STATIC $<TARGET_OBJECTS:rsc_core>)
set_target_properties(rsc_static PROPERTIES OUTPUT_NAME rsc EXPORT_NAME static LINKER_LANGUAGE CXX)
set(rsc_installed_dependencies LAPACK::LAPACK Threads::Threads PkgConfig::rsc_fftw
    PkgConfig::rsc_netcdf udunits2 ZLIB::ZLIB ${rsc_cholmod})
target_link_libraries(rsc_static PUBLIC "$<BUILD_INTERFACE:${rsc_dependencies}>"
                      "$<INSTALL_INTERFACE:${rsc_installed_dependencies}>")

foreach(library rsc_shared rsc_static)
  target_include_directories(${library} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()
add_library(rsc::rsc ALIAS rsc_shared)
add_library(rsc::static ALIAS rsc_static)

set(rsc_package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/rsc)
install(TARGETS rsc RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET rsc_mpi)
  install(TARGETS rsc_mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES ${PROJECT_BINARY_DIR}/rsc.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/output/plot ${PROJECT_SOURCE_DIR}/output/export
        DESTINATION ${CMAKE_INSTALL_DATADIR}/rsc
        FILES_MATCHING PATTERN *.py PATTERN __pycache__ EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/modules/rsc/_sound.py
        DESTINATION ${CMAKE_INSTALL_DATADIR}/rsc/plot)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/input ${PROJECT_SOURCE_DIR}/modules/example
        DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN README PATTERN *.ipynb PATTERN *.nml PATTERN *.sh PATTERN *.py
        PATTERN *.gwy PATTERN *.sdf PATTERN *.txt PATTERN *.nc
        PATTERN *.f90 PATTERN *.f PATTERN *.c)
install(FILES ${PROJECT_SOURCE_DIR}/README ${PROJECT_SOURCE_DIR}/LICENSE
        ${PROJECT_SOURCE_DIR}/CHANGELOG DESTINATION ${CMAKE_INSTALL_DOCDIR})
foreach(room modules output src test)
  install(FILES ${PROJECT_SOURCE_DIR}/${room}/README DESTINATION ${CMAKE_INSTALL_DOCDIR}/${room})
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/src/THEORY.rst DESTINATION ${CMAKE_INSTALL_DOCDIR}/src)
install(TARGETS rsc_shared EXPORT rscTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS rsc_static EXPORT rscStaticTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES ${PROJECT_SOURCE_DIR}/src/rsc.h ${PROJECT_SOURCE_DIR}/modules/rsc_law.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT rscTargets NAMESPACE rsc:: DESTINATION ${rsc_package_folder})
install(EXPORT rscStaticTargets NAMESPACE rsc:: DESTINATION ${rsc_package_folder})

set(rsc_fortran_root ${CMAKE_INSTALL_LIBDIR}/fortran/modules)
if(RSC_FORTRAN)
  enable_language(Fortran)
  # A .mod file can be read only by the compiler that wrote it: its folder says which that is, and
  # the source lies beside it.
  string(REGEX MATCH "^[0-9]+" compiler_version "${CMAKE_Fortran_COMPILER_VERSION}")
  string(TOLOWER "${CMAKE_Fortran_COMPILER_ID}" compiler_name)
  string(REPLACE "gnu" "gfortran" compiler_name "${compiler_name}")
  set(rsc_fortran_folder ${rsc_fortran_root}/${compiler_name}-${compiler_version})

  add_library(rsc_fortran STATIC ${PROJECT_SOURCE_DIR}/modules/rsc.f90)
  file(GLOB included ${PROJECT_SOURCE_DIR}/modules/generated/*.inc)
  set_source_files_properties(${PROJECT_SOURCE_DIR}/modules/rsc.f90
                              PROPERTIES OBJECT_DEPENDS "${included}")
  set(modules ${PROJECT_BINARY_DIR}/modules)
  set_target_properties(rsc_fortran PROPERTIES Fortran_MODULE_DIRECTORY ${modules}
                        EXPORT_NAME fortran)
  target_compile_options(rsc_fortran PRIVATE $<$<Fortran_COMPILER_ID:GNU>:-std=f2018 -Wall -Wextra>)
  target_include_directories(rsc_fortran INTERFACE $<BUILD_INTERFACE:${modules}>
                             $<INSTALL_INTERFACE:${rsc_fortran_folder}>)
  target_link_libraries(rsc_fortran PUBLIC rsc_shared)
  add_library(rsc::fortran ALIAS rsc_fortran)
  install(TARGETS rsc_fortran EXPORT rscFortranTargets ARCHIVE DESTINATION ${rsc_fortran_folder})
  install(EXPORT rscFortranTargets NAMESPACE rsc:: DESTINATION ${rsc_package_folder})
  install(FILES ${modules}/rsc.mod DESTINATION ${rsc_fortran_folder})
else()
  set(rsc_fortran_folder ${rsc_fortran_root})  # the source alone, for any compiler
endif()
install(FILES ${PROJECT_SOURCE_DIR}/modules/rsc.f90 ${PROJECT_SOURCE_DIR}/modules/rsc_results.f90
        ${PROJECT_SOURCE_DIR}/modules/rsc_law.f90
        DESTINATION ${rsc_fortran_folder})
install(FILES ${PROJECT_SOURCE_DIR}/modules/generated/interface.inc
        ${PROJECT_SOURCE_DIR}/modules/generated/wrappers.inc
        DESTINATION ${rsc_fortran_folder}/generated)  # rsc.f90 includes them

# FORTRAN 77: subroutines with integer handles, in C, for any Fortran compiler.
add_library(rsc_77 STATIC ${PROJECT_SOURCE_DIR}/modules/rsc77.c)
set_target_properties(rsc_77 PROPERTIES OUTPUT_NAME rsc77 EXPORT_NAME rsc77 C_STANDARD 11)
target_link_libraries(rsc_77 PUBLIC rsc_shared PRIVATE $<BUILD_INTERFACE:rsc_warnings>)
add_library(rsc::rsc77 ALIAS rsc_77)
install(TARGETS rsc_77 EXPORT rscTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

install(CODE "set(SOURCE [[${PROJECT_SOURCE_DIR}/modules/rsc]])")
install(SCRIPT ${PROJECT_SOURCE_DIR}/modules/install_python.cmake)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rscConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/rscConfig.cmake
                              INSTALL_DESTINATION ${rsc_package_folder})
# Since this version nothing was removed from rsc.h, the modules and these targets, so that a
# program for it or a later one builds with this one, too. To be raised when something is removed.
set(rsc_oldest 0.3)
set(rsc_version_file ${PROJECT_BINARY_DIR}/rscConfigVersion.cmake)
write_basic_package_version_file(${rsc_version_file} COMPATIBILITY SameMajorVersion)
file(READ ${rsc_version_file} rsc_same_major)
file(WRITE ${rsc_version_file} "if(PACKAGE_FIND_VERSION AND \
PACKAGE_FIND_VERSION VERSION_LESS ${rsc_oldest})
  set(PACKAGE_VERSION ${PROJECT_VERSION})
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
  return()
endif()
${rsc_same_major}")
install(FILES ${PROJECT_BINARY_DIR}/rscConfig.cmake ${PROJECT_BINARY_DIR}/rscConfigVersion.cmake
        DESTINATION ${rsc_package_folder})

# pkg-config: folders relative to the .pc file, so that an installation may be moved.
string(REGEX REPLACE "[^/]+" ".." rsc_up "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
set(rsc_private_libraries "")
foreach(library ${LAPACK_LIBRARIES} ${BLAS_LIBRARIES})
  if(library MATCHES "lib([^/]+)\\.(so|a|dylib)$")
    list(APPEND rsc_private_libraries "-l${CMAKE_MATCH_1}")
  elseif(NOT library MATCHES "::")
    list(APPEND rsc_private_libraries "${library}")
  endif()
endforeach()
if(rsc_cholmod)
  list(APPEND rsc_private_libraries -lcholmod)
endif()
list(APPEND rsc_private_libraries -lfftw3_threads -lfftw3f_threads -ludunits2
     ${CMAKE_THREAD_LIBS_INIT} -lstdc++ -lm)
list(REMOVE_DUPLICATES rsc_private_libraries)
list(JOIN rsc_private_libraries " " rsc_private_libraries)
configure_file(${CMAKE_CURRENT_LIST_DIR}/rsc.pc.in ${PROJECT_BINARY_DIR}/rsc.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/rsc.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(RSC_FORTRAN)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/rsc_fortran.pc.in ${PROJECT_BINARY_DIR}/rsc_fortran.pc
                 @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/rsc_fortran.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endif()
