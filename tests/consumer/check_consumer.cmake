# Installs the build into an empty prefix, then configures, builds and runs the stranger's project there.
#
#   cmake -DBUILD=folder -DWORK=folder -DGENERATOR=Ninja -DCOMPILER=c++ -DFLAGS=... -DTYPE=Release
#         -DMODULES=base|geom|... -P check_consumer.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# A folder with a blank in its name, as people have them.
set(prefix "${WORK}/prefix of a stranger")
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})

# The installed tree must stand on its own: nothing in it names the tree it was built from.
file(GLOB_RECURSE package_files ${prefix}/*.cmake)
foreach(file IN LISTS package_files)
  file(STRINGS ${file} leaks REGEX "lekalo_options")
  file(STRINGS ${file} paths)
  foreach(line IN LISTS paths)
    string(FIND "${line}" "${BUILD}" place)
    if(NOT place EQUAL -1)
      list(APPEND leaks "${line}")
    endif()
  endforeach()
  if(leaks)
    message(FATAL_ERROR "${file} names the build it came from: ${leaks}")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${WORK}/build -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${TYPE}
  -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
message(STATUS "${output}")
run(${prefix}/bin/lekalo --version)

# The example program, built the same way.
set(example ${CMAKE_CURRENT_LIST_DIR}/../../examples/library)
run(${CMAKE_COMMAND} -S ${example} -B ${WORK}/library -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_FLAGS=${FLAGS} -DCMAKE_BUILD_TYPE=${TYPE}
  -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/library)
run(${WORK}/library/locate ${example}/plate.json ${example}/casting.json ${WORK}/located.json)
if(NOT output MATCHES "clearance 2\\.[0-9]+ mm, and no placement has more than 2\\.")
  message(FATAL_ERROR "examples/library/locate does not find the placement:\n${output}")
endif()
run(${prefix}/bin/lekalo verify ${WORK}/located.json)
run(${WORK}/library/locate_solid ${example}/../solid/part.stl ${example}/../solid/casting.stl ${WORK}/solid.json)
if(NOT output MATCHES "clearance 1\\.9[0-9]+ mm, and no placement has more than")
  message(FATAL_ERROR "examples/library/locate_solid does not find the placement:\n${output}")
endif()
run(${prefix}/bin/lekalo verify ${WORK}/solid.json)
run(${WORK}/library/nest ${example}/../layouts/shoes.json ${WORK}/nested.json)
run(${prefix}/bin/lekalo check ${WORK}/nested.json)
run(${WORK}/library/pocket ${example}/../pockets/cover.json)
if(NOT output MATCHES "M30.*cut: (99\\.99|100)")
  message(FATAL_ERROR "examples/library/pocket does not write a judged program:\n${output}")
endif()
file(REMOVE_RECURSE ${WORK})

# The README shows just these lines.
file(READ ${CMAKE_CURRENT_LIST_DIR}/../../README.md readme)
file(READ ${CMAKE_CURRENT_LIST_DIR}/main.cpp program)
string(REGEX MATCH "```cpp\n([^`]*)```" shown "${readme}")
string(REPLACE "\n" "\n  " shown "${CMAKE_MATCH_1}")
string(STRIP "${shown}" shown)
string(FIND "${program}" "${shown}" place)
if(shown STREQUAL "" OR place EQUAL -1)
  message(FATAL_ERROR "The C++ lines of README.md do not stand in tests/consumer/main.cpp as they are:\n${shown}")
endif()
