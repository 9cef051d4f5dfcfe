# The layer test must catch what it is for: plants one violation of each rule in a small tree and demands
# that check_layers.cmake names it, and that it passes the tree without any.
#
#   cmake -DCHECKER=check_layers.cmake -DWORK=folder -P check_planted.cmake
cmake_minimum_required(VERSION 3.25)

set(layers "module base\nPUBLIC base: \nPRIVATE base: \nmodule geom\nPUBLIC geom: base\nPRIVATE geom: \n"
  "module phi\nPUBLIC phi: geom\nPRIVATE phi: \nmodule verify\nPUBLIC verify: base\nPRIVATE verify: \n"
  "module io\nPUBLIC io: phi\nPRIVATE io: verify\n")
string(CONCAT layers ${layers})

function(plant_clean_tree)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/layers.txt "${layers}")
  file(WRITE ${WORK}/include/lekalo/base/error.hpp "#include <string>\n")
  file(WRITE ${WORK}/include/lekalo/geom/point.hpp "#include \"lekalo/base/error.hpp\"\n")
  file(WRITE ${WORK}/include/lekalo/phi/convex.hpp "#include \"lekalo/geom/point.hpp\"\nstruct Bound {\n};\n")
  file(WRITE ${WORK}/include/lekalo/io/files.hpp "#include <string>\n")
  file(WRITE ${WORK}/src/phi/convex.cpp "#include \"bound.hpp\"\n  #  include <lekalo/base/error.hpp>\n")
  file(WRITE ${WORK}/src/phi/bound.hpp "#pragma once\n")
  file(WRITE ${WORK}/src/verify/verify.cpp "#include \"lekalo/base/error.hpp\"\n")
  file(WRITE ${WORK}/src/io/files.cpp "#include <fstream>\n#include \"lekalo/verify/verify.hpp\"\n")
  file(WRITE ${WORK}/apps/cli/main.cpp "#include \"lekalo/io/files.hpp\"\n#include <iostream>\n")
endfunction()

function(run_checker RESULT OUTPUT)
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -DLAYERS=${WORK}/layers.txt -P ${CHECKER}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  set(${RESULT} ${result} PARENT_SCOPE)
  set(${OUTPUT} "${output}" PARENT_SCOPE)
endfunction()

plant_clean_tree()
run_checker(result output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "a clean tree is refused: ${output}")
endif()

# must_catch(FILE LINE SAYS): with LINE added to FILE the checker fails and its text holds SAYS.
function(must_catch FILE LINE SAYS)
  plant_clean_tree()
  file(APPEND ${WORK}/${FILE} "${LINE}\n")
  run_checker(result output)
  string(FIND "${output}" "${SAYS}" place)
  if(result EQUAL 0 OR place EQUAL -1)
    message(FATAL_ERROR "planted '${LINE}' in ${FILE}; expected '${SAYS}', got (${result}): ${output}")
  endif()
endfunction()

must_catch(src/phi/bound.hpp "struct Bound {" "bound.hpp defines Bound, and so does another header of phi")
must_catch(include/lekalo/geom/point.hpp "#include \"lekalo/phi/convex.hpp\"" "geom has no arrow to phi")
must_catch(include/lekalo/io/files.hpp "#include \"lekalo/verify/verify.hpp\"" "io has no arrow to verify")
must_catch(src/phi/convex.cpp "  #  include <lekalo/io/files.hpp>" "phi has no arrow to io")
must_catch(src/phi/convex.cpp "#include \"../io/reader.hpp\"" "neither lekalo/MODULE/... nor a file beside it")
must_catch(src/phi/convex.cpp "#include <unordered_map>" "below io nothing may depend on")
must_catch(src/verify/verify.cpp "#include \"lekalo/geom/point.hpp\"" "verify has no arrow to geom")
must_catch(apps/cli/main.cpp "#include \"lekalo/nest/strip.hpp\"" "apps has no arrow to nest")
must_catch(src/stray/new.cpp "#include <string>" "src/stray belongs to no module")
string(REPLACE "PRIVATE verify: " "PRIVATE verify: geom" layers "${layers}")
must_catch(src/verify/verify.cpp "" "it may use base only")

file(REMOVE_RECURSE ${WORK})
