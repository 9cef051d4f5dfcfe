# Configures the project as on a machine that lacks what it can do without. It must not fail, and each thing that is
# not there gets one sentence that names its packages.
#
#   cmake -DSOURCES=folder -DWORK=folder -DGENERATOR=Ninja -DCOMPILER=c++ -P check_absent.cmake
cmake_minimum_required(VERSION 3.25)

function(configure NAME)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${WORK}
    ${CMAKE_COMMAND} -S ${SOURCES} -B ${WORK}/${NAME} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "the project cannot be configured ${NAME}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect)
  string(REPLACE ";" "," said "${output}")  # for a list of CMake ends an item there
  foreach(sentence IN LISTS ARGN)
    string(REGEX MATCHALL "${sentence}[^\n]*, tools/setup.sh installs it" told "${said}")
    list(LENGTH told times)
    if(NOT times EQUAL 1)
      message(FATAL_ERROR "\"${sentence}...; tools/setup.sh installs it.\" is told ${times} times in:\n${output}")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE ${WORK})
# These files go before the system's of those names, and lead nowhere.
foreach(name ipopt libqrencode)
  file(WRITE ${WORK}/${name}.pc "Name: ${name}\nDescription: none\nVersion: 0\nRequires: no-such-library\n")
endforeach()

configure(without_components -DLEKALO_WASM_CXX= -DLEKALO_NODE= -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON)
expect("No IPOPT .coinor-libipopt-dev," "No libqrencode .libqrencode-dev.:" "No GoogleTest .libgtest-dev.:" "No compiler for WebAssembly .clang-19,"
       "No Node .nodejs,")
configure(without_python -DLEKALO_WITH_WASM=OFF -DCMAKE_DISABLE_FIND_PACKAGE_Python3=ON)
expect("No Python .python3.:")
file(REMOVE_RECURSE ${WORK})
