# What the modules link. cmake/lekaloConfig.cmake.in finds the same for whoever installs us.
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MPFR REQUIRED IMPORTED_TARGET mpfr gmp)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(EXPAT REQUIRED IMPORTED_TARGET expat)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)
find_package(Threads REQUIRED)
if(LEKALO_WITH_IPOPT)
  pkg_check_modules(IPOPT QUIET IMPORTED_TARGET ipopt)
  if(NOT IPOPT_FOUND)
    message(STATUS "No IPOPT (coinor-libipopt-dev, libblas-dev, liblapack-dev, libgfortran-12-dev): lekalo is built "
      "without the source's reference method; tools/setup.sh installs it.")
    set(LEKALO_WITH_IPOPT OFF)
  endif()
endif()
if(LEKALO_WITH_QR)
  pkg_check_modules(QRENCODE QUIET IMPORTED_TARGET libqrencode)
  if(NOT QRENCODE_FOUND)
    message(STATUS "No libqrencode (libqrencode-dev): lekalo is built without labels, whose QR codes it makes; "
      "tools/setup.sh installs it.")
    set(LEKALO_WITH_QR OFF)
  endif()
endif()

# Of the program alone, not of the modules: the server of the editor.
find_package(Boost 1.74 REQUIRED)  # headers: Asio, Beast
find_package(SQLite3 REQUIRED)

if(LEKALO_BUILD_TESTS)
  find_package(GTest QUIET)
  find_package(Python3 QUIET COMPONENTS Interpreter)
  if(NOT GTest_FOUND)
    message(STATUS "No GoogleTest (libgtest-dev): the tests are not built; tools/setup.sh installs it.")
    set(LEKALO_BUILD_TESTS OFF)
  elseif(NOT Python3_FOUND)
    message(STATUS "No Python (python3): the tests of documents, of additions and some of the command are left out; "
      "tools/setup.sh installs it.")
  endif()
endif()
