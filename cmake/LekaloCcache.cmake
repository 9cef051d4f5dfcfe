# A second build of the same sources takes seconds with ccache, also in another checkout (paths below this one
# are taken relative, and the working directory is left out); without it everything works the same. It is told of
# headers by the compiler, so that a first build does not read every source twice.
if(PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(LEKALO_CCACHE ccache)
  mark_as_advanced(LEKALO_CCACHE)
  if(LEKALO_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_DEPEND=1 ${LEKALO_CCACHE})
  endif()
endif()
