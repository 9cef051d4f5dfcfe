# A second build of the same sources takes seconds with ccache; without it everything works the same.
if(PROJECT_IS_TOP_LEVEL AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(LEKALO_CCACHE ccache)
  mark_as_advanced(LEKALO_CCACHE)
  if(LEKALO_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${LEKALO_CCACHE})
  endif()
endif()
