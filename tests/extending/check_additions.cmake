# Holds what the additions beside this file are to do, and that nothing else changes with them.
#
#   cmake -DLEKALO= -DEXTENDED= -DSOURCES= -DOVERLAY= -DLAYERS= -DPYTHON= -DWORK= -P check_additions.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})

# demand(SENTENCE CONDITION...)
function(demand SENTENCE)
  if(NOT (${ARGN}))
    message(FATAL_ERROR "${SENTENCE}")
  endif()
endfunction()

# ends(STATUS PROGRAM RESULT ARGUMENTS...): what it writes to stdout and stderr; it has to end with that status.
function(ends STATUS PROGRAM RESULT)
  execute_process(COMMAND ${PROGRAM} ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status
    OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL STATUS)
    message(FATAL_ERROR "${PROGRAM} ${ARGN}: ${status}: ${said}")
  endif()
  set(${RESULT} "${said}" PARENT_SCOPE)
endfunction()

# says(PROGRAM RESULT ARGUMENTS...): the same; it has to end well.
macro(says PROGRAM RESULT)
  ends(0 ${PROGRAM} ${RESULT} ${ARGN})
endmacro()

# names(SAID TEXT): the text stands in what was said.
function(names SAID TEXT)
  string(FIND "${SAID}" "${TEXT}" place)
  demand("'${TEXT}' is not in: ${SAID}" place GREATER -1)
endfunction()

# ---- the layers of the tree with the additions in it --------------------------------------------------------
foreach(folder include src apps)
  file(COPY ${SOURCES}/${folder} DESTINATION ${WORK}/tree)
endforeach()
file(COPY ${OVERLAY}/ DESTINATION ${WORK}/tree)
says(${CMAKE_COMMAND} layers -DROOT=${WORK}/tree -DLAYERS=${LAYERS} -P ${SOURCES}/tests/layers/check_layers.cmake)

# ---- the post: help names it, a pocket's program and a cut are written in it -----------------------------------
set(pocket ${SOURCES}/examples/pockets/cover.json --tool 6 --depth 1)
foreach(command pocket export)
  says(${EXTENDED} help ${command} --help)
  names("${help}" "shop")
endforeach()
says(${EXTENDED} said pocket ${pocket} --post shop -o shop.ngc)
file(READ ${WORK}/shop.ngc program)
demand("the added post has not written its comments: ${program}" program MATCHES "; LEKALO POCKET")

# ---- the move: it gets turns, so the search goes another way, and what is found passes the check ---------------
foreach(program LEKALO EXTENDED)
  says(${${program}} said nest ${SOURCES}/tests/extending/move/strip.json --work 1000000 --seed 1 --json -o ${program}.json)
  string(REGEX MATCH "\"work\": [0-9]+" work_${program} "${said}")
  says(${LEKALO} said check ${program}.json)
endforeach()
demand("the move that was added has never had a turn: ${work_LEKALO} with and without it"
  NOT work_LEKALO STREQUAL work_EXTENDED)

# ---- the format: help and refusals name it, and whatever takes drawings reads it --------------------------------
set(plt ${SOURCES}/tests/extending/format)
says(${EXTENDED} help locate --help)
names("${help}" ".dxf .svg .plt .hpgl")
says(${EXTENDED} help pocket --help)
names("${help}" "DXF, SVG or PLT")
file(WRITE ${WORK}/none.bin "?")
ends(3 ${EXTENDED} said check none.bin)
names("${said}" "DXF, SVG and PLT drawings")
ends(3 ${LEKALO} said check ${plt}/part.plt)
says(${EXTENDED} said check ${plt}/part.plt)
ends(2 ${EXTENDED} said nest ${plt}/part.plt --work 1)
names("${said}" "has parts and no sheet to place them on")
says(${EXTENDED} said pocket ${plt}/part.plt --tool 6 --depth 1 -o part.ngc)
says(${EXTENDED} said locate --part ${plt}/part.plt --blank ${plt}/blank.plt -o plt.json --json)
names("${said}" "\"status\": \"optimal\"")
ends(1 ${LEKALO} said verify plt.json)
names("${said}" "for the stated regions")

# ---- the criterion: help and refusals name it, its choice is another one, and the checker does not call that confirmed
set(parts --part ${SOURCES}/examples/regions/bracket.json --blank ${SOURCES}/examples/regions/casting.json --gap 0.02)
says(${EXTENDED} help locate --help)
names("${help}" "smallest|largest|even|left")
names("${help}" "the most even, or the one furthest to the left")
ends(2 ${LEKALO} said locate ${parts} --criterion left)
ends(2 ${EXTENDED} said locate ${parts} --criterion right)
names("${said}" "smallest, largest, even, left")
says(${EXTENDED} said locate ${parts} --criterion left --give-up 0.5 -o left.json)
names("${said}" "does not know the criterion left")
says(${EXTENDED} said locate ${parts} -o smallest.json)
foreach(result left smallest)
  file(READ ${WORK}/${result}.json document)
  string(JSON x_${result} GET "${document}" x)
endforeach()
demand("the criterion that was added has not moved the part: x is ${x_left}" x_left LESS x_smallest)
foreach(program LEKALO EXTENDED)
  ends(1 ${${program}} said verify left.json)
  names("${said}" "Incomplete: ")
  names("${said}" "the criterion \"left\" is none that this checker knows")
endforeach()

# ---- more than two lines are noticed --------------------------------------------------------------------------------
file(COPY ${SOURCES}/tests/extending/lay_over.py DESTINATION ${WORK}/planted)
file(WRITE ${WORK}/planted/greedy/lines.txt
  "README.md\n+one\nafter # lekalo\n+two\nafter # lekalo\n+three\nafter # lekalo\n")
ends(1 ${PYTHON} said -B planted/lay_over.py ${SOURCES} ${WORK}/planted/tree)
names("${said}" "greedy touches 3 existing lines")

# ---- nothing else: the same bytes without the additions -----------------------------------------------------------
foreach(arguments "pocket;${pocket}" "check;${SOURCES}/examples/layouts/shoes.json")
  foreach(program LEKALO EXTENDED)
    execute_process(COMMAND ${${program}} ${arguments} WORKING_DIRECTORY ${WORK} OUTPUT_VARIABLE bytes_${program}
      ERROR_VARIABLE bytes_${program})
  endforeach()
  demand("with the additions lekalo ${arguments} writes other bytes" bytes_LEKALO STREQUAL bytes_EXTENDED)
endforeach()
