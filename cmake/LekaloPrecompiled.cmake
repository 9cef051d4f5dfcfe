# A third of the time of most sources went into reading the same standard headers. They are read once here, for the
# modules and programs and, with gtest, for the tests. The preset 'clang' goes without and so holds that each file
# includes what it uses.
option(LEKALO_PRECOMPILE "Read the standard headers once for all sources" ${PROJECT_IS_TOP_LEVEL})
set(lekalo_standard_headers <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers>
  <optional> <set> <span> <sstream> <string> <string_view> <unordered_map> <utility> <variant> <vector>
  <fmt/core.h> <tl/expected.hpp>)

# lekalo_precompile(NAME HEADERS headers... LIBRARIES targets... [OPTIONS options...]): precompiles HEADERS as NAME.
function(lekalo_precompile NAME)
  if(NOT LEKALO_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(source ${PROJECT_BINARY_DIR}/${NAME}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(${NAME} OBJECT ${source})
  target_link_libraries(${NAME} PRIVATE ${ARG_LIBRARIES} lekalo_options)
  target_compile_options(${NAME} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${NAME} PRIVATE ${ARG_HEADERS})
  lekalo_takes_precompiled(${NAME})
endfunction()

# Makes ccache take the objects of a target that are made with a precompiled header: it asks to be told that
# this is safe, and the header itself must hold no time.
function(lekalo_takes_precompiled TARGET)
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    set_target_properties(${TARGET} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${CMAKE_CXX_COMPILER_LAUNCHER}")
  endif()
  # g++ 12 does not know any more that these headers are the system's, and tells of strings of the library what it
  # suspects there, of which nothing was true; the address sanitizer looks for the same.
  target_compile_options(${TARGET} PRIVATE
    $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>
    $<$<CXX_COMPILER_ID:GNU>:SHELL:-fpch-preprocess -Wno-array-bounds -Wno-stringop-overread -Wno-stringop-overflow>)
endfunction()

# lekalo_use_precompiled(TARGET NAME): TARGET's sources begin with the headers of NAME.
function(lekalo_use_precompiled TARGET NAME)
  if(LEKALO_PRECOMPILE)
    target_precompile_headers(${TARGET} REUSE_FROM ${NAME})
    lekalo_takes_precompiled(${TARGET})
  endif()
endfunction()
