# Builds the page once for all build folders, and copies it to where this one wants it:
#
#   cmake -DNPM=npm -DSOURCES=web -DPLACE=build/shared -DPAGE=FOLDER -DKERNEL=lekalo.wasm -DMISSING=page.html
#         -P build_page.cmake
#
# npm fetches the packages of package-lock.json, tsc checks the types, Vite makes the page, and the kernel is laid
# beside it. Where the packages cannot be fetched the page says so and the build goes on; without the stamp the next
# build tries again. A page that does not compile is an error.
cmake_minimum_required(VERSION 3.25)

# run(RESULT COMMAND...): its output is shown only where it fails.
function(run RESULT)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SOURCES} RESULT_VARIABLE status OUTPUT_VARIABLE said
    ERROR_VARIABLE said COMMAND_ECHO NONE)
  set(${RESULT} ${status} PARENT_SCOPE)
  if(NOT status EQUAL 0)
    message(STATUS "${said}")
  endif()
endfunction()

# Builds that run at the same time wait for each other here.
file(LOCK ${SOURCES}/.npm-lock GUARD PROCESS TIMEOUT 600)
set(installed ${SOURCES}/node_modules/.package-lock.json)
if(NOT EXISTS ${installed} OR ${SOURCES}/package-lock.json IS_NEWER_THAN ${installed})
  run(status ${NPM} ci --no-audit --no-fund --ignore-scripts --fetch-retries=2 --fetch-timeout=60000)
  if(NOT status EQUAL 0)
    message(WARNING "npm ci could not fetch what the page is built with (above): lekalo is built without its "
      "page. Build again when the network is there, or configure with -DLEKALO_WITH_PAGE=OFF.")
    file(REMOVE_RECURSE ${PAGE} ${PAGE}.stamp)
    file(MAKE_DIRECTORY ${PAGE})
    file(COPY_FILE ${MISSING} ${PAGE}/index.html)
    return()
  endif()
endif()

# The page that is there is the right one where all that it is made of has the same bytes.
file(GLOB_RECURSE sources ${SOURCES}/src/* ${SOURCES}/../examples/orders/* ${SOURCES}/../examples/layouts/*)
foreach(name index.html package-lock.json tsconfig.json vite.config.ts build_page.cmake)
  list(APPEND sources ${SOURCES}/${name})
endforeach()
set(key "")
foreach(file IN LISTS sources KERNEL)
  file(SHA256 ${file} hash)
  string(APPEND key "${file} ${hash}\n")
endforeach()
set(made ${PLACE}/page)
set(made_of "")
if(EXISTS ${made}.key)
  file(READ ${made}.key made_of)
endif()
if(NOT made_of STREQUAL key)
  file(REMOVE ${made}.key)
  set(bin ${SOURCES}/node_modules/.bin)
  run(status ${bin}/tsc --noEmit)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "The page has wrong types (above).")
  endif()
  run(status ${bin}/vite build --emptyOutDir --outDir ${made})
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "Vite could not build the page (above).")
  endif()
  if(KERNEL)
    file(COPY_FILE ${KERNEL} ${made}/lekalo.wasm)
  endif()
  file(WRITE ${made}.key "${key}")
endif()

file(REMOVE_RECURSE ${PAGE})
file(COPY ${made}/ DESTINATION ${PAGE})
file(TOUCH ${PAGE}.stamp)
