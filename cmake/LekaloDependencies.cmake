# What the modules link. cmake/lekaloConfig.cmake.in finds the same for whoever installs us.
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(MPFR REQUIRED IMPORTED_TARGET mpfr gmp)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(PNG REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(EXPAT REQUIRED IMPORTED_TARGET expat)
find_package(Threads REQUIRED)
if(LEKALO_WITH_IPOPT)
  pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt)
endif()

# Of the program alone, not of the modules: the server of the editor.
find_package(Boost 1.74 REQUIRED)  # headers: Asio, Beast
find_package(SQLite3 REQUIRED)
