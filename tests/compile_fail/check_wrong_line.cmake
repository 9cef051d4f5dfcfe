# A case is one source file with one wrong line under LEKALO_WRONG and the right one beside it. The file must
# compile as it stands, must not compile with LEKALO_WRONG, and the compiler must say what the first line of
# the file, `// expect: REGEX`, expects: so no case fails for a reason that is not its own.
#
#   cmake -DCOMPILER=c++ -DINCLUDES=a|b -DCASE=file.cpp -P check_wrong_line.cmake
cmake_minimum_required(VERSION 3.25)

file(STRINGS ${CASE} first LIMIT_COUNT 1)
if(NOT first MATCHES "^// expect: (.+)$")
  message(FATAL_ERROR "${CASE}: the first line must be '// expect: REGEX'")
endif()
set(expected "${CMAKE_MATCH_1}")

string(REPLACE "|" ";" includes "${INCLUDES}")
list(REMOVE_DUPLICATES includes)
list(TRANSFORM includes PREPEND "-I")
set(compile ${CMAKE_COMMAND} -E env LC_ALL=C ${COMPILER} -std=c++20 -Wall -Wextra -Werror -fsyntax-only ${includes})

execute_process(COMMAND ${compile} ${CASE} RESULT_VARIABLE result ERROR_VARIABLE output)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the right line does not compile:\n${output}")
endif()
execute_process(COMMAND ${compile} -DLEKALO_WRONG ${CASE} RESULT_VARIABLE result ERROR_VARIABLE output)
if(result EQUAL 0)
  message(FATAL_ERROR "${CASE}: the wrong line compiles")
endif()
if(NOT output MATCHES "${expected}")
  message(FATAL_ERROR "${CASE}: the wrong line fails for another reason than '${expected}':\n${output}")
endif()
