# Holds every #include of the modules and the programs against the arrows that CMake states.
#
#   cmake -DROOT=source-tree -DLAYERS=build/layers.txt -P check_layers.cmake
#
# Rules:
#   (1) include/lekalo/M reaches M and what lies behind M's PUBLIC arrows;
#   (2) src/M reaches that, and what lies behind M's PRIVATE arrows;
#   (3) verify reaches base and nothing else, whatever CMake says: the checker must not share code with
#       what it judges;
#   (4) a file in a room of a module (src/M/ROOM, include/lekalo/M/ROOM) reaches the rooms that its room states;
#       files beside the rooms reach all of them;
#   (5) every other quoted include is a file of the same folder, or of another room of the same module under
#       its whole name, "M/ROOM/file.hpp": no way round through "../";
#   (6) below disk no files, clocks, threads of output or standard randomness, below io no unordered containers
#       either: the same input gives the same bytes;
#   (7) apps may include any module, but only through public headers; the command line may include the server; a
#       room of a program reaches the rooms that it states, and the files beside the rooms;
#   (8) no folder of the product holds more than 40 files of its own;
#   (9) only src/verify/number includes GMP and MPFR: a target without them replaces that room alone;
#   (10) only src/base/parallel.cpp starts threads, and only apps may beside it: compiled without them the library
#       gives the same bytes;
#   (11) test names are sentences in CamelCase;
#   (12) headers that the compiler needs seconds for stand behind a few files, so that a cold build stays short;
#   (13) every header may be included twice: "#pragma once" is its first directive.
cmake_minimum_required(VERSION 3.25)

set(forbidden_below_disk fstream iostream filesystem chrono ctime time.h random)
set(forbidden_below_io unordered_map unordered_set)
set(number_headers gmp.h gmpxx.h mpfr.h)
set(thread_headers thread mutex shared_mutex condition_variable future semaphore latch barrier stop_token execution
    pthread.h)
set(most_files 40)
# What the header is called, and the only files that may include it.
set(heavy "^nlohmann/" "^boost/" "^CLI/" "^fmt/format[.]h$")
set(heavy_places "^src/io/text/json_(events|writer)[.]cpp$" "^apps/server/(network/|server[.]cpp)"
    "^apps/cli/options/command_line[.]cpp$" "^src/io/text/json_writer[.]cpp$")

set(violations "")
set(checked 0)

macro(violation)
  string(APPEND violations "  ${ARGN}\n")
endmacro()

# ---- the arrows -------------------------------------------------------------------------------------------
file(STRINGS ${LAYERS} lines)
set(modules "")
foreach(line IN LISTS lines)
  if(line MATCHES "^module ([a-z]+)$")
    list(APPEND modules ${CMAKE_MATCH_1})
  elseif(line MATCHES "^(PUBLIC|PRIVATE) ([a-z]+): ?(.*)$")
    string(REPLACE " " ";" ${CMAKE_MATCH_1}_${CMAKE_MATCH_2} "${CMAKE_MATCH_3}")
  elseif(line MATCHES "^ROOM ([a-z/]+)/([a-z_]+): ?(.*)$")
    set(module ${CMAKE_MATCH_1})
    set(room ${CMAKE_MATCH_2})
    string(REPLACE " " ";" used "${CMAKE_MATCH_3}")
    foreach(other IN LISTS used)
      if(NOT other IN_LIST rooms_${module})
        violation("CMake: room ${module}/${room} uses ${other}, which is not stated before it")
      endif()
    endforeach()
    list(APPEND rooms_${module} ${room})
    set(room_${module}_${room} ${room} ${used})
  else()
    message(FATAL_ERROR "${LAYERS}: cannot read '${line}'")
  endif()
endforeach()

# What a module's users see through it. Modules stand in building order, so one pass is enough.
foreach(module IN LISTS modules)
  set(seen_${module} ${module})
  foreach(used IN LISTS PUBLIC_${module})
    if(NOT DEFINED seen_${used})
      message(FATAL_ERROR "${LAYERS}: ${module} uses ${used}, which is not stated before it")
    endif()
    list(APPEND seen_${module} ${seen_${used}})
  endforeach()
  list(REMOVE_DUPLICATES seen_${module})
  set(body_${module} ${seen_${module}})
  foreach(used IN LISTS PRIVATE_${module})
    list(APPEND body_${module} ${seen_${used}})
  endforeach()
endforeach()

set(expected_verify base verify)
set(stated_verify ${body_verify})
list(SORT stated_verify)
if("verify" IN_LIST modules AND NOT stated_verify STREQUAL expected_verify)
  violation("CMake lets verify use ${stated_verify}; it may use base only")
endif()

# ---- the includes -----------------------------------------------------------------------------------------
# check_room(FILE MODULE PATH): PATH, as a file of MODULE includes it, lies in a room that FILE may reach.
function(check_room FILE MODULE PATH)
  if(NOT FILE MATCHES "^(src|include/lekalo)/${MODULE}/([a-z_]+)/")
    return()
  endif()
  set(room ${CMAKE_MATCH_2})
  if(NOT room IN_LIST rooms_${MODULE})
    violation("${FILE} lies in a room of ${MODULE} that CMake does not state")
  elseif(NOT PATH MATCHES "^(lekalo/)?${MODULE}/([a-z_]+)/")
    if(NOT PATH MATCHES "^lekalo/${MODULE}/" OR "${rooms_${MODULE}}" STREQUAL "")
      return()
    endif()
  elseif(NOT CMAKE_MATCH_2 IN_LIST room_${MODULE}_${room})
    violation("${FILE} includes ${PATH}: room ${MODULE}/${room} has no arrow to ${CMAKE_MATCH_2}")
  endif()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# check_app_room(FILE APP PATH): the same for a program, whose rooms may also reach the files beside them.
function(check_app_room FILE APP PATH)
  if(FILE MATCHES "^${APP}/([a-z_]+)/")
    set(room ${CMAKE_MATCH_1})
    if(NOT room IN_LIST rooms_${APP})
      violation("${FILE} lies in a room of ${APP} that CMake does not state")
    elseif(PATH MATCHES "^([a-z_]+)/" AND NOT CMAKE_MATCH_1 IN_LIST room_${APP}_${room})
      violation("${FILE} includes ${PATH}: room ${APP}/${room} has no arrow to ${CMAKE_MATCH_1}")
    endif()
  endif()
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

# check_file(FILE MODULE ALLOWED...): every include of FILE, relative to ROOT.
function(check_file FILE MODULE)
  set(allowed ${ARGN})
  file(STRINGS ${ROOT}/${FILE} includes REGEX "^[ \t]*#[ \t]*include")
  get_filename_component(folder ${ROOT}/${FILE} DIRECTORY)
  string(REGEX REPLACE "^([^/]+/[^/]+)/.*" "\\1" app "${FILE}")
  if(FILE MATCHES "[.]hpp$")
    file(STRINGS ${ROOT}/${FILE} first REGEX "^[ \t]*#" LIMIT_COUNT 1)
    if(NOT first STREQUAL "#pragma once")
      violation("${FILE} does not begin with #pragma once")
    endif()
  endif()
  foreach(include IN LISTS includes)
    if(NOT include MATCHES "include[ \t]*([\"<])([^\">]+)[\">]")
      violation("${FILE}: cannot read '${include}'")
      continue()
    endif()
    set(quote "${CMAKE_MATCH_1}")
    set(path "${CMAKE_MATCH_2}")
    foreach(name place IN ZIP_LISTS heavy heavy_places)
      if(path MATCHES "${name}" AND NOT FILE MATCHES "${place}")
        violation("${FILE} includes <${path}>: the compiler needs long for it; only ${place} may")
      endif()
    endforeach()
    if(path MATCHES "^lekalo/([^/]+)/")
      set(used ${CMAKE_MATCH_1})
      if(NOT used IN_LIST allowed)
        violation("${FILE} includes ${path}: ${MODULE} has no arrow to ${used}")
      elseif(used STREQUAL MODULE)
        check_room(${FILE} ${MODULE} ${path})
      endif()
    elseif(path MATCHES "^${MODULE}/[a-z_]+/[a-z_0-9]+[.]hpp$" AND EXISTS ${ROOT}/src/${path})
      check_room(${FILE} ${MODULE} ${path})
    elseif(MODULE STREQUAL "apps" AND EXISTS ${ROOT}/${app}/${path} AND NOT path MATCHES "[.][.]/")
      check_app_room(${FILE} ${app} ${path})
    elseif(MODULE STREQUAL "apps" AND path MATCHES "^server/[a-z_/]+[.]hpp$" AND EXISTS ${ROOT}/apps/${path})
      continue()
    elseif(quote STREQUAL "\"" AND (path MATCHES "/" OR NOT EXISTS ${folder}/${path}))
      violation("${FILE} includes \"${path}\": neither lekalo/MODULE/... nor a file beside it")
    elseif(path IN_LIST forbidden_below_disk AND NOT MODULE MATCHES "^(disk|apps)$")
      violation("${FILE} includes <${path}>: below disk nothing may depend on files, clocks or chance")
    elseif(path IN_LIST forbidden_below_io AND NOT MODULE MATCHES "^(io|draw|disk|apps)$")
      violation("${FILE} includes <${path}>: below io nothing may depend on the order of a hash")
    elseif(path IN_LIST number_headers AND NOT FILE MATCHES "^src/verify/number/")
      violation("${FILE} includes <${path}>: only src/verify/number may use GMP and MPFR")
    elseif(path IN_LIST thread_headers AND NOT MODULE STREQUAL "apps" AND NOT FILE STREQUAL "src/base/parallel.cpp")
      violation("${FILE} includes <${path}>: below the apps only src/base/parallel.cpp may use threads")
    endif()
  endforeach()
  math(EXPR checked "${checked} + 1")
  set(checked ${checked} PARENT_SCOPE)
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

function(check_folder FOLDER MODULE)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/${FOLDER}/*.cpp ${ROOT}/${FOLDER}/*.hpp)
  foreach(file IN LISTS files)
    check_file(${file} ${MODULE} ${ARGN})
  endforeach()
  set(checked ${checked} PARENT_SCOPE)
  set(violations "${violations}" PARENT_SCOPE)
endfunction()

foreach(module IN LISTS modules)
  check_folder(include/lekalo/${module} ${module} ${seen_${module}})
  check_folder(src/${module} ${module} ${body_${module}})
endforeach()
check_folder(apps apps ${modules})

# ---- one name, one type -----------------------------------------------------------------------------------
# Two headers of a module that define types of one name are fine for every compiler and link into one of the two.
foreach(module IN LISTS modules)
  file(GLOB_RECURSE headers RELATIVE ${ROOT} ${ROOT}/include/lekalo/${module}/*.hpp ${ROOT}/src/${module}/*.hpp)
  set(types "")
  foreach(header IN LISTS headers)
    file(STRINGS ${ROOT}/${header} definitions REGEX "^(struct|class) [A-Za-z0-9_]+( final)?( :.*| )?{")
    foreach(definition IN LISTS definitions)
      string(REGEX REPLACE "^(struct|class) ([A-Za-z0-9_]+).*" "\\2" type "${definition}")
      if(type IN_LIST types)
        violation("${header} defines ${type}, and so does another header of ${module}")
      endif()
      list(APPEND types ${type})
    endforeach()
  endforeach()
endforeach()

foreach(place include/lekalo src)
  file(GLOB folders RELATIVE ${ROOT}/${place} ${ROOT}/${place}/*)
  foreach(folder IN LISTS folders)
    if(NOT folder IN_LIST modules)
      violation("${place}/${folder} belongs to no module that CMake states")
    endif()
  endforeach()
endforeach()

# ---- no drawers -------------------------------------------------------------------------------------------
file(GLOB_RECURSE entries LIST_DIRECTORIES true RELATIVE ${ROOT} ${ROOT}/include/* ${ROOT}/src/* ${ROOT}/apps/*
     ${ROOT}/bindings/* ${ROOT}/web/src/*)
foreach(entry IN LISTS entries)
  if(IS_DIRECTORY ${ROOT}/${entry})
    file(GLOB own LIST_DIRECTORIES false ${ROOT}/${entry}/*)
    list(LENGTH own count)
    if(count GREATER most_files)
      violation("${entry} holds ${count} files of its own; more than ${most_files} are a drawer, name its rooms")
    endif()
  endif()
endforeach()

# ---- one case style for test names -----------------------------------------------------------------------
file(GLOB_RECURSE tests RELATIVE ${ROOT} ${ROOT}/tests/*.cpp ${ROOT}/tests/*.hpp)
foreach(test IN LISTS tests)
  file(STRINGS ${ROOT}/${test} named REGEX "^(TYPED_)?TEST(_F|_P)?\\([A-Za-z0-9_]+, [A-Za-z0-9_]+")
  foreach(line IN LISTS named)
    if(NOT line MATCHES "TEST(_F|_P)?\\([A-Z][A-Za-z0-9]*, [A-Z][A-Za-z0-9]*\\)")
      violation("${test}: '${line}' is not a name in CamelCase")
    endif()
  endforeach()
endforeach()

if(checked EQUAL 0)
  message(FATAL_ERROR "layers: no file found under ${ROOT}")
endif()
if(violations)
  message(FATAL_ERROR "layers broken:\n${violations}")
endif()
message(STATUS "layers: ${checked} files keep to the arrows")
