# Builds lekalo.wasm in one place for all presets, and copies it to where this build wants it:
#
#   cmake -DPLACE=build/wasm -DMODULE=build/dev/lekalo.wasm -DOPTIONS=options.cmake -P build_module.cmake
#
# Its flags do not depend on the preset. The lock lets builds that run at the same time wait for each other. What has
# changed since the last time only the inner build knows: without a change this takes a fraction of a second.
cmake_minimum_required(VERSION 3.25)
file(MAKE_DIRECTORY ${PLACE})
file(LOCK ${PLACE} DIRECTORY GUARD PROCESS TIMEOUT 3600)

# run(COMMAND...): its output is shown only where it fails.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "lekalo.wasm could not be built:\n${said}")
  endif()
endfunction()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/module -B ${PLACE} -G Ninja -C ${OPTIONS})
run(${CMAKE_COMMAND} --build ${PLACE})
file(COPY_FILE ${PLACE}/lekalo.wasm ${MODULE} ONLY_IF_DIFFERENT)
