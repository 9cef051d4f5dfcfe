# One static library per module: include/lekalo/NAME is its public face, src/NAME its body.

add_library(lekalo_options INTERFACE)
target_compile_options(lekalo_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${LEKALO_WERROR}>:-Werror>
  # g++ 12 invents overlapping copies in string concatenation at -O3 (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Of files that are compiled in one piece clang++ compares local names with those at file scope of the others.
  $<$<AND:$<CXX_COMPILER_ID:Clang>,$<BOOL:${LEKALO_UNITY}>>:-Wno-shadow>
  # Results must be the same bytes for every compiler and optimisation level: no fused
  # multiply-add unless the source says so (docs/design/geometry.md).
  -ffp-contract=off)
lekalo_precompile(lekalo_headers HEADERS ${lekalo_standard_headers} LIBRARIES fmt::fmt tl::expected)

# lekalo_module(NAME [PUBLIC targets...] [PRIVATE targets...] [ROOMS "room: used rooms..."...])
#
# PUBLIC: what the module's headers may include; PRIVATE: what only its body may. The lekalo:: targets
# among them are the arrows of ARCHITECTURE.md; there is no other list of them. ROOMS are the folders of
# src/NAME and include/lekalo/NAME, each with the rooms stated before it that its files may include; files
# beside the rooms may include all of them.
function(lekalo_module NAME)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE;ROOMS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${NAME}/*.cpp)
  if(NOT sources)
    set(sources ${PROJECT_BINARY_DIR}/empty_${NAME}.cpp)
    file(CONFIGURE OUTPUT ${sources} CONTENT "")
  endif()
  add_library(lekalo_${NAME} STATIC ${sources})
  add_library(lekalo::${NAME} ALIAS lekalo_${NAME})
  set_target_properties(lekalo_${NAME} PROPERTIES EXPORT_NAME ${NAME})
  target_include_directories(lekalo_${NAME} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(lekalo_${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/src)  # "MODULE/ROOM/file.hpp"
  target_compile_features(lekalo_${NAME} PUBLIC cxx_std_20)
  target_link_libraries(lekalo_${NAME}
    PUBLIC ${ARG_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:lekalo_options> ${ARG_PRIVATE})
  if(fmt::fmt IN_LIST ARG_PRIVATE)  # g++ takes the headers with the definitions they were made with
    lekalo_use_precompiled(lekalo_${NAME} lekalo_headers)
  endif()
  lekalo_unite(lekalo_${NAME} 9 ${sources})
  set_property(GLOBAL APPEND PROPERTY LEKALO_MODULES lekalo_${NAME})

  set(arrows "module ${NAME}")
  foreach(face PUBLIC PRIVATE)
    set(modules ${ARG_${face}})
    list(FILTER modules INCLUDE REGEX "^lekalo::")
    list(TRANSFORM modules REPLACE "^lekalo::" "")
    list(JOIN modules " " modules)
    string(APPEND arrows "\n${face} ${NAME}: ${modules}")
  endforeach()
  foreach(room IN LISTS ARG_ROOMS)
    string(APPEND arrows "\nROOM ${NAME}/${room}")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY LEKALO_LAYERS "${arrows}\n")
endfunction()

# lekalo_rooms(FOLDER "room: used rooms"...): the rooms of a program. Files beside them may include all of them and be
# included by all of them.
function(lekalo_rooms FOLDER)
  foreach(room IN LISTS ARGN)
    set_property(GLOBAL APPEND_STRING PROPERTY LEKALO_LAYERS "ROOM ${FOLDER}/${room}\n")
  endforeach()
endfunction()

# Writes the arrows for tests/layers/check_layers.cmake.
function(lekalo_write_layers FILE)
  get_property(layers GLOBAL PROPERTY LEKALO_LAYERS)
  file(CONFIGURE OUTPUT ${FILE} CONTENT "${layers}" @ONLY)
endfunction()
