# Installs the Python package where a Python looks that belongs to the prefix (/usr, /usr/local,
# ~/.local); under another prefix into lib/python3/dist-packages, and says how Python finds it.
# Run at installation time: the prefix is known only then. SOURCE: the folder of the package.
set(folder "")
foreach(python /usr/bin/python3 python3)
  if(NOT folder)
    execute_process(COMMAND ${python} -c "
import os, site, sys
prefix = os.path.realpath(sys.argv[1])
paths = site.getsitepackages() + [site.getusersitepackages()]
found = [p for p in paths if os.path.realpath(os.path.join(p, '../../..')) == prefix]
print(found[0] if found else '', end='')" ${CMAKE_INSTALL_PREFIX}
                    OUTPUT_VARIABLE folder ERROR_QUIET)
  endif()
endforeach()
if(NOT folder)
  set(folder ${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages)
  message(STATUS "Python: set PYTHONPATH=${folder} to find the package rsc")
endif()
file(INSTALL ${SOURCE} DESTINATION ${folder} PATTERN __pycache__ EXCLUDE)
