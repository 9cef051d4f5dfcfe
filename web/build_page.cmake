# The packages of package-lock.json (once for all build folders), the page by Vite, the kernel beside it:
#
#   cmake -DNPM=npm -DSOURCES=web -DPAGE=FOLDER -DKERNEL=lekalo.wasm -DMISSING=page.html -P build_page.cmake
#
# Where the packages cannot be fetched the page says so and the build goes on; without the stamp the next build
# tries again. A page that does not compile is an error.
cmake_minimum_required(VERSION 3.25)

# run(RESULT COMMAND...): output and all only where it fails.
function(run RESULT)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SOURCES} RESULT_VARIABLE status OUTPUT_VARIABLE said
    ERROR_VARIABLE said COMMAND_ECHO NONE)
  set(${RESULT} ${status} PARENT_SCOPE)
  if(NOT status EQUAL 0)
    message(STATUS "${said}")
  endif()
endfunction()

set(installed ${SOURCES}/node_modules/.package-lock.json)
file(LOCK ${SOURCES}/.npm-lock GUARD PROCESS TIMEOUT 600)
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
file(LOCK ${SOURCES}/.npm-lock RELEASE)

set(bin ${SOURCES}/node_modules/.bin)
run(status ${bin}/tsc --noEmit)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The page has wrong types (above).")
endif()
run(status ${bin}/vite build --emptyOutDir --outDir ${PAGE})
if(NOT status EQUAL 0)
  message(FATAL_ERROR "Vite could not build the page (above).")
endif()
if(KERNEL)
  file(COPY_FILE ${KERNEL} ${PAGE}/lekalo.wasm)
endif()
file(TOUCH ${PAGE}.stamp)
